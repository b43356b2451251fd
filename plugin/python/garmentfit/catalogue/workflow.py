# SPDX-License-Identifier: GPL-3.0-or-later
"""The jobs of a catalogue one by one, for workflow engines: they schedule in place of Dask, and get the same folders.

    garmentfit catalogue list PLAN -o DIR     prints which jobs there are, and writes it to DIR/workflow.json
    garmentfit catalogue job DIR rig KEY      makes one rig
    garmentfit catalogue job DIR dress KEY    dresses one pair, once its rig is made
    garmentfit catalogue results DIR          tables and page of what has ended
"""
from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict

from .command import OPTIONS, named_pairs, prepare, write_results
from .plan import Limits, Pair, read_plan
from .store import Store, StoreError, write_error, write_whole

_FILE = "workflow.json"


def list_jobs(words: list) -> int:
    """Writes and prints {"pairs": {key: key of its rig}, "rigs": {key: key of a pair with this body}}, and what jobs
    need to know. A pair with a file that cannot be read has its row at once, and no rig."""
    parser = argparse.ArgumentParser(prog="garmentfit catalogue list")
    parser.add_argument("plan", help="plan.toml or plan.csv")
    for names, about in OPTIONS:
        parser.add_argument(*names, **about)
    options = parser.parse_args(words)
    plan, program, version, store = prepare(options)
    with store.lock():
        try:
            pairs = named_pairs(store, plan, version)
            table = {"program": program, "limits": asdict(plan.limits), "pictures": not options.no_pictures,
                     "rigs": {rig: key for key, (_, rig) in pairs.items() if rig},
                     "pairs": {key: rig for key, (_, rig) in pairs.items()}}
            write_whole(store.folder / _FILE, json.dumps(table))
        except OSError as error:
            raise write_error(store.folder, error) from None
    print(json.dumps(table))
    return 0


def run_one(words: list) -> int:
    """Returns 0 when the job has a row, whatever its end, and 4 when no job can succeed."""
    parser = argparse.ArgumentParser(prog="garmentfit catalogue job")
    parser.add_argument("folder", metavar="DIR")
    parser.add_argument("kind", choices=("rig", "dress"))
    parser.add_argument("key", metavar="KEY")
    options = parser.parse_args(words)
    from .job import Fatal, run_job

    store, table = _listed(options.folder)
    known = table["rigs" if options.kind == "rig" else "pairs"]
    if options.key not in known:
        raise StoreError(f"{store.folder}: has no {options.kind} {options.key}; garmentfit catalogue list PLAN -o DIR "
                         "prints those that there are")
    pair_key, rig = (known[options.key], options.key) if options.kind == "rig" else (options.key, known[options.key])
    if options.kind == "dress" and rig and store.finished("rig", rig) is None:
        raise StoreError(f"{store.folder}: the rig {rig} of this pair is not made; run the job rig {rig} first")
    pair = Pair(**store.read_plan()[pair_key])
    try:
        row = run_job(str(store.folder), options.kind, options.key, pair, rig, table["program"],
                      Limits(**table["limits"]), table["pictures"])
    except Fatal as error:
        print(f"garmentfit catalogue: {error}", file=sys.stderr)
        return 4
    print(f"{options.kind} {options.key}: {row['reason']}")
    return 0


def tables_and_page(words: list) -> int:
    parser = argparse.ArgumentParser(prog="garmentfit catalogue results")
    parser.add_argument("folder", metavar="DIR")
    store, _ = _listed(parser.parse_args(words).folder)
    try:
        write_results(store)
    except OSError as error:
        raise write_error(store.folder, error) from None
    return 0


def _listed(folder: str) -> tuple:
    store = Store(folder)
    try:
        return store, json.loads((store.folder / _FILE).read_text())
    except FileNotFoundError:
        raise StoreError(f"{store.folder}: no list of jobs; start with garmentfit catalogue list PLAN -o DIR") from None
