#include "outfit/props_met.h"

#include <algorithm>

#include "cloth/contact/contact.h"

namespace vfit {

namespace {

constexpr float kGrows_s = 0.25f;
constexpr float kLeap_m = 0.5f;  // in a step: no hand and no ball is so fast

}  // namespace

bool PropsMet::add(const Prop& prop, Cloth& cloth) {
    if (std::any_of(met_.begin(), met_.end(), [&](const Met& met) { return met.prop == &prop; }))
        return false;
    met_.reserve(met_.size() + 1), free_meshes_.reserve(met_.size() + 1);
    uint32_t mesh;
    if (free_meshes_.empty()) {
        mesh = cloth.add_mesh(prop.vertex_count(), prop.indices(), {}, MeshOf::prop);
    } else {
        mesh = free_meshes_.back();
        cloth.replace_mesh(mesh, prop.vertex_count(), prop.indices(), MeshOf::prop);
        free_meshes_.pop_back();
    }
    cloth.meet_edges();
    met_.push_back({&prop, mesh, 0.0f, 0, Vec3(0.0f), {}, {}});
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

void PropsMet::move(const Mat4& root, float dt, Cloth& cloth) {
    const Mat4 to_body = glm::inverse(root);
    for (Met& met : met_) {
        const Vec3 from_body(to_body * Vec4(met.prop->center(), 1.0f));
        if (met.size > 0.0f && glm::distance(from_body, met.from_body) > kLeap_m) come_in_anew(met, cloth);
        met.from_body = from_body;
        if (met.size == 0.0f) begin_to_grow(met, cloth);
        met.size = std::min(1.0f, met.size + dt / kGrows_s);
        if (met.size == 0.0f) continue;
        const std::vector<Vec3>& whole = met.prop->positions();
        met.places.resize(whole.size());
        for (size_t i = 0; i < whole.size(); ++i)
            met.places[i] = met.size < 1.0f ? glm::mix(whole[met.from], whole[i], met.size) : whole[i];
        cloth.move_mesh(met.mesh, met.places);
    }
}

void PropsMet::hide(Cloth& cloth) {
    for (Met& met : met_) come_in_anew(met, cloth);
}

void PropsMet::come_in_anew(Met& met, Cloth& cloth) {
    met.size = 0.0f;
    cloth.hide_mesh(met.mesh);
}

void PropsMet::begin_to_grow(Met& met, const Cloth& cloth) {
    Bounds garment;
    for (const Vec3& p : cloth.positions()) garment.add(p);
    const Vec3 middle = 0.5f * (garment.low + garment.high);
    const std::vector<Vec3>& whole = met.prop->positions();
    float most = -1.0f;
    for (uint32_t i = 0; i < whole.size(); ++i)
        if (const float way = glm::distance(whole[i], middle); way > most) most = way, met.from = i;
}

void PropsMet::keep_step() {
    for (Met& met : met_)
        if (met.size > 0.0f) met.kept = met.places;
}

}  // namespace vfit
