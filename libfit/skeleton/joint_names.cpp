// SPDX-License-Identifier: GPL-3.0-or-later
#include "joint_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "tuning.h"

namespace garmentfit {
namespace {

using namespace skeleton_tuning;

struct Word {
    std::string_view word;
    JointKind kind;
    bool has_side;
};

constexpr std::array k_words {
    Word { "hips", JointKind::pelvis, false },
    Word { "pelvis", JointKind::pelvis, false },
    Word { "root", JointKind::pelvis, false },
    Word { "hip", JointKind::pelvis, false },
    Word { "spine", JointKind::spine, false },
    Word { "chest", JointKind::spine, false },
    Word { "upperchest", JointKind::spine, false },
    Word { "lowerback", JointKind::spine, false },
    Word { "upperback", JointKind::spine, false },
    Word { "thorax", JointKind::spine, false },
    Word { "torso", JointKind::spine, false },
    Word { "neck", JointKind::neck, false },
    Word { "lowerneck", JointKind::neck, false },
    Word { "head", JointKind::head, false },
    Word { "clavicle", JointKind::clavicle, true },
    Word { "collar", JointKind::clavicle, true },
    Word { "shoulder", JointKind::shoulder, true },
    Word { "arm", JointKind::shoulder, true },
    Word { "upperarm", JointKind::shoulder, true },
    Word { "uparm", JointKind::shoulder, true },
    Word { "humerus", JointKind::shoulder, true },
    Word { "forearm", JointKind::elbow, true },
    Word { "lowerarm", JointKind::elbow, true },
    Word { "elbow", JointKind::elbow, true },
    Word { "radius", JointKind::elbow, true },
    Word { "hand", JointKind::wrist, true },
    Word { "wrist", JointKind::wrist, true },
    Word { "armupper", JointKind::shoulder, true },
    Word { "armlower", JointKind::elbow, true },
    Word { "upleg", JointKind::hip, true },
    Word { "legupper", JointKind::hip, true },
    Word { "leglower", JointKind::knee, true },
    Word { "legup", JointKind::hip, true },
    Word { "leglow", JointKind::knee, true },
    Word { "armup", JointKind::shoulder, true },
    Word { "armlow", JointKind::elbow, true },
    Word { "upperleg", JointKind::hip, true },
    Word { "thigh", JointKind::hip, true },
    Word { "femur", JointKind::hip, true },
    Word { "hip", JointKind::hip, true },
    Word { "leg", JointKind::knee, true },
    Word { "lowerleg", JointKind::knee, true },
    Word { "calf", JointKind::knee, true },
    Word { "shin", JointKind::knee, true },
    Word { "tibia", JointKind::knee, true },
    Word { "knee", JointKind::knee, true },
    Word { "foot", JointKind::ankle, true },
    Word { "ankle", JointKind::ankle, true },
    Word { "abdomen", JointKind::spine, false },
    Word { "abdomenlower", JointKind::spine, false },
    Word { "abdomenupper", JointKind::spine, false },
    Word { "chestlower", JointKind::spine, false },
    Word { "chestupper", JointKind::spine, false },
    Word { "neckupper", JointKind::neck, false },
    Word { "necklower", JointKind::neck, false },
    Word { "necktwist", JointKind::neck, false },
    Word { "shldr", JointKind::shoulder, true },
    Word { "shldrbend", JointKind::shoulder, true },
    Word { "forearmbend", JointKind::elbow, true },
    Word { "thighbend", JointKind::hip, true },
};

/// What programs put before or between the words: VRM, 3ds Max, Source, Mixamo without its colon, Rigify, Character
/// Creator, SMPL, Auto-Rig Pro.
constexpr std::array<std::string_view, 14> k_fillers { "j",  "c",    "bip", "biped", "valve", "mixamorig", "def",
                                                       "cc", "base", "m",   "f",     "avg",   "armature",  "x" };

/// The parts of a bone by Auto-Rig Pro: upper arms and thighs begin with "twist", forearms and shins with "stretch".
/// "offset" means nothing.
constexpr std::array<std::string_view, 3> k_parts { "stretch", "twist", "offset" };

/// "mixamorig:LeftUpLeg" -> left, up, leg; "thigh_l" -> thigh, l; "LCalf" -> l, calf; digits are dropped.
std::vector<std::string> tokens_of(const std::string& name)
{
    std::vector<std::string> tokens(1);
    for (std::size_t i = name.find(':') == std::string::npos ? 0 : name.find(':') + 1; i < name.size(); ++i) {
        const auto c = static_cast<unsigned char>(name[i]);
        const auto is_upper = [&](std::size_t k) { return std::isupper(static_cast<unsigned char>(name[k])) != 0; };
        const auto is_lower = [&](std::size_t k) { return std::islower(static_cast<unsigned char>(name[k])) != 0; };
        if (is_upper(i) && i > 0 && (!is_upper(i - 1) || (i + 1 < name.size() && is_lower(i + 1))))
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

/// What nearly all names of a rig hold, as a figure's name or "jnt", says nothing about a joint: "Character1_LeftArm",
/// "l_arm_jnt".
std::set<std::string> common_tokens(const std::vector<std::string>& names)
{
    std::map<std::string, std::size_t> counts;
    for (const std::string& name : names) {
        const std::vector<std::string> tokens = tokens_of(name);
        for (const std::string& token : std::set<std::string>(tokens.begin(), tokens.end()))
            ++counts[token];
    }
    std::set<std::string> common;
    for (const auto& [token, count] : counts)
        if (count >= k_fewest_common_names && double(count) >= k_common_share * double(names.size()))
            common.insert(token);
    return common;
}

template <std::size_t N>
bool is_among(const std::array<std::string_view, N>& words, const std::string& token)
{
    return std::find(words.begin(), words.end(), token) != words.end();
}

/// What may be meant besides what words say.
enum class Reading {
    plain,
    stand_in,  ///< a palm or fist is a hand, and a goal of inverse kinematics the joint that it pulls
    part,  ///< the part of a bone is the bone
};

/// @param common  what is left out
std::optional<NamedJoint> recognize(const std::string& name, const std::set<std::string>& common,
                                    Reading reading = Reading::plain)
{
    int side = 0;
    std::string word;
    for (const std::string& token : tokens_of(name))
        if (token == "left" || token == "l")
            side = 1;
        else if (token == "right" || token == "r")
            side = 2;
        else if (common.contains(token))
            continue;
        else if (reading == Reading::stand_in && (token == "palm" || token == "fist"))
            word += "hand";
        else if (!is_among(k_fillers, token) && !(reading == Reading::stand_in && token == "ik")
                 && !(reading == Reading::part && is_among(k_parts, token)))
            word += token;
    if (const auto joint = look_up(word, side))
        return joint;
    if (side == 0 && (word.starts_with("l") || word.starts_with("r")))  // "lfemur"
        return look_up(word.substr(1), word[0] == 'l' ? 1 : 2);
    return {};
}

bool has_token(const std::string& name, std::string_view token)
{
    const std::vector<std::string> tokens = tokens_of(name);
    return std::find(tokens.begin(), tokens.end(), token) != tokens.end();
}

/// Names that mean one thing alone and another thing beside others.
class JointNames {
public:
    explicit JointNames(const std::vector<std::string>& names) : names_(names), common_(common_tokens(names))
    {
        for (const std::string& name : names)
            joints_.push_back(recognize(name, common_));
    }

    std::vector<std::optional<NamedJoint>> read()
    {
        if (count_token("stretch") > 0)
            name_parts();
        // derived: a rig has two shoulders, so some are clavicles, unless these have names of their own
        if (count(JointKind::shoulder) > 2 && count(JointKind::clavicle) == 0)
            rename(JointKind::shoulder, "shoulder", JointKind::clavicle);
        if (count(JointKind::hip) == 0)  // "Left leg" above "Left knee", or the only bone of the leg
            rename(JointKind::knee, "leg", JointKind::hip);
        leave_out_beside_others(JointKind::pelvis, "root");  // it lies on the floor
        leave_out_beside_others(JointKind::hip, "hip");  // "Hip.L" leads from the pelvis to where "Thigh.L" begins
        for (const JointKind kind : { JointKind::wrist, JointKind::ankle })
            if (count(kind) == 0)
                name_stand_ins(kind);
        if (count(JointKind::head) == 0)
            name_upper_spine();
        if (count(JointKind::pelvis) == 0)
            name_first_of_spine();
        return std::move(joints_);
    }

private:
    bool is(std::size_t joint, JointKind kind) const { return joints_[joint] && joints_[joint]->kind == kind; }

    int count(JointKind kind) const
    {
        int result = 0;
        for (std::size_t i = 0; i < joints_.size(); ++i)
            result += is(i, kind);
        return result;
    }

    std::ptrdiff_t count_token(std::string_view token) const
    {
        return std::count_if(names_.begin(), names_.end(),
                             [token](const std::string& name) { return has_token(name, token); });
    }

    /// Where a bone has one part only, the joint is at its head, whatever it is called.
    void name_parts()
    {
        std::map<std::pair<JointKind, int>, std::size_t> first;
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            const std::optional<NamedJoint> joint = recognize(names_[i], common_, Reading::part);
            if (joints_[i] || !joint)
                continue;
            joints_[i] = joint;
            const auto [found, is_new] = first.try_emplace({ joint->kind, joint->side }, i);
            const bool is_upper = joint->kind == JointKind::shoulder || joint->kind == JointKind::hip;
            const bool begins = has_token(names_[i], is_upper ? "twist" : "stretch");
            if (is_new)
                continue;
            joints_[begins ? found->second : i]->is_later_part = true;
            if (begins)
                found->second = i;
        }
    }

    void rename(JointKind from, std::string_view token, JointKind to)
    {
        for (std::size_t i = 0; i < joints_.size(); ++i)
            if (is(i, from) && has_token(names_[i], token))
                joints_[i]->kind = to;
    }

    /// Names with that word mean something else beside other joints of their kind.
    void leave_out_beside_others(JointKind kind, std::string_view token)
    {
        std::vector<std::size_t> named;
        for (std::size_t i = 0; i < joints_.size(); ++i)
            if (is(i, kind) && has_token(names_[i], token))
                named.push_back(i);
        if (int(named.size()) < count(kind))
            for (const std::size_t i : named)
                joints_[i].reset();
    }

    /// Rigify's human goes on counting the spine through neck (4, 5) and head (6).
    void name_upper_spine()
    {
        for (std::size_t i = 0; i < joints_.size(); ++i)
            if (is(i, JointKind::spine) && names_[i].ends_with("006"))
                joints_[i]->kind = JointKind::head;
            else if (is(i, JointKind::spine) && (names_[i].ends_with("004") || names_[i].ends_with("005")))
                joints_[i]->kind = JointKind::neck;
    }

    void name_stand_ins(JointKind kind)
    {
        for (std::size_t i = 0; i < joints_.size(); ++i)
            if (const auto joint = recognize(names_[i], common_, Reading::stand_in);
                !joints_[i] && joint && joint->kind == kind)
                joints_[i] = joint;
    }

    /// It begins in the pelvis there.
    void name_first_of_spine()
    {
        const auto first = std::find_if(joints_.begin(), joints_.end(),
                                        [](const auto& joint) { return joint && joint->kind == JointKind::spine; });
        if (first != joints_.end())
            (*first)->kind = JointKind::pelvis;
    }

    const std::vector<std::string>& names_;
    std::set<std::string> common_;
    std::vector<std::optional<NamedJoint>> joints_;
};

}  // namespace

std::vector<std::optional<NamedJoint>> recognize_joints(const std::vector<std::string>& names)
{
    return JointNames(names).read();
}

}  // namespace garmentfit
