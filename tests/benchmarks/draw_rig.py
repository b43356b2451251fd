#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of rigs to be looked at (Debian: python3-vtk9).

    bends /tmp/bends && draw_rig.py bends /tmp/bends docs/images/rig_bends.png
    draw_rig.py bodies build/release/plugin/cli/garmentfit docs/images/rig_bodies.png
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import vtk

BODIES = pathlib.Path(__file__).resolve().parents[1] / "bodies"
TILE = 240  # pixels
COLUMNS = 4
SKIN, LEFT, RIGHT, MIDDLE = (0.80, 0.66, 0.56), (0.12, 0.35, 0.75), (0.8, 0.2, 0.15), (0.25, 0.25, 0.25)

# Of a bend: m from the joint to the edge of its tile, and from where it is looked at.
REACH = {"shoulder": 0.34, "elbow": 0.3, "hip": 0.42, "knee": 0.36}
VIEW = {"shoulder raised": (0.35, 0.2, 1), "shoulder forward": (0.9, 0.25, 0.6), "elbow": (0.2, 1, 0.6),
        "hip": (1, 0.25, 0.75), "hip spread": (0.15, 0.1, 1), "knee": (1, 0.15, 0.35)}


def skin_of(path, opacity=1.0):
    reader = vtk.vtkPLYReader()
    reader.SetFileName(str(path))
    smooth = vtk.vtkPolyDataNormals()
    smooth.SetInputConnection(reader.GetOutputPort())
    smooth.SplittingOff()
    return actor_of(smooth, SKIN, opacity)


def actor_of(source, colour, opacity=1.0):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*colour)
    actor.GetProperty().SetOpacity(opacity)
    return actor


def bone_of(bone):
    line = vtk.vtkLineSource()
    line.SetPoint1(*bone["head"])
    line.SetPoint2(*bone["tail"])
    tube = vtk.vtkTubeFilter()
    tube.SetInputConnection(line.GetOutputPort())
    tube.SetRadius(0.011)
    tube.SetNumberOfSides(12)
    tube.CappingOn()
    return actor_of(tube, {"l": LEFT, "r": RIGHT}.get(side_of(bone["name"]), MIDDLE))


def side_of(name):
    return name[0] if name[1:] in {"clavicle", "humerus", "radius", "hipjoint", "femur", "tibia"} else ""


def renderer_of(actors, label, view, focus=None, scale=None):
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.UseDepthPeelingOn()
    for actor in actors:
        renderer.AddActor(actor)
    text = vtk.vtkTextActor()
    text.SetInput(label)
    text.SetPosition(8, 6)
    text.GetTextProperty().SetColor(0, 0, 0)
    text.GetTextProperty().SetFontSize(15)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*(focus or (0, 0, 0)))
    camera.SetPosition(*(p + 3 * v for p, v in zip(camera.GetFocalPoint(), view)))
    camera.SetViewUp(0, 1, 0)
    if scale:
        camera.SetParallelScale(scale)
        renderer.ResetCameraClippingRange()
    else:
        renderer.ResetCamera()
        camera.SetWindowCenter(0, -0.05)  # room for the label
    renderer.AddActor(text)
    return renderer


def joint_of(path):
    for line in path.read_bytes().split(b"end_header")[0].decode().splitlines():
        if line.startswith("comment joint"):
            return [float(x) for x in line.split()[2:]]
    sys.exit(f"{path}: no comment says where the joint is")


def bends(folder):
    files = sorted(pathlib.Path(folder).glob("*.ply"), key=lambda p: (p.stem.split()[0], float(p.stem.split()[-1])))
    for path in files:
        _, *name, degrees = path.stem.split()
        yield renderer_of([skin_of(path)], f"{' '.join(name)} {degrees}\N{DEGREE SIGN}", VIEW[" ".join(name)],
                          joint_of(path), REACH[name[0]])


def bodies(program):
    for path in sorted(BODIES.glob("*.ply")):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([program, "rig", path, "-o", f"{folder}/rig", "--quiet"], check=True)
            rig = json.loads(pathlib.Path(folder, "rig", "rig.json").read_text())
        actors = [skin_of(path, 0.35)] + [bone_of(bone) for bone in rig["bones"]]
        yield renderer_of(actors, path.stem.replace("_", " "), (0.55, 0.12, 1))


def draw(renderers, output):
    rows = -(-len(renderers) // COLUMNS)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetAlphaBitPlanes(1)
    window.SetMultiSamples(0)
    window.SetSize(COLUMNS * TILE, rows * TILE)
    for i, renderer in enumerate(renderers):
        row, column = divmod(i, COLUMNS)
        renderer.SetViewport(column / COLUMNS, 1 - (row + 1) / rows, (column + 1) / COLUMNS, 1 - row / rows)
        renderer.UseFXAAOn()
        window.AddRenderer(renderer)
    window.Render()
    pixels = vtk.vtkWindowToImageFilter()
    pixels.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(output)
    writer.SetInputConnection(pixels.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    kind, source, output = sys.argv[1:]
    draw(list({"bends": bends, "bodies": bodies}[kind](source)), output)
