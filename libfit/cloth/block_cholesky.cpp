// SPDX-License-Identifier: GPL-3.0-or-later
#include "block_cholesky.h"

#include <Eigen/Cholesky>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <atomic>

#include "parallel.h"
#include "tuning.h"

namespace garmentfit {
namespace {

using Lists = std::vector<std::vector<int>>;

/// The rows in an order of approximate minimum degree.
std::vector<int> minimum_degree_order(const Lists& neighbours)
{
    const int n = int(neighbours.size());
    std::vector<Eigen::Triplet<double>> entries;
    for (int v = 0; v < n; ++v) {
        entries.emplace_back(v, v, 1.0);
        for (const int w : neighbours[v])
            entries.emplace_back(v, w, 1.0);
    }
    Eigen::SparseMatrix<double> pattern(n, n);
    pattern.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(pattern, order);
    return { order.indices().begin(), order.indices().end() };
}

/// For each row those below the diagonal of its column, when rows are renamed by `place`.
Lists lower_triangle(const Lists& neighbours, const std::vector<int>& place)
{
    Lists result(neighbours.size());
    for (std::size_t v = 0; v < neighbours.size(); ++v)
        for (const int w : neighbours[v])
            if (place[w] > place[v])
                result[place[v]].push_back(place[w]);
    for (std::vector<int>& rows : result)
        std::sort(rows.begin(), rows.end());
    return result;
}

/// The rows of each column of the factor, and by them the elimination tree: a column's parent is its first row.
Lists columns_of_factor(const Lists& lower)
{
    Lists result = lower, children(lower.size());
    for (std::size_t j = 0; j < lower.size(); ++j) {
        std::vector<int>& rows = result[j];
        for (const int child : children[j])
            rows.insert(rows.end(), result[child].begin() + 1, result[child].end());
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        if (!rows.empty())
            children[rows.front()].push_back(int(j));
    }
    return result;
}

/// The columns, each after all below it in the tree, subtree after subtree.
std::vector<int> post_order(const Lists& columns)
{
    const int n = int(columns.size());
    Lists children(n + 1);
    for (int j = n - 1; j >= 0; --j)
        children[columns[j].empty() ? n : columns[j].front()].push_back(j);
    std::vector<int> result, open { n };
    while (!open.empty()) {  // parents first, then turned round
        const int j = open.back();
        open.pop_back();
        result.push_back(j);
        open.insert(open.end(), children[j].rbegin(), children[j].rend());
    }
    std::reverse(result.begin(), result.end());
    result.pop_back();
    return result;
}

long entries(long columns, long rows) { return columns * (columns + 1) / 2 + columns * rows; }

}  // namespace

BlockCholesky::BlockCholesky(int count, const std::vector<std::pair<int, int>>& pairs)
{
    Lists neighbours(count);
    for (const auto& [i, j] : pairs) {
        neighbours[i].push_back(j);
        neighbours[j].push_back(i);
    }
    for (std::vector<int>& some : neighbours) {
        std::sort(some.begin(), some.end());
        some.erase(std::unique(some.begin(), some.end()), some.end());
    }
    order(neighbours);
    const Lists lower = lower_triangle(neighbours, place_);
    find_fronts(columns_of_factor(lower));
    link_fronts();
    plan_subtrees();
    place_blocks(lower);
}

void BlockCholesky::order(const Lists& neighbours)
{
    const auto places_in = [](const std::vector<int>& order) {
        std::vector<int> result(order.size());
        for (std::size_t i = 0; i < order.size(); ++i)
            result[order[i]] = int(i);
        return result;
    };
    place_ = places_in(minimum_degree_order(neighbours));
    const std::vector<int> after = places_in(post_order(columns_of_factor(lower_triangle(neighbours, place_))));
    for (int& place : place_)
        place = after[place];
}

// A column joins the front of the one before it, which is its child, where few zeros are stored for that.
void BlockCholesky::find_fronts(const Lists& columns)
{
    struct Part {
        int begin, end;
        long zeros;
    };
    std::vector<Part> parts;
    for (int j = 0; j < int(columns.size()); ++j) {
        Part part { j, j + 1, 0 };
        const std::vector<int>& rows = columns[j];
        while (!parts.empty()) {
            const Part& child = parts.back();
            const std::vector<int>& below = columns[child.end - 1];
            if (below.empty() || below.front() != part.begin)
                break;
            // Each of the child's columns gets rows for all of the part's that it has none for.
            const long more = long(part.end - part.begin) + long(rows.size()) - long(below.size());
            const long zeros = part.zeros + child.zeros + more * (child.end - child.begin);
            const long all = entries(part.end - child.begin, long(rows.size()));
            if (part.end - child.begin > k_small_front && double(zeros) > k_front_zeros * double(all))
                break;
            part = { child.begin, part.end, zeros };
            parts.pop_back();
        }
        parts.push_back(part);
    }
    for (const Part& part : parts)
        fronts_.push_back({ part.begin, part.end, columns[part.end - 1], {}, {}, 0 });
}

void BlockCholesky::link_fronts()
{
    std::vector<int> front_of(place_.size());
    for (std::size_t f = 0; f < fronts_.size(); ++f)
        std::fill(front_of.begin() + fronts_[f].begin, front_of.begin() + fronts_[f].end, int(f));
    for (std::size_t f = 0; f < fronts_.size(); ++f) {
        Front& front = fronts_[f];
        front.left_begin = left_size_;
        left_size_ += 3 * int(front.rows.size());
        if (front.rows.empty())
            continue;
        Front& parent = fronts_[front_of[front.rows.front()]];
        parent.children.push_back(int(f));
        for (const int row : front.rows)
            front.in_parent.push_back(
                row < parent.end ? row - parent.begin
                                 : parent.columns()
                        + int(std::lower_bound(parent.rows.begin(), parent.rows.end(), row) - parent.rows.begin()));
    }
}

// Small subtrees as they are, and each front above them for itself, on the first level after its children.
void BlockCholesky::plan_subtrees()
{
    const int count = int(fronts_.size());
    std::vector<double> work(count);  // in the subtree
    std::vector<int> first(count), level(count, 0);
    double all = 0;
    for (int f = 0; f < count; ++f) {
        const double columns = fronts_[f].columns(), size = fronts_[f].size();
        work[f] = columns * size * size;
        all += work[f];
        first[f] = fronts_[f].children.empty() ? f : first[fronts_[f].children.front()];
        for (const int child : fronts_[f].children)
            work[f] += work[child];
    }
    const double most = k_subtree_work * all;
    std::vector<bool> is_whole(count);
    for (int f = 0; f < count; ++f)
        is_whole[f] = work[f] <= most;
    const auto add = [&](int l, const Subtree& subtree) {
        levels_.resize(std::max<std::size_t>(levels_.size(), l + 1));
        levels_[l].push_back(subtree);
    };
    for (int f = 0; f < count; ++f) {
        if (!is_whole[f]) {
            for (const int child : fronts_[f].children) {
                if (is_whole[child])
                    add(0, { first[child], child + 1 });
                level[f] = std::max(level[f], level[child] + 1);
            }
            add(level[f], { f, f + 1 });
        } else if (fronts_[f].rows.empty()) {
            add(0, { first[f], f + 1 });
        }
    }
}

void BlockCholesky::place_blocks(const Lists& lower)
{
    block_begin_.push_back(0);
    for (int j = 0; j < int(lower.size()); ++j) {
        block_rows_.push_back(j);
        block_rows_.insert(block_rows_.end(), lower[j].begin(), lower[j].end());
        block_begin_.push_back(int(block_rows_.size()));
    }
    blocks_.resize(block_rows_.size());
    set_zero();
}

void BlockCholesky::set_zero() { std::fill(blocks_.begin(), blocks_.end(), Eigen::Matrix3d::Zero()); }

Eigen::Matrix3d* BlockCholesky::find(int i, int j)
{
    const auto [column, row] = std::minmax(place_[i], place_[j]);
    const auto begin = block_rows_.begin() + block_begin_[column], end = block_rows_.begin() + block_begin_[column + 1];
    const auto found = std::lower_bound(begin, end, row);
    return found != end && *found == row ? &blocks_[found - block_rows_.begin()] : nullptr;
}

template <class Visit>
void BlockCholesky::upwards(const Visit& visit) const
{
    for (const std::vector<Subtree>& level : levels_)
        parallel_for(level.size(), [&](std::size_t i) {
            for (int f = level[i].first; f < level[i].second; ++f)
                visit(f);
        });
}

template <class Visit>
void BlockCholesky::downwards(const Visit& visit) const
{
    for (auto level = levels_.rbegin(); level != levels_.rend(); ++level)
        parallel_for(level->size(), [&](std::size_t i) {
            for (int f = (*level)[i].second - 1; f >= (*level)[i].first; --f)
                visit(f);
        });
}

// The matrix's own blocks in the columns of a front.
void BlockCholesky::take_blocks(const Front& front, Dense& factor) const
{
    for (int j = front.begin; j < front.end; ++j) {
        auto row = front.rows.begin();
        for (int b = block_begin_[j]; b < block_begin_[j + 1]; ++b) {
            int local = block_rows_[b] - front.begin;
            if (block_rows_[b] >= front.end) {
                row = std::lower_bound(row, front.rows.end(), block_rows_[b]);
                local = front.columns() + int(row - front.rows.begin());
            }
            factor.block<3, 3>(3 * local, 3 * (j - front.begin)) += blocks_[b].cast<float>();
        }
    }
}

void BlockCholesky::add_remainder(const Front& child, const Dense& left, const Front& front, Dense& factor,
                                  Dense& remainder)
{
    const std::vector<int>& place = child.in_parent;
    for (int j = 0; j < int(place.size()); ++j)
        for (int i = j; i < int(place.size()); ++i) {
            const auto block = left.block<3, 3>(3 * i, 3 * j);
            if (place[j] < front.columns())
                factor.block<3, 3>(3 * place[i], 3 * place[j]) += block;
            else
                remainder.block<3, 3>(3 * (place[i] - front.columns()), 3 * (place[j] - front.columns())) += block;
        }
}

// Takes what the children have left, eliminates the front's columns, and leaves the remainder.
bool BlockCholesky::eliminate(int f, std::vector<Dense>& left)
{
    const Front& front = fronts_[f];
    const int columns = 3 * front.columns(), below = 3 * int(front.rows.size());
    Dense& factor = factors_[f];
    Dense& remainder = left[f];
    factor.setZero(columns + below, columns);
    remainder.setZero(below, below);
    take_blocks(front, factor);
    for (const int child : front.children) {
        add_remainder(fronts_[child], left[child], front, factor, remainder);
        left[child].resize(0, 0);
    }
    Eigen::Ref<Dense> corner = factor.topRows(columns);
    const Eigen::LLT<Eigen::Ref<Dense>> cholesky(corner);
    if (cholesky.info() != Eigen::Success)
        return false;
    if (below > 0) {
        auto rest = factor.bottomRows(below);
        corner.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(rest);
        remainder.selfadjointView<Eigen::Lower>().rankUpdate(rest, -1);
    }
    return true;
}

bool BlockCholesky::factorise()
{
    factors_.resize(fronts_.size());
    std::vector<Dense> left(fronts_.size());
    std::atomic<bool> is_definite = true;
    upwards([&](int f) {
        if (is_definite && !eliminate(f, left))
            is_definite = false;
    });
    return is_definite;
}

Positions BlockCholesky::solve(const Positions& right) const
{
    Eigen::VectorXf x(right.size()), left(left_size_);
    for (int v = 0; v < int(right.rows()); ++v)
        x.segment<3>(3 * place_[v]) = right.row(v).transpose().cast<float>();
    upwards([&](int f) {
        const Front& front = fronts_[f];
        auto mine = x.segment(3 * front.begin, 3 * front.columns());
        auto below = left.segment(front.left_begin, 3 * Eigen::Index(front.rows.size()));
        below.setZero();
        for (const int child : front.children) {
            const std::vector<int>& place = fronts_[child].in_parent;
            const int from = fronts_[child].left_begin;
            for (int i = 0; i < int(place.size()); ++i)
                if (place[i] < front.columns())
                    mine.segment<3>(3 * place[i]) += left.segment<3>(from + 3 * i);
                else
                    below.segment<3>(3 * (place[i] - front.columns())) += left.segment<3>(from + 3 * i);
        }
        factors_[f].topRows(mine.size()).triangularView<Eigen::Lower>().solveInPlace(mine);
        below.noalias() -= factors_[f].bottomRows(below.size()) * mine;
    });
    downwards([&](int f) {
        const Front& front = fronts_[f];
        auto mine = x.segment(3 * front.begin, 3 * front.columns());
        auto below = left.segment(front.left_begin, 3 * Eigen::Index(front.rows.size()));
        for (int i = 0; i < int(front.rows.size()); ++i)
            below.segment<3>(3 * i) = x.segment<3>(3 * front.rows[i]);
        mine.noalias() -= factors_[f].bottomRows(below.size()).transpose() * below;
        factors_[f].topRows(mine.size()).triangularView<Eigen::Lower>().transpose().solveInPlace(mine);
    });
    Positions result(right.rows(), 3);
    for (int v = 0; v < int(right.rows()); ++v)
        result.row(v) = x.segment<3>(3 * place_[v]).transpose().cast<double>();
    return result;
}

}  // namespace garmentfit
