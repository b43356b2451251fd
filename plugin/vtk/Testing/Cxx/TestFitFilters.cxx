// SPDX-License-Identifier: GPL-3.0-or-later

// The VTK filters in a pipeline: the same numbers as the filters behind them, no copies, no repeated computation, and
// usable after errors.

#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/filters/filters.h"
#include "polydata_of.h"

#include "vtkCallbackCommand.h"
#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkDrapeGarment.h"
#include "vtkDressBody.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkFitSkeleton.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkRecoverPose.h"
#include "vtkRigBody.h"
#include "vtkSmartPointer.h"
#include "vtkSphereSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkTestErrorObserver.h"
#include "vtkTrivialProducer.h"

namespace {

using namespace garmentfit;
using namespace garmentfit::fixtures;

// ---- inputs ----------------------------------------------------------------------------------------------

vtkSmartPointer<vtkFloatArray> some_numbers(const char* name, vtkIdType count, int components)
{
    auto array = vtkSmartPointer<vtkFloatArray>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetNumberOfTuples(count);
    array->Fill(0.5);
    return array;
}

const TriangleMesh& body_mesh()
{
    static const TriangleMesh mesh = capsule_person({ .arm_angle = 20, .hip_angle = 8 }).mesh;
    return mesh;
}

TriangleMesh shorts_mesh(double ease)
{
    return garment_round(
        person_skeleton({}), ease, [](const Vec3& p) { return p.y() > 0.5 && p.y() < 1.0 && std::abs(p.x()) < 0.26; },
        0.04);
}

vtkSmartPointer<vtkPolyData> body() { return polydata_of(body_mesh()); }

vtkSmartPointer<vtkPolyData> shorts(double ease = 0.02)
{
    auto data = polydata_of(shorts_mesh(ease));
    data->GetPointData()->SetTCoords(some_numbers("UV", data->GetNumberOfPoints(), 2));
    data->GetCellData()->AddArray(some_numbers("Panel", data->GetNumberOfCells(), 1));
    return data;
}

void shorten(vtkDressBody& filter)
{
    filter.SetTypeByName("shorts");
    filter.SetSettlingSteps(2);
    filter.SetRecoverySettlingSteps(2);
    filter.SetQualityByName("draft");
}

// ---- outputs --------------------------------------------------------------------------------------------

vtkPolyData* polydata(vtkAlgorithm& filter, int port)
{
    return vtkPolyData::SafeDownCast(filter.GetOutputDataObject(port));
}

double number(vtkDataObject* data, const char* name)
{
    return data->GetFieldData()->GetArray(name)->GetComponent(0, 0);
}

Positions points_of(vtkPolyData* data)
{
    Positions positions(data->GetNumberOfPoints(), 3);
    for (Eigen::Index v = 0; v < positions.rows(); ++v)
        data->GetPoint(v, positions.row(v).data());
    return positions;
}

struct Stages {
    std::set<std::string> seen;
    vtkNew<vtkCallbackCommand> command;

    explicit Stages(vtkAlgorithm& filter)
    {
        command->SetClientData(this);
        command->SetCallback([](vtkObject* caller, unsigned long, void* self, void*) {
            auto* sender = static_cast<vtkAlgorithm*>(caller);
            if (sender->GetProgress() > 0 && sender->GetProgress() < 1)  // the executive reports 0 and 1 itself
                static_cast<Stages*>(self)->seen.insert(sender->GetProgressText());
        });
        filter.AddObserver(vtkCommand::ProgressEvent, command);
    }
};

/// Listens to a filter and its executive.
struct Errors {
    vtkSmartPointer<vtkTest::ErrorObserver> heard = vtkSmartPointer<vtkTest::ErrorObserver>::New();

    explicit Errors(vtkAlgorithm& filter)
    {
        for (vtkObject* object : { static_cast<vtkObject*>(&filter), static_cast<vtkObject*>(filter.GetExecutive()) }) {
            object->AddObserver(vtkCommand::ErrorEvent, heard);
            object->AddObserver(vtkCommand::WarningEvent, heard);
        }
    }
};

struct Chain {
    vtkNew<vtkRigBody> rig;
    vtkNew<vtkFitSkeleton> fit;
    vtkNew<vtkDrapeGarment> drape;
    vtkNew<vtkRecoverPose> recover;

    Chain(vtkPolyData* body_data, vtkDataObject* garments)
    {
        rig->SetInputData(body_data);
        fit->SetInputConnection(0, rig->GetOutputPort());
        fit->SetInputDataObject(1, garments);
        for (const auto& [from, to] : { std::pair<vtkAlgorithm*, vtkAlgorithm*> { fit, drape }, { drape, recover } }) {
            to->SetInputConnection(0, from->GetOutputPort(0));
            to->SetInputConnection(1, from->GetOutputPort(1));
        }
        fit->SetTypeByName("shorts");
        drape->SetSettlingSteps(2);
        recover->SetRecoverySettlingSteps(2);
        recover->SetQualityByName("draft");
    }
};

/// A reader with a time step: it reads again for each time step that is requested.
class TimedBody : public vtkPolyDataAlgorithm {
public:
    static TimedBody* New();
    vtkTypeMacro(TimedBody, vtkPolyDataAlgorithm);

protected:
    TimedBody() { SetNumberOfInputPorts(0); }

    int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
    {
        double time = 0.3;
        outputs->GetInformationObject(0)->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), &time, 1);
        return 1;
    }

    int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
    {
        vtkPolyData::GetData(outputs)->ShallowCopy(body());
        return 1;
    }
};
vtkStandardNewMacro(TimedBody);

Scene dressed_by_the_filters()
{
    Scene scene;
    scene.body = make_body(body_mesh().positions, body_mesh().triangles);
    const TriangleMesh garment = shorts_mesh(0.02);
    scene.garments.push_back({ make_garment(garment.positions, garment.triangles), GarmentType::automatic });
    Parameters p;
    p.fit.type = GarmentType::shorts;
    p.drape.settling_steps = p.recover.settling_steps = 2;
    p.recover.quality = garmentfit::Quality::draft;
    filter_of("dress").run(scene, p);
    return scene;
}

/// One dressing that several tests look at.
struct Dressed {
    vtkSmartPointer<vtkPolyData> person = body(), garment = shorts();
    vtkNew<vtkDressBody> dress;

    Dressed()
    {
        dress->SetInputData(0, person);
        dress->SetInputData(1, garment);
        shorten(*dress);
        dress->Update();
    }
};

Dressed& dressed()
{
    static Dressed once;
    return once;
}

// ---- the tests -------------------------------------------------------------------------------------------------

TEST(DressBody, GivesTheNumbersOfTheFilterBehindIt)
{
    const Scene scene = dressed_by_the_filters();
    vtkDressBody* dress = dressed().dress;
    const WornGarment& worn = scene.recovered->garments[0];
    vtkPolyData* garment = polydata(*dress, 1);
    EXPECT_EQ(points_of(garment), worn.positions);
    EXPECT_EQ(number(garment, "GarmentMinDistance"), worn.certificate.min_distance);
    EXPECT_EQ(number(garment, "BodyCrossings"), 0);
    for (Eigen::Index v = 0; v < worn.positions.rows(); ++v)
        ASSERT_EQ(garment->GetPointData()->GetArray("Ease")->GetComponent(v, 0), scene.recovered->maps[0].ease[v]);
    EXPECT_EQ(number(polydata(*dress, 0), "Certified"), scene.recovered->certified ? 1 : 0);
}

TEST(Chain, OfFourFiltersGivesWhatDressBodyGives)
{
    vtkDressBody* dress = dressed().dress;
    Chain chain(dressed().person, dressed().garment);
    chain.recover->Update();
    EXPECT_EQ(points_of(polydata(*chain.recover, 1)), points_of(polydata(*dress, 1)));
    EXPECT_EQ(points_of(polydata(*chain.recover, 2)), points_of(polydata(*dress, 2)));
    EXPECT_EQ(number(polydata(*chain.recover, 1), "StrainP95"), number(polydata(*dress, 1), "StrainP95"));
}

TEST(DressBody, CopiesNoUnchangedData)
{
    const auto& [person, garment, dress] = dressed();
    EXPECT_EQ(polydata(*dress, 0)->GetPoints(), person->GetPoints());
    EXPECT_EQ(polydata(*dress, 0)->GetPolys(), person->GetPolys());
    vtkPolyData* dressed = polydata(*dress, 1);
    EXPECT_EQ(dressed->GetPolys(), garment->GetPolys());
    EXPECT_EQ(dressed->GetPointData()->GetTCoords(), garment->GetPointData()->GetTCoords());
    EXPECT_EQ(dressed->GetCellData()->GetArray("Panel"), garment->GetCellData()->GetArray("Panel"));
    EXPECT_EQ(dressed->GetPointData()->GetArray("RestPosition")->GetVoidPointer(0),
              garment->GetPoints()->GetData()->GetVoidPointer(0));
    EXPECT_EQ(garment->GetPointData()->GetNumberOfArrays(), 1);  // the input gained nothing
    EXPECT_EQ(garment->GetFieldData()->GetNumberOfArrays(), 0);
    EXPECT_EQ(person->GetFieldData()->GetNumberOfArrays(), 0);
}

TEST(DressBody, RepeatsOnlyStepsThatDependOnAChangedParameter)
{
    vtkNew<vtkDressBody> dress;
    dress->SetInputData(0, body());
    dress->SetInputData(1, shorts());
    shorten(*dress);
    dress->Update();
    {
        Stages stages(*dress);
        dress->Update();
        EXPECT_TRUE(stages.seen.empty());
        dress->SetSettlingSteps(2);  // as it was
        dress->Update();
        EXPECT_TRUE(stages.seen.empty());
        dress->SetFrames(3);
        dress->Update();
        EXPECT_EQ(stages.seen, std::set<std::string> { "recovering the pose" });
    }
    Stages stages(*dress);
    dress->SetIterations(7);
    dress->Update();
    EXPECT_EQ(stages.seen.count("rigging the body"), 0u);
    EXPECT_EQ(stages.seen.count("fitting the skeleton"), 1u);
}

TEST(RigBody, GivesASkeletonOfNamedJointsAndWeightsThatSumToOne)
{
    vtkNew<vtkRigBody> rig;
    rig->SetInputData(body());
    rig->Update();
    vtkDataArray* weights = polydata(*rig, 0)->GetPointData()->GetArray("JointWeights");
    for (vtkIdType v = 0; v < weights->GetNumberOfTuples(); ++v)
        ASSERT_NEAR(weights->GetComponent(v, 0) + weights->GetComponent(v, 1) + weights->GetComponent(v, 2)
                        + weights->GetComponent(v, 3),
                    1, 1e-12);
    vtkPolyData* skeleton = polydata(*rig, rig->GetSkeletonPort());
    EXPECT_EQ(skeleton->GetNumberOfLines(), int(bone_count) + int(extremity_count));
    auto* names = vtkStringArray::SafeDownCast(skeleton->GetPointData()->GetAbstractArray("JointName"));
    EXPECT_EQ(names->GetValue(0), "root");
    EXPECT_GE(names->LookupValue("lelbow"), 0);
    vtkDataArray* parents = skeleton->GetPointData()->GetArray("JointParent");
    for (vtkIdType j = 0; j < skeleton->GetNumberOfPoints(); ++j)
        EXPECT_LT(parents->GetComponent(j, 0), j);
}

TEST(RigBody, TakesKnownJointsInTheBodysUnits)
{
    auto in_decimetres = polydata_of({ 10 * body_mesh().positions, body_mesh().triangles });
    const Vec3 elbow = 10 * person_skeleton({ .arm_angle = 20 }).tails[lhumerus];
    vtkNew<vtkRigBody> rig;
    rig->SetInputData(in_decimetres);
    rig->SetUnit("dm");
    rig->SetJoint("lelbow", elbow.x(), elbow.y(), elbow.z());
    rig->Update();
    vtkPolyData* skeleton = polydata(*rig, 1);
    auto* names = vtkStringArray::SafeDownCast(skeleton->GetPointData()->GetAbstractArray("JointName"));
    EXPECT_NEAR((Vec3(skeleton->GetPoint(names->LookupValue("lelbow"))) - elbow).norm(), 0, 1e-9);
    EXPECT_EQ(number(polydata(*rig, 0), "BodyFrame"), 0.1);
}

TEST(RigBody, IsAsTallAsItIsSaidToBe)
{
    vtkNew<vtkRigBody> rig;
    rig->SetInputData(body());
    EXPECT_TRUE(std::isnan(rig->GetHeight()));
    const auto heights = body_mesh().positions.col(1);
    for (const double height : { 1.5, 0.9 }) {
        rig->SetHeight(height);
        rig->Update();
        EXPECT_NEAR(number(polydata(*rig, 0), "BodyFrame"), height / (heights.maxCoeff() - heights.minCoeff()), 1e-12);
    }
    rig->SetHeight(NAN);
    rig->Update();
    EXPECT_EQ(number(polydata(*rig, 0), "BodyFrame"), 1);
}

TEST(RigBody, EndsAtItsTimeLimit)
{
    vtkNew<vtkRigBody> rig;
    Errors errors(*rig);
    rig->SetInputData(body());
    rig->SetTimeLimit(1e-9);
    rig->Update();
    EXPECT_EQ(rig->GetErrorName(), "time_limit");
    EXPECT_NE(errors.heard->GetErrorMessage().find("time_limit"), std::string::npos);
    errors.heard->Clear();
    rig->SetTimeLimit(0);
    rig->Update();
    EXPECT_FALSE(errors.heard->GetError());
    EXPECT_GT(polydata(*rig, 0)->GetNumberOfPoints(), 0);
}

/// A number in the field data of a garment.
void say(vtkPolyData& garment, const char* name, double value)
{
    vtkNew<vtkDoubleArray> array;
    array->SetName(name);
    array->InsertNextValue(value);
    garment.GetFieldData()->AddArray(array);
}

TEST(FitSkeleton, TakesScaleFrontAndPlaceOfAllGarmentsOrOfEach)
{
    vtkNew<vtkRigBody> rig;
    rig->SetInputData(body());
    rig->SetHeight(1.5);
    vtkNew<vtkMultiBlockDataSet> layers;
    layers->SetBlock(0, shorts(0.02));
    auto scaled = shorts(0.03), placed = shorts(0.04);
    say(*scaled, "GarmentScale", 1.1);
    say(*placed, "GarmentAsPlaced", 1);
    layers->SetBlock(1, scaled);
    layers->SetBlock(2, placed);
    vtkNew<vtkFitSkeleton> fit;
    Errors errors(*fit);
    fit->SetInputConnection(0, rig->GetOutputPort());
    fit->SetInputData(1, layers);
    const auto metres_per_unit = [&](int layer) {
        fit->Update();
        auto* made = vtkMultiBlockDataSet::SafeDownCast(fit->GetOutputDataObject(1));
        return number(vtkPolyData::SafeDownCast(made->GetBlock(layer)), "GarmentFrame");
    };
    fit->SetGarmentFront("+z");
    EXPECT_DOUBLE_EQ(metres_per_unit(0), 1);
    EXPECT_DOUBLE_EQ(metres_per_unit(1), 1.1);
    EXPECT_DOUBLE_EQ(metres_per_unit(2), number(polydata(*rig, 0), "BodyFrame"));
    fit->SetGarmentScale(1.05);
    EXPECT_DOUBLE_EQ(metres_per_unit(0), 1.05);
    EXPECT_DOUBLE_EQ(metres_per_unit(1), 1.1);
    fit->SetGarmentScale(1);
    fit->AsPlacedOn();
    EXPECT_DOUBLE_EQ(metres_per_unit(0), number(polydata(*rig, 0), "BodyFrame"));
    EXPECT_FALSE(errors.heard->GetError()) << errors.heard->GetErrorMessage();
    fit->SetGarmentFront("-y");
    fit->Update();
    EXPECT_NE(errors.heard->GetErrorMessage().find("garment_front: -y lies along the up axis"), std::string::npos)
        << errors.heard->GetErrorMessage();
}

TEST(FitSkeleton, SortsLayersWhereTheirOrderIsAutomatic)
{
    vtkNew<vtkMultiBlockDataSet> layers;
    layers->SetBlock(0, shorts(0.04));
    layers->SetBlock(1, shorts(0.015));
    vtkNew<vtkRigBody> rig;
    rig->SetInputData(body());
    vtkNew<vtkFitSkeleton> fit;
    fit->SetInputConnection(0, rig->GetOutputPort());
    fit->SetInputData(1, layers);
    fit->SetTypeByName("shorts");  // so that the width decides
    fit->Update();
    EXPECT_EQ(number(polydata(*fit, 0), "FitLayers"), 0) << "as given";
    fit->SetLayerOrderByName("auto");
    fit->Update();
    EXPECT_EQ(number(polydata(*fit, 0), "FitLayers"), 1) << "the wider one";
}

TEST(DressBody, DressesLayersOfACompositeAndReturnsAComposite)
{
    vtkNew<vtkMultiBlockDataSet> layers;
    layers->SetBlock(0, shorts(0.015));
    layers->SetBlock(1, shorts(0.03));
    layers->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "overshorts");
    vtkNew<vtkDressBody> dress;
    dress->SetInputData(0, body());
    dress->SetInputData(1, layers);
    shorten(*dress);
    dress->Update();
    auto* dressed = vtkMultiBlockDataSet::SafeDownCast(dress->GetOutputDataObject(1));
    ASSERT_TRUE(dressed);
    ASSERT_EQ(dressed->GetNumberOfBlocks(), 2u);
    EXPECT_STREQ(dressed->GetMetaData(1u)->Get(vtkCompositeDataSet::NAME()), "overshorts");
    EXPECT_EQ(number(dressed->GetBlock(1), "Worn"), 1);
    EXPECT_EQ(number(dressed->GetBlock(1), "LayerCrossings"), 0);

    dress->SetInputData(1, shorts());  // and one garment again
    dress->Update();
    EXPECT_TRUE(polydata(*dress, 1));
}

TEST(RecoverPose, OffersItsPosePathAsTimeSteps)
{
    Chain chain(body(), shorts());
    chain.recover->SetFrames(4);
    chain.recover->UpdateInformation();
    for (int port = 0; port < 3; ++port)
        EXPECT_EQ(chain.recover->GetOutputInformation(port)->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()), 4);
    chain.recover->UpdateTimeStep(0);
    EXPECT_EQ(points_of(polydata(*chain.recover, 0)), points_of(polydata(*chain.drape, 0)));
    EXPECT_EQ(points_of(polydata(*chain.recover, 1)), points_of(polydata(*chain.drape, 1)));
    EXPECT_EQ(polydata(*chain.recover, 1)->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), 0);

    Stages recovered(*chain.recover), rigged(*chain.rig);
    chain.recover->UpdateTimeStep(1);
    EXPECT_EQ(points_of(polydata(*chain.recover, 0)), body_mesh().positions);
    EXPECT_TRUE(recovered.seen.empty());
    EXPECT_TRUE(rigged.seen.empty());
}

TEST(DressBody, ComputesFramesOnceWhereTheBodysFileHasATimeStep)
{
    vtkNew<TimedBody> reader;
    vtkNew<vtkDressBody> dress;
    vtkNew<vtkPolyData> elsewhere;  // round the body, nothing would move
    elsewhere->DeepCopy(shorts());
    for (vtkIdType i = 0; i < elsewhere->GetNumberOfPoints(); ++i)
        elsewhere->GetPoints()->SetPoint(
            i, Eigen::Vector3d(Eigen::Vector3d(elsewhere->GetPoint(i)) + Eigen::Vector3d(1, 0, 0)).data());
    dress->SetInputConnection(0, reader->GetOutputPort());
    dress->SetInputData(1, elsewhere);
    shorten(*dress);
    dress->SetFrames(2);
    dress->UpdateTimeStep(1);
    Stages stages(*dress);
    dress->UpdateTimeStep(0);
    EXPECT_TRUE(stages.seen.empty());
    EXPECT_NE(points_of(polydata(*dress, 0)), body_mesh().positions);
}

TEST(Chain, DoesNotRigAgainWhenTheFitChanges)
{
    Chain chain(body(), shorts());
    chain.fit->Update();
    Stages rigged(*chain.rig), fitted(*chain.fit);
    chain.fit->SetIterations(7);
    chain.fit->Update();
    EXPECT_TRUE(rigged.seen.empty());
    EXPECT_FALSE(fitted.seen.empty());
}

/// Joins pairs of triangles that share an edge to quads; fans of the quads are these triangles.
vtkSmartPointer<vtkCellArray> quads_of(const TriangleMesh& mesh)
{
    struct Side {
        Eigen::Index triangle;
        int opposite;
    };
    std::map<std::pair<int, int>, Side> sides;  // by the vertices that they lead from and to
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            sides[{ mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3) }] = { f, mesh.triangles(f, (k + 2) % 3) };
    std::set<Eigen::Index> done;
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        if (!done.insert(f).second)
            continue;
        const Eigen::RowVector3i t = mesh.triangles.row(f);
        const auto beyond = sides.find({ t[0], t[2] });
        if (beyond != sides.end() && done.insert(beyond->second.triangle).second)
            cells->InsertNextCell({ t[0], t[1], t[2], beyond->second.opposite });
        else
            cells->InsertNextCell({ t[0], t[1], t[2] });
    }
    return cells;
}

TEST(DressBody, KeepsQuads)
{
    auto garment = shorts();
    garment->SetPolys(quads_of(shorts_mesh(0.02)));
    ASSERT_LT(garment->GetNumberOfPolys(), shorts_mesh(0.02).triangles.rows());
    vtkNew<vtkDressBody> dress;
    dress->SetInputData(0, body());
    dress->SetInputData(1, garment);
    shorten(*dress);
    dress->Update();
    EXPECT_EQ(number(polydata(*dress, 0), "Certified"), 1);
    EXPECT_EQ(polydata(*dress, 1)->GetPolys(), garment->GetPolys());
    EXPECT_EQ(polydata(*dress, 1)->GetPointData()->GetArray("Ease")->GetNumberOfTuples(), garment->GetNumberOfPoints());
}

/// Texture coordinates as of pieces of a pattern: round the body and along it.
vtkSmartPointer<vtkFloatArray> pattern_of(const TriangleMesh& mesh, bool is_upright)
{
    vtkNew<vtkFloatArray> array;
    array->SetName("UV");
    array->SetNumberOfComponents(2);
    for (const auto& place : mesh.positions.rowwise()) {
        const double round = 0.2 * std::atan2(place.z(), std::abs(place.x()) - 0.1), along = place.y();
        array->InsertNextTuple2(is_upright ? round : along, is_upright ? along : round);
    }
    return array;
}

TEST(DressBody, TakesTheWarpFromTextureCoordinates)
{
    const TriangleMesh mesh = shorts_mesh(0.02);
    const auto worn = [&](vtkDataArray* uvs) {
        auto garment = polydata_of(mesh);
        garment->GetPointData()->SetTCoords(uvs);
        vtkNew<vtkDressBody> dress;
        dress->SetInputData(0, body());
        dress->SetInputData(1, garment);
        dress->SetFabricByName("stretch_woven");
        shorten(*dress);
        dress->Update();
        return points_of(polydata(*dress, 1));
    };
    const Positions without = worn(nullptr), upright = worn(pattern_of(mesh, true)),
                    across = worn(pattern_of(mesh, false));
    ASSERT_EQ(without.rows(), mesh.positions.rows());
    EXPECT_NE(upright, without);
    EXPECT_NE(upright, across);
}

TEST(DressBody, WarnsOfAGarmentThatIsTooSmall)
{
    vtkNew<vtkDressBody> dress;
    Errors errors(*dress);
    dress->SetInputData(0, body());
    dress->SetInputData(1, shorts(-0.02));
    shorten(*dress);
    dress->Update();
    EXPECT_FALSE(errors.heard->GetError()) << errors.heard->GetErrorMessage();
    ASSERT_TRUE(errors.heard->GetWarning());
    EXPECT_NE(errors.heard->GetWarningMessage().find("too small"), std::string::npos);
    EXPECT_EQ(number(polydata(*dress, 0), "Certified"), 0);
    EXPECT_TRUE(std::isnan(number(polydata(*dress, 0), "Speed")));
    EXPECT_GT(number(polydata(*dress, 1), "MissingGirth"), 0);
}

// ---- bad input -------------------------------------------------------------------------------------------------

vtkSmartPointer<vtkPolyData> lines_only()
{
    auto data = body();
    vtkNew<vtkCellArray> lines;
    lines->InsertNextCell({ 0, 1 });
    data->SetPolys(nullptr);
    data->SetLines(lines);
    return data;
}

vtkSmartPointer<vtkPolyData> not_finite()
{
    auto data = body();
    data->GetPoints()->SetPoint(7, NAN, 0, 0);
    return data;
}

vtkSmartPointer<vtkPolyData> naming_a_point_that_is_not_there()
{
    auto data = body();
    data->GetPolys()->InsertNextCell({ 0, 1, 1000000 });
    return data;
}

vtkSmartPointer<vtkPolyData> sphere()
{
    vtkNew<vtkSphereSource> source;
    source->Update();
    return source->GetOutput();
}

TEST(RigBody, RefusesBadInputInOneLineAndWorksAfterwards)
{
    vtkNew<vtkRigBody> rig;
    Errors errors(*rig);
    const std::pair<vtkSmartPointer<vtkPolyData>, const char*> bad[]
        = { { vtkSmartPointer<vtkPolyData>::New(), "0 polygons" },
            { lines_only(), "1 lines" },
            { not_finite(), "7" },
            { naming_a_point_that_is_not_there(), "refers to a vertex outside" },
            { sphere(), "" } };
    for (const auto& [data, part] : bad) {
        rig->SetInputData(data);
        rig->Update();
        EXPECT_NE(errors.heard->GetErrorMessage().find(part), std::string::npos) << errors.heard->GetErrorMessage();
        EXPECT_EQ(rig->GetErrorCode(), vtkFitFilter::InvalidInput);
        EXPECT_NE(rig->GetErrorName(), "");
        EXPECT_EQ(polydata(*rig, 0)->GetNumberOfPoints(), 0);
        EXPECT_EQ(polydata(*rig, 1)->GetNumberOfPoints(), 0);
        errors.heard->Clear();
    }
    rig->SetInputData(body());
    rig->Update();
    EXPECT_FALSE(errors.heard->GetError()) << errors.heard->GetErrorMessage();
    EXPECT_EQ(rig->GetErrorCode(), vtkErrorCode::NoError);
    EXPECT_EQ(rig->GetErrorName(), "");
    EXPECT_GT(polydata(*rig, 1)->GetNumberOfPoints(), 0);
}

TEST(RigBody, NamesTheKindOfAnErrorForPrograms)
{
    vtkNew<vtkRigBody> rig;
    Errors errors(*rig);
    rig->SetInputData(lines_only());
    rig->Update();
    EXPECT_EQ(rig->GetErrorName(), name_of(ErrorCode::no_faces));
}

TEST(FitSkeleton, RefusesABodyWithoutARigOrWithTheRigOfAnother)
{
    vtkNew<vtkRigBody> rig;
    rig->SetInputData(body());
    rig->Update();
    const auto with_its_rig = [&](const TriangleMesh& mesh) {
        auto other = polydata_of(mesh);
        other->GetFieldData()->ShallowCopy(polydata(*rig, 0)->GetFieldData());
        for (const char* name : { "JointIndices", "JointWeights" })
            other->GetPointData()->AddArray(polydata(*rig, 0)->GetPointData()->GetArray(name));
        return other;
    };
    vtkNew<vtkFitSkeleton> fit;
    Errors errors(*fit);
    fit->SetInputData(1, shorts());
    const std::pair<vtkSmartPointer<vtkPolyData>, const char*> bad[]
        = { { body(), "Rig Body" },
            { with_its_rig(capsule_person({ .arm_angle = 0, .spacing = 0.06 }).mesh), "belongs to a body of" },
            { with_its_rig({ 1.1 * body_mesh().positions, body_mesh().triangles }), "belongs to another body" } };
    for (const auto& [data, part] : bad) {
        fit->SetInputData(0, data);
        fit->Update();
        EXPECT_NE(errors.heard->GetErrorMessage().find(part), std::string::npos) << errors.heard->GetErrorMessage();
        EXPECT_EQ(polydata(*fit, 1)->GetNumberOfPoints(), 0);
        errors.heard->Clear();
    }
}

TEST(FitSkeleton, WarnsOfARigWhoseSkeletonSeemsWrong)
{
    vtkNew<vtkRigBody> rig;
    rig->SetInputData(body());
    rig->Update();
    const auto warning_about = [](vtkPolyData* rigged) {
        vtkNew<vtkFitSkeleton> fit;
        Errors warnings(*fit);
        fit->SetInputData(0, rigged);
        fit->SetInputData(1, shorts());
        fit->SetTypeByName("shorts");
        fit->Update();
        EXPECT_FALSE(warnings.heard->GetError()) << warnings.heard->GetErrorMessage();
        return warnings.heard->GetWarningMessage();
    };
    vtkNew<vtkPolyData> rigged;
    rigged->DeepCopy(polydata(*rig, 0));
    EXPECT_EQ(warning_about(rigged).find("may be wrong"), std::string::npos);
    vtkFieldData& field = *rigged->GetFieldData();
    field.RemoveArray("RigRadii");  // of another skeleton
    auto unknown = some_numbers("RigRadii", bone_count, 1);
    unknown->Fill(0);
    field.AddArray(unknown);
    vtkDataArray& joints = *field.GetArray("RigJoints");
    for (int axis = 0; axis < 3; ++axis)  // a pelvis in the neck
        joints.SetComponent(0, axis, joints.GetComponent(1 + thorax, axis));
    EXPECT_NE(warning_about(rigged).find("the skeleton of the body may be wrong: the pelvis"), std::string::npos)
        << warning_about(rigged);
}

TEST(DressBody, NamesAMissingInput)
{
    vtkNew<vtkDressBody> dress;
    Errors errors(*dress);
    dress->SetInputData(0, body());
    dress->Update();
    EXPECT_TRUE(errors.heard->GetError());
}

TEST(FitSkeleton, KeepsNoOlderOutputsWhenAnInputIsMissingOrOfAnotherKind)
{
    Chain chain(body(), shorts());
    vtkNew<vtkImageData> image;
    const std::pair<vtkDataObject*, const char*> bad[] = { { nullptr, "0 connections" }, { image, "vtkImageData" } };
    for (const auto& [garments, part] : bad) {
        chain.fit->SetInputDataObject(1, shorts());
        chain.fit->Update();
        EXPECT_EQ(chain.fit->GetErrorCode(), vtkErrorCode::NoError);
        EXPECT_GT(polydata(*chain.fit, 0)->GetNumberOfPoints(), 0);
        Errors errors(*chain.fit);
        chain.fit->SetInputDataObject(1, garments);
        chain.fit->Update();
        EXPECT_NE(errors.heard->GetErrorMessage().find(part), std::string::npos) << errors.heard->GetErrorMessage();
        EXPECT_EQ(chain.fit->GetErrorCode(), vtkFitFilter::InvalidInput);
        for (int port : { 0, 1, 2 })
            EXPECT_EQ(polydata(*chain.fit, port)->GetNumberOfPoints(), 0);
    }
}

TEST(DressBody, RefusesAnUnknownUnitAndWorksAfterwards)
{
    vtkNew<vtkDressBody> dress;
    Errors errors(*dress);
    dress->SetInputData(0, body());
    dress->SetInputData(1, shorts());
    dress->SetUnit("cubit");
    dress->Update();
    EXPECT_NE(errors.heard->GetErrorMessage().find("cubit"), std::string::npos);
    errors.heard->Clear();
    dress->SetUnit("auto");
    shorten(*dress);
    dress->Update();
    EXPECT_FALSE(errors.heard->GetError()) << errors.heard->GetErrorMessage();
    EXPECT_EQ(number(polydata(*dress, 0), "Certified"), 1);
}

TEST(DressBody, StopsWhenAbortedAndRunsWhenModified)
{
    vtkNew<vtkDressBody> dress;
    Errors errors(*dress);
    vtkNew<vtkCallbackCommand> abort;
    abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*) {
        auto* sender = static_cast<vtkAlgorithm*>(caller);
        if (sender->GetProgress() > 0.55)
            sender->SetAbortExecute(1);
    });
    const unsigned long tag = dress->AddObserver(vtkCommand::ProgressEvent, abort);
    dress->SetInputData(0, body());
    dress->SetInputData(1, shorts());
    shorten(*dress);
    dress->Update();
    EXPECT_EQ(polydata(*dress, 1)->GetNumberOfPoints(), 0);
    dress->RemoveObserver(tag);
    dress->SetAbortExecute(0);
    dress->Modified();
    Stages stages(*dress);
    dress->Update();
    EXPECT_FALSE(errors.heard->GetError()) << errors.heard->GetErrorMessage();
    EXPECT_EQ(number(polydata(*dress, 0), "Certified"), 1);
    EXPECT_EQ(stages.seen.count("rigging the body"), 0u);  // kept from before
}

TEST(Chain, IsEmptyWithoutErrorsWhenItsFirstFilterIsAborted)
{
    Chain chain(body(), shorts());
    Errors errors(*chain.fit), later_errors(*chain.drape);
    vtkNew<vtkCallbackCommand> abort;
    abort->SetCallback(
        [](vtkObject* caller, unsigned long, void*, void*) { static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1); });
    const unsigned long tag = chain.rig->AddObserver(vtkCommand::ProgressEvent, abort);
    chain.drape->Update();
    EXPECT_FALSE(errors.heard->GetError()) << errors.heard->GetErrorMessage();
    EXPECT_FALSE(later_errors.heard->GetError()) << later_errors.heard->GetErrorMessage();
    EXPECT_EQ(polydata(*chain.drape, 1)->GetNumberOfPoints(), 0);
    chain.rig->RemoveObserver(tag);
    chain.rig->SetAbortExecute(0);
    chain.rig->Modified();
    chain.fit->Update();
    EXPECT_GT(polydata(*chain.fit, 1)->GetNumberOfPoints(), 0);
}

TEST(DressBody, ClampsNumbersAndRefusesTextThatIsNoValue)
{
    vtkNew<vtkDressBody> dress;
    Errors errors(*dress);
    dress->SetContactDistance(7);
    EXPECT_EQ(dress->GetContactDistance(), dress->GetContactDistanceMaxValue());
    dress->SetProxyVertices(-3);
    EXPECT_EQ(dress->GetProxyVertices(), dress->GetProxyVerticesMinValue());
    dress->SetTypeByName("coat");
    EXPECT_EQ(dress->GetType(), int(GarmentType::coat));
    dress->SetType(1000);
    EXPECT_EQ(dress->GetTypeAsString(), std::string(garment_type_names().back()));
    EXPECT_FALSE(errors.heard->GetError());
    dress->SetTypeByName("umbrella");
    EXPECT_NE(errors.heard->GetErrorMessage().find("umbrella"), std::string::npos);
    errors.heard->Clear();
    dress->SetParameter("colour", "red");
    EXPECT_NE(errors.heard->GetErrorMessage().find("colour"), std::string::npos);
}

TEST(DressBody, TakesFiguresOfTheClothFromItsFabricUnlessGiven)
{
    vtkNew<vtkDressBody> dress;
    EXPECT_TRUE(std::isnan(dress->GetDensity()));
    EXPECT_EQ(dress->GetParameter("density"), "of the fabric");
    dress->SetDensity(0.3);
    EXPECT_EQ(dress->GetDensity(), 0.3);
    const vtkMTimeType time = dress->GetMTime();
    dress->SetDensity(NAN);
    EXPECT_TRUE(std::isnan(dress->GetDensity()));
    EXPECT_GT(dress->GetMTime(), time);
}

TEST(EveryFilter, PrintsAllItsParameters)
{
    vtkNew<vtkDressBody> dress;
    dress->SetUp("+z");
    std::ostringstream text;
    dress->Print(text);
    for (const char* part : { "Contact distance: 0.0025 m", "Garment type: auto", "Up: +z", "GarmentUnit: auto" })
        EXPECT_NE(text.str().find(part), std::string::npos) << text.str();
}

}  // namespace
