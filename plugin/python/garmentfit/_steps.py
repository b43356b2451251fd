# SPDX-License-Identifier: GPL-3.0-or-later
"""The five filters as functions. Arguments are never changed.

Each function takes the parameters of its filter as keyword arguments. Their docstrings are generated from the schema.
"""
from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import invalid_input
from ._meshes import Mesh, MeshLike, Positions, Triangles, as_mesh
from ._parameters import takes_parameters_of

#: Called with the finished fraction and the name of the stage. Returns False to stop: Cancelled is raised.
Progress = Callable[[float, str], Optional[bool]]


class Garment(NamedTuple):
    """A garment and what is known of it. Several garments can differ in it; None is what the function is given."""

    mesh: MeshLike
    type: str = "auto"
    front: Optional[str] = None  #: the axis of its file that its front faces
    scale: Optional[float] = None  #: of its file, after its unit
    as_placed: Optional[bool] = None  #: it lies round the body already
    fabric: Optional[str] = None  #: what it is made of


class Girth(NamedTuple):
    place: str
    body: float
    garment: float

    @property
    def ease(self) -> float:
        return self.garment - self.body


class Overstretch(NamedTuple):
    """The edges that are stretched most."""

    edges: int  #: number of edges stretched by more than half their length
    largest: float  #: largest stretch of an edge, as a share of its length
    part: str  #: nearest part of the body; empty where no edge is overstretched


class PlaceVerdict(NamedTuple):
    place: str
    fit: str  #: "roomy", "fits", "tight" or "too small"
    stretch: float  #: of the cloth round that place, as a share of its length
    pressure: float  #: Pa, on the mean


class FitVerdict(NamedTuple):
    """How a garment fits."""

    fit: str  #: "roomy", "fits", "tight", "too small" or "too large": it does not stay up
    fabric_that_would_do: Optional[str]  #: of a garment that is too small, where there is such a fabric
    places: List[PlaceVerdict]


class FitOfGarment(NamedTuple):
    type: str
    type_probability: float  #: that the type is right; 1 where it was given
    covered: List[str]  #: names of bones
    layer: int  #: 0 for the innermost of several garments


@dataclass(frozen=True)
class Certificate:
    """Quality of a dressed garment. Crossings are counted exactly."""

    body_crossings: int
    self_crossings: int
    input_self_crossings: int  #: of the garment as given
    kept_self_crossings: int  #: those of them that were not resolved
    shifted_self_crossings: int  #: others, where sheets lay on each other
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
    """One worn garment. Lengths are in the body's unit."""

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
    verdict: FitVerdict


class Frame(NamedTuple):
    """A state on the pose path to the body's input pose."""

    share: float  #: 0 is the fitted pose, 1 the input pose
    body: Positions
    garments: List[Positions]


class _Result:
    def __init__(self, scene: _core.Scene) -> None:
        self._scene = scene

    @property
    def metres_per_unit(self) -> float:
        """Of the body's unit, given or guessed."""
        return self._scene.metres_per_unit

    @property
    def body(self) -> Positions:
        """The body's vertices in the pose of this result."""
        return self._scene.snapshot().body()

    @property
    def joint_names(self) -> List[str]:
        return _core.skeleton_arrays()["points"]["JointName"]

    @property
    def joints(self) -> Positions:
        """In the order of joint_names, in the same pose."""
        return self._scene.snapshot().joints()

    @property
    def bones(self) -> List[Tuple[str, int, int]]:
        """(name, first joint, second joint); after the bones the tips of head, hands and feet."""
        names = _core.skeleton_arrays()["cells"]["BoneName"]
        return [(name, *line) for name, line in zip(names, _core.skeleton_lines())]


class Rig(_Result):
    """The skeleton and the skin weights of a body."""

    @property
    def joint_indices(self) -> npt.NDArray[np.uint16]:
        """Bones (n x 4) of each vertex."""
        return self._scene.rig_arrays()["points"]["JointIndices"]

    @property
    def joint_weights(self) -> npt.NDArray[np.float64]:
        """Skin weights (n x 4) of these bones; rows sum to 1."""
        return self._scene.rig_arrays()["points"]["JointWeights"]


class Conflict(NamedTuple):
    """A bone that two garments need in different directions."""

    bone: str
    garments: Tuple[int, int]  #: their indices; the first one has too little space for the bone
    angle: float  #: degrees between the bone's directions in the poses of the two garments


class Fit(_Result):
    """A body in the pose of its garments."""

    @property
    def garments(self) -> List[FitOfGarment]:
        return [FitOfGarment(**fit) for fit in self._scene.fits()]

    @property
    def conflicts(self) -> List[Conflict]:
        """Empty where one pose serves all garments."""
        return [Conflict(*conflict) for conflict in self._scene.conflicts()]


class Dressing(_Result):
    """Garments on a body."""

    def __init__(self, scene: _core.Scene) -> None:
        super().__init__(scene)
        self.garments: List[DressedGarment] = [_dressed(garment) for garment in scene.garments()]
        verdict = scene.verdict()
        self.certified: bool = verdict["certified"]  #: worn, body at full size and in its pose, no crossings
        self.too_small: bool = verdict["too_small"]  #: a garment is, for this body or this pose
        self.note: str = verdict["note"]  #: why it is not certified, one line; else empty
        self.warnings: List[str] = verdict["warnings"]  #: what limits the trust in the result, one line each
        self.scale_reached: float = verdict["scale_reached"]
        self.pose_reached: float = verdict["pose_reached"]
        #: m/s, of the cloth's fastest vertex at the end; None where the garment is too small and was never settled
        self.speed: Optional[float] = verdict["speed"]
        #: what is left of all forces on the cloth at the end, in shares of the weight of each vertex's cloth: mean and
        #: 99th percentile (a static equilibrium: below 0.02 and 0.2); None before the pose was recovered
        self.residual: Optional[Tuple[float, float]] = verdict["residual"]
        self.held_back: List[Tuple[str, float]] = verdict["held_back"]
        #: parts of the body that enter each other, and how deep: cloth has no space there
        self.overlaps: List[Tuple[str, str, float]] = verdict["overlaps"]

    @property
    def fits(self) -> List[FitOfGarment]:
        return Fit(self._scene).garments

    @property
    def frames(self) -> List[Frame]:
        """States on the pose path to the body's input pose: at most `frames`, without those that are not certified."""
        return [Frame(*frame) for frame in self._scene.frames()]

    def write_animation(self, path: Union[str, "os.PathLike[str]"], *, seconds: float = 3) -> None:
        """Writes the frames as one GLB that other programs can play: each is a morph target of body and clothes.

        seconds: how long the animation is.
        """
        self._scene.write_animation(Path(path), float(seconds))

    def write_outfit(self, path: Union[str, "os.PathLike[str]"], *, bones: str = "own",
                     hide_covered_skin: bool = False, influences: int = 4) -> None:
        """Writes body and clothes as one skinned GLB, or VRM by its name: one skeleton, and weights for all meshes, so
        that other programs can pose them. Meshes from read_mesh keep their UVs, materials and textures.

        bones: whose joints and names it has: garmentfit, vrm, mixamo, unreal, smpl, or own. Own are those of the body's
        file, with its animations and all else, where that is a skinned glTF or GLB from read_mesh; else garmentfit.
        hide_covered_skin: leaves out faces of the body that the clothes cover in all poses of everyday movement, and
        draws in skin under cloth by up to 6 cm (of an adult), but on an avatar's own bones.
        influences: at most so many joints move a vertex of the clothes: four, which all programs read, or up to eight.
        Only of a certified result in the body's own pose (dress, recover_pose).
        """
        self._scene.write_outfit(Path(path), bones, hide_covered_skin, influences)


def _dressed(garment: Mapping[str, Any]) -> DressedGarment:
    parts = dict(garment)
    parts["certificate"] = Certificate(**parts["certificate"])
    parts["overstretched"] = Overstretch(*parts["overstretched"])
    parts["girths"] = [Girth(*girth) for girth in parts["girths"]]
    fit, fabric, places = parts["verdict"]
    parts["verdict"] = FitVerdict(fit, fabric, [PlaceVerdict(*place) for place in places])
    return DressedGarment(**parts)


def _scene_of(body: MeshLike, unit: str, up: str, front: str,
              joints: Optional[Mapping[str, Sequence[float]]], parameters: Mapping[str, Any]) -> _core.Scene:
    mesh = as_mesh(body)
    known = {name: [float(x) for x in place] for name, place in (joints or {}).items()}
    scene = _core.Scene.of_body(mesh.positions, mesh.triangles, unit, up, front, known, dict(parameters))
    if mesh.file is not None:
        scene.set_body_file(mesh.file, mesh._left)
    return scene


def _sizes_of(garment: Garment, parameters: Mapping[str, Any]) -> Mapping[str, Any]:
    """What the garment says of itself comes before the parameters of all garments."""
    own = {"garment_scale": garment.scale, "as_placed": garment.as_placed, "garment_fabric": garment.fabric}
    return {**parameters, **{name: value for name, value in own.items() if value is not None}}


def _with_garments(scene: _core.Scene, garments: Union[MeshLike, Sequence[Any]], unit: str, up: str, front: str,
                   parameters: Mapping[str, Any]) -> _core.Scene:
    dressed = scene.copy()
    several = isinstance(garments, (list, tuple)) and not isinstance(garments, Garment) and not _is_pair(garments)
    layers = list(garments) if several else [garments]
    for i, layer in enumerate(layers):
        garment = layer if isinstance(layer, Garment) else Garment(layer)
        mesh = as_mesh(garment.mesh)
        if mesh.file is not None:
            _core.require_no_body(mesh.file)
        named = mesh.name if len(layers) == 1 or mesh.name != "the garment" else f"garment {i + 1}"
        dressed.add_garment(mesh.positions, mesh.triangles, mesh.corner_uvs(), garment.type, unit, up,
                            garment.front or front, dict(_sizes_of(garment, parameters)), named)
        if mesh.file is not None:
            dressed.set_garment_look(mesh.file, mesh._left)
    return dressed


def _scene_in(result: Any, maker: str) -> _core.Scene:
    if not isinstance(result, _Result):
        raise invalid_input("missing_input",
                            f"{type(result).__name__} is no result of a step; give the result of {maker}")
    return result._scene


def _is_pair(given: Sequence[Any]) -> bool:
    """Positions and triangles, not two garments."""
    return isinstance(given, tuple) and len(given) == 2 and all(isinstance(part, np.ndarray) for part in given)


@takes_parameters_of("rig")
def rig_body(body: MeshLike, *, unit: str = "auto", up: str = "auto", front: str = "auto",
             joints: Optional[Mapping[str, Sequence[float]]] = None, progress: Optional[Progress] = None,
             **parameters: Any) -> Rig:
    """Finds the skeleton and the skin weights of a body.

    unit, up, front: of the body's file, "auto" or "m", "dm", "cm", "mm", "in", "ft" and "+x" ... "-z".
    joints: positions of known joints by name, in the body's units and axes.
    """
    return Rig(_scene_of(body, unit, up, front, joints, parameters).run("rig", parameters, progress))


@takes_parameters_of("fit")
def fit_skeleton(rig: Rig, garments: Union[MeshLike, Sequence[Any]], *, garment_unit: str = "auto",
                 garment_up: str = "auto", garment_front: str = "auto", progress: Optional[Progress] = None,
                 **parameters: Any) -> Fit:
    """Poses a rigged body so that its bones run through the middle of the garment's parts.

    garments: one, or a list from the inside out (or layer_order="auto"); Garment(mesh, type, front, scale, as_placed,
    fabric)
    says for each what it is and how it lies.
    """
    scene = _with_garments(_scene_in(rig, "rig_body"), garments, garment_unit, garment_up, garment_front, parameters)
    return Fit(scene.run("fit", parameters, progress))


@takes_parameters_of("drape")
def drape_garment(fit: Fit, *, progress: Optional[Progress] = None, **parameters: Any) -> Dressing:
    """Drapes the garments on the posed body; cloth and body never cross."""
    return Dressing(_scene_in(fit, "fit_skeleton").run("drape", parameters, progress))


@takes_parameters_of("recover")
def recover_pose(draped: Dressing, *, progress: Optional[Progress] = None, **parameters: Any) -> Dressing:
    """Moves a dressed body and its garments back to the input pose of the body."""
    return Dressing(_scene_in(draped, "drape_garment").run("recover", parameters, progress))


@takes_parameters_of("dress")
def dress(body: MeshLike, garments: Union[MeshLike, Sequence[Any]], *, unit: str = "auto", up: str = "auto",
          front: str = "auto", joints: Optional[Mapping[str, Sequence[float]]] = None, garment_unit: str = "auto",
          garment_up: str = "auto", garment_front: str = "auto", progress: Optional[Progress] = None,
          **parameters: Any) -> Dressing:
    """Dresses a body in garments made for somebody else: rig, fit, drape, recover.

    A garment that is too small is no error: `certified` is then False, and `note` says where and by how much.
    """
    scene = _with_garments(_scene_of(body, unit, up, front, joints, parameters), garments, garment_unit, garment_up,
                           garment_front, parameters)
    return Dressing(scene.run("dress", parameters, progress))
