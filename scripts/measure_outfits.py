# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures dressed folders by a benchmark, prints a table in Markdown. Run by scripts/measure-outfits."""

import json
import subprocess
import sys
from pathlib import Path

HEAD = """| outfit | nearest point | weights of clothes | nearest point, skin hidden and drawn in | both | share | faces hidden \
| skin out, nearest | skin out, weights | edges torn, nearest | edges torn, weights |
| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"""

HOLES_HEAD = """| outfit | faces hidden | pixels of skin | through | deep |
| --- | ---: | ---: | ---: | ---: |"""


def measure(program: str, folder: Path) -> list:
    """One result for each garment that the folder holds dressed."""
    report = json.loads((folder / "report.json").read_text())
    if not report["certified"]:
        sys.exit(f"{folder}: not certified; give folders of outfits that could be worn")
    names = [garment["file"] for garment in report["garments"]]
    return [json.loads(subprocess.run([program, folder / "body.ply", folder / "rest" / name, folder / name],
                                      check=True, capture_output=True, text=True).stdout) for name in names]


def row(name: str, results: list) -> tuple:
    """Of all garments and poses, nearest and ours: crossings with the whole body and with what is shown; skin that came
    out; edges torn."""
    rivals = "nearest", "ours"
    crossings = [sum(result[rival]["crossings"][k] for result in results) for k in (0, 1) for rival in rivals]
    others = [sum(result[rival][what] for result in results) for what in ("out", "torn") for rival in rivals]
    hidden = sum(1 - result["shown_faces"] / result["faces"] for result in results) / len(results)
    return name, *crossings, hidden, *others


def line(name: str, nearest: int, ours: int, nearest_shown: int, ours_shown: int, hidden: float, *others: int) -> str:
    share = f"{ours_shown / nearest:.2f}" if nearest else "-"
    columns = [name, nearest, ours, nearest_shown, ours_shown, share, f"{hidden:.0%}", *others]
    return "| " + " | ".join(map(str, columns)) + " |"


def holes_row(name: str, results: list) -> tuple:
    hidden = sum(1 - result["shown_faces"] / result["faces"] for result in results) / len(results)
    return name, hidden, *(sum(result[what] for result in results) for what in ("skin", "through", "deep"))


def print_holes(program: str, outfits: list) -> None:
    """What views of each garment by itself show where covered skin was left out."""
    rows = []
    print(HOLES_HEAD)
    for outfit in outfits:
        name, _, folder = outfit.partition("=")
        rows.append(holes_row(name, measure(program, Path(folder))))
        print("| {} | {:.0%} | {} | {} | {} |".format(*rows[-1]), flush=True)
    sums = [sum(column) for column in list(zip(*rows))[1:]]
    print("| all | {:.0%} | {} | {} | {} |".format(sums[0] / len(rows), *sums[1:]))


def main(program: str, *outfits: str) -> None:
    if outfits[0] == "--holes":
        print_holes(program, outfits[1:])
        return
    rows = []
    print(HEAD)
    for outfit in outfits:
        name, _, folder = outfit.partition("=")
        rows.append(row(name, measure(program, Path(folder))))
        print(line(*rows[-1]), flush=True)
    sums = [sum(column) for column in list(zip(*rows))[1:]]
    sums[4] /= len(rows)
    print(line("all", *sums))


if __name__ == "__main__":
    main(*sys.argv[1:])
