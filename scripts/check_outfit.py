# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens an outfit in Blender and turns a joint. Run by scripts/check-outfit --blender."""

import sys
from math import radians

import bpy
import numpy as np


def places(mesh) -> np.ndarray:
    """The vertices of a mesh as they are shown."""
    shown = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    rows = np.empty(3 * len(shown.vertices))
    shown.vertices.foreach_get("co", rows)
    return rows.reshape(-1, 3)


def main(file: str) -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=file)
    armature = next(item for item in bpy.data.objects if item.type == "ARMATURE")
    meshes = [item for item in bpy.data.objects
              if item.type == "MESH" and any(m.type == "ARMATURE" for m in item.modifiers)]
    if len(meshes) < 2:
        sys.exit(f"{file}: Blender has {len(meshes)} skinned meshes; a body and a garment were expected")
    before = [places(mesh) for mesh in meshes]
    for joint in armature.pose.bones:
        joint.rotation_mode = "XYZ"
        joint.rotation_euler.x += radians(20)
    bpy.context.view_layer.update()
    for mesh, rows in zip(meshes, before):
        if np.abs(places(mesh) - rows).max() < 0.01:
            sys.exit(f"{file}: in Blender no joint moves {mesh.name}")
    print(f"{file}: Blender {bpy.app.version_string} moves " + ", ".join(mesh.name for mesh in meshes))


if __name__ == "__main__":
    main(sys.argv[1])
