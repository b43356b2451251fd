# SPDX-License-Identifier: GPL-3.0-or-later
"""What scheduling costs: the command, with a program that does nothing or sleeps, on a cluster. Not a test.

    python measure_scheduling.py --jobs 1000 [--sleep 2] [--workers 2]
    python measure_scheduling.py --jobs 100000 --no-processes
    python measure_scheduling.py --jobs 10000 --no-processes --sleep 20 --simulated 1000

The plan has one body and one garment, and a parameter that counts. Scheduler and workers are started by the dask
command. With --no-processes workers get the same jobs and do nothing with them: what is left is the cost of Dask.
Of simulated workers all run in one process; scheduler and client do not notice.
Prints while it runs: time, jobs finished, processor time and memory of client, scheduler and all workers; at the end
the wall clock from the first row to the last beside that of workers which are never idle.
"""
from __future__ import annotations

import argparse
import multiprocessing
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil
from distributed import Client
from garmentfit.catalogue.plan import Limits, Pair
from garmentfit.catalogue.scheduling import run_jobs

import faults

_PROGRAM = """\
#!/bin/sh
case $* in
*--version*) echo nothing 1 ;;
*dress*) {work} ;;
esac
"""


def main(words: list) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jobs", type=int, default=1000)
    parser.add_argument("--sleep", type=float, default=0, help="length of a job in seconds")
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    parser.add_argument("--no-processes", action="store_true")
    parser.add_argument("--simulated", type=int, default=0, metavar="NUMBER", help="workers in one process")
    parser.add_argument("--every", type=float, default=20, help="seconds between lines")
    options = parser.parse_args(words)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        with faults.Cluster(0 if options.simulated else options.workers, folder) as cluster:
            if options.simulated:
                cluster.workers.append(_simulate(cluster.address, options.simulated, folder))
            client = (_Dask if options.no_processes else _Command)(folder, options, cluster.address)
            parts = {"client": [client.process], "scheduler": [cluster.scheduler], "workers": cluster.workers}
            used = _watch(client, parts, options.every)
        ended = client.count()
        print(client.conclusion() + "for each job " + ", ".join(
            f"{part} {1000 * seconds / ended:.2f} ms" for part, (seconds, _) in used.items()))


class _Command:
    """garmentfit catalogue."""

    def __init__(self, folder: Path, options, address: str):
        self._output, self._options = folder / "out", options
        self.process = subprocess.Popen([*_prepare(folder, options), "--scheduler", address])
        self.runs = lambda: self.process.poll() is None

    def count(self) -> int:
        try:
            return sum(len(os.listdir(self._output / "jobs" / part)) for part in os.listdir(self._output / "jobs"))
        except FileNotFoundError:
            return 0

    def conclusion(self) -> str:
        options = self._options
        ends = sorted(path.stat().st_mtime for path in self._output.glob("jobs/*/*/done.json"))
        busy = (len(ends) - options.workers) * options.sleep / options.workers
        return (f"{len(ends)} jobs of {options.sleep:g} s on {options.workers} workers: {ends[-1] - ends[0]:.1f} s "
                f"from the first row to the last, {busy:.1f} s if no worker waited; ")


class _Dask:
    """The part of the command that hands jobs to Dask."""

    def __init__(self, folder: Path, options, address: str):
        self._ended = multiprocessing.Value("i")
        self.process = multiprocessing.Process(target=self._run, args=(folder, options, address))
        self.process.start()
        self.runs = self.process.is_alive

    def _run(self, folder: Path, options, address: str) -> None:
        def arrived():
            self._ended.value += 1
        pairs = (Pair("/bodies/body.ply", "garment", ("/garments/garment.ply",), parameters=(("number", str(number)),))
                 for number in range(options.jobs))
        jobs = ((options.sleep, str(folder), "dress", f"{number:024x}", pair, "0" * 24, ["garmentfit"], Limits(), True)
                for number, pair in enumerate(pairs))
        run_jobs(_sleep, jobs, address, arrived=arrived)

    def count(self) -> int:
        return self._ended.value

    def conclusion(self) -> str:
        return f"{self.count()} jobs; "


def _sleep(seconds: float, *_) -> None:
    time.sleep(seconds)


def _simulate(address: str, number: int, folder: Path):
    """Returns the process, when all workers are known to the scheduler."""
    script, start = Path(__file__).parent / "many_workers.py", time.monotonic()
    started = subprocess.Popen([sys.executable, str(script), address, str(number), str(folder)],
                               stderr=subprocess.DEVNULL)
    with Client(address, set_as_default=False) as client:
        client.wait_for_workers(number, timeout=600)
    print(f"{number} workers after {time.monotonic() - start:.0f} s", flush=True)
    return started


def _watch(client, parts: dict, every: float) -> dict:
    """Prints a line now and then until the client ends; returns the last figures of each part."""
    print(f"{'s':>6} {'finished':>9}" + "".join(f" {part + ' s':>12} {'MB':>6}" for part in parts), flush=True)
    start, used = time.monotonic(), {}
    while client.runs():
        now = {part: _used(processes) for part, processes in parts.items()}
        if not client.runs():
            break
        used = now
        print(f"{time.monotonic() - start:6.0f} {client.count():9d}" +
              "".join(f" {seconds:12.1f} {memory:6.0f}" for seconds, memory in used.values()), flush=True)
        end = time.monotonic() + every
        while client.runs() and time.monotonic() < end:
            time.sleep(0.2)
    return used


def _prepare(folder: Path, options) -> list:
    """Writes inputs, plan and program; returns the command."""
    for name in ("body.ply", "garment.ply"):
        (folder / name).write_text(name)
    lines = ["body,garment,number", *(f"body.ply,garment.ply,{number}" for number in range(options.jobs))]
    (folder / "plan.csv").write_text("\n".join(lines) + "\n")
    (folder / "program").write_text(_PROGRAM.format(work=f"exec sleep {options.sleep}" if options.sleep else ":"))
    return [sys.executable, "-m", "garmentfit", "catalogue", str(folder / "plan.csv"), "-o", str(folder / "out"),
            "--program", f"sh {folder}/program", "--no-pictures", "--quiet"]


def _used(processes: list) -> tuple:
    """Processor seconds and memory in MB, of the processes and those that they started, ended ones too."""
    seconds = memory = 0
    for process in processes:
        try:
            for each in [psutil.Process(process.pid), *psutil.Process(process.pid).children(recursive=True)]:
                times = each.cpu_times()
                seconds += times.user + times.system + times.children_user + times.children_system
                memory += each.memory_info().rss / 1e6
        except psutil.NoSuchProcess:
            pass
    return seconds, memory


if __name__ == "__main__":
    main(sys.argv[1:])
