# SPDX-License-Identifier: GPL-3.0-or-later
"""Outfits and frames as USD, opened by Pixar's library."""
import numpy as np
import pytest
from conftest import QUICK

import garmentfit

pytest.importorskip("pxr", reason="usd-core is not installed")

from pxr import Gf, Usd, UsdGeom, UsdShade, UsdSkel, Vt  # noqa: E402

from garmentfit._glb import Glb  # noqa: E402
from garmentfit.usd import convert_outfit, write_frames  # noqa: E402

PIXEL = bytes.fromhex("89504e470d0a1a0a0000000d49484452000000010000000108020000009077"
                      "53de0000000c4944415478da63f8ffff3f0005fe02fe33129514"
                      "0000000049454e44ae426082")


@pytest.fixture(scope="module")
def dressed(body, skirt, tmp_path_factory):
    """In a skirt with a seam in its UVs, two materials and a picture."""
    folder = tmp_path_factory.mktemp("cloth")
    half = len(skirt.triangles) // 2
    faces = [f"f {a}/{k} {b}/{k} {c}/{k}" for k, part in ((1, skirt.triangles[:half]), (2, skirt.triangles[half:]))
             for a, b, c in part + 1]
    lines = [f"v {x} {y} {z}" for x, y, z in skirt.positions] + ["vt .5 .25", "vt .5 .75", "usemtl red"] \
        + faces[:half] + ["usemtl print"] + faces[half:]
    (folder / "skirt.obj").write_text("mtllib skirt.mtl\n" + "\n".join(lines))
    (folder / "skirt.mtl").write_text("newmtl red\nKd 1 0 0\nnewmtl print\nmap_Kd print.png\n")
    (folder / "print.png").write_bytes(PIXEL)
    return garmentfit.dress(body, garmentfit.read_mesh(folder / "skirt.obj"), frames=3, **QUICK)


def skinned(glb, node, turns):
    """Linear blend skinning by the numbers of the GLB, its joints turned in their own axes."""
    skin, primitive = glb.json["skins"][node["skin"]], glb.json["meshes"][node["mesh"]]["primitives"][0]
    binds = glb.array(skin["inverseBindMatrices"]).astype(float).reshape(-1, 4, 4).transpose(0, 2, 1)

    def world(joint):
        local = glb.parent_from_node(joint) @ turns.get(glb.json["nodes"][joint]["name"], np.eye(4))
        return local if glb.parent(joint) is None else world(glb.parent(joint)) @ local
    moves = np.array([world(joint) @ bind for joint, bind in zip(skin["joints"], binds)])
    attributes = {name: glb.array(index) for name, index in primitive["attributes"].items()}
    places = np.c_[attributes["POSITION"], np.ones(len(attributes["POSITION"]))]
    joints, weights = (np.hstack([attributes[name] for name in sorted(attributes) if name.startswith(what)])
                       for what in ("JOINTS_", "WEIGHTS_"))
    per_joint = np.einsum("vkij,vj->vki", moves[joints.astype(int)], places)
    return np.einsum("vk,vki->vi", weights, per_joint)[:, :3]


def posed_by_usd(stage, place, turns):
    """The points of a mesh as USD's own skinning has them."""
    cache, root = UsdSkel.Cache(), UsdSkel.Root.Get(stage, "/Outfit")
    cache.Populate(root, Usd.PrimDefaultPredicate)
    prim = stage.GetPrimAtPath(place)
    skinning = cache.GetSkinningQuery(prim)
    skeleton = cache.GetSkelQuery(UsdSkel.BindingAPI(prim).GetInheritedSkeleton())
    names = [joint.split("/")[-1] for joint in skeleton.GetJointOrder()]
    local = skeleton.ComputeJointLocalTransforms(0, True)
    local = Vt.Matrix4dArray([Gf.Matrix4d(*turns[name].T.reshape(-1).tolist()) * matrix if name in turns else matrix
                              for name, matrix in zip(names, local)])
    in_skeleton = UsdSkel.ConcatJointTransforms(skeleton.GetTopology(), local)
    binds = skeleton.GetJointWorldBindTransforms()
    moves = Vt.Matrix4dArray([bind.GetInverse() * now for bind, now in zip(binds, in_skeleton)])
    points = UsdGeom.Mesh(prim).GetPointsAttr().Get()
    assert skinning.ComputeSkinnedPoints(moves, points, 0)
    return np.array(points)


@pytest.mark.parametrize("influences", [4, 8])
def test_usd_poses_an_outfit_as_the_glb_does(dressed, tmp_path, influences):
    dressed.write_outfit(tmp_path / "outfit.glb", hide_covered_skin=True, influences=influences)
    assert convert_outfit(tmp_path / "outfit.glb", tmp_path / "outfit.usdc") == []
    stage, glb = Usd.Stage.Open(str(tmp_path / "outfit.usdc")), Glb(tmp_path / "outfit.glb")
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1 and UsdGeom.GetStageUpAxis(stage) == "Y"
    turn = np.eye(4)
    turn[:3, :3] = [[1, 0, 0], [0, 0.6, -0.8], [0, 0.8, 0.6]]
    meshes = [node for node in glb.json["nodes"] if "mesh" in node]
    assert len(meshes) == 2
    for node in meshes:
        place = "/Outfit/" + glb.json["meshes"][node["mesh"]]["name"]
        still, moved = (posed_by_usd(stage, place, turns) for turns in ({}, {"lfemur": turn, "lhumerus": turn}))
        assert np.abs(still - skinned(glb, node, {})).max() < 1e-5
        assert np.abs(moved - skinned(glb, node, {"lfemur": turn, "lhumerus": turn})).max() < 1e-5
        assert np.abs(moved - still).max() > 0.05
    assert UsdGeom.PrimvarsAPI(stage.GetPrimAtPath("/Outfit/body")).GetPrimvar("covered").HasValue()


def test_usd_keeps_uvs_materials_and_pictures(dressed, tmp_path):
    dressed.write_outfit(tmp_path / "outfit.glb")
    convert_outfit(tmp_path / "outfit.glb", tmp_path / "sub" / "outfit.usda")
    stage = Usd.Stage.Open(str(tmp_path / "sub" / "outfit.usda"))
    cloth = stage.GetPrimAtPath("/Outfit/skirt")
    mesh = UsdGeom.Mesh(cloth)
    uvs = np.array(UsdGeom.PrimvarsAPI(cloth).GetPrimvar("st").Get())
    assert len(uvs) == len(mesh.GetPointsAttr().Get()) and set(uvs[:, 1]) == {0.25, 0.75}
    subsets = UsdShade.MaterialBindingAPI(cloth).GetMaterialBindSubsets()
    assert sum(len(subset.GetIndicesAttr().Get()) for subset in subsets) == len(mesh.GetFaceVertexCountsAttr().Get())
    materials = [UsdShade.MaterialBindingAPI(subset).ComputeBoundMaterial()[0] for subset in subsets]
    assert [material.GetPrim().GetDisplayName() for material in materials] == ["red", "print"]
    surfaces = [material.ComputeSurfaceSource()[0] for material in materials]
    assert surfaces[0].GetInput("diffuseColor").Get() == Gf.Vec3f(1, 0, 0)
    reader = surfaces[1].GetInput("diffuseColor").GetConnectedSources()[0][0].source
    file = UsdShade.Shader(reader.GetPrim()).GetInput("file").Get()
    assert (tmp_path / "sub" / file.path).read_bytes() == PIXEL and file.resolvedPath


def test_frames_are_points_that_move(dressed, body, tmp_path):
    (tmp_path / "frames.usdc").write_text("something else")
    write_frames(dressed, body, tmp_path / "frames.usdc")
    stage = Usd.Stage.Open(str(tmp_path / "frames.usdc"))
    assert stage.GetEndTimeCode() == len(dressed.frames) - 1 > 0
    for time, frame in enumerate(dressed.frames):
        for name, points in ("body", frame.body), ("skirt", frame.garments[0]):
            written = UsdGeom.Mesh(stage.GetPrimAtPath(f"/Dressing/{name}")).GetPointsAttr().Get(time)
            assert np.abs(np.array(written) - points).max() < 1e-5
    write_frames(dressed, body, tmp_path / "frames.usdc", up="z")  # once more, while it is shown
    assert UsdGeom.GetStageUpAxis(stage) == "Z"


def test_what_usd_does_not_get_is_said_and_bad_input_is_refused(dressed, body, skirt, tmp_path):
    dressed.write_outfit(tmp_path / "avatar.vrm")
    assert convert_outfit(tmp_path / "avatar.vrm", tmp_path / "avatar.usd") == ["extensions are left out: VRMC_vrm"]
    (tmp_path / "no.glb").write_text("nothing")
    for call, words in ((lambda: convert_outfit(tmp_path / "no.glb", tmp_path / "no.usdc"), "is no GLB"),
                        (lambda: convert_outfit(tmp_path / "avatar.vrm", tmp_path / "no.abc"), "does not end in"),
                        (lambda: convert_outfit(tmp_path / "avatar.vrm", tmp_path / "no.glb" / "x.usd"),
                         "cannot be written"),
                        (lambda: write_frames(dressed, body, tmp_path / "no.usdc", up="x"), "y or z up"),
                        (lambda: write_frames(garmentfit.dress(body, skirt, **QUICK), body, tmp_path / "no.usdc"),
                         "no frames")):
        with pytest.raises(garmentfit.InvalidInput, match=words):
            call()
    assert not (tmp_path / "no.usdc").exists()
