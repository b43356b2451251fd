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
_SHOWN = ["pair", "body", "garment", "size", "reason", "message", "verdict", "type", "type_probability", "seconds",
          "strain_max", "folder", "picture", "view"]


def write_page(store: Store, rows: list) -> None:
    """Writes index.html and the folder page/. rows: of results.collect."""
    folder = store.folder / "page"
    folder.mkdir(exist_ok=True)
    for name in ("catalogue.js", "catalogue.css", "three.min.js", "three.LICENSE"):
        write_whole(folder / name, (_WEB / name).read_bytes())
    names = [*_SHOWN, *ease_columns(rows)]
    table = dict(columns=names, rows=[[row.get(name) for name in names] for row in rows],
                 summary=summary(rows).most_common())
    write_whole(folder / "rows.js", f"const catalogue = {json.dumps(table)};\n".replace("</", "<\\/"))
    write_whole(store.folder / "index.html", (_WEB / "index.html").read_text())
