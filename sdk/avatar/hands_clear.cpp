#include "avatar/hands_clear.h"

#include <algorithm>
#include <cmath>

#include "body/joint_bones.h"
#include "math/quaternion.h"
#include "math/two_bone_ik.h"

namespace vfit {

namespace {

constexpr float kGap_m = 0.005f;   // that stays between hand and skin
constexpr float kBlend_m = 0.02f;  // over which two neighbouring bones share a place
constexpr int kRounds = 3;         // a hand led out of the thigh may touch the hip
constexpr size_t kReach = 2;       // cells of an outline that a vertex speaks for, to either side
constexpr float kAlongHand[] = {0.1f, kHandCentre, 1.0f,
                                1.6f};  // from the wrist to the knuckles, and on to the fingers
constexpr float kLeastOut_m = 1e-4f;

struct ArmBones {
    int upper, lower, hand;
    float side;  // of the body: +X is left
};
constexpr ArmBones kArms[2] = {
    {VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_LEFT_HAND, 1.0f},
    {VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_RIGHT_LOWER_ARM, VFIT_BONE_RIGHT_HAND, -1.0f}};

using glm::dot;

}  // namespace

void HandsClear::Outline::learn(std::span<const Vec3> points) {
    radius.fill(0.0f);
    std::array<bool, kLevels * kAngles> known{};
    for (const Vec3& p : points) {
        const Vec3 d = p - start;
        const float level = (dot(d, axis) - least) / length * float(kLevels);
        if (level < 0.0f || level >= float(kLevels)) continue;
        const float out = std::hypot(dot(d, x), dot(d, z));
        const float angle = std::atan2(dot(d, z), dot(d, x)) / (2.0f * kPi) + 0.5f;
        const auto cell =
            size_t(level) * kAngles + size_t(std::min(angle * float(kAngles), float(kAngles) - 0.5f));
        radius[cell] = std::max(radius[cell], out);
        known[cell] = true;
    }
    // Cells without a vertex take their neighbours' on the same level; where these have none either, nothing
    // is there.
    for (size_t level = 0; level < size_t(kLevels); ++level)
        for (size_t a = 0; a < size_t(kAngles); ++a) {
            const size_t cell = level * kAngles + a;
            if (known[cell]) continue;
            for (size_t step = 1; step <= kReach && radius[cell] == 0.0f; ++step) {
                const size_t row = level * kAngles;
                const size_t before = row + (a + kAngles - step) % kAngles,
                             after = row + (a + step) % kAngles;
                if (known[before] || known[after])
                    radius[cell] =
                        std::max(known[before] ? radius[before] : 0.0f, known[after] ? radius[after] : 0.0f);
            }
        }
}

float HandsClear::Outline::at(float height, float angle) const {
    const float level =
        std::clamp((height - least) / length * float(kLevels) - 0.5f, 0.0f, float(kLevels - 1));
    const float turn = (angle / (2.0f * kPi) + 0.5f) * float(kAngles) - 0.5f + float(kAngles);
    const auto l0 = std::min(size_t(level), size_t(kLevels - 2));
    const auto a0 = size_t(turn) % kAngles, a1 = (a0 + 1) % kAngles;
    const float tl = level - float(l0), ta = turn - std::floor(turn);
    const auto cell = [&](size_t l, size_t a) { return radius[l * kAngles + a]; };
    return glm::mix(glm::mix(cell(l0, a0), cell(l0, a1), ta),
                    glm::mix(cell(l0 + 1, a0), cell(l0 + 1, a1), ta), tl);
}

HandsClear::HandsClear(const AvatarRig& rig, std::span<const Vec3> rest, std::span<const BodyPart> parts) {
    const auto add = [&](std::vector<int> humanoid, const Vec3& start, const Vec3& end, float before,
                         auto&& belongs) {
        Outline o;
        o.start = start;
        const float length = glm::distance(o.start, end);
        o.axis = length > 1e-3f ? (end - o.start) / length : Vec3(0, 1, 0);
        o.x = glm::normalize(Vec3(1, 0, 0) - o.axis.x * o.axis);
        o.z = glm::cross(o.x, o.axis);
        o.least = -before * length;
        o.length = std::max(length - o.least, 1e-3f);
        for (const int b : humanoid)
            if (rig.rig_bone(b) >= 0) {
                o.bones.push_back(rig.rig_bone(b));
                o.heights.push_back(dot(rig.rest_head(b) - o.start, o.axis));
            }
        std::vector<Vec3> points;
        for (size_t v = 0; v < rest.size(); ++v)
            if (belongs(parts[v])) points.push_back(rest[v]);
        o.learn(points);
        outlines_.push_back(std::move(o));
    };
    // From the crotch up to the armpits' height: above, shoulders and arms themselves are in the way.
    const Vec3 hips = rig.rest_head(VFIT_BONE_HIPS);
    const Vec3 shoulders =
        0.5f * (rig.rest_head(VFIT_BONE_LEFT_UPPER_ARM) + rig.rest_head(VFIT_BONE_RIGHT_UPPER_ARM));
    constexpr float kArmpit = 0.85f, kBelowHips = 0.3f;
    add({VFIT_BONE_HIPS, VFIT_BONE_SPINE, VFIT_BONE_CHEST, VFIT_BONE_UPPER_CHEST}, hips,
        glm::mix(hips, shoulders, kArmpit), kBelowHips,
        [](BodyPart part) { return part == BodyPart::kTorso; });
    // Thighs as seen from between them, so that the way out is always the hand's own side.
    const auto between = [&](int left, int right) {
        return 0.5f * (rig.rest_head(left) + rig.rest_head(right));
    };
    const Vec3 legs = between(VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG);
    const Vec3 knees = between(VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_RIGHT_LOWER_LEG);
    add({VFIT_BONE_LEFT_UPPER_LEG}, legs, knees, 0.0f,
        [](BodyPart part) { return part == BodyPart::kLeftThigh || part == BodyPart::kTorso; });
    add({VFIT_BONE_RIGHT_UPPER_LEG}, legs, knees, 0.0f,
        [](BodyPart part) { return part == BodyPart::kRightThigh || part == BodyPart::kTorso; });

    for (size_t i = 0; i < 2; ++i) {
        const int bone = rig.rig_bone(kArms[i].hand);
        const AvatarBone& hand = rig.bones()[size_t(bone)];
        hands_[i].rig_bone = bone;
        for (size_t k = 0; k < std::size(kAlongHand); ++k)
            hands_[i].points[k] = glm::mix(hand.rest_head, hand.rest_tail, kAlongHand[k]);
        const Vec3 centre = glm::mix(hand.rest_head, hand.rest_tail, kHandCentre);
        const BodyPart own = i == 0 ? BodyPart::kLeftHand : BodyPart::kRightHand;
        const Vec3 palm = hand.rest_tail - hand.rest_head;
        const float length = std::max(glm::length(palm), 1e-3f);
        // Half the palm's thickness: the thinner half of its points lie so far from its axis.
        std::vector<float> off;
        for (size_t v = 0; v < rest.size(); ++v) {
            if (parts[v] != own) continue;
            const Vec3 d = rest[v] - centre;
            const float along = dot(d, palm / length);
            if (std::abs(along) < 0.25f * length) off.push_back(glm::length(d - along * palm / length));
        }
        if (off.empty()) continue;
        std::nth_element(off.begin(), off.begin() + std::ptrdiff_t(off.size() / 2), off.end());
        hands_[i].radius = off[off.size() / 2];
    }
}

HandsClear::Way HandsClear::way_out(const Outline& o, std::span<const Mat4> matrices, const Vec3& p,
                                    float radius, float side) const {
    // The place in the rest mesh, as the bones near it see it.
    Vec3 rest(0.0f);
    Mat3 turn(0.0f);
    float total = 0.0f;
    for (size_t i = 0; i < o.bones.size(); ++i) {
        const Mat4& m = matrices[size_t(o.bones[i])];
        const Vec3 own = glm::transpose(Mat3(m)) * (p - Vec3(m[3]));
        const float height = dot(own - o.start, o.axis);
        const float low = i == 0 ? -1e9f : o.heights[i],
                    high = i + 1 < o.bones.size() ? o.heights[i + 1] : 1e9f;
        const float beyond = std::max({low - height, height - high, 0.0f});
        const float w = std::exp(-beyond * beyond / (kBlend_m * kBlend_m)) + 1e-6f;
        rest += w * own;
        turn += w * Mat3(m);
        total += w;
    }
    rest /= total;
    const Vec3 d = rest - o.start;
    const float height = dot(d, o.axis);
    const float along_x = dot(d, o.x), along_z = dot(d, o.z);
    const float distance = std::hypot(along_x, along_z);
    // Beyond the ends the outline fades out over the hand's own size.
    const float past = std::max(o.least - height, height - (o.least + o.length));
    const float fade = std::clamp(1.0f - past / std::max(radius, 0.02f), 0.0f, 1.0f);
    if (fade <= 0.0f) return {};
    const float clear = o.at(height, std::atan2(along_z, along_x)) + radius + kGap_m;
    const float depth = fade * (clear - distance);
    if (depth <= 0.0f) return {};
    const Vec3 out = distance > 0.01f ? (along_x * o.x + along_z * o.z) / distance : side * o.x;
    return {glm::normalize(turn * out), depth};
}

void HandsClear::run(const PosedSkeleton& posed, std::span<const Mat4> matrices, Pose& pose) const {
    for (size_t i = 0; i < 2; ++i) {
        const ArmBones& arm = kArms[i];
        const Hand& hand = hands_[i];
        Vec3 moved(0.0f);
        for (int round = 0; round < kRounds; ++round)
            for (const Outline& outline : outlines_) {
                Way deepest;
                for (const Vec3& rest : hand.points) {
                    const Vec3 p = Vec3(matrices[size_t(hand.rig_bone)] * Vec4(rest, 1.0f)) + moved;
                    const Way way = way_out(outline, matrices, p, hand.radius, arm.side);
                    if (way.depth > deepest.depth) deepest = way;
                }
                moved += deepest.depth * deepest.out;
            }
        if (glm::length(moved) < kLeastOut_m) continue;

        const auto at = [&](int bone) { return posed.position[size_t(bone)]; };
        const auto turn = [&](int bone) { return posed.rotation[size_t(bone)]; };
        const Vec3 shoulder = at(arm.upper), elbow = at(arm.lower), wrist = at(arm.hand);
        const float upper = glm::distance(shoulder, elbow), lower = glm::distance(elbow, wrist);
        const TwoBoneSolution to =
            solve_two_bone(shoulder, upper, lower, wrist + moved, elbow - 0.5f * (shoulder + wrist), 0.0f);
        const Quat upper_turn =
            glm::normalize(shortest_arc(elbow - shoulder, to.middle - shoulder) * turn(arm.upper));
        const Quat lower_turn =
            glm::normalize(shortest_arc(wrist - elbow, to.end - to.middle) * turn(arm.lower));
        pose.rotation[size_t(arm.upper)] = glm::conjugate(turn(bone_parent(arm.upper))) * upper_turn;
        pose.rotation[size_t(arm.lower)] = glm::conjugate(upper_turn) * lower_turn;
        pose.rotation[size_t(arm.hand)] = glm::conjugate(lower_turn) * turn(arm.hand);
    }
}

}  // namespace vfit
