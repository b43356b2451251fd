# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in PyMeshLab: pymeshlab_test.py PLUGIN SAMPLES BODIES PROGRAM"""

import ctypes
import gc
import json
import os
import resource
import struct
import subprocess
import sys
import tempfile
import unittest

import numpy
import pymeshlab

PLUGIN, SAMPLES, BODIES, PROGRAM = sys.argv[1:5]
BODY, SKIRT = os.path.join(SAMPLES, "walking_woman.ply"), os.path.join(SAMPLES, "skirt.ply")
SMALL_BODY = os.path.join(BODIES, "man_a_pose.ply")
# its name since 2023, and before
Percent = getattr(pymeshlab, "PercentageValue", getattr(pymeshlab, "Percentage", None))


# PyMeshLab corrupts memory when it destroys a MeshSet in which a filter has failed, also one of MeshLab's own.
KEPT = []


def opened(*paths):
    meshes = pymeshlab.MeshSet()
    for path in paths:
        meshes.load_new_mesh(path)
    return meshes


def labels(meshes):
    return [meshes.mesh(layer).label() for layer in range(len(meshes))]


def glb_json(path):
    with open(path, "rb") as file:
        return json.loads(file.read(struct.unpack("<5I", file.read(20))[3]))


def resident_bytes():
    gc.collect()
    ctypes.CDLL(None).malloc_trim(0)
    with open("/proc/self/statm", encoding="ascii") as pages:
        return int(pages.read().split()[1]) * resource.getpagesize()


class GarmentFitting(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        pymeshlab.load_plugin(PLUGIN)

    def refusal(self, meshes, name, **parameters):
        """Returns why a filter failed, and checks that it changed nothing."""
        KEPT.append(meshes)
        before, given = labels(meshes), [meshes.mesh(layer).vertex_matrix() for layer in range(len(meshes))]
        with self.assertRaises(pymeshlab.PyMeshLabException) as raised:
            meshes.apply_filter(name, **parameters)
        self.assertEqual(labels(meshes), before)
        for layer, positions in enumerate(given):
            numpy.testing.assert_array_equal(meshes.mesh(layer).vertex_matrix(), positions)
        return str(raised.exception)

    def test_rigs_a_body_into_two_new_layers(self):
        meshes = opened(BODY)
        given = meshes.mesh(0).vertex_matrix().copy()
        numbers = meshes.apply_filter("generate_garment_fitting_rig", body=0)
        self.assertEqual(labels(meshes), ["walking_woman.ply", "walking_woman rigged", "walking_woman skeleton"])
        self.assertEqual(meshes.current_mesh_id(), 0)
        numpy.testing.assert_array_equal(meshes.mesh(0).vertex_matrix(), given)
        self.assertGreater(numbers["side_confidence"], 0.5)
        self.assertEqual(meshes.mesh(2).edge_number(), 22)
        weights = [meshes.mesh(1).vertex_custom_scalar_attribute_array(f"weight{slot}") for slot in range(4)]
        numpy.testing.assert_allclose(sum(weights), 1, atol=1e-12)

    def test_keeps_the_rig_in_the_document(self):
        meshes = opened(BODY, SKIRT)
        self.assertIn("run Garment Fitting: Rig Body", self.refusal(meshes, "generate_garment_fitting_fit"))
        meshes.apply_filter("generate_garment_fitting_rig")
        meshes.apply_filter("generate_garment_fitting_fit", body=0, garment=1)
        self.assertIn("walking_woman in the pose of skirt", labels(meshes))

    def test_says_what_is_wrong(self):
        self.assertIn("at least one mesh", self.refusal(opened(), "generate_garment_fitting_rig"))
        self.assertIn("out of range", self.refusal(opened(BODY), "generate_garment_fitting_rig", proxy_vertices=3))
        words = self.refusal(opened(BODY, SKIRT), "generate_garment_fitting_dress", garment=0)
        self.assertIn("is already chosen as the body", words)
        self.assertIn("give a human body", self.refusal(opened(SKIRT), "generate_garment_fitting_rig"))
        self.refusal(opened(BODY, SKIRT), "generate_garment_fitting_dress", garment=7)  # with a message of PyMeshLab

    def test_says_where_a_garment_is_too_small(self):
        meshes = opened(SMALL_BODY, SKIRT)
        meshes.set_current_mesh(1)
        garment = meshes.mesh(1)
        centre = garment.vertex_matrix().mean(axis=0)
        narrow = centre + (garment.vertex_matrix() - centre) * [0.72, 1, 0.72]
        meshes.add_mesh(pymeshlab.Mesh(narrow, garment.face_matrix()), "narrow")
        words = self.refusal(
            meshes, "generate_garment_fitting_dress", body=0, garment=2, second_garment=2, third_garment=2
        )
        self.assertIn("narrow is too small", words)

    def test_takes_lengths_as_a_share_of_the_bodys_box(self):
        meshes = opened(BODY, SKIRT)
        words = self.refusal(meshes, "generate_garment_fitting_dress", contact_distance=Percent(50))
        self.assertIn("contact_distance: 0.95", words)

    def test_dresses_to_the_numbers_of_the_command_line(self):
        meshes = opened(SMALL_BODY, SKIRT)
        numbers = meshes.apply_filter("generate_garment_fitting_dress", body=0, garment=1)
        self.assertGreater(numbers["min_distance"], 0)
        worn = labels(meshes).index("skirt on man_a_pose")
        dressed = meshes.mesh(worn)
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "dress", SMALL_BODY, SKIRT, "--quiet", "-o", folder + "/out"], check=True)
            by_program = opened(folder + "/out/skirt.ply")  # a file of floats; a mesh lives no longer than its set
            positions = by_program.current_mesh().vertex_matrix()
            numpy.testing.assert_array_equal(
                dressed.vertex_matrix().astype(numpy.float32), positions.astype(numpy.float32)
            )
        ease = dressed.vertex_custom_scalar_attribute_array("ease")
        numpy.testing.assert_allclose(dressed.vertex_scalar_array(), ease, atol=1e-6)

        girths = meshes.apply_filter("get_garment_fitting_measurements", body=0, garment=1, worn=worn)
        self.assertGreater(girths["hips garment"], girths["hips body"])

    def test_saves_an_outfit_on_the_skeleton_of_the_bodys_file(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "rig", BODY, "--quiet", "-o", folder + "/rigged"], check=True)
            avatar = folder + "/rigged/rigged.glb"
            meshes = opened(avatar, SKIRT)
            meshes.apply_filter("generate_garment_fitting_dress", body=0, garment=1, quality="draft")
            meshes.apply_filter("save_garment_fitting_outfit", body=0, file=folder + "/outfit.glb")
            given, outfit = glb_json(avatar), glb_json(folder + "/outfit.glb")
            self.assertEqual(outfit["nodes"][:-1], given["nodes"])
            self.assertEqual(outfit["nodes"][-1]["name"], "skirt")
            self.assertEqual(len(outfit["skins"]), 2)
            words = self.refusal(meshes, "save_garment_fitting_outfit", body=0, file=folder + "/outfit.glb",
                                 body_file=folder + "/gone.glb")
            self.assertIn("gone.glb", words)

    def test_keeps_memory_level_over_twenty_runs(self):
        def run():
            meshes = opened(SMALL_BODY, SKIRT)
            meshes.apply_filter("generate_garment_fitting_rig", body=0)
            meshes.apply_filter("generate_garment_fitting_fit", body=0, garment=1)

        for _ in range(5):
            run()
        before = resident_bytes()
        for _ in range(20):
            run()
        growth = (resident_bytes() - before) / 2**20
        print(f"resident memory grew by {growth:.1f} MB over 20 runs")
        self.assertLess(growth, 8)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
