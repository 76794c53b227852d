#include "outfit/props_met.h"

#include <algorithm>

namespace vfit {

namespace {

constexpr float kGrows_s = 0.25f;
constexpr float kLeap_m = 0.3f;  // in a step: what is faster is not swept (kMaxWay_m)
constexpr float kNear_m = 0.3f;  // to the garment, where leaps matter

Vec3 moved(const Mat4& m, const Vec3& p) { return Vec3(m * Vec4(p, 1.0f)); }

Bounds bounds_of(const Cloth& cloth) {
    Bounds out;
    for (const Vec3& p : cloth.positions()) out.add(p);
    return out;
}

/// Some vertex moves too far relative to the body, and its way leads past the garment.
bool leaps(std::span<const Vec3> before, std::span<const Vec3> now, const Mat4& motion, Bounds garment) {
    garment.low -= kNear_m, garment.high += kNear_m;
    for (size_t i = 0; i < now.size(); ++i) {
        Bounds way;
        way.add(before[i]), way.add(now[i]);
        if (garment.overlaps(way) && glm::distance(moved(motion, before[i]), now[i]) > kLeap_m) return true;
    }
    return false;
}

}  // namespace

bool PropsMet::add(const Prop& prop, Cloth& cloth) {
    if (std::any_of(met_.begin(), met_.end(), [&](const Met& met) { return met.prop == &prop; }))
        return false;
    met_.reserve(met_.size() + 1), free_meshes_.reserve(met_.size() + 1);
    cloth.meet_edges();
    uint32_t mesh;
    if (free_meshes_.empty()) {
        mesh = cloth.add_mesh(prop.vertex_count(), prop.indices(), {}, MeshOf::prop);
    } else {
        mesh = free_meshes_.back();
        cloth.replace_mesh(mesh, prop.vertex_count(), prop.indices(), MeshOf::prop);
        free_meshes_.pop_back();
    }
    cloth.shape_mesh(mesh, prop.positions());
    met_.push_back({&prop, mesh, 0.0f, 0, {}, {}, {}, {}});
    return true;
}

bool PropsMet::remove(const Prop& prop, Cloth& cloth) {
    const auto met = std::find_if(met_.begin(), met_.end(), [&](const Met& m) { return m.prop == &prop; });
    if (met == met_.end()) return false;
    cloth.hide_mesh(met->mesh);
    free_meshes_.push_back(met->mesh);
    met_.erase(met);
    return true;
}

void PropsMet::move(const RootMotion& body, float dt, Cloth& cloth) {
    if (met_.empty()) return;
    const Bounds garment = bounds_of(cloth);
    const Mat4 motion = body.now * glm::inverse(body.before);
    for (Met& met : met_) {
        const std::vector<Vec3>& whole = met.prop->positions();
        if (met.size > 0.0f && leaps(met.whole, whole, motion, garment)) come_in_anew(met, cloth);
        if (met.size == 0.0f) begin_to_grow(met, garment);
        // Cloth that moves with the body at once takes the prop's start along: their distance stays.
        met.starts = met.places;
        if (body.carried > 0.0f)
            for (Vec3& p : met.starts) p = glm::mix(p, moved(motion, p), body.carried);
        met.whole = whole;
        met.size = std::min(1.0f, met.size + dt / kGrows_s);
        for (size_t i = 0; i < whole.size(); ++i)
            met.places[i] = met.size < 1.0f ? glm::mix(whole[met.from], whole[i], met.size) : whole[i];
        cloth.move_mesh(met.mesh, met.places, met.starts);
    }
}

void PropsMet::hide(Cloth& cloth) {
    for (Met& met : met_) come_in_anew(met, cloth);
}

void PropsMet::come_in_anew(Met& met, Cloth& cloth) {
    met.size = 0.0f;
    cloth.hide_mesh(met.mesh);
}

/// All of it at one vertex.
void PropsMet::begin_to_grow(Met& met, const Bounds& garment) {
    const Vec3 middle = 0.5f * (garment.low + garment.high);
    const std::vector<Vec3>& whole = met.prop->positions();
    float most = -1.0f;
    for (uint32_t i = 0; i < whole.size(); ++i)
        if (const float way = glm::distance(whole[i], middle); way > most) most = way, met.from = i;
    met.places.assign(whole.size(), whole[met.from]);
}

void PropsMet::keep_step() {
    for (Met& met : met_) {
        met.kept.clear();
        if (met.size > 0.0f) met.kept = met.places;
    }
}

}  // namespace vfit
