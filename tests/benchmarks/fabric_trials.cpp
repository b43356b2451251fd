// SPDX-License-Identifier: GPL-3.0-or-later
// What the solver makes of each fabric in the tests of a laboratory, as one line of CSV for each; for docs/fabrics.md,
// which scripts/draw-fabrics makes.
//
//   fabric_trials [FOLDER]    FOLDER also gets the draped disc of 30 cm of each fabric, as OBJ

#include "fabric_trials.h"

#include <filesystem>
#include <fstream>
#include <iostream>

int main(int argc, char** argv)
{
    using namespace garmentfit;
    std::cout
        << "fabric,bend_stiffness,cantilever,drape_24,drape_30,drape_36,nodes_30,young_1,young_10,shear,poisson\n";
    for (std::size_t f = 0; f < fabric_names().size(); ++f) {
        const ClothOptions options = trials::of(Fabric(f));
        const Material material = material_of(options);
        const double length  // of the strip: about twice the bending length
            = 2.7 * std::cbrt(material.bend_stiffness / (material.density * trials::k_standard_gravity));
        const trials::Draped small = trials::cusick(options, 0.12), middle = trials::cusick(options, 0.15),
                             large = trials::cusick(options, 0.18);
        const trials::Moduli first = trials::moduli(options, 0.01), tenth = trials::moduli(options, 0.1);
        std::cout << fabric_names()[f] << ',' << material.bend_stiffness << ','
                  << trials::cantilever_stiffness(options, length, length / 20) << ',' << small.coefficient << ','
                  << middle.coefficient << ',' << large.coefficient << ',' << middle.nodes << ',' << first.young << ','
                  << tenth.young << ',' << first.shear << ',' << first.poisson << std::endl;
        if (argc < 2)
            continue;
        std::ofstream obj(std::filesystem::path(argv[1]) / (std::string(fabric_names()[f]) + ".obj"));
        for (Eigen::Index v = 0; v < middle.positions.rows(); ++v)
            obj << "v " << middle.positions.row(v) << '\n';
        for (Eigen::Index t = 0; t < middle.rest.triangles.rows(); ++t)
            obj << "f " << middle.rest.triangles.row(t).array() + 1 << '\n';
    }
}
