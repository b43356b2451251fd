# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads the plugin into pvpython, dresses, goes through time, draws.   pvpython TestPlugin.py PLUGIN.so SAMPLES FOLDER"""
import os
import sys

from paraview import servermanager
from paraview.simple import *  # noqa: F401,F403  (ParaView's filters and ours arrive here)

plugin, samples, folder = sys.argv[1:4]
LoadPlugin(plugin, ns=globals())

body = PLYReader(FileNames=[os.path.join(samples, "walking_woman.ply")])
skirt = PLYReader(FileNames=[os.path.join(samples, "skirt.ply")])
dress = DressBody(Body=body, Garments=skirt, Type="skirt", SettlingSteps=2, RecoverySettlingSteps=2, Frames=3)
assert list(dress.TimestepValues) == [0, 0.5, 1], dress.TimestepValues
assert dress.ContactDistance == 0.0025

dress.UpdatePipeline(1)
dressed = servermanager.Fetch(dress, idx=1)
assert dressed.GetNumberOfPoints() == 3055
assert dressed.GetFieldData().GetArray("BodyCrossings").GetValue(0) == 0
assert dressed.GetPointData().GetArray("Ease") is not None
at_end = dressed.GetPoint(0)
dress.UpdatePipeline(0)
assert servermanager.Fetch(dress, idx=1).GetPoint(0) != at_end

rig = RigBody(Body=body)
rig.UpdatePipeline()
assert servermanager.Fetch(rig, idx=1).GetNumberOfLines() == 22

view = CreateView("RenderView")
view.ViewSize = [500, 700]
Show(OutputPort(dress, 0), view).DiffuseColor = [0.87, 0.72, 0.6]
ColorBy(Show(OutputPort(dress, 1), view), ("POINTS", "Ease"))
view.ViewTime = 1
ResetCamera(view)
picture = os.path.join(folder, "paraview.png")
SaveScreenshot(picture, view)
assert os.path.getsize(picture) > 5000
print("dressed in", GetParaViewVersion())
