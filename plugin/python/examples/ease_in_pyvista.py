# SPDX-License-Identifier: GPL-3.0-or-later
# %% [markdown]
# # How a garment sits: ease in PyVista
# A body, and a coat made for somebody else. Run it cell by cell in a notebook, or as
# `python ease_in_pyvista.py [PICTURE.png [BODY GARMENT TYPE]]` from the repository's root.

# %%
import sys

import pyvista as pv

from garmentfit.vtk import DressBody

picture = sys.argv[1] if len(sys.argv) > 1 else None
body, garment, type_ = sys.argv[2:5] or ("docs/samples/walking_woman.ply", "docs/samples/coat.ply", "coat")

# %% The pipeline. It computes nothing yet.
dress = DressBody(type=type_, fabric="wool")
dress.SetInputData(0, pv.read(body))
dress.SetInputData(1, pv.read(garment))

# %% It runs when the plotter asks for it. Blue touches the skin, red has five centimetres of ease.
plotter = pv.Plotter(shape=(1, 2), off_screen=picture is not None, window_size=(1200, 900), border=False)
for column, azimuth in enumerate((20, 200)):
    plotter.subplot(0, column)
    plotter.add_mesh(dress.GetOutputPort(0), color="#d9b38c", smooth_shading=True)
    plotter.add_mesh(dress.GetOutputPort(1), scalars="Ease", clim=(0, 0.05), cmap="turbo", smooth_shading=True,
                     show_scalar_bar=column == 1,
                     scalar_bar_args={"title": "ease, m", "vertical": True, "position_x": 0.85})
    plotter.view_xy()
    plotter.camera.azimuth = azimuth
    plotter.camera.zoom(1.35)
plotter.show(screenshot=picture)

# %% The certificate is part of the output.
dressed = pv.wrap(dress.GetOutput(1)).field_data
print({name: dressed[name][0] for name in ("BodyCrossings", "SelfCrossings", "GarmentMinDistance", "StrainP95")})
for place, skin, cloth in zip(dressed["GirthPlace"], dressed["GirthBody"], dressed["GirthGarment"]):
    print(f"{place}: body {skin:.2f} m, garment {cloth:.2f} m")
