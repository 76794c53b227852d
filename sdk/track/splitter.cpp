#include "track/splitter.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// Effort of a metre across, and of a metre climbed along the view beyond what noise does.
constexpr float kWayWeight = 0.3f, kClimbWeight = 4.0f;
constexpr float kEffortUnit_m = 0.25e-3f;

// A body below its head: to the sides, and before and behind, for a trunk that leans and a foot set forward.
constexpr float kSeedHalf_m = 0.10f, kSeedDepth_m = 0.45f;

}  // namespace

void Splitter::fit(const DepthGrid& grid) {
    if (owner_.size() == grid.cells()) return;
    owner_.assign(grid.cells(), kOutside);
    for (auto* v : {&members_, &sorted_, &effort_, &next_, &previous_}) v->resize(grid.cells());
    path_m_.resize(grid.cells());
    points_.resize(grid.cells());
    cells_ = {};
}

void Splitter::begin(const DepthGrid& grid, std::span<const uint32_t> cells) {
    fit(grid);
    for (const uint32_t cell : cells_) owner_[cell] = kOutside;  // of the last component
    std::copy(cells.begin(), cells.end(), members_.begin());
    grid_ = &grid;
    cells_ = {members_.data(), cells.size()};
    for (const uint32_t cell : cells) owner_[cell] = kFree;
}

void Splitter::queue(uint32_t cell, uint32_t effort) {
    uint32_t& first = buckets_[effort % kBuckets];
    effort_[cell] = effort;
    next_[cell] = first;
    previous_[cell] = kNone;
    if (first != kNone) previous_[first] = cell;
    first = cell;
    ++waiting_;
}

void Splitter::leave_queue(uint32_t cell) {
    const uint32_t before = previous_[cell], after = next_[cell];
    (before != kNone ? next_[before] : buckets_[effort_[cell] % kBuckets]) = after;
    if (after != kNone) previous_[after] = before;
    --waiting_;
}

// Offers the cell's neighbours its own seed.
void Splitter::offer(uint32_t cell, uint32_t x, uint32_t y, float farthest_m) {
    const uint32_t width = grid_->width(), height = grid_->height();
    const float* const depth = grid_->depth().data();
    const float z = depth[cell], same = grid_->same_surface_m(z), noise = grid_->sigma_m(z),
                side = grid_->cell_m(z);
    const auto visit = [&](uint32_t to, float way) {
        if (owner_[to] == kOutside || effort_[to] <= effort_[cell]) return;
        const float step = std::abs(depth[to] - z), path = path_m_[cell] + way;
        if (step > same || path > farthest_m) return;
        const float climb = kClimbWeight * std::max(0.0f, step - noise);
        const float cost = (kWayWeight * way + climb) / kEffortUnit_m;
        const uint32_t effort = effort_[cell] + std::min(uint32_t(cost) + 1, kBuckets - 1);
        if (effort >= effort_[to]) return;
        if (effort_[to] != kNone) leave_queue(to);
        owner_[to] = owner_[cell];
        path_m_[to] = path;
        queue(to, effort);
    };
    // As in Components, one cell without a reading is stepped over.
    const auto look = [&](uint32_t next, bool inside, uint32_t beyond, bool beyond_inside) {
        if (inside && depth[next] > 0.0f)
            visit(next, side);
        else if (inside && beyond_inside)
            visit(beyond, 2.0f * side);
    };
    look(cell - 1, x > 0, cell - 2, x > 1);
    look(cell + 1, x + 1 < width, cell + 2, x + 2 < width);
    look(cell - width, y > 0, cell - 2 * width, y > 1);
    look(cell + width, y + 1 < height, cell + 2 * width, y + 2 < height);
}

// Shortest ways from all seeds at once (Dijkstra 1959), queued in buckets of equal effort (Dial 1969).
void Splitter::grow(float farthest_m) {
    buckets_.fill(kNone);
    waiting_ = 0;
    for (const uint32_t cell : cells_) {
        path_m_[cell] = 0.0f;
        effort_[cell] = owner_[cell] == kFree ? kNone : 0;
    }
    grid_->for_each(cells_, [&](uint32_t cell, uint32_t x, uint32_t y) {
        if (effort_[cell] == 0) offer(cell, x, y, farthest_m);
    });
    for (uint32_t effort = 0; waiting_ > 0; ++effort)
        for (uint32_t cell; (cell = buckets_[effort % kBuckets]) != kNone;) {
            leave_queue(cell);
            offer(cell, cell % grid_->width(), cell / grid_->width(), farthest_m);
        }

    std::array<uint32_t, kMostSeeds + 2> counts{};
    for (const uint32_t cell : cells_) ++counts[owner_[cell]];
    starts_[0] = 0;
    for (size_t i = 0; i <= kMostSeeds; ++i) starts_[i + 1] = starts_[i] + counts[i];
    auto next = starts_;
    for (const uint32_t cell : cells_) sorted_[next[owner_[cell]]++] = cell;
}

std::span<const uint32_t> Splitter::piece(uint8_t number) const {
    return {sorted_.data() + starts_[number], starts_[number + 1u] - starts_[number]};
}

uint8_t Splitter::seed_heads(const ShapeMeter& meter, bool half_seen) {
    size_t count = 0;
    grid_->for_each(cells_, [&](uint32_t cell, uint32_t x, uint32_t y) {
        points_[count++] = Vec4(meter.world(x, y), grid_->area_m2(grid_->depth()[cell]));
    });
    const auto heads = finder_.run({points_.data(), count}, half_seen);
    static_assert(HeadFinder::kMost <= kMostSeeds);
    for (size_t i = 0; i < count; ++i) {
        // Of two heads, the one behind the other, the nearer to the axis.
        float least = kSeedDepth_m * kSeedDepth_m;
        for (size_t k = 0; k < heads.size(); ++k) {
            const float x = points_[i].x - heads[k].x_m, z = points_[i].z - heads[k].z_m,
                        away = x * x + z * z;
            if (std::abs(x) > kSeedHalf_m || away > least) continue;
            least = away;
            seed(cells_[i], uint8_t(k + 1));
        }
    }
    return uint8_t(heads.size());
}

}  // namespace vfit
