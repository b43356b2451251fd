#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds over vertices, a line for each benchmark, and the exponents of growth between sizes.

    stages --benchmark_filter='drape|recover' --benchmark_format=json > cloth.json
    chart_cost.py cloth.json "Draping and recovering a coat" docs/images/drape_cost.png
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

source, title, picture = sys.argv[1:]
runs = [r for r in json.load(open(source))["benchmarks"] if "vertices" in r]

plt.figure(figsize=(6, 3.6))
for stage in dict.fromkeys(r["name"].split("/")[0] for r in runs):
    of_stage = [r for r in runs if r["name"].split("/")[0] == stage]
    vertices = np.array([r["vertices"] for r in of_stage])
    seconds = np.array([r["real_time"] for r in of_stage])
    exponents = np.diff(np.log(seconds)) / np.diff(np.log(vertices))
    plt.loglog(vertices, seconds, "o-", label=stage)
    for i, exponent in enumerate(exponents):
        middle = np.sqrt(vertices[i] * vertices[i + 1]), np.sqrt(seconds[i] * seconds[i + 1])
        plt.annotate(f"{exponent:.2f}", middle, textcoords="offset points", xytext=(0, -14), ha="center")
    slope = np.polyfit(np.log(vertices), np.log(seconds), 1)[0]
    print(f"{stage}: exponent over all sizes {slope:.2f}")
    print(*(f"  {int(v)}: {s:.2f} s" for v, s in zip(vertices, seconds)), sep="\n")
plt.xlabel("vertices")
plt.ylabel("seconds")
plt.title(f"{title}; numbers are exponents of growth", fontsize=9)
plt.legend()
plt.grid(True, which="both", alpha=0.3)
plt.tight_layout()
plt.savefig(picture, dpi=120)
