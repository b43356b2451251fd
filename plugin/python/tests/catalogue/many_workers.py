# SPDX-License-Identifier: GPL-3.0-or-later
"""Many Dask workers in one process, each with a thread and a connection of its own: a large cluster, to its scheduler.

    python many_workers.py ADDRESS NUMBER FOLDER

What a worker does for its process as a whole is left out, as each of them would do it for all: twice a second a worker
lists the files that its process holds open, fifty times a second it looks at the clock, and each line of the log
passes through a handler of each worker. Heartbeats are sent as by any worker. Prints how many have started.
"""
from __future__ import annotations

import asyncio
import logging
import resource
import sys

import dask
from distributed import Worker

_AT_ONCE = 50  # all at once would time out
_ONCE_ONLY = {"distributed.admin.system-monitor.interval": "1d", "distributed.admin.tick.interval": "1d",
              "distributed.admin.tick.cycle": "1d", "distributed.worker.profile.enabled": False}


async def _work(address: str, number: int, folder: str) -> None:
    workers = []
    for start in range(0, number, _AT_ONCE):
        some = [Worker(address, nthreads=1, memory_limit=0, dashboard=False, local_directory=folder)
                for _ in range(start, min(number, start + _AT_ONCE))]
        workers += await asyncio.gather(*some)
        print(f"{len(workers)} of {number} workers started", flush=True)
    await asyncio.gather(*(worker.finished() for worker in workers))


if __name__ == "__main__":
    resource.setrlimit(resource.RLIMIT_NOFILE, (resource.getrlimit(resource.RLIMIT_NOFILE)[1],) * 2)
    logging.disable(logging.CRITICAL)
    with dask.config.set(_ONCE_ONLY):
        asyncio.run(_work(sys.argv[1], int(sys.argv[2]), sys.argv[3]))
