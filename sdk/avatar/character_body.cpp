#include "avatar/character_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "avatar/avatar.h"
#include "core/error.h"
#include "geometry/membrane.h"
#include "geometry/mesh_query.h"
#include "math/quaternion.h"

namespace vfit {

namespace {

/// Parts that only meet each other: an arm that hangs beside the trunk is no part of it.
enum Region { kTrunk, kLeftArm, kRightArm, kLeftLeg, kRightLeg, kRegions };

Region region_of(BodyPart part) {
    switch (part) {
        case BodyPart::kHead:
        case BodyPart::kTorso: return kTrunk;
        case BodyPart::kLeftUpperArm:
        case BodyPart::kLeftForearm:
        case BodyPart::kLeftHand: return kLeftArm;
        case BodyPart::kRightUpperArm:
        case BodyPart::kRightForearm:
        case BodyPart::kRightHand: return kRightArm;
        case BodyPart::kLeftThigh:
        case BodyPart::kLeftShank:
        case BodyPart::kLeftFoot: return kLeftLeg;
        default: return kRightLeg;
    }
}

constexpr int kEvenRounds = 80;
constexpr float kCuff_m = 0.05f;  // that sleeves may reach beyond the wrist

/// The humanoid bone that a bone is, or hangs on.
std::vector<int> humanoid_bones(const std::vector<AvatarBone>& bones) {
    std::vector<int> out;
    for (const AvatarBone& bone : bones)
        out.push_back(bone.bone >= 0    ? bone.bone
                      : bone.parent < 0 ? VFIT_BONE_HIPS
                                        : out[size_t(bone.parent)]);
    return out;
}

/// Each humanoid bone's joint; where bones of the trunk are missing, between those that are there as on the
/// model.
std::array<Vec3, kBoneCount> joints_of(const std::vector<AvatarBone>& bones,
                                       const std::array<Vec3, kBoneCount>* like = nullptr) {
    std::array<std::optional<Vec3>, kBoneCount> known;
    for (const AvatarBone& bone : bones)
        if (bone.bone >= 0) known[size_t(bone.bone)] = bone.rest_head;
    std::array<Vec3, kBoneCount> out;
    constexpr std::array kSpine = {VFIT_BONE_HIPS,        VFIT_BONE_SPINE, VFIT_BONE_CHEST,
                                   VFIT_BONE_UPPER_CHEST, VFIT_BONE_NECK,  VFIT_BONE_HEAD};
    for (size_t i = 0; i < kSpine.size(); ++i) {
        const auto b = size_t(kSpine[i]);
        if (known[b]) {
            out[b] = *known[b];
            continue;
        }
        size_t below = i, above = i;
        while (!known[size_t(kSpine[below])]) --below;
        while (!known[size_t(kSpine[above])]) ++above;
        const auto from = size_t(kSpine[below]), to = size_t(kSpine[above]);
        const Vec3 way = (*like)[to] - (*like)[from];
        const float share = glm::dot((*like)[b] - (*like)[from], way) / glm::dot(way, way);
        out[b] = glm::mix(*known[from], *known[to], share);
    }
    for (const auto& [shoulder, arm] : {std::pair(VFIT_BONE_LEFT_SHOULDER, VFIT_BONE_LEFT_UPPER_ARM),
                                        std::pair(VFIT_BONE_RIGHT_SHOULDER, VFIT_BONE_RIGHT_UPPER_ARM)})
        if (!known[size_t(shoulder)]) {
            const Vec3& top = out[VFIT_BONE_UPPER_CHEST];
            const float share = glm::distance((*like)[size_t(shoulder)], (*like)[VFIT_BONE_UPPER_CHEST]) /
                                glm::distance((*like)[size_t(arm)], (*like)[VFIT_BONE_UPPER_CHEST]);
            known[size_t(shoulder)] = glm::mix(top, *known[size_t(arm)], share);
        }
    for (const auto& [toes, foot] : {std::pair(VFIT_BONE_LEFT_TOES, VFIT_BONE_LEFT_FOOT),
                                     std::pair(VFIT_BONE_RIGHT_TOES, VFIT_BONE_RIGHT_FOOT)})
        if (!known[size_t(toes)]) {
            // The same way of the foot, as long as the sole is high.
            const Vec3 way = (*like)[size_t(toes)] - (*like)[size_t(foot)];
            known[size_t(toes)] = *known[size_t(foot)] +
                                  way * (known[size_t(foot)]->y / std::max((*like)[size_t(foot)].y, 0.01f));
        }
    for (size_t b = 0; b < size_t(kBoneCount); ++b)
        if (known[b]) out[b] = *known[b];
    return out;
}

Vec3 middle(const std::array<Vec3, kBoneCount>& joints, int a, int b) {
    return 0.5f * (joints[size_t(a)] + joints[size_t(b)]);
}

float trunk_length(const std::array<Vec3, kBoneCount>& joints) {
    return glm::distance(middle(joints, VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG),
                         middle(joints, VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_RIGHT_UPPER_ARM));
}

/// Where a humanoid bone ends: of the model and of a character alike.
Vec3 end_of(const std::array<Vec3, kBoneCount>& joints, int bone) {
    switch (bone) {
        case VFIT_BONE_HIPS: return joints[VFIT_BONE_SPINE];
        case VFIT_BONE_SPINE: return joints[VFIT_BONE_CHEST];
        case VFIT_BONE_CHEST: return joints[VFIT_BONE_UPPER_CHEST];
        case VFIT_BONE_UPPER_CHEST: return joints[VFIT_BONE_NECK];
        case VFIT_BONE_NECK: return joints[VFIT_BONE_HEAD];
        case VFIT_BONE_LEFT_SHOULDER: return joints[VFIT_BONE_LEFT_UPPER_ARM];
        case VFIT_BONE_LEFT_UPPER_ARM: return joints[VFIT_BONE_LEFT_LOWER_ARM];
        case VFIT_BONE_LEFT_LOWER_ARM: return joints[VFIT_BONE_LEFT_HAND];
        case VFIT_BONE_RIGHT_SHOULDER: return joints[VFIT_BONE_RIGHT_UPPER_ARM];
        case VFIT_BONE_RIGHT_UPPER_ARM: return joints[VFIT_BONE_RIGHT_LOWER_ARM];
        case VFIT_BONE_RIGHT_LOWER_ARM: return joints[VFIT_BONE_RIGHT_HAND];
        case VFIT_BONE_LEFT_UPPER_LEG: return joints[VFIT_BONE_LEFT_LOWER_LEG];
        case VFIT_BONE_LEFT_LOWER_LEG: return joints[VFIT_BONE_LEFT_FOOT];
        case VFIT_BONE_LEFT_FOOT: return joints[VFIT_BONE_LEFT_TOES];
        case VFIT_BONE_RIGHT_UPPER_LEG: return joints[VFIT_BONE_RIGHT_LOWER_LEG];
        case VFIT_BONE_RIGHT_LOWER_LEG: return joints[VFIT_BONE_RIGHT_FOOT];
        case VFIT_BONE_RIGHT_FOOT: return joints[VFIT_BONE_RIGHT_TOES];
        default: return joints[size_t(bone)];
    }
}

float median(std::vector<float> list) {
    if (list.empty()) return 0.0f;
    const auto at = list.begin() + std::ptrdiff_t(list.size() / 2);
    std::nth_element(list.begin(), at, list.end());
    return *at;
}

/// Median distance from the line of a bone of what that bone carries beside it.
float thickness_about(const std::array<Vec3, kBoneCount>& joints, int bone, std::span<const Vec3> places,
                      std::span<const uint8_t> carried_by, std::span<const uint8_t> counts) {
    const Vec3 from = joints[size_t(bone)], way = end_of(joints, bone) - from;
    const float length2 = glm::dot(way, way);
    std::vector<float> distances;
    if (length2 > 1e-8f)
        for (size_t v = 0; v < places.size(); ++v) {
            if (carried_by[v] != bone || (!counts.empty() && !counts[v])) continue;
            const float t = glm::dot(places[v] - from, way) / length2;
            if (t > 0.1f && t < 0.9f) distances.push_back(glm::distance(places[v], from + t * way));
        }
    return median(std::move(distances));
}

/// One a triangle: some way leads from its front out of the mesh. Skin below clothes, or within a joint,
/// does not count.
std::vector<uint8_t> seen_from_outside(std::span<const Vec3> places, std::span<const uint32_t> indices) {
    constexpr int kRays = 24;
    constexpr float kFar_m = 3.0f, kOff_m = 1e-4f, kLowest = 0.1f;
    const MeshQuery mesh(places, indices);
    const float golden = kPi * (3.0f - std::sqrt(5.0f));
    std::vector<uint8_t> out(indices.size() / 3, 0);
    for (size_t t = 0; t < out.size(); ++t) {
        const Vec3 &a = places[indices[3 * t]], &b = places[indices[3 * t + 1]],
                   &c = places[indices[3 * t + 2]];
        const Vec3 across = glm::cross(b - a, c - a);
        const float area = glm::length(across);
        if (area < 1e-10f) continue;
        const Vec3 normal = across / area, middle = (a + b + c) / 3.0f + kOff_m * normal;
        const Vec3 side =
            glm::normalize(glm::cross(normal, std::abs(normal.x) < 0.5f ? Vec3(1, 0, 0) : Vec3(0, 1, 0)));
        const Vec3 other = glm::cross(normal, side);
        for (int i = 0; i < kRays && !out[t]; ++i) {
            const float z = 1.0f - (1.0f - kLowest) * (float(i) + 0.5f) / float(kRays),
                        r = std::sqrt(1.0f - z * z), turn = golden * float(i);
            out[t] = !mesh.cast(middle, r * std::cos(turn) * side + r * std::sin(turn) * other + z * normal,
                                kFar_m);
        }
    }
    return out;
}

class Registration {
public:
    Registration(const AvatarSource& character, const std::shared_ptr<const BodyModel>& model, vfit_sex sex,
                 std::span<const uint8_t> left_out)
        : character_(character),
          model_(*model),
          topology_(model->topology(0)),
          count_(topology_.vertex_count),
          membrane_(count_, topology_.indices),
          left_out_(left_out) {
        out_.source = body_source(model, 0, sex, {}, Vec2(1.0f));
    }

    CharacterBody run() {
        stand_like_model();
        find_regions();
        warp();
        approach();
        enclose();
        finish();
        carry();
        return std::move(out_);
    }

private:
    std::vector<Vec3>& places() { return out_.source.rest.positions; }

    /// The character in the model's posture and size.
    void stand_like_model() {
        AvatarDesc plain;
        plain.single_bones = true;
        const Avatar body(out_.source, plain);
        Avatar figure(character_, plain);
        model_joints_ = joints_of(out_.source.bones);
        Pose pose = body.rest_pose();
        pose.hips_position = figure.rest_pose().hips_position;
        figure.move(pose);
        const std::span<const Mat4> matrices = figure.skinning_matrices();
        std::vector<AvatarBone> bones = character_.bones;
        for (size_t b = 0; b < bones.size(); ++b)
            bones[b].rest_head = Vec3(matrices[b] * Vec4(bones[b].rest_head, 1.0f));
        const auto joints = joints_of(bones, &model_joints_);
        out_.scale = trunk_length(model_joints_) / std::max(trunk_length(joints), 1e-3f);
        // As high above the soles as it is tall, and over the same place.
        std::vector<Vec3> posed;
        for (size_t v = 0; v < character_.rest.positions.size(); ++v) {
            Mat4 m(0.0f);
            for (size_t k = 0; k < size_t(kSkinBones); ++k)
                if (character_.skin_weights[v][k] > 0.0f)
                    m += character_.skin_weights[v][k] * matrices[character_.skin_bones[v][k]];
            posed.push_back(Vec3(m * Vec4(character_.rest.positions[v], 1.0f)));
        }
        const Vec3 hips = middle(joints, VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG),
                   model_hips = middle(model_joints_, VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG);
        float lowest = posed.front().y;
        for (const Vec3& p : posed) lowest = std::min(lowest, p.y);
        Mat4 place = glm::scale(Mat4(1.0f), Vec3(out_.scale));
        place[3] = Vec4(model_hips.x - out_.scale * hips.x, -out_.scale * lowest,
                        model_hips.z - out_.scale * hips.z, 1.0f);
        const auto placed = [&](const Vec3& p) { return Vec3(place * Vec4(p, 1.0f)); };
        for (size_t b = 0; b < bones.size(); ++b) out_.from_rest.push_back(place * matrices[b]);
        for (const Vec3& p : posed) out_.skin.push_back(placed(p));
        for (size_t b = 0; b < size_t(kBoneCount); ++b) joints_[b] = placed(joints[b]);
        place_trunk();
    }

    /// Rigs put the joints of the trunk anywhere, hips even on the floor: they stand between thighs and neck
    /// as on the model.
    void place_trunk() {
        const Vec3 from = middle(model_joints_, VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG),
                   to = middle(joints_, VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG);
        const Vec3 model_way = model_joints_[VFIT_BONE_NECK] - from, way = joints_[VFIT_BONE_NECK] - to;
        for (const int bone : {VFIT_BONE_HIPS, VFIT_BONE_SPINE, VFIT_BONE_CHEST, VFIT_BONE_UPPER_CHEST}) {
            const Vec3 own = model_joints_[size_t(bone)] - from;
            const float along = glm::dot(own, model_way) / glm::dot(model_way, model_way);
            joints_[size_t(bone)] =
                to + along * way + (own - along * model_way) * (glm::length(way) / glm::length(model_way));
        }
    }

    /// Which triangles of the character each region of the body may come to lie on.
    void find_regions() {
        const std::vector<AvatarBone>& bones = character_.bones;
        humanoid_ = humanoid_bones(bones);
        // Hair and hats, which hang on the head, are worn over garments.
        counts_.assign(out_.skin.size(), 0);
        std::vector<float>& of_head = out_.of_head;
        of_head.assign(out_.skin.size(), 0.0f);
        for (size_t v = 0; v < out_.skin.size(); ++v)
            for (size_t k = 0; k < size_t(kSkinBones); ++k)
                if (humanoid_[character_.skin_bones[v][k]] == VFIT_BONE_HEAD)
                    of_head[v] += character_.skin_weights[v][k];
        const std::vector<uint32_t>& indices = character_.rest.indices;
        const std::vector<BodyPart>& parts = character_.topology->parts;
        const std::vector<uint8_t> seen = seen_from_outside(out_.skin, indices);
        std::array<std::vector<uint32_t>, kRegions> of_region;
        for (size_t i = 0; i + 2 < indices.size(); i += 3) {
            if (!left_out_.empty() && left_out_[i / 3]) continue;
            const uint32_t* t = &indices[i];
            if (of_head[t[0]] + of_head[t[1]] + of_head[t[2]] > 1.5f) continue;
            if (!seen[i / 3]) continue;
            std::array<bool, kRegions> in{};
            for (size_t k = 0; k < 3; ++k) {
                in[region_of(parts[t[k]])] = true;
                counts_[t[k]] = 1;
            }
            for (size_t r = 0; r < kRegions; ++r)
                if (in[r]) of_region[r].insert(of_region[r].end(), t, t + 3);
        }
        for (size_t r = 0; r < kRegions; ++r) {
            if (!of_region[r].empty()) queries_[r].emplace(out_.skin, of_region[r]);
            triangles_[r] = std::move(of_region[r]);
        }
    }

    /// Each bone's skin goes with its bone, as long and as thick as the character has it there.
    void warp() {
        const std::vector<int> humanoid = humanoid_bones(out_.source.bones);
        std::vector<uint8_t> carried(out_.skin.size()), body_carried(count_);
        for (size_t v = 0; v < out_.skin.size(); ++v)
            carried[v] = uint8_t(humanoid_[character_.skin_bones[v][0]]);
        for (size_t v = 0; v < count_; ++v) {
            body_carried[v] = uint8_t(humanoid[out_.source.skin_bones[v][0]]);
            const int hand = topology_.parts[v] == BodyPart::kLeftHand    ? VFIT_BONE_LEFT_HAND
                             : topology_.parts[v] == BodyPart::kRightHand ? VFIT_BONE_RIGHT_HAND
                                                                          : -1;
            is_bare_.push_back(body_carried[v] == VFIT_BONE_HEAD ||
                               (hand >= 0 && glm::distance(out_.source.rest.positions[v],
                                                           model_joints_[size_t(hand)]) > kCuff_m));
        }
        std::array<Mat4, kBoneCount> to;
        for (int b = 0; b < kBoneCount; ++b) {
            const Vec3 from = model_joints_[size_t(b)], target = joints_[size_t(b)];
            const Vec3 way = end_of(model_joints_, b) - from, wanted = end_of(joints_, b) - target;
            const float own = glm::length(way), other = glm::length(wanted);
            const bool has_length = own > 0.01f && other > 0.01f;
            const float along = has_length ? other / own : 1.0f;
            const float thick = thickness_about(model_joints_, b, std::span(places()).first(count_),
                                                body_carried, {}),
                        wide = thickness_about(joints_, b, out_.skin, carried, counts_);
            const float across = thick > 0.0f && wide > 0.0f ? std::clamp(wide / thick, 0.3f, 3.0f) : 1.0f;
            Mat3 linear(has_length ? across : (thick > 0.0f && wide > 0.0f ? across : 1.0f));
            if (has_length) {
                const Vec3 axis = way / own;
                linear = glm::mat3_cast(shortest_arc(way, wanted)) *
                         (Mat3(across) + (along - across) * glm::outerProduct(axis, axis));
            }
            Mat4 m(linear);
            m[3] = Vec4(target - linear * from, 1.0f);
            to[size_t(b)] = m;
        }
        // Hands, feet and heads have no length of their own here: as long as what they hang on is thick.
        for (const auto& [end, of] : {std::pair(VFIT_BONE_LEFT_HAND, VFIT_BONE_LEFT_LOWER_ARM),
                                      std::pair(VFIT_BONE_RIGHT_HAND, VFIT_BONE_RIGHT_LOWER_ARM),
                                      std::pair(VFIT_BONE_LEFT_TOES, VFIT_BONE_LEFT_FOOT),
                                      std::pair(VFIT_BONE_RIGHT_TOES, VFIT_BONE_RIGHT_FOOT),
                                      std::pair(VFIT_BONE_HEAD, VFIT_BONE_NECK)}) {
            Mat4 m = to[size_t(of)];
            m[3] = Vec4(joints_[size_t(end)] - Mat3(m) * model_joints_[size_t(end)], 1.0f);
            to[size_t(end)] = m;
        }
        const std::vector<Vec3> own = places();
        for (size_t v = 0; v < count_; ++v) {
            Vec3 sum(0.0f);
            for (size_t k = 0; k < size_t(kSkinBones); ++k)
                sum += out_.source.skin_weights[v][k] *
                       Vec3(to[size_t(humanoid[out_.source.skin_bones[v][k]])] * Vec4(own[v], 1.0f));
            places()[v] = sum;
        }
        for (size_t b = 0; b < out_.source.bones.size(); ++b) {
            AvatarBone& bone = out_.source.bones[b];
            const Mat4& m = to[size_t(humanoid[b])];
            bone.rest_head =
                bone.bone >= 0 ? joints_[size_t(bone.bone)] : Vec3(m * Vec4(bone.rest_head, 1.0f));
            bone.rest_tail = Vec3(m * Vec4(bone.rest_tail, 1.0f));
        }
    }

    const std::optional<MeshQuery>& query_of(size_t v) const {
        return queries_[region_of(topology_.parts[v])];
    }

    std::vector<Vec3> body_normals() {
        std::vector<Vec3> normals;
        compute_normals(std::span(places()).first(count_), topology_.indices, normals);
        return normals;
    }

    /// Closest points of skin that faces the same way, with less and less stiffness.
    void approach() {
        constexpr int kRounds = 12;
        constexpr float kReach_m = 0.15f, kLastReach_m = 0.05f, kStiff = 20.0f, kLastStiff = 1.0f,
                        kFacing = 0.3f;
        std::vector<Vec3> wanted(count_);
        std::vector<float> weights(count_);
        for (int round = 0; round < kRounds; ++round) {
            const float t = float(round) / float(kRounds - 1);
            const float reach = glm::mix(kReach_m, kLastReach_m, t),
                        stiff = kStiff * std::pow(kLastStiff / kStiff, t);
            const std::vector<Vec3> normals = body_normals();
            for (size_t v = 0; v < count_; ++v) {
                wanted[v] = Vec3(0.0f), weights[v] = 0.0f;
                if (is_bare_[v] || !query_of(v)) continue;
                const MeshQuery::Closest closest = query_of(v)->closest(places()[v]);
                if (closest.distance > reach || glm::dot(closest.normal, normals[v]) < kFacing) continue;
                wanted[v] = closest.point - places()[v];
                weights[v] = 1.0f;
            }
            const std::vector<Vec3> shifts = membrane_.even(wanted, weights, stiff, kEvenRounds);
            for (size_t v = 0; v < count_; ++v) places()[v] += shifts[v];
        }
    }

    /// Until what counts of the character's skin lies inside: clothes that it has on, too.
    void enclose() {
        constexpr int kRounds = 6;
        constexpr float kFarthest_m = 0.06f, kStiff = 0.3f, kClear_m = 0.001f;
        out_.outside_m.assign(out_.skin.size(), 0.0f);
        const std::span<const Vec3> all = std::span(places()).first(count_);
        MeshQuery own(all, topology_.indices);
        std::vector<Vec3> wanted(count_);
        std::vector<float> weights(count_);
        for (int round = 0; round < kRounds; ++round) {
            std::fill(wanted.begin(), wanted.end(), Vec3(0.0f));
            std::fill(weights.begin(), weights.end(), 0.0f);
            for_outside(own, [&](const Vec3&, const MeshQuery::Closest& closest, float outside, uint32_t) {
                if (outside < -kClear_m || closest.distance > kFarthest_m ||
                    outside < 0.7f * closest.distance)
                    return;
                const Vec3 shift = (outside + kClear_m) * closest.normal;
                for (size_t j = 0; j < 3; ++j) {
                    const uint32_t v = topology_.indices[3 * closest.triangle + j];
                    if (glm::dot(shift, shift) < glm::dot(wanted[v], wanted[v])) continue;
                    wanted[v] = shift, weights[v] = 1.0f;
                }
            });
            const std::vector<Vec3> shifts = membrane_.even(wanted, weights, kStiff, kEvenRounds);
            for (size_t v = 0; v < count_; ++v) places()[v] += shifts[v];
            own.update(all);
        }
        for_outside(own, [&](const Vec3&, const MeshQuery::Closest&, float outside, uint32_t vertex) {
            if (vertex != UINT32_MAX) out_.outside_m[vertex] = std::max(out_.outside_m[vertex], outside);
        });
    }

    /// Calls with(place, closest, how far outside, vertex or UINT32_MAX) for corners of the character's
    /// triangles, which may be larger than the body's, and for places between them, where garments may be
    /// worn.
    template <typename With>
    void for_outside(const MeshQuery& own, const With& with) const {
        constexpr Vec3 kPlaces[] = {{1, 0, 0},
                                    {0, 1, 0},
                                    {0, 0, 1},
                                    {0.5f, 0.5f, 0},
                                    {0.5f, 0, 0.5f},
                                    {0, 0.5f, 0.5f},
                                    {1 / 3.0f, 1 / 3.0f, 1 / 3.0f}};
        for (size_t r = 0; r < kRegions; ++r)
            for (size_t i = 0; i + 2 < triangles_[r].size(); i += 3) {
                const uint32_t* t = &triangles_[r][i];
                for (size_t k = 0; k < std::size(kPlaces); ++k) {
                    const Vec3 p = kPlaces[k].x * out_.skin[t[0]] + kPlaces[k].y * out_.skin[t[1]] +
                                   kPlaces[k].z * out_.skin[t[2]];
                    const MeshQuery::Closest closest = own.closest(p);
                    const uint32_t* corner = &topology_.indices[3 * closest.triangle];
                    if (std::any_of(corner, corner + 3, [&](uint32_t v) { return is_bare_[v]; }) ||
                        std::none_of(corner, corner + 3,
                                     [&](uint32_t v) { return region_of(topology_.parts[v]) == r; }))
                        continue;
                    with(p, closest, glm::dot(p - closest.point, closest.normal), k < 3 ? t[k] : UINT32_MAX);
                }
            }
    }

    void finish() {
        Mesh& rest = out_.source.rest;
        for (size_t i = 0; i < topology_.seam_sources.size(); ++i)
            rest.positions[count_ + i] = rest.positions[topology_.seam_sources[i]];
        rest.normals = body_normals();
        for (const uint32_t source : topology_.seam_sources)
            rest.normals.push_back(Vec3(rest.normals[source]));
        float lowest = 1e9f;
        for (const Vec3& p : rest.positions) lowest = std::min(lowest, p.y);
        if (lowest == 0.0f) return;
        const Vec3 up(0.0f, -lowest, 0.0f);
        for (Vec3& p : rest.positions) p += up;
        for (Vec3& p : out_.skin) p += up;
        for (AvatarBone& bone : out_.source.bones) bone.rest_head += up, bone.rest_tail += up;
        for (Mat4& m : out_.from_rest) m = glm::translate(Mat4(1.0f), up) * m;
        for (auto& query : queries_)
            if (query) query->update(out_.skin);
    }

    /// The bones of the closest skin of the same region; what is no humanoid bone counts as the one that it
    /// hangs on.
    void carry() {
        std::vector<uint16_t> merged(character_.bones.size());
        for (size_t b = 0; b < merged.size(); ++b) {
            const AvatarBone& bone = character_.bones[b];
            merged[b] = bone.bone >= 0 || bone.is_twist || bone.parent < 0 ? uint16_t(b)
                                                                           : merged[size_t(bone.parent)];
        }
        const size_t bones = merged.size();
        std::vector<float> rows(count_ * bones, 0.0f);
        for (size_t v = 0; v < count_; ++v) {
            const auto r = size_t(region_of(topology_.parts[v]));
            if (!queries_[r]) continue;
            const MeshQuery::Closest closest = queries_[r]->closest(places()[v]);
            const float shares[3] = {1.0f - closest.uv.x - closest.uv.y, closest.uv.x, closest.uv.y};
            for (size_t j = 0; j < 3; ++j) {
                const uint32_t corner = triangles_[r][3 * closest.triangle + j];
                for (size_t k = 0; k < size_t(kSkinBones); ++k)
                    rows[v * bones + merged[character_.skin_bones[corner][k]]] +=
                        shares[j] * character_.skin_weights[corner][k];
            }
        }
        // Evened out a little: the character's own triangles may be large.
        constexpr int kRounds = 3;
        std::vector<float> before;
        for (int round = 0; round < kRounds; ++round) {
            before = rows;
            for (size_t v = 0; v < count_; ++v)
                for (size_t b = 0; b < bones; ++b) {
                    float sum = 0.0f;
                    const std::span<const uint32_t> around = membrane_.neighbours(v);
                    for (const uint32_t n : around) sum += before[n * bones + b];
                    if (!around.empty())
                        rows[v * bones + b] =
                            0.5f * before[v * bones + b] + 0.5f * sum / float(around.size());
                }
        }
        for (size_t v = 0; v < count_; ++v) {
            std::vector<std::pair<float, uint16_t>> order;
            for (size_t b = 0; b < bones; ++b)
                if (rows[v * bones + b] > 0.01f) order.emplace_back(rows[v * bones + b], uint16_t(b));
            if (order.empty()) order.emplace_back(1.0f, hips_of_character());
            std::sort(order.rbegin(), order.rend());
            order.resize(std::min<size_t>(order.size(), 4));  // as many as all engines take
            SkinBones by{};
            SkinWeights shares{};
            float sum = 0.0f;
            for (const auto& [share, bone] : order) sum += share;
            for (size_t k = 0; k < order.size(); ++k)
                by[k] = order[k].second, shares[k] = order[k].first / sum;
            out_.skin_bones.push_back(by), out_.skin_weights.push_back(shares);
        }
    }

    uint16_t hips_of_character() const {
        for (size_t b = 0; b < character_.bones.size(); ++b)
            if (character_.bones[b].bone == VFIT_BONE_HIPS) return uint16_t(b);
        return 0;
    }

    const AvatarSource& character_;
    const BodyModel& model_;
    const BodyTopology& topology_;
    const size_t count_;
    const Membrane membrane_;
    std::span<const uint8_t> left_out_;
    CharacterBody out_;
    std::array<Vec3, kBoneCount> model_joints_{}, joints_{};
    std::vector<int> humanoid_;     // one a bone of the character
    std::vector<uint8_t> is_bare_;  // one a vertex of the body: of the head or a hand, where no garment goes
    std::vector<uint8_t> counts_;   // one a vertex of the character: 1, a region has it
    std::array<std::vector<uint32_t>, kRegions> triangles_;
    std::array<std::optional<MeshQuery>, kRegions> queries_;
};

}  // namespace

CharacterBody body_in(const AvatarSource& character, const std::shared_ptr<const BodyModel>& model,
                      vfit_sex sex, std::span<const uint8_t> left_out) {
    return Registration(character, model, sex, left_out).run();
}

}  // namespace vfit
