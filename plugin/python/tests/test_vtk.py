# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python filters in pipelines of pip's VTK, of Debian's, and in PyVista."""
import os
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("vtkmodules")
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkPolyData  # noqa: E402
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as pipeline  # noqa: E402
from vtkmodules.vtkIOPLY import vtkPLYReader  # noqa: E402

import garmentfit  # noqa: E402
from garmentfit import _core  # noqa: E402
from garmentfit.vtk import DrapeGarment, DressBody, FitSkeleton, RecoverPose, RigBody  # noqa: E402

SAMPLES = Path(os.environ.get("GARMENTFIT_SAMPLES", Path(__file__).parents[3] / "docs" / "samples"))
QUICK = dict(type="skirt", settling_steps=2, recovery_settling_steps=2)


def reader(name):
    ply = vtkPLYReader()
    ply.SetFileName(str(SAMPLES / name))
    return ply


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def stages_of(filter_):
    seen = set()
    filter_.AddObserver("ProgressEvent", lambda o, e: seen.add(o.GetProgressText()) if 0 < o.GetProgress() < 1 else None)
    return seen


@pytest.fixture(scope="module")
def sources():
    return reader("walking_woman.ply"), reader("skirt.ply")


@pytest.fixture(scope="module")
def dress(sources):
    filter_ = DressBody(frames=3, **QUICK)
    filter_.SetInputConnection(0, sources[0].GetOutputPort())
    filter_.SetInputConnection(1, sources[1].GetOutputPort())
    filter_.Update()
    return filter_


def test_the_same_numbers_as_the_functions(dress):
    result = garmentfit.dress(garmentfit.read_mesh(SAMPLES / "walking_woman.ply"),
                              garmentfit.read_mesh(SAMPLES / "skirt.ply"), **QUICK)
    dress.UpdateTimeStep(1)
    assert np.array_equal(points(dress.GetOutput(1)), result.garments[0].positions)
    ease = vtk_to_numpy(dress.GetOutput(1).GetPointData().GetArray("Ease"))
    assert np.array_equal(ease, result.garments[0].ease)


def test_a_chain_gives_the_same_and_does_not_rig_again(dress, sources):
    rig, fit, drape, recover = RigBody(), FitSkeleton(type="skirt"), DrapeGarment(settling_steps=2), RecoverPose()
    recover.recovery_settling_steps = 2
    rig.SetInputConnection(sources[0].GetOutputPort())
    fit.SetInputConnection(0, rig.GetOutputPort())
    fit.SetInputConnection(1, sources[1].GetOutputPort())
    for above, below in ((fit, drape), (drape, recover)):
        below.SetInputConnection(0, above.GetOutputPort(0))
        below.SetInputConnection(1, above.GetOutputPort(1))
    recover.Update()
    dress.UpdateTimeStep(1)
    assert np.array_equal(points(recover.GetOutput(1)), points(dress.GetOutput(1)))
    rigged = stages_of(rig)
    fit.iterations = 7
    fit.Update()
    assert not rigged


def test_nothing_that_stays_is_copied(dress, sources):
    dress.UpdateTimeStep(1)
    assert dress.GetOutput(0).GetPoints() is sources[0].GetOutput().GetPoints()
    assert dress.GetOutput(1).GetPolys() is sources[1].GetOutput().GetPolys()
    assert sources[1].GetOutput().GetPointData().GetNumberOfArrays() == 0
    assert sources[1].GetOutput().GetFieldData().GetNumberOfArrays() == 0


def test_time_steps_are_computed_once(dress):
    dress.UpdateInformation()
    assert dress.GetOutputInformation(1).Length(pipeline.TIME_STEPS()) == 3
    dress.UpdateTimeStep(0)
    at_start = points(dress.GetOutput(1)).copy()
    seen = stages_of(dress)
    dress.UpdateTimeStep(1)
    assert not seen and not np.array_equal(points(dress.GetOutput(1)), at_start)


def test_a_changed_parameter_repeats_only_what_it_concerns(dress):
    seen = stages_of(dress)
    dress.recovery_settling_steps = 3
    dress.Update()
    assert seen == {"recovering the pose"}


def test_every_parameter_is_an_attribute():
    for make, name in ((RigBody, "rig"), (FitSkeleton, "fit"), (DrapeGarment, "drape"), (RecoverPose, "recover"),
                       (DressBody, "dress")):
        filter_ = make()
        for parameter, default, *_ in _core.parameters_of(name):
            assert getattr(filter_, parameter) == default and parameter in dir(filter_)
            time = filter_.GetMTime()
            setattr(filter_, parameter, default)
            assert filter_.GetMTime() == time
    with pytest.raises(garmentfit.InvalidInput):
        DressBody(colour="red")


def test_bad_input_raises_an_event_and_the_filter_works_afterwards(sources):
    rig, heard = RigBody(), []
    rig.AddObserver("ErrorEvent", lambda o, e: heard.append(e))
    rig.GetExecutive().AddObserver("ErrorEvent", lambda o, e: None)
    rig.SetInputData(vtkPolyData())
    rig.Update()
    assert heard and "0 polygons" in rig.error and rig.GetOutput(0).GetNumberOfPoints() == 0
    rig.SetInputConnection(sources[0].GetOutputPort())
    rig.Update()
    assert rig.error is None and rig.GetOutput(1).GetNumberOfLines() == 22


def test_abort_leaves_outputs_empty_and_the_filter_runs_again(sources):
    rig = RigBody()
    rig.SetInputConnection(sources[0].GetOutputPort())
    tag = rig.AddObserver("ProgressEvent", lambda o, e: o.SetAbortExecute(1) if o.GetProgress() > 0.3 else None)
    rig.Update()
    assert rig.GetOutput(1).GetNumberOfPoints() == 0
    rig.RemoveObserver(tag)
    rig.SetAbortExecute(0)
    rig.Modified()
    rig.Update()
    assert rig.GetOutput(1).GetNumberOfPoints() == 23


def test_pyvista_takes_the_filter_as_it_is(dress, tmp_path):
    pyvista = pytest.importorskip("pyvista")
    pyvista.OFF_SCREEN = True
    plotter = pyvista.Plotter(window_size=(200, 200))
    plotter.add_mesh(dress.GetOutputPort(0), color="tan")
    plotter.add_mesh(dress.GetOutputPort(1), scalars="Ease")
    picture = plotter.screenshot(str(tmp_path / "dressed.png"))
    assert len(np.unique(picture.reshape(-1, 3), axis=0)) > 50


def test_pyvista_meshes_are_meshes():
    pyvista = pytest.importorskip("pyvista")
    body = pyvista.read(SAMPLES / "walking_woman.ply")
    assert len(garmentfit.rig_body(body).joints) == 23
