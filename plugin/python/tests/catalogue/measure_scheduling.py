# SPDX-License-Identifier: GPL-3.0-or-later
"""What scheduling costs: jobs that do nothing, or sleep, on local workers. Not a test.

    python measure_scheduling.py --jobs 1000 [--sleep 0.25] [--workers 2]

Prints processor time of this process, in which client and scheduler run, its memory, and the wall clock beside that of
workers which are never idle.
"""
import argparse
import os
import resource
import sys
import time

from garmentfit.catalogue.scheduling import run_jobs


def main(words: list) -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jobs", type=int, default=1000)
    parser.add_argument("--sleep", type=float, default=0, help="length of a job in seconds")
    parser.add_argument("--workers", type=int, default=os.cpu_count())
    options = parser.parse_args(words)
    processor, start = time.process_time(), time.monotonic()
    jobs = ((options.sleep,) for _ in range(options.jobs))
    first = []
    run_jobs(time.sleep, jobs, workers=options.workers, arrived=lambda: first or first.append(time.monotonic()))
    wall, since_first = time.monotonic() - start, time.monotonic() - first[0]
    processor = time.process_time() - processor
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1000
    print(f"{options.jobs} jobs of {options.sleep:g} s on {options.workers} workers: {wall:.1f} s, after the first job "
          f"{since_first:.1f} s; busy workers: {options.jobs * options.sleep / options.workers:.1f} s; client and "
          f"scheduler: {processor:.2f} s, {1000 * processor / options.jobs:.2f} ms for each job, {memory:.0f} MB")


if __name__ == "__main__":
    main(sys.argv[1:])
