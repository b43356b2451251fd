# SPDX-License-Identifier: GPL-3.0-or-later
"""Outfits and moving clothes as USD, for Omniverse, Houdini, Maya and others. Needs `pip install ".[usd]"`.

>>> from garmentfit.usd import convert_outfit, write_frames
>>> dressed.write_outfit("outfit.glb")
>>> convert_outfit("outfit.glb", "outfit.usdc")
>>> write_frames(dressed, body, "dressing.usdc")
"""
from __future__ import annotations

import os
import re
from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt
from pxr import Gf, Sdf, Tf, Usd, UsdGeom, UsdShade, UsdSkel, Vt

from ._errors import invalid_input
from ._glb import Glb
from ._meshes import MeshLike, as_mesh
from ._steps import Dressing

_ENDINGS = (".usd", ".usda", ".usdc")
_SHOWN = {"baseColorTexture": ("diffuseColor", "rgb"), "normalTexture": ("normal", "rgb")}


def convert_outfit(outfit: Union[str, "os.PathLike[str]"], path: Union[str, "os.PathLike[str]"]) -> List[str]:
    """Writes an outfit of write_outfit as USD: meshes with their UVs, materials, skins and skeletons (UsdSkel).

    Pictures are written into NAME_textures beside it. Returns what USD does not get, a line each.
    """
    glb, stage, path = Glb(Path(outfit)), *_new_stage(path, 1.0, "y")
    root = UsdSkel.Root.Define(stage, "/Outfit")
    stage.SetDefaultPrim(root.GetPrim())
    materials = [_add_material(stage, glb, i, path) for i in range(len(glb.list("materials")))]
    skeletons = [_add_skeleton(stage, glb, i) for i in range(len(glb.list("skins")))]
    names: Dict[str, int] = {}
    for index, node in enumerate(glb.list("nodes")):
        if "mesh" in node:
            _add_meshes(stage, glb, index, skeletons, materials, names)
    stage.GetRootLayer().Save()
    return _lost(glb)


def write_frames(dressed: Dressing, body: MeshLike, path: Union[str, "os.PathLike[str]"], *, up: str = "y",
                 frames_per_second: float = 8) -> None:
    """Writes the states on the pose path (`frames` of dress or recover_pose) as USD: meshes whose points move.

    body: the mesh that was dressed, for its triangles. up: of the body's file, "y" or "z".
    """
    frames = dressed.frames
    if not frames:
        raise invalid_input("missing_input", "there are no frames; give dress or recover_pose a number of frames")
    if up not in ("y", "z"):
        raise invalid_input("wrong_call", f"USD has y or z up, not {up!r}; turn the meshes")
    stage, path = _new_stage(path, dressed.metres_per_unit, up)
    stage.SetStartTimeCode(0)
    stage.SetEndTimeCode(len(frames) - 1)
    stage.SetTimeCodesPerSecond(frames_per_second)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/Dressing").GetPrim())
    names: Dict[str, int] = {}
    meshes = [("body", as_mesh(body).triangles, [frame.body for frame in frames])]
    meshes += [(Path(garment.name).stem, garment.triangles, [frame.garments[i] for frame in frames])
               for i, garment in enumerate(dressed.garments)]
    for name, triangles, states in meshes:
        mesh = _define_mesh(stage, f"/Dressing/{_free_name(name, names)}", states[0], triangles)
        for time, points in enumerate(states):
            mesh.GetPointsAttr().Set(_points(points), time)
            mesh.GetExtentAttr().Set(UsdGeom.PointBased.ComputeExtent(_points(points)), time)
    stage.GetRootLayer().Save()


def _new_stage(path: Union[str, "os.PathLike[str]"], metres_per_unit: float, up: str) -> Tuple[Any, Path]:
    path = Path(path)
    if path.suffix not in _ENDINGS:
        raise invalid_input("wrong_call", f"{path} does not end in {', '.join(_ENDINGS)}; give a name that does")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        known = Sdf.Layer.Find(str(path))  # in this process, which may still show it
        if known is not None:
            known.Clear()
        else:
            path.unlink(missing_ok=True)
        stage = Usd.Stage.Open(known) if known is not None else Usd.Stage.CreateNew(str(path))
    except (OSError, Tf.ErrorException):
        raise invalid_input("unwritable_file", f"{path}: cannot be written; choose another place") from None
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y if up == "y" else UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, metres_per_unit)
    return stage, path


def _free_name(name: str, taken: Dict[str, int]) -> str:
    """USD knows letters, digits and underscores, each name once."""
    plain = re.sub(r"\W", "_", name) or "mesh"
    plain = plain if not plain[0].isdigit() else "_" + plain
    taken[plain] = taken.get(plain, 0) + 1
    return plain if taken[plain] == 1 else f"{plain}_{taken[plain]}"


def _points(rows: npt.NDArray[Any]) -> Any:
    return Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(rows, np.float32))


def _define_mesh(stage: Any, place: str, points: npt.NDArray[Any], triangles: npt.NDArray[Any]) -> Any:
    mesh = UsdGeom.Mesh.Define(stage, place)
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreatePointsAttr(_points(points))
    mesh.CreateExtentAttr(UsdGeom.PointBased.ComputeExtent(_points(points)))
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray([3] * len(triangles)))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(np.ascontiguousarray(triangles, np.int32).reshape(-1)))
    return mesh


# ---- skeletons -------------------------------------------------------------------------------------------------------

def _matrices(rows: List[npt.NDArray[np.float64]]) -> Any:
    return Vt.Matrix4dArray([Gf.Matrix4d(*matrix.T.reshape(-1).tolist()) for matrix in rows])  # USD has rows


def _joint_above(glb: Glb, node: int, joints: List[int]) -> Optional[int]:
    above = glb.parent(node)
    while above is not None and above not in joints:
        above = glb.parent(above)
    return above


def _add_skeleton(stage: Any, glb: Glb, index: int) -> Tuple[str, npt.NDArray[np.int64]]:
    """Its place, and the row in it of each joint of the skin: USD wants parents first."""
    skin = glb.json["skins"][index]
    joints: List[int] = skin["joints"]
    above = {joint: _joint_above(glb, joint, joints) for joint in joints}

    def chain(joint: int) -> List[int]:
        parent = above[joint]
        return ([] if parent is None else chain(parent)) + [joint]

    order = sorted(joints, key=lambda joint: (len(chain(joint)), joints.index(joint)))
    taken: Dict[str, int] = {}
    names = {joint: _free_name(glb.json["nodes"][joint].get("name", f"joint_{joint}"), taken) for joint in order}
    binds = glb.array(skin["inverseBindMatrices"]).astype(float).reshape(-1, 4, 4).transpose(0, 2, 1)
    world = {joint: glb.world_from_node(joint) for joint in joints}
    skeleton = UsdSkel.Skeleton.Define(stage, f"/Outfit/skeleton_{index}")
    skeleton.CreateJointsAttr(["/".join(names[each] for each in chain(joint)) for joint in order])
    skeleton.CreateBindTransformsAttr(_matrices([np.linalg.inv(binds[joints.index(joint)]) for joint in order]))
    skeleton.CreateRestTransformsAttr(_matrices(
        [world[joint] if above[joint] is None else np.linalg.inv(world[above[joint]]) @ world[joint]
         for joint in order]))
    return f"/Outfit/skeleton_{index}", np.array([order.index(joint) for joint in joints])


def _bind(glb: Glb, mesh: Any, attributes: Dict[str, int], skeleton: Tuple[str, npt.NDArray[np.int64]]) -> None:
    place, rows = skeleton
    binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
    sets = [name[-1] for name in sorted(attributes) if name.startswith("JOINTS_")]
    indices = rows[np.hstack([glb.array(attributes[f"JOINTS_{each}"]) for each in sets]).astype(int)]
    weights = np.hstack([glb.array(attributes[f"WEIGHTS_{each}"]) for each in sets]).astype(np.float32)
    count = indices.shape[1]
    binding.CreateJointIndicesPrimvar(False, count).Set(Vt.IntArray.FromNumpy(indices.astype(np.int32).reshape(-1)))
    binding.CreateJointWeightsPrimvar(False, count).Set(Vt.FloatArray.FromNumpy(weights.reshape(-1)))
    binding.CreateGeomBindTransformAttr(Gf.Matrix4d(1))
    binding.CreateSkeletonRel().SetTargets([place])


# ---- meshes ----------------------------------------------------------------------------------------------------------

def _add_meshes(stage: Any, glb: Glb, node: int, skeletons: List[Any], materials: List[str],
                names: Dict[str, int]) -> None:
    """Primitives that share their vertices are one mesh, with a subset of faces for each material."""
    given = glb.json["nodes"][node]
    mesh_given = glb.json["meshes"][given["mesh"]]
    groups: Dict[int, List[Any]] = {}
    for primitive in mesh_given["primitives"]:
        groups.setdefault(primitive["attributes"]["POSITION"], []).append(primitive)
    for position, primitives in groups.items():
        attributes, points = primitives[0]["attributes"], glb.array(position)
        faces = [glb.array(each["indices"]).reshape(-1, 3).astype(np.int32) if "indices" in each
                 else np.arange(len(points), dtype=np.int32).reshape(-1, 3) for each in primitives]
        name = _free_name(mesh_given.get("name") or given.get("name") or "mesh", names)
        mesh = _define_mesh(stage, f"/Outfit/{name}", points, np.concatenate(faces))
        mesh.CreateDoubleSidedAttr(any(glb.json["materials"][each["material"]].get("doubleSided", False)
                                       for each in primitives if "material" in each))
        primvars = UsdGeom.PrimvarsAPI(mesh)
        if "NORMAL" in attributes:
            mesh.CreateNormalsAttr(_points(glb.array(attributes["NORMAL"])))
            mesh.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
        if "TEXCOORD_0" in attributes:
            uvs = glb.array(attributes["TEXCOORD_0"]).astype(np.float32)
            uvs[:, 1] = 1 - uvs[:, 1]  # glTF counts from above
            primvars.CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray,
                                   UsdGeom.Tokens.vertex).Set(Vt.Vec2fArray.FromNumpy(uvs))
        if "_COVERED" in attributes:
            primvars.CreatePrimvar("covered", Sdf.ValueTypeNames.FloatArray, UsdGeom.Tokens.vertex).Set(
                Vt.FloatArray.FromNumpy(glb.array(attributes["_COVERED"]).astype(np.float32).reshape(-1)))
        _bind_materials(stage, mesh, primitives, faces, materials)
        if "skin" in given:
            _bind(glb, mesh, attributes, skeletons[given["skin"]])
        else:
            UsdGeom.Xformable(mesh).AddTransformOp().Set(_matrices([glb.world_from_node(node)])[0])


def _bind_materials(stage: Any, mesh: Any, primitives: List[Any], faces: List[npt.NDArray[Any]],
                    materials: List[str]) -> None:
    first = 0
    for primitive, own in zip(primitives, faces):
        if "material" in primitive:
            material = UsdShade.Material.Get(stage, materials[primitive["material"]])
            prim = mesh.GetPrim()
            if len(primitives) > 1:
                subset = UsdGeom.Subset.CreateGeomSubset(
                    mesh, f"part_{first}", UsdGeom.Tokens.face,
                    Vt.IntArray(list(range(first, first + len(own)))), UsdShade.Tokens.materialBind)
                prim = subset.GetPrim()
            UsdShade.MaterialBindingAPI.Apply(prim).Bind(material)
        first += len(own)


# ---- materials -------------------------------------------------------------------------------------------------------

def _add_material(stage: Any, glb: Glb, index: int, path: Path) -> str:
    given = glb.json["materials"][index]
    metal = given.get("pbrMetallicRoughness", {})
    place = f"/Outfit/material_{index}"
    material = UsdShade.Material.Define(stage, place)
    material.GetPrim().SetDisplayName(given.get("name", ""))
    shader = UsdShade.Shader.Define(stage, place + "/surface")
    shader.CreateIdAttr("UsdPreviewSurface")
    colour = metal.get("baseColorFactor", [1, 1, 1, 1])
    shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*colour[:3]))
    shader.CreateInput("opacity", Sdf.ValueTypeNames.Float).Set(
        colour[3] if given.get("alphaMode", "OPAQUE") != "OPAQUE" else 1.0)
    shader.CreateInput("metallic", Sdf.ValueTypeNames.Float).Set(metal.get("metallicFactor", 1.0))
    shader.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(metal.get("roughnessFactor", 1.0))
    shader.CreateInput("emissiveColor", Sdf.ValueTypeNames.Color3f).Set(
        Gf.Vec3f(*given.get("emissiveFactor", [0, 0, 0])))
    for texture, (target, output) in _SHOWN.items():
        info = {**metal, **given}.get(texture)
        if info is not None and "source" in glb.json["textures"][info["index"]]:
            source = glb.json["textures"][info["index"]]["source"]
            reader = _add_texture(stage, place, texture, _write_picture(glb, source, path), colour)
            shader.GetInput(target) or shader.CreateInput(target, Sdf.ValueTypeNames.Normal3f)
            shader.GetInput(target).ConnectToSource(reader.ConnectableAPI(), output)
            if texture == "baseColorTexture" and given.get("alphaMode", "OPAQUE") != "OPAQUE":
                reader.CreateOutput("a", Sdf.ValueTypeNames.Float)
                shader.GetInput("opacity").ConnectToSource(reader.ConnectableAPI(), "a")
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    return place


def _add_texture(stage: Any, place: str, name: str, file: str, colour: List[float]) -> Any:
    uvs = UsdShade.Shader.Define(stage, place + "/uvs")
    uvs.CreateIdAttr("UsdPrimvarReader_float2")
    uvs.CreateInput("varname", Sdf.ValueTypeNames.String).Set("st")
    reader = UsdShade.Shader.Define(stage, f"{place}/{name}")
    reader.CreateIdAttr("UsdUVTexture")
    reader.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(file)
    reader.CreateInput("st", Sdf.ValueTypeNames.Float2).ConnectToSource(
        uvs.ConnectableAPI(), "result", UsdShade.AttributeType.Output, Sdf.ValueTypeNames.Float2)
    for side in "wrapS", "wrapT":
        reader.CreateInput(side, Sdf.ValueTypeNames.Token).Set("repeat")
    is_normal = name == "normalTexture"
    reader.CreateInput("sourceColorSpace", Sdf.ValueTypeNames.Token).Set("raw" if is_normal else "sRGB")
    reader.CreateInput("scale", Sdf.ValueTypeNames.Float4).Set(Gf.Vec4f(2) if is_normal else Gf.Vec4f(*colour))
    reader.CreateInput("bias", Sdf.ValueTypeNames.Float4).Set(Gf.Vec4f(-1) if is_normal else Gf.Vec4f(0))
    reader.CreateOutput("rgb", Sdf.ValueTypeNames.Float3)
    return reader


def _write_picture(glb: Glb, index: int, path: Path) -> str:
    """Its name as USD refers to it."""
    data, ending = glb.picture(index)
    folder = path.with_name(path.stem + "_textures")
    folder.mkdir(exist_ok=True)
    (folder / f"{index}{ending}").write_bytes(data)
    return f"./{folder.name}/{index}{ending}"


def _lost(glb: Glb) -> List[str]:
    primitives = [each for mesh in glb.list("meshes") for each in mesh["primitives"]]
    others = [name for material in glb.list("materials")
              for name in {**material.get("pbrMetallicRoughness", {}), **material}
              if name.endswith("Texture") and name not in _SHOWN]
    lines = []
    if glb.list("animations"):
        lines.append("animations are left out")
    if any("targets" in each for each in primitives):
        lines.append("morph targets are left out")
    lines += [f"{name} is left out" for name in sorted(set(others))]
    if glb.json.get("extensions"):
        lines.append("extensions are left out: " + ", ".join(glb.json["extensions"]))
    return lines
