#include "cloth/contact/virtual_particles.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "cloth/contact/contact_culling.h"
#include "core/error.h"

namespace vfit {

namespace {

// A step meets them all: tens of milliseconds. What wants more is a mistake.
constexpr float kMost = 65536.0f;

}  // namespace

VirtualParticles::VirtualParticles(const Fabric& fabric, float spacing_m) {
    const FabricData& data = fabric.data();
    std::map<std::pair<uint32_t, uint32_t>, float> lengths;
    for (const DistanceConstraint& e : data.edges) lengths[std::minmax(e.a, e.b)] = e.rest_m;
    const auto length = [&](uint32_t a, uint32_t b) {
        const auto found = lengths.find(std::minmax(a, b));
        return found == lengths.end() ? 0.0f : found->second;  // between fixed vertices: skinned
    };
    // A triangle cut into n x n: the middle of each. Of equal sides none of its corners is further off than
    // spacing_m.
    std::vector<float> cuts;
    float wanted = 0.0f;
    for (size_t t = 0; t + 2 < data.indices.size(); t += 3) {
        const uint32_t* v = &data.indices[t];
        const float longest = std::max({length(v[0], v[1]), length(v[1], v[2]), length(v[2], v[0])});
        cuts.push_back(std::ceil(longest / (std::sqrt(3.0f) * spacing_m)));
        if (cuts.back() > 1.0f) wanted += cuts.back() * cuts.back();
    }
    if (wanted > kMost)
        fail(VFIT_ERROR_ARGUMENT, "virtual particles ", spacing_m, " m from each other are ",
             size_t(std::min(wanted, 1e9f)), ", more than ", size_t(kMost));
    for (size_t t = 0; t + 2 < data.indices.size(); t += 3) {
        const uint32_t* v = &data.indices[t];
        if (cuts[t / 3] <= 1.0f) continue;
        const int n = int(cuts[t / 3]);
        const auto add = [&](float a, float b) {
            const float weights[3] = {a / (3.0f * float(n)), b / (3.0f * float(n)),
                                      1.0f - (a + b) / (3.0f * float(n))};
            Point point{};
            float sum = 0.0f;
            for (size_t k = 0; k < 3; ++k) {
                point.corners[k] = fabric.layout().particle_of[v[k]];
                point.weights[k] = weights[k];
                point.gains[k] = weights[k] * data.inverse_mass[v[k]];
                sum += weights[k] * point.gains[k];
            }
            if (sum == 0.0f) return;
            for (float& gain : point.gains) gain /= sum;
            points_.push_back(point);
        };
        for (int i = 0; i < n; ++i)
            for (int k = 0; i + k < n; ++k) {
                add(float(3 * i + 1), float(3 * k + 1));
                if (i + k + 1 < n) add(float(3 * i + 2), float(3 * k + 2));
            }
    }
    of_point_.resize(points_.size());
}

Vec3 VirtualParticles::at(const Point& p, const Particles& particles) {
    return p.weights[0] * particles[p.corners[0]].x + p.weights[1] * particles[p.corners[1]].x +
           p.weights[2] * particles[p.corners[2]].x;
}

void VirtualParticles::find_near(const Particles& places, const Particles& velocities, float dt,
                                 std::span<const SweptCapsule> colliders) {
    near_.clear();
    for (size_t i = 0; i < points_.size(); ++i) {
        Near& near = of_point_[i];
        near.center = at(points_[i], places);
        near.way_m = expected_way_m(dt * glm::length(at(points_[i], velocities)));
        near.first = uint32_t(near_.size());
        for (uint32_t c = 0; c < colliders.size(); ++c)
            if (may_touch(colliders[c], near.center, near.way_m)) near_.push_back(c);
        near.last = uint32_t(near_.size());
    }
}

void VirtualParticles::meet(const Point& point, const SweptCapsule& collider, const ContactSettings& settings,
                            const Particles& starts, Particles& places, Particles& pushed) const {
    const Vec3 place = at(point, places);
    Vec3 to = place;
    if (!resolve_contact(collider, at(point, starts), settings, to)) return;
    for (size_t k = 0; k < 3; ++k) {
        const Vec3 move = (to - place) * point.gains[k];
        places[point.corners[k]].x += move;
        if (!pushed.empty()) pushed[point.corners[k]].x += move;
    }
}

void VirtualParticles::solve(std::span<const SweptCapsule> colliders, const ContactSettings& settings,
                             const Particles& starts, Particles& places, Particles& pushed) const {
    for (size_t i = 0; i < points_.size(); ++i) {
        const Near& near = of_point_[i];
        const Vec3 way = at(points_[i], places) - near.center;
        if (glm::dot(way, way) > near.way_m * near.way_m) {
            for (const SweptCapsule& collider : colliders)
                meet(points_[i], collider, settings, starts, places, pushed);
        } else {
            for (uint32_t c = near.first; c < near.last; ++c)
                meet(points_[i], colliders[near_[c]], settings, starts, places, pushed);
        }
    }
}

}  // namespace vfit
