// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace garmentfit::cli {

/// The program garmentfit, for a process that does nothing else: it watches SIGINT and SIGTERM from here on.
/// Exit codes and files are described in docs/command-line.md.
int run_program(int argc, char** argv);

}  // namespace garmentfit::cli
