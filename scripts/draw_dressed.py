# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a folder that `garmentfit dress` wrote from PLY files in metres with +y up: body and garments in soft light.

Called by scripts/draw-dressed, which installs the package vtk of PyPI. It needs no display. The general program for
pictures, for all formats, units and axes, is garmentfit-picture.
"""

import argparse
import json
import pathlib

import numpy as np
import vtkmodules.vtkRenderingFreeType  # noqa: F401, registers the text renderer
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkImagingCore import vtkImageResize
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass, vtkSSAOPass

PLY_TYPES = {"char": "i1", "uchar": "u1", "short": "<i2", "ushort": "<u2", "int": "<i4", "uint": "<u4",
             "float": "<f4", "double": "<f8", "float32": "<f4", "float64": "<f8", "int32": "<i4", "uint8": "u1"}
BACKGROUND = (0.965, 0.96, 0.95)
SKIN = (0.87, 0.77, 0.70)
CLOTH = [(0.95, 0.94, 0.91), (0.37, 0.47, 0.62), (0.76, 0.55, 0.41), (0.55, 0.65, 0.55)]  # from the inside out
SUPERSAMPLES = 2
INK = (0.2, 0.2, 0.22)


def read_ply(path):
    """Vertex columns by name, and triangles, of a binary little-endian PLY file."""
    data = pathlib.Path(path).read_bytes()
    end = data.index(b"end_header\n") + len(b"end_header\n")
    elements = []
    for words in (line.split() for line in data[:end].decode("ascii").splitlines()):
        if words[0] == "format" and words[1] != "binary_little_endian":
            raise SystemExit(f"draw-dressed: {path}: {words[1]}; only binary little-endian PLY files can be drawn")
        if words[0] == "element":
            elements.append((words[1], int(words[2]), []))
        elif words[0] == "property":
            elements[-1][2].append(words[1:])
    vertices = triangles = None
    for name, count, properties in elements:
        if name == "vertex":
            dtype = np.dtype([(p[1], PLY_TYPES[p[0]]) for p in properties])
            vertices = np.frombuffer(data, dtype, count, end)
        elif name == "face":
            fields = []
            for p in properties:
                fields += [("n", PLY_TYPES[p[1]]), ("v", PLY_TYPES[p[2]], 3)] if p[0] == "list" else [(p[1], PLY_TYPES[p[0]])]
            dtype = np.dtype(fields)
            triangles = np.frombuffer(data, dtype, count, end)["v"].astype(np.int64)
        else:
            break
        end += dtype.itemsize * count
    return vertices, triangles


def polydata(path, column=None):
    vertices, triangles = read_ply(path)
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.column_stack([vertices[c] for c in "xyz"]).astype(float), deep=True))
    cells = vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(triangles.ravel(), deep=True))
    mesh = vtkPolyData()
    mesh.SetPoints(points)
    mesh.SetPolys(cells)
    if column:
        values = numpy_to_vtk(np.asarray(vertices[column], dtype=float), deep=True)
        values.SetName(column)
        mesh.GetPointData().SetScalars(values)
    return mesh


def smooth(mesh):
    """The mesh with one normal for each vertex, so that facets do not show."""
    normals = vtkPolyDataNormals()
    normals.SetInputData(mesh)
    normals.SplittingOff()
    normals.ConsistencyOff()
    normals.Update()
    return normals.GetOutput()


def actor_of(mesh, colour):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(smooth(mesh))
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetInterpolationToPhong()
    look.SetColor(colour)
    look.SetAmbient(0.30)
    look.SetDiffuse(0.78)
    look.SetSpecular(0.06)
    look.SetSpecularPower(12)
    return actor


class FitMap:
    """Colours of ease, strain or pressure, and their legend. One garment's cloth is seen: the outermost."""

    TITLES = {"ease": ("ease, cm", 100), "strain": ("strain, %", 100), "pressure": ("pressure, Pa", 1)}

    def __init__(self, name, values):
        self.title, self.factor = self.TITLES[name]
        # All but a twentieth of the values lie below, so that a few do not wash out the rest.
        high = self.factor * float(np.quantile(np.abs(values), 0.95))
        low = -high if name == "strain" else 0.0
        self.table = vtkLookupTable()
        self.table.SetNumberOfTableValues(256)
        self.table.SetRange(low, high)
        stops = np.array([(0.70, 0.13, 0.17), (0.94, 0.54, 0.38), (0.97, 0.90, 0.70), (0.57, 0.77, 0.78), (0.16, 0.40, 0.62)])
        if name != "ease":
            stops = stops[::-1]
        for i in range(256):
            t = i / 255 * (len(stops) - 1)
            k = min(int(t), len(stops) - 2)
            self.table.SetTableValue(i, *(stops[k] + (t - k) * (stops[k + 1] - stops[k])), 1)

    def colour(self, actor):
        values = actor.GetMapper().GetInput().GetPointData().GetScalars()
        for i in range(values.GetNumberOfValues()):
            values.SetValue(i, self.factor * values.GetValue(i))
        actor.GetMapper().ScalarVisibilityOn()
        actor.GetMapper().SetLookupTable(self.table)
        actor.GetMapper().UseLookupTableScalarRangeOn()

    def legend(self, scale):
        bar = vtkScalarBarActor()
        bar.SetLookupTable(self.table)
        bar.SetTitle(self.title)
        bar.SetNumberOfLabels(5)
        bar.SetLabelFormat("{:.0f}" if self.table.GetRange()[1] > 10 else "{:.1f}")
        bar.UnconstrainedFontSizeOn()
        for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
            text.SetColor(INK)
            text.ShadowOff()
            text.ItalicOff()
            text.BoldOff()
            text.SetFontSize(int(22 * scale))
        bar.SetVerticalTitleSeparation(int(14 * scale))
        bar.SetPosition(0.25, 0.24)
        bar.SetPosition2(0.6, 0.52)
        bar.SetBarRatio(0.28)
        return bar


def light(renderer, turn, height, intensity, colour):
    lamp = vtkLight()
    lamp.SetLightTypeToCameraLight()
    lamp.SetPosition(np.sin(np.radians(turn)), height, np.cos(np.radians(turn)))
    lamp.SetFocalPoint(0, 0, 0)
    lamp.SetIntensity(intensity)
    lamp.SetColor(colour)
    renderer.AddLight(lamp)


def light_softly(renderer):
    """Key, fill and rim light, and the shade of near surfaces."""
    renderer.AutomaticLightCreationOff()
    light(renderer, -38, 0.75, 0.72, (1, 0.98, 0.95))
    light(renderer, 50, 0.2, 0.36, (0.93, 0.96, 1))
    light(renderer, 165, 0.9, 0.25, (1, 1, 1))
    shade = vtkSSAOPass()
    shade.SetRadius(0.06)
    shade.SetBias(0.006)
    shade.SetKernelSize(192)
    shade.BlurOn()
    shade.SetDelegatePass(vtkRenderStepsPass())
    renderer.SetPass(shade)


def box_of(actors):
    """Lowest and highest corner."""
    bounds = np.array([actor.GetBounds() for actor in actors])
    return bounds[:, 0::2].min(axis=0), bounds[:, 1::2].max(axis=0)


def aim(renderer, centre, extent, turn, aspect):
    """A long lens, so that front and side are seen at one scale."""
    angle = 14
    half = max(extent[1], extent[0] / aspect) / 2 * 1.06
    distance = half / np.tan(np.radians(angle / 2)) + extent[2] / 2
    camera = renderer.GetActiveCamera()
    camera.SetViewAngle(angle)
    camera.SetFocalPoint(centre)
    camera.SetPosition(centre + distance * np.array([np.sin(np.radians(turn)), 0.06, np.cos(np.radians(turn))]))
    camera.SetViewUp(0, 1, 0)
    renderer.ResetCameraClippingRange()


def caption(text, scale):
    actor = vtkTextActor()
    actor.SetInput(text)
    style = actor.GetTextProperty()
    style.SetFontSize(int(22 * scale))
    style.SetColor(INK)
    style.SetJustificationToCentered()
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(0.5, 0.015)
    return actor


def write_png(window, path):
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    width, height = window.GetSize()
    resize = vtkImageResize()
    resize.SetInputConnection(grab.GetOutputPort())
    resize.SetOutputDimensions(width // SUPERSAMPLES, height // SUPERSAMPLES, 1)
    writer = vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetInputConnection(resize.GetOutputPort())
    writer.Write()


def panels_of(folder, options):
    """Pairs of actors and caption, in the order in which they are drawn."""
    garments = json.loads((folder / "rig.json").read_text())["garments"]
    names = [str(pathlib.Path(g["file"]).with_suffix(".ply")) for g in garments]
    panels = []
    if options.given:
        body, *given = options.given
        panels.append(([actor_of(polydata(body), SKIN)], "body", options.turns[0]))
        panels.append(([actor_of(polydata(g), CLOTH[i]) for i, g in enumerate(given)],
                       "garments as given" if len(given) > 1 else "garment as given", options.turns[0]))
    actors = [actor_of(polydata(folder / "body.ply"), SKIN)]
    sources = folder / "maps" if options.map else folder
    for i, name in enumerate(names):
        actors.append(actor_of(polydata(sources / name, options.map), CLOTH[i % len(CLOTH)]))
    for turn in options.turns:
        panels.append((actors, "dressed" if options.given else "", turn))
    return panels, actors[1:]


def draw(folder, options):
    panels, cloth = panels_of(folder, options)
    shown = None
    if options.map:
        shown = FitMap(options.map, np.concatenate([read_ply(p)[0][options.map] for p in sorted((folder / "maps").glob("*.ply"))]))
        for actor in cloth:
            shown.colour(actor)
    scale = SUPERSAMPLES * options.height / 1000
    width = int(options.height * options.aspect)
    legend_width = int(0.26 * options.height) if shown else 0
    total = width * len(panels) + legend_width
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(SUPERSAMPLES * total, SUPERSAMPLES * options.height)
    boxes = [box_of(actors) for actors, _, _ in panels]
    extent = np.max([high - low for low, high in boxes], axis=0)  # one scale for all
    for k, (actors, text, turn) in enumerate(panels):
        renderer = vtkRenderer()
        renderer.SetViewport(k * width / total, 0, (k + 1) * width / total, 1)
        renderer.SetBackground(BACKGROUND)
        for actor in actors:
            renderer.AddActor(actor)
        if text:
            renderer.AddViewProp(caption(text, scale))
        light_softly(renderer)
        window.AddRenderer(renderer)
        low, high = boxes[k]
        aim(renderer, (low + high) / 2, extent, turn, options.aspect)
    if shown:
        renderer = vtkRenderer()
        renderer.SetViewport(width * len(panels) / total, 0, 1, 1)
        renderer.SetBackground(BACKGROUND)
        renderer.AddViewProp(shown.legend(scale))
        window.AddRenderer(renderer)
    write_png(window, options.output)


def main():
    parser = argparse.ArgumentParser(prog="draw-dressed", description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="what garmentfit dress wrote")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="PNG file")
    parser.add_argument("--map", choices=sorted(FitMap.TITLES), help="colours the cloth by it, with a legend")
    parser.add_argument("--given", nargs="+", metavar="FILE", help="body and garments as given, drawn first")
    parser.add_argument("--turns", type=lambda t: [float(x) for x in t.split(",")], default=[0.0, 40.0],
                        help="degrees that the viewer walks round to the figure's left, one picture each")
    parser.add_argument("--height", type=int, default=1000, help="pixels")
    parser.add_argument("--aspect", type=float, default=0.62, help="width of one picture by its height")
    options = parser.parse_args()
    draw(options.folder, options)


if __name__ == "__main__":
    main()
