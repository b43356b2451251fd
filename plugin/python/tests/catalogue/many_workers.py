# SPDX-License-Identifier: GPL-3.0-or-later
"""Many Dask workers in one process, each with a thread and a connection of its own: a large cluster, to its scheduler.

    python many_workers.py ADDRESS NUMBER FOLDER
"""
from __future__ import annotations

import asyncio
import resource
import sys

from distributed import Worker


async def _work(address: str, number: int, folder: str) -> None:
    workers = []
    for start in range(0, number, 50):  # all at once would time out
        some = [Worker(address, nthreads=1, memory_limit=0, dashboard=False, local_directory=folder)
                for _ in range(start, min(number, start + 50))]
        workers += await asyncio.gather(*some)
    await asyncio.gather(*(worker.finished() for worker in workers))


if __name__ == "__main__":
    resource.setrlimit(resource.RLIMIT_NOFILE, (resource.getrlimit(resource.RLIMIT_NOFILE)[1],) * 2)
    asyncio.run(_work(sys.argv[1], int(sys.argv[2]), sys.argv[3]))
