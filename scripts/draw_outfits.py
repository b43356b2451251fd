# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws outfits in poses that other programs would give them: a row for each outfit, a column for each pose.

Run by scripts/draw-outfits. Poses and linear blend skinning are those of the benchmark posed_outfits.
"""

import argparse
import json
import pathlib
import subprocess
import tempfile

import numpy as np
from draw_dressed import (
    BACKGROUND, CLOTH, SKIN, SUPERSAMPLES, actor_of, aim, box_of, caption, light_softly, polydata, write_png)
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

POSES = ["stand", "walk 0", "walk 2", "walk 4", "walk 6", "reach up", "sit", "knee up"]


def posed(program, outfit, folder):
    """Actors of body and clothes for each pose. The body is without its covered skin."""
    report = json.loads((outfit / "report.json").read_text())
    names = [garment["file"] for garment in report["garments"]]
    rows = {pose: [] for pose in POSES}
    for i, name in enumerate(names):
        subprocess.run([program, outfit / "body.ply", outfit / "rest" / name, outfit / name, folder], check=True,
                       stdout=subprocess.DEVNULL)
        for pose, actors in rows.items():
            if i == 0:
                actors.append(actor_of(polydata(folder / f"{pose} shown.ply"), SKIN))
            actors.append(actor_of(polydata(folder / f"{pose} ours.ply"), CLOTH[(i + 1) % len(CLOTH)]))
    return rows


def draw(rows, output, height, turn):
    width = int(0.62 * height)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(SUPERSAMPLES * width * len(POSES), SUPERSAMPLES * height * len(rows))
    for r, (name, poses) in enumerate(rows.items()):
        boxes = {pose: box_of(actors) for pose, actors in poses.items()}
        extent = np.max([high - low for low, high in boxes.values()], axis=0)
        for c, (pose, actors) in enumerate(poses.items()):
            renderer = vtkRenderer()
            renderer.SetViewport(c / len(POSES), 1 - (r + 1) / len(rows), (c + 1) / len(POSES), 1 - r / len(rows))
            renderer.SetBackground(BACKGROUND)
            for actor in actors:
                renderer.AddActor(actor)
            renderer.AddViewProp(caption(f"{name}, {pose}", SUPERSAMPLES * height / 420))
            light_softly(renderer)
            window.AddRenderer(renderer)
            low, high = boxes[pose]
            aim(renderer, (low + high) / 2, extent, turn, width / height)
    write_png(window, output)


def main():
    parser = argparse.ArgumentParser(prog="draw-outfits", description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path, help="posed_outfits")
    parser.add_argument("outfits", nargs="+", metavar="NAME=FOLDER", help="what garmentfit dress wrote")
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True, help="PNG file")
    parser.add_argument("--height", type=int, default=250, help="pixels of one picture")
    parser.add_argument("--turn", type=float, default=30, help="degrees that the viewer walks round to the left")
    options = parser.parse_args()
    rows = {}
    for outfit in options.outfits:
        name, _, folder = outfit.partition("=")
        with tempfile.TemporaryDirectory() as poses:
            rows[name] = posed(options.program, pathlib.Path(folder), pathlib.Path(poses))
    draw(rows, options.output, options.height, options.turn)


if __name__ == "__main__":
    main()
