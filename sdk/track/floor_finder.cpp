#include "track/floor_finder.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr uint32_t kSampleStep = 4;  // cells between samples: 80 x 60 of them for a 640 x 480 image
constexpr float kFarthest_m = 6.0f;  // beyond, a reading of a structured-light camera says nothing
constexpr float kSigmas = 2.5f;      // taken for the floor: 99 % of its readings
constexpr float kUneven_m = 0.012f;  // carpets, tiles and the bow of a real floor
constexpr float kThings = 0.3f;      // of that band: above, feet and cables begin
constexpr double kThingsWeight = 0.3;
constexpr float kBelow_m = 0.10f;  // a table has readings below it, a floor has none

// Where a camera for people can stand and look.
constexpr float kLowest_m = 0.1f, kHighest_m = 4.0f;
constexpr float kMostTilt_rad = 50.0f * kPi / 180.0f,
                kMostRoll_rad = 40.0f * kPi / 180.0f;  // from what is taken for up

constexpr uint32_t kTries = 400;        // finds a floor of 5 % of the samples in 99 of 100 frames
constexpr int kWindow = 12;             // samples: the three of a try lie on one surface more often than not
constexpr float kFewestShare = 0.012f;  // of the image: a strip below the feet
constexpr uint32_t kFewest = 40;        // samples
constexpr float kNarrowest_m = 1.2f;    // a table's corner or a person's back is smaller
constexpr float kBeside_m = 0.1f;       // a plane that slopes another way is a band's height off there
constexpr uint32_t kBeside = 2;         // samples, at least
constexpr float kLevel = 0.35f;         // of the neighbours: floors have 0.8 to 1, shiny ones half of it
constexpr float kMostBelow = 0.08f;  // readings below the plane per reading on it: beside tables 0.17 to 0.3
constexpr uint32_t kBlock = 5;       // samples: what a shiny floor shows of itself lies so close together
constexpr double kMemory = 0.9;      // of the last frame's sums: a third of a second at 30 Hz
// After the first frame: this many tries now and then, so that no frame takes longer than others, until they
// show that a whole search is worth it. While a floor is seen, a better one may come into view.
constexpr uint32_t kFewTries = 24;
constexpr uint32_t kLeastRest = 4,
                   kMostRest = 64;  // frames after a whole search, longer each time it was in vain
constexpr uint32_t kLookAgain = 4;  // frames, while a floor is seen
constexpr float kBetter = 1.5f;

bool plausible(const Vec3& plane, const Vec3& up) {
    const float length = glm::length(plane);
    if (!(length > 1.0f / kHighest_m && length < 1.0f / kLowest_m)) return false;
    const Vec3 normal = -plane / length;
    if (std::abs(normal.z) > std::sin(kMostTilt_rad)) return false;
    const float along = normal.x * up.x + normal.y * up.y, across = normal.x * up.y - normal.y * up.x;
    return std::abs(std::atan2(across, along)) < kMostRoll_rad;
}

}  // namespace

void FloorFinder::Sums::add(const Sample& s, double weight) {
    const double x = s.x, y = s.y, v = s.inverse;
    product[0] += weight * x * x;
    product[1] += weight * x * y;
    product[2] += weight * x;
    product[3] += weight * y * y;
    product[4] += weight * y;
    product[5] += weight;
    side[0] += weight * x * v;
    side[1] += weight * y * v;
    side[2] += weight * v;
}

void FloorFinder::Sums::decay(double share) {
    for (double& p : product) p *= share;
    for (double& s : side) s *= share;
}

bool FloorFinder::Sums::solve(Plane& plane) const {
    const auto& p = product;
    const glm::dmat3 m(p[0], p[1], p[2], p[1], p[3], p[4], p[2], p[4], p[5]);
    // A single line of readings leaves the plane's slope across it open.
    if (!(std::abs(glm::determinant(m)) > 1e-9 * p[5] * p[5] * p[5])) return false;
    plane = Plane(glm::inverse(m) * glm::dvec3(side[0], side[1], side[2]));
    return true;
}

void FloorFinder::reset() {
    found_ = false;
    frames_ = next_search_ = 0;
    rest_ = kLeastRest;
    seed_ = 0;
}

uint32_t FloorFinder::random(uint32_t below) {
    seed_ = seed_ * 6364136223846793005ull + 1442695040888963407ull;  // Knuth, MMIX
    return uint32_t((seed_ >> 33) * below >> 31);
}

// The cells of each square of samples take turns, so that all of them serve in sixteen frames.
void FloorFinder::take_samples(const DepthGrid& grid, uint32_t turn) {
    columns_ = std::max(1u, grid.width() / kSampleStep);
    rows_ = std::max(1u, grid.height() / kSampleStep);
    for (auto* v : {&x_, &y_, &inverse_}) v->resize(size_t(columns_) * rows_);
    for (uint32_t y = 0; y < rows_; ++y) {
        const uint32_t cy = std::min(y * kSampleStep + turn % kSampleStep, grid.height() - 1);
        const float* const depth = grid.depth().data() + size_t(cy) * grid.width();
        for (uint32_t x = 0; x < columns_; ++x) {
            const uint32_t cx =
                std::min(x * kSampleStep + turn / kSampleStep % kSampleStep, grid.width() - 1);
            const float z = depth[cx];
            const size_t i = size_t(y) * columns_ + x;
            x_[i] = grid.ray_x()[cx];
            y_[i] = grid.ray_y()[cy];
            inverse_[i] = z > 0.0f && z < kFarthest_m ? 1.0f / z : 0.0f;
        }
    }
}

// Height of a sample above the plane, in units of its own depth: h / z = d (1/z - a . r).
float FloorFinder::score(const Plane& plane) const {
    const float d = 1.0f / glm::length(plane), noise = kSigmas * kInverseDepthSigma * d;
    const Plane a = plane * d;
    int32_t on = 0, below = 0;
    for (size_t i = 0; i < inverse_.size(); ++i) {  // without branches, for vectors
        const float inverse = inverse_[i], h = d * inverse - a.x * x_[i] - a.y * y_[i] - a.z;
        const float band = kUneven_m * inverse + noise;
        const int32_t valid = inverse > 0.0f;
        on += valid & int32_t(std::abs(h) < band);
        below += valid & int32_t(h < -(band + kBelow_m * inverse));
    }
    const float fewest = std::max(float(kFewest), kFewestShare * float(inverse_.size()));
    if (float(on) < fewest) return 0.0f;
    if (float(below) > kMostBelow * float(on)) below = below_beside(plane);
    if (float(below) > kMostBelow * float(on)) return 0.0f;
    return float(on) - float(below);
}

// How wide what is seen of the plane is, the way it is wider: four times the deviation from its middle. Where
// a plane cuts through walls, strips of readings lie on it, but slope another way: across the strip their
// neighbours leave the plane. On a floor, neighbours lie on it in every direction, among a shiny one's
// mirrored readings, too.
float FloorFinder::extent_m(const Plane& plane) const {
    const float d = 1.0f / glm::length(plane), noise = kSigmas * kInverseDepthSigma * d;
    const Plane a = plane * d;
    float count = 0.0f;
    Vec3 sum(0.0f), squares(0.0f);
    std::array<float, 2> beside{}, level{};  // neighbours along rows and columns: all; those that are level
    const auto height = [&](size_t i) { return d * inverse_[i] - a.x * x_[i] - a.y * y_[i] - a.z; };
    // Samples per unit of ray. An image of one column has no neighbours.
    const float per_ray = columns_ > 1 ? float(columns_ - 1) / (x_[columns_ - 1] - x_[0]) : 0.0f;
    const auto farthest = float(columns_ + rows_);
    for (uint32_t y = 0; y < rows_; ++y)
        for (uint32_t x = 0; x < columns_; ++x) {
            const size_t i = size_t(y) * columns_ + x;
            const float inverse = inverse_[i], h = height(i), band = kUneven_m * inverse + noise;
            if (inverse <= 0.0f || std::abs(h) > band) continue;
            const uint32_t step =
                std::max(kBeside, uint32_t(std::min(farthest, kBeside_m * inverse * per_ray)));
            const Vec3 p = Vec3(x_[i], y_[i], 1.0f) / inverse;
            sum += p, squares += p * p, count += 1.0f;
            const auto look = [&](size_t axis, size_t other) {
                if (inverse_[other] <= 0.0f) return;
                beside[axis] += 1.0f;
                level[axis] += std::abs(height(other) - h) < band ? 1.0f : 0.0f;
            };
            if (x + step < columns_) look(0, i + step);
            if (y + step < rows_) look(1, i + size_t(step) * columns_);
        }
    if (count == 0.0f || level[0] < kLevel * beside[0] || level[1] < kLevel * beside[1]) return 0.0f;
    const Vec3 mean = sum / count, variance = squares / count - mean * mean;
    return 4.0f * std::sqrt(std::max(0.0f, variance.x + variance.y + variance.z));
}

// A shiny floor shows the room mirrored below it, among its own readings: those are no evidence against it.
// What is seen below a table is seen beside it.
int32_t FloorFinder::below_beside(const Plane& plane) const {
    const float d = 1.0f / glm::length(plane), noise = kSigmas * kInverseDepthSigma * d;
    int32_t count = 0;
    for (uint32_t top = 0; top < rows_; top += kBlock)
        for (uint32_t left = 0; left < columns_; left += kBlock) {
            int32_t on = 0, below = 0;
            for (uint32_t y = top; y < std::min(top + kBlock, rows_); ++y)
                for (uint32_t x = left; x < std::min(left + kBlock, columns_); ++x) {
                    const Sample s = sample(size_t(y) * columns_ + x);
                    if (s.inverse <= 0.0f) continue;
                    const float h = d * (s.inverse - plane.x * s.x - plane.y * s.y - plane.z);
                    const float band = kUneven_m * s.inverse + noise;
                    on += std::abs(h) < band;
                    below += h < -(band + kBelow_m * s.inverse);
                }
            if (on == 0) count += below;
        }
    return count;
}

size_t FloorFinder::gather(const Plane& plane, float slack_m, Sums& sums) const {
    const float d = 1.0f / glm::length(plane), noise = kSigmas * kInverseDepthSigma * d;
    size_t count = 0;
    for (size_t i = 0; i < inverse_.size(); ++i) {
        const Sample s = sample(i);
        const float h = d * (s.inverse - plane.x * s.x - plane.y * s.y - plane.z);
        if (s.inverse <= 0.0f || std::abs(h) > slack_m * s.inverse + noise) continue;
        // What lies on the floor is above it, and nothing is below.
        sums.add(s, h > kThings * (slack_m * s.inverse + noise) ? kThingsWeight : 1.0);
        ++count;
    }
    return count;
}

FloorFinder::Fit FloorFinder::search(const Vec3& up, uint32_t tries) {
    Fit best;
    for (uint32_t i = 0; i < tries; ++i) {
        const uint32_t first = random(uint32_t(inverse_.size()));
        const int x = int(first % columns_), y = int(first / columns_);
        Sums sums;
        bool whole = true;
        for (int k = 0; k < 3 && whole; ++k) {
            const int dx = k == 0 ? 0 : int(random(2 * kWindow + 1)) - kWindow;
            const int dy = k == 0 ? 0 : int(random(2 * kWindow + 1)) - kWindow;
            const int sx = std::clamp(x + dx, 0, int(columns_) - 1),
                      sy = std::clamp(y + dy, 0, int(rows_) - 1);
            const Sample s = sample(size_t(sy) * columns_ + size_t(sx));
            whole = s.inverse > 0.0f;
            sums.add(s);
        }
        Plane plane;
        if (!whole || !sums.solve(plane) || !plausible(plane, up)) continue;
        const float points = score(plane);
        if (points > best.score && extent_m(plane) > kNarrowest_m) best = {plane, points};
    }
    for (const float slack : {2.0f * kUneven_m, kUneven_m, kUneven_m}) {
        Sums sums;
        Plane plane;
        if (!best.valid() || gather(best.plane, slack, sums) < kFewest || !sums.solve(plane)) break;
        // The lowest strip of a wall is near many planes, yet lies in its own.
        if (!plausible(plane, up)) return {};
        if (const float points = score(plane); points > 0.0f) best = {plane, points};
    }
    return best;
}

// All cells instead of a sixteenth: the first image has to be right already.
void FloorFinder::fit_whole(const DepthGrid& grid, const Vec3& up) {
    for (int pass = 0; pass < 3; ++pass) {
        sums_ = {};
        for (uint32_t turn = 0; turn < kSampleStep * kSampleStep; ++turn) {
            take_samples(grid, turn);
            gather(plane_, kUneven_m, sums_);
        }
        Plane refined;
        if (sums_.solve(refined) && plausible(refined, up) && score(refined) > 0.0f) plane_ = refined;
    }
}

bool FloorFinder::worth_a_search(const Vec3& up, bool seen) {
    if (frames_ == 1) return true;
    if (frames_ < next_search_ || (seen && frames_ % kLookAgain != 0)) return false;
    const Fit hint = search(up, kFewTries);
    return hint.valid() && (!seen || hint.score > kBetter * score(plane_));
}

bool FloorFinder::run(const DepthGrid& grid, Camera& camera) {
    take_samples(grid, frames_++);
    if (camera.floor_state == VFIT_FLOOR_GIVEN) {
        if (camera.floor_distance_m < kLowest_m) return false;
        return score(-camera.floor_normal / camera.floor_distance_m) > 0.0f;
    }

    const Vec3 up = camera.floor_normal;
    found_ = found_ && plausible(plane_, up);
    bool seen = false;
    if (found_) {
        Sums now = sums_;
        now.decay(kMemory);
        seen = gather(plane_, kUneven_m, now) >= kFewest && score(plane_) > 0.0f;
        Plane refined;
        if (seen && now.solve(refined) && plausible(refined, up) && score(refined) > 0.0f) {
            plane_ = refined;
            sums_ = now;
        }
    }
    if (worth_a_search(up, seen)) {
        const Fit fit = search(up, kTries);
        next_search_ = frames_ + rest_;
        rest_ = fit.valid() ? kLeastRest : std::min(2 * rest_, kMostRest);
        if (fit.valid() && (!seen || fit.score > kBetter * score(plane_))) {
            plane_ = fit.plane;
            fit_whole(grid, up);
            found_ = seen = true;
        }
    }
    if (!found_) return false;
    const float d = 1.0f / glm::length(plane_);
    camera.floor_normal = -plane_ * d;
    camera.floor_distance_m = d;
    camera.floor_state = VFIT_FLOOR_ESTIMATED;
    return seen;
}

}  // namespace vfit
