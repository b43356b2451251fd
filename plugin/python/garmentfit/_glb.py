# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads what outfits hold: glTF in one binary file, with plain accessors."""
from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple

import numpy as np
import numpy.typing as npt

from ._errors import invalid_input

_NUMBERS = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
_COLUMNS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class Glb:
    """A GLB file: its JSON, and its arrays by their accessors."""

    def __init__(self, path: Path) -> None:
        data = path.read_bytes()
        if data[:4] != b"glTF":
            raise invalid_input("unreadable_file", f"{path}: is no GLB; give a file that write_outfit wrote")
        end = 20 + struct.unpack_from("<I", data, 12)[0]
        self.path, self.json = path, json.loads(data[20:end])  # type: Path, Dict[str, Any]
        self._buffer = data[end + 8:]
        self._parents = {child: i for i, node in enumerate(self.list("nodes")) for child in node.get("children", [])}

    def list(self, name: str) -> List[Any]:
        return self.json.get(name, [])

    def array(self, index: int) -> npt.NDArray[Any]:
        """Rows of an accessor; whole numbers that stand for shares are shares."""
        accessor = self.json["accessors"][index]
        if "sparse" in accessor or "bufferView" not in accessor:
            raise invalid_input("unreadable_file", f"{self.path}: has sparse accessors; give a file of write_outfit")
        view = self.json["bufferViews"][accessor["bufferView"]]
        number, columns = np.dtype(_NUMBERS[accessor["componentType"]]), _COLUMNS[accessor["type"]]
        width = number.itemsize * columns
        begin, stride = view.get("byteOffset", 0) + accessor.get("byteOffset", 0), view.get("byteStride", width)
        rows = np.ndarray((accessor["count"], columns), number, self._buffer, begin, (stride, number.itemsize))
        if accessor.get("normalized"):
            return rows / np.iinfo(number).max
        return rows.copy()

    def picture(self, index: int) -> Tuple[bytes, str]:
        """Bytes of an image, and the ending of its file's name."""
        image = self.json["images"][index]
        if "bufferView" in image:
            view = self.json["bufferViews"][image["bufferView"]]
            begin = view.get("byteOffset", 0)
            data = self._buffer[begin:begin + view["byteLength"]]
        else:
            import base64
            data = base64.b64decode(image["uri"].split(",", 1)[1])
        return data, ".png" if data[:4] == b"\x89PNG" else ".jpg"

    def parent(self, node: int) -> Optional[int]:
        return self._parents.get(node)

    def parent_from_node(self, index: int) -> npt.NDArray[np.float64]:
        """4 x 4, for columns."""
        node = self.json["nodes"][index]
        if "matrix" in node:
            return np.array(node["matrix"], float).reshape(4, 4).T
        transform = np.eye(4)
        x, y, z, w = node.get("rotation", (0, 0, 0, 1))
        transform[:3, :3] = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                                      [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                                      [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]) \
            * np.array(node.get("scale", (1, 1, 1)))
        transform[:3, 3] = node.get("translation", (0, 0, 0))
        return transform

    def world_from_node(self, index: int) -> npt.NDArray[np.float64]:
        above = self.parent(index)
        local = self.parent_from_node(index)
        return local if above is None else self.world_from_node(above) @ local
