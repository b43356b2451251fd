# SPDX-License-Identifier: GPL-3.0-or-later
"""python -m garmentfit is the command line's program."""
import json
import signal
import subprocess
import sys

import numpy as np
import pytest
from conftest import BODY, QUICK, SKIRT

import garmentfit

PROGRAM = [sys.executable, "-m", "garmentfit"]
SETTLE = ["--settling-steps", "2"]


def run(*words):
    return subprocess.run([*PROGRAM, *map(str, words)], capture_output=True, text=True)


def test_dresses_to_the_same_numbers_as_the_functions(body, skirt, tmp_path):
    done = run("dress", BODY, SKIRT, "--type", "skirt", *SETTLE, "--recovery-settling-steps", "2",
               "--quality", "draft", "-o", tmp_path / "out")
    assert done.returncode == 0, done.stderr
    assert "written to" in done.stdout or "certified" in done.stdout, done.stdout
    result = garmentfit.dress(body, skirt, **QUICK)
    written = garmentfit.read_mesh(tmp_path / "out" / "skirt.ply").positions
    assert np.array_equal(written, result.garments[0].positions.astype(np.float32))
    assert json.loads((tmp_path / "out" / "report.json").read_text())["certified"]


def test_tells_each_failure_of_several_runs_in_one_process():
    once = "_core.run_program(['garmentfit', 'rig', 'no.ply', '-o', 'o'])"
    twice = f"from garmentfit import _core; {once}; {once}"
    done = subprocess.run([sys.executable, "-c", twice], capture_output=True, text=True)
    assert len(done.stderr.splitlines()) == 2, done.stderr


def test_has_every_step_and_their_files(tmp_path):
    for words in (["rig", BODY], ["fit", BODY, SKIRT, "--type", "skirt", "--rig", tmp_path / "rig" / "rig.json"],
                  ["drape", tmp_path / "fit", *SETTLE],
                  ["recover", tmp_path / "drape", "--recovery-settling-steps", "2", "--quality", "draft"]):
        done = run(*words, "-o", tmp_path / words[0])
        assert done.returncode == 0, done.stderr
    assert (tmp_path / "recover" / "skirt.ply").exists()


def test_says_what_is_wrong_in_one_line_with_code_2(tmp_path):
    bad = run("dress", "nobody.ply", SKIRT, "-o", tmp_path / "none")
    assert bad.returncode == 2 and "nobody.ply" in bad.stderr and bad.stderr.count("\n") == 1
    assert not (tmp_path / "none").exists()


def test_ctrl_c_leaves_nothing_behind(tmp_path):
    words = ["dress", str(BODY), str(SKIRT), "--settling-steps", "10000", "-o", str(tmp_path / "out")]
    process = subprocess.Popen([*PROGRAM, *words], stderr=subprocess.PIPE)
    with pytest.raises(subprocess.TimeoutExpired):  # still at work
        process.wait(1.5)
    process.send_signal(signal.SIGINT)
    assert process.wait() in (130, -signal.SIGINT)  # the latter while Python was still starting
    assert not (tmp_path / "out").exists()
