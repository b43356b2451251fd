# SPDX-License-Identifier: GPL-3.0-or-later
"""DIR/index.html: the results to look at. It opens from disk, without a server or a network.

A page from disk may load scripts and images, but read no other file. So rows and views are scripts that call a function
of the page, and three.js is its classic build."""
from __future__ import annotations

import json
from pathlib import Path

from .results import ease_columns, summary
from .store import Store, write_whole

_WEB = Path(__file__).parent / "web"
_SHOWN = ["pair", "body", "garment", "size", "variant", "reason", "message", "verdict", "type", "type_probability",
          "seconds", "strain_max", "folder", "picture", "view"]


def write_page(store: Store, rows: list) -> None:
    """Writes index.html and the folder page/. rows: of results.collect."""
    folder = store.folder / "page"
    folder.mkdir(exist_ok=True)
    for name in ("catalogue.js", "catalogue.css", "three.min.js", "three.LICENSE"):
        write_whole(folder / name, (_WEB / name).read_bytes())
    names = [*_SHOWN, *ease_columns(rows)]
    rows = [dict(row, variant=variant) for row, variant in zip(rows, _variants(rows))]
    table = dict(columns=names, rows=[[row.get(name) for name in names] for row in rows],
                 summary=summary(rows).most_common())
    write_whole(folder / "rows.js", f"const catalogue = {json.dumps(table)};\n".replace("</", "<\\/"))
    write_whole(store.folder / "index.html", (_WEB / "index.html").read_text())


def _variants(rows: list) -> list:
    """For each row the parameters, as text, that are not the same in all rows: they tell its pair from others."""
    tables = [json.loads(row["parameters"]) for row in rows]
    names = sorted({name for table in tables for name in table})
    varied = [name for name in names if len({table.get(name) for table in tables}) > 1]
    return [", ".join(f"{name} {table[name]}" for name in varied if name in table) for table in tables]
