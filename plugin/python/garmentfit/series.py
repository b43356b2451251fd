# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the outputs of a filter with time steps as a series of files.

>>> from garmentfit.series import write_series
>>> write_series(dress, "dressing.pvd")  # ParaView and PyVista read it
"""
from __future__ import annotations

import os
from pathlib import Path
from typing import Any, List, Tuple, Union
from xml.sax.saxutils import quoteattr

from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet, vtkMultiBlockDataSet
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter

from ._errors import invalid_input


def write_series(filter_: Any, path: Union[str, "os.PathLike[str]"]) -> List[Path]:
    """Writes all outputs at each of the filter's time steps as NAME_0000.vtm, ... beside NAME.pvd, which lists them.

    Works with any vtkAlgorithm. The files are in VTK's binary mode, which ParaView 5.11 of Debian 12 can read.
    Returns the paths of the .vtm files.
    """
    path = Path(path)
    if path.suffix != ".pvd":
        raise invalid_input("wrong_call", f"{path} does not end in .pvd; give a name that does")
    written = [(time, _write(filter_, time, path.with_name(f"{path.stem}_{i:04}.vtm")))
               for i, time in enumerate(_times_of(filter_))]
    path.write_text(_collection(written), encoding="utf-8")
    return [file for _, file in written]


def _times_of(filter_: Any) -> List[float]:
    filter_.UpdateInformation()
    _require_success(filter_)
    information, key = filter_.GetOutputInformation(0), vtkStreamingDemandDrivenPipeline.TIME_STEPS()
    if not information.Has(key):
        raise invalid_input("wrong_call", f"{filter_.GetClassName()} has no time steps; set frames to their number")
    return [information.Get(key, i) for i in range(information.Length(key))]


def _require_success(filter_: Any) -> None:
    if line := getattr(filter_, "error", None):  # of the filters of garmentfit.vtk
        raise invalid_input(filter_.error_name, line)


def _write(filter_: Any, time: float, file: Path) -> Path:
    updated = filter_.UpdateTimeStep(time)
    _require_success(filter_)
    if not updated or filter_.GetAbortExecute():
        raise invalid_input("missing_input",
                            f"{filter_.GetClassName()} has no output at time {time}; {file} is not written")
    outputs = vtkMultiBlockDataSet()
    ports = filter_.GetNumberOfOutputPorts()
    for port, name in enumerate(("body", "garments", "skeleton") if ports == 3 else map(str, range(ports))):
        outputs.SetBlock(port, filter_.GetOutputDataObject(port))
        outputs.GetMetaData(port).Set(vtkCompositeDataSet.NAME(), name)
    writer = vtkXMLMultiBlockDataWriter()
    writer.SetInputData(outputs)
    writer.SetFileName(str(file))
    writer.SetDataModeToBinary()
    if writer.Write() != 1:
        raise invalid_input("unwritable_file", f"cannot write {file}")
    return file


def _collection(written: List[Tuple[float, Path]]) -> str:
    entries = "".join(f"    <DataSet timestep={quoteattr(repr(time))} part=\"0\" file={quoteattr(file.name)}/>\n"
                      for time, file in written)
    return f'<VTKFile type="Collection" version="0.1">\n  <Collection>\n{entries}  </Collection>\n</VTKFile>\n'
