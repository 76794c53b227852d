#include "track/life_signs.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// Five bins: two thirds of a second. A person who stands quietly moves by 2 to 5 mm in that time (speed of
// the centre of mass: Winter 1995, 3 to 8 mm/s), and never along a straight line that a sensor could not see.
constexpr float kBin_s = 0.13f;
constexpr uint32_t kBlock = 16;        // cells along a side; the mean of so many has a noise of about 0.3 mm
constexpr uint32_t kFewestCells = 48;  // of a block
constexpr uint32_t kFewestBlocks = 4;
constexpr float kSteadyShare = 0.6f;                   // of the cells: fewer, and it moves about
constexpr float kSmallest_m = 0.0005f;                 // movement, root of its power; sensors drift by less
constexpr float kSameImage_m = 1e-5f;                  // noise; less than this is of rounding sums
constexpr float kMedian = 1.386f;                      // of the sum of two squared normal deviates
constexpr float kCommon = 3.3f, kSurelyCommon = 8.0f;  // of the noise: 1 in 100, none
constexpr float kSure = 2.5f, kSurer = 6.0f;  // standard deviations of a ratio; of what has been lifeless
constexpr float kStill_s = 2.0f * kBin_s - 0.01f;  // verdicts in a row
// What is put down moves for a last second. A person who has lived for longer may hold their breath for twice
// the rest.
constexpr float kSettles_s = 1.0f, kMaxPatience_s = 5.0f;

/// Orthogonal polynomials over five bins: what is slow is movement, what is fast is noise.
constexpr double kSlow[2][5] = {{-2, -1, 0, 1, 2}, {2, -1, -2, -1, 2}};
constexpr double kSlowNorm[2] = {10, 14};
constexpr double kFast[2][5] = {{-1, 2, 0, -2, 1}, {1, -4, 6, -4, 1}};
constexpr double kFastNorm[2] = {10, 70};

}  // namespace

void LifeSigns::fit(const DepthGrid& grid) {
    if (grid.width() == width_ && grid.height() == height_) return;
    width_ = grid.width(), height_ = grid.height();
    for (auto& sums : sums_) sums.assign(grid.cells(), 0.0f);
    for (auto& owners : owners_) owners.assign(grid.cells(), 0);
    const size_t blocks = size_t(width_ / kBlock) * (height_ / kBlock);
    blocks_.reserve(blocks), values_.reserve(blocks);
    reset();
}

void LifeSigns::reset() {
    people_.fill({});
    images_.fill(0);
    bin_ = 0, bin_s_ = 0.0f;
}

void LifeSigns::see(const DepthGrid& grid, const std::vector<uint8_t>& slots,
                    const std::array<uint32_t, kSlots>& ids, float dt_s) {
    fit(grid);
    for (uint32_t slot = 0; slot < kSlots; ++slot)
        if (people_[slot].id != ids[slot]) people_[slot] = {}, people_[slot].id = ids[slot];
    bin_s_ += dt_s;
    if (images_[size_t(bin_)] > 0 && bin_s_ >= kBin_s - 1e-3f) close_bin(slots);
    auto& sums = sums_[size_t(bin_)];
    auto& owners = owners_[size_t(bin_)];
    if (images_[size_t(bin_)]++ == 0) {
        std::copy(slots.begin(), slots.end(), owners.begin());
        std::copy(grid.depth().begin(), grid.depth().begin() + std::ptrdiff_t(grid.cells()), sums.begin());
        return;
    }
    for (size_t i = 0; i < grid.cells(); ++i) {  // without branches, for vectors
        owners[i] = uint8_t(owners[i] == slots[i] ? slots[i] : 0);
        sums[i] += grid.depth()[i];
    }
}

void LifeSigns::close_bin(const std::vector<uint8_t>& slots) {
    if (std::all_of(images_.begin(), images_.end(), [](uint32_t n) { return n > 0; })) {
        measure(slots);
        for (uint32_t slot = 0; slot < kSlots; ++slot)
            if (people_[slot].id != 0) judge(slot);
    }
    bin_ = (bin_ + 1) % kBins;
    images_[size_t(bin_)] = 0;
    bin_s_ = 0.0f;
}

void LifeSigns::measure(const std::vector<uint8_t>& slots) {
    cells_.fill({});
    blocks_.clear();
    for (uint32_t top = 0; top + kBlock <= height_; top += kBlock)
        for (uint32_t left = 0; left + kBlock <= width_; left += kBlock) add_block(slots, left, top);
}

/// A block is of the slot of its first cell that has one.
void LifeSigns::add_block(const std::vector<uint8_t>& slots, uint32_t left, uint32_t top) {
    const auto steady = [&](size_t i, uint8_t slot) {
        return std::all_of(owners_.begin(), owners_.end(),
                           [&](const auto& owners) { return owners[i] == slot; });
    };
    std::array<double, kBins> sum{};
    float slope = 0.0f;
    uint32_t cells = 0;
    uint8_t slot = 0;
    for (uint32_t y = top; y < top + kBlock; ++y)
        for (uint32_t x = left; x < left + kBlock; ++x) {
            const size_t i = size_t(y) * width_ + x;
            const uint8_t own = slots[i];
            if (own == 0 || x == 0 || y == 0 || x + 1 == width_ || y + 1 == height_) continue;
            ++cells_[own - 1u].all;
            if (!steady(i, own)) continue;
            ++cells_[own - 1u].steady;
            // Readings at an outline are of both sides.
            const bool inside = slots[i - 1] == own && slots[i + 1] == own && slots[i - width_] == own &&
                                slots[i + width_] == own;
            if (!inside || (slot != 0 && own != slot)) continue;
            slot = own;
            for (size_t k = 0; k < kBins; ++k) sum[k] += double(sums_[k][i]);
            slope += (sums_[0][i + 1] - sums_[0][i - 1]) / (2.0f * float(images_[0]));
            ++cells;
        }
    if (cells < kFewestCells) return;
    std::array<double, kBins> mean;  // from the oldest on
    for (size_t k = 0; k < kBins; ++k) {
        const size_t bin = (size_t(bin_) + 1 + k) % kBins;
        mean[k] = sum[bin] / (double(cells) * images_[bin]);
    }
    const auto along = [&](const double(&polynomial)[kBins], double norm) {
        double product = 0.0;
        for (size_t k = 0; k < kBins; ++k) product += polynomial[k] * mean[k];
        return float(product / std::sqrt(norm));
    };
    Power power;
    power.slot = slot;
    power.slope = slope / float(cells);
    power.move = {along(kSlow[0], kSlowNorm[0]), along(kSlow[1], kSlowNorm[1])};
    const float fast[2] = {along(kFast[0], kFastNorm[0]), along(kFast[1], kFastNorm[1])};
    power.slow = power.move[0] * power.move[0] + power.move[1] * power.move[1];
    power.fast = fast[0] * fast[0] + fast[1] * fast[1];
    blocks_.push_back(power);
}

float LifeSigns::median(uint32_t slot, float Power::* of) {
    values_.clear();
    for (const Power& block : blocks_)
        if (block.slot == slot + 1) values_.push_back(block.*of);
    const auto middle = values_.begin() + std::ptrdiff_t(values_.size() / 2);
    std::nth_element(values_.begin(), middle, values_.end());
    return *middle;
}

/// Of a movement that all blocks share, along the view and across it: a step aside moves what slopes to the
/// left and to the right the opposite ways. Mean power of a degree of freedom, as of one block's noise.
float LifeSigns::common_power(uint32_t slot) const {
    std::array<float, 2> ahead{}, aside{};
    float weight = 0.0f, count = 0.0f, mean = 0.0f;
    for (const Power& b : blocks_)
        if (b.slot == slot + 1) mean += b.slope, ++count;
    mean /= count;
    for (const Power& b : blocks_) {
        if (b.slot != slot + 1) continue;
        const float slope = b.slope - mean;
        weight += slope * slope;
        for (size_t p = 0; p < 2; ++p) ahead[p] += b.move[p], aside[p] += slope * b.move[p];
    }
    float power = (ahead[0] * ahead[0] + ahead[1] * ahead[1]) / count;
    if (weight > 0.0f) power += (aside[0] * aside[0] + aside[1] * aside[1]) / weight;
    return 0.25f * power;
}

/// Movement stands out of the noise. Of all blocks the median is taken: limbs that move fast are noise to a
/// sum.
bool LifeSigns::stirs(uint32_t slot, bool sure) {
    const float slow = median(slot, &Power::slow), fast = median(slot, &Power::fast);
    const float ratio = 1.0f + (sure ? kSurer : kSure) * std::sqrt(2.0f / float(values_.size()));
    if (slow > ratio * fast && slow - fast > kSmallest_m * kSmallest_m) return true;
    const float noise = fast / kMedian;
    const float excess = common_power(slot) - (sure ? kSurelyCommon : kCommon) * noise;
    return excess > 0.0f && excess > kSmallest_m * kSmallest_m;
}

void LifeSigns::judge(uint32_t slot) {
    Person& person = people_[slot];
    const auto count = size_t(
        std::count_if(blocks_.begin(), blocks_.end(), [&](const Power& b) { return b.slot == slot + 1; }));
    const bool rests =
        count >= kFewestBlocks && float(cells_[slot].steady) >= kSteadyShare * float(cells_[slot].all);
    // A picture that is shown again and again has no noise, and says nothing.
    if (rests && median(slot, &Power::fast) < kSameImage_m * kSameImage_m) return;
    const bool stirred = !rests || stirs(slot, person.lifeless);
    if (rests && stirred) person.alive_s = std::min(person.alive_s + kBin_s, kMaxPatience_s);
    const bool lives = stirred && (!person.lifeless || person.stirred);
    person.stirred = stirred;
    if (lives) {
        person.still_s = 0.0f;
        person.lifeless = false;
    } else {
        person.still_s += kBin_s;
        const float patience =
            std::max(kStill_s, std::min(2.0f * (person.alive_s - kSettles_s), kMaxPatience_s));
        person.lifeless = person.still_s >= patience;
    }
}

}  // namespace vfit
