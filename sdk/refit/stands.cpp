#include "refit/stands.h"

#include <glm/gtc/matrix_transform.hpp>
#include <iterator>

#include "avatar/avatar.h"

namespace vfit {

namespace {

/// Evenly spread over 0 to 1 (Halton 1960): item i of the sequence of that prime.
float halton(uint32_t i, uint32_t prime) {
    float out = 0.0f, digit = 1.0f;
    for (; i > 0; i /= prime) digit /= float(prime), out += digit * float(i % prime);
    return out;
}

/// Angles that walking people and their gestures reach, in radians; limbs of both sides are alike.
struct Range {
    float low, high;
};
constexpr Range kLowered{0.7f, 1.35f}, kSwing{-0.8f, 0.9f}, kArmTwist{-0.7f, 0.7f}, kElbow{0.0f, 1.7f},
    kHandTwist{-1.2f, 1.2f}, kWristBend{-0.6f, 0.6f}, kWristAside{-0.4f, 0.4f}, kStep{-0.55f, 0.55f},
    kInwards{-0.1f, 0.15f}, kLegTwist{-0.25f, 0.25f}, kKnee{0.0f, 1.3f}, kAnkle{-0.6f, 0.6f},
    kFootAside{-0.25f, 0.25f}, kTrunkTwist{-0.2f, 0.2f}, kNod{-0.3f, 0.3f};
constexpr uint32_t kStands = 60;

Quat turned(float angle, const Vec3& axis) { return glm::angleAxis(angle, axis); }

/// In the T-pose, with hanging arms, and as people move.
std::vector<Pose> usual_poses(const Avatar& figure) {
    constexpr uint32_t kPrimes[] = {2,  3,  5,  7,  11, 13, 17, 19, 23, 29, 31,  37,  41,  43, 47,
                                    53, 59, 61, 67, 71, 73, 79, 83, 89, 97, 101, 103, 107, 109};
    const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    Pose straight;
    straight.hips_position = figure.skeleton().offset[VFIT_BONE_HIPS];
    std::vector<Pose> poses = {straight, straight};
    constexpr float kHanging = 1.3f;
    poses[1].rotation[VFIT_BONE_LEFT_UPPER_ARM] = turned(-kHanging, z);
    poses[1].rotation[VFIT_BONE_RIGHT_UPPER_ARM] = turned(kHanging, z);
    for (uint32_t i = 1; i <= kStands; ++i) {
        Pose& pose = poses.emplace_back(straight);
        size_t next = 0;
        constexpr float kReaches[] = {1.0f, 0.6f, 0.3f};  // most motions are small
        const float reach = kReaches[i % std::size(kReaches)];
        // The first items of the sequences of large primes lie close together: those are left out.
        const auto draw = [&](const Range& range) {
            const uint32_t prime = kPrimes[next++];
            return reach * (range.low + (range.high - range.low) * halton(prime + i, prime));
        };
        auto& r = pose.rotation;
        const float step = draw(kStep);  // of the left leg; the right one is behind
        // side: 1 left, -1 right; turns about Y and Z are mirrored.
        const auto limbs = [&](float side, int arm, int forearm, int hand, int thigh, int shank, int foot) {
            // One by one: compilers may take the operands of a product in any order.
            const float arm_twist = draw(kArmTwist), lowered = draw(kLowered), swing = draw(kSwing),
                        elbow = draw(kElbow), bend = draw(kWristBend), aside = draw(kWristAside),
                        hand_twist = draw(kHandTwist), leg_twist = draw(kLegTwist), inwards = draw(kInwards),
                        knee = draw(kKnee), foot_aside = draw(kFootAside), ankle = draw(kAnkle);
            r[size_t(arm)] = turned(-swing, x) * turned(-side * lowered / reach, z) * turned(arm_twist, x);
            r[size_t(forearm)] = turned(-side * elbow, y);
            r[size_t(hand)] = turned(hand_twist, x) * turned(-side * aside, y) * turned(-side * bend, z);
            r[size_t(thigh)] =
                turned(-side * step, x) * turned(-side * inwards, z) * turned(side * leg_twist, y);
            r[size_t(shank)] = turned(knee, x);
            r[size_t(foot)] = turned(-ankle, x) * turned(foot_aside, z);
        };
        limbs(1.0f, VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_LEFT_HAND,
              VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_LEFT_FOOT);
        limbs(-1.0f, VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_RIGHT_LOWER_ARM, VFIT_BONE_RIGHT_HAND,
              VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG, VFIT_BONE_RIGHT_FOOT);
        r[VFIT_BONE_SPINE] = r[VFIT_BONE_CHEST] = turned(draw(kTrunkTwist), y);
        const float turn_of_head = draw(kTrunkTwist), nod = draw(kNod);
        r[VFIT_BONE_NECK] = turned(nod, x) * turned(turn_of_head, y);
    }
    return poses;
}

}  // namespace

Mat4 blended(const SkinBones& bones, const SkinWeights& weights, std::span<const Mat4> matrices) {
    Mat4 m(0.0f);
    for (size_t k = 0; k < size_t(kSkinBones); ++k)
        if (weights[k] > 0.0f) m += weights[k] * matrices[bones[k]];
    return m;
}

std::vector<Stand> usual_stands(const AvatarSource& character, const CharacterBody& body) {
    std::vector<Stand> stands = {{body.from_rest, body.skin}};
    AvatarDesc plain;
    plain.single_bones = true;
    Avatar figure(character, plain);
    const Mat4 larger = glm::scale(Mat4(1.0f), Vec3(body.scale));
    for (const Pose& pose : usual_poses(figure)) {
        figure.move(pose);
        Stand& stand = stands.emplace_back();
        for (const Mat4& m : figure.skinning_matrices()) stand.matrices.push_back(larger * m);
        for (size_t v = 0; v < character.rest.positions.size(); ++v)
            stand.skin.push_back(
                Vec3(blended(character.skin_bones[v], character.skin_weights[v], stand.matrices) *
                     Vec4(character.rest.positions[v], 1.0f)));
    }
    return stands;
}

}  // namespace vfit
