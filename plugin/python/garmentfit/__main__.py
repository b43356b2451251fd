# SPDX-License-Identifier: GPL-3.0-or-later
"""python -m garmentfit: the command line's program, with all its commands, files and exit codes."""
import sys

from . import _core


def main() -> int:
    return _core.run_program(["garmentfit", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
