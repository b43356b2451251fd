# SPDX-License-Identifier: GPL-3.0-or-later
"""Time steps as a series of files, and back."""
import pytest
from conftest import BODY, QUICK, SKIRT

pyvista = pytest.importorskip("pyvista")

from garmentfit import InvalidInput  # noqa: E402
from garmentfit.series import write_series  # noqa: E402
from garmentfit.vtk import DrapeGarment, DressBody, FitSkeleton, RecoverPose, RigBody  # noqa: E402


@pytest.fixture(scope="module")
def chain():
    rig, fit, drape, recover = steps = (RigBody(), FitSkeleton(type="skirt"), DrapeGarment(settling_steps=2),
                                        RecoverPose(recovery_settling_steps=2, quality="draft", frames=3))
    rig.SetInputData(pyvista.read(BODY))
    fit.SetInputConnection(0, rig.GetOutputPort(0))
    fit.SetInputData(1, pyvista.read(SKIRT))
    for above, below in ((fit, drape), (drape, recover)):
        for port in (0, 1):
            below.SetInputConnection(port, above.GetOutputPort(port))
    recover.Update()
    return steps


def bits_of(data):
    """All arrays by name, type and components, as bytes or texts. Readers use other classes for the same types."""
    found = {("points",): memoryview(data.GetPoints().GetData()).tobytes(),
             ("polygons",): memoryview(data.GetPolys().GetConnectivityArray()).tobytes()}
    for attributes in (data.GetPointData(), data.GetCellData(), data.GetFieldData()):
        for i in range(attributes.GetNumberOfArrays()):
            array = attributes.GetAbstractArray(i)
            key = (attributes.GetClassName(), array.GetName(), array.GetDataType(), array.GetNumberOfComponents())
            if array.IsNumeric():
                found[key] = memoryview(array).tobytes() if array.GetNumberOfValues() else b""
            else:
                found[key] = [array.GetValue(k) for k in range(array.GetNumberOfValues())]
    return found


def test_scrubbing_computes_nothing_and_comes_back_to_the_same_bits(chain):
    recover, seen = chain[-1], []
    for step in chain:
        step.AddObserver("ProgressEvent",
                         lambda o, e: seen.append(o.GetProgressText()) if 0 < o.GetProgress() < 1 else None)
    shown = {}
    for time in (0, 0.5, 1, 0.5, 0, 1, 0):
        recover.UpdateTimeStep(time)
        bits = [bits_of(recover.GetOutput(port)) for port in (0, 1)]
        assert shown.setdefault(time, bits) == bits
    assert not seen and shown[0] != shown[0.5] != shown[1]


def test_each_port_is_asked_for_its_own_time(chain):
    from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
    recover = chain[-1]
    recover.UpdateTimeStep(1)
    end = bits_of(recover.GetOutput(1))
    recover.GetOutputInformation(1).Set(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP(), 0.0)
    recover.Update(1)
    assert bits_of(recover.GetOutput(1)) != end


def test_a_series_comes_back_bit_for_bit(chain, tmp_path):
    recover = chain[-1]
    files = write_series(recover, tmp_path / "dressing.pvd")
    assert [file.name for file in files] == [f"dressing_000{i}.vtm" for i in range(3)]
    assert "appended" not in "".join(path.read_text() for path in tmp_path.rglob("*.vtp"))
    series = pyvista.get_reader(str(tmp_path / "dressing.pvd"))
    assert series.time_values == [0.0, 0.5, 1.0]
    for time in series.time_values:
        series.set_active_time_value(time)
        back = series.read()[0]
        recover.UpdateTimeStep(time)
        for port, name in enumerate(("body", "garments", "skeleton")):
            written, read = bits_of(recover.GetOutput(port)), bits_of(back[name])
            assert written == {key: read[key] for key in written}  # readers add the time


def test_what_has_no_time_steps_is_no_series(chain, tmp_path):
    with pytest.raises(InvalidInput, match="frames"):
        write_series(chain[0], tmp_path / "none.pvd")
    with pytest.raises(InvalidInput, match="pvd"):
        write_series(chain[-1], tmp_path / "none.vtk")


def test_a_filter_that_fails_writes_nothing(tmp_path):
    dress = DressBody(frames=2)
    with pytest.raises(InvalidInput, match="nothing is connected to input 0"):
        write_series(dress, tmp_path / "none.pvd")
    dress.SetInputData(0, pyvista.Sphere())
    dress.SetInputData(1, pyvista.read(SKIRT))
    with pytest.raises(InvalidInput, match="give a human body"):
        write_series(dress, tmp_path / "none.pvd")
    dress.SetInputData(0, pyvista.read(BODY))
    dress.AddObserver("ProgressEvent", lambda o, e: o.SetAbortExecute(1))
    with pytest.raises(InvalidInput, match="has no output at time 0"):
        write_series(dress, tmp_path / "none.pvd")
    assert not list(tmp_path.iterdir())
