# SPDX-License-Identifier: GPL-3.0-or-later
"""python -m garmentfit: the command line's program, with all its commands, files and exit codes, and catalogue."""
import sys


def main() -> int:
    if sys.argv[1:2] == ["catalogue"]:
        from .catalogue.command import main as run_catalogue
        return run_catalogue(sys.argv[2:])
    from . import _core
    return _core.run_program(["garmentfit", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
