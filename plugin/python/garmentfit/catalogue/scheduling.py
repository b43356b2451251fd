# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs jobs on Dask workers. Dask only schedules: what is finished is known from the folder alone."""
from __future__ import annotations

import itertools
import logging
import math
import queue
import time
from functools import partial

_PER_THREAD = 4  # guess: jobs that wait at the scheduler for each thread; more would only cost it memory
_LEAST_WAITING = 64  # guess: hides the round trips to the scheduler where jobs take no time
_REPEATS = 5  # guess: times that one job may come back because its worker died
_ASK_SECONDS = 5  # guess: workers come and go slowly
_PATIENCE_SECONDS = 60  # guess: time in which a scheduler or worker may come back


class SchedulerLost(RuntimeError):
    """The scheduler or all workers are gone; the folder resumes."""


def run_jobs(function, jobs, scheduler: str = "", workers: int = 1, arrived=None) -> int:
    """Calls function(*job) for each job on the workers and arrived() here after each; returns how many have ended.

    jobs is an iterable of tuples and is read as workers become free. What function returns is not asked for: it stands
    in the folder, and the connection to it may be lost. A job whose connection was lost is called a second time.
    Without a scheduler's address, local workers start, which do one job at a time each. Raises what function raises,
    and SchedulerLost."""
    import dask
    import distributed  # noqa: F401, which sets its defaults

    with dask.config.set({"distributed.comm.timeouts.connect": _PATIENCE_SECONDS}):  # 30 s is short on a busy machine
        return _run_jobs(function, jobs, scheduler, workers, arrived)


def _run_jobs(function, jobs, scheduler: str, workers: int, arrived) -> int:
    from distributed import Client, LocalCluster

    logging.getLogger("distributed.client").setLevel(logging.CRITICAL)  # a lost connection is handled, or raised here
    if scheduler:
        try:
            client = Client(scheduler, timeout=_PATIENCE_SECONDS, set_as_default=False)
        except (OSError, ValueError) as error:
            raise SchedulerLost(f"{scheduler}: no scheduler answers ({error}); check its address") from None
        with client:
            return _drain(client, function, iter(jobs), arrived, _Workers(client))
    with LocalCluster(n_workers=workers, threads_per_worker=1, processes=True,
                      dashboard_address="127.0.0.1:0", silence_logs=50) as cluster, \
            Client(cluster, set_as_default=False) as client:
        # A worker that was killed starts again, but Dask gives it up after 15 s; a busy machine may need longer.
        restart = partial(cluster.scale, workers)
        return _drain(client, function, iter(jobs), arrived, _Workers(client, workers, restart))


def _drain(client, function, jobs, arrived, workers) -> int:
    """Keeps a window of jobs at the scheduler, so that its memory does not grow with the plan."""
    ended, waiting, done = queue.Queue(), {}, 0

    def submit(job, repeats=0):
        future = client.submit(function, *job, pure=False)
        waiting[future.key] = future, job, repeats
        future.add_done_callback(ended.put)

    def fill():
        window = max(_LEAST_WAITING, _PER_THREAD * workers.threads())
        for job in itertools.islice(jobs, max(0, window - len(waiting))):
            submit(job)

    fill()
    while waiting:
        for future in _next_ended(client, workers, ended):
            if future.key not in waiting:
                continue  # told of twice, after a connection was lost
            _, job, repeats = waiting.pop(future.key)
            if future.status == "finished":
                done += 1
                if arrived:
                    arrived()
            else:
                submit(job, _count_repeat(future, repeats))
            future.release()
        fill()
    return done


class _Workers:
    """How many threads the workers have now. Where they are fewer than `least`, restart() is called."""

    def __init__(self, client, least: int = 0, restart=None):
        self._client, self._least, self._restart = client, least, restart
        self._threads, self._asked = 0, -math.inf

    def threads(self, patience: float = _ASK_SECONDS) -> int:
        """patience: age in seconds at which an answer is still good; of 1,000 workers it has more than a megabyte."""
        if time.monotonic() - self._asked > patience:
            known = self._client.scheduler_info(n_workers=-1)["workers"]
            self._threads, self._asked = sum(worker["nthreads"] for worker in known.values()), time.monotonic()
            if self._threads < self._least:
                self._restart()
        return self._threads


def _next_ended(client, workers, ended) -> list:
    """The futures that ended since the last call, at least one. Raises SchedulerLost where none can end any more."""
    last_seen = time.monotonic()
    while True:
        try:
            batch = [ended.get(timeout=1)]
            break
        except queue.Empty:
            if client.status == "running" and workers.threads(patience=1):
                last_seen = time.monotonic()
            elif client.status == "closed" or time.monotonic() - last_seen > _PATIENCE_SECONDS:
                raise SchedulerLost("no scheduler or no worker is left; start them and run again to go on") from None
    while not ended.empty():
        batch.append(ended.get())
    return batch


def _count_repeat(future, repeats: int) -> int:
    """How often a job has come back because its worker died, or lost its connection, which does not count. Raises the
    error of the job itself, and SchedulerLost where it came back too often."""
    from distributed import KilledWorker

    if future.status != "error":
        return repeats
    error = future.exception()
    if not isinstance(error, KilledWorker):
        raise error
    if repeats == _REPEATS:
        raise SchedulerLost("a job lost its worker again and again; look at the workers' logs, then run again")
    return repeats + 1
