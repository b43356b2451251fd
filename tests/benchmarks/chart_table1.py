#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Seconds of the three methods for each pair of Table 1, one thread.

    table1 > table1.txt
    chart_table1.py table1.txt docs/images/fit-table1.png
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in open(sys.argv[1]) if line.startswith("| ")]
rows = [row for row in rows if row[0].isdigit()]
names = [f"{row[0]} {row[1].partition('_')[2]}" for row in rows]
columns = {"tisserand": (7, "#b8442f"), "paper by scan": (6, "#d9a441"), "paper by KD-tree": (5, "#5b9a68"), "fast": (4, "#3a6ea5")}

plt.figure(figsize=(7, 3.8))
for name, (column, color) in columns.items():
    plt.semilogy(names, [float(row[column].split("/")[0]) for row in rows], "o-", color=color, label=name)
plt.ylabel("seconds, one thread")
plt.xticks(rotation=35, ha="right")
plt.grid(True, which="both", alpha=0.3)
plt.legend(ncol=4, loc="upper center", bbox_to_anchor=(0.5, 1.15), frameon=False)
plt.tight_layout()
plt.savefig(sys.argv[2], dpi=120)
