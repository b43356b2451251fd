#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The wrapped filters: every parameter of the schema, and round trips through VTK's own files."""
import math
import os
import sys
import tempfile
import unittest

from vtkmodules.vtkCommonCore import VTK_DOUBLE
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


if __name__ == "__main__":
    unittest.main(verbosity=2)
