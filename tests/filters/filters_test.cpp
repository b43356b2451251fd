// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/filters/filters.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "fixtures.h"
#include "garmentfit/error.h"
#include "garmentfit/filters/outcome.h"
#include "garmentfit/refined_body.h"
#include "garmentfit/rig_body.h"

namespace {

using namespace garmentfit;

struct CountNames {
    std::multiset<std::string> names;
    template <class Value>
    void operator()(const Value&, const About& about)
    {
        names.insert(std::string(about.name));
    }
};

template <class Options>
std::size_t count_of(const Options& options)
{
    CountNames count;
    describe(options, count);
    return count.names.size();
}

// A new field makes the binding fail to compile: add it to schema.h, then here.
TEST(Schema, DescribesEveryFieldOfEveryOptionsStruct)
{
    // front and joints are places in the body's own axes: a host reads them where it reads the body
    [[maybe_unused]] const auto [proxy_vertices, swap_sides, humanlike, front, joints] = RigOptions();
    EXPECT_EQ(count_of(RigOptions()), 3u);
    // the front is an axis of the garment's file; how many ways of wearing are skipped is for Dress Body to say
    [[maybe_unused]] const auto [type, method, iterations, nearest, garment_front, as_placed, skipped] = FitOptions();
    EXPECT_EQ(count_of(FitOptions()), 5u);
    [[maybe_unused]] const auto [height] = BodySizes();
    EXPECT_EQ(count_of(BodySizes()), 1u);
    [[maybe_unused]] const auto [garment_scale] = GarmentSizes();
    EXPECT_EQ(count_of(GarmentSizes()), 1u);
    [[maybe_unused]] const auto [fabric, contact, gap, density, stretch, bend, friction, largest, weft, shear,
                                 enlargement]
        = ClothOptions();
    EXPECT_EQ(count_of(ClothOptions()), 11u);
    // the size from the start is for Dress Body to say
    [[maybe_unused]] const auto [drape_cloth, growing, settling, size] = DrapeOptions();
    EXPECT_EQ(count_of(DrapeOptions()), 11u + 2u);
    // whether cloth only rests is for Dress Body to say
    [[maybe_unused]] const auto [recover_cloth, steps, length, recover_settling, quality, settle_time, press, frames,
                                 rests]
        = RecoverOptions();
    EXPECT_EQ(count_of(RecoverOptions()), 10u + 7u);  // all of the cloth but how much larger it may be made
}

TEST(Schema, NamesAreUniqueAndEveryParameterIsExplained)
{
    for (const Filter& filter : filters()) {
        CountNames count;
        const Parameters parameters;
        describe(filter, parameters, count);
        for (const std::string& name : count.names)
            EXPECT_EQ(count.names.count(name), 1u) << name << " in " << filter.name;
        describe(filter, parameters, [](const auto&, const About& about) {
            EXPECT_FALSE(about.label.empty()) << about.name;
            EXPECT_FALSE(about.help.empty()) << about.name;
        });
    }
}

TEST(Schema, PublishedMethodsAreForResearch)
{
    std::set<std::string> research;
    const Parameters parameters;
    describe(filter_of("dress"), parameters, [&](const auto&, const About& about) {
        if (about.group == Group::research)
            research.insert(std::string(about.name));
    });
    EXPECT_EQ(research, (std::set<std::string> { "iterations", "method", "nearest" }));
}

TEST(Schema, EmptyValuesSayWhatHoldsInstead)
{
    const Parameters parameters;
    describe(filter_of("dress"), parameters, [](const auto& value, const About& about) {
        EXPECT_EQ(about.otherwise.empty(), !is_optional<decltype(value)>) << about.name;
        if (is_optional<decltype(value)>) {
            EXPECT_EQ(text_of(value, about), about.otherwise) << about.name;
        }
    });
}

TEST(Schema, DefaultsLieInTheirRanges)
{
    const Parameters defaults;
    for (const Filter& filter : filters())
        EXPECT_NO_THROW(describe(filter, defaults, CheckRanges()));
}

TEST(Schema, AFilterShowsNoParameterThatItDoesNotHeed)
{
    const auto shows = [](const char* filter, const char* name) {
        CountNames count;
        const Parameters parameters;
        describe(filter_of(filter), parameters, count);
        return count.names.count(name) == 1;
    };
    EXPECT_TRUE(shows("dress", "enlarge") && shows("drape", "enlarge"));
    EXPECT_FALSE(shows("recover", "enlarge"));
    EXPECT_TRUE(shows("dress", "frames") && shows("recover", "frames"));
    EXPECT_FALSE(shows("drape", "frames"));
}

TEST(Schema, DressingShowsTheParametersOfAllFourSteps)
{
    CountNames four, dress;
    const Parameters parameters;
    for (const Filter& filter : filters())
        describe(filter, parameters, filter.name == "dress" ? dress : four);
    for (const std::string& name : four.names)
        EXPECT_EQ(dress.names.count(name), 1u) << name;
}

TEST(SetByName, SetsOneParameterFromText)
{
    Parameters parameters;
    SetByName set { "contact_distance", "0.004" };
    describe(filter_of("drape"), parameters, set);
    EXPECT_TRUE(set.found);
    EXPECT_EQ(parameters.drape.cloth.contact_distance, 0.004);

    SetByName set_type { "type", "coat" };
    describe(filter_of("fit"), parameters, set_type);
    EXPECT_EQ(parameters.fit.type, GarmentType::coat);
}

TEST(SetByName, EmptiesWhatTheFabricDecides)
{
    Parameters parameters;
    const auto set = [&](const char* text) { describe(filter_of("drape"), parameters, SetByName { "density", text }); };
    EXPECT_FALSE(parameters.drape.cloth.density);
    set("0.2");
    EXPECT_EQ(parameters.drape.cloth.density, 0.2);
    set("of the fabric");
    EXPECT_FALSE(parameters.drape.cloth.density);
    EXPECT_THROW(set("7"), InvalidInput) << "out of range";
    EXPECT_THROW(set(""), InvalidInput);
}

TEST(SetByName, RefusesTextThatIsNoValue)
{
    Parameters parameters;
    for (const auto& [name, text] : { std::pair { "contact_distance", "thick" },
                                      { "contact_distance", "0.002m" },
                                      { "type", "umbrella" },
                                      { "swap_sides", "maybe" },
                                      { "iterations", "2.5" } })
        EXPECT_THROW(describe(filter_of("dress"), parameters, SetByName { name, text }), InvalidInput)
            << name << ' ' << text;
}

TEST(CheckRanges, NamesParameterValueAndRange)
{
    Parameters parameters;
    parameters.drape.cloth.density = -1;
    try {
        describe(filter_of("drape"), parameters, CheckRanges());
        FAIL() << "a negative density passed";
    } catch (const InvalidInput& error) {
        const std::string message = error.what();
        for (const char* part : { "density", "-1", "0.01..5 kg/m^2" })
            EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
    }
}

TEST(CheckRanges, RefusesNotANumber)
{
    Parameters parameters;
    parameters.drape.cloth.friction = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(describe(filter_of("drape"), parameters, CheckRanges()), InvalidInput);
}

TEST(Filter, SaysWhichInputIsMissing)
{
    Scene empty;
    for (const Filter& filter : filters())
        EXPECT_THROW(filter.run(empty, {}), InvalidInput) << filter.name;
    EXPECT_THROW(filter_of("iron"), InvalidInput);
}

TEST(Filter, ChecksRangesBeforeItWorks)
{
    Scene scene;
    scene.body.emplace();  // rigging it would fail with another message
    Parameters parameters;
    parameters.rig.proxy_vertices = 1;
    try {
        filter_of("rig").run(scene, parameters);
        FAIL() << "one proxy vertex passed";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.code(), ErrorCode::out_of_range);
        EXPECT_NE(std::string(error.what()).find("proxy_vertices"), std::string::npos) << error.what();
    }
}

/// A person and trousers, to be draped in the pose of the input.
Scene fitted_trousers()
{
    const fixtures::Person person = fixtures::capsule_person({ .arm_angle = 20 });
    Scene scene;
    scene.body = make_body(person.mesh.positions, person.mesh.triangles);
    scene.rig = rig_body(*scene.body);
    const TriangleMesh trousers = fixtures::garment_round(
        person.skeleton, 0.02, [](const Vec3& p) { return p.y() > 0.2 && p.y() < 1 && std::abs(p.x()) < 0.26; });
    scene.garments = { { make_garment(trousers.positions, trousers.triangles), GarmentType::trousers, "legs.obj" } };
    scene.fits.resize(1);
    return scene;
}

TEST(TimeLimit, OfWorkWithoutAResultIsAnErrorThatNamesStageAndOption)
{
    Parameters parameters;
    parameters.time_limit = 1e-9;
    for (const char* name : { "rig", "fit" }) {
        Scene scene = fitted_trousers();
        try {
            filter_of(name).run(scene, parameters);
            FAIL() << name << " knows no limit";
        } catch (const TimeLimitReached& error) {
            const std::string message = error.what();
            EXPECT_NE(message.find("time_limit"), std::string::npos) << message;
            EXPECT_NE(message.find(name == std::string("rig") ? "rigging" : "fitting"), std::string::npos) << message;
            EXPECT_EQ(message.find("user"), std::string::npos) << message;
        }
    }
}

TEST(TimeLimit, LeavesACleanStateAndSaysSo)
{
    Scene scene = fitted_trousers();
    Parameters parameters;
    parameters.time_limit = 1e-9;
    filter_of("drape").run(scene, parameters);
    ASSERT_TRUE(scene.draped);
    EXPECT_EQ(scene.draped->out_of_time, Stage::drape);
    EXPECT_FALSE(scene.draped->certified);
    EXPECT_TRUE(all_clean(scene.draped->garments));
    EXPECT_EQ(outcome_of(*scene.draped), Outcome::not_certified) << "the garment is not too small";
    const std::string line = explain(*scene.draped, { "legs.obj" });
    EXPECT_NE(line.find("the time limit was reached while draping"), std::string::npos) << line;
}

TEST(TimeLimit, LeavesTheBodyInTheFittedPoseWhereNothingIsLeftForTheReturn)
{
    Scene scene = fitted_trousers();
    Parameters parameters;
    parameters.time_limit = 0;  // none
    parameters.drape.settling_steps = 2;
    filter_of("drape").run(scene, parameters);
    ASSERT_TRUE(scene.draped->certified);
    EXPECT_FALSE(scene.draped->out_of_time);
    filter_of("recover").run(scene, parameters, Progress().until(Deadline::in(1e-9)));
    ASSERT_TRUE(scene.recovered);
    EXPECT_EQ(scene.recovered->out_of_time, Stage::recover);
    EXPECT_FALSE(scene.recovered->certified);
    EXPECT_EQ(scene.recovered->pose_reached, 0);
    EXPECT_EQ(scene.recovered->garments[0].positions, scene.draped->garments[0].positions);
}

TEST(TimeLimit, OfAHostHoldsForAllItsFilters)
{
    Scene scene = fitted_trousers();
    EXPECT_THROW(filter_of("rig").run(scene, {}, Progress().until(Deadline::in(1e-9))), TimeLimitReached);
    EXPECT_FALSE(Deadline().has_passed());
    EXPECT_FALSE(Deadline::in(0).has_passed());
    EXPECT_TRUE(Progress().until(Deadline::in(1e-9)).until(Deadline::in(1000)).is_late()) << "the earlier one counts";
}

TEST(Filter, NamesTheGarmentThatIsOfAbsurdSizeBeforeItWorks)
{
    const fixtures::Person person = fixtures::capsule_person();
    Scene scene;
    scene.body = make_body(person.mesh.positions, person.mesh.triangles);
    scene.rig = fixtures::simple_rig(person);
    const TriangleMesh shirt
        = fixtures::garment_round(person.skeleton, 0.02, [](const Vec3& p) { return p.y() > 0.9 && p.y() < 1.4; });
    scene.garments = { { make_garment(shirt.positions, shirt.triangles), GarmentType::vest, "vest.obj" },
                       { make_garment(1000 * shirt.positions, shirt.triangles), GarmentType::vest, "huge.obj" } };
    scene.fits.resize(2);
    fixtures::expect_invalid([&] { filter_of("drape").run(scene, {}); }, "huge.obj: the garment would be");
    EXPECT_FALSE(scene.draped);
    scene.garments[1].name = "";
    fixtures::expect_invalid([&] { filter_of("fit").run(scene, {}); }, "garment 2: the garment would be");
    EXPECT_TRUE(scene.fits.empty());
}

// ---- the tables in the documentation --------------------------------------------------------------------------------

std::string read_text(const std::string& path)
{
    std::ifstream file(path);
    return { std::istreambuf_iterator<char>(file), {} };
}

/// Replaces what stands between "<!-- parameters: NAME -->" and "<!-- end -->".
std::string with_table(std::string page, std::string_view name, const std::string& table)
{
    const std::string opening = "<!-- parameters: " + std::string(name) + " -->\n", closing = "<!-- end -->";
    const auto found = page.find(opening);
    if (found == std::string::npos)
        return page + "\nmissing: " + opening;
    const auto from = found + opening.size(), to = page.find(closing, from);
    return page.replace(from, to - from, table);
}

/// With one vertex for all of a mesh's in each cell of a grid.
TriangleMesh coarsened(const TriangleMesh& mesh, double cell)
{
    std::map<std::array<int, 3>, int> numbers;
    std::vector<Vec3> sums;
    std::vector<int> counts, cells;
    for (const auto& p : mesh.positions.rowwise()) {
        const Eigen::RowVector3i at = (p / cell).array().floor().cast<int>();
        const auto [found, is_new] = numbers.try_emplace({ at[0], at[1], at[2] }, int(sums.size()));
        if (is_new) {
            sums.push_back(Vec3::Zero());
            counts.push_back(0);
        }
        sums[std::size_t(found->second)] += p.transpose();
        ++counts[std::size_t(found->second)];
        cells.push_back(found->second);
    }
    TriangleMesh result { Positions(Eigen::Index(sums.size()), 3), Triangles(mesh.triangles.rows(), 3) };
    for (std::size_t i = 0; i < sums.size(); ++i)
        result.positions.row(Eigen::Index(i)) = sums[i] / counts[i];
    Eigen::Index kept = 0;
    for (const auto& corners : mesh.triangles.rowwise()) {
        const Eigen::RowVector3i now(cells[std::size_t(corners[0])], cells[std::size_t(corners[1])],
                                     cells[std::size_t(corners[2])]);
        if (now[0] != now[1] && now[1] != now[2] && now[2] != now[0])
            result.triangles.row(kept++) = now;
    }
    result.triangles.conservativeResize(kept, 3);
    return result;
}

/// A person of coarse skin, and a shirt this far off the skin.
Scene scene_of_coarse_person(double edge, double ease)
{
    const TriangleMesh coarse = coarsened(fixtures::capsule_person({ .arm_angle = 60 }).mesh, edge);
    const TriangleMesh shirt
        = fixtures::garment_round(fixtures::person_skeleton({ .arm_angle = 20 }), ease,
                                  [](const Vec3& p) { return p.y() > 0.9 && p.y() < 1.47 && std::abs(p.x()) < 0.4; });
    Scene scene;
    scene.body = make_body(coarse.positions, coarse.triangles);
    scene.garments = { { make_garment(shirt.positions, shirt.triangles), GarmentType::tshirt, "shirt.obj" } };
    return scene;
}

TEST(Filters, DressABodyOfLargeTrianglesOnARefinedOne)
{
    Scene scene = scene_of_coarse_person(0.11, 0.03);
    ASSERT_TRUE(has_large_triangles(*scene.body));
    const Positions given = scene.body->surface.positions;
    Parameters parameters;
    parameters.recover.quality = Quality::draft;
    parameters.recover.frames = 3;
    filter_of("dress").run(scene, parameters);
    ASSERT_TRUE(scene.recovered);
    EXPECT_TRUE(scene.recovered->certified);
    EXPECT_EQ(scene.recovered->body, given);
    EXPECT_EQ(scene.body->surface.positions, given);
    EXPECT_EQ(scene.rig->weights.weights.rows(), given.rows());
    EXPECT_EQ(scene.draped->body.rows(), given.rows());
    ASSERT_FALSE(scene.recovered->frames.empty());
    EXPECT_EQ(scene.recovered->frames.back().body, given);
}

TEST(Filters, KeepTheVerdictOnABodyThatARefinedOneIsNoBetterThan)
{
    Scene scene = scene_of_coarse_person(0.07, -0.02);
    ASSERT_TRUE(has_triangles_to_refine(*scene.body) && !has_large_triangles(*scene.body));
    const Positions given = scene.body->surface.positions;
    filter_of("dress").run(scene, {});
    ASSERT_TRUE(final_dressing(scene));
    EXPECT_EQ(outcome_of(*final_dressing(scene)), Outcome::too_small);
    EXPECT_EQ(final_dressing(scene)->body.rows(), given.rows());
    EXPECT_EQ(scene.body->surface.positions, given);
}

TEST(Documentation, ParameterTablesAreCurrent)
{
    const std::string path = GARMENTFIT_DOCS "/command-line.md";
    const std::string page = read_text(path);
    std::string current = page;
    const Parameters parameters;
    for (const Filter& filter : filters()) {
        if (filter.name == "dress")
            continue;  // the four together
        std::ostringstream table;
        describe(filter, parameters, MarkdownTable(table));
        current = with_table(current, filter.name, table.str());
    }
    if (std::getenv("GARMENTFIT_WRITE_DOCS"))
        std::ofstream(path) << current;
    else
        EXPECT_EQ(page, current) << "run this test with GARMENTFIT_WRITE_DOCS=1 to write the tables anew";
}

TEST(Filters, OnAKnownRigADressingIsTheSameWithoutRigging)
{
    const Filter dress = filter_of("dress"), worn = dress.on_known_rig();
    EXPECT_EQ(worn.stages, std::vector<Stage>(dress.stages.begin() + 1, dress.stages.end()));
    EXPECT_TRUE(worn.reads(Data::rig));
    EXPECT_FALSE(worn.makes(Data::rig));
    Scene scene;
    scene.body = make_body(fixtures::capsule_person().mesh.positions, fixtures::capsule_person().mesh.triangles);
    scene.garments.resize(1);
    fixtures::expect_invalid([&] { worn.run(scene, {}); }, "the body has no rig");
}

}  // namespace
