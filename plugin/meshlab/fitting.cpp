// SPDX-License-Identifier: GPL-3.0-or-later
#include "fitting.h"

#include <map>
#include <mutex>

#include "garmentfit/filters/given_rig.h"

namespace garmentfit::meshlab {
namespace {

bool is_same(const TriangleMesh& kept, const TriangleMesh& given, const Frame& frame)
{
    return kept.positions.rows() == given.positions.rows() && kept.triangles.rows() == given.triangles.rows()
        && kept.triangles == given.triangles && kept.positions == frame.to_metres(given.positions);
}

/// The fitting of each layer. It is no attribute of the mesh, because MeshLab 2020.09 never frees those.
class Registry {
public:
    void add(MeshDocument& document, int layer, const SharedFitting& fitting)
    {
        const std::lock_guard lock(mutex_);
        if (fittings_.count(&document) == 0)
            forget_with(document);
        fittings_[&document][layer] = fitting;
    }

    SharedFitting of(const MeshDocument& document, int layer)
    {
        const std::lock_guard lock(mutex_);
        const auto of_document = fittings_.find(&document);
        if (of_document == fittings_.end())
            return nullptr;
        const auto found = of_document->second.find(layer);
        return found == of_document->second.end() ? nullptr : found->second;
    }

private:
    void forget_with(MeshDocument& document)
    {
        const QObject* const key = &document;
        QObject::connect(
            &document, &MeshDocument::meshRemoved, &context_,
            [this, key](int layer) {
                const std::lock_guard lock(mutex_);
                fittings_[key].erase(layer);
            },
            Qt::DirectConnection);
        QObject::connect(
            &document, &QObject::destroyed, &context_,
            [this, key] {
                const std::lock_guard lock(mutex_);
                fittings_.erase(key);
            },
            Qt::DirectConnection);
    }

    std::mutex mutex_;  // PyMeshLab may run filters in several threads
    std::map<const QObject*, std::map<int, SharedFitting>> fittings_;  // by document, then by layer
    QObject context_;  // ends the connections when the plugin is unloaded
};

Registry& registry()
{
    static Registry fittings;
    return fittings;
}

std::filesystem::path beside(const MeshModel& layer, const char* ending)
{
    const std::filesystem::path file = layer.fullName().toStdString();
    return file.empty() ? file : std::filesystem::path(file).replace_extension(ending);
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

void attach(MeshDocument& document, const MeshModel& layer, const SharedFitting& fitting)
{
    registry().add(document, layer.id(), fitting);
}

bool is_result(const MeshDocument& document, const MeshModel& layer)
{
    return registry().of(document, layer.id()) != nullptr;
}

SharedFitting find_fitting(const MeshDocument& document, const std::function<bool(const Fitting&)>& is_suitable)
{
    const std::vector<const MeshModel*> layers = layers_of(document);
    for (auto layer = layers.rbegin(); layer != layers.rend(); ++layer)
        if (const SharedFitting fitting = registry().of(document, (*layer)->id()); fitting && is_suitable(*fitting))
            return fitting;
    return nullptr;
}

std::filesystem::path rig_file_beside(const MeshModel& body) { return beside(body, ".rig.json"); }

std::filesystem::path outfit_beside(const MeshModel& body) { return beside(body, ".outfit.glb"); }

Fitting fitting_from_file(const std::filesystem::path& path, const std::string& body_name, const TriangleMesh& body)
{
    RigFile contents = read_whole_rig(path);
    Fitting fitting;
    fitting.body_name = body_name;
    fitting.body_frame = contents.frame;
    put_body(fitting.scene, contents.frame, body.positions, body.triangles);
    fitting.scene.rig = rig_on(std::move(contents.rig), fitting.scene.body->surface.positions, path.string());
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

}  // namespace garmentfit::meshlab
