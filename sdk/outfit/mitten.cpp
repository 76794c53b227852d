#include "outfit/mitten.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr uint32_t kRound = 24;     // places of a section
constexpr float kApart_m = 0.01f;   // sections
constexpr float kWithin_m = 0.01f;  // of a section: the points that it goes around

/// Around these points, in the plane of the two ways.
void add_section(std::span<const Vec3> points, const Vec3& middle, const Vec3& across, const Vec3& up,
                 std::vector<Vec3>& out) {
    const auto direction = [&](uint32_t i) {
        const float angle = 2.0f * kPi * float(i) / float(kRound);
        return std::cos(angle) * across + std::sin(angle) * up;
    };
    float reach[kRound];
    for (uint32_t i = 0; i < kRound; ++i) {
        reach[i] = 0.0f;
        for (const Vec3& p : points) reach[i] = std::max(reach[i], glm::dot(p - middle, direction(i)));
    }
    for (uint32_t i = 0; i < kRound; ++i) {
        float radius = INFINITY;  // up to the first of the lines that touch the points
        for (uint32_t k = 0; k < kRound; ++k)
            if (const float towards = glm::dot(direction(k), direction(i)); towards > 1e-3f)
                radius = std::min(radius, reach[k] / towards);
        out.push_back(middle + radius * direction(i));
    }
}

}  // namespace

Mitten mitten_around(std::span<const Vec3> hand, const Vec3& to_forearm) {
    Mitten out;
    if (hand.empty()) return out;
    const Vec3 along = -to_forearm;
    const Vec3 across =
        glm::normalize(glm::cross(along, std::abs(along.x) < 0.7f ? Vec3(1, 0, 0) : Vec3(0, 0, 1)));
    const Vec3 up = glm::cross(along, across);
    float low = INFINITY, high = -INFINITY;
    for (const Vec3& p : hand)
        low = std::min(low, glm::dot(p, along)), high = std::max(high, glm::dot(p, along));
    const auto sections = 1 + uint32_t(std::ceil((high - low) / kApart_m));
    Vec3 middle(0.0f);
    for (uint32_t i = 0; i < sections; ++i) {
        const float at = std::min(low + kApart_m * float(i), high);
        std::vector<Vec3> within;
        for (const Vec3& p : hand)
            if (std::abs(glm::dot(p, along) - at) <= kWithin_m) within.push_back(p);
        if (!within.empty()) {
            middle = Vec3(0.0f);
            for (const Vec3& p : within) middle += p / float(within.size());
        }
        middle += (at - glm::dot(middle, along)) * along;
        add_section(within, middle, across, up, out.places);
    }
    const auto tip = uint32_t(out.places.size());
    out.places.push_back(middle);
    for (uint32_t i = 0; i < sections; ++i)
        for (uint32_t k = 0; k < kRound; ++k) {
            const uint32_t next = (k + 1) % kRound, a = i * kRound + k, b = i * kRound + next;
            if (i + 1 < sections)
                out.indices.insert(out.indices.end(), {a, b, a + kRound, b, b + kRound, a + kRound});
            else
                out.indices.insert(out.indices.end(), {a, b, tip});
        }
    for (const Vec3& place : out.places) {
        uint32_t nearest = 0;
        float least2 = INFINITY;
        for (uint32_t i = 0; i < hand.size(); ++i) {
            const Vec3 way = hand[i] - place;
            const float way2 = glm::dot(way, way);
            if (way2 < least2) least2 = way2, nearest = i;
        }
        out.goes_with.push_back(nearest);
    }
    return out;
}

}  // namespace vfit
