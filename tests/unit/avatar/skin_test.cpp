// Linear blend skinning on a tube about a synthetic forearm.
#include "avatar/skin.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "synthetic_rig.h"

namespace vfit {
namespace {

struct Tube {
    std::vector<Vec3> rest;
    std::vector<SkinBones> bones;
    std::vector<SkinWeights> weights;
    std::vector<float> t;  // along the limb
};

/// A ring of points at each of eleven places along the limb, carried by its original bone alone.
Tube tube_about(const LimbChain& limb) {
    Tube tube;
    const Vec3 axis = limb.far_joint - limb.near_joint;
    const Vec3 a = glm::normalize(glm::cross(axis, Vec3(0, 1, 0.3f))), b = glm::normalize(glm::cross(axis,
        a));
    for (int i = 0; i <= 10; ++i)
        for (int k = 0; k < 8; ++k) {
            const float t = 0.1f * float(i), angle = 0.25f * kPi * float(k);
            tube.rest.push_back(limb.near_joint + axis * t + 0.04f * (std::cos(angle) * a +
                std::sin(angle) * b));
            tube.bones.push_back({static_cast<uint16_t>(limb.rig_bones[0])});
            tube.weights.push_back({1.0f});
            tube.t.push_back(t);
        }
    return tube;
}

TEST(SplitLimbWeights, GrowLinearlyFromOriginalToExtension) {
    const AvatarRig rig(synthetic_rig(), 0.0f, 1);
    const LimbChain& limb = rig.limbs()[1];
    Tube tube = tube_about(limb);
    split_limb_weights(tube.rest, rig.limbs(), tube.bones, tube.weights);
    for (size_t v = 0; v < tube.rest.size(); ++v) {
        float original = 0.0f, extension = 0.0f;
        for (size_t k = 0; k < kSkinBones; ++k) {
            if (tube.weights[v][k] == 0.0f) continue;
            (tube.bones[v][k] == limb.rig_bones[0] ? original : extension) += tube.weights[v][k];
        }
        EXPECT_NEAR(original, 1.0f - tube.t[v], 1e-5f);
        EXPECT_NEAR(extension, tube.t[v], 1e-5f);
    }
}

TEST(SplitLimbWeights, KeepTheShareOfOtherBonesAndSumToOne) {
    const AvatarRig rig(synthetic_rig(), 0.0f, 4);
    const LimbChain& limb = rig.limbs()[1];
    const auto hand = static_cast<uint16_t>(rig.rig_bone(VFIT_BONE_LEFT_HAND));
    Tube tube = tube_about(limb);
    for (size_t v = 0; v < tube.rest.size(); ++v) {
        tube.bones[v] = {static_cast<uint16_t>(limb.rig_bones[0]),
            static_cast<uint16_t>(limb.rig_bones.back()), hand};
        tube.weights[v] = {0.3f, 0.3f, 0.4f};
    }
    split_limb_weights(tube.rest, rig.limbs(), tube.bones, tube.weights);
    for (size_t v = 0; v < tube.rest.size(); ++v) {
        float sum = 0.0f, of_hand = 0.0f;
        for (size_t k = 0; k < kSkinBones; ++k) {
            sum += tube.weights[v][k];
            if (tube.bones[v][k] == hand) of_hand += tube.weights[v][k];
            EXPECT_LE(tube.weights[v][k], tube.weights[v][k > 0 ? k - 1 : 0]);
        }
        EXPECT_NEAR(sum, 1.0f, 1e-6f);
        EXPECT_NEAR(of_hand, 0.4f, 1e-6f);
    }
}

TEST(Skin, OneBoneMovesItsVerticesRigidly) {
    const AvatarRig rig(synthetic_rig(), 0.0f, 1);
    const Tube tube = tube_about(rig.limbs()[1]);
    const Skin skin(tube.bones, tube.weights);
    Pose pose;
    pose.rotation[VFIT_BONE_LEFT_UPPER_ARM] = glm::angleAxis(0.7f, glm::normalize(Vec3(1, 2, 3)));
    PosedSkeleton posed;
    std::vector<Mat4> matrices(rig.bones().size());
    rig.pose(pose, posed, matrices);
    std::vector<Vec3> normals(tube.rest.size(), Vec3(0, 1, 0)), out(tube.rest.size()),
        out_normals(tube.rest.size());
    const auto jobs = Jobs::own(0);
    skin.pose(matrices, tube.rest, normals, out, out_normals, *jobs);
    for (size_t v = 1; v < out.size(); ++v) {
        EXPECT_NEAR(glm::distance(out[v], out[0]), glm::distance(tube.rest[v], tube.rest[0]), 2e-6f);
        EXPECT_NEAR(glm::length(out_normals[v]), 1.0f, 1e-6f);
        EXPECT_LT(glm::distance(out_normals[v], out_normals[0]), 1e-6f);
    }
}

TEST(Skin, WorkerCountDoesNotChangeABit) {
    const AvatarRig rig(synthetic_rig(), 0.0f, 4);
    Tube tube = tube_about(rig.limbs()[1]);
    split_limb_weights(tube.rest, rig.limbs(), tube.bones, tube.weights);
    Tube many;  // several chunks of work
    for (int i = 0; i < 100; ++i) {
        many.rest.insert(many.rest.end(), tube.rest.begin(), tube.rest.end());
        many.bones.insert(many.bones.end(), tube.bones.begin(), tube.bones.end());
        many.weights.insert(many.weights.end(), tube.weights.begin(), tube.weights.end());
    }
    const Skin skin(many.bones, many.weights);
    Pose pose;
    pose.rotation[VFIT_BONE_LEFT_HAND] = glm::angleAxis(1.0f, Vec3(1, 0, 0));
    PosedSkeleton posed;
    std::vector<Mat4> matrices(rig.bones().size());
    rig.pose(pose, posed, matrices);
    std::vector<Vec3> alone(many.rest.size()), together(many.rest.size());
    skin.pose(matrices, many.rest, {}, alone, {}, *Jobs::own(0));
    skin.pose(matrices, many.rest, {}, together, {}, *Jobs::own(3));
    EXPECT_EQ(alone, together);
}

TEST(Skin, VertexThatNoBoneCarriesIsRefused) {
    const std::vector<SkinBones> bones(2);
    std::vector<SkinWeights> weights(2);
    weights[0][0] = 1.0f;
    try {
        const Skin skin(bones, weights);
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), VFIT_ERROR_DATA);
    }
}

}  // namespace
}  // namespace vfit
