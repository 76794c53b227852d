#include "cloth/garment/dress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cloth/garment/clear_skin.h"
#include "cloth/garment/cut.h"
#include "cloth/garment/hems.h"
#include "core/error.h"
#include "geometry/mesh_query.h"

namespace vfit {

namespace {

void check(const Garment& garment, const BoundGarment& bound, const DressBody& body) {
    if (body.positions.size() != bound.body_vertices)
        fail(VFIT_ERROR_ARGUMENT, "garment ", garment.name, ": authored body and avatar differ in topology");
}

/// The ball inside the body that touches the skin below p: half as thick as the body there, at most as wide
/// as the trunk's rounding, so that a vertex that slid sideways finds the skin curve away below it.
struct BodyBall {
    Vec3 center;
    float radius_m;
};
BodyBall ball_below(const MeshQuery& skin, const Vec3& p, const MeshQuery::Closest& closest) {
    constexpr float kSmallest_m = 0.02f, kLargest_m = 0.1f;
    const Vec3 inward = closest.distance > 1e-6f ? (closest.point - p) / closest.distance : -closest.normal;
    const auto far_side = skin.cast(closest.point + inward * 1e-3f, inward, 2.0f * kLargest_m);
    const float radius = far_side ? std::max(kSmallest_m, 0.5f * far_side->distance) : kLargest_m;
    return {closest.point + inward * radius, radius};
}

/// A triangle with these sides, the first edge of which runs as that of `like`, and on the same side of it.
void with_sides(const Vec2 (&like)[3], const float (&sides)[3], Vec2 (&out)[3]) {
    const Vec2 first = like[1] - like[0], along = first / glm::length(first);
    const Vec2 left(-along.y, along.x);
    const float side = glm::dot(like[2] - like[0], left) < 0.0f ? -1.0f : 1.0f;
    const float x = (sides[0] * sides[0] + sides[2] * sides[2] - sides[1] * sides[1]) / (2.0f * sides[0]);
    constexpr float kFlattest = 0.05f;  // height over base: bodies change triangles by a little, but slivers
    const float y = std::max(std::sqrt(std::max(0.0f, sides[2] * sides[2] - x * x)), kFlattest * sides[0]);
    out[0] = like[0];
    out[1] = like[0] + along * sides[0];
    out[2] = like[0] + along * x + left * (side * y);
}

/// The triangles as they are cut, one place a corner: in a size, or with the garment's lengths as much longer
/// as its shape is on this body. So what was loose, tight, gathered or flared by some share where it was made
/// stays so, place by place.
std::vector<Vec2> cut_of(const Garment& garment, std::span<const Vec3> rest, const GarmentSize* size) {
    std::vector<Vec2> cut = cut_corners(garment, size);
    if (size) return cut;
    for (size_t i = 0; i + 2 < cut.size(); i += 3) {
        const Vec2 like[3] = {cut[i], cut[i + 1], cut[i + 2]};
        float sides[3];
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t a = garment.mesh.indices[i + k], b = garment.mesh.indices[i + (k + 1) % 3];
            sides[k] = glm::length(like[(k + 1) % 3] - like[k]) * glm::length(rest[b] - rest[a]) /
                       std::max(glm::length(garment.mesh.positions[b] - garment.mesh.positions[a]), 1e-6f);
        }
        Vec2 corners[3];
        with_sides(like, sides, corners);
        std::copy(corners, corners + 3, &cut[i]);
    }
    return cut;
}

/// On a narrower body, a coat's fronts would go through each other: what is left of the middle stays there.
Vec3 carried_to(const Vec3& place, const Vec3& shift) {
    constexpr float kLeast = 0.3f;  // of how far off the middle it was
    Vec3 out = place + shift;
    if (out.x * place.x < kLeast * place.x * place.x) out.x = kLeast * place.x;
    return out;
}

/// Keeps the vertices that hold the garment near their targets, and the others within reach of those by the
/// way along the edges (long range attachment). Returns these ways. They slide on the skin as all cloth does,
/// but not far: pinned to it, they would stretch wherever the skin does, and give way to no obstacle.
///
/// Both pull by limited forces: without a limit, the cloth would be stretched or drawn through the skin where
/// the body leaves it too little way, as in a squat. The held vertices carry the whole garment, however few
/// they are; the others are helped to carry themselves.
std::vector<Tether> hold(std::span<const uint32_t> held, float slides_m, FabricData& data) {
    constexpr float kGravity_m_s2 = 9.81f;
    constexpr float kHeld = 2.0f, kHanging = 6.0f;  // times the weight that hangs there
    std::vector<float> inverse_mass = data.inverse_mass;
    float all_kg = 0.0f, held_kg = 0.0f;
    for (const float inverse : inverse_mass) all_kg += 1.0f / inverse;
    for (const uint32_t v : held) held_kg += 1.0f / std::exchange(inverse_mass[v], 0.0f);
    const float pull_m_s2 = kHeld * kGravity_m_s2 * all_kg / held_kg;
    for (const uint32_t v : held) data.limits.push_back({v, slides_m, v, pull_m_s2});
    std::vector<Tether> tethers = cook_tethers(inverse_mass, data.edges);
    for (const Tether& t : tethers)
        data.limits.push_back({t.vertex, t.length_m + slides_m, t.anchor, kHanging * kGravity_m_s2});
    return tethers;
}

/// How far what holds a garment slides: a waistband grips, and cloth on shoulders hardly slides, but where a
/// sleeve pulls it after an arm that is raised.
float slide_of(const Garment& garment, std::span<const uint32_t> held, std::span<const Vec3> rest,
               std::span<const Vec3> body) {
    constexpr float kWaistband_m = 0.002f, kShoulders_m = 0.005f, kWithSleeves_m = 0.01f,
                    kShoulderHeight = 0.7f;  // of the stature
    float middle = 0.0f, top = 0.0f;
    for (const uint32_t v : held) middle += rest[v].y / float(held.size());
    for (const Vec3& p : body) top = std::max(top, p.y);
    if (middle < kShoulderHeight * top) return kWaistband_m;
    return garment.has_sleeves() ? kWithSleeves_m : kShoulders_m;
}

/// Those that contact does not move, or not all of.
std::vector<uint32_t> skinned_triangles(const Garment& garment) {
    std::vector<uint32_t> out;
    for (size_t i = 0; i + 2 < garment.mesh.indices.size(); i += 3) {
        const uint32_t* v = &garment.mesh.indices[i];
        if (std::any_of(v, v + 3, [&](uint32_t corner) { return !garment.simulated[corner]; }))
            out.insert(out.end(), v, v + 3);
    }
    return out;
}

}  // namespace

Dress::Dress(const Garment& garment, const BoundGarment& bound, const FabricMaterial& material,
             const DressBody& body, float size_ratio, float thickness_m, const GarmentSize* size, Jobs* jobs)
    : indices_(garment.mesh.indices) {
    check(garment, bound, body);
    const uint32_t n = garment.vertex_count();
    for (uint32_t v = 0; v < n; ++v)
        if (!garment.simulated[v]) held_.push_back(v);
    // Both bodies stand in the same pose: what lies off the skin is carried as it is, so that ease and flare
    // stay what they were cut to.
    std::vector<std::array<float, 3>> shifts(n);
    for (uint32_t i = 0; i < n; ++i) {
        const Vec3 shift = bound.bindings[i].on(body.positions) - bound.skin_below.rest[i];
        shifts[i] = {shift.x, shift.y, shift.z};
    }
    bound.smoother->smooth(shifts);
    for (uint32_t i = 0; i < n; ++i)
        rest_.push_back(carried_to(garment.mesh.positions[i], {shifts[i][0], shifts[i][1], shifts[i][2]}));
    parallel_for_vertices(jobs, n,
                          [&](uint32_t i) { push_out(body.skin, thickness_m, std::span(&rest_[i], 1)); });
    clear_skin({body.positions, body.indices, body.skin}, skinned_triangles(garment), rest_);

    slides_m_ = slide_of(garment, held_, rest_, body.positions);
    carried_ = bound.skin_below;
    carried_.rest = rest_;
    split_limb_weights(rest_, body.limbs, carried_.bones, carried_.weights);
    carry_.emplace(carried_.bones, carried_.weights);
    const std::vector<uint32_t> triangles = body.bindable_triangles(false);
    const size_t bone_count = body.bone_count();
    std::optional<MeshQuery> bindable;  // made where a backstop needs it
    for (uint32_t i = 0; i < n; ++i) {
        if (!garment.backstop[i] || !garment.simulated[i]) continue;
        if (!bindable) bindable.emplace(body.positions, triangles);
        const MeshQuery::Closest closest = bindable->closest(rest_[i]);
        const BodyBall ball = ball_below(*bindable, rest_[i], closest);
        std::vector<float> bones(bone_count);
        Binding::of(closest, triangles).add_bones(body, bones);
        carried_.add(ball.center, bones);
        backstops_.push_back({i, ball.radius_m});
    }
    if (garment.has_own_lengths()) {
        hems_ = limb_hems(indices_, bound.parts_below, garment.simulated, rest_);
        end_at_wrists(hems_, body, rest_);
    }
    std::vector<uint8_t> keeps_hem(n, 0);
    for (const LimbHem& hem : hems_)
        for (const LimbHem::UpTheLimb& up : hem.up) keeps_hem[up.vertex] = 1;
    for (uint32_t i = 0; i < carried_.rest.size(); ++i) {
        const bool limited =
            i < n && ((!garment.most_way.empty() && garment.most_way[i] > 0.0f) || keeps_hem[i]);
        if (i >= n || !garment.simulated[i] || limited) followed_.push_back(i);
    }
    fabric_ = fabric_of(garment, material, size_ratio, size, &taken_up_, jobs);
    skin();
}

void Dress::skin() {
    skin_.emplace(carried_.skin());
    held_shape_ = HeldShape(held_, indices_, carried_from());
    if (followed_.empty()) return;
    Carried followed;
    for (const uint32_t i : followed_) followed.add(carried_.rest[i], carried_.bones[i], carried_.weights[i]);
    followed_skin_.emplace(followed.skin());
}

void Dress::lift_over(const Dress& below, float thickness_m) {
    constexpr float kAside_m = 0.005f, kFarthest_m = 0.03f;
    const MeshQuery cloth(below.carried_from(), below.indices());
    for (const uint32_t v : held_) {
        Vec3& place = carried_.rest[v];
        const MeshQuery::Closest near = cloth.closest(place);
        const float above = glm::dot(place - near.point, near.normal);
        const bool lies_there =
            near.distance < kFarthest_m && glm::length(place - near.point - above * near.normal) < kAside_m;
        if (lies_there && above < thickness_m) place += (thickness_m - above) * near.normal;
    }
    skin();
}

void Dress::lie_on_skin() {
    std::copy(rest_.begin(), rest_.end(), carried_.rest.begin());
    skin();
}

std::vector<Vec2> Dress::cut(const Garment& garment, float size_ratio, const GarmentSize* size) const {
    if (garment.has_own_lengths()) return cut_of(garment, rest_, size);
    // As cook_fabric has it of a shape in space.
    const Vec3 scale(size_ratio, 1.0f, size_ratio);
    std::vector<Vec2> out;
    for (size_t i = 0; i + 2 < indices_.size(); i += 3) {
        float sides[3];
        for (size_t k = 0; k < 3; ++k)
            sides[k] = glm::length((rest_[indices_[i + (k + 1) % 3]] - rest_[indices_[i + k]]) * scale);
        Vec2 corners[3];
        with_sides({{0, 0}, {1, 0}, {0, 1}}, sides, corners);
        out.insert(out.end(), corners, corners + 3);
    }
    return out;
}

std::shared_ptr<const Fabric> Dress::fabric_of(const Garment& garment, const FabricMaterial& material,
                                               float size_ratio, const GarmentSize* size, TakenUp* taken_up,
                                               Jobs* jobs) const {
    std::vector<Vec2> cut = garment.has_own_lengths() ? cut_of(garment, rest_, size) : std::vector<Vec2>();
    const TakenUp taken = take_up(hems_, indices_, garment.simulated, cut);
    if (taken_up) *taken_up = taken;
    const std::span<const Vec2> uvs = std::span(garment.mesh.uvs).first(garment.vertex_count());
    const std::vector<uint8_t> simulated(garment.vertex_count(), 1);
    FabricData data = cook_fabric({rest_, indices_, uvs, simulated, size_ratio, cut}, material);
    data.backstops = backstops_;
    const std::vector<Tether> tethers = hold(held_, slides_m_, data);
    for (uint32_t i = 0; i < garment.vertex_count(); ++i)
        if (!garment.most_way.empty() && garment.most_way[i] > 0.0f && garment.simulated[i])
            data.limits.push_back({i, garment.most_way[i]});
    keep_hems(hems_, tethers, data);
    return std::make_shared<const Fabric>(std::move(data), jobs);
}

void Dress::place(std::span<const Mat4> matrices, std::vector<Vec3>& targets, Scratch& scratch,
                  Jobs& jobs) const {
    skin_->carry(matrices, targets, scratch.bones, jobs);
}

void Dress::follow(std::span<const Mat4> matrices, std::vector<Vec3>& targets, Scratch& scratch,
                   Jobs& jobs) const {
    if (!followed_skin_) return;
    followed_skin_->carry(matrices, scratch.places, scratch.bones, jobs);
    for (size_t i = 0; i < followed_.size(); ++i) targets[followed_[i]] = scratch.places[i];
    held_shape_.keep_lengths(targets);
}

}  // namespace vfit
