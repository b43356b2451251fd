# SPDX-License-Identifier: GPL-3.0-or-later
"""The jobs of a catalogue one by one, as a workflow engine calls them."""
import json
import subprocess

import pytest

for needed in ("distributed", "psutil", "pyarrow", "tqdm"):
    pytest.importorskip(needed)
from test_run import CATALOGUE, FAKE, Trial  # noqa: E402


def catalogue(trial, *words):
    return subprocess.run([*CATALOGUE, *words], env=trial.environment, capture_output=True, text=True, timeout=60)


def listed(trial):
    done = catalogue(trial, "list", str(trial.folder / "plan.toml"), "-o", str(trial.output), "--program", FAKE)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_single_jobs_fill_the_folders_that_a_run_fills(tmp_path):
    trial = Trial(tmp_path, 2, ["ok", "crash", "small"])
    jobs = listed(trial)
    assert len(jobs["pairs"]) == 6 and len(jobs["rigs"]) == 2
    for kind, keys in (("rig", jobs["rigs"]), ("dress", jobs["pairs"])):
        for key in keys:
            done = catalogue(trial, "job", str(trial.output), kind, key)
            assert done.returncode == 0, done.stderr
    done = catalogue(trial, "results", str(trial.output))
    assert done.returncode == 0 and "6 of 6" in done.stdout, done.stderr
    assert sorted(row["reason"] for row in trial.rows()) == ["crashed"] * 2 + ["done"] * 2 + ["too_small"] * 2
    before, finished = trial.counts.read_text(), trial.finished()
    assert finished.keys() == jobs["pairs"].keys() | jobs["rigs"].keys()
    again = trial.run()  # by Dask: nothing is left to do
    assert again.returncode == 0, again.stderr
    assert trial.counts.read_text() == before and trial.finished() == finished


def test_a_pair_waits_for_its_rig_and_unknown_jobs_are_refused(tmp_path):
    trial = Trial(tmp_path, 1, ["ok"])
    refused = catalogue(trial, "job", str(trial.output), "rig", "0")
    assert refused.returncode == 2 and "catalogue list" in refused.stderr
    pair, rig = next(iter(listed(trial)["pairs"].items()))
    refused = catalogue(trial, "job", str(trial.output), "dress", pair)
    assert refused.returncode == 2 and f"rig {rig}" in refused.stderr
    refused = catalogue(trial, "job", str(trial.output), "dress", "none")
    assert refused.returncode == 2 and "has no dress none" in refused.stderr
    assert catalogue(trial, "status", str(trial.output)).stdout.startswith("0 of 1")


def test_an_unreadable_file_has_its_row_before_any_job(tmp_path):
    trial = Trial(tmp_path, 1, ["ok", "ok"])
    (tmp_path / "garment1.ply").unlink()
    (tmp_path / "garment1.ply").symlink_to(tmp_path / "gone.ply")
    jobs = listed(trial)
    without_rig = [key for key, rig in jobs["pairs"].items() if not rig]
    assert len(without_rig) == len(jobs["pairs"]) - 1 == 1
    done = catalogue(trial, "job", str(trial.output), "dress", without_rig[0])
    assert done.returncode == 0 and "unreadable_file" in done.stdout, done.stderr
