# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints a plan, as CSV, in which each garment of test data and of a corpus occurs once, and each body.

    python plan_of_corpus.py DATA CORPUS [--share 0.5] [--seed 1] > plan.csv

DATA has pairs.csv (columns body, garment) and bodies/; CORPUS has corpus.csv (columns mesh and fits, the names of
bodies near to the one that a garment was made on). Of those bodies, the one that has the fewest garments so far gets
it. Bodies that are left over get a garment of DATA. --share takes that part of CORPUS at random.
"""
from __future__ import annotations

import argparse
import collections
import csv
import random
import sys
from pathlib import Path


def main(words: list) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("data", type=Path)
    parser.add_argument("corpus", type=Path)
    parser.add_argument("--share", type=float, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--quality", default="draft")
    options = parser.parse_args(words)
    known = _rows(options.corpus / "corpus.csv")
    known = random.Random(options.seed).sample(known, round(options.share * len(known)))
    pairs = [(options.data / row["body"], options.data / row["garment"]) for row in _rows(options.data / "pairs.csv")]
    used = collections.Counter(body.stem for body, _ in pairs)
    for row in sorted(known, key=lambda row: row["mesh"]):
        body = min(row["fits"].split(), key=lambda name: used[name])
        used[body] += 1
        pairs.append((options.data / "bodies" / f"{body}.ply", options.corpus / row["mesh"]))
    garments = [garment for _, garment in pairs]
    left = sorted(body for body in (options.data / "bodies").glob("*.ply") if not used[body.stem])
    pairs += zip(left, garments)
    writer = csv.writer(sys.stdout)
    writer.writerow(["body", "garment", "quality"])
    writer.writerows((body.resolve(), garment.resolve(), options.quality) for body, garment in pairs)


def _rows(path: Path) -> list:
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


if __name__ == "__main__":
    main(sys.argv[1:])
