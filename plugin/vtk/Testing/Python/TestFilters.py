#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The wrapped filters: every parameter of the schema, and round trips through VTK's own files."""
import json
import math
import os
import struct
import sys
import tempfile
import unittest

from vtkmodules.vtkCommonCore import VTK_DOUBLE, VTK_STRING, vtkFloatArray
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as pipeline
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import (vtkXMLMultiBlockDataReader, vtkXMLMultiBlockDataWriter, vtkXMLPolyDataReader,
                                 vtkXMLPolyDataWriter)

import garmentfitvtk as fit

SAMPLES = sys.argv.pop()
FILTERS = [fit.vtkRigBody, fit.vtkFitSkeleton, fit.vtkDrapeGarment, fit.vtkRecoverPose, fit.vtkDressBody]


def reader(name):
    ply = vtkPLYReader()
    ply.SetFileName(os.path.join(SAMPLES, name))
    return ply


def camel(name):
    return "".join(word.capitalize() for word in name.split("_"))


def another(value, smallest):
    """A value that differs. NaN is an optional parameter that is not given."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return value + 1
    return (smallest() if math.isnan(value) else value) * 1.125 + 1e-9


def arrays_of(data):
    attributes = [data.GetPointData(), data.GetCellData(), data.GetFieldData()]
    return {a.GetAbstractArray(i).GetName(): a.GetAbstractArray(i) for a in attributes
            for i in range(a.GetNumberOfArrays())}


def same_bits(test, one, other):
    """All arrays and points of two poly data, value by value."""
    a, b = arrays_of(one), arrays_of(other)
    a["Points"], b["Points"] = one.GetPoints().GetData(), other.GetPoints().GetData()
    test.assertLessEqual(set(a), set(b))
    for name, array in a.items():
        test.assertEqual(array.GetDataType(), b[name].GetDataType(), name)
        test.assertEqual(array.GetNumberOfValues(), b[name].GetNumberOfValues(), name)
        for i in range(array.GetNumberOfValues()):
            test.assertEqual(array.GetVariantValue(i), b[name].GetVariantValue(i), name)


class Parameters(unittest.TestCase):
    def test_every_parameter_of_the_schema_has_set_and_get(self):
        for make in FILTERS:
            filter_ = make()
            names = [filter_.GetParameterName(i) for i in range(filter_.GetNumberOfParameters())]
            self.assertGreater(len(names), 1)
            for name in names:
                self.assertTrue(hasattr(filter_, "Set" + camel(name)), f"{make.__name__} lacks Set{camel(name)}")
                self.assertTrue(hasattr(filter_, "Get" + camel(name)), f"{make.__name__} lacks Get{camel(name)}")
                self.assertTrue(filter_.GetParameterHelp(name))

    def test_set_reaches_the_parameter_of_its_name(self):
        for make in FILTERS:
            filter_ = make()
            for i in range(filter_.GetNumberOfParameters()):
                name = filter_.GetParameterName(i)
                get, set_ = getattr(filter_, "Get" + camel(name)), getattr(filter_, "Set" + camel(name))
                before, time = filter_.GetParameter(name), filter_.GetMTime()
                set_(another(get(), getattr(filter_, "Get" + camel(name) + "MinValue", None)))
                self.assertNotEqual(filter_.GetParameter(name), before, name)
                self.assertGreater(filter_.GetMTime(), time)
                filter_.SetParameter(name, before)
                self.assertEqual(filter_.GetParameter(name), before)


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.body, cls.garment = reader("walking_woman.ply"), reader("skirt.ply")
        cls.rig, cls.fit = fit.vtkRigBody(), fit.vtkFitSkeleton()
        cls.rig.SetInputConnection(cls.body.GetOutputPort())
        cls.fit.SetInputConnection(0, cls.rig.GetOutputPort())
        cls.fit.SetInputConnection(1, cls.garment.GetOutputPort())
        cls.fit.SetTypeByName("skirt")
        cls.fit.Update()

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()

    def tearDown(self):
        self.folder.cleanup()

    def path(self, name):
        return os.path.join(self.folder.name, name)

    def test_vtp_keeps_body_garment_and_skeleton_bit_for_bit(self):
        for port in range(3):
            data = self.fit.GetOutputDataObject(port)
            writer, back = vtkXMLPolyDataWriter(), vtkXMLPolyDataReader()
            writer.SetInputData(data)
            writer.SetFileName(self.path("part.vtp"))
            writer.SetDataModeToBinary()
            self.assertEqual(writer.Write(), 1)
            back.SetFileName(self.path("part.vtp"))
            back.Update()
            same_bits(self, data, back.GetOutput())

    def test_vtm_keeps_them_as_blocks(self):
        blocks = vtkMultiBlockDataSet()
        for port in range(3):
            blocks.SetBlock(port, self.fit.GetOutputDataObject(port))
        writer, back = vtkXMLMultiBlockDataWriter(), vtkXMLMultiBlockDataReader()
        writer.SetInputData(blocks)
        writer.SetFileName(self.path("all.vtm"))
        writer.SetDataModeToBinary()
        self.assertEqual(writer.Write(), 1)
        back.SetFileName(self.path("all.vtm"))
        back.Update()
        for port in range(3):
            same_bits(self, blocks.GetBlock(port), back.GetOutput().GetBlock(port))

    def test_a_rig_read_from_a_file_fits_as_the_one_in_memory(self):
        writer, back, again = vtkXMLPolyDataWriter(), vtkXMLPolyDataReader(), fit.vtkFitSkeleton()
        writer.SetInputConnection(self.rig.GetOutputPort())
        writer.SetFileName(self.path("rigged.vtp"))
        writer.SetDataModeToBinary()
        writer.Write()
        back.SetFileName(self.path("rigged.vtp"))
        again.SetInputConnection(0, back.GetOutputPort())
        again.SetInputConnection(1, self.garment.GetOutputPort())
        again.SetTypeByName("skirt")
        again.Update()
        same_bits(self, self.fit.GetOutputDataObject(2), again.GetOutputDataObject(2))

    def test_points_that_move_are_double_and_those_given_are_kept(self):
        body = self.fit.GetOutputDataObject(0)
        self.assertEqual(body.GetPoints().GetDataType(), VTK_DOUBLE)
        own = body.GetPointData().GetArray("InputPosition")
        given = self.body.GetOutput().GetPoints().GetData()
        self.assertTrue(all(own.GetTuple(i) == given.GetTuple(i) for i in range(given.GetNumberOfTuples())))
        self.assertFalse(self.fit.GetOutputInformation(0).Has(pipeline.TIME_STEPS()))


class Outfits(unittest.TestCase):
    """A dressed body from VTK's files to one skinned GLB."""

    @classmethod
    def setUpClass(cls):
        cls.garment = reader("skirt.ply")
        cls.garment.Update()
        uvs = vtkFloatArray()
        uvs.SetNumberOfComponents(2)
        uvs.SetNumberOfTuples(cls.garment.GetOutput().GetNumberOfPoints())
        uvs.Fill(0.25)
        cls.garment.GetOutput().GetPointData().SetTCoords(uvs)
        cls.dress = fit.vtkDressBody()
        cls.body = reader("walking_woman.ply")
        cls.dress.SetInputConnection(0, cls.body.GetOutputPort())
        cls.dress.SetInputData(1, cls.garment.GetOutput())
        cls.dress.SetTypeByName("skirt")
        cls.dress.SetQualityByName("draft")
        cls.dress.Update()

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.writer = fit.vtkOutfitWriter()
        self.writer.SetFileName(os.path.join(self.folder.name, "new", "outfit.glb"))
        self.messages = []
        self.writer.AddObserver("ErrorEvent", self.keep_message)

    def tearDown(self):
        self.folder.cleanup()

    def keep_message(self, _, event, message=""):
        self.messages.append(message)

    keep_message.CallDataType = VTK_STRING

    def outfit(self):
        with open(self.writer.GetFileName(), "rb") as file:
            length_of_json = struct.unpack("<5I", file.read(20))[3]
            return json.loads(file.read(length_of_json))

    def write_avatar(self, name, left_out=None):
        """A skinned file with joints of Mixamo of body and garment, one of which may be left out."""
        path = self.writer.GetFileName()
        self.writer.SetInputConnection(0, self.dress.GetOutputPort(0))
        self.writer.SetInputConnection(1, self.dress.GetOutputPort(1))
        self.writer.SetBones("mixamo")
        self.writer.SetFileName(os.path.join(self.folder.name, name))
        self.assertEqual(self.writer.Write(), 1, self.messages)
        avatar = self.outfit()
        for node in avatar["nodes"]:
            if "mesh" in node and node["name"] == left_out:
                del node["mesh"], node["skin"]
        with open(self.writer.GetFileName(), "r+b") as file:
            length = struct.unpack("<5I", file.read(20))[3]
            file.write(json.dumps(avatar, separators=(",", ":")).ljust(length).encode())
        self.writer.SetFileName(path)
        self.writer.SetBones("own")
        return os.path.join(self.folder.name, name), avatar

    def expect_refusal(self, words):
        self.assertEqual(self.writer.Write(), 0)
        self.assertNotEqual(self.writer.GetErrorCode(), 0)
        self.assertIn(words, self.messages[-1])
        self.assertFalse(os.path.exists(self.writer.GetFileName()))

    def test_body_and_garment_are_written_with_skins_and_uvs(self):
        self.writer.SetInputConnection(0, self.dress.GetOutputPort(0))
        self.writer.SetInputConnection(1, self.dress.GetOutputPort(1))
        self.writer.SetBones("mixamo")
        self.assertEqual(self.writer.Write(), 1, self.messages)
        outfit = self.outfit()
        self.assertEqual(len(outfit["meshes"]), 2)
        self.assertIn("mixamorig:Hips", [node.get("name") for node in outfit["nodes"]])
        body, skirt = (mesh["primitives"][0]["attributes"] for mesh in outfit["meshes"])
        for attributes in (body, skirt):
            self.assertIn("JOINTS_0", attributes)
        self.assertNotIn("TEXCOORD_0", body)
        self.assertIn("TEXCOORD_0", skirt)
        self.assertNotIn("JOINTS_1", skirt)

    def test_more_joints_may_move_a_vertex(self):
        self.writer.SetInputConnection(0, self.dress.GetOutputPort(0))
        self.writer.SetInputConnection(1, self.dress.GetOutputPort(1))
        self.writer.SetInfluences(9)
        self.assertEqual(self.writer.GetInfluences(), 8)
        self.assertEqual(self.writer.Write(), 1, self.messages)
        self.assertIn("JOINTS_1", self.outfit()["meshes"][1]["primitives"][0]["attributes"])

    def test_what_was_kept_in_files_is_written_alike(self):
        self.writer.SetInputConnection(0, self.dress.GetOutputPort(0))
        self.writer.SetInputConnection(1, self.dress.GetOutputPort(1))
        self.assertEqual(self.writer.Write(), 1, self.messages)
        with open(self.writer.GetFileName(), "rb") as file:
            direct = file.read()
        backs = []
        for port in range(2):
            path = os.path.join(self.folder.name, f"{port}.vtp")
            keep, back = vtkXMLPolyDataWriter(), vtkXMLPolyDataReader()
            keep.SetInputConnection(self.dress.GetOutputPort(port))
            keep.SetFileName(path)
            keep.SetDataModeToBinary()
            keep.Write()
            back.SetFileName(path)
            self.writer.SetInputConnection(port, back.GetOutputPort())
            backs.append(back)
        self.assertEqual(self.writer.Write(), 1, self.messages)
        with open(self.writer.GetFileName(), "rb") as file:
            self.assertEqual(file.read(), direct)

    def test_garments_may_be_several_blocks(self):
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, self.dress.GetOutputDataObject(1))
        self.writer.SetInputConnection(0, self.dress.GetOutputPort(0))
        self.writer.SetInputData(1, blocks)
        self.assertEqual(self.writer.Write(), 1, self.messages)
        self.assertEqual(len(self.outfit()["meshes"]), 2)

    def expect_kept(self, avatar):
        """The outfit is the avatar's file with a mesh more."""
        outfit = self.outfit()
        for of_file in ("nodes", "meshes", "skins"):
            self.assertEqual(outfit[of_file][:-1], avatar[of_file])
        self.assertEqual(outfit["nodes"][-1]["name"], "the garment")
        self.assertIn("JOINTS_0", outfit["meshes"][-1]["primitives"][0]["attributes"])

    def test_an_outfit_on_the_bodys_own_joints_is_its_file_with_the_garments(self):
        self.assertEqual(self.writer.GetBones(), "own")
        path, avatar = self.write_avatar("avatar.glb", left_out="the garment")
        self.writer.SetBodyFileName(path)
        self.assertEqual(self.writer.GetBodyFileName(), path)
        for hides in (False, True):
            self.writer.SetHideCoveredSkin(hides)
            self.assertEqual(self.writer.Write(), 1, self.messages)
            outfit = self.outfit()
            self.assertEqual("_COVERED" in outfit["meshes"][0]["primitives"][0]["attributes"], hides)
            if not hides:
                self.expect_kept(avatar)
        self.writer.SetBones("smpl")
        self.assertEqual(self.writer.Write(), 1, self.messages)
        self.assertNotIn("mixamorig:Hips", [node.get("name") for node in self.outfit()["nodes"]])

    def test_the_bodys_own_file_may_have_more_parts(self):
        path, avatar = self.write_avatar("clothed.glb")
        self.writer.SetBodyFileName(path)
        self.assertEqual(self.writer.Write(), 1, self.messages)
        self.expect_kept(avatar)

    def test_a_file_that_is_not_the_bodys_is_refused(self):
        path, _ = self.write_avatar("clothes.glb", left_out="body")
        self.writer.SetBodyFileName(path)
        self.expect_refusal("vertices of the body do not lie where any of its")
        self.writer.SetBodyFileName(os.path.join(self.folder.name, "gone.glb"))
        self.expect_refusal("gone.glb")

    def test_a_file_of_the_body_without_a_skin_is_a_warning(self):
        warnings = []

        def keep_warning(_, event, message=""):
            warnings.append(message)

        keep_warning.CallDataType = VTK_STRING
        self.writer.AddObserver("WarningEvent", keep_warning)
        self.writer.SetInputConnection(0, self.dress.GetOutputPort(0))
        self.writer.SetInputConnection(1, self.dress.GetOutputPort(1))
        self.writer.SetBodyFileName(os.path.join(SAMPLES, "walking_woman.ply"))
        self.assertEqual(self.writer.Write(), 1, self.messages)
        self.assertIn("walking_woman.ply: has no skin", warnings[0])
        self.assertIn("lhipjoint", [node.get("name") for node in self.outfit()["nodes"]])

    def test_what_cannot_be_written_is_said_in_one_line(self):
        self.writer.SetInputConnection(0, self.body.GetOutputPort())
        self.writer.SetInputConnection(1, self.dress.GetOutputPort(1))
        self.expect_refusal("Rig")
        self.writer.SetInputConnection(0, self.dress.GetOutputPort(0))
        self.writer.SetBones("cat")
        self.expect_refusal("give one of own, garmentfit, vrm")
        self.writer.SetBones("smpl")
        self.writer.SetFileName(os.path.join(self.folder.name, "outfit.obj"))
        self.expect_refusal("give a name that ends in .glb or .vrm")
        self.writer.SetFileName(os.path.join(self.folder.name, "outfit.glb"))
        posed, rig = fit.vtkFitSkeleton(), fit.vtkRigBody()
        rig.SetInputConnection(self.body.GetOutputPort())
        posed.SetInputConnection(0, rig.GetOutputPort())
        posed.SetInputData(1, self.garment.GetOutput())
        posed.SetTypeByName("skirt")
        self.writer.SetInputConnection(0, posed.GetOutputPort())
        self.expect_refusal("in its own pose")


if __name__ == "__main__":
    unittest.main(verbosity=2)
