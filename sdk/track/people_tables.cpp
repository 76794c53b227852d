// The part of PeopleMap that cuts table tops out of what stands at them: level surfaces, as the floor is one.
#include <array>
#include <cmath>

#include "track/people_map.h"

namespace vfit {

namespace {

// Heights of seats, tables and counters; a lap, and two forearms ahead, show 0.04 m2 to the camera.
constexpr float kLowest_m = 0.3f, kHighest_m = 1.3f, kBin_m = 0.025f;
constexpr int kBins = int((kHighest_m - kLowest_m) / kBin_m) + 1;
constexpr float kMinTop_m2 = 0.06f;
constexpr int kReach = 3;                // cells up and down the image, between which heights are compared
constexpr float kLevel = 0.33f;          // of what an upright surface rises there
constexpr float kLevelSlack_m = 0.004f;  // of noise

}  // namespace

std::span<const uint32_t> PeopleMap::without_tables(std::span<const uint32_t> cells) {
    if (camera_.floor_state == VFIT_FLOOR_DEFAULT) return cells;
    const ShapeMeter meter(grid_, camera_, {});
    const int down = meter.down(), width = int(grid_.width()), height = int(grid_.height());
    const int dx = std::abs(down) == 1 ? down * kReach : 0, dy = dx ? 0 : down / width * kReach;
    const auto bin_of = [&](int x, int y) {
        if (x - std::abs(dx) < 0 || y - std::abs(dy) < 0 || x + std::abs(dx) >= width ||
            y + std::abs(dy) >= height)
            return -1;
        const float z = grid_.depth()[size_t(y * width + x)];
        if (grid_.depth()[size_t((y + dy) * width + x + dx)] == 0.0f ||
            grid_.depth()[size_t((y - dy) * width + x - dx)] == 0.0f)
            return -1;
        const float upper = meter.world(uint32_t(x - dx), uint32_t(y - dy)).y,
                    lower = meter.world(uint32_t(x + dx), uint32_t(y + dy)).y;
        if (std::abs(upper - lower) > kLevel * 2.0f * kReach * grid_.cell_m(z) + kLevelSlack_m) return -1;
        const float at = meter.world(uint32_t(x), uint32_t(y)).y;
        return at < kLowest_m || at >= kHighest_m ? -1 : int((at - kLowest_m) / kBin_m);
    };
    std::array<float, kBins + 2> area{};
    grid_.for_each(cells, [&](uint32_t cell, uint32_t x, uint32_t y) {
        const int bin = bin_of(int(x), int(y));
        if (bin >= 0) area[size_t(bin) + 1] += grid_.area_m2(grid_.depth()[cell]);
    });
    std::array<bool, kBins + 2> top{};
    bool any = false;
    for (size_t b = 1; b <= kBins; ++b)
        if (area[b - 1] + area[b] + area[b + 1] > kMinTop_m2) top[b - 1] = top[b] = top[b + 1] = any = true;
    if (!any) return cells;
    const std::span<uint32_t> room(pool_.data() + pool_used_, cells.size());
    size_t kept = 0;
    grid_.for_each(cells, [&](uint32_t cell, uint32_t x, uint32_t y) {
        const int bin = bin_of(int(x), int(y));
        if (bin >= 0 && top[size_t(bin) + 1]) {
            wanted_[cell] = 0;
            background_.add(grid_, cell);
        } else {
            room[kept++] = cell;
        }
    });
    pool_used_ += kept;
    return room.first(kept);
}

}  // namespace vfit
