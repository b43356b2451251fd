# SPDX-License-Identifier: GPL-3.0-or-later
"""Dresses bodies in garments with PyMeshLab, saves the results and draws the ease.

    dress_in_python.py PLUGIN -o FOLDER --bodies woman.ply man.ply --garments tshirt.ply trousers.ply skirt.ply
"""

import argparse
import pathlib
import sys
import textwrap

import matplotlib
import numpy
import pymeshlab

matplotlib.use("Agg")
from matplotlib import cm, collections, colors, pyplot  # noqa: E402  (the backend must be chosen first)

WIDEST_SHARE = 0.03  # of the body's height: ease from here on is shown in the last colour


class Dressed:
    """One garment on one body, or the reason why it was not dressed."""

    def __init__(self, body, garment):
        self.meshes = pymeshlab.MeshSet()  # kept: PyMeshLab must not destroy a MeshSet in which a filter has failed
        self.meshes.load_new_mesh(str(body))
        self.meshes.load_new_mesh(str(garment))
        self.failure = ""
        try:
            self.meshes.apply_filter("generate_garment_fitting_dress", body=0, garment=1)
        except pymeshlab.PyMeshLabException as error:
            self.failure = str(error).split("Details: ")[-1].strip()
        self.meshes.set_current_mesh(len(self.meshes) - 1)  # the last layer is the dressed garment

    @property
    def body(self):
        return self.meshes.mesh(0)

    @property
    def garment(self):
        return self.meshes.current_mesh()

    @property
    def ease(self):
        """At each vertex of the garment, in the body's unit."""
        return self.garment.vertex_custom_scalar_attribute_array("ease")

    def in_words(self):
        if self.failure:
            return self.failure
        return f"ease {numpy.median(self.ease):.3f} (median), {numpy.quantile(self.ease, 0.95):.3f} (95%)"


def corners(mesh):
    return mesh.vertex_matrix()[mesh.face_matrix()]


def shaded(triangles, rgb):
    """Faces lit from the front."""
    normals = numpy.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    light = numpy.abs(normals[:, 2]) / numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-30)
    return numpy.asarray(rgb) * (0.35 + 0.65 * light)[:, None]


def draw(axes, dressed, scale):
    """The body and what it wears, from the front: +y up, facing +z."""
    triangles, rgb = corners(dressed.body), [(0.75, 0.75, 0.75)] * dressed.body.face_number()
    depth = triangles[:, :, 2].min(axis=1)  # cloth is nearer to the skin than faces are wide: draw it in front
    if not dressed.failure:
        ease = dressed.ease[dressed.garment.face_matrix()].mean(axis=1)
        garment = corners(dressed.garment)
        triangles = numpy.concatenate([triangles, garment])
        depth = numpy.concatenate([depth, garment[:, :, 2].max(axis=1)])
        rgb = numpy.concatenate([rgb, scale.to_rgba(ease)[:, :3]])
    order = numpy.argsort(depth)  # far ones first
    facecolors = shaded(triangles, rgb)[order]
    axes.add_collection(collections.PolyCollection(triangles[order][:, :, :2], facecolors=facecolors, edgecolors="face"))
    axes.autoscale()
    axes.set_aspect("equal")
    axes.axis("off")


def height(body):
    return numpy.ptp(body.vertex_matrix()[:, 1])


def draw_all(results, path):
    """One row for each body, one column for each garment."""
    bodies = list(dict.fromkeys(body for body, _ in results))
    garments = list(dict.fromkeys(garment for _, garment in results))
    widest = WIDEST_SHARE * max(height(dressed.body) for dressed in results.values())
    scale = cm.ScalarMappable(colors.Normalize(0, widest), "turbo_r")
    size = (3 * len(garments) + 1, 4 * len(bodies))
    figure, grid = pyplot.subplots(len(bodies), len(garments), figsize=size, squeeze=False, layout="constrained")
    for (body, garment), dressed in results.items():
        axes = grid[bodies.index(body), garments.index(garment)]
        draw(axes, dressed, scale)
        axes.set_title(f"{garment} on {body}\n{textwrap.fill(dressed.in_words(), 40)}", fontsize=9)
    figure.colorbar(scale, ax=grid, label="ease, in the body's unit", extend="max")
    figure.savefig(path, dpi=80)


def main():
    """Returns 1 where a garment was not dressed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("plugin", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--bodies", type=pathlib.Path, nargs="+", required=True)
    parser.add_argument("--garments", type=pathlib.Path, nargs="+", required=True)
    call = parser.parse_args()

    pymeshlab.load_plugin(str(call.plugin.resolve()))
    call.output.mkdir(parents=True, exist_ok=True)
    results = {}
    for body in call.bodies:
        for garment in call.garments:
            dressed = results[body.stem, garment.stem] = Dressed(body, garment)
            print(f"{garment.stem} on {body.stem}: {dressed.in_words()}", flush=True)
            if not dressed.failure:
                dressed.meshes.save_current_mesh(str(call.output / f"{garment.stem}_on_{body.stem}.ply"))
    draw_all(results, call.output / "ease.png")
    return int(any(dressed.failure for dressed in results.values()))


if __name__ == "__main__":
    sys.exit(main())
