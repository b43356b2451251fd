# SPDX-License-Identifier: GPL-3.0-or-later
"""Dresses bodies in garments with PyMeshLab, saves what came of it and plots the ease.

    dress_in_python.py PLUGIN -o FOLDER --bodies woman.ply man.ply --garments tshirt.ply skirt.ply coat.ply
"""

import argparse
import pathlib

import matplotlib
import numpy
import pymeshlab

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (the backend must be chosen first)


def dress(body, garment, folder):
    """Ease at each vertex in the body's unit, or the reason why there is none."""
    meshes = pymeshlab.MeshSet()
    meshes.load_new_mesh(str(body))
    meshes.load_new_mesh(str(garment))
    try:
        meshes.apply_filter("generate_garment_fitting_dress", body=0, garment=1)
    except pymeshlab.PyMeshLabException as error:
        return meshes, str(error).split("Details: ")[-1]
    meshes.set_current_mesh(len(meshes) - 1)  # the last layer is the dressed garment
    meshes.save_current_mesh(str(folder / f"{garment.stem}_on_{body.stem}.ply"))
    return meshes, meshes.current_mesh().vertex_custom_scalar_attribute_array("ease")


def plot(axes, body, results):
    shown = {garment: ease for garment, ease in results.items() if not isinstance(ease, str)}
    if shown:
        axes.violinplot([numpy.asarray(ease) for ease in shown.values()], showmedians=True)
    axes.set_xticks(range(1, len(shown) + 1), shown.keys())
    axes.set_title(body)
    axes.set_ylabel("ease, in the body's unit")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("plugin", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--bodies", type=pathlib.Path, nargs="+", required=True)
    parser.add_argument("--garments", type=pathlib.Path, nargs="+", required=True)
    call = parser.parse_args()

    pymeshlab.load_plugin(str(call.plugin.resolve()))
    call.output.mkdir(parents=True, exist_ok=True)
    kept = []  # PyMeshLab must not destroy a MeshSet in which a filter has failed
    figure, rows = pyplot.subplots(1, len(call.bodies), figsize=(5 * len(call.bodies), 4), sharey=True, squeeze=False)
    for axes, body in zip(rows[0], call.bodies):
        results = {}
        for garment in call.garments:
            meshes, ease = dress(body, garment, call.output)
            kept.append(meshes)
            results[garment.stem] = ease
            print(f"{garment.stem} on {body.stem}:", ease if isinstance(ease, str) else f"ease {numpy.median(ease):.3f}")
        plot(axes, body.stem, results)
    figure.tight_layout()
    figure.savefig(call.output / "ease.png", dpi=100)


if __name__ == "__main__":
    main()
