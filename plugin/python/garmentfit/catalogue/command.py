# SPDX-License-Identifier: GPL-3.0-or-later
"""garmentfit catalogue: arguments, messages and exit codes."""
from __future__ import annotations

import argparse
import os
import shlex
import subprocess
import sys

from .plan import Hashes, PlanError, read_plan, to_json
from .store import DiskError, Store, StoreError, write_error

_STOPPED = "garmentfit catalogue: stopped; the same command goes on from here"
_NO_ANSWER = "the workers did not answer in time; run again to go on"  # Dask's TimeoutError has no text
_BY_CHANCE = ("crashed", "killed", "time_limit", "memory_limit", "file_limit", "unreadable_file")  # may pass next time
_MISSING = "garmentfit catalogue: needs {}; install it with: pip install 'garmentfit[catalogue]'"


def main(words: list) -> int:
    """Runs `garmentfit catalogue words...`. Returns 0 when every pair has a row, whatever its end; 2: wrong input or
    folder; 4: the disk, the scheduler or all workers were lost; 130: Ctrl-C. After 4 and 130 the folder resumes."""
    try:
        return _command(words)
    except (PlanError, StoreError) as error:
        print(f"garmentfit catalogue: {error}", file=sys.stderr)
        return 2
    except DiskError as error:
        print(f"garmentfit catalogue: {error}", file=sys.stderr)
        return 4
    except ModuleNotFoundError as error:
        print(_MISSING.format(error.name), file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print(_STOPPED, file=sys.stderr)
        return 130


OPTIONS = (  # of a run and of a list of its jobs
    (("-o", "--output"), {"required": True, "metavar": "DIR", "help": "folder; a run that stopped goes on in it"}),
    (("--program",), {"default": "", "metavar": "COMMAND", "help": "program to call; this package's by default"}),
    (("--no-pictures",), {"action": "store_true", "help": "no thumbnails and no 3D views"}),
)


def _command(words: list) -> int:
    from . import workflow

    others = {"status": _status, "list": workflow.list_jobs, "job": workflow.run_one,
              "results": workflow.tables_and_page}
    return others[words[0]](words[1:]) if words and words[0] in others else _run(words)


def _arguments(words: list):
    parser = argparse.ArgumentParser(prog="garmentfit catalogue", description="Dresses many bodies in many garments.",
                                     epilog="garmentfit catalogue status DIR: how many pairs have ended, and how. "
                                            "garmentfit catalogue list, job, results: one step each, for workflow "
                                            "engines")
    parser.add_argument("plan", help="plan.toml or plan.csv")
    for names, about in OPTIONS:
        parser.add_argument(*names, **about)
    parser.add_argument("--scheduler", default="", metavar="ADDRESS",
                        help="a Dask scheduler whose workers see DIR and the inputs under the same paths")
    parser.add_argument("--workers", type=int, default=0,
                        help="local workers; by default as many as the cores have room for")
    parser.add_argument("--retry", action="store_true",
                        help="do again what crashed, met a limit or could not read a file")
    parser.add_argument("--quiet", action="store_true", help="no progress bar")
    return parser.parse_args(words)


def prepare(options) -> tuple:
    """The plan, the program with its version, and the folder, which exists then."""
    program = shlex.split(options.program) or [sys.executable, "-m", "garmentfit"]
    plan, version = read_plan(options.plan), _version(program)
    store = Store(options.output)
    store.create()
    return plan, program, version, store


def _run(words: list) -> int:
    options = _arguments(words)
    plan, program, version, store = prepare(options)
    with store.lock():
        try:
            return _run_held(store, plan, program, version, options)
        except OSError as error:
            raise write_error(store.folder, error) from None


def _run_held(store: Store, plan, program: list, version: str, options) -> int:
    """The run of the holder of the lock; returns the exit code."""
    store.clear_work()
    pairs = named_pairs(store, plan, version)
    if options.retry:
        _forget_failures(store, pairs)
    code = _work(store, pairs, program, plan.limits, options)
    write_results(store)
    return code


def named_pairs(store: Store, plan, version: str) -> dict:
    """Pairs with the names of their rigs, by their names; also written into the folder. A pair with a file that cannot
    be read gets its row here, and has no rig."""
    from .job import finish_unreadable

    pairs, unreadable = _named(plan, version)
    store.write_plan({key: to_json(pair) for key, (pair, _) in pairs.items()})
    for key, error in unreadable.items():
        finish_unreadable(store, key, pairs[key][0], error)
    return pairs


def _named(plan, version: str) -> tuple:
    """Pairs with the names of their rigs, and errors of those with a file that cannot be read: both by their names."""
    hashes, pairs, unreadable = Hashes(), {}, {}
    for pair in plan.pairs:
        try:
            pairs[hashes.of_pair(pair, version)] = pair, hashes.of_rig(pair, version)
        except OSError as error:
            key = hashes.of_unreadable(pair, version)
            pairs[key], unreadable[key] = (pair, ""), error
    return pairs, unreadable


def _version(program: list) -> str:
    try:
        return subprocess.run([*program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError) as error:
        raise StoreError(f"{program[0]}: cannot be run ({error})") from None


def _forget_failures(store: Store, pairs: dict) -> None:
    rigs = {("rig", rig) for _, rig in pairs.values() if rig}
    for kind, key in [("dress", key) for key in pairs] + sorted(rigs):
        row = store.finished(kind, key)
        if row and row["reason"] in _BY_CHANCE:
            store.forget(kind, key)


def _work(store: Store, pairs: dict, program: list, limits, options) -> int:
    """Makes the rigs, then the pairs; returns the exit code. Prints why it ended early."""
    from tqdm import tqdm

    from .job import Fatal, run_job
    from .scheduling import SchedulerLost, run_jobs

    folder, draw = str(store.folder), not options.no_pictures
    workers = options.workers or max(1, (os.cpu_count() or 1) // limits.threads)
    rest = {key: pair for key, pair in pairs.items() if store.finished("dress", key) is None}
    rigs = {rig: pair for pair, rig in rest.values() if store.finished("rig", rig) is None}
    try:
        for kind, jobs in (
                ("rig", [(folder, "rig", key, pair, key, program, limits, draw) for key, pair in rigs.items()]),
                ("dress", [(folder, "dress", key, *pair, program, limits, draw) for key, pair in rest.items()])):
            total = len(pairs) if kind == "dress" else len(jobs)
            if jobs:
                with tqdm(total=total, initial=total - len(jobs), desc=kind, unit="pair" if kind == "dress" else "body",
                          disable=None if not options.quiet else True) as bar:
                    run_jobs(run_job, jobs, options.scheduler, workers, bar.update)
    except BaseException as error:
        if _is_ctrl_c(error):
            print(_STOPPED, file=sys.stderr)
            return 130
        if isinstance(error, (Fatal, SchedulerLost, OSError)):
            print(f"garmentfit catalogue: {str(error) or _NO_ANSWER}", file=sys.stderr)
            return 4
        raise
    return 0


def _is_ctrl_c(error) -> bool:
    """Also where closing the workers failed after it."""
    while error and not isinstance(error, KeyboardInterrupt):
        error = error.__context__
    return error is not None


def write_results(store: Store) -> None:
    from . import page, results

    rows = results.collect(store)
    results.write_tables(store, rows)
    page.write_page(store, rows)
    print(_in_words(results.summary(rows)))


def _status(words: list) -> int:
    parser = argparse.ArgumentParser(prog="garmentfit catalogue status")
    parser.add_argument("folder", metavar="DIR")
    store = Store(parser.parse_args(words).folder)
    from . import results

    rows = results.collect(store)
    print(_in_words(results.summary(rows)))
    return 0


def _in_words(summary) -> str:
    total, waiting = sum(summary.values()), summary.get("waiting", 0)
    lines = [f"{total - waiting} of {total} pairs finished"]
    return "\n".join(lines + [f"  {count:6d}  {reason}" for reason, count in summary.most_common()])
