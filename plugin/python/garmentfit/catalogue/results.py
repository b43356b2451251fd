# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of a catalogue: results.parquet and results.csv, one row for each pair of the plan."""
from __future__ import annotations

import collections
import csv
import io
import json
from pathlib import Path

from .store import Store, write_whole

_FIRST = ["pair", "body", "garment", "size", "exit", "reason", "message", "certified", "verdict", "type",
          "type_probability"]
_LAST = ["strain_median", "strain_max", "seconds", "memory_mb", "program_memory_mb", "parameters", "warnings",
         "body_file", "garment_files", "folder"]

_NUMBERS = {"type_probability", "strain_median", "strain_max", "seconds", "memory_mb", "program_memory_mb"}


def collect(store: Store) -> list:
    """One dict for each pair of the plan, in its order. Pairs not finished have the reason "waiting".

    Cost: one small file read for each pair."""
    rows = []
    for key, pair in store.read_plan().items():
        row = store.finished("dress", key)
        state = row or {"exit": None, "reason": "waiting", "message": ""}
        names = [name for name in state if name.startswith(("ease_", "layer")) and name != "layers"]
        flat = {name: state.get(name) for name in [*_FIRST[4:], *names, *_LAST[:5]]}
        flat.update(picture=bool(state.get("picture")), view=bool(state.get("view")), pair=key,
                    body=Path(pair["body"]).stem, garment=pair["garment"], size=pair["size"],
                    parameters=json.dumps(dict(pair["body_parameters"] + pair["parameters"])),
                    warnings=json.dumps(state.get("warnings", [])), body_file=pair["body"],
                    garment_files=";".join(pair["layers"]),
                    folder=str(store.pair_folder(key).relative_to(store.folder)) if row else "")
        rows.append(flat)
    return rows


def write_tables(store: Store, rows: list) -> None:
    """Writes results.csv and results.parquet. Lengths in metres, strain as a share, memory in 1e6 bytes."""
    import pyarrow
    import pyarrow.parquet

    names = columns(rows)
    text = io.StringIO()
    writer = csv.DictWriter(text, names, restval="", extrasaction="ignore")
    writer.writeheader()
    writer.writerows(rows)
    write_whole(store.folder / "results.csv", text.getvalue())
    schema = pyarrow.schema([(name, _type(name)) for name in names])
    table = pyarrow.table({name: _column(rows, name) for name in names}, schema=schema)
    sink = pyarrow.BufferOutputStream()
    pyarrow.parquet.write_table(table, sink)
    write_whole(store.folder / "results.parquet", sink.getvalue().to_pybytes())


def columns(rows: list) -> list:
    return [*_FIRST, *ease_columns(rows), *layer_columns(rows), *_LAST]


def ease_columns(rows: list) -> list:
    """One for each place that some garment goes round."""
    return sorted({name for row in rows for name in row if name.startswith("ease_")})


def layer_columns(rows: list) -> list:
    """Verdict, strain and ease of each garment of outfits of several layers."""
    return sorted({name for row in rows for name in row if name.startswith("layer")})


def summary(rows: list) -> collections.Counter:
    """How many pairs ended for each reason."""
    return collections.Counter(row["reason"] for row in rows)


def _type(name: str):
    import pyarrow
    if name == "exit":
        return pyarrow.int32()
    if name == "certified":
        return pyarrow.bool_()
    return pyarrow.float64() if _is_number(name) else pyarrow.string()


def _is_number(name: str) -> bool:
    plain = name.split("_", 1)[1] if name.startswith("layer") else name
    return plain in _NUMBERS or plain.startswith("ease_")


def _column(rows: list, name: str) -> list:
    values = [row.get(name) for row in rows]
    return [None if value is None else float(value) for value in values] if _is_number(name) else values
