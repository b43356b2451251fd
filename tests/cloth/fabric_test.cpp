// SPDX-License-Identifier: GPL-3.0-or-later
#include "fabric_trials.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

// The presets against what laboratories measure (docs/fabrics.md).

namespace {

using namespace garmentfit;

/// How many times as stiff as its hinges' figure cloth bends.
/// derived: on rows of equilateral triangles all bending is at the hinges along the rows, a third of all, and the energy
/// is quadratic: 3. The free borders of a strip have no hinges.
constexpr double k_bending_of_hinges = 2.8;

struct Range {
    double low, high;
};

/// Columns `quantity`_low and `quantity`_high of docs/fabrics.csv.
std::map<std::string, Range> published(const std::string& quantity)
{
    std::ifstream file(GARMENTFIT_DOCS "/fabrics.csv");
    std::string line, cell;
    std::map<std::string, Range> result;
    while (std::getline(file, line)) {
        std::stringstream row(line);
        std::string fabric, what, low, high;
        std::getline(row, fabric, ',');
        std::getline(row, what, ',');
        std::getline(row, low, ',');
        std::getline(row, high, ',');
        if (what == quantity)
            result[fabric] = { std::stod(low), std::stod(high) };
    }
    return result;
}

double bending_length_of(const Material& material, double times)
{
    return std::cbrt(times * material.bend_stiffness / (material.density * trials::k_standard_gravity));
}

// literature: [peirce_1930_handle], c^3 = bending stiffness over weight by area, and c = l / 2 at 41.5 degrees.
void expect_cantilever(Fabric fabric, double parts)
{
    const double length = bending_length_of(material_of(fabric), k_bending_of_hinges);
    const double stiffness = trials::cantilever_stiffness(trials::of(fabric), 2 * length, length / parts);
    EXPECT_NEAR(stiffness / (k_bending_of_hinges * material_of(fabric).bend_stiffness), 1, 0.1)  // 3 % of the length
        << fabric_names()[static_cast<int>(fabric)] << ", " << parts << " edges in a bending length";
}

TEST(FabricTrials, ACantileverHangsAsPeirceSays) { expect_cantilever(Fabric::cotton, 8); }

TEST(Slow, ACantileverHangsAsPeirceSaysWhateverTheFabricAndTheMesh)
{
    for (const Fabric fabric : { Fabric::cotton, Fabric::denim, Fabric::jersey })
        for (const double parts : { 8., 12. })
            expect_cantilever(fabric, parts);
}

TEST(FabricTrials, PresetsAreWithinThePublishedRangesOfTheirFabric)
{
    for (const auto& [quantity, value, times] : { std::tuple { "density", &Material::density, 1. },
                                                  { "bend_stiffness", &Material::bend_stiffness, k_bending_of_hinges },
                                                  { "largest_stretch", &Material::largest_stretch, 1. },
                                                  { "thickness", &Material::thickness, 1. },
                                                  { "weft_to_warp", &Material::weft_to_warp, 1. },
                                                  { "shear_stiffness", &Material::shear_stiffness, 1. } }) {
        const auto ranges = published(quantity);
        EXPECT_EQ(ranges.size(), fabric_names().size()) << quantity;
        for (const auto& [name, range] : ranges) {
            EXPECT_GE(times * material_of(fabric_of(name)).*value, range.low) << name << ", " << quantity;
            EXPECT_LE(times * material_of(fabric_of(name)).*value, range.high) << name << ", " << quantity;
        }
    }
}

// literature: [kirk_1966_extensibility] for what a wearer needs; the element is an isotropic sheet whatever the fabric.
TEST(FabricTrials, TensionAndShearAreThoseOfAnIsotropicSheet)
{
    for (const Fabric fabric : { Fabric::cotton, Fabric::jersey }) {
        const double k = material_of(fabric).stretch_stiffness;
        const trials::Moduli small = trials::moduli(trials::of(fabric), 0.01),
                             large = trials::moduli(trials::of(fabric), 0.1);
        EXPECT_NEAR(small.young / k, 1, 0.03);
        EXPECT_NEAR(large.young / k, 1, 0.1) << "springs turn into the direction of the pull";
        EXPECT_NEAR(small.poisson, 1. / 3, 0.02);
        EXPECT_NEAR(small.shear / k, 3. / 8, 0.01);
    }
}

// literature: [wang_2011_cloth] for the figures of the fabrics. The sheet is the same however it lies on the mesh; an even
// net of springs would be three times as stiff along one row as along another.
TEST(FabricTrials, WarpWeftAndShearAreThoseOfTheFabricHoweverTheMeshLies)
{
    GarmentMesh shaken = trials::strip(0.2, 0.2, 0.01);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> shift(-2e-3, 2e-3);
    for (Eigen::Index v = 0; v < shaken.positions.rows(); ++v)
        shaken.positions.row(v) += Eigen::RowVector3d(shift(random), 0, shift(random));
    for (const GarmentMesh& sheet : { trials::strip(0.2, 0.2, 0.01), shaken })
        for (const Fabric fabric : { Fabric::cotton, Fabric::denim, Fabric::jersey }) {
            const Material material = material_of(fabric);
            const double warp = 2 * material.stretch_stiffness / (1 + material.weft_to_warp),
                         weft = material.weft_to_warp * warp;
            const trials::Moduli along = trials::moduli(trials::of(fabric), 0.01, trials::cut_at(sheet, 0)),
                                 across = trials::moduli(trials::of(fabric), 0.01, trials::cut_at(sheet, M_PI / 2));
            EXPECT_NEAR(along.young / warp, 1, 0.03);
            EXPECT_NEAR(across.young / weft, 1, 0.03);
            EXPECT_NEAR(along.shear / material.shear_stiffness, 1, 0.01);
            EXPECT_NEAR(across.shear / material.shear_stiffness, 1, 0.01);
            EXPECT_NEAR(along.poisson * across.poisson, 1. / 9, 0.01);
        }
}

// derived: at 45 degrees to the warp, 1 / E = 1 / 4 warp + 1 / 4 weft + 1 / 4 shear - nu / 2 warp.
TEST(FabricTrials, AClothWithoutMuchShearStiffnessGivesOnTheBias)
{
    const Material cotton = material_of(Fabric::cotton);
    const double expected
        = 4 / (2 / cotton.stretch_stiffness + 1 / cotton.shear_stiffness - 2. / 3 / cotton.stretch_stiffness);
    const GarmentMesh sheet = trials::strip(0.2, 0.2, 0.01);
    const double bias = trials::moduli({}, 0.01, trials::cut_at(sheet, M_PI / 4)).young;
    EXPECT_NEAR(bias / expected, 1, 0.05);
    EXPECT_LT(bias, 0.6 * cotton.stretch_stiffness);
}

TEST(FabricTrials, AClothThatIsAlikeInAllDirectionsIsTheSheetOfOneWithoutWarp)
{
    ClothOptions alike;
    alike.weft_to_warp = 1;
    alike.shear_stiffness = 3. / 8 * material_of(alike).stretch_stiffness;
    const GarmentMesh sheet = trials::strip(0.2, 0.2, 0.01);
    for (const double strain : { 0.01, 0.1, 0.3 }) {
        const trials::Moduli without = trials::moduli(alike, strain, sheet),
                             with = trials::moduli(alike, strain, trials::cut_at(sheet, 0.4));
        EXPECT_NEAR(with.young / without.young, 1, 0.01);  // the triangles are not quite even
        EXPECT_NEAR(with.shear / without.shear, 1, 0.01);
    }
}

TEST(FabricTrials, AStifferClothDrapesLess)
{
    ClothOptions soft, stiff;
    soft.bend_stiffness = 2e-6;
    stiff.bend_stiffness = 4e-5;
    const trials::Draped a = trials::cusick(soft, 0.15, 0.09, 0.015), b = trials::cusick(stiff, 0.15, 0.09, 0.015);
    EXPECT_LT(a.coefficient, b.coefficient - 0.2);
    EXPECT_GT(a.lowest, b.lowest);
    EXPECT_GE(a.nodes, 3);
}

// literature: the ranges of docs/fabrics.csv, each with its source, by [iso_9073_9] with a disc of 30 cm.
TEST(Slow, FabricsHaveTheDrapeCoefficientsThatArePublished)
{
    const auto ranges = published("drape_30");
    EXPECT_EQ(ranges.size(), fabric_names().size());
    for (const auto& [name, range] : ranges) {
        const double coefficient = trials::cusick(trials::of(fabric_of(name)), 0.15, 0.09, 0.01).coefficient;
        EXPECT_GE(coefficient, range.low) << name;
        EXPECT_LE(coefficient, range.high) << name;
    }
}

}  // namespace
