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
                                                  { "thickness", &Material::thickness, 1. } }) {
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
