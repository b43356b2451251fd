#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds of rigging over vertices, and the exponent of growth between sizes.

    stages --benchmark_filter=rig --benchmark_format=json > rig.json
    chart_rig.py rig.json docs/images/rig_cost.png
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

runs = [r for r in json.load(open(sys.argv[1]))["benchmarks"] if "vertices" in r]
vertices = np.array([r["vertices"] for r in runs])
seconds = np.array([r["real_time"] for r in runs])
exponents = np.diff(np.log(seconds)) / np.diff(np.log(vertices))

plt.figure(figsize=(6, 3.6))
plt.loglog(vertices, seconds, "o-", color="#3a6ea5")
for i, exponent in enumerate(exponents):
    middle = np.sqrt(vertices[i] * vertices[i + 1]), np.sqrt(seconds[i] * seconds[i + 1])
    plt.annotate(f"{exponent:.2f}", middle, textcoords="offset points", xytext=(0, -14), ha="center")
plt.xlabel("vertices")
plt.ylabel("seconds")
plt.title("Closing and rigging a body; numbers are exponents of growth")
plt.grid(True, which="both", alpha=0.3)
plt.tight_layout()
plt.savefig(sys.argv[2], dpi=120)
slope = np.polyfit(np.log(vertices), np.log(seconds), 1)[0]
print(f"exponent over all sizes: {slope:.2f}")
print(*(f"{int(v)}: {s:.2f} s" for v, s in zip(vertices, seconds)), sep="\n")
