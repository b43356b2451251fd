// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace garmentfit::cli {

/// What `garmentfit` does with its words, for a process that does nothing else: SIGINT and SIGTERM are watched from here on.
/// Exit codes and files are described in docs/command-line.md.
int run_program(int argc, char** argv);

}  // namespace garmentfit::cli
