# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a plan: bodies x garments x sizes x parameters, from TOML or CSV."""
from __future__ import annotations

import csv
import glob
import hashlib
import itertools
import json
import os
import stat
from dataclasses import asdict, dataclass, field
from pathlib import Path

try:
    import tomllib
except ImportError:  # Python 3.9 and 3.10
    import tomli as tomllib

_GARMENT_KEYS = {"name", "layers", "types", "sizes", "parameters"}
_PLAN_KEYS = {"bodies", "garments", "garment_files", "body_parameters", "parameters", "vary", "pairs", "limits"}
_LIMIT_KEYS = {"seconds", "memory_mb", "threads"}
_CSV_KEYS = {"body", "garment", "type", "size", "name"}


class PlanError(ValueError):
    """A plan that cannot be read; one line says where, what and what to do."""


@dataclass(frozen=True)
class Limits:
    """What one job may use. seconds: wall clock; memory_mb: resident memory of its processes, in 1e6 bytes."""
    seconds: float = 600  # guess: five times the program's own time limit
    memory_mb: float = 4000  # guess: the sample coat needs 150
    threads: int = 1  # measured in docs/catalogue-data.md: more pairs at a time use cores better


@dataclass(frozen=True)
class Pair:
    """One outfit on one body. Files are absolute; layers go from the inside out."""
    body: str
    garment: str  # name of the outfit
    layers: tuple
    types: tuple = ()
    size: str = ""
    body_parameters: tuple = ()  # (name, value) as text, sorted; also given when the body is rigged
    parameters: tuple = ()  # the same, for dressing only

    def flags(self) -> list:
        """Arguments of `garmentfit dress` after the files."""
        words = [word for name in self.types for word in ("--type", name)]
        return words + flags(self.body_parameters) + flags(self.parameters)


@dataclass(frozen=True)
class Plan:
    pairs: tuple
    limits: Limits = field(default_factory=Limits)


def flags(parameters) -> list:
    """--name value of each (name, value); a value of "on" is a flag alone."""
    words = []
    for name, value in parameters:
        words += ["--" + name.replace("_", "-")] + ([] if value == "on" else [value])
    return words


class Hashes:
    """SHA-256 of files, each file read once. Cost: one read of the file at its first call. Raises OSError."""

    def __init__(self):
        self._of_path = {}

    def of_file(self, path: str) -> str:
        if path not in self._of_path:
            digest = hashlib.sha256()
            for part in [path, *_buffers(path)]:
                with open(part, "rb") as file:
                    for block in iter(lambda: file.read(1 << 20), b""):
                        digest.update(block)
            self._of_path[path] = digest.hexdigest()
        return self._of_path[path]

    def of_rig(self, pair: Pair, version: str) -> str:
        """Name of the rig that all pairs of this body share."""
        return _digest(["rig", version, self.of_file(pair.body), pair.body_parameters])

    def of_pair(self, pair: Pair, version: str) -> str:
        """Name of a pair: content of the inputs, file names of garments (outputs bear them), parameters, version."""
        layers = [(Path(layer).name, self.of_file(layer)) for layer in pair.layers]
        return _digest(["dress", version, self.of_file(pair.body), layers, pair.types, pair.body_parameters,
                        pair.parameters])

    def of_unreadable(self, pair: Pair, version: str) -> str:
        """Name of a pair with a file that cannot be read: by paths. Once the file can be read it is another pair."""
        return _digest(["unreadable", version, pair.body, pair.layers, pair.types, pair.body_parameters,
                        pair.parameters])


def read_plan(path) -> Plan:
    """Reads plan.toml or plan.csv; paths in it are relative to its folder. Raises PlanError."""
    path = Path(path)
    try:
        text = path.read_text()
    except (OSError, UnicodeDecodeError) as error:
        raise PlanError(f"{path}: cannot be read ({error}); give a TOML or CSV file") from None
    plan = _from_csv(path, text) if path.suffix.lower() == ".csv" else _from_toml(path, text)
    if not plan.pairs:
        raise PlanError(f"{path}: no pair; check bodies and garments")
    return plan


def to_json(pair: Pair) -> dict:
    return asdict(pair)


def _digest(value) -> str:
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()[:24]


def _buffers(path: str) -> list:
    """Files that a .gltf refers to: they hold its vertices."""
    if not path.lower().endswith(".gltf"):
        return []
    try:
        uris = [buffer.get("uri", "data:") for buffer in json.loads(Path(path).read_text()).get("buffers", [])]
    except (ValueError, AttributeError):
        return []  # the program will say what is wrong with it
    files = [os.path.join(os.path.dirname(path), uri) for uri in uris if not uri.startswith("data:")]
    return [file for file in files if os.path.exists(file)]


def _from_toml(path: Path, text: str) -> Plan:
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise PlanError(f"{path}: {error}") from None
    _check_keys(path, "the plan", table, _PLAN_KEYS)
    limits = table.get("limits", {})
    _check_keys(path, "limits", limits, _LIMIT_KEYS)
    for name, value in limits.items():
        if not isinstance(value, int if name == "threads" else (int, float)) or not value > 0:
            raise PlanError(f"{path}: limits: {name} = {value!r}; give a positive number" +
                            (" without decimals" if name == "threads" else ""))
    bodies = _expand(path, table.get("bodies", []), "bodies")
    outfits = _outfits(path, table)
    if table.get("pairs", "product") == "zip":
        if len(bodies) != len(outfits):
            raise PlanError(f"{path}: pairs = \"zip\" with {len(bodies)} bodies and {len(outfits)} garments; "
                            "give as many of both, or pairs = \"product\"")
        matched = list(zip(bodies, outfits))
    elif table.get("pairs", "product") == "product":
        matched = list(itertools.product(bodies, outfits))
    else:
        raise PlanError(f"{path}: pairs is \"product\" or \"zip\"")
    body_parameters = _parameters(table.get("body_parameters", {}))
    pairs = []
    for (body, outfit), varied in itertools.product(matched, _variations(table.get("vary", {}))):
        parameters = _parameters({**table.get("parameters", {}), **outfit["parameters"], **varied})
        pairs.append(Pair(body, outfit["name"], outfit["layers"], outfit["types"], outfit["size"], body_parameters,
                          parameters))
    return Plan(tuple(dict.fromkeys(pairs)), Limits(**limits))


def _outfits(path: Path, table: dict) -> list:
    outfits = [dict(name=Path(file).stem, layers=(file,), types=(), size="", parameters={})
               for file in _expand(path, table.get("garment_files", []), "garment_files")]
    for number, entry in enumerate(table.get("garments", []), 1):
        where = f"garments entry {number}"
        _check_keys(path, where, entry, _GARMENT_KEYS)
        if not entry.get("layers"):
            raise PlanError(f"{path}: {where} has no layers; give a list of files, from the inside out")
        for size in entry.get("sizes", [""]):
            layers = tuple(_one_file(path, layer.replace("{size}", str(size))) for layer in entry["layers"])
            outfits.append(dict(name=entry.get("name", "+".join(Path(layer).stem for layer in layers)), layers=layers,
                                types=tuple(entry.get("types", ())), size=str(size),
                                parameters=entry.get("parameters", {})))
    return outfits


def _from_csv(path: Path, text: str) -> Plan:
    """Columns body and garment (layers separated by ;), optional type, size, name; all others are parameters."""
    rows = list(csv.DictReader(text.splitlines()))
    pairs = []
    for number, row in enumerate(rows, 2):
        if not row.get("body") or not row.get("garment"):
            raise PlanError(f"{path}:{number}: needs the columns body and garment")
        if None in row:
            raise PlanError(f"{path}:{number}: has more fields than the header")
        layers = tuple(_one_file(path, layer) for layer in row["garment"].split(";"))
        types = tuple(filter(None, (row.get("type") or "").split(";")))
        parameters = _parameters({name: value for name, value in row.items() if name not in _CSV_KEYS and value})
        name = row.get("name") or "+".join(Path(layer).stem for layer in layers)
        pairs.append(Pair(_one_file(path, row["body"]), name, layers, types, row.get("size") or "", (), parameters))
    return Plan(tuple(dict.fromkeys(pairs)))


def _variations(vary: dict) -> list:
    return [dict(zip(vary, values)) for values in itertools.product(*vary.values())]


def _parameters(table: dict) -> tuple:
    text = {name: ("on" if value is True else str(value)) for name, value in table.items() if value is not False}
    return tuple(sorted(text.items()))


def _expand(path: Path, patterns, what: str) -> list:
    if isinstance(patterns, str):
        patterns = [patterns]
    files = []
    for pattern in patterns:
        found = sorted(glob.glob(str(path.parent / pattern), recursive=True))
        if not found:
            raise PlanError(f"{path}: {what}: no file matches {pattern}")
        files += map(os.path.realpath, found)
    return list(dict.fromkeys(files))


def _one_file(path: Path, name: str) -> str:
    """Refuses what is certainly no file. What this run may not even look at is left to its pairs: they get a row."""
    file = os.path.join(path.parent, name.strip())
    try:
        if not stat.S_ISREG(os.stat(file).st_mode):
            raise PlanError(f"{path}: {name}: is not a file")
    except (FileNotFoundError, NotADirectoryError):
        raise PlanError(f"{path}: {name}: no such file") from None
    except OSError:
        pass
    return os.path.realpath(file)


def _check_keys(path: Path, where: str, table: dict, known: set) -> None:
    unknown = sorted(set(table) - known)
    if unknown:
        raise PlanError(f"{path}: {where}: unknown key {unknown[0]}; known are {', '.join(sorted(known))}")
