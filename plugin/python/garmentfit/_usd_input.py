# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes of USD files, by usd-core (extra `usd`)."""
from __future__ import annotations

from pathlib import Path
from typing import Any, List, Tuple

import numpy as np
import numpy.typing as npt

from ._errors import invalid_input

ENDINGS = (".usd", ".usda", ".usdc", ".usdz")


def read_usd(path: Path) -> Tuple[npt.NDArray[np.float64], npt.NDArray[np.int32]]:
    """All visible meshes of the stage at its first time, in metres with +y up; polygons are cut into fans."""
    stage = _open(path)
    from pxr import Usd, UsdGeom
    time = Usd.TimeCode.EarliestTime()
    transforms = UsdGeom.XformCache(time)
    positions: List[npt.NDArray[np.float64]] = []
    triangles: List[npt.NDArray[np.int64]] = []
    first = 0
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if not _is_shown(prim, time):
            continue
        points, faces = _mesh(path, prim, np.array(transforms.GetLocalToWorldTransform(prim)), time)
        positions.append(points)
        triangles.append(faces + first)
        first += len(points)
    if not triangles or not sum(map(len, triangles)):
        raise invalid_input("no_faces", f"{path}: has no visible mesh with faces; give a surface mesh")
    metres = np.concatenate(positions) * UsdGeom.GetStageMetersPerUnit(stage)
    if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.z:
        metres = np.stack([metres[:, 0], metres[:, 2], -metres[:, 1]], axis=1)
    return metres, np.concatenate(triangles).astype(np.int32)


def _open(path: Path) -> Any:
    try:
        from pxr import Tf, Usd
    except ImportError:
        raise invalid_input("unreadable_file",
                            f"{path}: USD needs usd-core; pip install 'garmentfit[usd]'") from None
    try:
        return Usd.Stage.Open(str(path))
    except Tf.ErrorException as error:
        why = str(error).strip().splitlines()[-1].strip()
        raise invalid_input("unreadable_file", f"{path}: is no USD file that can be read ({why})") from None


def _is_shown(prim: Any, time: Any) -> bool:
    from pxr import UsdGeom
    if not prim.IsA(UsdGeom.Mesh):
        return False
    image = UsdGeom.Imageable(prim)
    purpose = image.ComputePurpose()
    return bool(image.ComputeVisibility(time) != UsdGeom.Tokens.invisible
                and purpose not in (UsdGeom.Tokens.proxy, UsdGeom.Tokens.guide))


def _mesh(path: Path, prim: Any, world_from_local: npt.NDArray[np.float64],
          time: Any) -> Tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """In the stage's units and axes. The matrix is for rows, as in USD."""
    from pxr import UsdGeom
    mesh = UsdGeom.Mesh(prim)

    def array(attribute: Any, kind: Any) -> Any:
        value = attribute.Get(time)
        return np.array([] if value is None else value, dtype=kind)

    points = array(mesh.GetPointsAttr(), np.float64).reshape(-1, 3)
    counts = array(mesh.GetFaceVertexCountsAttr(), np.int64)
    corners = array(mesh.GetFaceVertexIndicesAttr(), np.int64)
    if counts.sum() != len(corners) or (counts < 3).any():
        raise invalid_input("unreadable_file", f"{path}: {prim.GetPath()}: the counts of its corners are mangled")
    if len(corners) and (corners.min() < 0 or corners.max() >= len(points)):
        raise invalid_input("bad_index", f"{path}: {prim.GetPath()}: faces refer to vertices from {corners.min()} to "
                                         f"{corners.max()}, but there are {len(points)}")
    faces = _fans(counts, corners)
    turned = np.linalg.det(world_from_local[:3, :3]) < 0
    if turned != (mesh.GetOrientationAttr().Get(time) == UsdGeom.Tokens.leftHanded):
        faces = faces[:, ::-1]
    return points @ world_from_local[:3, :3] + world_from_local[3, :3], faces


def _fans(counts: npt.NDArray[np.int64], corners: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    fans = counts - 2
    begins = np.repeat(np.cumsum(counts) - counts, fans)
    within = np.arange(fans.sum()) - np.repeat(np.cumsum(fans) - fans, fans)
    return np.stack([corners[begins], corners[begins + within + 1], corners[begins + within + 2]], axis=1)
