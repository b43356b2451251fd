# SPDX-License-Identifier: GPL-3.0-or-later
"""The plugin in PyMeshLab: pymeshlab_test.py PLUGIN SAMPLES PROGRAM"""

import os
import subprocess
import sys
import tempfile
import unittest

import numpy
import pymeshlab

PLUGIN, SAMPLES, PROGRAM = sys.argv[1:4]
BODY, SKIRT = os.path.join(SAMPLES, "walking_woman.ply"), os.path.join(SAMPLES, "skirt.ply")
Percent = getattr(pymeshlab, "PercentageValue", getattr(pymeshlab, "Percentage", None))  # its name since 2023, and before


# PyMeshLab corrupts memory when it destroys a MeshSet in which a filter has failed, also one of MeshLab's own.
KEPT = []


def opened(*paths):
    meshes = pymeshlab.MeshSet()
    KEPT.append(meshes)
    for path in paths:
        meshes.load_new_mesh(path)
    return meshes


def labels(meshes):
    return [meshes.mesh(layer).label() for layer in range(len(meshes))]


def layer_called(meshes, label):
    return labels(meshes).index(label)


class GarmentFitting(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        pymeshlab.load_plugin(PLUGIN)

    def refusal(self, meshes, name, **parameters):
        before = labels(meshes)
        with self.assertRaises(pymeshlab.PyMeshLabException) as raised:
            meshes.apply_filter(name, **parameters)
        self.assertEqual(labels(meshes), before)
        return str(raised.exception)

    def test_rigs_a_body_into_two_new_layers(self):
        meshes = opened(BODY)
        given = meshes.mesh(0).vertex_matrix().copy()
        numbers = meshes.apply_filter("generate_garment_fitting_rig", body=0)
        self.assertEqual(labels(meshes), ["walking_woman.ply", "walking_woman rigged", "walking_woman skeleton"])
        self.assertEqual(meshes.current_mesh_id(), 0)
        self.assertTrue(numpy.array_equal(meshes.mesh(0).vertex_matrix(), given))
        self.assertGreater(numbers["side_margin"], 0.5)
        self.assertEqual(meshes.mesh(2).edge_number(), 22)
        weights = [meshes.mesh(1).vertex_custom_scalar_attribute_array(f"weight{slot}") for slot in range(4)]
        numpy.testing.assert_allclose(sum(weights), 1, atol=1e-12)

    def test_hands_the_rig_on_in_the_document(self):
        meshes = opened(BODY, SKIRT)
        self.assertIn("run Garment Fitting: Rig Body", self.refusal(meshes, "generate_garment_fitting_fit"))
        meshes.apply_filter("generate_garment_fitting_rig")
        meshes.apply_filter("generate_garment_fitting_fit", body=0, garment=1)
        self.assertIn("walking_woman in the pose of skirt", labels(meshes))

    def test_says_what_is_wrong(self):
        self.assertIn("at least one mesh", self.refusal(opened(), "generate_garment_fitting_rig"))
        self.assertIn("out of range", self.refusal(opened(BODY), "generate_garment_fitting_rig", proxy_vertices=3))
        self.assertIn("is the body already", self.refusal(opened(BODY, SKIRT), "generate_garment_fitting_dress", garment=0))

    def test_takes_lengths_as_a_share_of_the_bodys_box(self):
        meshes = opened(BODY, SKIRT)
        words = self.refusal(meshes, "generate_garment_fitting_dress", contact_distance=Percent(50))
        self.assertIn("contact_distance: 0.95", words)

    def test_dresses_to_the_numbers_of_the_command_line(self):
        meshes = opened(BODY, SKIRT)
        numbers = meshes.apply_filter("generate_garment_fitting_dress", body=0, garment=1)
        self.assertGreater(numbers["smallest_gap"], 0)
        worn = layer_called(meshes, "skirt on walking_woman")
        dressed = meshes.mesh(worn)
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "dress", BODY, SKIRT, "--quiet", "-o", folder + "/out"], check=True)
            by_program = opened(folder + "/out/skirt.ply").current_mesh()  # whose file holds floats
            numpy.testing.assert_allclose(dressed.vertex_matrix(), by_program.vertex_matrix(), rtol=0, atol=1e-7)
        ease = dressed.vertex_custom_scalar_attribute_array("ease")
        numpy.testing.assert_allclose(dressed.vertex_scalar_array(), ease, atol=1e-6)

        girths = meshes.apply_filter("get_garment_fitting_measurements", body=0, garment=1, worn=worn)
        self.assertGreater(girths["hips garment"], girths["hips body"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
