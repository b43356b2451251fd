# SPDX-License-Identifier: GPL-3.0-or-later
"""Fixtures of several tests. The tests lie beside the sources and use the installed package."""
from pathlib import Path

import pytest

import garmentfit

ROOT = Path(__file__).parents[3]
SAMPLES = ROOT / "docs" / "samples"
BODY = ROOT / "tests" / "bodies" / "woman_t_pose.ply"
SKIRT = SAMPLES / "skirt.ply"
QUICK = dict(type="skirt", settling_steps=2, recovery_settling_steps=2, quality="draft")


@pytest.fixture(scope="session")
def body():
    return garmentfit.read_mesh(BODY)


@pytest.fixture(scope="session")
def skirt():
    return garmentfit.read_mesh(SKIRT)
