// SPDX-License-Identifier: GPL-3.0-or-later
#include "limb_search.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "search_grids.h"

namespace garmentfit {
namespace {

constexpr double k_better = 1e-9;  // unit: m of energy; below this rounding decides, and the nearer direction wins
constexpr double k_any = FitEnergy::k_any;

// The first bones of a limb, up to and including the last one placed.
struct Chain {
    Vec3 tail;
    Eigen::Quaterniond turn;
    std::array<Vec3, 2> directions;
    double score = 0;
    CoverageDistances distances;  // empty where coverage does not count
};

void sort_best_first(std::vector<Chain>& chains)
{
    std::stable_sort(chains.begin(), chains.end(), [](const Chain& a, const Chain& b) { return a.score > b.score; });
}

class LimbSearch {
public:
    LimbSearch(const FitEnergy& energy, const Posture& present, const Limb& limb, const LimbGrid& grid) :
        energy_(energy), present_(present), limb_(limb), grid_(grid), bones_(place_bones(energy.rest(), present))
    {
    }

    /// The best first bones, none of them alike: those of the beam.
    std::vector<Chain> find_first_bones() const
    {
        const auto [first, second] = limb_.bones;
        Chain root { bones_.joints.head(first), bones_.parent_turn(first), { Vec3::Zero(), Vec3::Zero() }, 0, {} };
        if (grid_.exact && fills_tube())
            root.distances = energy_.coverage_distances(bones_, limb_);
        std::vector<Chain> beam, chains = extend(root, 0, present_.directions[first], k_any);
        if (grid_.exact) {
            for (Chain& chain : chains)
                if (energy_.misses_sleeve(first, chain.tail, bones_.joints))
                    chain.score -= energy_.weights().arm_in_trunk;
            sort_best_first(chains);
        }
        for (Chain& chain : chains) {
            if (int(beam.size()) == grid_.beam)
                break;
            const bool is_alike = std::any_of(beam.begin(), beam.end(), [&](const Chain& kept) {
                return angle_between(kept.directions[0], chain.directions[0]) < k_alike_directions * grid_.spacing;
            });
            if (!is_alike && !crosses(root.tail, chain.tail))
                beam.push_back(std::move(chain));
        }
        return beam;
    }

    /// Replaces `best` by the best chain that begins with `first`, if that one is better.
    void improve(std::optional<Chain>& best, const Chain& first) const
    {
        const auto [upper, lower] = limb_.bones;
        const Vec3 start = shortest_arc(present_.directions[upper], first.directions[0]) * present_.directions[lower];
        for (const Chain& chain : extend(first, 1, start, best ? best->score : k_any)) {
            if (best && chain.score <= best->score + k_better)
                return;
            if (crosses(first.tail, chain.tail))
                continue;
            const bool tip_crosses = crosses(chain.tail, tip_of(chain));
            if (tip_crosses && !may_cross_cloth(limb_.end))
                continue;
            const double score = chain.score - (tip_crosses ? energy_.weights().tip_crossing : 0);
            if (best && score <= best->score + k_better)
                continue;
            best = chain;
            best->score = score;
            if (!tip_crosses)
                return;
        }
    }

private:
    // A limb fills a tube of its own where the garment covers its lower bone, or is a sleeve; legs in a skirt share
    // theirs.
    bool fills_tube() const
    {
        const bool is_leg = limb_.end == lfoot_tip || limb_.end == rfoot_tip;
        return energy_.metric().covers(limb_.bones[is_leg ? 1 : 0]);
    }

    bool crosses(const Vec3& from, const Vec3& to) const
    {
        return grid_.exact && energy_.metric().cloth().crosses(from, to);
    }

    Vec3 tip_of(const Chain& chain) const
    {
        return chain.tail + chain.turn * (energy_.rest().tips[limb_.end] - energy_.rest().tail(limb_.bones[1]));
    }

    bool exceeds_limits(int bone, const Chain& chain, const Vec3& direction) const
    {
        return energy_.limits().excess(bone, chain.turn, direction) > 0
            || (is_forearm(bone) && folds_into_chest(bones_.joints.direction(parent_of(limb_.bones[0])), direction));
    }

    // The chain with its bone number `link` in every direction of the grid about `start`, best first. Directions that
    // cannot exceed `least` are left out.
    std::vector<Chain> extend(const Chain& chain, int link, const Vec3& start, double least) const
    {
        const int bone = limb_.bones[link];
        const bool is_covered = energy_.metric().covers(bone), is_last = link == 1;
        const bool coverage_counts = chain.distances.size() > 0 && is_covered;
        const double empty
            = coverage_counts ? energy_.coverage_cost(chain.distances) : 0;  // the most that a bone can save
        std::vector<Chain> result;
        for (const Vec3& direction : directions_about(start, grid_.extent, grid_.spacing)) {
            if (is_covered && exceeds_limits(bone, chain, direction))
                continue;
            const Vec3 tail = chain.tail + energy_.rest().length(bone) * direction;
            const double value = energy_.bone_value(bone, chain.tail, tail, chain.turn, bones_.joints,
                                                    least - chain.score - empty - k_better);
            if (value == k_any)
                continue;
            Chain next = chain;
            next.directions[link] = direction;
            next.tail = tail;
            next.score += value;
            if (coverage_counts) {
                next.distances = next.distances.min(energy_.coverage_distances(bone, chain.tail, next.tail));
                next.score += empty - energy_.coverage_cost(next.distances);
            }
            next.turn = bone_turn(energy_.rest(), bone, chain.turn, direction);
            if (is_last)
                next.score += energy_.metric().uncovered_tip_value(limb_.end, next.tail, tip_of(next));
            if (is_last && !grid_.exact)  // no crossing can rule the best one out
                least = std::max(least, next.score);
            result.push_back(std::move(next));
        }
        sort_best_first(result);
        return result;
    }

    const FitEnergy& energy_;
    const Posture& present_;
    const Limb& limb_;
    const LimbGrid& grid_;
    PlacedBones bones_;
};

}  // namespace

Posture search_limb(const FitEnergy& energy, const Posture& present, const Limb& limb, const LimbGrid& grid)
{
    const LimbSearch search(energy, present, limb, grid);
    std::optional<Chain> best;
    for (const Chain& first : search.find_first_bones())
        search.improve(best, first);
    Posture moved = present;
    for (std::size_t link = 0; best && link < limb.bones.size(); ++link)
        moved.directions[limb.bones[link]] = best->directions[link];
    return moved;
}

}  // namespace garmentfit
