// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

namespace garmentfit {
namespace {

struct Word {
    std::string_view word;
    JointKind kind;
    bool has_side;
};

constexpr std::array k_words {
    Word { "hips", JointKind::pelvis, false },      Word { "pelvis", JointKind::pelvis, false },
    Word { "root", JointKind::pelvis, false },      Word { "hip", JointKind::pelvis, false },
    Word { "spine", JointKind::spine, false },      Word { "chest", JointKind::spine, false },
    Word { "upperchest", JointKind::spine, false }, Word { "lowerback", JointKind::spine, false },
    Word { "upperback", JointKind::spine, false },  Word { "thorax", JointKind::spine, false },
    Word { "neck", JointKind::neck, false },        Word { "lowerneck", JointKind::neck, false },
    Word { "head", JointKind::head, false },        Word { "clavicle", JointKind::clavicle, true },
    Word { "collar", JointKind::clavicle, true },   Word { "shoulder", JointKind::shoulder, true },
    Word { "arm", JointKind::shoulder, true },      Word { "upperarm", JointKind::shoulder, true },
    Word { "uparm", JointKind::shoulder, true },    Word { "humerus", JointKind::shoulder, true },
    Word { "forearm", JointKind::elbow, true },     Word { "lowerarm", JointKind::elbow, true },
    Word { "elbow", JointKind::elbow, true },       Word { "radius", JointKind::elbow, true },
    Word { "hand", JointKind::wrist, true },        Word { "wrist", JointKind::wrist, true },
    Word { "upleg", JointKind::hip, true },         Word { "upperleg", JointKind::hip, true },
    Word { "thigh", JointKind::hip, true },         Word { "femur", JointKind::hip, true },
    Word { "hip", JointKind::hip, true },           Word { "leg", JointKind::knee, true },
    Word { "lowerleg", JointKind::knee, true },     Word { "calf", JointKind::knee, true },
    Word { "shin", JointKind::knee, true },         Word { "tibia", JointKind::knee, true },
    Word { "knee", JointKind::knee, true },         Word { "foot", JointKind::ankle, true },
    Word { "ankle", JointKind::ankle, true },
};

/// "mixamorig:LeftUpLeg" -> left, up, leg; "thigh_l" -> thigh, l; digits are dropped.
std::vector<std::string> tokens_of(const std::string& name)
{
    std::vector<std::string> tokens(1);
    for (std::size_t i = name.find(':') == std::string::npos ? 0 : name.find(':') + 1; i < name.size(); ++i) {
        const auto c = static_cast<unsigned char>(name[i]);
        if (std::isupper(c) && i > 0 && !std::isupper(static_cast<unsigned char>(name[i - 1])))
            tokens.emplace_back();
        if (std::isalpha(c))
            tokens.back() += char(std::tolower(c));
        else if (!std::isdigit(c))
            tokens.emplace_back();
    }
    return tokens;
}

std::optional<NamedJoint> look_up(const std::string& word, int side)
{
    for (const Word& w : k_words)
        if (w.word == word && w.has_side == (side != 0))
            return NamedJoint { w.kind, side };
    return {};
}

std::optional<NamedJoint> recognize(const std::string& name)
{
    int side = 0;
    std::string word;
    for (const std::string& token : tokens_of(name))
        if (token == "left" || token == "l")
            side = 1;
        else if (token == "right" || token == "r")
            side = 2;
        else if (token != "j" && token != "bip" && token != "c")  // prefixes of VRM names
            word += token;
    if (const auto joint = look_up(word, side))
        return joint;
    if (side == 0 && (word.starts_with("l") || word.starts_with("r")))  // "lfemur"
        return look_up(word.substr(1), word[0] == 'l' ? 1 : 2);
    return {};
}

}  // namespace

std::vector<std::optional<NamedJoint>> recognize_joints(const std::vector<std::string>& names)
{
    std::vector<std::optional<NamedJoint>> joints;
    const auto is_shoulder = [](const std::optional<NamedJoint>& j) { return j && j->kind == JointKind::shoulder; };
    for (const std::string& name : names)
        joints.push_back(recognize(name));
    if (std::count_if(joints.begin(), joints.end(), is_shoulder)
        > 2)  // derived: a rig has two shoulders, so some are clavicles
        for (std::size_t i = 0; i < names.size(); ++i)
            if (is_shoulder(joints[i]) && tokens_of(names[i]).back() == "shoulder")
                joints[i]->kind = JointKind::clavicle;
    return joints;
}

}  // namespace garmentfit
