# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads the plugin into pvpython, dresses a body, steps through time, writes a series, renders.

    pvpython TestPlugin.py PLUGIN.so BODY.ply SKIRT.ply FOLDER
"""
import os
import sys

from paraview import servermanager
from paraview.simple import *  # noqa: F401,F403  (ParaView's filters and the plugin's)

plugin, body_file, skirt_file, folder = sys.argv[1:5]
LoadPlugin(plugin, ns=globals())

body = PLYReader(FileNames=[body_file])
skirt = PLYReader(FileNames=[skirt_file])
dress = DressBody(Body=body, Garments=skirt, Type="skirt", SettlingSteps=2, RecoverySettlingSteps=2, Quality="draft", Frames=3)
assert list(dress.TimestepValues) == [0, 0.5, 1], dress.TimestepValues
assert dress.ContactDistance == 0.0025
assert dress.Density == "of the fabric"

dress.UpdatePipeline(1)
dressed = servermanager.Fetch(dress, idx=1)
assert dressed.GetNumberOfPoints() == 3055
assert dressed.GetFieldData().GetArray("BodyCrossings").GetValue(0) == 0
assert dressed.GetPointData().GetArray("Ease") is not None
at_end = dressed.GetPoint(0)
dress.UpdatePipeline(0)
assert servermanager.Fetch(dress, idx=1).GetPoint(0) != at_end

series = os.path.join(folder, "skirt.pvd")
SaveData(series, proxy=OutputPort(dress, 1), WriteTimeSteps=1, DataMode="Binary")
back = PVDReader(FileName=series)
assert list(back.TimestepValues) == [0, 0.5, 1], back.TimestepValues
for time in back.TimestepValues:
    dress.UpdatePipeline(time)
    back.UpdatePipeline(time)
    written, read = servermanager.Fetch(dress, idx=1), servermanager.Fetch(back)
    assert memoryview(written.GetPoints().GetData()).tobytes() == memoryview(read.GetPoints().GetData()).tobytes(), time
    for name in ("Ease", "RestPosition"):
        kept = [memoryview(data.GetPointData().GetArray(name)).tobytes() for data in (written, read)]
        assert kept[0] == kept[1], name

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
