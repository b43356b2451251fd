# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python filters in pipelines of pip's VTK, of Debian's, and in PyVista."""
import gc
import weakref

import numpy as np
import pytest
from conftest import BODY, QUICK, SKIRT

pytest.importorskip("vtkmodules")
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkCommonCore import vtkStringArray  # noqa: E402
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkMultiBlockDataSet, vtkPolyData  # noqa: E402
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as pipeline  # noqa: E402
from vtkmodules.vtkIOPLY import vtkPLYReader  # noqa: E402

import garmentfit  # noqa: E402
from garmentfit import _core  # noqa: E402
from garmentfit._meshes import as_mesh  # noqa: E402
from garmentfit.vtk import DrapeGarment, DressBody, FitSkeleton, RecoverPose, RigBody  # noqa: E402


def reader(path):
    ply = vtkPLYReader()
    ply.SetFileName(str(path))
    return ply


def points(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def stages_of(filter_):
    seen = set()
    filter_.AddObserver("ProgressEvent",
                        lambda o, e: seen.add(o.GetProgressText()) if 0 < o.GetProgress() < 1 else None)
    return seen


@pytest.fixture(scope="module")
def sources():
    return reader(BODY), reader(SKIRT)


@pytest.fixture(scope="module")
def dress(sources):
    filter_ = DressBody(frames=3, **QUICK)
    filter_.SetInputConnection(0, sources[0].GetOutputPort())
    filter_.SetInputConnection(1, sources[1].GetOutputPort())
    filter_.Update()
    return filter_


def test_the_same_numbers_as_the_functions(dress, body, skirt):
    result = garmentfit.dress(body, skirt, **QUICK)
    dress.UpdateTimeStep(1)
    assert np.array_equal(points(dress.GetOutput(1)), result.garments[0].positions)
    ease = vtk_to_numpy(dress.GetOutput(1).GetPointData().GetArray("Ease"))
    assert np.array_equal(ease, result.garments[0].ease)


def test_a_chain_gives_the_same_and_does_not_rig_again(dress, sources):
    rig, fit, drape, recover = RigBody(), FitSkeleton(type="skirt"), DrapeGarment(settling_steps=2), RecoverPose()
    recover.recovery_settling_steps = 2
    recover.quality = "draft"
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


def address(array):
    return vtk_to_numpy(array).__array_interface__["data"][0]


def test_nothing_that_stays_is_copied(dress, sources):
    dress.UpdateTimeStep(1)
    given, dressed = sources[1].GetOutput(), dress.GetOutput(1)
    assert dress.GetOutput(0).GetPoints() is sources[0].GetOutput().GetPoints()
    assert dressed.GetPolys() is given.GetPolys()
    assert address(dressed.GetPolys().GetConnectivityArray()) == address(given.GetPolys().GetConnectivityArray())
    assert address(dressed.GetPointData().GetArray("RestPosition")) == address(given.GetPoints().GetData())
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


def test_sizes_and_the_time_limit_are_heeded_when_they_change(sources):
    rig = RigBody(time_limit=1e-9)
    rig.SetInputConnection(0, sources[0].GetOutputPort())
    rig.AddObserver("ErrorEvent", lambda o, e: None)
    rig.Update()
    assert rig.error_name == "time_limit" and "time_limit" in rig.error
    rig.time_limit = 0
    for height in (1.5, 0.9):
        rig.height = height
        rig.Update()
        units = np.ptp(points(rig.GetOutput(0))[:, 1])
        assert rig.error is None
        assert np.isclose(rig.GetOutput(0).GetFieldData().GetArray("BodyFrame").GetValue(0), height / units)


def test_a_shorter_time_limit_repeats_draping_only_and_leaves_a_clean_state(sources):
    filter_ = DressBody(**QUICK)
    for port in (0, 1):
        filter_.SetInputConnection(port, sources[port].GetOutputPort())
    filter_.AddObserver("WarningEvent", lambda o, e: None)
    filter_.Update()
    seen = stages_of(filter_)
    filter_.time_limit = 1e-6
    filter_.Update()
    assert not {"rigging the body", "fitting the skeleton"} & seen
    field = filter_.GetOutput(0).GetFieldData()
    assert field.GetArray("Certified").GetValue(0) == 0
    assert "time limit" in field.GetAbstractArray("Note").GetValue(0)


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


def changed(data, change):
    copy = vtkPolyData()
    copy.DeepCopy(data)
    change(copy)
    return copy


def only_lines(data):
    lines = vtkCellArray()
    lines.InsertNextCell(2)
    lines.InsertCellPoint(0)
    lines.InsertCellPoint(1)
    data.SetPolys(None)
    data.SetLines(lines)


def no_points(data):
    data.SetPoints(None)


def strips(data):
    data.SetStrips(data.GetPolys())


def of_a_type_unknown(data):
    array = vtkStringArray()
    array.SetName("GarmentType")
    array.InsertNextValue("hat")
    data.GetFieldData().AddArray(array)


def with_a_quad(polygons):
    """Replaces the first two triangles by one quad."""
    corners = vtk_to_numpy(polygons.GetConnectivityArray()).reshape(-1, 3)[2:].tolist()
    cells = vtkCellArray()
    for cell in ([0, 1, 2, 3], *corners):
        cells.InsertNextCell(len(cell))
        for corner in cell:
            cells.InsertCellPoint(corner)
    return cells


def blocks(block):
    composite = vtkMultiBlockDataSet()
    composite.SetBlock(0, block)
    return composite


BAD_BODIES = {
    "0 polygons": lambda body: vtkPolyData(),
    "1 lines": lambda body: changed(body, only_lines),
    "strips": lambda body: changed(body, strips),
    "0 points": lambda body: changed(body, no_points),
    "finite": lambda body: changed(body, lambda data: data.GetPoints().SetPoint(7, np.nan, 0, 0)),
}
BAD_GARMENTS = {
    "0 polygons": lambda skirt: vtkPolyData(),
    "1 lines": lambda skirt: changed(skirt, only_lines),
    "finite": lambda skirt: changed(skirt, lambda data: data.GetPoints().SetPoint(7, np.inf, 0, 0)),
    "hat": lambda skirt: changed(skirt, of_a_type_unknown),
    "vtkImageData": lambda skirt: blocks(vtkImageData()),
    "garment": lambda skirt: vtkMultiBlockDataSet(),
}


@pytest.fixture
def rig(sources):
    filter_ = RigBody()
    filter_.SetInputConnection(sources[0].GetOutputPort())
    filter_.Update()
    return filter_


def listening(filter_):
    heard = []
    filter_.AddObserver("ErrorEvent", lambda o, e: heard.append(e))
    filter_.GetExecutive().AddObserver("ErrorEvent", lambda o, e: heard.append(e))
    return heard


@pytest.mark.parametrize("part", BAD_BODIES)
def test_a_bad_body_raises_an_event_and_the_filter_works_afterwards(part, sources):
    rig = RigBody()
    heard = listening(rig)
    sources[0].Update()
    rig.SetInputData(BAD_BODIES[part](sources[0].GetOutput()))
    rig.Update()
    assert heard and part in rig.error and "\n" not in rig.error and rig.error_name
    assert rig.GetOutput(0).GetNumberOfPoints() == rig.GetOutput(1).GetNumberOfPoints() == 0
    rig.SetInputConnection(sources[0].GetOutputPort())
    rig.Update()
    assert rig.error is None and rig.error_name is None and rig.GetOutput(1).GetNumberOfLines() == 22


@pytest.mark.parametrize("part", BAD_GARMENTS)
def test_a_bad_garment_raises_an_event_and_the_filter_works_afterwards(part, rig, sources):
    fit = FitSkeleton(type="skirt")
    heard = listening(fit)
    sources[1].Update()
    fit.SetInputConnection(0, rig.GetOutputPort())
    fit.SetInputData(1, BAD_GARMENTS[part](sources[1].GetOutput()))
    fit.Update()
    assert heard and part in fit.error and "\n" not in fit.error
    assert fit.GetOutput(0).GetNumberOfPoints() == fit.GetOutput(2).GetNumberOfPoints() == 0
    fit.SetInputConnection(1, sources[1].GetOutputPort())
    fit.Update()
    assert fit.error is None and fit.GetOutput(1).GetNumberOfPoints() == 3055


def test_what_the_filter_before_made_is_asked_for_by_name(rig, sources):
    for make, connected, part in ((FitSkeleton, sources[0], "Rig Body"), (DrapeGarment, rig, "Fit Skeleton"),
                                  (RecoverPose, rig, "Drape Garment")):
        filter_ = make()
        heard = listening(filter_)
        filter_.SetInputConnection(0, connected.GetOutputPort())
        filter_.SetInputConnection(1, sources[1].GetOutputPort())
        filter_.Update()
        assert heard and part in filter_.error, filter_.error


def test_a_rig_of_another_body_is_refused(rig, sources):
    man = reader(BODY.with_name("man_a_pose.ply"))
    man.Update()
    fit = FitSkeleton()
    listening(fit)
    fit.SetInputConnection(1, sources[1].GetOutputPort())
    for other, part in ((sources[1], "3000 vertices, this one has 3055"), (man, "belongs to another body")):
        field = rig.GetOutput(0).GetFieldData()
        wrong = changed(other.GetOutput(), lambda data: data.GetFieldData().ShallowCopy(field))
        for name in ("JointIndices", "JointWeights"):
            wrong.GetPointData().AddArray(rig.GetOutput(0).GetPointData().GetArray(name))
        fit.SetInputData(0, wrong)
        fit.Update()
        assert part in fit.error


def test_what_the_executive_refuses_has_its_own_line_and_leaves_no_older_outputs(rig, sources):
    fit = FitSkeleton(type="skirt")
    heard = listening(fit)
    fit.SetInputConnection(0, rig.GetOutputPort())
    for garments, part in ((None, "nothing is connected to input 1, the garments"),
                           (vtkImageData(), "is a vtkImageData")):
        fit.SetInputConnection(1, sources[1].GetOutputPort())
        fit.Update()
        assert fit.error is None and fit.GetOutput(0).GetNumberOfPoints() > 0 and not heard
        fit.SetInputDataObject(1, garments)
        fit.Update()
        assert heard == ["ErrorEvent"] and part in fit.error
        assert [fit.GetOutput(port).GetNumberOfPolys() for port in range(3)] == [0, 0, 0]
        heard.clear()


def test_a_missing_input_is_an_error_event(sources):
    dress = DressBody()
    heard = listening(dress)
    dress.SetInputConnection(0, sources[0].GetOutputPort())
    dress.Update()
    assert heard


def test_what_the_executive_refuses_leaves_no_older_line(sources):
    rig = RigBody()
    heard = listening(rig)
    rig.SetInputData(vtkPolyData())
    rig.Update()
    older = rig.error
    assert older
    heard.clear()
    rig.SetInputData(vtkImageData())
    rig.Update()
    assert heard and rig.error != older and "input 0, the body, is a vtkImageData" in rig.error


@pytest.mark.parametrize("name, value, part", [
    ("frames", "many", 'frames: "many"'), ("frames", 10**12, "frames"), ("frames", -1, "frames"),
    ("density", np.nan, "nan"),
    ("unit", None, "TypeError"), ("joints", {"lknee": 5}, "TypeError"),
])
def test_an_attribute_of_the_wrong_kind_leaves_a_line(name, value, part, sources):
    dress = DressBody(**{name: value})
    heard = listening(dress)
    for port, source in enumerate(sources):
        dress.SetInputConnection(port, source.GetOutputPort())
    dress.Update()
    assert heard and part in dress.error
    with pytest.raises(TypeError):
        dress.joints["lelbow"] = (0, 0, 0)


def test_abort_in_the_middle_leaves_outputs_empty_and_what_was_done_is_kept(sources):
    dress = DressBody(**QUICK)
    for port, source in enumerate(sources):
        dress.SetInputConnection(port, source.GetOutputPort())
    tag = dress.AddObserver("ProgressEvent", lambda o, e: o.SetAbortExecute(1) if o.GetProgress() > 0.6 else None)
    dress.Update()
    assert all(dress.GetOutput(port).GetNumberOfPoints() == 0 for port in range(3)) and dress.error is None
    dress.RemoveObserver(tag)
    dress.SetAbortExecute(0)
    dress.Modified()
    seen = stages_of(dress)
    dress.Update()
    assert dress.GetOutput(0).GetFieldData().GetArray("Certified").GetValue(0) == 1
    assert "rigging the body" not in seen and "recovering the pose" in seen


def test_a_chain_is_silent_and_empty_when_its_first_filter_is_aborted(sources):
    rig, fit = RigBody(), FitSkeleton(type="skirt")
    heard = listening(fit)
    rig.SetInputConnection(sources[0].GetOutputPort())
    fit.SetInputConnection(0, rig.GetOutputPort())
    fit.SetInputConnection(1, sources[1].GetOutputPort())
    tag = rig.AddObserver("ProgressEvent", lambda o, e: o.SetAbortExecute(1))
    fit.Update()
    assert not heard and fit.error is None and fit.GetOutput(1).GetNumberOfPoints() == 0
    rig.RemoveObserver(tag)
    rig.SetAbortExecute(0)
    rig.Modified()
    fit.Update()
    assert fit.GetOutput(1).GetNumberOfPoints() == 3055


def test_a_file_with_a_time_of_its_own_is_not_read_anew_for_each_frame(sources, tmp_path):
    from vtkmodules.vtkCommonDataModel import vtkDataObject
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter
    sources[0].Update()
    timed = changed(sources[0].GetOutput(), lambda data: data.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), 0.3))
    writer, back, dress = vtkXMLPolyDataWriter(), vtkXMLPolyDataReader(), DressBody(frames=2, **QUICK)
    writer.SetInputData(timed)
    for file in (writer, back):
        file.SetFileName(str(tmp_path / "body.vtp"))
    writer.Write()
    dress.SetInputConnection(0, back.GetOutputPort())
    dress.SetInputConnection(1, sources[1].GetOutputPort())
    dress.UpdateTimeStep(1)
    seen = stages_of(dress)
    dress.UpdateTimeStep(0)
    assert not seen and back.GetOutputInformation(0).Has(pipeline.TIME_STEPS())


def test_a_garment_that_is_too_small_is_a_warning(sources):
    dress = DressBody(type="skirt")
    heard = listening(dress)
    warned = []
    dress.AddObserver("WarningEvent", lambda o, e: warned.append(e))
    heavy = reader(BODY.with_name("heavy_man_arms_down.ply"))  # kept: VTK's Python does not keep a producer alive
    dress.SetInputConnection(0, heavy.GetOutputPort())
    dress.SetInputConnection(1, sources[1].GetOutputPort())
    dress.Update()
    assert warned and not heard and dress.error is None
    of_body = dress.GetOutput(0).GetFieldData()
    assert "too small" in of_body.GetAbstractArray("Note").GetValue(0)
    assert np.isnan(of_body.GetArray("Speed").GetValue(0)) and of_body.GetAbstractArray("Warnings")


def test_a_filter_that_nobody_holds_is_freed(sources):
    rig = RigBody()
    rig.SetInputConnection(sources[0].GetOutputPort())
    rig.Update()
    gone = weakref.ref(rig)
    del rig
    gc.collect()
    assert gone() is None


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
    body = pyvista.read(BODY)
    assert len(garmentfit.rig_body(body).joints) == 23
    for given, part in ((pyvista.Line(), "1 lines"), (pyvista.PolyData(), "0 points"), (body.strip(), "strips"),
                        (body.cast_to_unstructured_grid(), "is no mesh")):
        with pytest.raises(garmentfit.InvalidInput, match=part):
            garmentfit.rig_body(given)


def test_functions_take_polygons_as_the_filters_do(sources):
    sources[0].Update()
    with_quad = changed(sources[0].GetOutput(), lambda data: data.SetPolys(with_a_quad(data.GetPolys())))
    whole = as_mesh(sources[0].GetOutput())
    cut = as_mesh(with_quad)
    assert with_quad.GetNumberOfPolys() == len(whole.triangles) - 1
    assert np.array_equal(cut.positions, whole.positions) and np.array_equal(cut.triangles[2:], whole.triangles[2:])
    assert cut.triangles[:2].tolist() == [[0, 1, 2], [0, 2, 3]]
