# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a catalogue to its end while processes are killed at random moments (kill -9), with a fixed seed.

    python faults.py --seed 1 --kills 20 --seconds 10 40 -- garmentfit catalogue plan.toml -o DIR
    python faults.py --cluster 2 ...      with a scheduler and two workers started by the dask command

Victims are the client, a worker, a job and, in a cluster, the scheduler. Whatever was killed is started again. Each
process of the program is counted as it starts. Ends with an error where a process starts for something that is
finished, where a finished folder changes, where a run without a kill does not end with 0, or where the table does not
have one row for each pair of the plan.
"""
from __future__ import annotations

import argparse
import collections
import csv
import random
import shlex
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil


_COUNTER = """\
#!/bin/sh
# Notes when a job starts and its folder, the last argument, then becomes the program.
log=$1
shift
for folder; do :; done
time=$(date +%s%N) || exit 1  # killed
case $folder in */result) echo "$time $folder" >> "$log" ;; esac
exec "$@"
"""


class Starts:
    """Which processes of the program start, by a script that is called in its place."""

    def __init__(self, folder: Path, program: list):
        script, self._log = folder / "count_starts", folder / "starts"
        script.write_text(_COUNTER)
        self.program = shlex.join(["sh", str(script), str(self._log), *program])

    def read(self) -> list:
        """(name of the rig or pair, time in ns) of each start."""
        if not self._log.exists():
            return []
        starts = [line.split(" ", 1) for line in self._log.read_text().splitlines()]
        return [(Path(folder).parent.name.rsplit("-", 1)[0], int(time)) for time, folder in starts]


def _heed_interruptions():
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # a shell's background jobs, and what they start, begin without it


class Run:
    """A running catalogue command, its workers and jobs."""

    def __init__(self, command: list, output: Path, cluster=None, log=subprocess.DEVNULL, environment=None):
        self._work, self._cluster = str(output.resolve() / "work") + "/", cluster
        if cluster:
            command = [*command, "--scheduler", cluster.address]
        self.process = subprocess.Popen(command, stdout=log, stderr=log, env=environment,
                                        preexec_fn=_heed_interruptions)

    def candidates(self, victim: str) -> list:
        below = _below(self.process.pid)
        if self._cluster:
            below += [each for started in self._cluster.workers for each in [started, *_below(started.pid)]]
        if victim == "job":
            return [each for each in below if self._work in " ".join(_words(each))]
        if victim == "scheduler":
            return [self._cluster.scheduler]
        if victim == "client":
            return [self.process]
        if self._cluster:
            return self._cluster.workers
        direct = _below(self.process.pid, recursive=False)  # a job has its worker's words until it is the program
        return [each for each in direct if "spawn_main" in " ".join(_words(each))]

    def kill_one(self, victim: str, chance: random.Random) -> bool:
        some = self.candidates(victim)
        if not some:
            return False
        chosen = chance.choice(some)
        try:
            chosen.kill()
        except psutil.NoSuchProcess:
            return False
        chosen.wait(10)
        return True

    def stop(self) -> None:
        for each in [self.process, *_below(self.process.pid)]:
            try:
                each.kill()
            except psutil.NoSuchProcess:
                pass
        self.process.wait()


class Cluster:
    """A scheduler and workers, started by the dask command as on other machines."""

    def __init__(self, workers: int, folder, environment=None):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            self.address = f"tcp://127.0.0.1:{free.getsockname()[1]}"
        self._folder, self._environment = str(folder), environment
        self.scheduler, self.workers = None, [None] * workers
        self.mend()

    def mend(self) -> None:
        """Starts what does not run."""
        if not _runs(self.scheduler):
            self.scheduler = self._start("scheduler", "--host", "127.0.0.1", "--port", self.address.split(":")[-1])
        for index, worker in enumerate(self.workers):
            if not _runs(worker):
                self.workers[index] = self._start("worker", self.address, "--nthreads", "1",
                                                  "--local-directory", self._folder)

    def _start(self, kind: str, *words):
        return subprocess.Popen([sys.executable, "-m", f"distributed.cli.dask_{kind}", *words, "--no-dashboard"],
                                env=self._environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        for each in [*self.workers, self.scheduler]:
            for process in [each, *_below(each.pid)]:
                try:
                    process.kill()
                except psutil.NoSuchProcess:
                    pass
            each.wait()


def finished(output: Path) -> dict:
    """Time of the row of each finished rig and pair."""
    rows = [*output.glob("jobs/*/*/done.json"), *output.glob("rigs/*/done.json")]
    return {path.parent.name: path.stat().st_mtime_ns for path in rows}


def _below(pid: int, recursive: bool = True) -> list:
    try:
        return psutil.Process(pid).children(recursive)
    except psutil.NoSuchProcess:
        return []


def _words(process) -> list:
    try:
        return psutil.Process(process.pid).cmdline()
    except psutil.Error:
        return []


def _runs(process) -> bool:
    return process is not None and process.poll() is None


def main(words: list) -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--kills", type=int, default=20)
    parser.add_argument("--seconds", type=float, nargs=2, default=(10, 40), help="shortest, longest time between kills")
    parser.add_argument("--cluster", type=int, default=0, help="workers beside a scheduler; none: local workers")
    parser.add_argument("command", nargs="+", help="after --: garmentfit catalogue PLAN -o DIR ...")
    options = parser.parse_args(words)
    command = options.command
    output = Path(command[command.index("-o") + 1])
    with tempfile.TemporaryDirectory() as folder:
        given = command.index("--program") + 1 if "--program" in command else 0
        starts = Starts(Path(folder), shlex.split(command[given]) if given else [sys.executable, "-m", "garmentfit"])
        options.command = [*command, "--program", starts.program]  # the last one counts
        if not options.cluster:
            return _storm(options, output, starts, None)
        with Cluster(options.cluster, folder) as cluster:
            return _storm(options, output, starts, cluster)


def _storm(options, output: Path, starts: Starts, cluster) -> int:
    chance, seen, kills, begin = random.Random(options.seed), finished(output), collections.Counter(), time.monotonic()
    before = len(seen)
    while True:
        calm, run = sum(kills.values()) >= options.kills, Run(options.command, output, cluster, log=None)
        _kill_while_it_runs(run, chance, kills, options, output, cluster)
        now = finished(output)
        print(f"ended with {run.process.returncode}, {len(now)} finished", flush=True)
        if error := _wrong(seen, now, starts):
            print(error)
            return 1
        if run.process.returncode == 0:
            break
        if calm:
            print("a run without kills did not end with 0")
            return 1
        seen = now
    killed = ", ".join(f"{count} {victim}" for victim, count in sorted(kills.items()))
    print(f"{len(starts.read())} processes for {len(now) - before} rigs and pairs, none for a finished one; kill -9: "
          f"{killed}; {time.monotonic() - begin:.0f} s")
    return _check_rows(output)


def _kill_while_it_runs(run: Run, chance: random.Random, kills, options, output: Path, cluster) -> None:
    victims = ["client", "worker", "job"] + (["scheduler"] if cluster else [])
    next_kill = time.monotonic() + chance.uniform(*options.seconds)
    while run.process.poll() is None:
        try:
            run.process.wait(1)
        except subprocess.TimeoutExpired:
            pass
        if time.monotonic() > next_kill and sum(kills.values()) < options.kills:
            victim = min(chance.sample(victims, len(victims)), key=lambda name: kills[name])  # each as often as others
            if run.kill_one(victim, chance):
                kills[victim] += 1
                print(f"killed {victim}, {len(finished(output))} finished", flush=True)
            next_kill = time.monotonic() + chance.uniform(*options.seconds)
        if cluster:
            cluster.mend()  # workers end some time after their scheduler


def _wrong(seen: dict, now: dict, starts: Starts) -> str:
    """What was done a second time, or ""."""
    changed = [key for key in seen if now.get(key) != seen[key]]
    if changed:
        return f"finished and changed afterwards: {', '.join(changed)}"
    again = [key for key, start in starts.read() if start > now.get(key, start)]
    return f"finished and started again: {', '.join(again)}" if again else ""


def _check_rows(output: Path) -> int:
    with open(output / "results.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    planned = len((output / "plan.jsonl").read_text().splitlines())
    whole = len({row["pair"] for row in rows}) == len(rows) == planned and all(row["exit"] for row in rows)
    ends = collections.Counter(row["reason"] for row in rows)
    print(f"{len(rows)} rows for {planned} pairs: {', '.join(f'{count} {reason}' for reason, count in ends.items())}")
    return 0 if whole else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
