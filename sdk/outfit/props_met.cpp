#include "outfit/props_met.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr float kGrows_s = 0.25f;
constexpr float kLeap_m = 0.3f;     // in a step: what is faster is not swept (kMaxWay_m)
constexpr float kLongest_s = 5.0f;  // that it passes
constexpr float kNear_m = 0.3f;     // to the garment, where leaps matter

Vec3 moved(const Mat4& m, const Vec3& p) { return Vec3(m * Vec4(p, 1.0f)); }

Bounds bounds_of(const ClothPiece& cloth) {
    Bounds out;
    for (const Vec3& p : cloth.positions()) out.add(p);
    return out;
}

Bounds widened(const Bounds& box, float by_m) { return {box.low - by_m, box.high + by_m}; }

/// Some vertex moves too far relative to the body, and its way leads past the garment.
bool leaps(std::span<const Vec3> before, std::span<const Vec3> now, const Mat4& motion,
           const Bounds& around) {
    for (size_t i = 0; i < now.size(); ++i) {
        Bounds way;
        way.add(before[i]), way.add(now[i]);
        if (around.overlaps(way) && glm::distance(moved(motion, before[i]), now[i]) > kLeap_m) return true;
    }
    return false;
}

}  // namespace

bool PropsMet::add(const Prop& prop, ClothPiece cloth) {
    if (std::any_of(met_.begin(), met_.end(), [&](const Met& met) { return met.prop == &prop; }))
        return false;
    met_.reserve(met_.size() + 1), free_meshes_.reserve(met_.size() + 1);
    cloth.meet_edges();
    uint32_t mesh;
    if (free_meshes_.empty()) {
        mesh = cloth.add_mesh(prop.vertex_count(), prop.indices(), MeshOf::prop);
    } else {
        mesh = free_meshes_.back();
        cloth.replace_mesh(mesh, prop.vertex_count(), prop.indices(), MeshOf::prop);
        free_meshes_.pop_back();
    }
    cloth.shape_mesh(mesh, prop.positions());
    met_.push_back({&prop, mesh, 0.0f, 0, {}, {}, {}, {}, {}});
    return true;
}

void PropsMet::add_to(ClothPiece cloth) {
    free_meshes_.clear();
    if (!met_.empty()) cloth.meet_edges();
    for (Met& met : met_) {
        met.mesh = cloth.add_mesh(met.prop->vertex_count(), met.prop->indices(), MeshOf::prop);
        cloth.shape_mesh(met.mesh, met.prop->positions());
    }
}

bool PropsMet::remove(const Prop& prop, ClothPiece cloth) {
    const auto met = std::find_if(met_.begin(), met_.end(), [&](const Met& m) { return m.prop == &prop; });
    if (met == met_.end()) return false;
    cloth.hide_mesh(met->mesh);
    free_meshes_.push_back(met->mesh);
    met_.erase(met);
    return true;
}

void PropsMet::move(const BodyBeside& body, float dt, ClothPiece cloth, Jobs& jobs) {
    if (met_.empty()) return;
    const Bounds garment = bounds_of(cloth), around = widened(garment, kNear_m),
                 where_cloth_is = widened(garment, body.room_m);
    const Mat4 motion = body.motion.now * glm::inverse(body.motion.before);
    for (Met& met : met_) {
        std::swap(met.whole.at, met.last_whole);
        body.posed.move(met.prop->positions(), body.room_m, where_cloth_is, met.whole, jobs);
        const std::vector<Vec3>& whole = met.whole.at;
        if (met.passes) continue;
        if (met.size > 0.0f && leaps(met.last_whole, whole, motion, around)) come_in_anew(met, cloth);
        if (met.size == 0.0f) begin_to_grow(met, garment);
        // Cloth that moves with the body at once takes the prop's start along: their distance stays.
        met.starts = met.places;
        if (const float carried = body.motion.carried; carried > 0.0f)
            for (Vec3& p : met.starts) p = glm::mix(p, moved(motion, p), carried);
        met.size = std::min(1.0f, met.size + dt / kGrows_s);
        for (size_t i = 0; i < whole.size(); ++i)
            met.places[i] = met.size < 1.0f ? glm::mix(whole[met.from], whole[i], met.size) : whole[i];
        cloth.move_mesh(met.mesh, met.places, met.starts);
    }
}

void PropsMet::let_pass(ClothPiece cloth, float share, float dt) {
    for (Met& met : met_) {
        met.for_s += dt;
        if (met.passes && met.for_s >= met.passes_s) {
            met.passes = false, met.for_s = 0.0f;
            continue;
        }
        // What it holds and crosses has no way out.
        if (!met.passes && met.size > 0.0f && cloth.crosses_mesh(met.mesh) && holds(met, cloth, share)) {
            met.passes_s = met.for_s < met.passes_s ? std::min(2.0f * met.passes_s, kLongest_s) : kPasses_s;
            met.passes = true, met.for_s = 0.0f;
            come_in_anew(met, cloth);
        }
    }
}

bool PropsMet::holds(const Met& met, const ClothPiece& cloth, float share) {
    return is_held(
        cloth, met.places.size(), [&](size_t i) { return glm::mix(met.starts[i], met.places[i], share); },
        [](uint32_t) { return true; });
}

void PropsMet::hide(ClothPiece cloth) {
    for (Met& met : met_) {
        met.passes = false, met.for_s = INFINITY;
        come_in_anew(met, cloth);
    }
}

void PropsMet::come_in_anew(Met& met, ClothPiece cloth) {
    met.size = 0.0f;
    met.whole.before.clear();
    cloth.hide_mesh(met.mesh);
}

/// All of it at one vertex.
void PropsMet::begin_to_grow(Met& met, const Bounds& garment) {
    const Vec3 middle = 0.5f * (garment.low + garment.high);
    const std::vector<Vec3>& whole = met.whole.at;
    float most = -1.0f;
    for (uint32_t i = 0; i < whole.size(); ++i)
        if (const float way = glm::distance(whole[i], middle); way > most) most = way, met.from = i;
    met.places.assign(whole.size(), whole[met.from]);
}

void PropsMet::keep_step() {
    for (Met& met : met_) {
        met.kept.clear();
        if (met.passes)
            met.kept = met.whole.at;
        else if (met.size > 0.0f)
            met.kept = met.places;
    }
}

}  // namespace vfit
