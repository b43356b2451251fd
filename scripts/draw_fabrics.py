# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the tables of docs/fabrics.md and draws the draped discs of three fabrics. Called by scripts/draw-fabrics."""

import csv
import pathlib
import sys

import numpy as np
from draw_dressed import BACKGROUND, CLOTH, SUPERSAMPLES, caption, light, write_png
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkFiltersSources import vtkCylinderSource
from vtkmodules.vtkIOGeometry import vtkOBJReader
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow

PAGE = pathlib.Path("docs/fabrics.md")
SHOWN = [("jersey", 1), ("wool", 3), ("denim", 2)]  # fabric, colour
VIEWS = [(0.0, 0.28, 0.96), (0.0, 1.0, 0.001)]  # from the side and from above


def actor_of(source, colour, feature_angle=80):
    normals = vtkPolyDataNormals()
    normals.SetInputConnection(source.GetOutputPort())
    normals.SetFeatureAngle(feature_angle)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(colour)
    return actor


def disc_of(path, colour):
    reader = vtkOBJReader()
    reader.SetFileName(str(path))
    return actor_of(reader, colour)


def support():
    cylinder = vtkCylinderSource()
    cylinder.SetRadius(0.0895)
    cylinder.SetHeight(0.01)
    cylinder.SetCenter(0, -0.0065, 0)
    cylinder.SetResolution(90)
    return actor_of(cylinder, (0.6, 0.6, 0.62), 30)


def aim(renderer, view):
    camera = renderer.GetActiveCamera()
    camera.SetViewAngle(14)
    camera.SetFocalPoint(0, -0.02, 0)
    camera.SetPosition(1.45 * np.array(view) / np.linalg.norm(view))
    camera.SetViewUp(0, 1, 0) if view[1] < 0.9 else camera.SetViewUp(0, 0, -1)
    renderer.ResetCameraClippingRange()


def draw(folder, rows, path, size=400):
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(SUPERSAMPLES * size * len(SHOWN), SUPERSAMPLES * size * len(VIEWS))
    for i, (fabric, colour) in enumerate(SHOWN):
        for k, view in enumerate(VIEWS):
            renderer = vtkRenderer()
            renderer.SetViewport(i / len(SHOWN), 1 - (k + 1) / len(VIEWS), (i + 1) / len(SHOWN), 1 - k / len(VIEWS))
            renderer.SetBackground(BACKGROUND)
            renderer.AddActor(disc_of(folder / f"{fabric}.obj", CLOTH[colour]))
            renderer.AddActor(support())
            if k == len(VIEWS) - 1:
                percent = 100 * float(rows[fabric]["drape_30"])
                renderer.AddViewProp(caption(f"{fabric}: {percent:.0f} %", SUPERSAMPLES * size / 500))
            renderer.AutomaticLightCreationOff()
            light(renderer, -50, 0.9, 0.75, (1, 0.98, 0.95))
            light(renderer, 60, 0.1, 0.3, (0.93, 0.96, 1))
            window.AddRenderer(renderer)
            aim(renderer, view)
    write_png(window, path)


def published():
    """{fabric: {quantity: (low, high, source)}}"""
    result = {}
    with open("docs/fabrics.csv", newline="") as file:
        for row in csv.DictReader(file):
            result.setdefault(row["fabric"], {})[row["quantity"]] = (float(row["low"]), float(row["high"]), row["source"])
    return result


def percent(share):
    return f"{100 * float(share):.0f} %"


def measured_table(rows, known):
    lines = ["| fabric | bending: figure, cantilever, published, N m | drape 24 cm | 30 cm | published | 36 cm | folds |",
             "| --- | --- | --- | --- | --- | --- | --- |"]
    for name, row in rows.items():
        bend, drape = known[name]["bend_stiffness"], known[name]["drape_30"]
        lines.append(
            f"| {name} | {float(row['bend_stiffness']):.2g}, {float(row['cantilever']):.2g}, {bend[0]:.2g} to {bend[1]:.2g} | "
            f"{percent(row['drape_24'])} | {percent(row['drape_30'])} | {percent(drape[0])} to {percent(drape[1])} | "
            f"{percent(row['drape_36'])} | {row['nodes_30']} |")
    return "\n".join(lines)


def moduli_table(rows):
    lines = ["| fabric | tension over stretch at 1 %, N/m | at 10 % | shear, N/m | Poisson's ratio |",
             "| --- | --- | --- | --- | --- |"]
    for name, row in rows.items():
        lines.append(f"| {name} | {float(row['young_1']):.0f} | {float(row['young_10']):.0f} | {float(row['shear']):.0f} | "
                     f"{float(row['poisson']):.2f} |")
    return "\n".join(lines)


def sources_table(known):
    quantities = ["density", "bend_stiffness", "largest_stretch", "thickness", "weft_to_warp", "shear_stiffness",
                  "drape_30"]
    lines = ["| fabric | quantity | from | to | source |", "| --- | --- | --- | --- | --- |"]
    for quantity in quantities:
        for name, of_fabric in known.items():
            low, high, source = of_fabric[quantity]
            lines.append(f"| {name} | {quantity} | {low:.3g} | {high:.3g} | {source} |")
    return "\n".join(lines)


def put(page, name, table):
    begin, end = f"<!-- {name}: written by scripts/draw-fabrics -->", f"<!-- end of {name} -->"
    head, rest = page.split(begin)
    return f"{head}{begin}\n\n{table}\n\n{end}{rest.split(end)[1]}"


def main():
    folder = pathlib.Path(sys.argv[1])
    with open(folder / "trials.csv", newline="") as file:
        rows = {row["fabric"]: row for row in csv.DictReader(file)}
    known = published()
    page = PAGE.read_text()
    page = put(page, "measured", measured_table(rows, known))
    page = put(page, "moduli", moduli_table(rows))
    page = put(page, "sources", sources_table(known))
    PAGE.write_text(page)
    draw(folder, rows, "docs/images/fabrics-drape.png")


if __name__ == "__main__":
    main()
