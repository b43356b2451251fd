// SPDX-License-Identifier: GPL-3.0-or-later

// The plugin in MeshLab 2020.09's PluginManager, without windows.

#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>

#include <malloc.h>
#include <unistd.h>

#include <QApplication>
#include <QDir>

#include <common/pluginmanager.h>

#include "../temporary_folder.h"
#include "garmentfit/filters/filters.h"
#include "garmentfit/filters/rig_file.h"
#include "garmentfit/io.h"
#include "garmentfit/skinned_gltf.h"
#include "open_layer.h"

namespace {

using namespace garmentfit;
namespace fs = std::filesystem;

const fs::path k_body = GARMENTFIT_SAMPLES "/walking_woman.ply", k_skirt = GARMENTFIT_SAMPLES "/skirt.ply",
               k_small_body = GARMENTFIT_BODIES "/man_a_pose.ply";

PluginManager& plugins()
{
    static PluginManager manager;
    static const bool loaded = [] {
        RichParameterList settings;
        manager.loadPlugins(settings, QDir(GARMENTFIT_PLUGIN_FOLDER));
        return true;
    }();
    (void)loaded;
    return manager;
}

QString full_name(const std::string& name) { return QString::fromStdString("Garment Fitting: " + name); }

QAction* action_of(const std::string& name) { return plugins().actionFilterMap.value(full_name(name)); }

MeshFilterInterface& filter_of(const std::string& name)
{
    return *qobject_cast<MeshFilterInterface*>(action_of(name)->parent());
}

RichParameterList dialog_of(const std::string& name, MeshDocument& document)
{
    RichParameterList list;
    filter_of(name).initParameterSet(action_of(name), document, list);
    return list;
}

struct Ended {
    bool well = false;
    std::string message;
};

bool go_on(int, const char*) { return true; }

Ended run(const std::string& name, MeshDocument& document, const RichParameterList& list,
          vcg::CallBackPos* callback = go_on)
{
    MeshFilterInterface& filter = filter_of(name);
    filter.setLog(&document.Log);
    Ended ended;
    ended.well = filter.applyFilter(action_of(name), document, list, callback);
    ended.message = filter.errorMsg().toStdString();
    return ended;
}

Ended run(const std::string& name, MeshDocument& document) { return run(name, document, dialog_of(name, document)); }

std::string log_of(const MeshDocument& document)
{
    std::string log;
    for (const auto& line : document.Log.logStringList())
        log += line.second.toStdString() + '\n';
    return log;
}

void choose(RichParameterList& list, const QString& name, MeshDocument& document, int layer)
{
    list.setValue(name, MeshValue(&document, layer));
}

TriangleMesh body_mesh()
{
    const MeshFile file = MeshFile::read(k_body);
    return { file.positions(), file.triangles() };
}

std::vector<std::string> names_of(const MeshDocument& document)
{
    std::vector<std::string> names;
    for (const MeshModel* layer : document.meshList)
        names.push_back(layer->label().toStdString());
    return names;
}

Vec3 point_of(const MeshModel& layer, int vertex)
{
    const Point3m& p = layer.cm.vert[vertex].cP();
    return { p[0], p[1], p[2] };
}

/// All bytes that could change: positions, faces, colours, quality, matrix, visibility.
std::string state_of(const MeshModel& layer)
{
    std::string state(reinterpret_cast<const char*>(layer.cm.vert.data()), layer.cm.vert.size() * sizeof(CVertexO));
    state.append(reinterpret_cast<const char*>(layer.cm.face.data()), layer.cm.face.size() * sizeof(CFaceO));
    state.append(reinterpret_cast<const char*>(&layer.cm.Tr), sizeof layer.cm.Tr);
    return state + std::to_string(layer.dataMask()) + (layer.isVisible() ? "visible" : "hidden");
}

std::vector<std::string> states_of(const MeshDocument& document)
{
    std::vector<std::string> states;
    for (const MeshModel* layer : document.meshList)
        states.push_back(state_of(*layer));
    return states;
}

const std::vector<std::string> k_filters { "Rig Body",     "Fit Skeleton", "Drape Garment",
                                           "Recover Pose", "Dress Body",   "Save Rig",
                                           "Load Rig",     "Save Outfit",  "Body Measurements and Ease" };

class MeshLab : public fixtures::TemporaryFolder {
protected:
    /// Opens a body and a skirt as MeshLab does.
    void open_samples()
    {
        meshlab::open_layer(document, k_body);
        meshlab::open_layer(document, k_skirt);
    }

    /// A filter that fails says why and changes nothing.
    void expect_refusal(const std::string& name, const RichParameterList& list, const std::string& words)
    {
        const std::vector<std::string> names = names_of(document), states = states_of(document);
        const MeshModel* const current = document.mm();
        const Ended ended = run(name, document, list);
        EXPECT_FALSE(ended.well);
        EXPECT_NE(ended.message.find(words), std::string::npos) << ended.message;
        EXPECT_EQ(names_of(document), names);
        EXPECT_EQ(states_of(document), states);
        EXPECT_EQ(document.mm(), current);
    }

    MeshDocument document;
};

TEST_F(MeshLab, ShowsAllFiltersUnderTheNamesThatScriptsKnow)
{
    for (const std::string& name : k_filters) {
        ASSERT_TRUE(action_of(name)) << name;
        EXPECT_GT(filter_of(name).filterInfo(action_of(name)).size(), 80) << name;
        EXPECT_EQ(filter_of(name).filterArity(action_of(name)), MeshFilterInterface::FIXED);
        EXPECT_NE(filter_of(name).getClass(action_of(name)), MeshFilterInterface::Generic);
    }
}

TEST_F(MeshLab, ShowsEveryParameterOfTheSchemaWithLabelAndTip)
{
    open_samples();
    const Parameters parameters;
    for (const Filter& filter : filters()) {
        const RichParameterList list = dialog_of(std::string(filter.label), document);
        describe(filter, parameters, [&](const auto&, const About& about) {
            EXPECT_TRUE(list.hasParameter(QString::fromUtf8(about.name.data(), int(about.name.size())))) << about.name;
        });
        for (const RichParameter& parameter : list) {
            EXPECT_FALSE(parameter.fieldDescription().isEmpty()) << parameter.name().toStdString();
            EXPECT_FALSE(parameter.toolTip().isEmpty()) << parameter.name().toStdString();
        }
    }
}

TEST_F(MeshLab, HasNoFieldsForAnEmptyDocumentAndRefusesToRun)
{
    for (const std::string& name : k_filters) {
        const RichParameterList list = dialog_of(name, document);
        EXPECT_TRUE(list.isEmpty()) << name;
        expect_refusal(name, list, "the document has no layer");
    }
}

TEST_F(MeshLab, RigsABodyIntoTwoNewLayersAndTouchesNoOther)
{
    open_samples();
    const std::string body = state_of(*document.meshList[0]), skirt = state_of(*document.meshList[1]);
    MeshModel* const current = document.mm();
    ASSERT_TRUE(run("Rig Body", document).well);

    EXPECT_EQ(names_of(document),
              (std::vector<std::string> { "walking_woman.ply", "skirt.ply", "walking_woman rigged",
                                          "walking_woman skeleton" }));
    EXPECT_EQ(state_of(*document.meshList[0]), body);
    EXPECT_EQ(state_of(*document.meshList[1]), skirt);
    EXPECT_EQ(document.mm(), current);
    EXPECT_EQ(document.meshList[3]->cm.vn, 1 + bone_count + extremity_count);
    EXPECT_EQ(document.meshList[3]->cm.en, bone_count + extremity_count);
}

TEST_F(MeshLab, FindsTheSameRigAsTheLibrary)
{
    open_samples();
    ASSERT_TRUE(run("Rig Body", document).well);
    const TriangleMesh mesh = body_mesh();
    const Rig rig = rig_body(make_body(mesh.positions, mesh.triangles));

    for (int bone = 0; bone < bone_count; ++bone)
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_EQ(document.meshList[3]->cm.vert[bone + 1].cP()[axis], float(rig.skeleton.tails[bone][axis]));
    CMeshO& rigged = document.meshList[2]->cm;
    auto joint = vcg::tri::Allocator<CMeshO>::FindPerVertexAttribute<float>(rigged, "joint1");
    auto weight = vcg::tri::Allocator<CMeshO>::FindPerVertexAttribute<float>(rigged, "weight1");
    for (int v = 0; v < rigged.vn; ++v) {
        EXPECT_EQ(joint[v], float(rig.weights.bones(v, 1)));
        EXPECT_EQ(weight[v], float(rig.weights.weights(v, 1)));
    }
}

TEST_F(MeshLab, ShowsTheWeightOfTheChosenBoneAsQuality)
{
    open_samples();
    RichParameterList list = dialog_of("Rig Body", document);
    list.setValue("shown_bone", EnumValue(lfemur));
    ASSERT_TRUE(run("Rig Body", document, list).well);
    const MeshModel& rigged = *document.meshList[2];
    EXPECT_TRUE(rigged.hasDataMask(MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR));
    float least = 1, most = 0;
    for (const CVertexO& vertex : rigged.cm.vert) {
        least = std::min(least, vertex.cQ());
        most = std::max(most, vertex.cQ());
    }
    EXPECT_EQ(least, 0);
    EXPECT_GT(most, 0.9F);
}

/// Rigs and fits body and skirt with a layer matrix, or with moved vertices.
void fit_moved(MeshDocument& document, const Matrix44m& matrix, bool by_layer)
{
    for (const fs::path& file : { k_body, k_skirt }) {
        MeshModel& layer = meshlab::open_layer(document, file);
        if (by_layer)
            layer.cm.Tr = matrix;
        else
            for (CVertexO& vertex : layer.cm.vert)
                vertex.P() = matrix * vertex.cP();
    }
    ASSERT_TRUE(run("Rig Body", document).well);
    ASSERT_TRUE(run("Fit Skeleton", document).well);
}

TEST_F(MeshLab, AppliesTheLayersMatrix)
{
    const Matrix44m z_up = Matrix44m(std::array<float, 16> { 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1 }.data()),
                    aside = Matrix44m(std::array<float, 16> { 0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1 }.data()),
                    millimetres = Matrix44m().SetScale(1024, 1024, 1024);  // a power of two near 1000 rounds no number
    for (const Matrix44m& matrix : { z_up, aside, millimetres, millimetres * z_up * aside }) {
        MeshDocument by_layer, by_mesh;
        fit_moved(by_layer, matrix, true);
        fit_moved(by_mesh, matrix, false);
        ASSERT_EQ(names_of(by_layer), names_of(by_mesh));
        for (int made = 2; made < by_mesh.size(); ++made) {
            EXPECT_EQ(by_layer.meshList[made]->cm.Tr, Matrix44m().Identity());
            for (int vertex = 0; vertex < by_mesh.meshList[made]->cm.vn; ++vertex)
                ASSERT_EQ(point_of(*by_layer.meshList[made], vertex), point_of(*by_mesh.meshList[made], vertex));
        }
    }
}

TEST_F(MeshLab, RigsAShiftedTurnedAndScaledLayerWhereItIsSeen)
{
    meshlab::open_layer(document, k_body);
    MeshDocument moved;
    const float scale = 39.37F;  // to inches
    const Matrix44m matrix = Matrix44m().SetTranslate(3, -0.5F, 1) * Matrix44m().SetRotateDeg(50, Point3m(0, 1, 0))
        * Matrix44m().SetScale(scale, scale, scale);
    MeshModel& body = meshlab::open_layer(moved, k_body);
    body.cm.Tr = matrix;
    ASSERT_TRUE(run("Rig Body", document).well);
    ASSERT_TRUE(run("Rig Body", moved).well);
    for (int joint = 0; joint < 1 + bone_count; ++joint) {
        const Point3m expected = matrix * document.meshList[2]->cm.vert[joint].cP();
        EXPECT_LT((moved.meshList[2]->cm.vert[joint].cP() - expected).Norm(), 0.04 * scale) << joint;
    }
    for (int vertex = 0; vertex < body.cm.vn; ++vertex)
        ASSERT_LT((moved.meshList[1]->cm.vert[vertex].cP() - matrix * body.cm.vert[vertex].cP()).Norm(), 1e-6 * scale);
}

TEST_F(MeshLab, SkipsDeletedVerticesAndKeepsThem)
{
    TriangleMesh mesh = body_mesh();
    mesh.positions.conservativeResize(mesh.positions.rows() + 1, 3);
    mesh.positions.bottomRows(1) << 9, 9, 9;
    MeshModel& body = meshlab::add_mesh(document, "/woman.ply", mesh);
    vcg::tri::Allocator<CMeshO>::DeleteVertex(body.cm, body.cm.vert.back());
    ASSERT_TRUE(run("Rig Body", document).well);
    EXPECT_EQ(document.meshList[1]->cm.vert.size(), body.cm.vert.size() - 1);
    EXPECT_TRUE(body.cm.vert.back().IsD());
}

TEST_F(MeshLab, ShowsLengthsInTheBodysUnit)
{
    TriangleMesh mesh = body_mesh();
    mesh.positions *= 100;
    meshlab::add_mesh(document, "/woman.ply", mesh);
    meshlab::open_layer(document, k_skirt);
    const RichParameterList list = dialog_of("Drape Garment", document);
    EXPECT_NEAR(list.getAbsPerc("contact_distance"), 100 * ClothOptions().contact_distance, 1e-6);
}

TEST_F(MeshLab, RefusesLayersThatAreNoBody)
{
    const Positions corners = (Positions(4, 3) << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1).finished();
    const Triangles faces = (Triangles(4, 3) << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2).finished();
    meshlab::add_mesh(document, "/tetrahedron.ply", { corners, faces });
    meshlab::add_mesh(document, "/points.ply", { corners, Triangles(0, 3) });
    RichParameterList list = dialog_of("Rig Body", document);
    expect_refusal("Rig Body", list, "");
    choose(list, "body", document, 1);
    expect_refusal("Rig Body", list, "points has no faces");
}

TEST_F(MeshLab, RefusesTheBodyAsItsOwnGarment)
{
    open_samples();
    RichParameterList list = dialog_of("Dress Body", document);
    choose(list, "garment", document, 0);
    expect_refusal("Dress Body", list, "walking_woman is already chosen as the body");
}

TEST_F(MeshLab, RefusesAGarmentTwice)
{
    open_samples();
    meshlab::open_layer(document, GARMENTFIT_SAMPLES "/coat.ply");
    RichParameterList list = dialog_of("Dress Body", document);
    choose(list, "second_garment", document, 2);
    choose(list, "third_garment", document, 2);
    expect_refusal("Dress Body", list, "coat is already chosen as another garment");
}

TEST_F(MeshLab, RefusesParametersOutOfRange)
{
    open_samples();
    RichParameterList list = dialog_of("Rig Body", document);
    list.setValue("proxy_vertices", IntValue(7));
    expect_refusal("Rig Body", list, "proxy_vertices: 7 is out of range");
}

TEST_F(MeshLab, RefusesAGarmentThatFacesUpwards)
{
    open_samples();
    RichParameterList list = dialog_of("Dress Body", document);
    list.setValue("garment_front", EnumValue(3));  // +y
    expect_refusal("Dress Body", list, "garment_front: +y lies along the up axis");
}

TEST_F(MeshLab, MakesABodyAsTallAsItIsSaidToBe)
{
    fs::copy(k_body, folder / "woman.ply");
    meshlab::open_layer(document, folder / "woman.ply");
    RichParameterList list = dialog_of("Rig Body", document);
    EXPECT_EQ(list.getString("height").toStdString(), "auto");
    list.setValue("height", StringValue("tall"));
    expect_refusal("Rig Body", list, "is not possible; give 0.2..10 m");
    list.setValue("height", StringValue("1.8"));
    const Ended ended = run("Rig Body", document, list);
    ASSERT_TRUE(ended.well) << ended.message;
    ASSERT_TRUE(run("Save Rig", document).well);
    const auto heights = body_mesh().positions.col(1);
    EXPECT_NEAR(read_rig_file(folder / "woman.rig.json").frame.metres_per_unit,
                1.8 / (heights.maxCoeff() - heights.minCoeff()), 1e-6);
}

TEST_F(MeshLab, EndsAtItsTimeLimit)
{
    open_samples();
    RichParameterList list = dialog_of("Rig Body", document);
    list.setValue("time_limit", FloatValue(1e-6F));
    expect_refusal("Rig Body", list, "time_limit: it was reached while rigging the body");
}

TEST_F(MeshLab, RefusesInvalidChoices)
{
    open_samples();
    using Field = std::pair<std::string, std::string>;
    for (const auto& [name, filter] :
         { Field { "unit", "Rig Body" }, Field { "shown_bone", "Rig Body" }, Field { "type", "Dress Body" },
           Field { "shown_map", "Dress Body" }, Field { "garment_front", "Dress Body" } })
        for (const int number : { -1, 99 }) {
            RichParameterList list = dialog_of(filter, document);
            list.setValue(QString::fromStdString(name), EnumValue(number));
            expect_refusal(filter, list, name + ": " + std::to_string(number) + " is out of range; give 0..");
        }
}

TEST_F(MeshLab, SaysWhichFilterMustRunFirst)
{
    open_samples();
    expect_refusal("Fit Skeleton", dialog_of("Fit Skeleton", document), "run Garment Fitting: Rig Body");
    ASSERT_TRUE(run("Rig Body", document).well);
    expect_refusal("Drape Garment", dialog_of("Drape Garment", document), "run Garment Fitting: Fit Skeleton");
    ASSERT_TRUE(run("Fit Skeleton", document).well);
    expect_refusal("Recover Pose", dialog_of("Recover Pose", document), "run Drape Garment");
}

TEST_F(MeshLab, ForgetsTheRigOfABodyThatWasChanged)
{
    open_samples();
    ASSERT_TRUE(run("Rig Body", document).well);
    document.meshList[0]->cm.vert[0].P()[0] += 0.01F;
    expect_refusal("Fit Skeleton", dialog_of("Fit Skeleton", document), "was changed after rigging");
}

TEST_F(MeshLab, FindsTheRigBesideTheBodysFile)
{
    fs::copy(k_body, folder / "woman.ply");
    meshlab::open_layer(document, folder / "woman.ply");
    ASSERT_TRUE(run("Rig Body", document).well);
    ASSERT_TRUE(run("Save Rig", document).well);
    ASSERT_TRUE(fs::exists(folder / "woman.rig.json"));

    MeshDocument reopened;
    meshlab::open_layer(reopened, folder / "woman.ply");
    meshlab::open_layer(reopened, k_skirt);
    const Ended fitted = run("Fit Skeleton", reopened);
    ASSERT_TRUE(fitted.well) << fitted.message;

    meshlab::open_layer(document, k_skirt);
    ASSERT_TRUE(run("Fit Skeleton", document).well);
    const MeshModel &skeleton = *document.meshList.back(), &again = *reopened.meshList.back();
    ASSERT_EQ(skeleton.label(), again.label());
    for (int joint = 0; joint < skeleton.cm.vn; ++joint)
        EXPECT_EQ(point_of(skeleton, joint), point_of(again, joint));
}

/// The skirt with texture coordinates of its corners.
void write_skirt_with_pattern(const fs::path& path)
{
    const MeshFile skirt = MeshFile::read(k_skirt);
    std::ofstream obj(path);
    for (const auto& place : skirt.positions().rowwise())
        obj << "v " << place << "\nvt " << 0.2 * std::atan2(place.z(), place.x()) << ' ' << place.y() << '\n';
    for (const auto& corners : skirt.triangles().rowwise()) {
        obj << 'f';
        for (const int corner : corners)
            obj << ' ' << corner + 1 << '/' << corner + 1;
        obj << '\n';
    }
}

TEST_F(MeshLab, TakesTheWarpFromTextureCoordinates)
{
    write_skirt_with_pattern(folder / "skirt.obj");
    const auto worn = [&](const fs::path& skirt) {
        MeshDocument own;
        meshlab::open_layer(own, k_body);
        meshlab::open_layer(own, skirt);
        RichParameterList list = dialog_of("Dress Body", own);
        list.setValue("quality", EnumValue(int(Quality::draft)));
        list.setValue("fabric", EnumValue(int(Fabric::stretch_woven)));
        const Ended ended = run("Dress Body", own, list);
        EXPECT_TRUE(ended.well) << ended.message;
        std::vector<Vec3> places;
        const MeshModel& last = *own.meshList.back();
        for (int v = 0; v < last.cm.vn; ++v)
            places.push_back(point_of(last, v));
        return places;
    };
    const std::vector<Vec3> with = worn(folder / "skirt.obj"), without = worn(k_skirt);
    ASSERT_EQ(with.size(), without.size());
    EXPECT_NE(with, without);
}

TEST_F(MeshLab, SavesADressedBodyAsAnOutfit)
{
    fs::copy(k_body, folder / "woman.ply");
    fs::copy(k_skirt, folder / "skirt.ply");
    meshlab::open_layer(document, folder / "woman.ply");
    meshlab::open_layer(document, folder / "skirt.ply");
    expect_refusal("Save Outfit", dialog_of("Save Outfit", document), "wears nothing in its own pose");
    RichParameterList dress = dialog_of("Dress Body", document);
    dress.setValue("quality", EnumValue(int(Quality::draft)));
    const Ended dressed = run("Dress Body", document, dress);
    ASSERT_TRUE(dressed.well) << dressed.message;

    const std::size_t layers = names_of(document).size();
    RichParameterList list = dialog_of("Save Outfit", document);
    list.setValue("bones", EnumValue(2));
    list.setValue("influences", EnumValue(1));
    const Ended ended = run("Save Outfit", document, list);
    ASSERT_TRUE(ended.well) << ended.message;
    EXPECT_EQ(names_of(document).size(), layers);
    std::ifstream file(folder / "woman.outfit.glb", std::ios::binary);
    const std::string bytes { std::istreambuf_iterator<char>(file), {} };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_NE(bytes.find("mixamorig:Hips"), std::string::npos);
    EXPECT_NE(bytes.find("JOINTS_1"), std::string::npos) << "eight influences";

    list.setValue("file", FileValue(QString::fromStdString((folder / "outfit.obj").string())));
    expect_refusal("Save Outfit", list, "give a name that ends in .glb or .vrm");
    document.meshList[0]->cm.vert[0].P()[0] += 0.01F;
    expect_refusal("Save Outfit", dialog_of("Save Outfit", document), "was changed since");
}

/// A skinned body with the joints of another program.
void write_avatar(const fs::path& path, double size = 1)
{
    const TriangleMesh mesh = body_mesh();
    const Rig rig = rig_body(make_body(mesh.positions, mesh.triangles));
    OutfitOptions options;
    options.names = BoneNames::unreal;
    write_outfit_glb(path, rig, { { "body", { size * mesh.positions, mesh.triangles }, rig.weights } }, options);
}

TEST_F(MeshLab, SavesAnOutfitOnTheSkeletonOfTheBodysFile)
{
    write_avatar(folder / "avatar.glb");
    meshlab::open_layer(document, folder / "avatar.glb");
    meshlab::open_layer(document, k_skirt);
    RichParameterList dress = dialog_of("Dress Body", document);
    dress.setValue("quality", EnumValue(int(Quality::draft)));
    const Ended dressed = run("Dress Body", document, dress);
    ASSERT_TRUE(dressed.well) << dressed.message;

    RichParameterList list = dialog_of("Save Outfit", document);
    const auto choose_file = [&](const QString& name, const fs::path& file) {
        list.setValue(name, FileValue(QString::fromStdString((folder / file).string())));
    };
    const auto joints_saved_as = [&](const char* file) {
        choose_file("file", file);
        const Ended ended = run("Save Outfit", document, list);
        EXPECT_TRUE(ended.well) << ended.message;
        const std::string outfit = load(folder / file);
        return outfit.find("spine_03") != std::string::npos ? "own" : "garmentfit";
    };
    EXPECT_EQ(joints_saved_as("of_the_layer.glb"), std::string("own"));
    EXPECT_EQ(MeshFile::read(folder / "of_the_layer.glb").positions().topRows(document.meshList[0]->cm.vn),
              MeshFile::read(folder / "avatar.glb").positions());

    write_ply(folder / "avatar.ply", body_mesh().positions, body_mesh().triangles);  // MeshLab 2020.09 opens no glTF
    document.meshList[0]->setFileName(QString::fromStdString((folder / "avatar.ply").string()));
    EXPECT_EQ(joints_saved_as("of_a_layer_without.glb"), std::string("garmentfit"));
    EXPECT_NE(log_of(document).find("avatar.ply has no skin. Choose the avatar's glTF, GLB or VRM as Body file"),
              std::string::npos);
    choose_file("body_file", "avatar.glb");
    EXPECT_EQ(joints_saved_as("of_a_file.glb"), std::string("own"));
    EXPECT_EQ(load(folder / "of_a_file.glb"), load(folder / "of_the_layer.glb"));

    choose_file("body_file", "avatar.ply");
    EXPECT_EQ(joints_saved_as("of_a_file_without.glb"), std::string("garmentfit"));
    write_avatar(folder / "taller.glb", 1.06);
    choose_file("body_file", "taller.glb");
    expect_refusal("Save Outfit", list, "vertices of the body do not lie where any of its");
    choose_file("body_file", "gone.glb");
    expect_refusal("Save Outfit", list, "gone.glb");
}

TEST_F(MeshLab, DrapesInAPoseFittedBeforeTheRigWasSaved)
{
    fs::copy(k_small_body, folder / "man.ply");
    meshlab::open_layer(document, folder / "man.ply");
    meshlab::open_layer(document, k_skirt);
    for (const char* step : { "Rig Body", "Fit Skeleton", "Save Rig" })
        ASSERT_TRUE(run(step, document).well) << step;

    MeshDocument reopened;
    meshlab::open_layer(reopened, folder / "man.ply");
    meshlab::open_layer(reopened, k_skirt);
    RichParameterList short_drape = dialog_of("Drape Garment", reopened);
    short_drape.setValue("growing_steps", IntValue(4));
    short_drape.setValue("settling_steps", IntValue(0));
    const Ended draped = run("Drape Garment", reopened, short_drape);
    EXPECT_EQ(draped.message.find("was not fitted into"), std::string::npos) << draped.message;
}

TEST_F(MeshLab, LoadsARigIntoTheLayersOfRigBody)
{
    fs::copy(k_body, folder / "woman.ply");
    meshlab::open_layer(document, folder / "woman.ply");
    ASSERT_TRUE(run("Rig Body", document).well);
    ASSERT_TRUE(run("Save Rig", document).well);
    const Ended loaded = run("Load Rig", document);
    ASSERT_TRUE(loaded.well) << loaded.message;
    ASSERT_EQ(document.size(), 5);
    for (int joint = 0; joint < 1 + bone_count; ++joint)
        EXPECT_EQ(point_of(*document.meshList[2], joint), point_of(*document.meshList[4], joint));
}

/// With the pelvis in the neck.
void spoil_rig(const fs::path& path)
{
    RigFile contents = read_whole_rig(path);
    contents.rig.skeleton.root = contents.rig.skeleton.tail(thorax);
    contents.rig.radii = {};  // of another skeleton
    write_rig_file(path, contents);
}

TEST_F(MeshLab, WarnsOfARigFileWhoseSkeletonSeemsWrong)
{
    fs::copy(k_small_body, folder / "man.ply");
    meshlab::open_layer(document, folder / "man.ply");
    ASSERT_TRUE(run("Rig Body", document).well);
    ASSERT_TRUE(run("Save Rig", document).well);
    const auto warned = [&](const char* name, bool with_garment) {
        MeshDocument reopened;
        meshlab::open_layer(reopened, folder / "man.ply");
        if (with_garment)
            meshlab::open_layer(reopened, k_skirt);
        const Ended ended = run(name, reopened);
        EXPECT_TRUE(ended.well) << ended.message;
        return log_of(reopened).find("the skeleton in man.rig.json may be wrong: the pelvis") != std::string::npos;
    };
    EXPECT_FALSE(warned("Load Rig", false));
    spoil_rig(folder / "man.rig.json");
    EXPECT_TRUE(warned("Load Rig", false));
    EXPECT_TRUE(warned("Fit Skeleton", true));
}

TEST_F(MeshLab, RefusesAnotherBodysRig)
{
    fs::copy(k_body, folder / "woman.ply");
    meshlab::open_layer(document, folder / "woman.ply");
    ASSERT_TRUE(run("Rig Body", document).well);
    ASSERT_TRUE(run("Save Rig", document).well);
    MeshDocument other;
    const MeshFile skirt = MeshFile::read(k_skirt);
    meshlab::add_mesh(other, folder / "woman.ply", { skirt.positions(), skirt.triangles() });
    const Ended loaded = run("Load Rig", other);
    EXPECT_FALSE(loaded.well);
    EXPECT_NE(loaded.message.find("belongs to a body of 13380 vertices"), std::string::npos) << loaded.message;

    MeshDocument taller;
    meshlab::open_layer(taller, folder / "woman.ply").cm.Tr.SetScale(1.1F, 1.1F, 1.1F);
    const Ended loaded_on_taller = run("Load Rig", taller);
    EXPECT_FALSE(loaded_on_taller.well);
    EXPECT_NE(loaded_on_taller.message.find("belongs to another body"), std::string::npos) << loaded_on_taller.message;
}

TEST_F(MeshLab, StopsOnRequestAndRunsAgainAfterwards)
{
    open_samples();
    const Ended stopped
        = run("Rig Body", document, dialog_of("Rig Body", document), [](int, const char*) { return false; });
    EXPECT_FALSE(stopped.well);
    EXPECT_NE(stopped.message.find("stopped by the user"), std::string::npos);
    EXPECT_EQ(document.size(), 2);
    EXPECT_TRUE(run("Rig Body", document).well);
}

int reports = 0;

TEST_F(MeshLab, ReportsProgressTenTimesASecondAtMost)
{
    open_samples();
    reports = 0;
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(run("Rig Body", document, dialog_of("Rig Body", document), [](int percent, const char*) {
                    EXPECT_TRUE(percent >= 0 && percent <= 100);
                    ++reports;
                    return true;
                }).well);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    EXPECT_GT(reports, 1);
    EXPECT_LE(reports, 1 + 10 * seconds.count());
}

/// Compares a layer with a garment that the program garmentfit dressed.
void expect_same_positions(const MeshModel& layer, const fs::path& file)
{
    const Positions positions = MeshFile::read(file).positions();
    ASSERT_EQ(layer.cm.vn, positions.rows());
    for (int v = 0; v < layer.cm.vn; ++v)
        ASSERT_EQ(point_of(layer, v), Vec3(positions.row(v))) << v;
}

class SlowMeshLab : public MeshLab { };

void dress_by_program(const fs::path& body, const fs::path& garment, const fs::path& out)
{
    const std::string call = std::string(GARMENTFIT_PROGRAM) + " dress " + body.string() + " " + garment.string()
        + " --quiet -o " + out.string();
    ASSERT_EQ(std::system(call.c_str()), 0);
}

TEST_F(SlowMeshLab, DressesToTheNumbersOfTheCommandLine)
{
    dress_by_program(k_small_body, k_skirt, folder / "dressed");
    meshlab::open_layer(document, k_small_body);
    meshlab::open_layer(document, k_skirt);
    const Ended dressed = run("Dress Body", document);
    ASSERT_TRUE(dressed.well) << dressed.message;
    const MeshModel& skirt = *document.meshList.back();
    EXPECT_EQ(skirt.label().toStdString(), "skirt on man_a_pose");
    expect_same_positions(skirt, folder / "dressed" / "skirt.ply");
    EXPECT_EQ(skirt.cm.fn, document.meshList[1]->cm.fn);

    RichParameterList list = dialog_of("Body Measurements and Ease", document);
    const Ended measured = run("Body Measurements and Ease", document, list);
    ASSERT_TRUE(measured.well) << measured.message;
    CMeshO& shown = document.meshList.back()->cm;
    CMeshO& worn = document.meshList[document.size() - 2]->cm;
    auto ease = vcg::tri::Allocator<CMeshO>::FindPerVertexAttribute<float>(worn, "ease");
    for (int v = 0; v < shown.vn; ++v)
        ASSERT_NEAR(shown.vert[v].Q(), ease[v], 1e-6);
}

TEST_F(SlowMeshLab, DressesABodyInInchesToTheNumbersOfTheCommandLine)
{
    constexpr double inches_per_metre = 1 / 0.0254;
    for (const fs::path& given : { k_small_body, k_skirt }) {
        const MeshFile file = MeshFile::read(given);
        file.write(folder / given.filename(), file.positions() * inches_per_metre);
        meshlab::open_layer(document, folder / given.filename());
    }
    dress_by_program(folder / k_small_body.filename(), folder / k_skirt.filename(), folder / "dressed");
    const Ended dressed = run("Dress Body", document);
    ASSERT_TRUE(dressed.well) << dressed.message;
    expect_same_positions(*document.meshList.back(), folder / "dressed" / "skirt.ply");
}

TEST_F(SlowMeshLab, DressesTurnedAndScaledLayersToTheNumbersOfTheCommandLine)
{
    const Eigen::Matrix3d turned
        = (Eigen::Matrix3d() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished() * 1024;  // z up, about millimetres
    for (const fs::path& given : { k_small_body, k_skirt }) {
        const MeshFile file = MeshFile::read(given);
        file.write(folder / given.filename(), file.positions() * turned.transpose());
        Matrix44m& matrix = meshlab::open_layer(document, given).cm.Tr;
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                matrix[row][column] = float(turned(row, column));
    }
    dress_by_program(folder / k_small_body.filename(), folder / k_skirt.filename(), folder / "dressed");
    const Ended dressed = run("Dress Body", document);
    ASSERT_TRUE(dressed.well) << dressed.message;
    expect_same_positions(*document.meshList.back(), folder / "dressed" / "skirt.ply");
}

TEST_F(SlowMeshLab, DressesStepByStep)
{
    open_samples();
    for (const char* step : { "Rig Body", "Fit Skeleton", "Drape Garment", "Recover Pose" }) {
        const Ended ended = run(step, document);
        ASSERT_TRUE(ended.well) << step << ": " << ended.message;
    }
    EXPECT_EQ(
        names_of(document),
        (std::vector<std::string> { "walking_woman.ply", "skirt.ply", "walking_woman rigged", "walking_woman skeleton",
                                    "walking_woman in the pose of skirt", "walking_woman skeleton in the pose of skirt",
                                    "skirt on walking_woman, draped", "skirt on walking_woman" }));
}

TEST_F(SlowMeshLab, SaysWhereAGarmentIsTooSmallAndAddsNothing)
{
    meshlab::open_layer(document, k_body);
    const MeshFile skirt = MeshFile::read(k_skirt);
    const Positions centred = skirt.positions().rowwise() - skirt.positions().colwise().mean();
    const Positions narrow
        = (centred * Vec3(0.72, 1, 0.72).asDiagonal()).rowwise() + skirt.positions().colwise().mean();
    meshlab::add_mesh(document, "/narrow.ply", { narrow, skirt.triangles() });
    expect_refusal("Dress Body", dialog_of("Dress Body", document), "narrow is too small");
}

std::size_t resident_bytes()
{
    malloc_trim(0);
    std::size_t all_pages = 0, resident_pages = 0;
    std::ifstream("/proc/self/statm") >> all_pages >> resident_pages;
    return resident_pages * std::size_t(sysconf(_SC_PAGESIZE));
}

TEST_F(SlowMeshLab, KeepsMemoryLevelOverTwentyRuns)
{
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer keeps freed memory";
#endif
    meshlab::open_layer(document, k_small_body);
    meshlab::open_layer(document, k_skirt);
    const auto run_and_forget = [&] {
        ASSERT_TRUE(run("Rig Body", document).well);
        ASSERT_TRUE(run("Fit Skeleton", document).well);
        while (document.size() > 2) {
            document.meshList.back()->cm.ClearAttributes();  // MeshLab 2020.09 does not do so when it deletes a layer
            document.delMesh(document.meshList.back());
        }
    };
    for (int warm_up = 0; warm_up < 5; ++warm_up)
        run_and_forget();
    const std::size_t allocated = mallinfo2().uordblks, resident = resident_bytes();
    for (int i = 0; i < 20; ++i)
        run_and_forget();
    EXPECT_LT(mallinfo2().uordblks, allocated + (1U << 20));
    EXPECT_LT(resident_bytes(), resident + (8U << 20));
    RecordProperty("resident_growth_kB", (long(resident_bytes()) - long(resident)) / 1024);
}

}  // namespace

#ifdef __SANITIZE_ADDRESS__
/// Known leaks: vertex attributes of deleted layers in MeshLab 2020.09, and Qt's screen without a display.
extern "C" __attribute__((visibility("default"))) const char* __lsan_default_suppressions()
{
    return "leak:AddPerVertexAttribute\nleak:libQt5\nleak:libqoffscreen\n";
}
#endif

int main(int argc, char** argv)
{
    qputenv("QT_QPA_PLATFORM", "offscreen");
    testing::InitGoogleTest(&argc, argv);
    const QApplication application(argc, argv);
    return RUN_ALL_TESTS();
}
