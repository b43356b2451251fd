# SPDX-License-Identifier: GPL-3.0-or-later
"""The four steps as a pipeline of plain VTK, drawn in four frames of the return to the body's input pose.

    python pipeline.py PICTURE.png BODY.ply GARMENT.ply TYPE
"""
import sys

from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkRenderingCore import (vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                         vtkWindowToImageFilter)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (draws)

from garmentfit.vtk import DrapeGarment, FitSkeleton, RecoverPose, RigBody

FRAMES = 4


def reader(path):
    ply = vtkPLYReader()
    ply.SetFileName(path)
    return ply


def chain(body, garment, type_):
    rig, fit, drape, recover = RigBody(), FitSkeleton(type=type_), DrapeGarment(), RecoverPose(frames=FRAMES)
    rig.SetInputConnection(body.GetOutputPort())
    fit.SetInputConnection(0, rig.GetOutputPort())
    fit.SetInputConnection(1, garment.GetOutputPort())
    for above, below in ((fit, drape), (drape, recover)):
        below.SetInputConnection(0, above.GetOutputPort(0))
        below.SetInputConnection(1, above.GetOutputPort(1))
    return [rig, fit, drape, recover]  # the last one keeps the others alive


def actor(data, color):
    mapper, drawn = vtkPolyDataMapper(), vtkActor()
    mapper.SetInputDataObject(data)
    mapper.ScalarVisibilityOff()
    drawn.SetMapper(mapper)
    drawn.GetProperty().SetColor(color)
    return drawn


def draw_frame(recover, i):
    recover.UpdateTimeStep(i / (FRAMES - 1))
    renderer = vtkRenderer()
    renderer.SetViewport(i / FRAMES, 0, (i + 1) / FRAMES, 1)
    renderer.SetBackground(1, 1, 1)
    for port, color in ((0, (0.87, 0.72, 0.6)), (1, (0.2, 0.35, 0.6))):
        now = recover.GetOutput(port).NewInstance()
        now.ShallowCopy(recover.GetOutput(port))
        renderer.AddActor(actor(now, color))
    renderer.GetActiveCamera().SetPosition(1.2, 0.4, 3)
    renderer.ResetCamera()
    return renderer


def main(picture, body, garment, type_):
    sources = reader(body), reader(garment)  # VTK's Python does not keep producers alive
    steps = chain(*sources, type_)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(1600, 700)
    for i in range(FRAMES):
        window.AddRenderer(draw_frame(steps[-1], i))
    window.Render()
    pixels, writer = vtkWindowToImageFilter(), vtkPNGWriter()
    pixels.SetInput(window)
    writer.SetInputConnection(pixels.GetOutputPort())
    writer.SetFileName(picture)
    writer.Write()


if __name__ == "__main__":
    main(*sys.argv[1:])
