# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples run and draw something."""
import subprocess
import sys

import pytest
from conftest import BODY, ROOT, SAMPLES, SKIRT

pyvista = pytest.importorskip("pyvista")
EXAMPLES = ROOT / "plugin" / "python" / "examples"
OTHERS = [BODY.with_name(f"{name}.ply")
          for name in ("woman_t_pose", "man_a_pose", "tall_man_fighting", "heavy_man_arms_down")]


def colours_in(picture):
    return len({tuple(colour) for colour in pyvista.read(picture).active_scalars[::7]})


@pytest.mark.parametrize("example, words", [
    ("pipeline.py", [BODY, SKIRT, "skirt"]),
    ("ease_in_pyvista.py", [BODY, SKIRT, "skirt"]),
    ("five_bodies.py", [SKIRT, "skirt", SAMPLES / "walking_woman.ply", *OTHERS]),
])
def test_an_example_draws_its_picture(example, words, tmp_path):
    picture = tmp_path / "picture.png"
    done = subprocess.run([sys.executable, EXAMPLES / example, picture, *words], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert colours_in(picture) > 200
