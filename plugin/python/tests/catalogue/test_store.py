# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder of a catalogue where a run was killed and its jobs go on."""
import os
import shutil
import sys
import threading
import time
from pathlib import Path

import pytest

for needed in ("distributed", "psutil"):
    pytest.importorskip(needed)
import psutil  # noqa: E402
from garmentfit.catalogue import store as store_module  # noqa: E402
from garmentfit.catalogue.job import Fatal, run_job  # noqa: E402
from garmentfit.catalogue.plan import Limits, Pair  # noqa: E402
from garmentfit.catalogue.store import Store  # noqa: E402

FAKE = [sys.executable, str(Path(__file__).parent / "fake_program.py")]


@pytest.fixture
def store(tmp_path):
    made = Store(tmp_path / "out")
    made.create()
    return made


def start_job(store, key):
    work = store.start(key)
    (work / "result").mkdir()
    (work / "result" / "report.json").write_text("{}")
    return work


def test_a_job_that_ends_while_the_next_run_clears_its_folder_is_not_finished(store, monkeypatch):
    work, remove, ends = start_job(store, "aa11"), shutil.rmtree, []

    def remove_slowly(folder, **options):
        for file in Path(folder).rglob("report.json"):
            file.unlink()
        monkeypatch.setattr(store_module.shutil, "rmtree", remove)
        try:
            store.finish("dress", "aa11", work, {"reason": "done"})
        except FileNotFoundError as error:
            ends.append(error)
        remove(folder, **options)

    monkeypatch.setattr(store_module.shutil, "rmtree", remove_slowly)
    store.clear_work()
    assert store.finished("dress", "aa11") is None and len(ends) == 1
    assert not any((store.folder / "work").iterdir())


def test_a_process_whose_folder_was_cleared_is_stopped(store, tmp_path, monkeypatch):
    monkeypatch.setenv("FAKE_SECONDS", "30")
    for name in ("body.ply", "coat.ply"):
        (tmp_path / name).write_text("ok")
    pair, ends = Pair(str(tmp_path / "body.ply"), "coat", (str(tmp_path / "coat.ply"),)), []

    def work():
        try:
            ends.append(run_job(str(store.folder), "dress", "aa11", pair, "bb22", FAKE, Limits(), False))
        except (Fatal, OSError) as error:
            ends.append(error)
    orphan = threading.Thread(target=work)
    orphan.start()
    wait_for(lambda: jobs_in(store.folder))
    store.clear_work()
    orphan.join(10)
    assert not orphan.is_alive() and not jobs_in(store.folder)
    assert isinstance(ends[0], Fatal) and store.finished("dress", "aa11") is None


def test_what_a_killed_clearing_left_is_removed_by_the_next(store):
    work = start_job(store, "aa11")
    work.rename(work.with_name("cleared-" + work.name))
    start_job(store, "aa11")
    store.clear_work()
    assert not any((store.folder / "work").iterdir())


def test_a_folder_without_its_row_is_replaced(store):
    (store.pair_folder("aa11") / "result").mkdir(parents=True)
    store.finish("dress", "aa11", start_job(store, "aa11"), {"reason": "done"})
    assert store.finished("dress", "aa11") == {"reason": "done"}
    assert (store.pair_folder("aa11") / "result" / "report.json").exists()


def test_all_files_of_a_pair_are_on_the_disk_before_it_is_finished(store, monkeypatch):
    synced, sync, rename, work = set(), os.fsync, os.rename, start_job(store, "aa11")
    (work / "log.txt").write_text("log")

    def rename_if_safe(old, new):
        inside = [old, *Path(old).rglob("*")]
        assert {path.name for path in inside if path.stat().st_ino not in synced} == set()
        rename(old, new)

    monkeypatch.setattr(store_module.os, "fsync", lambda file: (synced.add(os.fstat(file).st_ino), sync(file)))
    monkeypatch.setattr(store_module.os, "rename", rename_if_safe)
    store.finish("dress", "aa11", work, {"reason": "done"})
    assert (store.pair_folder("aa11") / "result" / "report.json").exists() and len(synced) == 5


def jobs_in(folder):
    return [each for each in psutil.Process().children() if str(folder) in " ".join(command_of(each))]


def command_of(process):
    try:
        return process.cmdline()
    except psutil.Error:
        return []


def wait_for(condition, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.05)
