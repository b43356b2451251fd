// SPDX-License-Identifier: GPL-3.0-or-later
#include "garmentfit/stand_in.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "crowding.h"
#include "embedded_motion.h"
#include "exact_crossings.h"
#include "garmentfit/closed_ends.h"
#include "garmentfit/pieces.h"
#include "given_crossings.h"
#include "nearest.h"
#include "outward_cloth.h"
#include "parallel.h"
#include "remeshed_cloth.h"
#include "side_by_side.h"
#include "spread_ways.h"
#include "topology.h"
#include "torn_regions.h"
#include "tuning.h"
#include "untangle.h"
#include "used_vertices.h"
#include "weld.h"
#include "winding_number.h"

namespace garmentfit {
namespace {

constexpr double k_inside = 0.5;  // derived: around a closed surface winding numbers are 0 or 1

/// The garment that follows. Only vertices at exactly the same place are one: parts that touch stay as they are.
struct Parts {
    const Weld weld;
    const TriangleMesh rest;
    const MeshTopology topology;
    mutable SelfCrossingSearch search;  ///< its trees are renewed each time
    const std::vector<Crossing> crossings;  ///< with itself, as given
    const GivenCrossings given;
    const LedPlaces led;  ///< with the stand-in
    const SideBySide beside;

    Parts(const GarmentMesh& stand_in, const Positions& worn, const GarmentMesh& garment) :
        weld(garment), rest(sewn(weld.gather(garment))), topology(rest.triangles, int(rest.positions.rows())),
        search(rest.triangles, topology.edges()), crossings(self_crossings(rest.positions)),
        given(rest, topology.edges(), crossings), led(lead_along(stand_in, worn, rest, topology)),
        beside(rest.positions, topology, led.positions)
    {
    }
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;

    std::vector<Crossing> self_crossings(const Positions& positions) const { return search.find(positions); }
    /// Those that it was not given with.
    std::vector<Crossing> fresh_crossings(const Positions& positions) const
    {
        return given.compare(positions, self_crossings(positions)).fresh;
    }

private:
    static TriangleMesh sewn(const GarmentMesh& garment) { return { garment.positions, garment.triangles }; }
};

/// Where the least was wrong so far.
struct Best {
    Positions positions;
    std::size_t faults = std::numeric_limits<std::size_t>::max();
    int futile = 0;  ///< states since then

    void offer(const Positions& now, std::size_t wrong)
    {
        if (wrong >= faults) {
            ++futile;
            return;
        }
        positions = now;
        faults = wrong;
        futile = 0;
    }
};

// ---- cloth side by side moves alike --------------------------------------------------------------------------------

/// The affine motions of all vertices, a row each.
Eigen::MatrixXd affine_motions(const Parts& cloth)
{
    Eigen::MatrixXd motions(cloth.led.positions.rows(), 12);
    for (Eigen::Index v = 0; v < motions.rows(); ++v) {
        const Eigen::Matrix3d& turn = cloth.led.turns[v];
        motions.row(v).head<9>() = Eigen::Map<const Eigen::RowVector<double, 9>>(turn.data());
        motions.row(v).tail<3>() = cloth.led.positions.row(v) - cloth.rest.positions.row(v) * turn.transpose();
    }
    return motions;
}

Positions moved_by(const Eigen::MatrixXd& motions, const Positions& rest)
{
    Positions positions(rest.rows(), 3);
    for (Eigen::Index v = 0; v < rest.rows(); ++v) {
        const Eigen::RowVector<double, 9> turn = motions.row(v).head<9>();
        positions.row(v)
            = rest.row(v) * Eigen::Map<const Eigen::Matrix3d>(turn.data()).transpose() + motions.row(v).tail<3>();
    }
    return positions;
}

/// Marks where cloth meets itself that lay apart as given, and where it is torn. Of sheets that lay on each other some are
/// parted later, until no more of them cross than did. @return how many such places there are
std::size_t mark_faults(const Parts& cloth, const Positions& positions, std::vector<char>& marks)
{
    const std::vector<Crossing> fresh = cloth.given.of_cloth_apart(positions, cloth.self_crossings(positions));
    for (const Crossing& crossing : fresh) {
        for (const int v : cloth.topology.edges().row(crossing.first))
            marks[v] = 1;
        for (const int v : cloth.rest.triangles.row(crossing.second))
            marks[v] = 1;
    }
    std::size_t faults = fresh.size();
    for (const auto& edge : cloth.topology.edges().rowwise())
        if (is_torn(cloth.rest.positions, positions, edge[0], edge[1])) {
            marks[edge[0]] = marks[edge[1]] = 1;
            ++faults;
        }
    return faults;
}

/// Evens the motions round all places where parts that lay side by side went different ways: their vertices hang on
/// different sides of the stand-in, or are further from it than its folds are wide. A wider circle in each round.
Positions moved_alike(const Parts& cloth, const Progress& progress)
{
    const Eigen::MatrixXd led = affine_motions(cloth);
    Positions positions = cloth.led.positions;
    Best best { positions };
    std::vector<char> evened(led.rows(), 0);
    for (int round = 1;; ++round) {
        std::vector<char> marks(led.rows(), 0);
        best.offer(positions, mark_faults(cloth, positions, marks));
        if (best.faults == 0 || round > k_evening_rounds || best.futile == k_futile_evenings || !progress.goes_on(1))
            return best.positions;
        cloth.beside.spread(marks, round * k_evening_links);
        for (std::size_t v = 0; v < marks.size(); ++v)
            evened[v] |= marks[v];
        positions = moved_by(cloth.beside.evened(led, evened, k_evening_hold), cloth.rest.positions);
    }
}

// ---- clear of the body ---------------------------------------------------------------------------------------------

/// What a garment has to keep clear of, ready to be asked again and again.
class Obstacles {
public:
    explicit Obstacles(const Surroundings& around) : winding_(around.body), skin_(around.body)
    {
        for (const TriangleMesh& other : around.clothes)
            obstacles_.push_back({ other, edges_of(other.triangles), TriangleTree(other) });
        obstacles_.push_back({ around.body, edges_of(around.body.triangles), skin_ });
    }

    bool is_in_body(const Vec3& place) const { return winding_(place) > k_inside; }
    Vec3 nearest_skin(const Vec3& place) const { return skin_.nearest(place); }

    /// Marks vertices of cloth that lie in the body, or whose edges or triangles meet something.
    /// @return how many there are
    std::size_t mark_meeting(const TriangleMesh& cloth, const Edges& edges, std::vector<char>& marks) const
    {
        const TriangleTree tree(cloth);
        parallel_for(cloth.positions.rows(), [&](Eigen::Index v) { marks[v] = is_in_body(cloth.positions.row(v)); });
        for (const Obstacle& other : obstacles_) {
            for (const auto& [edge, triangle] : find_crossings(cloth, edges, other.tree))
                for (const int v : edges.row(edge))
                    marks[v] = 1;
            for (const auto& [edge, triangle] : find_crossings(other.mesh, other.edges, tree))
                for (const int v : cloth.triangles.row(triangle))
                    marks[v] = 1;
        }
        return std::size_t(std::count(marks.begin(), marks.end(), 1));
    }

private:
    struct Obstacle {
        const TriangleMesh& mesh;
        Edges edges;
        TriangleTree tree;
    };

    WindingNumber winding_;
    TriangleTree skin_;
    std::vector<Obstacle> obstacles_;
};

/// From a place in the body to a little beyond its skin.
Vec3 way_out(const Vec3& place, const Obstacles& obstacles)
{
    const Vec3 to_skin = obstacles.nearest_skin(place) - place;
    return (to_skin.norm() + k_pushing_step) * to_skin.stableNormalized();
}

/// How far, and where to, vertices that meet the body have to go: beyond the skin.
Positions ways_beyond_skin(const Positions& positions, const std::vector<char>& marks, const Obstacles& obstacles,
                           double beyond)
{
    Positions ways = Positions::Zero(positions.rows(), 3);
    parallel_for(positions.rows(), [&](Eigen::Index v) {
        if (!marks[v])
            return;
        const Vec3 place = positions.row(v), from_skin = place - obstacles.nearest_skin(place);
        if (obstacles.is_in_body(place))
            ways.row(v) = way_out(place, obstacles);
        else if (const double gap = from_skin.norm(); gap < beyond)
            ways.row(v) = (beyond - gap) * from_skin.stableNormalized();
    });
    return ways;
}

/// The same for vertices that are outside, of edges and triangles that pass through the body between them: they go as far
/// as what is within.
void lengthen_ways_between(const Parts& cloth, const Positions& positions, const std::vector<char>& marks,
                           const Obstacles& obstacles, Positions& ways)
{
    const auto take_along = [&](const auto& corners, const Vec3& place) {
        if (!obstacles.is_in_body(place))
            return;
        const Vec3 way = way_out(place, obstacles);
        for (const int v : corners)
            if (way.norm() > ways.row(v).norm())
                ways.row(v) = way;
    };
    const auto is_marked = [&](int v) { return marks[v] != 0; };
    const auto place = [&](int v) { return Vec3(positions.row(v)); };
    const auto count_parts = [](double length, int fewest) {
        return std::clamp(int(std::ceil(length / k_places_apart)), fewest, k_most_parts);
    };
    for (const auto& ends : cloth.topology.edges().rowwise())
        if (std::all_of(ends.begin(), ends.end(), is_marked)) {
            const Vec3 a = place(ends[0]), along = place(ends[1]) - a;
            const int parts = count_parts(along.norm(), k_parts_of_edge);
            for (int i = 1; i < parts; ++i)
                take_along(ends, a + double(i) / parts * along);
        }
    for (const auto& corners : cloth.rest.triangles.rowwise())
        if (std::all_of(corners.begin(), corners.end(), is_marked)) {
            const Vec3 a = place(corners[0]), p = place(corners[1]) - a, q = place(corners[2]) - a;
            const int parts = count_parts(std::max({ p.norm(), q.norm(), (p - q).norm() }), k_parts_of_triangle);
            for (int i = 1; i < parts; ++i)
                for (int j = 1; i + j < parts; ++j)
                    take_along(corners, a + (double(i) * p + double(j) * q) / parts);
        }
}

/// Half of the way to the stand-in, which lies clear of the body also where the skin of one limb faces that of another.
Positions ways_to_stand_in(const Parts& cloth, const Positions& positions, const std::vector<char>& marks)
{
    Positions ways = Positions::Zero(positions.rows(), 3);
    for (Eigen::Index v = 0; v < ways.rows(); ++v)
        if (marks[v])
            ways.row(v) = (cloth.led.feet.row(v) - positions.row(v)) / 2;
    return ways;
}

/// Beyond the skin, in turns with half of the way to the stand-in.
Positions ways_out(const Parts& cloth, const Positions& positions, const std::vector<char>& marks,
                   const Obstacles& obstacles, int round)
{
    if (round % 2 == 1)
        return ways_to_stand_in(cloth, positions, marks);
    Positions ways = ways_beyond_skin(positions, marks, obstacles, (round + 1) * k_pushing_step);
    lengthen_ways_between(cloth, positions, marks, obstacles, ways);
    return ways;
}

/// Moves what meets something, and the space round it along with it: sheets keep their order. Where something goes on
/// to meet, it is where the least does. Between two limbs ways out cancel each other: where moving is in vain, less of
/// the space is taken along.
/// @param ways_of  of the positions, of the vertices that are marked, in a round
template <class Ways>
Best moved_off(const Parts& cloth, Positions positions, const Obstacles& obstacles, const Progress& progress,
               const Ways& ways_of)
{
    const double edge = mean_edge_length(cloth.rest.positions, cloth.topology.edges()),
                 reach = std::min(k_pushing_reach * edge, k_longest_reach);
    double softness = 1;
    Best best { positions };
    std::vector<char> marks(positions.rows());
    for (int round = 0;; ++round) {
        best.offer(positions,
                   obstacles.mark_meeting({ positions, cloth.rest.triangles }, cloth.topology.edges(), marks));
        if (best.faults == 0 || round == k_pushing_rounds || best.futile == k_futile_pushes || !progress.goes_on(1))
            return best;
        const Positions ways = ways_of(positions, marks, round);
        const double longest = ways.rowwise().norm().maxCoeff();
        if (best.futile > k_patient_pushes)
            softness *= k_harder_push;
        positions += spread_ways(positions, ways, softness * std::max(reach, longest / k_steepest_way));
    }
}

/// Pushes what meets something away from the body. What stays caught between two limbs, which push it to and fro, goes
/// to the stand-in alone.
Positions pushed_clear(const Parts& cloth, const Positions& positions, const Obstacles& obstacles,
                       const Progress& progress)
{
    Best pushed = moved_off(cloth, positions, obstacles, progress, [&](const auto& now, const auto& marks, int round) {
        return ways_out(cloth, now, marks, obstacles, round);
    });
    if (pushed.faults == 0)
        return pushed.positions;
    const Best drawn
        = moved_off(cloth, pushed.positions, obstacles, progress,
                    [&](const auto& now, const auto& marks, int) { return ways_to_stand_in(cloth, now, marks); });
    pushed.offer(drawn.positions, drawn.faults);
    return pushed.positions;
}

// ---- parts that meet each other ------------------------------------------------------------------------------------

/// Parts the cloth as far as needed for no more than `enough` crossings, in sixteenths, eighths, quarters and halves of
/// the way to where that many are left.
Positions parted_to(const Parts& cloth, const Positions& positions, std::size_t enough)
{
    const Positions motion
        = reduce_crossings({ positions, cloth.rest.triangles }, cloth.topology.edges(), enough) - positions;
    if (motion.isZero(0))
        return positions;
    for (double share = k_least_parting; share < 1; share *= 2)
        if (Positions part = positions + share * motion; cloth.self_crossings(part).size() <= enough)
            return part;
    return positions + motion;
}

/// The rotation that takes a triangle from rest to where it is; an error of its strain.
Eigen::Matrix3d rotation_of(const Eigen::RowVector3i& corners, const Positions& rest, const Positions& positions)
{
    const auto frame = [&corners](const Positions& x) {
        const Vec3 along = (x.row(corners[1]) - x.row(corners[0])).transpose(),
                   normal = along.cross(Vec3(x.row(corners[2]) - x.row(corners[0])));
        Eigen::Matrix3d axes;
        axes << along.stableNormalized(), normal.stableNormalized(), along.cross(normal).stableNormalized();
        return axes;
    };
    return frame(positions) * frame(rest).transpose();
}

/// The marked vertices and their neighbours.
std::vector<int> with_neighbours(const MeshTopology& topology, const std::vector<char>& is_marked)
{
    std::vector<int> result;
    for (int v = 0; v < int(is_marked.size()); ++v) {
        const auto& neighbours = topology.neighbours(v);
        if (is_marked[v] || std::any_of(neighbours.begin(), neighbours.end(), [&](int n) { return is_marked[n]; }))
            result.push_back(v);
    }
    return result;
}

/// The triangles of a mesh that move from one place to another.
struct MovedPart {
    std::vector<int> vertices;  ///< those of the mesh
    Triangles triangles;  ///< of `vertices`
    Edges edges;

    MovedPart(const Triangles& mesh, const Positions& from, const Positions& to)
    {
        std::vector<int> faces;
        for (int f = 0; f < int(mesh.rows()); ++f)
            if (std::any_of(mesh.row(f).begin(), mesh.row(f).end(), [&](int v) { return from.row(v) != to.row(v); }))
                faces.push_back(f);
        const Triangles moved = mesh(faces, Eigen::all);
        vertices = used_vertices(moved);
        triangles = numbered_among(vertices, moved);
        edges = edges_of(triangles);
    }
};

/// From one place of the cloth that meets nothing towards another, as far as it meets nothing there: where it would,
/// vertices stay.
Positions moved_clear(const Parts& cloth, const Positions& from, Positions to, const Obstacles& obstacles)
{
    const MovedPart part(cloth.rest.triangles, from, to);
    if (part.vertices.empty())
        return to;
    std::vector<char> marks(part.vertices.size());
    for (int round = 0; round < k_clearing_rounds; ++round) {
        if (obstacles.mark_meeting({ to(part.vertices, Eigen::all), part.triangles }, part.edges, marks) == 0)
            return to;
        std::vector<char> meets(to.rows(), 0);
        for (std::size_t i = 0; i < marks.size(); ++i)
            meets[part.vertices[i]] = marks[i];
        const std::vector<int> meeting = with_neighbours(cloth.topology, meets);
        to(meeting, Eigen::all) = from(meeting, Eigen::all);
    }
    return from;
}

/// In which direction the edge of a crossing lay from the triangle at rest, unit. What lay right on it goes to the side on
/// which most of the edge is now.
Vec3 way_apart(const Parts& cloth, const Positions& positions, const Crossing& crossing)
{
    const Edges& edges = cloth.topology.edges();
    const Eigen::RowVector3i corners = cloth.rest.triangles.row(crossing.second);
    const Vec3 offset = offset_at_rest(cloth.rest, edges, positions, crossing);
    if (offset.norm() > k_least_offset)
        return rotation_of(corners, cloth.rest.positions, positions) * offset.normalized();
    const auto corner = [&](int k) { return Vec3(positions.row(corners[k])); };
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).stableNormalized();
    const auto height
        = [&](int end) { return normal.dot(Vec3(positions.row(edges(crossing.first, end))) - corner(0)); };
    return height(0) + height(1) > 0 ? normal : -normal;
}

/// How to move apart what meets and did not as given, by a step; cloth beside it goes half as far.
Positions towards_gaps_of_rest(const Parts& cloth, const std::vector<Crossing>& fresh, const Positions& positions,
                               double step)
{
    const Edges& edges = cloth.topology.edges();
    Positions motion = Positions::Zero(positions.rows(), 3);
    Eigen::VectorXd count = Eigen::VectorXd::Zero(positions.rows());
    const auto push = [&](int v, const Vec3& by) {
        motion.row(v) += by;
        count[v] += 1;
    };
    for (const Crossing& crossing : fresh) {
        const Vec3 by = step * way_apart(cloth, positions, crossing);
        for (const int v : edges.row(crossing.first))
            push(v, by);
        for (const int v : cloth.rest.triangles.row(crossing.second))
            push(v, -by);
    }
    motion.array().colwise() /= count.array().max(1);
    Positions beside = Positions::Zero(positions.rows(), 3);
    add_neighbours(edges, motion, beside);
    for (int v = 0; v < int(positions.rows()); ++v)
        if (count[v] == 0)
            motion.row(v) = beside.row(v) / std::max<double>(1, double(cloth.topology.neighbours(v).size())) / 2;
    return motion;
}

/// Where cloth meets itself and did not as given.
struct FreshCrossings {
    std::vector<Crossing> crossings;
    Positions positions;  ///< at which they do
};

/// If there are none, those that there would be in a file of single precision, in one of a few units: sheets that lay on
/// each other may be closer than its digits.
FreshCrossings find_fresh_crossings(const Parts& cloth, const Positions& positions)
{
    FreshCrossings found { cloth.fresh_crossings(positions), positions };
    for (const double unit : k_units_of_files) {
        if (!found.crossings.empty())
            break;
        found.positions = unit * (positions / unit).cast<float>().cast<double>();
        found.crossings = cloth.fresh_crossings(found.positions);
    }
    return found;
}

/// Gives what meets and did not as given, where that is little, the gaps that it had at rest. Where a fold has no room
/// for them, sheets are pushed to and fro: then it begins again where the fewest met, with half the step.
/// @return with the crossings that are left, or more than k_few_crossings
Best with_gaps_of_rest(const Parts& cloth, Positions positions, const Obstacles& obstacles, const Progress& progress)
{
    double step = k_gap_step * mean_edge_length(cloth.rest.positions, cloth.topology.edges());
    Best best { positions, k_few_crossings + 1 };
    for (int round = 0; round < k_gap_rounds; ++round) {
        const FreshCrossings fresh = find_fresh_crossings(cloth, positions);
        best.offer(positions, fresh.crossings.size());
        if (best.futile == k_futile_gap_rounds) {
            positions = best.positions;
            step /= 2;
            best.futile = 0;
            continue;
        }
        if (fresh.crossings.empty() || fresh.crossings.size() > k_few_crossings || !progress.goes_on(1))
            break;
        const Positions motion = towards_gaps_of_rest(cloth, fresh.crossings, fresh.positions, step);
        positions = moved_clear(cloth, positions, positions + motion, obstacles);
    }
    return best;
}

/// Untangles cloth with few crossings, but where that would make it meet something. Thousands of crossings are sheets
/// that lie on each other and do not come apart: of these, it leaves some fewer than were given.
Best untangled_once(const Parts& cloth, const Positions& positions, const Obstacles& obstacles,
                    const Progress& progress)
{
    const std::size_t given = cloth.crossings.size();
    Positions parted = given <= k_few_crossings
        ? untangle({ positions, cloth.rest.triangles }, cloth.topology.edges()).positions
        : parted_to(cloth, positions, std::size_t(k_fewer_crossings * double(given)));
    return with_gaps_of_rest(cloth, moved_clear(cloth, positions, std::move(parted), obstacles), obstacles, progress);
}

/// Again from where a few are left, as long as it leaves fewer.
Positions untangled(const Parts& cloth, const Positions& positions, const Obstacles& obstacles,
                    const Progress& progress)
{
    Best best { positions };
    while (best.futile == 0 && progress.goes_on(1)) {
        const Best next = untangled_once(cloth, best.positions, obstacles, progress);
        best.offer(next.positions, next.faults);
        if (next.faults == 0 || next.faults > k_last_crossings)
            break;
    }
    return best.positions;
}

std::size_t count_self_crossings(const TriangleMesh& cloth)
{
    return find_self_crossings(cloth, edges_of(cloth.triangles), TriangleTree(cloth)).size();
}

TriangleMesh welded(const GarmentMesh& garment)
{
    GarmentMesh sewn = Weld(garment).gather(garment);
    return { std::move(sewn.positions), std::move(sewn.triangles) };
}

/// The same cloth with fewer vertices. None where it, or the coarser one, crosses itself: what follows would cross at new
/// places.
std::optional<GarmentMesh> coarser(const TriangleMesh& cloth, int vertices)
{
    if (count_self_crossings(cloth) > 0)
        return {};
    const std::optional<TriangleMesh> coarse = remeshed_cloth(cloth, vertices);
    if (!coarse || count_self_crossings(*coarse) > 0)
        return {};
    return GarmentMesh { coarse->positions, coarse->triangles };
}

/// Larger triangles might lose the seams between pieces.
bool is_one_piece(const GarmentMesh& cloth) { return count_pieces_held(cloth).count == 1; }

/// The sheet moved out to near the cloth: collars and cuffs would be as much tighter than they are. As it is where it
/// would cross itself there.
GarmentMesh widened(Lining lining)
{
    GarmentMesh wide = lining.sheet;
    wide.positions += k_lining_shift * lining.gap * vertex_normals(wide.positions, wide.triangles);
    const bool crosses = count_self_crossings({ wide.positions, wide.triangles }) > 0;
    return crosses ? std::move(lining.sheet) : wide;
}

}  // namespace

std::optional<StandIn> make_stand_in(const GarmentMesh& garment)
{
    if (auto lining = lining_of(garment, crowding(garment) < k_crowded ? Lined::clothes_in_parts : Lined::all))
        return StandIn { widened(*std::move(lining)) };
    if (garment.positions.rows() < k_led)
        return {};
    const TriangleMesh cloth = welded(open_ends(garment).garment);  // ends that are closed may no longer be found in it
    const bool is_fine = cloth.positions.rows() >= k_fine;
    if (cloth.positions.rows() < k_led)
        return {};
    if (auto coarse = coarser(cloth, is_fine ? k_coarse : k_rough); coarse && (is_fine || is_one_piece(*coarse)))
        return StandIn { *std::move(coarse), false, !is_fine };
    return is_fine ? make_lining(garment) : std::nullopt;
}

std::optional<StandIn> make_lining(const GarmentMesh& garment)
{
    auto lining = lining_of(garment, Lined::all);
    return lining ? std::optional(StandIn { widened(*std::move(lining)), false }) : std::nullopt;
}

Positions follow(const GarmentMesh& stand_in, const Positions& worn, const GarmentMesh& garment,
                 const Surroundings& around, const Progress& progress)
{
    const Parts cloth(stand_in, worn, garment);
    const Obstacles obstacles(around);
    const Positions clear = pushed_clear(cloth, moved_alike(cloth, progress), obstacles, progress);
    return cloth.weld.place(untangled(cloth, clear, obstacles, progress));
}

Positions follow_roughly(const GarmentMesh& stand_in, const Positions& worn, const GarmentMesh& garment)
{
    const Weld weld(garment);
    const GarmentMesh sewn = weld.gather(garment);
    const TriangleMesh rest { sewn.positions, sewn.triangles };
    const MeshTopology topology(rest.triangles, int(rest.positions.rows()));
    return weld.place(lead_along(stand_in, worn, rest, topology).positions);
}

}  // namespace garmentfit
