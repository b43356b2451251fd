// SPDX-License-Identifier: GPL-3.0-or-later
// The input is a first byte, which chooses a small body, a garment round it and what is searched, and a list of edits:
// whatever they make of both, rigging and fitting end in a result or in one line. One execution takes two tenths of a
// second, where figures or other ways of wearing are searched some seconds.
#include <cmath>
#include <cstring>
#include <limits>

#include "fixtures.h"
#include "fuzz_target.h"
#include "garmentfit/error.h"
#include "garmentfit/filters/filters.h"

namespace {

using namespace garmentfit;

constexpr double k_seconds = 10;  // for both; what takes longer ends at its time limit
constexpr int k_proxy_vertices = 1000;  // the fewest that may be given
constexpr std::uint8_t k_ways = 224, k_figures = 240;  // first bytes from which these are searched, too
constexpr std::size_t k_edit_bytes = 8, k_most_edits = 64;

struct Edit {
    std::uint8_t kind = 0, axis = 0;
    std::uint16_t row = 0;
    float value = 0;
};

Edit edit_from(const std::uint8_t* data)
{
    Edit edit { data[0], std::uint8_t(data[1] % 3), 0, 0 };
    std::memcpy(&edit.row, data + 2, sizeof edit.row);
    std::memcpy(&edit.value, data + 4, sizeof edit.value);
    return edit;
}

void cut_off(TriangleMesh& mesh, int axis, double from)
{
    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        if (!(mesh.positions(mesh.triangles(f, 0), axis) > from))
            mesh.triangles.row(kept++) = mesh.triangles.row(f).eval();
    mesh.triangles.conservativeResize(kept, Eigen::NoChange);
}

void twice(TriangleMesh& mesh, int axis, double aside)
{
    if (mesh.positions.rows() > 20000)
        return;
    TriangleMesh other = mesh;
    other.positions.col(axis).array() += aside;
    mesh = fixtures::joined(mesh, other);
}

/// Faces and vertices that edits name by number are taken round and round.
void apply(const Edit& edit, TriangleMesh& mesh)
{
    if (mesh.triangles.rows() == 0)
        return;
    const Eigen::Index v = edit.row % mesh.positions.rows(), f = edit.row % mesh.triangles.rows();
    switch (edit.kind % 10) {
    case 0: mesh.positions(v, edit.axis) = edit.value; break;
    case 1: mesh.positions(v, edit.axis) += 0.1 * edit.value; break;
    case 2: mesh.triangles.row(f).reverseInPlace(); break;
    case 3: mesh.triangles.row(f) = mesh.triangles.row(mesh.triangles.rows() - 1).eval(); break;
    case 4: mesh.triangles(f, edit.axis) = int(v); break;
    case 5: mesh.positions.col(edit.axis) *= edit.value; break;
    case 6: mesh.positions.col(edit.axis).array() += edit.value; break;
    case 7: cut_off(mesh, edit.axis, edit.value); break;
    case 8: twice(mesh, edit.axis, edit.value); break;
    default: mesh.positions.row(v) = mesh.positions.row((v + edit.axis + 1) % mesh.positions.rows()).eval(); break;
    }
}

const TriangleMesh& body_of_kind(int kind)
{
    static const std::array<TriangleMesh, 4> bodies {
        fixtures::capsule_person({ 45, 15, 0, 0, 0, 1, 0.095 }).mesh,
        fixtures::capsule_person({ 0, 15, 0, 0, 0, 1, 0.07 }).mesh,
        fixtures::capsule_person({ 20, 45, 0, 0, 0, 1, 0.095 }).mesh,
        fixtures::capsule_person({ -60, 60, 30, 0, 0, 0.1, 0.085 }).mesh
    };  // spacings at which the first search succeeds
    return bodies[kind % bodies.size()];
}

const TriangleMesh& garment_of_kind(int kind)
{
    const auto between = [](double low, double high) {
        return [low, high](const Vec3& p) { return p.y() > low && p.y() < high && std::abs(p.x()) < 0.45; };
    };
    static const std::array<TriangleMesh, 2> garments {
        fixtures::garment_round(fixtures::person_skeleton({}), 0.03, between(0.85, 1.45), 0.1),
        fixtures::garment_round(fixtures::person_skeleton({}), 0.03, between(0.2, 1.02), 0.1)
    };
    return garments[kind % garments.size()];
}

void require_rig(const Rig& rig, Eigen::Index vertices)
{
    fuzz::require(rig.weights.weights.rows() == vertices, "that each vertex has weights");
    fuzz::require(((rig.weights.weights.rowwise().sum().array() - 1).abs() < 1e-6).all(), "that weights sum to 1");
    fuzz::require(rig.skeleton.root.allFinite(), "that the root is finite");
    for (const Vec3& tail : rig.skeleton.tails)
        fuzz::require(tail.allFinite(), "that joints are finite");
}

void rig_and_fit(const TriangleMesh& body, const TriangleMesh& garment, std::uint8_t searched)
{
    Scene scene;
    scene.body = make_body(body.positions, body.triangles);
    scene.garments = { { make_garment(garment.positions, garment.triangles) } };
    Parameters parameters;
    parameters.time_limit = k_seconds;
    parameters.rig.proxy_vertices = k_proxy_vertices;
    parameters.rig.humanlike = searched >= k_figures ? Humanlike::any : Humanlike::strict;
    parameters.fit.as_placed = searched < k_ways || searched >= k_figures;
    filter_of("rig").run(scene, parameters);
    require_rig(*scene.rig, body.positions.rows());
    filter_of("fit").run(scene, parameters);
    fuzz::require(scene.fits.size() == 1 && scene.fits[0].pose.root_translation.allFinite(), "that a pose is finite");
}

}  // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0)
        return 0;
    TriangleMesh body = body_of_kind(data[0]), garment = garment_of_kind(data[0] / 4);
    for (std::size_t i = 1, edits = 0; i + k_edit_bytes <= size && edits < k_most_edits; i += k_edit_bytes, ++edits) {
        const Edit edit = edit_from(data + i);
        apply(edit, edit.kind >= 200 ? garment : body);
    }
    try {
        rig_and_fit(body, garment, data[0]);
    } catch (const InvalidInput& error) {
        fuzz::require_one_line(error.what());
    } catch (const SolverFailure& error) {
        fuzz::require_one_line(error.what());
    } catch (const TimeLimitReached& error) {
        fuzz::require_one_line(error.what());
    }
    return 0;
}
