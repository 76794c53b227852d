#include "track/splitter.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// Effort of a metre across, and of a metre climbed along the view beyond what noise does.
constexpr float kWayWeight = 0.3f, kClimbWeight = 4.0f;
constexpr float kEffortUnit_m = 0.25e-3f;

// Heads are looked for in the outline's upper edge, from a column of 4 cm to the next.
constexpr float kColumn_m = 0.04f;
constexpr int kColumns = 128;             // 5 m
constexpr float kHeadsApart_m = 0.28f;    // two people shoulder to shoulder, the one half behind the other
constexpr float kSameTop_m = 0.05f;       // below the peak: the crown, whose middle is the axis
constexpr int kCrownHalf = 3;             // columns
// Shoulders and elbows below the top, and the breadth there to either side of the axis, as shares of the height (ANSUR
// II, with a margin): a raised arm has none outside.
constexpr float kShoulderFrom = 0.18f, kShoulderTo = 0.41f, kShoulder = 0.052f;
constexpr float kNeck_m = 0.10f;          // that the outline falls between two heads
constexpr float kLowestHead_m = 0.9f;
constexpr int kBodyHalf = 5;              // columns: 0.2 m to both sides of the axis
constexpr float kSlice_m = 0.10f;         // a body is looked for below the head slice by slice
constexpr int kSlices = 26;
constexpr float kLeastSlice_m = 0.07f;    // breadth: a shin
constexpr float kLeastTrunk_m = 0.55f;    // of slices in a row below the head
constexpr int kSeedHalf = 2;              // columns
constexpr float kSeedDepth_m = 0.45f;     // before and behind the head: a trunk that leans, a foot set forward
constexpr float kHeadBelow_m = 0.2f;      // from the crown to the chin

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
    const float z = depth[cell], same = same_surface_m(z), noise = depth_sigma_m(z), side = grid_->cell_m(z);
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

uint8_t Splitter::seed_heads(const ShapeMeter& meter) {
    if (cells_.empty()) return 0;
    const float middle = meter.world(cells_[cells_.size() / 2]).x - 0.5f * kColumns * kColumn_m;
    const auto column_of = [&](const Vec3& p) { return int(std::floor((p.x - middle) / kColumn_m)); };

    // Upper edge of the outline, and breadth in each slice of each column.
    std::array<float, kColumns> top;
    top.fill(-1e9f);
    static_assert(kColumns * kSlices < 4096);
    std::array<float, kColumns * kSlices> filled{};  // m2
    float lowest = 1e9f;
    grid_->for_each(cells_, [&](uint32_t cell, uint32_t x, uint32_t y) {
        const Vec3 p = points_[cell] = meter.world(x, y);
        const int c = column_of(p);
        if (c < 0 || c >= kColumns) return;
        top[size_t(c)] = std::max(top[size_t(c)], p.y);
        lowest = std::min(lowest, p.y);
        const int slice = int(std::floor(p.y / kSlice_m));
        if (slice >= 0 && slice < kSlices)
            filled[size_t(c * kSlices + slice)] += grid_->area_m2(grid_->depth()[cell]);
    });

    std::array<int, kMostSeeds> heads{};
    uint8_t count = 0;
    std::array<bool, kColumns> tried{};
    while (count < kMostSeeds) {
        int best = -1;
        for (int c = 0; c < kColumns; ++c)
            if (!tried[size_t(c)] && top[size_t(c)] > kLowestHead_m &&
                (best < 0 || top[size_t(c)] > top[size_t(best)]))
                best = c;
        if (best < 0) break;
        const int peak = best;
        float middle_of_crown = 0.0f;
        int crown = 0;
        for (int c = std::max(0, peak - kCrownHalf); c <= std::min(kColumns - 1, peak + kCrownHalf); ++c)
            if (top[size_t(c)] > top[size_t(peak)] - kSameTop_m) {
                middle_of_crown += float(c);
                ++crown;
            }
        best = int(std::lround(middle_of_crown / float(crown)));
        // What belongs to this peak is not tried again.
        const int apart = int(kHeadsApart_m / kColumn_m);
        for (int c = std::max(0, peak - apart / 2); c <= std::min(kColumns - 1, peak + apart / 2); ++c)
            tried[size_t(c)] = true;

        bool separate = true;
        for (int k = 0; k < count && separate; ++k) {
            const int a = std::min(best, heads[size_t(k)]), b = std::max(best, heads[size_t(k)]);
            float valley = 1e9f;
            for (int c = a; c <= b; ++c) valley = std::min(valley, top[size_t(c)]);
            separate = b - a >= apart && valley < top[size_t(peak)] - kNeck_m;
        }
        if (!separate) continue;
        // A hand that is raised has no body below it, and no shoulder outside.
        const int highest = int(top[size_t(peak)] / kSlice_m);
        float left = 0.0f, right = 0.0f;
        const float tall = top[size_t(peak)];
        const int first_slice = std::max(0, highest - int(std::lround(kShoulderTo * tall / kSlice_m)));
        const int last_slice = std::min(kSlices, highest - int(std::lround(kShoulderFrom * tall / kSlice_m)));
        for (int slice = first_slice; slice < last_slice; ++slice)
            for (int k = 1; k <= kBodyHalf; ++k) {
                if (best - k >= 0) left += filled[size_t((best - k) * kSlices + slice)];
                if (best + k < kColumns) right += filled[size_t((best + k) * kSlices + slice)];
            }
        const float shoulder = kShoulder * tall * kSlice_m * float(last_slice - first_slice);
        if (left < shoulder || right < shoulder) continue;
        float trunk = 0.0f;
        const float breadth_area = kLeastSlice_m * kSlice_m;
        for (int slice = std::min(highest, kSlices) - 1; slice >= 0; --slice) {
            float area = 0.0f;
            for (int c = std::max(0, best - kBodyHalf); c <= std::min(kColumns - 1, best + kBodyHalf); ++c)
                area += filled[size_t(c * kSlices + slice)];
            if (area < breadth_area) break;
            trunk += kSlice_m;
        }
        const float wanted = std::max(kLeastTrunk_m, 0.75f * (top[size_t(peak)] - std::max(0.0f, lowest)));
        if (trunk < wanted && trunk < 0.9f * top[size_t(peak)] - 0.3f) continue;
        heads[count++] = best;
    }
    // Who stands behind another's head is not below it.
    std::array<float, kMostSeeds> depth{}, weight{};
    const auto each_seed = [&](const auto& visit) {
        for (const uint32_t cell : cells_) {
            const Vec3& p = points_[cell];
            const int c = column_of(p);
            for (uint8_t k = 0; k < count; ++k)
                if (std::abs(c - heads[k]) <= kSeedHalf) visit(cell, p, k);
        }
    };
    each_seed([&](uint32_t, const Vec3& p, uint8_t k) {
        if (p.y < top[size_t(heads[k])] - kHeadBelow_m) return;
        depth[k] += p.z;
        weight[k] += 1.0f;
    });
    each_seed([&](uint32_t cell, const Vec3& p, uint8_t k) {
        if (std::abs(p.z - depth[k] / weight[k]) < kSeedDepth_m) seed(cell, uint8_t(k + 1));
    });
    return count;
}

}  // namespace vfit
