// SPDX-License-Identifier: GPL-3.0-or-later

// garmentfit: the filters on the command line.

#include "program.h"

int main(int argc, char** argv) { return garmentfit::cli::run_program(argc, argv); }
