#include "track/splitter.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// Heads are looked for in the outline's upper edge, from a column of 4 cm to the next.
constexpr float kColumn_m = 0.04f;
constexpr int kColumns = 128;             // 5 m
constexpr float kHeadsApart_m = 0.28f;    // two people shoulder to shoulder, the one half behind the other
constexpr float kSameTop_m = 0.05f;       // below the peak: the crown, whose middle is the axis
constexpr int kCrownHalf = 3;             // columns
constexpr int kShoulderFrom = 3, kShoulderTo = 7;  // slices below the top
constexpr float kShoulder_m = 0.09f;      // breadth to either side of the axis; a raised arm has none outside
constexpr float kNeck_m = 0.10f;          // that the outline falls between two heads
constexpr float kLowestHead_m = 0.9f;
constexpr int kBodyHalf = 5;              // columns: 0.2 m to both sides of the axis
constexpr float kSlice_m = 0.10f;         // a body is looked for below the head slice by slice
constexpr int kSlices = 26;
constexpr float kLeastSlice_m = 0.07f;    // breadth: a shin
constexpr float kLeastTrunk_m = 0.55f;    // of slices in a row below the head
constexpr int kSeedHalf = 2;              // columns
constexpr float kSmoothShare = 0.35f;     // of same_surface_m: two sigma and a slant, 3 cm at 2.5 m

}  // namespace

void Splitter::fit(const DepthGrid& grid) {
    if (owner_.size() == grid.cells()) return;
    owner_.assign(grid.cells(), kOutside);
    members_.resize(grid.cells());
    queue_.resize(grid.cells());
    sorted_.resize(grid.cells());
    path_m_.resize(grid.cells());
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

void Splitter::spread(float farthest_m, float share) {
    const uint32_t width = grid_->width(), height = grid_->height();
    const float* const z = grid_->depth().data();
    size_t head = 0, tail = 0;
    for (const uint32_t cell : cells_)
        if (owner_[cell] != kFree) queue_[tail++] = cell;
    // First in, first out: all seeds advance by one cell in turn.
    while (head < tail) {
        const uint32_t cell = queue_[head++];
        const uint32_t x = cell % width, y = cell / width;
        const float same = share * same_surface_m(z[cell]), path = path_m_[cell] + grid_->cell_m(z[cell]);
        if (path > farthest_m) continue;
        const auto visit = [&](uint32_t next) {
            if (owner_[next] != kFree || std::abs(z[next] - z[cell]) > same) return;
            owner_[next] = owner_[cell];
            path_m_[next] = path;
            queue_[tail++] = next;
        };
        // As in Components, one cell without a reading is stepped over.
        if (x > 0) z[cell - 1] > 0.0f ? visit(cell - 1) : x > 1 ? visit(cell - 2) : void();
        if (x + 1 < width) z[cell + 1] > 0.0f ? visit(cell + 1) : x + 2 < width ? visit(cell + 2) : void();
        if (y > 0) z[cell - width] > 0.0f ? visit(cell - width) : y > 1 ? visit(cell - 2 * width) : void();
        if (y + 1 < height)
            z[cell + width] > 0.0f ? visit(cell + width) : y + 2 < height ? visit(cell + 2 * width) : void();
    }
}

void Splitter::grow(float farthest_m) {
    for (const uint32_t cell : cells_) path_m_[cell] = 0.0f;
    spread(farthest_m, kSmoothShare);
    spread(farthest_m, 1.0f);

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
    for (const uint32_t cell : cells_) {
        const Vec3 p = meter.world(cell);
        const int c = column_of(p);
        if (c < 0 || c >= kColumns) continue;
        top[size_t(c)] = std::max(top[size_t(c)], p.y);
        lowest = std::min(lowest, p.y);
        const int slice = int(std::floor(p.y / kSlice_m));
        if (slice >= 0 && slice < kSlices)
            filled[size_t(c * kSlices + slice)] += grid_->area_m2(grid_->depth()[cell]);
    }

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
        const int last_slice = std::min(kSlices, highest - kShoulderFrom);
        for (int slice = std::max(0, highest - kShoulderTo); slice < last_slice; ++slice)
            for (int k = 1; k <= kBodyHalf; ++k) {
                if (best - k >= 0) left += filled[size_t((best - k) * kSlices + slice)];
                if (best + k < kColumns) right += filled[size_t((best + k) * kSlices + slice)];
            }
        const float shoulder = kShoulder_m * kSlice_m * float(kShoulderTo - kShoulderFrom);
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
    for (const uint32_t cell : cells_) {
        const int c = column_of(meter.world(cell));
        for (uint8_t k = 0; k < count; ++k)
            if (std::abs(c - heads[k]) <= kSeedHalf) seed(cell, uint8_t(k + 1));
    }
    return count;
}

}  // namespace vfit
