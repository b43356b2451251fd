// SPDX-License-Identifier: GPL-3.0-or-later
#include "results.h"

#include "garmentfit/filters/outcome.h"
#include "garmentfit/filters/rig_arrays.h"
#include "layers.h"

namespace garmentfit::meshlab {
namespace {

// Ends of the colour ramps, a matter of taste. The tooltip of Shown map states them.
constexpr double k_shown_ease = 0.1;  // m
constexpr double k_shown_strain = 0.1;
constexpr double k_shown_pressure = 1000;  // Pa

/// Adds layers to one document for one fitting, and attaches the fitting to each.
class NewLayers {
public:
    NewLayers(MeshDocument& document, const Choice& choice, Fitting fitting) :
        document_(document), choice_(choice), fitting_(std::make_shared<const Fitting>(std::move(fitting)))
    {
    }

    void add(Data data, bool visible)
    {
        visible_ = visible;
        switch (data) {
        case Data::rig: add_rig(); break;
        case Data::fits: add_fits(); break;
        case Data::draped:
            if (all_clean(scene().draped->garments))
                add_dressing(*scene().draped, ", draped");
            break;
        case Data::recovered:
            add_dressing(*scene().recovered, "");
            if (is_pressed(*scene().recovered))
                add_body(fitting_->body_name + " pressed", scene().recovered->body);
            add_frames(*scene().recovered);
            break;
        case Data::body:
        case Data::garments: break;  // no filter makes them
        }
    }

    void add_worn_copy(MeshModel& worn, const FitMap& map)
    {
        visible_ = true;
        add_map(kept(add_moved_copy(document_, worn, name_of(worn) + " ease", mesh_of(worn).positions)), map);
    }

private:
    const Scene& scene() const { return fitting_->scene; }

    MeshModel& kept(MeshModel& layer)
    {
        set_visible(document_, layer, visible_);
        attach(document_, layer, fitting_);
        return layer;
    }

    MeshModel& add_body(const std::string& name, const Positions& in_metres)
    {
        return kept(add_moved_copy(document_, *choice_.body, name, fitting_->body_frame.to_file(in_metres)));
    }

    void add_bones(const std::string& name, const Skeleton& skeleton)
    {
        kept(add_skeleton(document_, name, fitting_->body_frame.to_file(rows_of(skeleton))));
    }

    void add_rig()
    {
        const SkinWeights& skin = scene().rig->weights;
        MeshModel& body = add_body(fitting_->body_name + " rigged", scene().body->surface.positions);
        for (int slot = 0; slot < 4; ++slot) {
            add_attribute(body, "joint" + std::to_string(slot), skin.bones.col(slot).cast<double>());
            add_attribute(body, "weight" + std::to_string(slot), skin.weights.col(slot));
        }
        const auto shown = (skin.bones.array() == int(choice_.shown_bone)).cast<double>() * skin.weights.array();
        show_quality(body, shown.rowwise().sum().matrix(), 1, 0);
        add_bones(fitting_->body_name + " skeleton", scene().rig->skeleton);
    }

    void add_fits()
    {
        const Rig& rig = *scene().rig;
        for (std::size_t i = 0; i < scene().fits.size(); ++i) {
            const Pose& pose = scene().fits[i].pose;
            const std::string in_pose = " in the pose of " + fitting_->garment_names[i];
            add_body(fitting_->body_name + in_pose,
                     skin(scene().body->surface.positions, rig.weights, bone_transforms(rig.skeleton, pose)));
            add_bones(fitting_->body_name + " skeleton" + in_pose, pose_skeleton(rig.skeleton, pose));
        }
    }

    void add_map(MeshModel& layer, const FitMap& map)
    {
        const double metres = fitting_->body_frame.metres_per_unit;
        const Eigen::VectorXd ease = map.ease / metres;
        add_attribute(layer, "ease", ease);
        add_attribute(layer, "strain", map.strain);
        add_attribute(layer, "pressure", map.pressure);
        switch (choice_.shown_map) {
        case ShownMap::ease: show_quality(layer, ease, 0, k_shown_ease / metres); break;
        case ShownMap::strain: show_quality(layer, map.strain, k_shown_strain, 0); break;
        case ShownMap::pressure: show_quality(layer, map.pressure, k_shown_pressure, 0); break;
        case ShownMap::none: break;
        }
    }

    MeshModel& add_garment(std::size_t i, const std::string& suffix, const Positions& in_metres)
    {
        return kept(add_moved_copy(document_, *choice_.garments[i],
                                   fitting_->garment_names[i] + " on " + fitting_->body_name + suffix,
                                   fitting_->body_frame.to_file(in_metres)));
    }

    void add_dressing(const Dressing& dressing, const std::string& suffix)
    {
        for (const std::size_t i : dressing.worn())
            add_map(add_garment(i, suffix, dressing.garments[i].positions), dressing.maps[i]);
    }

    /// Hidden layers of the frames on the pose path.
    void add_frames(const Dressing& dressing)
    {
        visible_ = false;
        for (const RecoverFrame& frame : dressing.frames) {
            const std::string suffix = ", " + std::to_string(percent(frame.share)) + "% of the pose path";
            add_body(fitting_->body_name + suffix, frame.body);
            for (const std::size_t i : dressing.worn())
                add_garment(i, suffix, frame.garments[i]);
        }
    }

    MeshDocument& document_;
    const Choice& choice_;
    std::shared_ptr<const Fitting> fitting_;
    bool visible_ = true;
};

}  // namespace

void add_results(MeshDocument& document, const Choice& choice, Fitting fitting, const std::vector<Data>& outputs)
{
    NewLayers layers(document, choice, std::move(fitting));
    for (const Data data : outputs)
        layers.add(data, data == outputs.back());
}

void add_measured(MeshDocument& document, const Choice& choice, Fitting fitting, const FitMap& map)
{
    NewLayers(document, choice, std::move(fitting)).add_worn_copy(*choice.worn, map);
}

}  // namespace garmentfit::meshlab
