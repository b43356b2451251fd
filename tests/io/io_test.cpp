// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/io.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "garmentfit/error.h"
#include "mesh_file_samples.h"
#include "temporary_folder.h"

namespace {

using namespace garmentfit;

class Io : public fixtures::TemporaryFolder {
protected:
    MeshFile read(const std::string& name, const std::string& bytes) const { return MeshFile::read(save(name, bytes)); }

    std::string written(const MeshFile& mesh, const Positions& positions) const
    {
        mesh.write(folder / "written", positions);
        return load(folder / "written");
    }

    /// The one-line complaint about a file.
    static std::string complaint_about(const std::filesystem::path& path)
    {
        try {
            MeshFile::read(path);
        } catch (const InvalidInput& error) {
            return error.what();
        }
        return "no complaint";
    }

    void expect_complaint(const std::string& name, const std::string& bytes, const std::string& words) const
    {
        const std::string complaint = complaint_about(save(name, bytes));
        EXPECT_NE(complaint.find(words), std::string::npos) << complaint;
        EXPECT_NE(complaint.find(name), std::string::npos) << complaint;
        EXPECT_NE(complaint.find("; "), std::string::npos) << complaint << ": and what to do?";
        EXPECT_EQ(complaint.find('\n'), std::string::npos) << complaint;
    }
};

std::string with(std::string text, const std::string& from, const std::string& to)
{
    return text.replace(text.find(from), from.size(), to);
}

/// Turned by 90 degrees about x, and moved: (x, y, z) -> (x, -z, y) + (0, 0, 3).
Positions turned(const Positions& positions)
{
    Positions result = positions;
    result.col(1) = -positions.col(2);
    result.col(2) = positions.col(1).array() + 3;
    return result;
}

Triangles rows(std::initializer_list<std::array<int, 3>> triangles)
{
    Triangles result(triangles.size(), 3);
    Eigen::Index row = 0;
    for (const auto& t : triangles)
        result.row(row++) << t[0], t[1], t[2];
    return result;
}

TEST_F(Io, EveryFormatComesBackByteForByteWithItsOwnPositions)
{
    for (const samples::File& file : samples::all()) {
        const MeshFile mesh = read(file.name, file.bytes);
        EXPECT_EQ(written(mesh, mesh.positions()), file.bytes) << file.name;
    }
}

TEST_F(Io, EveryFormatKeepsOrderAndFacesWhenAllVerticesMove)
{
    for (const samples::File& file : samples::all()) {
        const MeshFile before = read(file.name, file.bytes);
        before.write(folder / ("moved_" + file.name), turned(before.positions()));
        const MeshFile after = MeshFile::read(folder / ("moved_" + file.name));
        EXPECT_TRUE(after.positions().isApprox(turned(before.positions()), 1e-6)) << file.name;
        EXPECT_EQ(after.triangles(), before.triangles()) << file.name;
        EXPECT_EQ(after.format(), before.format());
    }
}

TEST_F(Io, ReadsPolygonsAndIndicesCountedBackInObj)
{
    const MeshFile mesh = read("a.obj", samples::obj());
    EXPECT_EQ(mesh.format(), "obj");
    ASSERT_EQ(mesh.positions().rows(), 5);
    EXPECT_EQ(Vec3(mesh.positions().row(3)), Vec3(0, 1, 0.1));
    EXPECT_EQ(mesh.triangles(), rows({ { 0, 1, 2 }, { 0, 2, 3 }, { 2, 4, 3 } }));
}

TEST_F(Io, ObjKeepsColoursAndAllOtherLinesAndTurnsItsNormals)
{
    const MeshFile mesh = read("a.obj", samples::obj());
    const std::string text = written(mesh, turned(mesh.positions()));
    for (const char* kept :
         { "# roof, by hand\r\nmtllib roof.mtl\no Roof\n", " 1.0 0.5 0.25\n", "vt 1 1\n", "usemtl slate\ns 1\n",
           "f 1/1/1 2/2/1 3/3/1 \\\n  4/4/1\n", "f -3//2 -1//2 -2//2 # gable\nl 1 2\n# end" })
        EXPECT_NE(text.find(kept), std::string::npos) << text;
    // (0, -0.1, 1) and (0, 0, 1) turned by 90 degrees about x
    const auto after = text.find("vn ");
    double x, y, z;
    ASSERT_EQ(std::sscanf(text.c_str() + after, "vn %lf %lf %lf\nvn", &x, &y, &z), 3);
    EXPECT_NEAR(x, 0, 1e-12);
    EXPECT_NEAR(y, -1, 1e-12);
    EXPECT_NEAR(z, -0.1, 1e-12);
}

TEST_F(Io, AMovedVertexChangesOnlyItsOwnNumbers)
{
    const MeshFile mesh = read("a.ply", samples::ascii_ply());
    Positions moved = mesh.positions();
    moved.row(2) << 2, 1.0 / 3, 0.1;
    EXPECT_EQ(written(mesh, moved), with(samples::ascii_ply(), "1.0 1 0 0.25", "2 0.3333333333333333 0 0.1"));
}

TEST_F(Io, TextKeepsAllDigitsOfAPosition)
{
    for (const auto& [name, bytes] : { samples::File { "a.obj", samples::obj() },
                                       { "a.off", samples::off() },
                                       { "a.stl", samples::ascii_stl() } }) {
        const MeshFile mesh = read(name, bytes);
        Positions moved = mesh.positions();
        moved.row(1) << M_PI, -1.0 / 3, 1e-17;
        mesh.write(folder / ("moved_" + name), moved);
        EXPECT_EQ(MeshFile::read(folder / ("moved_" + name)).positions(), moved) << name;
    }
}

TEST_F(Io, ReadsBothByteOrdersOfPlyAlike)
{
    const MeshFile little = read("l.ply", samples::binary_ply(false)), big = read("b.ply", samples::binary_ply(true));
    EXPECT_EQ(little.positions(), big.positions());
    EXPECT_EQ(little.triangles(), rows({ { 0, 1, 2 }, { 0, 2, 3 } }));
    EXPECT_EQ(big.triangles(), little.triangles());
    EXPECT_EQ(little.positions()(0, 2), double(0.1f));
}

TEST_F(Io, PlyTurnsNormalsAndKeepsOtherProperties)
{
    const MeshFile mesh = read("b.ply", samples::binary_ply(true));
    mesh.write(folder / "moved.ply", turned(mesh.positions()));
    for (const VertexProperty& property : read_ply_properties(folder / "moved.ply"))
        if (property.name == "ny") {
            for (const double ny : property.values)  // the file's normals are not quite those of its faces
                EXPECT_NEAR(ny, -1, 1e-3);
        }
    EXPECT_EQ(load(folder / "moved.ply").size(), samples::binary_ply(true).size());
}

TEST_F(Io, WeldsStlOnEqualityAndWritesFacetsBackInOrder)
{
    for (const auto& bytes : { samples::ascii_stl(), samples::binary_stl() }) {
        const MeshFile mesh = read("a.stl", bytes);
        EXPECT_EQ(mesh.positions().rows(), 4);
        EXPECT_EQ(mesh.triangles(), rows({ { 0, 1, 2 }, { 0, 2, 3 } }));
    }
    const MeshFile mesh = read("a.stl", samples::ascii_stl());
    Positions moved = mesh.positions();
    moved.row(0) << -1, -1, 0;
    std::string expected = with(samples::ascii_stl(), "vertex 0 0 0", "vertex -1 -1 0");
    EXPECT_EQ(written(mesh, moved), with(expected, "vertex 0.0 -0 0", "vertex -1 -1 0"));
}

TEST_F(Io, AppliesNodesOfGltfAndTakesThemBack)
{
    const MeshFile mesh = read("a.glb", samples::glb());
    EXPECT_EQ(mesh.format(), "glb");
    Positions expected(4, 3);
    expected << 1, 0, 0, 3, 0, 0, 3, 2, 0, 1, 2, 0;
    EXPECT_EQ(mesh.positions(), expected);
    EXPECT_EQ(mesh.triangles(), rows({ { 0, 1, 2 }, { 0, 2, 3 } }));
    const std::string bytes = written(mesh, turned(mesh.positions()));
    EXPECT_NE(bytes.find("\"min\":[0.0,0.0,1.5],\"max\":[1.0,0.0,2.5]"), std::string::npos);
    EXPECT_NE(bytes.find("\"extras\":{\"kept\":[1,2.5,\"\"]}"), std::string::npos);
    EXPECT_NE(bytes.find(samples::raw(-1.0f)), std::string::npos) << "the normals point along -y now";
}

TEST_F(Io, WritesGltfInOneFileWhereverItsBufferLay)
{
    save("square one.bin", samples::gltf_buffer());
    save("linen.png", "\x89PNG rest");
    const std::string json = with(samples::gltf_json("\"uri\":\"square%20one.bin\","), "\"materials\"",
                                  "\"images\":[{\"uri\":\"linen.png\"},{\"uri\":\"lost.png\"}],\"materials\"");
    const MeshFile mesh = read("a.gltf", json);
    EXPECT_EQ(mesh.format(), "gltf");
    std::filesystem::create_directory(folder / "elsewhere");
    mesh.write(folder / "elsewhere" / "b.gltf", turned(mesh.positions()));
    EXPECT_TRUE(MeshFile::read(folder / "elsewhere" / "b.gltf").positions().isApprox(turned(mesh.positions()), 1e-6));
    const std::string text = load(folder / "elsewhere" / "b.gltf");
    EXPECT_NE(text.find("{\"uri\":\"data:image/png;base64,iVBORyByZXN0\"}"), std::string::npos) << text;
    EXPECT_EQ(text.find("lost.png"), std::string::npos) << "viewers refuse a file whose pictures are missing";
}

TEST_F(Io, ReadsAllOfTheChunkOfAGlbWhoseBufferIsSaidToBeShorter)
{
    const std::string json = samples::gltf_json(""),
                      length = "\"byteLength\":" + std::to_string(samples::gltf_buffer().size());
    const MeshFile whole = read("a.glb", samples::glb(json));
    const MeshFile shorter = read("a.glb", samples::glb(with(json, length, "\"byteLength\":20")));
    EXPECT_EQ(shorter.positions(), whole.positions());
    shorter.write(folder / "b.glb", whole.positions());
    EXPECT_EQ(MeshFile::read(folder / "b.glb").positions(), whole.positions());
    expect_complaint("a.glb", samples::glb(with(json, length, "\"byteLength\":20000")), "glb");
}

TEST_F(Io, AMirroringNodeOfGltfTurnsItsFacesOver)
{
    const MeshFile mesh = read("a.glb", samples::glb(with(samples::gltf_json(""), "[2,2,2]", "[-2,2,2]")));
    EXPECT_EQ(mesh.triangles(), rows({ { 0, 2, 1 }, { 0, 3, 2 } }));
}

TEST_F(Io, SaysWhatCannotBeDoneWithAGltf)
{
    const std::string json = samples::gltf_json("");
    const auto expect = [&](const std::string& from, const std::string& to, const std::string& words) {
        expect_complaint("a.glb", samples::glb(with(json, from, to)), words);
    };
    expect("5126", "5123", "without quantization");
    expect("\"count\":4", "\"count\":4000000000", "beyond its buffer");
    expect("\"children\":[1]", "\"children\":[0]", "two parents");
    expect("\"count\":4,\"type\":\"VEC3\",\"min\"",
           "\"sparse\":{\"count\":1,\"indices\":{\"bufferView\":1,\"componentType\":5123},"
           "\"values\":{\"bufferView\":7}},\"count\":4,\"type\":\"VEC3\",\"min\"",
           "packed data");
    expect("[2,2,2]", "[2,0,2]", "flattens");
    expect("\"mesh\":0", "\"mesh\":7", "mesh 7, but there are 1");
    expect("\"byteOffset\":12,", "\"byteOffset\":4,", "overlap");
    expect("\"2.0\"", "\"1.0\"", "version");
    expect_complaint("a.gltf", samples::gltf_json("\"uri\":\"none.bin\","), "none.bin");
    const std::string five = with(json, "\"count\":4", "\"count\":5");  // the first primitive has no normals
    expect_complaint("a.glb", samples::glb(with(five, "\"POSITION\":0,\"NORMAL\":1", "\"POSITION\":0")),
                     "different counts");
    expect_complaint("a.gltf", std::string(100000, '['), "levels deep");
}

TEST_F(Io, TellsFormatsByTheirContent)
{
    EXPECT_EQ(read("a.mesh", samples::binary_ply(true)).format(), "ply");
    EXPECT_EQ(read("a.bin", samples::glb()).format(), "glb");
    EXPECT_EQ(read("a", samples::off()).format(), "off");
    EXPECT_EQ(read("A.OBJ", samples::obj()).format(), "obj");
}

TEST_F(Io, SaysWhatIsWrongAndWhere)
{
    EXPECT_NE(complaint_about(folder / "none.ply").find("no such file; check the path"), std::string::npos);
    EXPECT_NE(complaint_about(folder).find("directory"), std::string::npos);
    expect_complaint("e.ply", "", "is empty");
    expect_complaint("t.xyz", "hello", "unknown format");
    expect_complaint("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no faces");
    expect_complaint("a.obj", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n", "line 2: '1 0 nan' is not finite");
    expect_complaint("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n",
                     "line 4: the face refers to vertex 4, but there are 3");
    expect_complaint("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n",
                     "line 4: the face refers to vertex 0, but there are 3");
    expect_complaint("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", "no faces");
    expect_complaint("a.obj", "v 0 0\nv 1 0 0\n", "line 1: ends too soon");
    expect_complaint("a.obj", "v 0 0 zero\n", "line 1: 'zero' is not a number");
    expect_complaint("a.ply", with(samples::ascii_ply(), "vertex 4", "vertex 2000000000"),
                     "more than the file can hold");
    expect_complaint("a.ply", with(samples::ascii_ply(), "4 0 1 2 3 42", "4 0 1 2 4 42"),
                     "line 23: face 0 refers to vertex 4, but there are 4, counted from 0");
    expect_complaint("a.ply", with(samples::ascii_ply(), "4 0 1 2 3 42", "2 0 1 42"), "face 0 has 2 corners");
    expect_complaint("a.ply", with(samples::ascii_ply(), "4 0 1 2 3 42", "200 0 1"), "a count of 200");
    expect_complaint("a.ply", with(samples::ascii_ply(), "ascii", "morse"), "line 2: unknown PLY encoding");
    expect_complaint("a.ply", with(samples::ascii_ply(), "property double y\n", ""), "no property y");
    expect_complaint("a.off", with(samples::off(), "4 2 0", "4 9 0"), "line 11: the file ends too soon");
    expect_complaint("a.off", "4OFF\n", "header is mangled");
    expect_complaint("a.off", "OFF BINARY\n", "save it as text");
    expect_complaint("a.stl", samples::binary_stl().substr(0, 150).replace(0, 5, "SCANS"),
                     "byte 150: the file ends too soon");
    expect_complaint("a.stl", with(samples::ascii_stl(), "endsolid square of two", ""), "without endsolid");
    std::string infinite = samples::binary_stl();
    infinite.replace(84 + 50 + 24, 4, samples::raw(std::numeric_limits<float>::infinity()));
    expect_complaint("a.stl", infinite, "facet 1 is not finite");
}

bool has_warning(const MeshFile& mesh, const std::string& words)
{
    const auto says = [&](const std::string& warning) { return warning.find(words) != std::string::npos; };
    return std::any_of(mesh.warnings().begin(), mesh.warnings().end(), says);
}

TEST_F(Io, ObjFacesOfTwoCornersAreLeftOutWithAWarningAndStayInTheFile)
{
    const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2\nf 1 2 3\nf 3\n";
    const MeshFile mesh = read("loose.obj", text);
    EXPECT_EQ(mesh.triangles(), rows({ { 0, 1, 2 } }));
    EXPECT_TRUE(has_warning(mesh, "2 faces have fewer than three corners; they are left out"));
    EXPECT_EQ(written(mesh, mesh.positions()), text);
}

TEST_F(Io, ObjNormalsThatAreMissingOrMangledAreAWarning)
{
    const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvn none\nvn 0 1\nvn nan 0 1\n"
                             "f 1//1 2//9 3//-7\nf 1//2 3//x 4//\nf 1/ 2// 3/7/\n";
    const MeshFile mesh = read("n.obj", text);
    EXPECT_EQ(mesh.triangles(), rows({ { 0, 1, 2 }, { 0, 2, 3 }, { 0, 1, 2 } }));
    EXPECT_TRUE(has_warning(mesh, "3 normals are not three numbers"));
    EXPECT_TRUE(has_warning(mesh, "3 corners of faces name a normal that does not exist"));
    const std::string moved = written(mesh, turned(mesh.positions()));
    EXPECT_NE(moved.find("vn none\nvn 0 1\nvn nan 0 1\nf 1//1 2//9 3//-7\n"), std::string::npos) << moved;
    EXPECT_TRUE(read("a.obj", samples::obj()).warnings().empty());
}

/// A strip of triangles with a vertex more that no face uses.
std::string strip_with_a_stray(const std::string& stray)
{
    std::string obj = "v " + stray + "\n", faces;
    for (int i = 0; i < 40; ++i) {
        obj += "v " + std::to_string(0.1 * (i / 2)) + " " + std::to_string(i % 2) + " 0\n";
        if (i > 1)
            faces += "f " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
    }
    return obj + faces;
}

TEST_F(Io, VerticesThatNoFaceUsesAreLeftOutWhereTheyAreFarAwayAndWrittenAsTheyWere)
{
    for (const std::string stray : { "1e30 -1e30 1e30", "nan 0 0", "0 inf 0", "5000 0 0" }) {
        const MeshFile mesh = read("s.obj", strip_with_a_stray(stray));
        EXPECT_LE(mesh.positions().cwiseAbs().maxCoeff(), 2) << stray;
        EXPECT_TRUE(has_warning(mesh, "1 vertices that no face uses")) << stray;
        EXPECT_NE(written(mesh, turned(mesh.positions())).find("v " + stray + "\n"), std::string::npos) << stray;
        EXPECT_EQ(written(mesh, mesh.positions()), strip_with_a_stray(stray));
    }
    const MeshFile near = read("s.obj", strip_with_a_stray("5 0 0"));
    EXPECT_TRUE(near.warnings().empty());
    EXPECT_EQ(near.positions()(0, 0), 5);
    const std::string ply = with(samples::ascii_ply(), "8 0 1 1 -5 0\n4 0 1 2 3 42", "8 0 nan 1 -5 0\n3 0 1 2 42");
    EXPECT_TRUE(read("s.ply", ply).positions().allFinite());
    const std::string off = with(with(samples::off(), "0 1 0 255 0 0", "0 nan 0 255 0 0"), "3 0 2 3", "3 0 2 1");
    EXPECT_TRUE(read("s.off", off).positions().allFinite());
    expect_complaint("s.off", with(samples::off(), "0 1 0 255 0 0", "0 nan 0 255 0 0"), "is not finite");
}

TEST_F(Io, NormalsAgainstTheFacesTellOfALeftHandedProgram)
{
    EXPECT_TRUE(has_warning(read("l.off", with(samples::off_with_normals(), "4 0 1 2 3", "4 3 2 1 0")), "left-handed"));
    EXPECT_TRUE(read("r.off", samples::off_with_normals()).warnings().empty());
    const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvn 0 0 -1\nf 1//1 2//1 3//1\n";
    EXPECT_TRUE(has_warning(read("l.obj", obj), "left-handed"));
    EXPECT_TRUE(read("r.obj", with(obj, "vn 0 0 -1", "vn 0 0 1")).warnings().empty());
}

TEST_F(Io, RefusesToWriteWhereNothingCanBeWrittenAndLeavesNothing)
{
    const MeshFile mesh = read("a.obj", samples::obj());
    EXPECT_THROW(mesh.write(folder / "none" / "b.obj", mesh.positions()), InvalidInput);
    EXPECT_THROW(mesh.write(folder, mesh.positions()), InvalidInput);
    EXPECT_THROW(mesh.write(folder / "b.obj", mesh.positions().topRows(2)), InvalidInput);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
    mesh.write(folder / "a.obj", turned(mesh.positions()));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST_F(Io, WritePlyKeepsDoublesAndProperties)
{
    Positions positions(3, 3);
    positions << 0, 0, 0, 1.0 / 3, 0, 0, 0, 1e-9, 7;
    const Triangles triangles = rows({ { 0, 1, 2 } });
    write_ply(folder / "w.ply", positions, triangles,
              { { "joint0", { 3, 4, 5 }, true }, { "weight0", { 0.1, 0.2, 0.3 } } }, { "hello" });
    const MeshFile mesh = MeshFile::read(folder / "w.ply");
    EXPECT_EQ(mesh.positions(), positions);
    EXPECT_EQ(mesh.triangles(), triangles);
    const auto properties = read_ply_properties(folder / "w.ply");
    ASSERT_EQ(properties.size(), 5u);
    EXPECT_EQ(properties[3].name, "joint0");
    EXPECT_TRUE(properties[3].integer);
    EXPECT_EQ(properties[3].values, (std::vector<double> { 3, 4, 5 }));
    EXPECT_EQ(properties[4].values, (std::vector<double> { 0.1, 0.2, 0.3 }));
}

}  // namespace
