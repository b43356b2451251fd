// SPDX-License-Identifier: GPL-3.0-or-later

// Prints what speaks for each facing of a body in garments, one line of JSON for each garment: scripts/fit-facing fits
// the weights of libfit/fit/facing.h on them.
//   facing_evidence BODY GARMENT...

#include <exception>
#include <iostream>

#include <nlohmann/json.hpp>

#include "best_start.h"
#include "facing.h"
#include "garmentfit/io.h"
#include "garmentfit/rig_body.h"
#include "garmentfit/units.h"
#include "outward_cloth.h"

namespace {

using namespace garmentfit;
using Json = nlohmann::json;

Json evidence_of(const Rig& rig, const Frame& body_frame, const std::string& path)
{
    const MeshFile file = MeshFile::read(path);
    const Frame frame = guess_garment_frame(file.positions(), file.triangles(), body_frame).frame;
    const TriangleMesh outward = outward_cloth(make_garment(frame.to_metres(file.positions()), file.triangles()));
    const std::vector<Opening> openings = openings_of(outward);
    const ClearanceField cloth(outward);
    const JointLimits limits(rig);
    const TypeGuess guess = resolve_type(GarmentType::automatic, openings);
    const BoneMetric metric(cloth, limb_radii_of(rig, bones_covered_by(guess.type, openings)));
    const FitEnergy energy(rig, limits, metric, cues_of(openings));
    std::vector<Posture> postures;
    std::vector<double> energies;
    for (const HypothesisScore& score : find_starts(energy, facing_hypotheses(energy), {})) {
        postures.push_back(score.posture);
        energies.push_back(score.energy);
    }
    Json facings = Json::array();
    for (const FacingEvidence& one : facing_evidence(energy, postures, energies))
        facings.push_back({ { "front", { one.front.x(), one.front.y(), one.front.z() } },
                            { "energy", one.energy },
                            { "input_front", one.input_front },
                            { "openings", one.openings } });
    const Eigen::Vector3d up = frame.up;
    return { { "garment", path }, { "up", { up.x(), up.y(), up.z() } }, { "facings", facings } };
}

}  // namespace

int main(int argc, char** argv)
try {
    const MeshFile file = MeshFile::read(argv[1]);
    const Frame frame = guess_body_frame(file.positions(), file.triangles()).frame;
    const Rig rig = rig_body(make_body(frame.to_metres(file.positions()), file.triangles()));
    for (int i = 2; i < argc; ++i)
        try {
            std::cout << evidence_of(rig, frame, argv[i]) << std::endl;
        } catch (const std::exception& error) {
            std::cerr << argv[i] << ": " << error.what() << std::endl;
        }
} catch (const std::exception& error) {
    std::cerr << "facing_evidence: " << error.what() << std::endl;
    return 1;
}
