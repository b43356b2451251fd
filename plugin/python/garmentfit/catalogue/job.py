# SPDX-License-Identifier: GPL-3.0-or-later
"""One job: one process of the program, in a folder of its own, within limits of time and memory."""
from __future__ import annotations

import ctypes
import json
import os
import resource
import shutil
import signal
import subprocess
import time
from pathlib import Path

import psutil

from .plan import Limits, Pair, flags
from .store import Store

_ATTEMPTS = 3  # guess: a job that was killed from outside so often is the cause itself
_POLL_SECONDS = 0.1
_LEAST_FREE_BYTES = 50_000_000  # guess: some times the files of one pair
_PR_SET_PDEATHSIG = 1
_LIBC = ctypes.CDLL(None, use_errno=True)


class Fatal(RuntimeError):
    """No further job can succeed, for example on a full disk; one line says why."""


def run_job(folder: str, kind: str, key: str, pair: Pair, rig_key: str, program: list, limits: Limits,
            draw: bool = True) -> dict:
    """Makes a rig or dresses a pair, unless it is finished already; returns its row.

    A failure of the job is a row. Raises Fatal where no job can succeed, and OSError otherwise. A worker runs this."""
    store = Store(folder)
    row = store.finished(kind, key)
    if row is not None:
        return row
    if shutil.disk_usage(folder).free < _LEAST_FREE_BYTES:
        raise Fatal(f"{folder}: the disk is full; free some space and run again")
    rig = store.finished("rig", rig_key) if kind == "dress" else None
    while True:
        work = store.start(key)
        if rig and rig["reason"] != "done":  # dressing would fail in the same way, and take longer for it
            (work / "log.txt").write_text(f"the body has no rig, see {store.rig_folder(rig_key)}/log.txt\n")
            row = dict(exit=rig["exit"], reason=rig["reason"], message=rig["message"], seconds=0.0, memory_mb=0.0)
            break
        row = _run_process(work, _call(store, kind, pair, rig_key, program, limits), limits)
        if row["reason"] != "killed" or store.count_attempt(key) >= _ATTEMPTS:
            break
        shutil.rmtree(work, ignore_errors=True)
    if row["reason"] == "unwritable_file" or shutil.disk_usage(folder).free < _LEAST_FREE_BYTES:
        shutil.rmtree(work, ignore_errors=True)
        raise Fatal(f"{folder}: cannot be written: {row['message'] or 'the disk is full'}")
    row.update(_inputs(kind, key, pair))
    if kind == "dress":
        row.update(_figures(work / "result" / "report.json"))
        if draw:
            _draw(work, row)
    store.finish(kind, key, work, row)
    return row


def finish_unreadable(store: Store, key: str, pair: Pair, error: OSError) -> None:
    """Writes the row of a pair that no process can dress, because this run cannot read one of its files."""
    if store.finished("dress", key) is not None:
        return
    message = f"{error.filename}: {error.strerror}; the command reads all files itself, to name pairs by their content"
    work = store.start(key)
    (work / "log.txt").write_text(message + "\n")
    row = dict(exit=2, reason="unreadable_file", message=message, seconds=0.0, memory_mb=0.0)
    store.finish("dress", key, work, {**row, **_inputs("dress", key, pair)})


def _inputs(kind: str, key: str, pair: Pair) -> dict:
    row = dict(kind=kind, key=key, body=pair.body, garment=pair.garment, size=pair.size)
    if kind == "dress":
        row.update(layers=list(pair.layers), parameters=dict(pair.body_parameters + pair.parameters))
    return row


def _call(store: Store, kind: str, pair: Pair, rig_key: str, program: list, limits: Limits) -> list:
    threads = ["--threads", str(limits.threads)]
    if kind == "rig":
        return [*program, "rig", pair.body, *threads, *flags(pair.body_parameters)]
    rig = store.rig_folder(rig_key) / "result" / "rig.json"
    return [*program, "dress", pair.body, *pair.layers, "--rig", str(rig), *threads, *pair.flags()]


def _run_process(work: Path, call: list, limits: Limits) -> dict:
    call = [*call, "--json", "-o", str(work / "result")]
    start = time.monotonic()
    with open(work / "log.txt", "wb") as log, open(work / "output.json", "wb") as output:
        log.write((" ".join(call) + "\n").encode())
        log.flush()
        process = subprocess.Popen(call, stdout=output, stderr=log, stdin=subprocess.DEVNULL, cwd=work,
                                   start_new_session=True, preexec_fn=_die_with_parent)
        stopped, peak = _watch(process, limits, start, work)
    row = {"exit": process.returncode, "seconds": round(time.monotonic() - start, 3), "memory_mb": round(peak / 1e6, 1)}
    row.update(_reason(process.returncode, stopped, limits, work))
    (work / "output.json").unlink()
    return row


def _die_with_parent() -> None:
    # A job must not outlive a worker that was killed: nobody would take its result.
    _LIBC.prctl(_PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)


def _watch(process, limits: Limits, start: float, work: Path) -> tuple:
    """Waits for the end within the limits; returns the limit that ended it, or "", and the peak memory in bytes.

    Raises Fatal where the next run cleared the folder: this job's run was killed, and nobody waits for its result."""
    stopped, peak, watched = "", 0, psutil.Process(process.pid)
    try:
        while process.poll() is None:
            peak = max(peak, _memory(watched))
            if not work.is_dir():
                raise Fatal(f"{work}: was cleared by another run in this folder; this one ends")
            if peak > limits.memory_mb * 1e6:
                stopped = "memory_limit"
            elif time.monotonic() - start > limits.seconds:
                stopped = "time_limit"
            if stopped:
                break
            try:
                process.wait(_POLL_SECONDS)
            except subprocess.TimeoutExpired:
                pass
    finally:
        try:
            os.killpg(process.pid, signal.SIGKILL)  # children of the process, too
        except ProcessLookupError:
            pass
        process.wait()
    return stopped, peak


def _memory(watched) -> int:
    try:
        return sum(each.memory_info().rss for each in [watched, *watched.children(recursive=True)])
    except psutil.Error:
        return 0  # it ended meanwhile


def _reason(code: int, stopped: str, limits: Limits, work: Path) -> dict:
    """One word for the way in which a job ended, and the program's own line."""
    if stopped == "time_limit":
        return {"reason": stopped, "message": f"stopped after {limits.seconds:g} s"}
    if stopped == "memory_limit":
        return {"reason": stopped, "message": f"stopped above {limits.memory_mb:g} MB"}
    if code == -signal.SIGXFSZ:
        limit = resource.getrlimit(resource.RLIMIT_FSIZE)[0] / 1e6
        return {"reason": "file_limit", "message": f"a file became larger than {limit:g} MB, the worker's limit for "
                                                   "files (ulimit -f)"}
    if code in (-signal.SIGKILL, -signal.SIGTERM, -signal.SIGINT, 130):
        return {"reason": "killed", "message": "killed from outside, perhaps for want of memory"}
    if code == 0:
        return {"reason": "done", "message": ""}
    try:
        error = json.loads((work / "output.json").read_text())["error"]
        return {"reason": error["code"], "message": error["message"]}
    except (ValueError, KeyError, TypeError):
        pass
    if code == 3:
        return {"reason": "too_small", "message": ""}
    if code == 4:
        return {"reason": "not_certified", "message": ""}
    return {"reason": "crashed", "message": f"ended with code {code}; see log.txt"}


def _figures(report: Path) -> dict:
    """What the table shows of report.json. Figures are those of the outermost layer; an outfit of several layers has
    those of each, too, as layer1_ and so on from the inside out."""
    try:
        table = json.loads(report.read_text())
    except (OSError, ValueError):
        return {}
    garments = table.get("garments") or [{}]
    scale = (table.get("body") or {}).get("metres_per_unit") or 1
    figures = {
        "certified": table.get("certified"),
        "type": "+".join(str(garment.get("type")) for garment in garments),
        "type_probability": min((garment.get("type_probability") or 0) for garment in garments),
        "program_memory_mb": round((table.get("peak_memory_bytes") or 0) / 1e6, 1),
        "warnings": table.get("warnings", []),
    }
    if len(garments) > 1:
        for number, garment in enumerate(garments, 1):
            figures.update((f"layer{number}_{name}", value) for name, value in _of_garment(garment, scale).items())
    return {**figures, **_of_garment(garments[-1], scale)}


def _of_garment(garment: dict, scale: float) -> dict:
    """Verdict, strain and ease of one garment. scale: metres per unit of the body's file."""
    figures = {
        "verdict": (garment.get("verdict") or {}).get("fit"),
        "strain_median": (garment.get("strain") or {}).get("median"),
        "strain_max": (garment.get("strain") or {}).get("max"),
    }
    for girth in garment.get("girths") or []:
        if girth.get("ease") is not None:
            figures["ease_" + girth["place"].replace(" ", "_")] = girth["ease"] * scale  # metres
    return figures


def _draw(work: Path, row: dict) -> None:
    from . import drawing
    try:
        drawing.draw_pair(work, row)
    except (ValueError, KeyError, IndexError) as error:  # a picture less is no reason to lose a result
        row.update(view=False, picture=False)
        row["message"] = (row["message"] + f" no picture: {error}").strip()
