# SPDX-License-Identifier: GPL-3.0-or-later
"""Every parameter of the schema is a keyword argument with a name, a type and a default, also for type checkers."""
import inspect
import subprocess
import sys

import pytest

import garmentfit
from garmentfit import _core

FUNCTIONS = {"rig": garmentfit.rig_body, "fit": garmentfit.fit_skeleton, "drape": garmentfit.drape_garment,
             "recover": garmentfit.recover_pose, "dress": garmentfit.dress}

RIGHT = """
import garmentfit
from garmentfit.vtk import DressBody
body, skirt = garmentfit.read_mesh("body.ply"), garmentfit.read_mesh("skirt.ply")
dressed: garmentfit.Dressing = garmentfit.dress(body, skirt, type="skirt", contact_distance=0.003, frames=3, unit="m")
gap: float = dressed.garments[0].certificate.min_distance
dress = DressBody(type="skirt", front="+z")
dress.density = 0.3
"""
WRONG = {
    'garmentfit.dress(body, skirt, colour="red")': 'Unexpected keyword argument "colour"',
    'garmentfit.dress(body, skirt, frames="many")': 'Argument "frames"',
    'garmentfit.dress(body, skirt, fabric="paper")': 'Argument "fabric"',
    'DressBody(colour="red")': 'Unexpected keyword argument "colour"',
    'dress.density = "heavy"': "Incompatible types in assignment",
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_signature_shows_every_parameter_with_its_default(name):
    shown = inspect.signature(FUNCTIONS[name]).parameters
    for parameter, default, type_, *_ in _core.parameters_of(name):
        assert (shown[parameter].default, shown[parameter].annotation) == (default, type_)
    assert not any(given.kind == inspect.Parameter.VAR_KEYWORD for given in shown.values())


def errors_of_mypy(text, folder):
    pytest.importorskip("mypy")
    program = folder / "program.py"
    program.write_text(text, encoding="utf-8")
    mypy = [sys.executable, "-m", "mypy", "--follow-imports=silent", "--cache-dir", folder / "cache", program]
    done = subprocess.run(mypy, capture_output=True, text=True, cwd=folder)
    return done.stdout + done.stderr


def test_a_type_checker_knows_what_is_right_and_what_is_wrong(tmp_path):
    assert "Success" in errors_of_mypy(RIGHT, tmp_path)
    found = errors_of_mypy(RIGHT + "\n".join(WRONG), tmp_path)
    for words in WRONG.values():
        assert words in found, found
