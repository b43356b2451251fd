# SPDX-License-Identifier: GPL-3.0-or-later
"""Thumbnails and the meshes of the page's viewer, from the files of one finished pair. Needs no display."""
from __future__ import annotations

import base64
import io
import json
from pathlib import Path

import numpy as np
from PIL import Image

_TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
          "double": "f8", "int8": "i1", "uint8": "u1", "int32": "i4", "uint32": "u4", "float32": "f4", "float64": "f8"}
_HEIGHT, _WIDTH = 144, 84  # pixels of one view of a thumbnail
_SKIN = (0.78, 0.70, 0.64)
_CLOTH = ((0.25, 0.42, 0.66), (0.60, 0.30, 0.30), (0.30, 0.52, 0.36), (0.55, 0.45, 0.20))
EASE_RANGE = (0.0, 0.05)  # m; ease above 5 cm has the last colour


def read_ply(path) -> tuple:
    """Reads a binary PLY of triangles as the program writes it: positions n x 3, triangles m x 3, values by name.

    Raises ValueError where the file is of another form."""
    content = Path(path).read_bytes()
    end = content.find(b"end_header\n") + len(b"end_header\n")
    lines = [line.split() for line in content[:end].decode("ascii", "replace").splitlines()]
    if ["format", "binary_little_endian", "1.0"] not in lines:
        raise ValueError(f"{path}: not a binary PLY")
    counts, fields = {}, []
    for words in lines:
        if words[:1] == ["element"]:
            counts[words[1]] = int(words[2])
            element = words[1]
        elif words[:1] == ["property"] and element == "vertex":
            fields.append((words[2], "<" + _TYPES[words[1]]))
    vertices = np.frombuffer(content, fields, counts["vertex"], end)
    face = np.dtype([("count", "u1"), ("corners", "<i4", 3)])
    faces = np.frombuffer(content, face, counts["face"], end + vertices.nbytes)
    if (faces["count"] != 3).any():
        raise ValueError(f"{path}: not all faces are triangles")
    positions = np.stack([vertices[axis] for axis in "xyz"], axis=1).astype(float)
    return positions, faces["corners"], {name: vertices[name] for name, _ in fields if name not in "xyz"}


def draw_pair(work: Path, row: dict) -> None:
    """Writes thumbnail.png (front, back, ease) and view.js into the folder of a pair, and into the row which of them
    there are. A pair without a result has no thumbnail."""
    result = work / "result"
    row.update(view=True, picture=(result / "body.ply").exists())
    if not row["picture"]:
        _write_view(work, row, [])
        return
    report = json.loads((result / "report.json").read_text())
    turn = _upright(report["body"])
    scale = report["body"]["metres_per_unit"]
    bodies = [result / "pressed_body.ply", result / "body.ply"]  # the first is there where cloth presses the skin in
    meshes = [_mesh("body", next(file for file in bodies if file.exists()), turn, scale)]
    for garment in report["garments"]:
        file = result / "maps" / (Path(garment["file"]).stem + ".ply")
        if file.exists():
            meshes.append(_mesh(garment["file"], file, turn, scale))
    _write_view(work, row, meshes)
    (work / "thumbnail.png").write_bytes(thumbnail(meshes))


def thumbnail(meshes: list) -> bytes:
    """A PNG of three views: front, back, and the front coloured by ease."""
    plain = [_SKIN] + [_CLOTH[index % len(_CLOTH)] for index in range(len(meshes) - 1)]
    colours = [np.tile(colour, (len(mesh["positions"]), 1)) for mesh, colour in zip(meshes, plain)]
    ease = [colours[0]] + [ramp(mesh["values"]["ease"], *EASE_RANGE) for mesh in meshes[1:]]
    views = [_view(meshes, colours, 1), _view(meshes, colours, -1), _view(meshes, ease, 1)]
    return _png(np.concatenate(views, axis=1))


def ramp(values, low: float, high: float) -> np.ndarray:
    """Colours n x 3 in 0..1: red at low (tight), through yellow, to blue at high."""
    share = np.clip((np.asarray(values, float) - low) / (high - low), 0, 1)[:, None]
    stops = np.array([[0.80, 0.15, 0.15], [0.95, 0.80, 0.30], [0.20, 0.40, 0.75]])
    return np.where(share < 0.5, stops[0] + (stops[1] - stops[0]) * share * 2,
                    stops[1] + (stops[2] - stops[1]) * (share * 2 - 1))


def _upright(body: dict) -> np.ndarray:
    """Rotation, 3 x 3, from the body's file to +y up and +z forwards."""
    up = np.asarray(body["up"], float)
    front = np.asarray(body.get("front") or [0, 0, 1], float)
    front = front - up * (front @ up)
    front /= np.linalg.norm(front)
    return np.stack([np.cross(up, front), up, front])


def _mesh(name: str, file: Path, turn: np.ndarray, scale: float) -> dict:
    positions, triangles, values = read_ply(file)
    if "ease" in values:
        values["ease"] = values["ease"] * scale
    return dict(name=name, positions=positions @ turn.T * scale, triangles=triangles, values=values)


def _view(meshes: list, colours: list, side: int) -> np.ndarray:
    """An image, height x width x 3, seen from +z (side 1) or -z (side -1). Cost: some samples for each pixel."""
    everything = np.concatenate([mesh["positions"] for mesh in meshes])
    low, high = everything.min(axis=0), everything.max(axis=0)
    pixel = max((high[1] - low[1]) / (_HEIGHT - 8), (high[0] - low[0]) / (_WIDTH - 4))
    image, depth = np.ones((_HEIGHT, _WIDTH, 3)), np.full(_HEIGHT * _WIDTH, -np.inf)
    for mesh, colour in zip(meshes, colours):
        points, shaded = _samples(mesh, colour, pixel, side)
        x = np.round(_WIDTH / 2 + side * (points[:, 0] - (low[0] + high[0]) / 2) / pixel).astype(int)
        y = np.round(_HEIGHT / 2 - (points[:, 1] - (low[1] + high[1]) / 2) / pixel).astype(int)
        inside = (x >= 0) & (x < _WIDTH) & (y >= 0) & (y < _HEIGHT)
        place, z, shaded = (y * _WIDTH + x)[inside], side * points[inside, 2], shaded[inside]
        order = np.argsort(z)  # the nearest is written last
        place, z, shaded = place[order], z[order], shaded[order]
        nearer = z > depth[place]
        image.reshape(-1, 3)[place[nearer]] = shaded[nearer]
        depth[place[nearer]] = z[nearer]
    return image


def _samples(mesh: dict, colour: np.ndarray, pixel: float, side: int) -> tuple:
    """Points on the triangles, at most about a pixel apart, with shaded colours."""
    corners = mesh["positions"][mesh["triangles"]]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    light = np.abs(normal @ np.array([0.3, 0.4, side * 0.87])) / np.maximum(length, 1e-30)
    edge = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    steps = np.clip(np.ceil(edge / pixel).astype(int), 1, 24)
    points, shaded = [], []
    for count in np.unique(steps):
        chosen = steps == count
        a, b = np.meshgrid(np.arange(count + 1), np.arange(count + 1))
        weights = np.stack([a, b, count - a - b], axis=-1)[a + b <= count] / count
        points.append(np.einsum("ki,nij->nkj", weights, corners[chosen]).reshape(-1, 3))
        tone = np.einsum("ki,nij->nkj", weights, colour[mesh["triangles"][chosen]])
        shaded.append((tone * (0.35 + 0.65 * light[chosen])[:, None, None]).reshape(-1, 3))
    return np.concatenate(points), np.clip(np.concatenate(shaded), 0, 1)


def _png(image: np.ndarray) -> bytes:
    """Of an image, height x width x 3, in 0..1."""
    content = io.BytesIO()
    Image.fromarray(np.round(image * 255).astype(np.uint8)).save(content, "PNG")
    return content.getvalue()


def _write_view(work: Path, row: dict, meshes: list) -> None:
    """view.js: what the page loads when a row is opened. A script, because pages from disk may not read other files."""
    packed = []
    for mesh in meshes:
        positions = mesh["positions"]
        low, step = positions.min(axis=0), np.ptp(positions, axis=0).max() / 65535  # 16 bits: 0.03 mm of 2 m
        packed.append(dict(
            name=mesh["name"], low=low.tolist(), step=step,
            positions=_base64(np.round((positions - low) / step).astype("<u2")),
            triangles=_base64(mesh["triangles"].astype("<u4")),
            values={name: _base64(np.asarray(values).astype("<f4")) for name, values in mesh["values"].items()}))
    report, log = work / "result" / "report.json", work / "log.txt"
    content = dict(row=row, meshes=packed, report=report.read_text() if report.exists() else "",
                   log=log.read_text(errors="replace")[-100_000:])
    text = json.dumps(content).replace("</", "<\\/")
    (work / "view.js").write_text(f"showPair({text});\n")


def _base64(array: np.ndarray) -> str:
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode()
