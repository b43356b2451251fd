#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare the skin weights that the program finds with those that avatars bring. Prints a table in Markdown.

  measure_weights.py PROGRAM AVATAR.glb... [--keep DIR]

Each avatar is rigged three times: by its own skeleton and weights; by its own joints, weights found; by its shape alone.
"Segments": mean over the vertices of half the sum of differences of weights in nine segments (trunk, upper arms,
forearms with hands, thighs, shins with feet). "Posed": mean distance between the vertices, a share of the stature,
when each rig takes four poses by its own joints and weights. What is refused has a dash, and the reason on stderr.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

SEGMENTS = {"humerus": 0, "radius": 1, "femur": 2, "tibia": 3}  # of the left side; the right ones follow
TRUNK, SEGMENT_COUNT = 8, 9
PLY_TYPES = {"double": "<f8", "float": "<f4", "int": "<i4", "uchar": "u1"}

# Degrees about the body's axes: left (legs swing back), up (the left arm swings back), front (the left arm rises).
# Right limbs turn about the last two the other way. One entry for both sides, or one for each.
POSES = {
    "walk": {"lfemur": (-35, 0, 0), "ltibia": (45, 0, 0), "rfemur": (20, 0, 0), "rtibia": (20, 0, 0),
             "lhumerus": (20, 0, -25), "rhumerus": (-20, 0, -25), "radius": (0, -20, 0), "lowerback": (0, 10, 0)},
    "sit": {"femur": (-80, 0, 0), "tibia": (80, 0, 0), "humerus": (0, -40, -20), "radius": (0, -60, 0)},
    "raise": {"humerus": (0, 0, 50), "radius": (0, 0, 30), "femur": (0, 0, 20)},
    "bend": {"lowerback": (20, 0, 0), "upperback": (15, 0, 0), "thorax": (10, 0, 0), "upperneck": (15, 0, 0),
             "humerus": (0, -30, -30), "radius": (0, -70, 0)},
}


def read_rig(folder):
    """Vertices, dense weights over the bones of rig.json, and rig.json."""
    rig = json.loads((folder / "rig.json").read_text())
    raw = (folder / "rigged.ply").read_bytes()
    header, _, data = raw.partition(b"end_header\n")
    lines = header.decode().splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith("element vertex"))
    properties = []
    for line in lines[start + 1:]:
        if not line.startswith("property"):
            break
        _, kind, name = line.split()
        properties.append((name, PLY_TYPES[kind]))
    rows = np.frombuffer(data, properties, int(lines[start].split()[2]))
    weights = np.zeros((len(rows), len(rig["bones"])))
    for k in range(4):
        np.add.at(weights, (np.arange(len(rows)), np.clip(rows[f"joint{k}"], 0, None)), rows[f"weight{k}"])
    return np.stack([rows[axis] for axis in "xyz"], 1), weights, rig


def segment_of(bone):
    side, name = bone[0], bone[1:]
    return SEGMENTS[name] + 4 * (side == "r") if name in SEGMENTS and side in "lr" else TRUNK


def in_segments(weights, rig):
    sums = np.zeros((len(weights), SEGMENT_COUNT))
    for row, bone in enumerate(rig["bones"]):
        sums[:, segment_of(bone["name"])] += weights[:, row]
    return sums


def rotation(axis, degrees):
    cross = np.cross(np.eye(3), axis)
    angle = np.radians(degrees)
    return np.eye(3) + np.sin(angle) * cross.T + (1 - np.cos(angle)) * cross.T @ cross.T


def turn_of(bone, pose, axes):
    angles = pose.get(bone, pose.get(bone[1:], (0, 0, 0)) if bone[1:] in SEGMENTS else (0, 0, 0))
    if bone[0] == "r" and bone[1:] in SEGMENTS:
        angles = (angles[0], -angles[1], -angles[2])
    turn = np.eye(3)
    for axis, degrees in zip(axes, angles):
        turn = rotation(axis, degrees) @ turn
    return turn


def posed(vertices, weights, rig, pose, axes):
    """Linear blend skinning; turns are about the axes of the body, each after that of its parent."""
    moves, result = {}, np.zeros_like(vertices)
    for row, bone in enumerate(rig["bones"]):
        turn, shift = moves.get(bone["parent"], (np.eye(3), np.zeros(3)))
        head = np.array(bone["head"])
        own = turn @ turn_of(bone["name"], pose, axes)
        moves[bone["name"]] = own, turn @ head + shift - own @ head
        result += weights[:, [row]] * (vertices @ own.T + moves[bone["name"]][1])
    return result


def compare(own, other):
    """Disagreement in segments, and mean distance after posing, a share of the stature."""
    vertices, weights, rig = own
    up, front = np.array(rig["up"]), np.array(rig["front"])
    front = front - front @ up * up
    front /= np.linalg.norm(front)
    axes = (np.cross(up, front), up, front)
    segments = 0.5 * np.abs(in_segments(weights, rig) - in_segments(other[1], other[2])).sum(1).mean()
    distances = [np.linalg.norm(posed(*own, pose, axes) - posed(*other, pose, axes), axis=1).mean()
                 for pose in POSES.values()]
    return segments, np.mean(distances) / np.ptp(vertices @ up)


def rig_avatar(program, avatar, folder, *options):
    run = subprocess.run([program, "rig", avatar, "-o", folder, "--quiet", *options], capture_output=True, text=True)
    if run.returncode:
        print(f"{avatar.name} {' '.join(map(str, options))}: {run.stderr.strip()}", file=sys.stderr)
        return None
    if not options and json.loads((folder / "report.json").read_text())["body"].get("skeleton") != "file":
        print(f"{avatar.name}: its own skeleton is not used; {run.stderr.strip()}", file=sys.stderr)
        return None
    return read_rig(folder)


def row_of(program, avatar, folder):
    own = rig_avatar(program, avatar, folder / "own")
    if own is None:
        return [0] + 4 * [np.nan]
    joints = rig_avatar(program, avatar, folder / "joints", "--ignore-skin", "--joints", folder / "own" / "rig.json")
    shape = rig_avatar(program, avatar, folder / "shape", "--ignore-skin")
    return [len(own[0])] + [x for other in (joints, shape) for x in (compare(own, other) if other else 2 * (np.nan,))]


def cells(values):
    return " | ".join("-" if np.isnan(v) else f"{v:.3f}" if k % 2 == 0 else f"{v:.2%}" for k, v in enumerate(values))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("avatars", type=pathlib.Path, nargs="+")
    parser.add_argument("--keep", type=pathlib.Path, help="folder for the rigs")
    args = parser.parse_args()
    print("| avatar | vertices | own joints: segments | posed | shape alone: segments | posed |")
    print("| --- | ---: | ---: | ---: | ---: | ---: |")
    rows = []
    with tempfile.TemporaryDirectory() as temporary:
        for avatar in args.avatars:
            rows.append(row_of(args.program, avatar, (args.keep or pathlib.Path(temporary)) / avatar.stem))
            print(f"| {avatar.stem} | {rows[-1][0]} | {cells(rows[-1][1:])} |", flush=True)
    print(f"| median | | {cells(np.nanmedian(np.array(rows)[:, 1:], 0))} |")


if __name__ == "__main__":
    main()
