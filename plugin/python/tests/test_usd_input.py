# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies and garments from USD files."""
import numpy as np
import pytest

import garmentfit
from garmentfit import InvalidInput

pytest.importorskip("pxr")

# A quad and a triangle in centimetres with +z up; one wound left-handed and mirrored; one hidden; one a guide.
SCENE = """#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Z"
)
def Xform "Root"
{
    double3 xformOp:translate = (0, 0, 100)
    uniform token[] xformOpOrder = ["xformOp:translate"]

    def Mesh "Quad"
    {
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(0, 0, 0), (100, 0, 0), (100, 100, 0), (0, 100, 0)]
    }
    def Mesh "Mirrored"
    {
        int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0)]
        uniform token orientation = "leftHanded"
        double3 xformOp:scale = (-1, 1, 1)
        uniform token[] xformOpOrder = ["xformOp:scale"]
    }
    def Mesh "LeftHanded"
    {
        int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0)]
        uniform token orientation = "leftHanded"
    }
    def Mesh "Hidden"
    {
        int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        point3f[] points = [(0, 0, 0), (9, 0, 0), (9, 9, 0)]
        token visibility = "invisible"
    }
    def Mesh "Guide"
    {
        int[] faceVertexCounts = [3]
        int[] faceVertexIndices = [0, 1, 2]
        point3f[] points = [(0, 0, 0), (9, 0, 0), (9, 9, 0)]
        uniform token purpose = "guide"
    }
}
"""


def _write(path, text):
    path.write_text(text)
    return path


def test_visible_meshes_are_read_in_metres_with_y_up(tmp_path):
    mesh = garmentfit.read_mesh(_write(tmp_path / "scene.usda", SCENE))
    assert mesh.name == "scene.usda"
    assert np.allclose(mesh.positions[:4], [[0, 1, 0], [1, 1, 0], [1, 1, -1], [0, 1, -1]])
    assert np.allclose(mesh.positions[4:7], [[0, 1, 0], [-.01, 1, 0], [-.01, 1, -.01]])
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [4, 5, 6], [9, 8, 7]]


def test_what_cannot_be_read_is_refused_in_a_line(tmp_path):
    for text, words in [("#usda 1.0\n", "no visible mesh"), ("hello", "no USD file"),
                        (SCENE.replace("[4]", "[5]"), "mangled"),
                        (SCENE.replace("[0, 1, 2, 3]", "[0, 1, 2, 7]"), "from 0 to 7, but there are 4")]:
        with pytest.raises(InvalidInput, match=words) as refused:
            garmentfit.read_mesh(_write(tmp_path / f"{len(text)}.usda", text))
        assert "\n" not in str(refused.value)
    with pytest.raises(InvalidInput):
        garmentfit.read_mesh(tmp_path / "missing.usdc")


def test_a_body_from_usd_is_rigged_as_from_another_file(body, tmp_path):
    from pxr import Usd, UsdGeom
    stage = Usd.Stage.CreateNew(str(tmp_path / "woman.usdc"))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    mesh = UsdGeom.Mesh.Define(stage, "/Woman")
    mesh.GetPointsAttr().Set(body.positions.astype(np.float32))
    mesh.GetFaceVertexCountsAttr().Set(np.full(len(body.triangles), 3, np.int32))
    mesh.GetFaceVertexIndicesAttr().Set(body.triangles.ravel())
    stage.Save()
    given = garmentfit.read_mesh(tmp_path / "woman.usdc")
    assert np.array_equal(given.triangles, body.triangles)
    assert np.allclose(garmentfit.rig_body(given).joints, garmentfit.rig_body(body).joints, atol=1e-6)
