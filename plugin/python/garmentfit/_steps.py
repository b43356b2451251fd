# SPDX-License-Identifier: GPL-3.0-or-later
"""The five filters as plain functions: numbers in, a result out, arguments untouched.

Each takes the parameters of its filter as keyword arguments. Their docstrings are made from the one description that the
program and all other hosts are made from.
"""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._meshes import Mesh, MeshLike, Positions, Triangles, as_mesh
from ._parameters import takes_parameters_of

#: Called with the fraction done and the name of the stage. False stops: Cancelled is raised.
Progress = Callable[[float, str], Optional[bool]]


class Garment(NamedTuple):
    """A garment and its type, where several are put on at once."""

    mesh: MeshLike
    type: str = "auto"


class Girth(NamedTuple):
    place: str
    body: float
    garment: float

    @property
    def ease(self) -> float:
        return self.garment - self.body


class Overstretch(NamedTuple):
    """Where cloth is stretched most."""

    edges: int  #: those that are stretched by more than half their length
    largest: float  #: stretch of the edge that is stretched most, as a share of its length
    part: str  #: of the body, next to it; empty where no edge is overstretched


class FitOfGarment(NamedTuple):
    type: str
    type_margin: float  #: 0 (a toss-up) to 1 (sure, or given)
    covered: List[str]  #: names of bones
    layer: int  #: 0 for the innermost of several garments


@dataclass(frozen=True)
class Certificate:
    """What a dressed garment is judged by; crossings are counted exactly."""

    body_crossings: int
    self_crossings: int
    input_self_crossings: int  #: that the garment was given with
    kept_self_crossings: int  #: those of them that did not come apart
    layer_crossings: int
    vertices_inside: int
    min_distance: float
    strain_median: float
    strain_p95: float
    strain_max: float

    @property
    def clean(self) -> bool:
        return not (self.body_crossings or self.self_crossings or self.layer_crossings or self.vertices_inside)


@dataclass(frozen=True)
class DressedGarment:
    """One garment as it is worn. Lengths are in the body's unit."""

    name: str
    positions: Positions  #: same vertices, same order
    triangles: Triangles
    certificate: Certificate
    ease: npt.NDArray[np.float64]  #: gap to the skin at each vertex
    strain: npt.NDArray[np.float64]  #: mean stretch of the edges at each vertex
    pressure: npt.NDArray[np.float64]  #: Pa
    girths: List[Girth]
    overstretched: Overstretch
    too_tight: List[Tuple[str, float]]  #: part of the body, missing girth


class Frame(NamedTuple):
    """A state on the way back to the body's own pose."""

    share: float  #: 0 is the fitted pose, 1 the own
    body: Positions
    garments: List[Positions]


class _Result:
    def __init__(self, scene: _core.Scene) -> None:
        self._scene = scene

    @property
    def metres_per_unit(self) -> float:
        """Of the body as it was given, or guessed."""
        return self._scene.metres_per_unit

    @property
    def body(self) -> Positions:
        """The body's vertices in the pose that was come to."""
        return self._scene.moment().body()

    @property
    def joint_names(self) -> List[str]:
        return _core.skeleton_arrays()["points"]["JointName"]

    @property
    def joints(self) -> Positions:
        """In the order of joint_names, in that pose."""
        return self._scene.moment().joints()

    @property
    def bones(self) -> List[Tuple[str, int, int]]:
        """Name, joint it comes from, joint it goes to; after the bones the tips of head, hands and feet."""
        names = _core.skeleton_arrays()["cells"]["BoneName"]
        return [(name, *line) for name, line in zip(names, _core.skeleton_lines())]


class Rig(_Result):
    """The skeleton of a body and how the skin hangs on it."""

    @property
    def joint_indices(self) -> npt.NDArray[np.uint16]:
        """Bones (n x 4) that each vertex hangs on."""
        return self._scene.rig_arrays()["points"]["JointIndices"]

    @property
    def joint_weights(self) -> npt.NDArray[np.float64]:
        """How much (n x 4); rows sum to 1."""
        return self._scene.rig_arrays()["points"]["JointWeights"]


class Conflict(NamedTuple):
    """Why no one pose serves two garments."""

    bone: str
    garments: Tuple[int, int]  #: which; in the first one the bone would lack room
    angle: float  #: degrees between the bone's directions in their own poses


class Fit(_Result):
    """A body posed into garments."""

    @property
    def garments(self) -> List[FitOfGarment]:
        return [FitOfGarment(**fit) for fit in self._scene.fits()]

    @property
    def conflicts(self) -> List[Conflict]:
        """Empty where all garments turn the bones alike."""
        return [Conflict(*conflict) for conflict in self._scene.conflicts()]


class Dressing(_Result):
    """Garments on a body."""

    def __init__(self, scene: _core.Scene) -> None:
        super().__init__(scene)
        self.garments: List[DressedGarment] = [_dressed(garment) for garment in scene.garments()]
        verdict = scene.verdict()
        self.certified: bool = verdict["certified"]  #: on, at full size, in the pose asked for, nothing crosses
        self.too_small: bool = verdict["too_small"]  #: the garment, for this body or this pose
        self.note: str = verdict["note"]  #: one line on what went wrong where it is not certified
        self.warnings: List[str] = verdict["warnings"]  #: what to know before believing the result, one line each
        self.size_reached: float = verdict["size_reached"]
        self.pose_reached: float = verdict["pose_reached"]
        #: m/s, of the cloth's fastest vertex at the end; None where the garment is too small to be put on, and never settled
        self.speed: Optional[float] = verdict["speed"]
        self.held_back: List[Tuple[str, float]] = verdict["held_back"]
        #: parts of the body that enter each other where cloth has no room, and how deep
        self.overlaps: List[Tuple[str, str, float]] = verdict["overlaps"]

    @property
    def fits(self) -> List[FitOfGarment]:
        return Fit(self._scene).garments

    @property
    def frames(self) -> List[Frame]:
        """States on the way to the body's own pose, as many as `frames` asked for but for those that cannot be certified."""
        return [Frame(*frame) for frame in self._scene.frames()]


def _dressed(garment: Mapping[str, Any]) -> DressedGarment:
    parts = dict(garment)
    parts["certificate"] = Certificate(**parts["certificate"])
    parts["overstretched"] = Overstretch(*parts["overstretched"])
    parts["girths"] = [Girth(*girth) for girth in parts["girths"]]
    return DressedGarment(**parts)


def _scene_of(body: MeshLike, unit: str, up: str, front: str, joints: Optional[Mapping[str, Sequence[float]]]) -> _core.Scene:
    mesh = as_mesh(body)
    known = {name: [float(x) for x in place] for name, place in (joints or {}).items()}
    return _core.Scene.of_body(mesh.positions, mesh.triangles, unit, up, front, known)


def _with_garments(scene: _core.Scene, garments: Union[MeshLike, Sequence[Any]], unit: str, up: str) -> _core.Scene:
    dressed = scene.copy()
    several = isinstance(garments, (list, tuple)) and not isinstance(garments, Garment) and not _is_pair(garments)
    layers = list(garments) if several else [garments]
    for i, layer in enumerate(layers):
        mesh, type_ = (layer.mesh, layer.type) if isinstance(layer, Garment) else (layer, "auto")
        mesh = as_mesh(mesh)
        named = mesh.name if len(layers) == 1 or mesh.name != "the garment" else f"garment {i + 1}"
        dressed.add_garment(mesh.positions, mesh.triangles, type_, unit, up, named)
    return dressed


def _scene_in(result: Any, maker: str) -> _core.Scene:
    if not isinstance(result, _Result):
        raise _core.InvalidInput(f"{type(result).__name__} is no result of a step; give what {maker} returned")
    return result._scene


def _is_pair(given: Sequence[Any]) -> bool:
    """Positions and triangles, not two garments."""
    return isinstance(given, tuple) and len(given) == 2 and all(isinstance(part, np.ndarray) for part in given)


@takes_parameters_of("rig")
def rig_body(body: MeshLike, *, unit: str = "auto", up: str = "auto", front: str = "auto",
             joints: Optional[Mapping[str, Sequence[float]]] = None, progress: Optional[Progress] = None,
             **parameters: Any) -> Rig:
    """Finds the skeleton of a body and how the skin hangs on it.

    unit, up, front: of the body's file, "auto" or "m", "dm", "cm", "mm", "in", "ft" and "+x" ... "-z".
    joints: places that you know better, by name, in the body's units and axes.
    """
    return Rig(_scene_of(body, unit, up, front, joints).run("rig", parameters, progress))


@takes_parameters_of("fit")
def fit_skeleton(rig: Rig, garments: Union[MeshLike, Sequence[Any]], *, garment_unit: str = "auto",
                 garment_up: str = "auto", progress: Optional[Progress] = None, **parameters: Any) -> Fit:
    """Poses a rigged body so that its bones run through the middle of the garment's parts.

    garments: one, or a list from the inside out (or layer_order="auto"); Garment(mesh, type) tells what each is.
    """
    return Fit(_with_garments(_scene_in(rig, "rig_body"), garments, garment_unit, garment_up).run("fit", parameters, progress))


@takes_parameters_of("drape")
def drape_garment(fit: Fit, *, progress: Optional[Progress] = None, **parameters: Any) -> Dressing:
    """Puts the posed body into its garments without letting cloth and body cross."""
    return Dressing(_scene_in(fit, "fit_skeleton").run("drape", parameters, progress))


@takes_parameters_of("recover")
def recover_pose(draped: Dressing, *, progress: Optional[Progress] = None, **parameters: Any) -> Dressing:
    """Brings a dressed body back to its own pose, the garments along."""
    return Dressing(_scene_in(draped, "drape_garment").run("recover", parameters, progress))


@takes_parameters_of("dress")
def dress(body: MeshLike, garments: Union[MeshLike, Sequence[Any]], *, unit: str = "auto", up: str = "auto",
          front: str = "auto", joints: Optional[Mapping[str, Sequence[float]]] = None, garment_unit: str = "auto",
          garment_up: str = "auto", progress: Optional[Progress] = None, **parameters: Any) -> Dressing:
    """Dresses a body in garments made for somebody else: rig, fit, drape, recover.

    A garment that is too small is no error: `certified` is then False, and `note` says where and by how much.
    """
    scene = _with_garments(_scene_of(body, unit, up, front, joints), garments, garment_unit, garment_up)
    return Dressing(scene.run("dress", parameters, progress))
