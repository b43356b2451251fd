#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make bodies that are far from the usual ones out of bodies with known joints: parts cut off, cartoon proportions,
many shells, things glued on. Deterministic.

  vary_bodies.py BODIES_DIR OUT_DIR [--rest BODY...] [--only BODY...]

BODIES_DIR has meshes and JSON files with `joints`, `end_sites` and `weights` (joints of MakeHuman's game rig). Each
variant gets OUT_DIR/<half>/<body>__<variant>.ply and a .json with its `joints` and `stature`. Every other body belongs
to the half `learn`, the rest to `judge`.
"""
import argparse
import json
import pathlib

import numpy as np
import trimesh

LEGS = {s: [f"{s}_hip", f"{s}_knee", f"{s}_ankle", f"{s}_toe"] for s in "lr"}
ARMS = {s: [f"{s}_shoulder", f"{s}_elbow", f"{s}_wrist"] for s in "lr"}


class Body:
    """A mesh with joints (name -> point) and dense weights (vertices x joints)."""

    def __init__(self, vertices, faces, joints, ends, names, weights):
        self.vertices, self.faces, self.joints, self.ends = vertices, faces, joints, ends
        self.names, self.weights = names, weights

    def copy(self):
        return Body(self.vertices.copy(), self.faces.copy(), {k: v.copy() for k, v in self.joints.items()},
                    {k: v.copy() for k, v in self.ends.items()}, self.names, self.weights)

    def weight_of(self, names):
        return self.weights[:, [self.names.index(n) for n in names]].sum(1)

    def main_joint(self):
        return self.weights.argmax(1)


def read_body(path, rest):
    truth = json.loads(path.read_text())
    table = json.loads((path.parent / truth["weights"]).read_text())
    file = path.parent / (truth["rest_mesh"] if rest else truth["mesh"])
    if not file.exists():
        file = path.parent / "rest" / pathlib.Path(file).name
    mesh = trimesh.load(file, process=False)
    weights = np.zeros((len(mesh.vertices), len(table["joint_names"])))
    for v, row in enumerate(table["rows"]):
        for joint, weight in row:
            weights[v, joint] += weight
    key = "rest_position" if rest else "position"
    return Body(np.array(mesh.vertices, float), np.array(mesh.faces), {j["name"]: np.array(j[key], float) for j in
                truth["joints"]}, {k: np.array(e[key], float) for k, e in truth["end_sites"].items()},
                table["joint_names"], weights)


def cap(vertices, faces):
    """Closes every boundary loop with a fan about its middle."""
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    twins = {(b, a) for a, b in edges.tolist()}
    following = {a: b for a, b in edges.tolist() if (a, b) not in twins}
    vertices, faces = vertices.tolist(), faces.tolist()
    while following:
        start, loop = next(iter(following)), []
        node = start
        while node in following:
            loop.append(node)
            node = following.pop(node)
        vertices.append(np.mean([vertices[n] for n in loop], axis=0))
        faces += [[b, a, len(vertices) - 1] for a, b in zip(loop, loop[1:] + loop[:1])]
    return np.array(vertices), np.array(faces)


def submesh(vertices, faces, keep):
    used, rows = np.unique(faces[keep], return_inverse=True)
    return cap(vertices[used], rows.reshape(-1, 3))


def cut(body, names):
    b = body.copy()
    lost = np.isin(b.main_joint(), [b.names.index(n) for n in names])
    b.vertices, b.faces = submesh(b.vertices, b.faces, ~lost[b.faces].any(1))
    pieces = trimesh.Trimesh(b.vertices, b.faces, process=False).split(only_watertight=False)
    main = max(pieces, key=lambda p: len(p.faces))
    b.vertices, b.faces = np.array(main.vertices), np.array(main.faces)
    return b


def scale_part(body, names, pivot, factor):
    b = body.copy()
    centre = b.joints[pivot].copy()
    w = b.weight_of(names)[:, None]
    b.vertices = b.vertices + w * (factor - 1) * (b.vertices - centre)
    for table in (b.joints, b.ends):
        for name in table:
            if name in names or (table is b.ends and "head" in names and name == "head_top"):
                table[name] = centre + factor * (table[name] - centre)
    return b


def stretch_chain(body, chain, factor, beyond):
    """Scales a limb's bones along their directions; what is beyond the last bone moves with it."""
    b = body.copy()
    moved = np.zeros_like(b.vertices)
    offset = np.zeros(3)
    new = dict(b.joints)
    for i, name in enumerate(chain):
        w = b.weight_of([name] + (beyond if i == len(chain) - 1 else []))[:, None]
        local = b.vertices - b.joints[name]
        shift = np.tile(offset, (len(b.vertices), 1))
        if i + 1 < len(chain):
            bone = b.joints[chain[i + 1]] - b.joints[name]
            length = np.linalg.norm(bone)
            along = np.clip(local @ bone / length, 0, length)
            shift += (factor - 1) * along[:, None] * bone / length
        moved += w * shift
        new[name] = b.joints[name] + offset
        if i + 1 < len(chain):
            offset = offset + (factor - 1) * bone
    for name in beyond:
        new[name] = b.joints[name] + offset
    for end in b.ends:
        if end[:2] == chain[0][:2] and ("hand" in end) == ("shoulder" in chain[0]) and "head" not in end:
            b.ends[end] = b.ends[end] + offset
    b.vertices, b.joints = b.vertices + moved, new
    return b


def limbs(body, legs=1.0, arms=1.0):
    for s in "lr":
        body = stretch_chain(body, LEGS[s][:3], legs, [LEGS[s][3]])
        body = stretch_chain(body, ARMS[s], arms, [])
    return body


def toon(body, head, legs, arms):
    return limbs(scale_part(body, ["head"], "head", head), legs, arms)


def shells(body, count, gap):
    """Capped shells of the main joints, the larger ones split by the nearest of several centres, each shrunk."""
    b = body.copy()
    rng = np.random.default_rng(count)
    centres = b.vertices[b.faces].mean(1)
    part = b.main_joint()[b.faces[:, 0]]
    while part.max() + 1 and len(np.unique(part)) < count:
        labels, sizes = np.unique(part, return_counts=True)
        largest = np.flatnonzero(part == labels[sizes.argmax()])
        points = centres[largest]
        axis = np.linalg.svd(points - points.mean(0), full_matrices=False)[2][0]
        along = points @ axis
        part[largest[along > np.median(along) + 0.02 * rng.uniform(-1, 1) * np.ptp(along)]] = part.max() + 1
    vertices, faces, base = [], [], 0
    for label in np.unique(part):
        if (part == label).sum() < 8:
            continue
        v, f = submesh(b.vertices, b.faces, part == label)
        middle = (v.min(0) + v.max(0)) / 2
        size = np.linalg.norm(np.ptp(v, axis=0))
        v = middle + max(0.6, 1 - 2 * gap / size) * (v - middle)
        vertices.append(v)
        faces.append(f + base)
        base += len(v)
    b.vertices, b.faces = np.concatenate(vertices), np.concatenate(faces)
    return b


def tube(path, radii, sides=16):
    path, rings = np.asarray(path, float), []
    for i, p in enumerate(path):
        t = path[min(i + 1, len(path) - 1)] - path[max(i - 1, 0)]
        t /= np.linalg.norm(t)
        u = np.cross(t, [1, 0, 0] if abs(t[0]) < 0.9 else [0, 1, 0])
        u /= np.linalg.norm(u)
        w = np.cross(t, u)
        a = np.linspace(0, 2 * np.pi, sides, endpoint=False)
        rings.append(p + radii[i] * (np.cos(a)[:, None] * u + np.sin(a)[:, None] * w))
    v = np.concatenate(rings)
    f = []
    for i in range(len(path) - 1):
        for k in range(sides):
            a, c = i * sides + k, i * sides + (k + 1) % sides
            f += [[a, c, a + sides], [c, c + sides, a + sides]]
    v, f = cap(v, np.array(f))
    mesh = trimesh.Trimesh(v, f, process=False)
    if mesh.volume < 0:
        mesh.invert()
    return mesh


def glue(body, additions, joined):
    b = body.copy()
    meshes = [trimesh.Trimesh(b.vertices, b.faces, process=False)] + additions
    union = trimesh.boolean.union(meshes, engine="manifold", check_volume=False) if joined else None
    mesh = union if union is not None and len(union.faces) else trimesh.util.concatenate(meshes)
    b.vertices, b.faces = np.array(mesh.vertices), np.array(mesh.faces)
    return b


def frame(body):
    j = body.joints
    up = j["neck"] - j["pelvis"]
    up /= np.linalg.norm(up)
    left = j["l_hip"] - j["r_hip"]
    left = left - left @ up * up
    left /= np.linalg.norm(left)
    return up, left, np.cross(left, up), np.linalg.norm(body.ends["head_top"] - j["head"]), np.ptp(body.vertices[:, 1])


def tail(body, joined):
    up, left, front, _, size = frame(body)
    start = body.joints["pelvis"] + 0.02 * size * up
    t = np.linspace(0, 1, 14)
    path = [start - front * 0.34 * size * a + up * size * (0.30 * a * a - 0.12 * a) for a in t]
    return glue(body, [tube(path, 0.035 * size * (1 - 0.6 * t))], joined)


def ears(body, joined):
    up, left, front, head, size = frame(body)
    top = body.ends["head_top"]
    parts = []
    for s in (1, -1):
        start = top - up * 0.25 * head + left * s * 0.3 * head
        t = np.linspace(0, 1, 8)
        parts.append(tube([start + a * size * 0.18 * (up + 0.5 * s * left) for a in t], size * 0.035 * (1.05 - t)))
    return glue(body, parts, joined)


def wings(body, joined):
    up, left, front, _, size = frame(body)
    parts = []
    for s in (1, -1):
        start = body.joints["spine3"] - 0.01 * size * front
        box = trimesh.creation.box(extents=[0.42 * size, 0.3 * size, 0.03 * size])
        for _ in range(3):
            box = box.subdivide()
        taper = 0.35 + 0.65 * (box.vertices[:, 0] / (0.42 * size) + 0.5)
        v = box.vertices * np.stack([np.ones(len(taper)), taper, np.ones(len(taper))], 1) + [0.23 * size, 0, 0]
        out = 0.8 * s * left - 0.6 * front
        side = np.cross(up, out)
        rot = np.stack([out, up, -side if s < 0 else side], 1)
        mesh = trimesh.Trimesh(start + v @ rot.T + 0.1 * size * up, box.faces, process=False)
        if mesh.volume < 0:
            mesh.invert()
        parts.append(mesh)
    return glue(body, parts, joined)


def hair(body, joined):
    up, left, front, head, size = frame(body)
    middle = (body.joints["head"] + body.ends["head_top"]) / 2
    ball = trimesh.creation.icosphere(subdivisions=3, radius=0.13 * size)
    ball.apply_translation(middle - 0.04 * size * front + 0.03 * size * up)
    t = np.linspace(0, 1, 12)
    pony = tube([middle - front * size * (0.1 + 0.16 * np.sqrt(a)) - up * size * 0.28 * a * a for a in t],
                size * 0.04 * (1 - 0.5 * t))
    return glue(body, [ball, pony], joined)


def skirt(body, joined):
    up, left, front, _, size = frame(body)
    t = np.linspace(0, 1, 10)
    path = [body.joints["pelvis"] + up * size * (0.06 - 0.24 * a) for a in t]
    return glue(body, [tube(path, size * (0.1 + 0.07 * t), 32)], joined)


def fat(body):
    b = body.copy()
    normals = trimesh.Trimesh(b.vertices, b.faces, process=False).vertex_normals
    trunk = b.weight_of(["pelvis", "spine1", "spine2"])
    trunk += 0.35 * b.weight_of(["l_hip", "r_hip", "spine3", "l_shoulder", "r_shoulder"])
    b.vertices = b.vertices + 0.07 * np.ptp(b.vertices[:, 1]) * np.clip(trunk, 0, 1)[:, None] * normals
    return b


def low_poly(body, faces):
    b = body.copy()
    mesh = trimesh.Trimesh(b.vertices, b.faces, process=False).simplify_quadric_decimation(face_count=faces)
    b.vertices, b.faces = np.array(mesh.vertices), np.array(mesh.faces)
    return b


HANDS, FEET = ["l_wrist", "r_wrist"], ["l_ankle", "r_ankle", "l_toe", "r_toe"]
VARIANTS = {
    "plain": lambda b: b,
    "no_head": lambda b: cut(b, ["head", "neck"]),
    "no_hands": lambda b: cut(b, HANDS),
    "no_feet": lambda b: cut(b, FEET),
    "torso": lambda b: cut(b, ["head", "neck"] + HANDS + FEET),
    "head25": lambda b: scale_part(b, ["head"], "head", 2.5),
    "legs04": lambda b: limbs(b, legs=0.4),
    "arms15": lambda b: limbs(b, arms=1.5),
    "chibi": lambda b: toon(b, 2.5, 0.45, 0.7),
    "ogre": lambda b: toon(fat(b), 0.8, 0.6, 1.3),
    "shells20": lambda b: shells(b, 20, 0.004),
    "shells55": lambda b: shells(b, 55, 0.006),
    "shells100": lambda b: shells(b, 100, 0.003),
    "tail": lambda b: tail(b, True),
    "tail_loose": lambda b: tail(b, False),
    "ears": lambda b: ears(b, True),
    "wings": lambda b: wings(b, True),
    "hair": lambda b: hair(b, True),
    "skirt": lambda b: skirt(b, True),
    "fat": fat,
    "low500": lambda b: low_poly(b, 500),
    "fox": lambda b: ears(tail(toon(b, 1.8, 0.6, 0.8), True), True),
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bodies", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--rest", nargs="*", default=[], help="bodies that are taken in their rest pose")
    parser.add_argument("--only", nargs="*", help="bodies")
    args = parser.parse_args()
    files = sorted(p for p in args.bodies.glob("*.json") if "joints" in json.loads(p.read_text())
                   and (not args.only or p.stem in args.only))
    for i, path in enumerate(files):
        if not json.loads(path.read_text()).get("joints"):
            continue
        body = read_body(path, path.stem in args.rest)
        folder = args.out / ("learn" if i % 2 == 0 else "judge")
        folder.mkdir(parents=True, exist_ok=True)
        for name, vary in VARIANTS.items():
            b = vary(body)
            stem = folder / f"{path.stem}__{name}"
            trimesh.Trimesh(b.vertices, b.faces, process=False).export(f"{stem}.ply")
            truth = {"joints": [{"name": k, "position": v.tolist()} for k, v in b.joints.items()],
                     "measurements_rest": {"stature": float(np.ptp(b.vertices[:, 1]))}}
            stem.with_suffix(".json").write_text(json.dumps(truth))


if __name__ == "__main__":
    main()
