# SPDX-License-Identifier: GPL-3.0-or-later
"""One garment on several bodies: the same pipeline, another input each time, side by side.

    python five_bodies.py PICTURE.png GARMENT TYPE BODY BODY ...
"""
import sys
import textwrap

import pyvista as pv

from garmentfit.vtk import DressBody


def dressed(dress, path):
    """Body, garment and one line on the result."""
    dress.SetInputData(0, pv.read(path))
    dress.Update()
    if dress.error:
        raise SystemExit(f"{path}: {dress.error}")
    body, garment = (pv.wrap(dress.GetOutput(port)).copy(deep=False) for port in (0, 1))
    return body, garment, body.field_data["Note"][0] or f"median strain {garment.field_data['StrainMedian'][0]:.1%}"


def draw(plotter, body, garment, note):
    plotter.add_mesh(body, color="#d9b38c", smooth_shading=True)
    plotter.add_mesh(garment, scalars="Ease", clim=(0, 0.05), cmap="turbo", smooth_shading=True, show_scalar_bar=False)
    plotter.add_text("\n".join(textwrap.wrap(note, 44)), position=(10, 470), font_size=7, color="black")
    plotter.view_xy()
    plotter.camera.azimuth = 20
    plotter.camera.zoom(1.18)


def main(picture, garment, type_, bodies):
    dress = DressBody(type=type_)
    dress.SetInputData(1, pv.read(garment))
    plotter = pv.Plotter(shape=(1, len(bodies)), off_screen=True, window_size=(360 * len(bodies), 540), border=False)
    for column, path in enumerate(bodies):
        plotter.subplot(0, column)
        draw(plotter, *dressed(dress, path))
    plotter.screenshot(picture)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], sys.argv[3], sys.argv[4:])
