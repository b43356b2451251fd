// SPDX-License-Identifier: GPL-3.0-or-later

// Prints the evidence for each way of wearing garments on a body, one line of JSON for each garment:
// scripts/fit-evidence fits the weights of libfit/fit/evidence.h on them.
//   wear_evidence BODY GARMENT[@METRES_PER_UNIT]...

#include <algorithm>
#include <array>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "garmentfit/closed_ends.h"
#include "garmentfit/io.h"
#include "garmentfit/rig_body.h"
#include "garmentfit/units.h"
#include "hypotheses.h"
#include "outward_cloth.h"

namespace {

using namespace garmentfit;
using Json = nlohmann::ordered_json;

Json list(const Eigen::Vector3d& v) { return { v.x(), v.y(), v.z() }; }

// @param number  of its attempt: a way of holding the garment with one coverage
Json json_of(const Hypothesis& hypothesis, int number)
{
    const Attempt& attempt = *hypothesis.attempt;
    const Skeleton joints = place_bones(attempt.rig().skeleton, hypothesis.wearing.posture).joints;
    Json inside, evidence;
    for (int b = 0; b < bone_count; ++b)
        inside[std::string(bone_name(b))] = attempt.energy().metric().samples_inside(joints.head(b), joints.tail(b));
    for (int e = 0; e < evidence_count; ++e)
        evidence[std::string(evidence_names()[e])] = hypothesis.wearing.evidence[e];
    return { { "attempt", number },
             { "kind", k_coverage_kind_names[int(attempt.coverage().kind)] },
             { "type", name_of(attempt.coverage().type) },
             { "up", list(hypothesis.up()) },
             { "front", list(hypothesis.wearing.front) },
             { "in_place", hypothesis.wearing.is_in_place },
             { "rank", hypothesis.wearing.rank },
             { "possible", hypothesis.is_possible() },
             { "probability", hypothesis.probability },
             { "inside", inside },
             { "evidence", evidence } };
}

// How files are turned that a program with other axes wrote, that face elsewhere, and one askew.
const std::array<Eigen::Matrix3d, 8>& turns()
{
    const auto about = [](double degrees, const Vec3& axis) {
        return Eigen::AngleAxisd(degrees / k_degrees_per_radian, axis.normalized()).toRotationMatrix();
    };
    static const std::array<Eigen::Matrix3d, 8> all { Eigen::Matrix3d::Identity(), about(-90, Vec3::UnitX()),
                                                      about(180, Vec3::UnitY()),   about(90, Vec3::UnitX()),
                                                      about(100, Vec3::UnitY()),   about(180, Vec3::UnitX()),
                                                      about(-50, Vec3::UnitY()),   about(30, Vec3(1, 0.4, 1)) };
    return all;
}

Json evidence_of(const Rig& rig, const TriangleMesh& body, const GarmentMesh& garment, const Eigen::Matrix3d& turn)
{
    const GarmentMesh turned = make_garment(garment.positions * turn.transpose(), garment.triangles);
    const TriangleMesh outward = outward_cloth(open_ends(turned).garment);
    Json hypotheses = Json::array();
    std::vector<const Attempt*> attempts;
    const std::vector<Hypothesis> found = find_hypotheses(rig, body, outward, {}, {});
    for (const Hypothesis& hypothesis : found) {
        const auto attempt = std::find(attempts.begin(), attempts.end(), hypothesis.attempt.get());
        const int number = int(attempt - attempts.begin());
        if (attempt == attempts.end())
            attempts.push_back(hypothesis.attempt.get());
        hypotheses.push_back(json_of(hypothesis, number));
    }
    return { { "turn", { list(turn.row(0)), list(turn.row(1)), list(turn.row(2)) } }, { "hypotheses", hypotheses } };
}

// As it is for a slimmer person.
GarmentMesh narrowed(const GarmentMesh& garment, double factor)
{
    const Eigen::RowVector3d middle = garment.positions.colwise().mean();
    const Positions narrow
        = ((garment.positions.rowwise() - middle) * Vec3(factor, 1, factor).asDiagonal()).rowwise() + middle;
    return make_garment(narrow, garment.triangles);
}

// As it is, and every other garment turned in one way, too, every third narrowed, and every third widened.
void print(const Rig& rig, const TriangleMesh& body, const Frame& body_frame, const std::string& path, int number)
{
    const std::size_t at = path.rfind('@');  // a file without a unit
    const MeshFile file = MeshFile::read(path.substr(0, at));
    Frame frame = guess_garment_frame(file.positions(), file.triangles(), body_frame).frame;
    if (at != std::string::npos)
        frame.metres_per_unit = std::stod(path.substr(at + 1));
    const GarmentMesh garment = make_garment(frame.to_metres(file.positions()), file.triangles());
    std::vector<std::size_t> ways { 0 };
    if (number % 2 == 0)
        ways.push_back(std::size_t(1 + number / 2 % 7));
    for (const std::size_t way : ways) {
        Json line = evidence_of(rig, body, garment, turns()[way]);
        line["garment"] = path;
        line["width"] = 1;
        std::cout << line << std::endl;
    }
    if (number % 3 == 0)
        return;
    const double width = number % 3 == 1 ? 0.75 : 1.25;
    Json line = evidence_of(rig, body, narrowed(garment, width), turns()[0]);
    line["garment"] = path;
    line["width"] = width;
    std::cout << line << std::endl;
}

}  // namespace

int main(int argc, char** argv)
try {
    const MeshFile file = MeshFile::read(argv[1]);
    const Frame frame = guess_body_frame(file.positions(), file.triangles()).frame;
    const BodyMesh body = make_body(frame.to_metres(file.positions()), file.triangles());
    const Rig rig = rig_body(body);
    for (int i = 2; i < argc; ++i)
        try {
            print(rig, body.surface, frame, argv[i], i);
        } catch (const std::exception& error) {
            std::cerr << argv[i] << ": " << error.what() << std::endl;
        }
} catch (const std::exception& error) {
    std::cerr << "wear_evidence: " << error.what() << std::endl;
    return 1;
}
