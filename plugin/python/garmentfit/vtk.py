# SPDX-License-Identifier: GPL-3.0-or-later
"""The filters for VTK pipelines in Python: pip's VTK, Debian's, and PyVista.

Ports and arrays are those of the C++ filters (docs/vtk.md): port 0 is the body, port 1 the garments, the last port the
skeleton. Parameters are attributes with the names of the schema, or keyword arguments:

>>> from garmentfit.vtk import DressBody
>>> dress = DressBody(type="skirt")
>>> dress.SetInputConnection(0, body.GetOutputPort())
>>> dress.SetInputConnection(1, skirt.GetOutputPort())
>>> plotter.add_mesh(dress.GetOutputPort(1), scalars="Ease")  # PyVista
"""
from __future__ import annotations

import inspect
import math
import sys
import time
from numbers import Integral
from types import MappingProxyType
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple

import numpy as np
from vtkmodules.numpy_interface import dataset_adapter  # noqa: F401  (numpy must be there before util.numpy_support)
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkCompositeDataSet, vtkDataObject, vtkPolyData)
from vtkmodules.vtkCommonExecutionModel import (vtkDemandDrivenPipeline, vtkExecutive,
                                                vtkStreamingDemandDrivenPipeline)

from . import _core
from ._core import Cancelled, InvalidInput, SolverFailure
from ._errors import invalid_input
from ._meshes import Mesh
from ._parameters import lines_on, with_keywords

# ---- between VTK's arrays and numpy's --------------------------------------------------------------------------

def _put(attributes: Any, name: str, values: Any) -> None:
    """Adds numbers without a copy, or texts."""
    if isinstance(values, list):
        array = vtkStringArray()
        for text in values:
            array.InsertNextValue(text)
    else:
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=0)
    array.SetName(name)
    attributes.AddArray(array)


def _put_all(data: vtkPolyData, arrays: Dict[str, Dict[str, Any]]) -> None:
    places = {"points": data.GetPointData(), "cells": data.GetCellData(), "field": data.GetFieldData()}
    for kind, attributes in places.items():
        for name, values in arrays[kind].items():
            _put(attributes, name, values)


def _numbers(attributes: Any, name: str) -> Optional[np.ndarray]:
    array = attributes.GetArray(name)
    if array is None:
        return None
    values = vtk_to_numpy(array).astype(np.float64, copy=False)
    return np.ascontiguousarray(values.reshape(len(values), -1))


def _find_in(data: vtkPolyData) -> Callable[[str], Optional[np.ndarray]]:
    """Returns a function that finds an array by name among those of points and of the field."""
    def find(name: str) -> Optional[np.ndarray]:
        found = _numbers(data.GetPointData(), name)
        return _numbers(data.GetFieldData(), name) if found is None else found
    return find


def mesh_of(data: vtkPolyData, what: str, kept: str = "") -> Tuple[np.ndarray, np.ndarray]:
    """Points, or those of the array `kept`, and polygons as fans of triangles."""
    if data.GetNumberOfPolys() == 0 or data.GetNumberOfStrips() or data.GetNumberOfPoints() == 0:
        raise invalid_input("no_faces",
                            f"{what} has {data.GetNumberOfPolys()} polygons, {data.GetNumberOfPoints()} points, "
                            f"{data.GetNumberOfLines()} lines and {data.GetNumberOfStrips()} strips; give a surface "
                            "of polygons, and convert strips with vtkTriangleFilter")
    points = vtk_to_numpy(data.GetPoints().GetData())
    own = _numbers(data.GetPointData(), kept) if kept else None
    positions = own if own is not None and own.shape == points.shape else points
    return np.ascontiguousarray(positions, dtype=np.float64), _fans(data.GetPolys())


def uvs_of(data: vtkPolyData) -> Optional[np.ndarray]:
    """Texture coordinates of the points, n x 2."""
    array = data.GetPointData().GetTCoords()
    if array is None or array.GetNumberOfComponents() < 2:
        return None
    return np.asarray(vtk_to_numpy(array)[:, :2], dtype=np.float64)


def _fans(polygons: vtkCellArray) -> np.ndarray:
    corners = vtk_to_numpy(polygons.GetConnectivityArray())
    offsets = vtk_to_numpy(polygons.GetOffsetsArray())
    if np.all(np.diff(offsets) == 3):
        return corners.reshape(-1, 3).astype(np.int32, copy=False)
    fans = [(corners[a], corners[k - 1], corners[k]) for a, b in zip(offsets, offsets[1:]) for k in range(a + 2, b)]
    return np.array(fans, dtype=np.int32).reshape(-1, 3)


def _leaves(data: vtkDataObject) -> List[Tuple[str, vtkPolyData]]:
    if isinstance(data, vtkPolyData):
        return [("the garment", data)]
    leaves: List[Tuple[str, vtkPolyData]] = []
    iterator = data.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        leaf = iterator.GetCurrentDataObject()
        if not isinstance(leaf, vtkPolyData):
            kind = leaf.GetClassName()
            raise invalid_input("wrong_call", f"garment {len(leaves) + 1} is a {kind}; give vtkPolyData, for example "
                                "from vtkGeometryFilter")
        named = iterator.HasCurrentMetaData() and iterator.GetCurrentMetaData().Get(vtkCompositeDataSet.NAME())
        leaves.append((named or f"garment {len(leaves) + 1}", leaf))
        iterator.GoToNextItem()
    return leaves


def _copy_leaves(source: vtkDataObject, target: vtkDataObject) -> List[vtkPolyData]:
    """Shallow copies of the garments, in a composite like theirs."""
    if isinstance(target, vtkPolyData):
        target.ShallowCopy(source)
        return [target]
    target.CopyStructure(source)
    copies = []
    iterator = source.NewIterator()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        copy = vtkPolyData()
        copy.ShallowCopy(iterator.GetCurrentDataObject())
        target.SetDataSet(iterator, copy)
        copies.append(copy)
        iterator.GoToNextItem()
    return copies


def _under_name(array: Any, name: str) -> Any:
    """Shares the memory under another name. Renaming the array itself would rename it in the input."""
    same = array.NewInstance()
    same.ShallowCopy(array)
    same.SetName(name)
    return same


def _restore(data: vtkPolyData, kept: str) -> None:
    array = data.GetPointData().GetArray(kept)
    if array is not None:
        points = vtkPoints()
        points.SetData(_under_name(array, "Points"))
        data.GetPointData().RemoveArray(kept)
        data.SetPoints(points)


def _move(data: vtkPolyData, kept: str, positions: np.ndarray) -> None:
    """Sets new points and keeps the old ones as an array, the same memory."""
    if not data.GetPointData().HasArray(kept):
        data.GetPointData().AddArray(_under_name(data.GetPoints().GetData(), kept))
    points = vtkPoints()
    points.SetData(numpy_to_vtk(positions, deep=0))
    data.SetPoints(points)
    data.GetCellData().SetNormals(None)
    normals = data.GetPointData().GetNormals()
    if normals is not None:
        turned = numpy_to_vtk(_core.vertex_normals(positions, _fans(data.GetPolys())), deep=0)
        turned.SetName(normals.GetName() or "Normals")
        data.GetPointData().SetNormals(turned)


def _given_type(garment: vtkPolyData) -> str:
    array = garment.GetFieldData().GetAbstractArray("GarmentType")
    return array.GetValue(0) if isinstance(array, vtkStringArray) and array.GetNumberOfValues() else "auto"


def _given_front(garment: vtkPolyData) -> str:
    array = garment.GetFieldData().GetAbstractArray("GarmentFront")
    return array.GetValue(0) if isinstance(array, vtkStringArray) and array.GetNumberOfValues() else ""


def _given_sizes(garment: vtkPolyData) -> Dict[str, Any]:
    """Scale, fabric, and whether the garment lies round the body already: of this garment."""
    fabric = garment.GetFieldData().GetAbstractArray("GarmentFabric")
    scale, placed = (_numbers(garment.GetFieldData(), name) for name in ("GarmentScale", "GarmentAsPlaced"))
    given: Dict[str, Any] = {}
    if scale is not None and scale.size:
        given["garment_scale"] = float(scale.flat[0])
    if placed is not None and placed.size:
        given["as_placed"] = bool(placed.flat[0])
    if isinstance(fabric, vtkStringArray) and fabric.GetNumberOfValues():
        given["garment_fabric"] = fabric.GetValue(0)
    return given


def _what_is_wrong(port: int, data: Optional[vtkDataObject]) -> Optional[str]:
    """Checks that an input is there and a surface. The executive reports this, too, and stops."""
    named = ("the body", "the garments")[port]
    if data is None:
        return f"nothing is connected to input {port}, {named}"
    if not isinstance(data, (vtkPolyData, vtkCompositeDataSet)):
        kind = data.GetClassName()
        return f"input {port}, {named}, is a {kind}; give vtkPolyData, for example from vtkGeometryFilter"
    return None


def _is_aborted_upstream(filter_: Any) -> bool:
    """Whether a filter upstream was aborted."""
    for port in range(filter_.GetNumberOfInputPorts()):
        before = filter_.GetInputAlgorithm(port, 0) if filter_.GetNumberOfInputConnections(port) else None
        if before is not None and (before.GetAbortExecute() or _is_aborted_upstream(before)):
            return True
    return False


# ---- the filter --------------------------------------------------------------------------------------------------

_MOST_FRAMES = next(int(range_.split("..")[1]) for name, _, _, range_, _ in _core.parameters_of("recover")
                    if name == "frames")


class _FitFilter(VTKPythonAlgorithmBase):
    """Base of the five filters. Each names its row of the table, its inputs and its outputs."""

    NAME = ""
    TAKES: Tuple[str, ...] = ()  #: results of earlier filters: some of rig, fits, worn
    MAKES: Tuple[str, ...] = ()  #: some of rig, fits, dressing, frames
    STEPS: Tuple[str, ...] = ()  #: filters to run one after another

    def __init_subclass__(cls) -> None:
        cls.__signature__ = with_keywords(inspect.signature(cls), cls.NAME)
        cls.__doc__ = (cls.__doc__ or "").rstrip() + lines_on(cls.NAME)

    def __init__(self, *, unit: str = "auto", up: str = "auto", front: str = "auto", garment_unit: str = "auto",
                 garment_up: str = "auto", garment_front: str = "auto",
                 joints: Optional[Mapping[str, Sequence[float]]] = None, **parameters: Any) -> None:
        object.__setattr__(self, "_values", {name: default for name, default, *_ in _core.parameters_of(self.NAME)})
        dresses = self.NAME != "rig"
        super().__init__(nInputPorts=1 + dresses, inputType="vtkPolyData", nOutputPorts=2 + dresses,
                         outputType="vtkPolyData")
        self.unit: str = unit
        self.up: str = up
        self.front: str = front
        self.garment_unit: str = garment_unit
        self.garment_up: str = garment_up
        self.garment_front: str = garment_front
        #: read only, so that a change is noticed: set all anew
        self.joints: Mapping[str, Sequence[float]] = joints or {}
        self.error: Optional[str] = None  #: message of the last execution; None after success
        self.error_name: Optional[str] = None  #: for programs: "rig_mismatch", ..., "solver_failure"; None likewise
        self._scenes: Dict[str, Any] = {}  # by step: identity of its inputs, and its result
        for name, value in parameters.items():
            if name not in self._values:
                kind, names = type(self).__name__, ", ".join(self._values)
                raise invalid_input("unknown_name", f"{kind} has no parameter called {name!r}; there are {names}")
            setattr(self, name, value)

    # parameters are attributes
    def __getattr__(self, name: str) -> Any:
        values = object.__getattribute__(self, "_values")
        if name in values:
            return values[name]
        raise AttributeError(f"{type(self).__name__} has no attribute {name!r}")

    def __setattr__(self, name: str, value: Any) -> None:
        if name in self._values:
            if self._values[name] != value:
                self._values[name] = value
                self.Modified()
        else:
            changed = name in ("unit", "up", "front", "garment_unit", "garment_up", "garment_front", "joints")
            super().__setattr__(name, MappingProxyType(dict(value)) if name == "joints" else value)
            if changed:
                self.Modified()

    def __dir__(self) -> List[str]:
        return [*super().__dir__(), *self._values]

    # methods that VTKPythonAlgorithmBase, a plain vtkAlgorithm, lacks
    def SetInputData(self, *arguments: Any) -> None:
        port, data = arguments if len(arguments) == 2 else (0, arguments[0])
        self.SetInputDataObject(port, data)

    def GetOutput(self, port: int = 0) -> vtkDataObject:
        return self.GetOutputDataObject(port)

    @property
    def skeleton_port(self) -> int:
        return self.GetNumberOfOutputPorts() - 1

    # the pipeline's requests
    def FillInputPortInformation(self, port: int, info: Any) -> int:
        if port == 0:
            info.Set(self.INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData")
        else:  # the composite first: the executive iterates over blocks unless the first type accepts composites
            info.Set(self.INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet")
            info.Append(self.INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData")
        return 1

    def FillOutputPortInformation(self, port: int, info: Any) -> int:
        garments = port == 1 and port != self.skeleton_port
        info.Set(vtkDataObject.DATA_TYPE_NAME(), "vtkDataObject" if garments else "vtkPolyData")
        return 1

    def ProcessRequest(self, request: Any, inputs: Any, outputs: Any) -> int:
        if request.Has(vtkDemandDrivenPipeline.REQUEST_DATA_OBJECT()):
            return self.RequestDataObject(request, inputs, outputs)
        if request.Has(vtkStreamingDemandDrivenPipeline.REQUEST_UPDATE_TIME()) or request.Has(
                vtkStreamingDemandDrivenPipeline.REQUEST_UPDATE_EXTENT()):
            self._keep_time(inputs)
        return super().ProcessRequest(request, inputs, outputs)

    def _frames(self) -> int:
        """Number of time steps; 0 where `frames` is invalid, which RequestData reports."""
        frames = self._values["frames"] if "frames" in self.MAKES else 0
        return int(frames) if isinstance(frames, Integral) and 0 < frames <= _MOST_FRAMES else 0

    def _keep_time(self, inputs: Any) -> None:
        """Time steps on the pose path belong to this filter. Passed upstream, each would make a reader with time steps
        read again, and this filter compute again."""
        for port in range(self.GetNumberOfInputPorts() if self._frames() else 0):
            for i in range(inputs[port].GetNumberOfInformationObjects()):
                inputs[port].GetInformationObject(i).Remove(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP())

    def RequestDataObject(self, request: Any, inputs: Any, outputs: Any) -> int:
        given = [inputs[port].GetInformationObject(0) for port in range(self.GetNumberOfInputPorts())]
        data = [info and info.Get(vtkDataObject.DATA_OBJECT()) for info in given]
        for port in range(self.GetNumberOfOutputPorts()):
            info = outputs.GetInformationObject(port)
            garments = port == 1 and port != self.skeleton_port
            like = data[1] if garments and not _what_is_wrong(1, data[1]) else None
            kind = like.GetClassName() if like is not None else "vtkPolyData"
            made = info.Get(vtkDataObject.DATA_OBJECT())
            if made is None or made.GetClassName() != kind:
                info.Set(vtkDataObject.DATA_OBJECT(), like.NewInstance() if like is not None else vtkPolyData())
        self.error = next((wrong for wrong in map(_what_is_wrong, range(len(data)), data) if wrong), None)
        self.error_name = "missing_input" if self.error else None
        if self.error:
            self._empty([outputs.GetInformationObject(port).Get(vtkDataObject.DATA_OBJECT())
                         for port in range(self.GetNumberOfOutputPorts())])
        return 1

    def RequestInformation(self, request: Any, inputs: Any, outputs: Any) -> int:
        frames = self._frames()
        for port in range(self.GetNumberOfOutputPorts()):
            info = outputs.GetInformationObject(port)
            if frames:
                steps = [i / (frames - 1) if frames > 1 else 1.0 for i in range(frames)]
                info.Set(vtkStreamingDemandDrivenPipeline.TIME_STEPS(), steps, frames)
                info.Set(vtkStreamingDemandDrivenPipeline.TIME_RANGE(), [0.0, 1.0], 2)
            else:
                info.Remove(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
                info.Remove(vtkStreamingDemandDrivenPipeline.TIME_RANGE())
        return 1

    def RequestData(self, request: Any, inputs: Any, outputs: Any) -> int:
        data = [inputs[port].GetInformationObject(0).Get(vtkDataObject.DATA_OBJECT())
                for port in range(self.GetNumberOfInputPorts())]
        made = [outputs.GetInformationObject(port).Get(vtkDataObject.DATA_OBJECT())
                for port in range(self.GetNumberOfOutputPorts())]
        self.error = self.error_name = None
        if data[0].GetNumberOfPoints() == 0 and _is_aborted_upstream(self):
            self._empty(made)
            return 1
        try:
            scene = self._updated(data[0], data[1] if len(data) > 1 else None)
            self._write(scene, self._time(request, outputs), data, made)
            if "dressing" in self.MAKES:
                verdict = scene.verdict()
                for warning in [verdict["note"], *verdict["warnings"]]:
                    self._tell("WarningEvent", warning)
            return 1
        except Cancelled:
            self._empty(made)
            return 1
        except (InvalidInput, SolverFailure) as error:
            self.error, self.error_name = str(error), getattr(error, "code", "solver_failure")
            self._empty(made)
            self._tell("ErrorEvent", self.error)
            return 0
        except BaseException as error:  # VTK prints it: Ctrl-C, a value of the wrong kind
            self.error, self.error_name = f"{type(error).__name__}: {error}", "invalid_input"
            self._empty(made)
            raise

    @staticmethod
    def _time(request: Any, outputs: Any) -> float:
        """The time step that the requesting port needs."""
        info = outputs.GetInformationObject(max(request.Get(vtkExecutive.FROM_OUTPUT_PORT()), 0))
        key = vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP()
        return info.Get(key) if info.Has(key) else 1.0

    @staticmethod
    def _empty(outputs: List[vtkDataObject]) -> None:
        for output in outputs:
            output.Initialize()

    def _tell(self, event: str, text: str) -> None:
        """Invokes an event of the vtkAlgorithm, or prints to standard error where it has no observer."""
        if text and self.HasObserver(event):
            self.InvokeEvent(event)
        elif text:
            print(f"garmentfit: {type(self).__name__}: {text}", file=sys.stderr)

    # computing
    def _goes_on(self, fraction: float, stage: str) -> bool:
        self.SetProgressText(stage)
        self.UpdateProgress(fraction)
        return not (self.CheckAbort() if hasattr(self, "CheckAbort") else self.GetAbortExecute())

    def _kept(self, step: str, made_from: Any, make: Any) -> Any:
        """The result of a step, computed again only where its inputs changed."""
        kept = self._scenes.get(step)
        if kept is None or kept[0] != made_from:
            self._scenes.pop(step, None)
            kept = self._scenes[step] = (made_from, make())
        return kept[1]

    def _updated(self, body: vtkPolyData, garments: Optional[vtkDataObject]) -> Any:
        end = self._end_of_time()
        choices = (self.unit, self.up, self.front, self._values.get("height"),
                   tuple(sorted((k, tuple(v)) for k, v in self.joints.items())))
        source: Any = (body.__this__, body.GetMTime(), choices)
        scene = self._kept("body", source, lambda: self._read_body(body))
        dressed = garments is None
        for i, step in enumerate(self.STEPS):
            if not dressed and step != "rig":
                source = (source, garments.__this__, garments.GetMTime(), self.garment_unit, self.garment_up,
                          self.garment_front, self._values.get("garment_scale"), self._values.get("as_placed"))
                before = scene
                scene = self._kept("garments", source, lambda: self._read_garments(before, body, garments))
                dressed = True
            values, matter = self._values_of(step, 0 if garments is None else len(_leaves(garments)))
            source = (source, tuple(sorted(matter.items())))
            before, part = scene, i / len(self.STEPS)
            if not math.isinf(end):
                values["time_limit"] = max(end - time.monotonic(), 1e-6)  # 0 would be no limit
            scene = self._kept(step, source, lambda: before.run(
                step, values, lambda done, stage: self._goes_on(part + done / len(self.STEPS), stage)))
            if step == "drape" and not scene.verdict()["put_on"]:
                break
        return scene

    def _values_of(self, step: str, layers: int) -> Tuple[Dict[str, Any], Dict[str, Any]]:
        """The parameters of a step, and those that its result depends on."""
        values = {name: self._values[name] for name, *_ in _core.parameters_of(step)}
        unused = set()
        if step == "drape":  # only garments that are worn already move to another pose
            unused = {name for name in values if name.startswith("recovery_") and layers < 2}
        if step in ("rig", "fit"):  # finished, or failed
            unused = {"time_limit"}
        return values, {name: value for name, value in values.items() if name not in unused}

    def _end_of_time(self) -> float:
        """Of all steps together; infinite without a time limit."""
        limit = self._values["time_limit"]
        return time.monotonic() + limit if limit > 0 else math.inf

    def _read_body(self, body: vtkPolyData) -> Any:
        if "rig" not in self.TAKES:
            positions, triangles = mesh_of(body, "the body")
            joints = {name: [float(x) for x in place] for name, place in self.joints.items()}
            return _core.Scene.of_body(positions, triangles, self.unit, self.up, self.front, joints,
                                        {"height": self._values["height"]})
        positions, triangles = mesh_of(body, "the body", "InputPosition")
        return _core.Scene.of_rigged(positions, triangles, _find_in(body), "fits" in self.TAKES)

    def _read_garments(self, scene: Any, body: vtkPolyData, garments: vtkDataObject) -> Any:
        scene = scene.copy()
        given = "fits" in self.TAKES or "worn" in self.TAKES
        layers = _leaves(garments)
        for name, garment in layers:
            positions, triangles = mesh_of(garment, name, "RestPosition" if given else "")
            scene.add_garment(positions, triangles, Mesh(positions, triangles, uvs=uvs_of(garment)).corner_uvs(),
                              _given_type(garment), self.garment_unit, self.garment_up,
                              _given_front(garment) or self.garment_front, {**self._values, **_given_sizes(garment)},
                              name, _find_in(garment) if given else None)
        if "worn" in self.TAKES:
            scene.set_worn(_find_in(body), mesh_of(body, "the body")[0],
                           [mesh_of(garment, name)[0] for name, garment in layers])
        return scene

    # writing
    def _write(self, scene: Any, time: float, inputs: List[Any], outputs: List[Any]) -> None:
        now = scene.snapshot(time if "frames" in self.MAKES else 1.0)
        self._write_body(scene, now, inputs[0], outputs[0])
        if len(inputs) > 1:
            self._write_garments(scene, now, _copy_leaves(inputs[1], outputs[1]))
        _draw_skeleton(outputs[self.skeleton_port], now.joints())
        if self._frames():
            for output in outputs:
                output.GetInformation().Set(vtkDataObject.DATA_TIME_STEP(), time)

    def _write_body(self, scene: Any, now: Any, given: vtkPolyData, body: vtkPolyData) -> None:
        body.ShallowCopy(given)
        if "rig" in self.MAKES:
            body.GetPointData().RemoveArray("InputPosition")  # of an earlier dressing
            _put_all(body, scene.rig_arrays())
        else:
            _restore(body, "InputPosition")
        if "fits" in self.MAKES:
            _put_all(body, scene.fit_arrays())
        if now.is_body_moved:
            _move(body, "InputPosition", now.body())
        if "dressing" in self.MAKES:
            _put_all(body, now.dressing_arrays())

    def _write_garments(self, scene: Any, now: Any, garments: List[vtkPolyData]) -> None:
        for i, garment in enumerate(garments):
            _put_all(garment, scene.garment_arrays(i))
            if "fits" in self.TAKES or "worn" in self.TAKES:
                _restore(garment, "RestPosition")
            else:
                garment.GetPointData().RemoveArray("RestPosition")  # of an earlier dressing
            if "fits" in self.MAKES:
                _put_all(garment, scene.found_arrays(i))
            if "dressing" in self.MAKES:
                _put_all(garment, now.worn_arrays(i))
                if i in now.worn:
                    _move(garment, "RestPosition", now.garment(i))
                    _put_all(garment, now.map_arrays(i))


def _draw_skeleton(skeleton: vtkPolyData, joints: np.ndarray) -> None:
    skeleton.Initialize()
    points, lines = vtkPoints(), vtkCellArray()
    points.SetData(numpy_to_vtk(joints, deep=0))
    skeleton.SetPoints(points)
    for start, end in _core.skeleton_lines():
        lines.InsertNextCell(2)
        lines.InsertCellPoint(start)
        lines.InsertCellPoint(end)
    skeleton.SetLines(lines)
    _put_all(skeleton, _core.skeleton_arrays())


class RigBody(_FitFilter):
    """Finds the skeleton and the skin weights of a body. Port 1 is the skeleton."""
    NAME, STEPS, MAKES = "rig", ("rig",), ("rig",)


class FitSkeleton(_FitFilter):
    """Poses a rigged body so that its bones run through the middle of the garment's parts."""
    NAME, STEPS, TAKES, MAKES = "fit", ("fit",), ("rig",), ("fits",)


class DrapeGarment(_FitFilter):
    """Drapes the garment on the posed body; cloth and body never cross."""
    NAME, STEPS, TAKES, MAKES = "drape", ("drape",), ("rig", "fits"), ("dressing",)


class RecoverPose(_FitFilter):
    """Moves a dressed body and its garments back to the input pose. `frames` adds time steps on the pose path."""
    NAME, STEPS, TAKES, MAKES = "recover", ("recover",), ("rig", "worn"), ("dressing", "frames")


class DressBody(_FitFilter):
    """Dresses a body in garments made for somebody else: rig, fit, drape, recover."""
    NAME, STEPS, MAKES = "dress", ("rig", "fit", "drape", "recover"), ("rig", "fits", "dressing", "frames")
