#include "cloth/garment/dress.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cloth/garment/carried.h"
#include "cloth/garment/clear_skin.h"
#include "cloth/garment/cut.h"
#include "cloth/garment/hems.h"
#include "core/error.h"
#include "measure/mesh_query.h"

namespace vfit {

namespace {

/// The body's triangles that may carry a garment: without arms, or, for sleeves, without hands.
std::vector<uint32_t> bindable_triangles(const DressBody& body, bool with_arms) {
    if (body.parts.empty()) return {body.indices.begin(), body.indices.end()};
    const auto is_kept = [&](uint32_t v) {
        const BodyPart part = body.parts[v];
        return with_arms ? part != BodyPart::kLeftHand && part != BodyPart::kRightHand : !is_arm(part);
    };
    std::vector<uint32_t> kept;
    for (size_t i = 0; i + 2 < body.indices.size(); i += 3) {
        const uint32_t* v = &body.indices[i];
        if (is_kept(v[0]) && is_kept(v[1]) && is_kept(v[2])) kept.insert(kept.end(), v, v + 3);
    }
    return kept;
}

/// A place on the body's surface: three corners and their weights.
struct Binding {
    uint32_t corner[3];
    float weight[3];

    Vec3 on(std::span<const Vec3> body) const {
        return weight[0] * body[corner[0]] + weight[1] * body[corner[1]] + weight[2] * body[corner[2]];
    }
};

void check(const Garment& garment, const DressBody& body) {
    const size_t n = body.authored.size();
    if (n == 0 || body.rest.size() != n)
        fail(VFIT_ERROR_ARGUMENT, "garment ", garment.name, ": authored body and avatar differ in topology");
    if (body.skin_bones.size() < n || body.skin_weights.size() < n ||
        (!body.parts.empty() && body.parts.size() < n))
        fail(VFIT_ERROR_ARGUMENT, "garment ", garment.name, ": the body's skin has too few vertices");
    for (uint32_t i : body.indices)
        if (i >= n) fail(VFIT_ERROR_ARGUMENT, "garment ", garment.name, ": the body's triangles name no such vertex");
}

std::vector<std::vector<uint32_t>> neighbours_of(const Mesh& mesh) {
    std::vector<std::vector<uint32_t>> lists(mesh.positions.size());
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k) {
            lists[mesh.indices[i + k]].push_back(mesh.indices[i + (k + 1) % 3]);
            lists[mesh.indices[i + (k + 1) % 3]].push_back(mesh.indices[i + k]);
        }
    for (auto& list : lists) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return lists;
}

/// Rows of numbers, one row a vertex.
struct Table {
    size_t width;
    std::vector<float> values;

    Table(size_t rows, size_t columns) : width(columns), values(rows * columns, 0.0f) {}
    std::span<float> row(size_t i) { return {values.data() + i * width, width}; }
    size_t rows() const { return values.size() / width; }

    std::vector<size_t> columns_in_use() {
        std::vector<size_t> used;
        for (size_t k = 0; k < width; ++k) {
            bool any = false;
            for (size_t i = k; i < values.size() && !any; i += width) any = values[i] != 0.0f;
            if (any) used.push_back(k);
        }
        return used;
    }
};

/// body(i) for each of so many, in parallel where there are jobs.
template <typename Body>
void for_each_of(uint32_t count, Jobs* jobs, Body&& body) {
    if (jobs) return parallel_for(*jobs, count, body);
    for (uint32_t i = 0; i < count; ++i) body(i);
}

/// The same for small ones.
template <typename Body>
void for_points(uint32_t count, Jobs* jobs, Body&& body) {
    constexpr uint32_t kShare = 128;
    for_each_of((count + kShare - 1) / kShare, jobs, [&](uint32_t at) {
        for (uint32_t i = at * kShare; i < std::min((at + 1) * kShare, count); ++i) body(i);
    });
}

/// Hanging cloth is bound to whichever leg is nearer; between them it must not tear. Evens the rows of simulated
/// vertices out over their neighbours, the more the further they hang from the skin; the skinned ones keep theirs.
void smooth_hanging(const Garment& garment, std::span<const float> skin_distances, Table& table, Jobs* jobs) {
    // Spreads over about 10 vertices, the gap between the legs, with steps that go beyond the mean (successive over-relaxation).
    constexpr int kRounds = 28;
    constexpr float kBeyond = 1.7f;
    constexpr float kCloseToSkin_m = 0.02f;  // a common ease: closer than that, cloth goes where its skin goes
    constexpr size_t kColumns = 8;           // at a time: a register
    using Row = std::array<float, kColumns>;
    const std::vector<std::vector<uint32_t>> neighbours = neighbours_of(garment.mesh);
    const std::vector<size_t> columns = table.columns_in_use();  // of the body's bones a dress has a fourth
    std::vector<float> kept;
    for (const float distance : skin_distances) kept.push_back(std::exp(-distance / kCloseToSkin_m));
    for_each_of(uint32_t((columns.size() + kColumns - 1) / kColumns), jobs, [&](uint32_t at) {
        const std::span<const size_t> some = std::span(columns).subspan(at * kColumns, std::min(kColumns, columns.size() - at * kColumns));
        std::vector<Row> own(table.rows(), Row{});
        for (size_t i = 0; i < own.size(); ++i)
            for (size_t k = 0; k < some.size(); ++k) own[i][k] = table.row(i)[some[k]];
        std::vector<Row> smooth = own;
        for (int round = 0; round < kRounds; ++round)
            for (size_t i = 0; i < neighbours.size(); ++i) {
                if (!garment.simulated[i] || neighbours[i].empty()) continue;
                Row sum{};
                for (const uint32_t j : neighbours[i])
                    for (size_t k = 0; k < kColumns; ++k) sum[k] += smooth[j][k];
                const float share = (1.0f - kept[i]) / float(neighbours[i].size());
                for (size_t k = 0; k < kColumns; ++k) smooth[i][k] += kBeyond * (kept[i] * own[i][k] + share * sum[k] - smooth[i][k]);
            }
        for (size_t i = 0; i < own.size(); ++i)
            for (size_t k = 0; k < some.size(); ++k) table.row(i)[some[k]] = smooth[i][k];
    });
}

/// Weight of each bone at a place on the body.
void add_bone_weights(const DressBody& body, const Binding& binding, std::span<float> bones) {
    for (int k = 0; k < 3; ++k)
        for (size_t j = 0; j < kSkinBones; ++j)
            bones[body.skin_bones[binding.corner[k]][j]] +=
                body.skin_weights[binding.corner[k]][j] * binding.weight[k];
}

Binding binding_of(const MeshQuery::Closest& closest, std::span<const uint32_t> triangles) {
    const uint32_t* v = &triangles[closest.triangle * 3];
    return {{v[0], v[1], v[2]}, {1.0f - closest.uv.x - closest.uv.y, closest.uv.x, closest.uv.y}};
}

/// The ball inside the body that touches the skin below p: half as thick as the body there, at most as wide as the
/// trunk's rounding, so that a vertex that slid sideways finds the skin curve away below it.
struct BodyBall {
    Vec3 center;
    float radius_m;
};
BodyBall ball_below(const MeshQuery& skin, const Vec3& p) {
    constexpr float kSmallest_m = 0.02f, kLargest_m = 0.1f;
    const MeshQuery::Closest closest = skin.closest(p);
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

/// The triangles as they are cut, one place a corner: in a size, or with the garment's lengths as much longer as its shape is on
/// this body. So what was loose, tight, gathered or flared by some share where it was made stays so, place by place.
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

/// Those that contact does not move, or not all of.
std::vector<uint32_t> skinned_triangles(const Garment& garment) {
    std::vector<uint32_t> out;
    for (size_t i = 0; i + 2 < garment.mesh.indices.size(); i += 3) {
        const uint32_t* v = &garment.mesh.indices[i];
        if (std::any_of(v, v + 3, [&](uint32_t corner) { return !garment.simulated[corner]; })) out.insert(out.end(), v, v + 3);
    }
    return out;
}

}  // namespace

Dress::Dress(const Garment& garment, const FabricMaterial& material, const DressBody& body, float size_ratio,
             float thickness_m, const GarmentSize* size, Jobs* jobs)
    : indices_(garment.mesh.indices) {
    check(garment, body);
    const uint32_t n = garment.vertex_count();
    uint32_t bones = 0;
    for (const auto& list : body.skin_bones)
        for (uint16_t bone : list) bones = std::max(bones, uint32_t(bone) + 1);
    const std::vector<uint32_t> triangles = bindable_triangles(body, false), with_arms = bindable_triangles(body, true);
    const bool sleeves = garment.has_sleeves();

    // Both bodies stand in the same pose: what lies off the skin is carried as it is, so that ease and flare stay
    // what they were cut to.
    Table carried_by(n, 3 + bones);  // shifts, then weights of the bones
    std::vector<float> skin_distances(n);
    std::vector<BodyPart> part_below(n, BodyPart::kTorso);
    {
        const MeshQuery authored(body.authored, triangles);
        std::optional<MeshQuery> authored_arms;
        if (sleeves) authored_arms.emplace(body.authored, with_arms);
        for_points(n, jobs, [&](uint32_t i) {
            const bool arm = sleeves && garment.on_arm[i];
            const MeshQuery::Closest closest = (arm ? *authored_arms : authored).closest(garment.mesh.positions[i]);
            skin_distances[i] = closest.distance;
            const Binding binding = binding_of(closest, arm ? with_arms : triangles);
            if (!body.parts.empty()) part_below[i] = body.parts[binding.corner[0]];
            const Vec3 shift = binding.on(body.rest) - binding.on(body.authored);
            for (int k = 0; k < 3; ++k) carried_by.row(i)[size_t(k)] = shift[k];
            add_bone_weights(body, binding, carried_by.row(i).subspan(3));
        });
    }
    smooth_hanging(garment, skin_distances, carried_by, jobs);
    for (uint32_t i = 0; i < n; ++i) {
        const std::span<const float> shift = carried_by.row(i);
        rest_.push_back(carried_to(garment.mesh.positions[i], {shift[0], shift[1], shift[2]}));
    }
    const MeshQuery skin(body.rest, body.indices);
    for_points(n, jobs, [&](uint32_t i) { push_out(skin, thickness_m, std::span(&rest_[i], 1)); });
    clear_skin({body.rest, body.indices, skin}, skinned_triangles(garment), rest_);

    Carried carried;
    for (uint32_t i = 0; i < n; ++i) carried.add(rest_[i], carried_by.row(i).subspan(3));
    carry_.emplace(carried.bones, carried.weights);
    std::optional<MeshQuery> bound;  // made where a backstop needs it
    std::vector<float> bone_weights(bones);
    for (uint32_t i = 0; i < n; ++i) {
        if (!garment.backstop[i] || !garment.simulated[i]) continue;
        if (!bound) bound.emplace(body.rest, triangles);
        const BodyBall ball = ball_below(*bound, rest_[i]);
        std::fill(bone_weights.begin(), bone_weights.end(), 0.0f);
        add_bone_weights(body, binding_of(bound->closest(rest_[i]), triangles), bone_weights);
        carried.add(ball.center, bone_weights);
        backstops_.push_back({i, ball.radius_m});
    }
    if (garment.has_own_lengths()) hems_ = limb_hems(indices_, part_below, garment.simulated, rest_);
    std::vector<uint8_t> of_hem(n, 0);
    for (const LimbHem& hem : hems_)
        for (const uint32_t v : hem.vertices) of_hem[v] = 1;
    Carried followed;
    for (uint32_t i = 0; i < carried.rest.size(); ++i) {
        const bool limited = i < n && ((!garment.most_way.empty() && garment.most_way[i] > 0.0f) || of_hem[i]);
        if (i < n && garment.simulated[i] && !limited) continue;
        followed.add(carried.rest[i], carried.bones[i], carried.weights[i]);
        followed_.push_back(i);
    }
    fabric_ = fabric_of(garment, material, size_ratio, size, &taken_up_);
    skin_.emplace(carried.skin());
    if (!followed_.empty()) followed_skin_.emplace(followed.skin());
}

std::vector<Vec2> Dress::cut(const Garment& garment, float size_ratio, const GarmentSize* size) const {
    if (garment.has_own_lengths()) return cut_of(garment, rest_, size);
    // As cook_fabric has it of a shape in space.
    const Vec3 scale(size_ratio, 1.0f, size_ratio);
    std::vector<Vec2> out;
    for (size_t i = 0; i + 2 < indices_.size(); i += 3) {
        float sides[3];
        for (size_t k = 0; k < 3; ++k) sides[k] = glm::length((rest_[indices_[i + (k + 1) % 3]] - rest_[indices_[i + k]]) * scale);
        Vec2 corners[3];
        with_sides({{0, 0}, {1, 0}, {0, 1}}, sides, corners);
        out.insert(out.end(), corners, corners + 3);
    }
    return out;
}

std::shared_ptr<const Fabric> Dress::fabric_of(const Garment& garment, const FabricMaterial& material, float size_ratio, const GarmentSize* size, TakenUp* taken_up) const {
    std::vector<Vec2> cut = garment.has_own_lengths() ? cut_of(garment, rest_, size) : std::vector<Vec2>();
    const TakenUp taken = take_up(hems_, indices_, garment.simulated, cut);
    if (taken_up) *taken_up = taken;
    const std::span<const Vec2> uvs = std::span(garment.mesh.uvs).first(garment.vertex_count());
    FabricData data = cook_fabric({rest_, indices_, uvs, garment.simulated, size_ratio, cut}, material);
    data.backstops = backstops_;
    for (uint32_t i = 0; i < garment.vertex_count(); ++i)
        if (!garment.most_way.empty() && garment.most_way[i] > 0.0f && garment.simulated[i]) data.limits.push_back({i, garment.most_way[i]});
    keep_hems(hems_, data);
    return std::make_shared<const Fabric>(std::move(data));
}

void Dress::place(std::span<const Mat4> matrices, std::vector<Vec3>& targets, Scratch& scratch, Jobs& jobs) const {
    skin_->carry(matrices, targets, scratch.bones, jobs);
}

void Dress::follow(std::span<const Mat4> matrices, std::vector<Vec3>& targets, Scratch& scratch, Jobs& jobs) const {
    if (!followed_skin_) return;
    followed_skin_->carry(matrices, scratch.places, scratch.bones, jobs);
    for (size_t i = 0; i < followed_.size(); ++i) targets[followed_[i]] = scratch.places[i];
}

}  // namespace vfit
