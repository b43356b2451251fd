# SPDX-License-Identifier: GPL-3.0-or-later
"""python -m garmentfit dress BODY GARMENT [GARMENT ...] -o DIR"""
from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any, Dict, List, Optional

from . import Cancelled, Garment, InvalidInput, SolverFailure, __version__, _core, dress, read_mesh

WRONG_INPUT, TOO_SMALL, NOT_CERTIFIED, STOPPED = 2, 3, 4, 130  # exit codes of the command line


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m garmentfit", description="Dresses bodies in garments made for others")
    parser.add_argument("--version", action="version", version=f"garmentfit {__version__}")
    command = parser.add_subparsers(dest="command", required=True).add_parser("dress", help="rig, fit, drape, recover")
    command.add_argument("body", metavar="BODY")
    command.add_argument("garments", metavar="GARMENT", nargs="+", help="from the inside out")
    command.add_argument("-o", "--output", required=True, type=Path, metavar="DIR")
    command.add_argument("--type", action="append", default=[], dest="types", choices=_core.garment_types(),
                         help="of a garment, once for each")
    for flag in ("--unit", "--up", "--front", "--garment-unit", "--garment-up"):
        command.add_argument(flag, default="auto")
    command.add_argument("--quiet", action="store_true")
    for name, default, range_, help_ in _core.parameters_of("dress"):
        if name != "type":
            command.add_argument("--" + name.replace("_", "-"), dest=name, help=f"{help_} ({range_})".replace("%", "%%"),
                                 **({"action": "store_true"} if isinstance(default, bool) else {"default": default}))
    return parser


def _parameters(call: argparse.Namespace) -> Dict[str, Any]:
    return {name: getattr(call, name) for name, *_ in _core.parameters_of("dress") if name != "type"}


def _run(call: argparse.Namespace) -> int:
    types = call.types + ["auto"] * (len(call.garments) - len(call.types))
    meshes = [read_mesh(path) for path in call.garments]
    result = dress(read_mesh(call.body), [Garment(mesh, type_) for mesh, type_ in zip(meshes, types)],
                   unit=call.unit, up=call.up, front=call.front, garment_unit=call.garment_unit,
                   garment_up=call.garment_up, **_parameters(call))
    call.output.mkdir(parents=True, exist_ok=True)
    for mesh, garment in zip(meshes, result.garments):
        if garment.certificate.clean:
            mesh.write(call.output / mesh.name, garment.positions)
    if not call.quiet and result.certified:
        print(f"written to {call.output}")
    if not result.certified:
        print(f"garmentfit: {result.note}", file=sys.stderr)
        return TOO_SMALL if result.too_small else NOT_CERTIFIED
    return 0


def _fail(code: int, message: str) -> int:
    print(f"garmentfit: {message}", file=sys.stderr)
    return code


def main(arguments: Optional[List[str]] = None) -> int:
    call = _parser().parse_args(arguments)
    try:
        return _run(call)
    except InvalidInput as error:
        return _fail(WRONG_INPUT, str(error))
    except SolverFailure as error:
        return _fail(NOT_CERTIFIED, str(error))
    except (Cancelled, KeyboardInterrupt):
        return _fail(STOPPED, "stopped by the user")


if __name__ == "__main__":
    sys.exit(main())
