// SPDX-License-Identifier: GPL-3.0-or-later
#include "fitting.h"

#include <algorithm>

namespace fit::meshlab {
namespace {

using Allocator = vcg::tri::Allocator<CMeshO>;

const char* const k_attribute = "garment fitting";  // of a mesh; MeshLab neither copies nor saves it

bool is_same(const TriangleMesh& kept, const TriangleMesh& given, const Frame& frame)
{
    return kept.positions.rows() == given.positions.rows() && kept.triangles.rows() == given.triangles.rows()
        && kept.triangles == given.triangles && kept.positions == frame.to_metres(given.positions);
}

SharedFitting fitting_of(const MeshModel& layer)
{
    auto& mesh = const_cast<CMeshO&>(layer.cm);  // vcglib of 2020.09 finds attributes of meshes that may change only
    auto attribute = Allocator::FindPerMeshAttribute<SharedFitting>(mesh, k_attribute);
    return Allocator::IsValidHandle(mesh, attribute) ? attribute() : nullptr;
}

}  // namespace

bool Fitting::is_of_body(const TriangleMesh& body) const { return is_same(scene.body->surface, body, body_frame); }

bool Fitting::is_of_garments(const std::vector<TriangleMesh>& garments) const
{
    if (garments.size() != scene.garments.size())
        return false;
    for (std::size_t i = 0; i < garments.size(); ++i) {
        const GarmentMesh& kept = scene.garments[i].mesh;
        if (!is_same({ kept.positions, kept.triangles }, garments[i], garment_frames[i]))
            return false;
    }
    return true;
}

void hand_on(MeshModel& layer, const SharedFitting& fitting)
{
    Allocator::GetPerMeshAttribute<SharedFitting>(layer.cm, k_attribute)() = fitting;
}

bool is_result(const MeshModel& layer) { return fitting_of(layer) != nullptr; }

SharedFitting find_fitting(const MeshDocument& document, const std::function<bool(const Fitting&)>& will_do)
{
    const std::vector<const MeshModel*> layers = layers_of(document);
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer)
        if (const SharedFitting fitting = fitting_of(**layer); fitting && will_do(*fitting))
            return fitting;
    return nullptr;
}

std::filesystem::path rig_file_beside(const MeshModel& body)
{
    const std::filesystem::path file = body.fullName().toStdString();
    return file.empty() ? file : std::filesystem::path(file).replace_extension(".rig.json");
}

Fitting fitting_from_file(const std::filesystem::path& path, const std::string& body_name, const TriangleMesh& body)
{
    RigFile contents = read_whole_rig(path);
    const auto rigged = contents.rig.weights.weights.rows();
    if (rigged != body.positions.rows())
        throw InvalidInput(path.string() + " belongs to a body of " + std::to_string(rigged) + " vertices, " + body_name
                           + " has " + std::to_string(body.positions.rows()) + "; choose the layer that was rigged");
    Fitting fitting;
    fitting.body_name = body_name;
    fitting.body_frame = contents.frame;
    fitting.scene.body = make_body(contents.frame.to_metres(body.positions), body.triangles);
    fitting.scene.rig = std::move(contents.rig);
    fitting.scene.rig->radii
        = bone_radii(fitting.scene.rig->skeleton, fitting.scene.rig->weights, fitting.scene.body->surface.positions);
    for (const FittedGarment& garment : contents.garments) {
        fitting.garment_names.push_back(garment.file);
        fitting.garment_frames.push_back(garment.frame);
        fitting.scene.fits.push_back(garment.fit);
    }
    return fitting;
}

RigFile rig_file_of(const Fitting& fitting)
{
    RigFile contents { fitting.body_frame, *fitting.scene.rig, {} };
    for (std::size_t i = 0; i < fitting.scene.fits.size(); ++i)
        contents.garments.push_back({ fitting.garment_names[i], fitting.garment_frames[i], fitting.scene.fits[i] });
    return contents;
}

}  // namespace fit::meshlab
