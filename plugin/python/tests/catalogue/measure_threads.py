# SPDX-License-Identifier: GPL-3.0-or-later
"""Two workers with one thread each against one worker with two threads, on pairs of a plan. Not a test.

    python measure_threads.py plan.csv --program build/release/plugin/cli/garmentfit [--pairs 12] [--seed 1]

Takes two pairs at a time: both at once with one thread each, and one after the other with two threads; every other time
in the other order. Prints the wall clock of both ways, and what they would take on two free cores, by processor time:
with two threads, the time in which n of them could run counts 1/n. Only that figure can be trusted where other
programs use the cores; memory bandwidth, which both ways share, is not in it.
"""
from __future__ import annotations

import argparse
import os
import random
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from garmentfit.catalogue.plan import read_plan

_SAMPLE_SECONDS = 0.005


def main(words: list) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("plan")
    parser.add_argument("--program", default=f"{sys.executable} -m garmentfit")
    parser.add_argument("--pairs", type=int, default=12)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args(words)
    pairs = random.Random(options.seed).sample(read_plan(options.plan).pairs, options.pairs)
    total = [0.0] * 5
    print("wall s, two workers | one worker | user+system s, one thread | two threads | two threads on free cores")
    with tempfile.TemporaryDirectory() as folder:
        calls = [_call(shlex.split(options.program), pair, Path(folder) / str(number))
                 for number, pair in enumerate(pairs)]
        for number in range(0, len(calls) - 1, 2):
            figures = _compare(calls[number:number + 2], number // 2 % 2 == 1)
            total = [sum(each) for each in zip(total, figures)]
            names = " and ".join(Path(pair.layers[0]).stem for pair in pairs[number:number + 2])
            print(" ".join(f"{figure:8.2f}" for figure in figures), names, flush=True)
    wall_two, wall_one, one_thread, two_threads, free = total
    print(" ".join(f"{figure:8.2f}" for figure in total), "together")
    print(f"ratio by the wall clock {wall_one / wall_two:.2f}; on two free cores {free / (one_thread / 2):.2f}; "
          f"two threads use {two_threads / one_thread:.2f} times the processor time of one")


def _call(program: list, pair, folder: Path) -> list:
    """The call that dresses a pair. Its rig is made here."""
    subprocess.run([*program, "rig", pair.body, "--quiet", "-o", str(folder)], check=True)
    return [*program, "dress", pair.body, *pair.layers, *pair.flags(), "--quiet", "--rig", str(folder / "rig.json"),
            "-o", str(folder)]


def _compare(calls: list, one_worker_first: bool) -> tuple:
    if one_worker_first:
        one_worker = _one_after_the_other(calls)
        two_workers = _at_once(calls)
    else:
        two_workers = _at_once(calls)
        one_worker = _one_after_the_other(calls)
    return two_workers[0], one_worker[0], two_workers[1], *one_worker[1:]


def _at_once(calls: list) -> tuple:
    """Wall clock and processor seconds, one thread each."""
    start, used = time.monotonic(), os.times()
    started = [subprocess.Popen([*call, "--threads", "1"], stderr=subprocess.DEVNULL) for call in calls]
    for process in started:
        process.wait()
    return time.monotonic() - start, _of_children(used)


def _one_after_the_other(calls: list) -> tuple:
    """Wall clock, processor seconds, and seconds on free cores, two threads each."""
    start, used, free = time.monotonic(), os.times(), 0.0
    for call in calls:
        process = subprocess.Popen([*call, "--threads", "2"], stderr=subprocess.DEVNULL)
        free += _on_free_cores(process)
    return time.monotonic() - start, _of_children(used), free


def _of_children(before) -> float:
    now = os.times()
    return now.children_user + now.children_system - before.children_user - before.children_system


def _on_free_cores(process) -> float:
    """Waits for the end of a process; its processor time, each piece divided by the threads that could run then."""
    folder, free, before = Path(f"/proc/{process.pid}/task"), 0.0, {}
    while process.poll() is None:
        now, runnable = {}, 0
        for thread in list(folder.glob("*")):
            try:
                runnable += (thread / "stat").read_text().rsplit(") ", 1)[1][0] == "R"
                now[thread.name] = int((thread / "schedstat").read_text().split()[0]) / 1e9
            except (OSError, IndexError, ValueError):
                pass  # it ended
        free += sum(now[name] - before.get(name, 0) for name in now) / max(1, runnable)
        before = {**before, **now}
        time.sleep(_SAMPLE_SECONDS)
    return free


if __name__ == "__main__":
    main(sys.argv[1:])
