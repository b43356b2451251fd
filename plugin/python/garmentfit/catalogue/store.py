# SPDX-License-Identifier: GPL-3.0-or-later
"""The folder of a catalogue. All state is here; nothing that a process keeps in memory is needed to go on.

    DIR/lock               held by the run at work (flock)
    DIR/plan.jsonl         one line for each pair
    DIR/rigs/KEY/          a rig of the program, made once for each body
    DIR/jobs/KE/KEY/       a finished pair: done.json, log.txt, result/, thumbnail.png, view.js
    DIR/attempts/KEY       one byte for each process that something from outside killed
    DIR/work/KEY-RANDOM/   a job at work

A job writes into its folder in work/, which is renamed when all is written. So a folder in jobs/ or rigs/ is complete,
and what is in work/ is never read. Files are on the disk before the rename: after a power cut, too, a pair is there
with all of them, or is done again. Whoever removes a folder renames it first. So of a job that ends and a run that
clears its folder one wins: the folder is finished as a whole, or not at all.
"""
from __future__ import annotations

import errno
import fcntl
import json
import os
import shutil
import uuid
from pathlib import Path


_CLEARED = "cleared-"


class StoreError(RuntimeError):
    """The folder cannot be used; one line says why."""


class DiskError(RuntimeError):
    """The disk takes no more; one line says so. With some space, the same folder goes on."""


def write_error(folder, error: OSError) -> RuntimeError:
    """What to raise for an error of writing into the folder: a full disk is no mistake of the caller."""
    if error.errno in (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO):
        return DiskError(f"{folder}: cannot be written ({error.strerror}); free some space, then run again")
    return StoreError(f"{folder}: cannot be written ({error.strerror}); give another folder")


class Store:
    def __init__(self, folder):
        self.folder = Path(folder).resolve()

    def create(self) -> None:
        try:
            for name in ("jobs", "rigs", "work", "attempts"):
                (self.folder / name).mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise write_error(self.folder, error) from None

    def lock(self):
        """Holds the folder until the returned file is closed or the process ends. Raises StoreError, DiskError."""
        try:
            file = open(self.folder / "lock", "a+")
        except OSError as error:
            raise write_error(self.folder, error) from None
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            file.close()
            raise StoreError(f"{self.folder}: another run works in this folder; wait for its end, or give another "
                             "folder") from None
        return file

    def clear_work(self) -> None:
        """Removes what runs left that were killed. Only for the holder of the lock, before workers start.

        Workers of such a run may still be at work, for example on other machines. Their jobs find their folders gone
        and end."""
        for left in list((self.folder / "work").iterdir()):
            self._remove(left)

    def _remove(self, folder: Path) -> None:
        """Removes a folder that its owner may still write to, or rename."""
        gone = self.folder / "work" / f"{_CLEARED}{uuid.uuid4().hex}"
        try:
            os.rename(folder, gone)
        except FileNotFoundError:
            return  # its job was quicker, and it is finished
        shutil.rmtree(gone, ignore_errors=True)

    def pair_folder(self, key: str) -> Path:
        return self.folder / "jobs" / key[:2] / key

    def rig_folder(self, key: str) -> Path:
        return self.folder / "rigs" / key

    def target(self, kind: str, key: str) -> Path:
        return self.rig_folder(key) if kind == "rig" else self.pair_folder(key)

    def finished(self, kind: str, key: str):
        """The row of a finished rig or pair, or None."""
        try:
            return json.loads((self.target(kind, key) / "done.json").read_text())
        except FileNotFoundError:
            return None

    def start(self, key: str) -> Path:
        folder = self.folder / "work" / f"{key}-{uuid.uuid4().hex[:8]}"
        folder.mkdir()
        return folder

    def finish(self, kind: str, key: str, work: Path, row: dict) -> None:
        """Writes the row, waits until all is on the disk, and renames the folder. Of two jobs with one key the first
        stays.

        Raises FileNotFoundError where another run cleared the folder meanwhile."""
        write_whole(work / "done.json", json.dumps(row))
        _sync(work)
        target = self.target(kind, key)
        target.parent.mkdir(exist_ok=True)
        try:
            os.rename(work, target)
        except OSError as error:
            if error.errno not in (errno.ENOTEMPTY, errno.EEXIST):
                raise
            if (target / "done.json").exists():
                shutil.rmtree(work, ignore_errors=True)
            else:  # no job leaves a folder without its row; somebody removed the row
                self._remove(target)
                os.rename(work, target)

    def count_attempt(self, key: str) -> int:
        """Notes one more process that was killed from outside, and returns how many there were."""
        with open(self.folder / "attempts" / key, "ab") as file:
            file.write(b".")
            file.flush()
            return file.tell()

    def forget(self, kind: str, key: str) -> None:
        """Removes a finished pair or rig, so that it is done again."""
        self._remove(self.target(kind, key))
        (self.folder / "attempts" / key).unlink(missing_ok=True)

    def write_plan(self, pairs: dict) -> None:
        """pairs: key -> dict as JSON."""
        lines = (json.dumps({"key": key, **pair}) + "\n" for key, pair in pairs.items())
        write_whole(self.folder / "plan.jsonl", "".join(lines))

    def read_plan(self) -> dict:
        try:
            lines = (self.folder / "plan.jsonl").read_text().splitlines()
        except FileNotFoundError:
            raise StoreError(f"{self.folder}: no catalogue; start with garmentfit catalogue PLAN -o DIR") from None
        return {pair.pop("key"): pair for pair in map(json.loads, lines)}


def _sync(folder: Path) -> None:
    """Returns when all files below a folder are on the disk: a rename must not get there before them."""
    for path, _, names in os.walk(folder):
        for name in [".", *names]:
            file = os.open(os.path.join(path, name), os.O_RDONLY)
            try:
                os.fsync(file)
            finally:
                os.close(file)


def write_whole(path: Path, text) -> None:
    """Writes a file that appears with all of its content, on the disk, or not at all."""
    temporary = path.with_name(f".{path.name}.{uuid.uuid4().hex[:8]}")
    try:
        with open(temporary, "wb") as file:
            file.write(text.encode() if isinstance(text, str) else text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)
