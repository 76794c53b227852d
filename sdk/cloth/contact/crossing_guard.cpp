#include "cloth/contact/crossing_guard.h"

#include <algorithm>

#include "cloth/rigid_motion.h"

namespace vfit {

namespace {
constexpr uint32_t kNone = UINT32_MAX;
constexpr int kRounds = 12;  // in which zones may grow
constexpr size_t kLargestZone =
    150;  // vertices: where more is in a jam, holding it would tear at what is about it
constexpr size_t kMostCrossed =
    40;  // one pair for so many triangles: beyond, cloth lies in a heap, which is left to contact
constexpr float kUntangles_m = 0.001f;  // a step
constexpr int kRoundsToPart = 30;
constexpr float kParts_m = 0.002f;  // a round
}  // namespace

CrossingGuard::CrossingGuard(const FabricData& fabric)
    : indices_(fabric.indices),
      parent_(fabric.inverse_mass.size(), kNone),
      wanted_(fabric.inverse_mass.size()),
      untangle_(fabric.inverse_mass.size()) {
    for (const float inverse : fabric.inverse_mass) is_fixed_.push_back(inverse == 0.0f);
}

void CrossingGuard::keep(std::span<const Vec3> before, std::span<Vec3> now, TriangleGroups& cloth,
                         bool even_heaps, Jobs& jobs) {
    for (const uint32_t v : zoned_) parent_[v] = kNone;
    zoned_.clear();
    const auto find = [&] {
        pairs_.clear();
        cloth.find_crossings(true, pairs_, jobs);
    };
    find();
    moved_.clear(), tangled_ = {};
    if (!even_heaps && pairs_.size() * kMostCrossed > indices_.size() / 3) return;
    if (!pairs_.empty()) std::copy(now.begin(), now.end(), wanted_.begin());
    for (int round = 0; round < kRounds && unite_crossed(before); ++round) {
        move_zones(before, now);
        cloth.move(now, jobs);
        find();
    }
    tangled_ = untangle_.move(pairs_, indices_, is_fixed_, kUntangles_m, now);
    moved_.assign(zoned_.begin(), zoned_.end());
    moved_.insert(moved_.end(), tangled_.begin(), tangled_.end());
}

void CrossingGuard::part(std::span<Vec3> places, TriangleGroups& cloth, Jobs& jobs) {
    for (int round = 0; round < kRoundsToPart; ++round) {
        cloth.move(places, jobs);
        pairs_.clear();
        cloth.find_crossings(true, pairs_, jobs);
        if (pairs_.empty()) return;
        untangle_.move(pairs_, indices_, is_fixed_, kParts_m, places);
    }
}

bool CrossingGuard::crossed_before(const TrianglePair& pair, std::span<const Vec3> before) const {
    const auto corners = [&](uint32_t t) {
        return Corners{{before[indices_[3 * t]], before[indices_[3 * t + 1]], before[indices_[3 * t + 2]]}};
    };
    return cross(corners(pair.first), corners(pair.second));
}

uint32_t CrossingGuard::root(uint32_t vertex) {
    while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
}

void CrossingGuard::unite(uint32_t a, uint32_t b) {
    for (const uint32_t v : {a, b}) {
        if (parent_[v] != kNone) continue;
        parent_[v] = v;
        zoned_.push_back(v);
    }
    const uint32_t x = root(a), y = root(b);
    parent_[std::max(x, y)] = std::min(x, y);
}

/// False if nothing crosses that did not before.
bool CrossingGuard::unite_crossed(std::span<const Vec3> before) {
    bool any = false;
    for (const TrianglePair& pair : pairs_) {
        if (crossed_before(pair, before)) continue;
        for (const uint32_t t : {pair.first, pair.second})
            for (size_t k = 0; k < 3; ++k) unite(indices_[3 * pair.first], indices_[3 * t + k]);
        any = true;
    }
    return any;
}

void CrossingGuard::move_zones(std::span<const Vec3> before, std::span<Vec3> now) {
    std::sort(zoned_.begin(), zoned_.end(),
              [&](uint32_t a, uint32_t b) { return std::pair(root(a), a) < std::pair(root(b), b); });
    for (size_t begin = 0, end; begin < zoned_.size(); begin = end) {
        for (end = begin + 1; end < zoned_.size() && root(zoned_[end]) == root(zoned_[begin]);) ++end;
        move_zone(std::span(zoned_).subspan(begin, end - begin), before, now);
    }
}

void CrossingGuard::move_zone(std::span<const uint32_t> zone, std::span<const Vec3> before,
                              std::span<Vec3> now) {
    fixed_.clear();
    for (const uint32_t v : zone)
        if (is_fixed_[v]) fixed_.push_back(v);
    RigidMotion motion;
    // With what is fixed it goes, but does not turn about two or three places of it.
    for (const uint32_t v : fixed_) motion.to_center += (wanted_[v] - before[v]) / float(fixed_.size());
    if (fixed_.empty()) motion = fit_rigid_motion(zone, before, wanted_);
    const bool jams = zone.size() > kLargestZone;
    for (const uint32_t v : zone)
        if (!is_fixed_[v]) now[v] = jams ? wanted_[v] : motion.point(before[v]);
}

}  // namespace vfit
