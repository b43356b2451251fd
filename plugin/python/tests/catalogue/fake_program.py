# SPDX-License-Identifier: GPL-3.0-or-later
"""Stands in for the program in tests of scheduling: quick, and it crashes, hangs or eats memory when asked to.

What it does stands in the garment's file: ok, crash, hang, memory, large, small, wrong. Each process that ends its
work adds a line to the file named by FAKE_COUNTS, by one write, so that lines of processes do not mix."""
import json
import os
import signal
import sys
import time
from pathlib import Path


def main(words):
    if words == ["--version"]:
        print("fake 1")
        return 0
    output = Path(words[words.index("-o") + 1])
    inputs = [word for word in words[1:] if word.endswith(".ply")]
    todo = Path(inputs[-1]).read_text().split()[0] if words[0] == "dress" else "ok"
    if todo == "crash":
        os.abort()
    if todo == "hang":
        time.sleep(1000)
    if todo == "memory":
        eaten = bytearray(os.urandom(1 << 20) * 300)
        time.sleep(len(eaten))
    if todo == "large":
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL)  # as in a program that is not Python
        Path("large").write_bytes(bytes(8_000_000))
    if todo == "wrong":
        print(json.dumps({"error": {"code": "no_faces", "message": "coat.ply: has no faces"}}))
        return 2
    time.sleep(float(os.environ.get("FAKE_SECONDS", "0")))
    output.mkdir()
    garments = [{"file": Path(name).name, "type": "coat", "type_probability": 0.9, "verdict": {"fit": "fits"},
                 "strain": {"median": 0.01, "max": 0.1}, "girths": [{"place": "waist", "ease": 0.04 + 0.01 * layer}]}
                for layer, name in enumerate(inputs[1:])]
    (output / "report.json").write_text(json.dumps({"certified": True, "body": {"metres_per_unit": 1},
                                                    "garments": garments, "peak_memory_bytes": 1e6}))
    (output / "rig.json").write_text("{}")
    if os.environ.get("FAKE_COUNTS"):
        with open(os.environ["FAKE_COUNTS"], "ab", buffering=0) as counts:
            counts.write((" ".join(inputs) + "\n").encode())
    return 3 if todo == "small" else 0


sys.exit(main(sys.argv[1:]))
