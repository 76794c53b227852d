#include "track/person_shape.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr float kBin_m = 0.025f;   // 160 of them: 4 m of height, and 2 m to both sides
constexpr int kTopBins = 8;        // 20 cm
constexpr int kBorderCells = 2;    // an image border is rarely straight
constexpr size_t kSample = 1024;   // cells
constexpr uint32_t kFewCells = 2;  // above which there is only speckle
constexpr float kLegsFrom_m = 0.2f, kLegsTo_m = 0.6f;

// A standing or sitting person. Statures and breadths: ANSUR II (smallest woman to largest man), with a
// margin for children, shoes, hats and loose clothes. Areas seen by the camera: 0.35 m2 is a slim person from
// the side, 1 m2 a heavy one from the front; a part of a person is no less than head and shoulders.
constexpr float kShortest_m = 0.9f, kTallest_m = 2.35f;
constexpr float kFeetBelow_m = 0.35f;
constexpr float kLeastArea_m2 = 0.12f, kLeastPart_m2 = 0.085f, kLeastBehind_m2 = 0.15f, kMostArea_m2 = 1.5f;
constexpr float kLeastPart_m = 0.4f;
constexpr float kWidestTrunk_m = 0.85f, kNarrowest_m = 0.14f, kThickest_m = 1.1f;
constexpr float kFlat_m = 0.014f;      // a trunk's front alone bends by more than 3 cm
constexpr float kFlatNoise = 1.2f;     // of what noise makes of a plane
constexpr float kFlatArea_m2 = 0.15f;  // below, a flat thing may be a forearm
constexpr float kMostTop_m2 = 0.085f;  // head with hair or hat: 0.05; a box as wide as a trunk: 0.1
constexpr float kLeastLegs_m = 0.07f;  // one shin; a coat rack's pole is 3 to 5 cm

/// Smallest eigenvalue of a symmetric matrix (trigonometric solution of its characteristic cubic).
double least_eigenvalue(const std::array<double, 6>& m) {
    const double xx = m[0], xy = m[1], xz = m[2], yy = m[3], yz = m[4], zz = m[5];
    const double q = (xx + yy + zz) / 3.0;
    const double off = xy * xy + xz * xz + yz * yz;
    const double p2 = (xx - q) * (xx - q) + (yy - q) * (yy - q) + (zz - q) * (zz - q) + 2.0 * off;
    const double p = std::sqrt(p2 / 6.0);
    if (p < 1e-12) return q;
    const double a = (xx - q) / p, b = (yy - q) / p, c = (zz - q) / p, d = xy / p, e = xz / p, f = yz / p;
    const double half = 0.5 * (a * (b * c - f * f) - d * (d * c - f * e) + e * (d * f - b * e));
    const double angle = std::acos(std::clamp(half, -1.0, 1.0)) / 3.0;
    return q + 2.0 * p * std::cos(angle + 2.0 * 3.14159265358979 / 3.0);
}

template <typename Bins>
float quantile_bin(const Bins& bins, float total, float share) {
    float sum = 0.0f;
    for (size_t i = 0; i < bins.size(); ++i) {
        if (sum + bins[i] > share * total) return float(i) + (share * total - sum) / bins[i];
        sum += bins[i];
    }
    return float(bins.size());
}

}  // namespace

ShapeMeter::ShapeMeter(const DepthGrid& grid, const Camera& camera, const std::array<int, 4>& view)
    : grid_(grid), rotation_(camera.world_from_camera()), floor_m_(camera.floor_distance_m), view_(view) {
    const Vec3& up = camera.floor_normal;
    down_ = std::abs(up.y) >= std::abs(up.x) ? (up.y < 0 ? int(grid.width()) : -int(grid.width()))
                                             : (up.x < 0 ? 1 : -1);
    start();
}

void ShapeMeter::start() {
    shape_ = {};
    shape_.x0 = shape_.y0 = 1 << 20;
    heights_.fill(0.0f);
    across_.fill(0.0f);
    along_.fill(0.0f);
    height_cells_.fill(0);
    sum_ = Vec3(0.0f);
    products_.fill(0.0);
    sides_ = 0;
}

void ShapeMeter::add(std::span<const uint32_t> cells) {
    if (cells.empty()) return;
    // Bins and products are taken around a point of the set: floats keep millimetres there.
    if (shape_.cells == 0) {
        const uint32_t middle = cells[cells.size() / 2];
        origin_ = world(middle % grid_.width(), middle / grid_.width());
    }
    const Vec3 offset = Vec3(0, floor_m_, 0) - origin_;
    // Extent in the image and height are of all cells; sums and breadths, of a large set, of a sample that is
    // enough.
    const size_t step = std::max<size_t>(1, cells.size() / kSample);
    size_t turn = 0;
    int left = shape_.x0, right = shape_.x1;
    float area_sum = 0.0f, depth_sum = 0.0f, legs = 0.0f;
    Vec3 sum(0.0f);
    std::array<float, 6> products{};
    const auto bin = [](float v) {
        return size_t(std::clamp(int(v * (1.0f / kBin_m) + 0.5f * kBins), 0, kBins - 1));
    };
    grid_.for_each(cells, [&](uint32_t cell, uint32_t x, uint32_t y) {
        left = std::min(left, int(x));
        right = std::max(right, int(x) + 1);
        const Vec3 r = rotation_ * grid_.point(x, y) + offset;
        // The floor of a camera that knows none may lie anywhere: heights are binned around the origin too.
        const size_t level = bin(r.y);
        ++height_cells_[level];
        if (++turn < step) return;
        turn = 0;
        const float z = grid_.depth()[cell], area = grid_.area_m2(z) * float(step);
        heights_[level] += area;
        across_[bin(r.x)] += area;
        along_[bin(r.z)] += area;
        sum += area * r;
        area_sum += area;
        depth_sum += area * z;
        products[0] += area * r.x * r.x;
        products[1] += area * r.x * r.y;
        products[2] += area * r.x * r.z;
        products[3] += area * r.y * r.y;
        products[4] += area * r.y * r.z;
        products[5] += area * r.z * r.z;
        const float h = r.y + origin_.y;
        legs += h >= kLegsFrom_m && h < kLegsTo_m ? area : 0.0f;
    });
    shape_.x0 = left, shape_.x1 = right;
    shape_.y0 = std::min(shape_.y0, int(cells.front() / grid_.width()));
    shape_.y1 = std::max(shape_.y1, int(cells.back() / grid_.width()) + 1);
    shape_.area_m2 += area_sum;
    shape_.depth_m += depth_sum;
    shape_.leg_width_m += legs / (kLegsTo_m - kLegsFrom_m);
    sum_ += sum;
    for (size_t i = 0; i < products.size(); ++i) products_[i] += double(products[i]);
    shape_.cells += uint32_t(cells.size());
}

Shape ShapeMeter::finish() {
    Shape& s = shape_;
    if (s.cells == 0) return s;
    constexpr float kMiddle = 0.5f * kBins * kBin_m;
    const float total = s.area_m2;
    const Vec3 mean = sum_ / total;
    s.centre = origin_ + mean;
    s.depth_m /= total;
    s.sigma_m = grid_.sigma_m(s.depth_m);
    std::array<double, 6> m = products_;
    for (double& v : m) v /= total;
    m[0] -= double(mean.x) * mean.x;
    m[1] -= double(mean.x) * mean.y;
    m[2] -= double(mean.x) * mean.z;
    m[3] -= double(mean.y) * mean.y;
    m[4] -= double(mean.y) * mean.z;
    m[5] -= double(mean.z) * mean.z;
    s.flatness_m = float(std::sqrt(std::max(0.0, least_eigenvalue(m))));

    const auto spread = [&](const Histogram& bins, float share) {
        return (quantile_bin(bins, total, 1.0f - share) - quantile_bin(bins, total, share)) * kBin_m;
    };
    s.width_m = spread(across_, 0.05f);
    s.trunk_width_m = spread(across_, 0.15f);
    s.thickness_m = spread(along_, 0.05f);
    int lowest = 0, highest = kBins - 1;
    while (lowest < highest && height_cells_[size_t(lowest)] < kFewCells) ++lowest;
    while (highest > lowest && height_cells_[size_t(highest)] < kFewCells) --highest;
    s.low_m = origin_.y - kMiddle + float(lowest) * kBin_m;
    s.high_m = origin_.y - kMiddle + float(highest + 1) * kBin_m;
    for (int i = std::max(0, highest - kTopBins + 1); i <= highest; ++i) s.top_area_m2 += heights_[size_t(i)];

    // Image borders as the upright person sees them.
    const int width = int(grid_.width());
    const bool left = s.x0<view_[0] + kBorderCells, right = s.x1> view_[2] - kBorderCells;
    const bool top = s.y0<view_[1] + kBorderCells, bottom = s.y1> view_[3] - kBorderCells;
    const auto flag = [](bool on, uint32_t bit) { return on ? bit : 0u; };
    if (down_ == width)
        s.out_of_view = flag(left, kOutOfViewLeft) | flag(right, kOutOfViewRight) | flag(top, kOutOfViewTop) |
                        flag(bottom, kOutOfViewFeet);
    else if (down_ == -width)
        s.out_of_view = flag(right, kOutOfViewLeft) | flag(left, kOutOfViewRight) |
                        flag(bottom, kOutOfViewTop) | flag(top, kOutOfViewFeet);
    else if (down_ == 1)
        s.out_of_view = flag(bottom, kOutOfViewLeft) | flag(top, kOutOfViewRight) |
                        flag(left, kOutOfViewTop) | flag(right, kOutOfViewFeet);
    else
        s.out_of_view = flag(top, kOutOfViewLeft) | flag(bottom, kOutOfViewRight) |
                        flag(right, kOutOfViewTop) | flag(left, kOutOfViewFeet);
    return s;
}

bool is_flat(const Shape& s) {
    return s.flatness_m < kFlatNoise * std::hypot(kFlat_m, s.sigma_m) && s.area_m2 > kFlatArea_m2;
}

bool looks_like_person(const Shape& s, bool floor_known, bool feet_hidden) {
    const bool feet_cut = feet_hidden || (s.out_of_view & kOutOfViewFeet) != 0;
    const bool cut = feet_cut || s.out_of_view != 0;
    if (s.area_m2 < (cut ? kLeastPart_m2 : kLeastArea_m2) || s.area_m2 > kMostArea_m2) return false;
    if (s.trunk_width_m > kWidestTrunk_m || s.thickness_m > kThickest_m) return false;
    if (s.width_m < kNarrowest_m) return false;
    if (feet_hidden && s.area_m2 < kLeastBehind_m2) return false;
    if (is_flat(s)) return false;
    if (!(s.out_of_view & kOutOfViewTop) && s.top_area_m2 > kMostTop_m2) return false;
    if (s.height_m() < (cut ? kLeastPart_m : kShortest_m)) return false;
    if (s.height_m() > kTallest_m) return false;
    if (!floor_known) return true;
    if (s.high_m > kTallest_m) return false;
    if (s.high_m < kShortest_m && !(s.out_of_view & kOutOfViewTop)) return false;
    if (!feet_cut && s.low_m > kFeetBelow_m) return false;
    if (!feet_cut && s.leg_width_m < kLeastLegs_m) return false;
    return true;
}

}  // namespace vfit
