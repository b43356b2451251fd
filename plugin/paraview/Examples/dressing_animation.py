# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the return of a dressed body to its input pose: one picture for each time step, and one with four of them.

    xvfb-run -a -s "-noreset -screen 0 1280x1024x24" \\
        pvbatch dressing_animation.py PLUGIN.so BODY.ply GARMENT.ply TYPE FOLDER
"""
import os
import sys

import numpy as np
from paraview.simple import *  # noqa: F401,F403  (ParaView's filters and the plugin's)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

FRAMES, SHOWN = 10, (0, 3, 6, 9)


def pipeline(body, garment, garment_type):
    return DressBody(Body=PLYReader(FileNames=[body]), Garments=PLYReader(FileNames=[garment]), Type=garment_type,
                     Frames=FRAMES)


def view_of(dress):
    view = CreateView("RenderView")
    view.ViewSize = [420, 700]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    Show(OutputPort(dress, 0), view).DiffuseColor = [0.87, 0.72, 0.6]
    ColorBy(Show(OutputPort(dress, 1), view), ("POINTS", "Ease"))
    GetColorTransferFunction("Ease").RescaleTransferFunction(0, 0.05)  # m
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [1.2, 1.0, 3.4], [0, 0.8, 0], [0, 1, 0]
    return view


def render(view, times, folder):
    pictures = []
    for i, time in enumerate(times):
        view.ViewTime = time
        pictures.append(os.path.join(folder, f"dressing_{i:02}.png"))
        SaveScreenshot(pictures[-1], view)
    return pictures


def pixels_of(picture):
    reader = vtkPNGReader()
    reader.SetFileName(picture)
    reader.Update()
    image = reader.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)


def side_by_side(pictures, path):
    row = np.hstack([pixels_of(picture) for picture in pictures])
    image, writer = vtkImageData(), vtkPNGWriter()
    image.SetDimensions(row.shape[1], row.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(row.reshape(-1, row.shape[2]), deep=1))
    writer.SetInputData(image)
    writer.SetFileName(path)
    writer.Write()


def main(plugin, body, garment, garment_type, folder):
    LoadPlugin(plugin, ns=globals())
    dress = pipeline(body, garment, garment_type)
    pictures = render(view_of(dress), dress.TimestepValues, folder)
    side_by_side([pictures[i] for i in SHOWN], os.path.join(folder, "dressing.png"))


main(*sys.argv[1:])
