// Skinning of a tube about a synthetic forearm.
#include "avatar/skin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

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
    const Vec3 a = glm::normalize(glm::cross(axis, Vec3(0, 1, 0.3f))),
               b = glm::normalize(glm::cross(axis, a));
    for (int i = 0; i <= 10; ++i)
        for (int k = 0; k < 8; ++k) {
            const float t = 0.1f * float(i), angle = 0.25f * kPi * float(k);
            tube.rest.push_back(limb.near_joint + axis * t +
                                0.04f * (std::cos(angle) * a + std::sin(angle) * b));
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

/// A tube as a skin, its normals away from the limb, and a pose that turns the hand about the limb.
struct SkinnedTube {
    AvatarRig rig{synthetic_rig(), 0.0f, 4};
    Tube tube = tube_about(rig.limbs()[1]);
    std::vector<Vec3> normals;
    std::vector<Mat4> matrices = std::vector<Mat4>(rig.bones().size());

    explicit SkinnedTube(float twist, int copies = 1) {
        split_limb_weights(tube.rest, rig.limbs(), tube.bones, tube.weights);
        const Tube once = tube;
        for (int i = 1; i < copies; ++i) {
            tube.rest.insert(tube.rest.end(), once.rest.begin(), once.rest.end());
            tube.bones.insert(tube.bones.end(), once.bones.begin(), once.bones.end());
            tube.weights.insert(tube.weights.end(), once.weights.begin(), once.weights.end());
        }
        for (const Vec3& p : tube.rest) normals.push_back(glm::normalize(p - on_limb(p)));
        Pose pose;
        pose.rotation[VFIT_BONE_LEFT_HAND] = glm::angleAxis(twist, Vec3(1, 0, 0));
        pose.rotation[VFIT_BONE_LEFT_LOWER_ARM] = glm::angleAxis(0.4f, Vec3(0, 1, 0));
        pose.hips_position = Vec3(0.3f, 1.1f, -0.4f);
        PosedSkeleton posed;
        rig.pose(pose, posed, matrices);
    }
    Vec3 on_limb(const Vec3& p) const {
        const LimbChain& limb = rig.limbs()[1];
        const Vec3 axis = limb.far_joint - limb.near_joint;
        return limb.near_joint + axis * (glm::dot(p - limb.near_joint, axis) / glm::dot(axis, axis));
    }
    Skin skin() const { return Skin(tube.bones, tube.weights, tube.rest, normals); }
};

struct PosedSkin {
    std::vector<Vec3> positions, normals;
};

PosedSkin pose_skin(const SkinnedTube& t, SkinMethod method = SkinMethod::linear, const Axes& axes = Axes(),
                    uint32_t workers = 0) {
    PosedSkin out{std::vector<Vec3>(t.tube.rest.size()), std::vector<Vec3>(t.tube.rest.size())};
    SkinTarget target;
    target.positions = out.positions.data();
    target.normals = out.normals.data();
    Skin::Scratch scratch;
    t.skin().pose(t.matrices, method, axes, target, scratch, *Jobs::own(workers));
    return out;
}

TEST(Skin, IsTheWeightedSumOfItsBones) {
    const SkinnedTube t(1.2f);
    const PosedSkin posed = pose_skin(t);
    for (size_t v = 0; v < t.tube.rest.size(); ++v) {
        Vec3 p(0.0f), n(0.0f);
        for (size_t k = 0; k < kSkinBones; ++k) {
            const Mat4& m = t.matrices[t.tube.bones[v][k]];
            p += t.tube.weights[v][k] * Vec3(m * Vec4(t.tube.rest[v], 1.0f));
            n += t.tube.weights[v][k] * (Mat3(m) * t.normals[v]);
        }
        EXPECT_LT(glm::distance(posed.positions[v], p), 1e-6f);
        EXPECT_LT(glm::distance(posed.normals[v], glm::normalize(n)), 1e-5f);
    }
}

TEST(Skin, IsWrittenInTheHostsAxes) {
    const SkinnedTube t(1.2f);
    const PosedSkin inside = pose_skin(t);
    for (const SkinMethod method : {SkinMethod::linear, SkinMethod::dual_quaternion})
        for (const vfit_axes convention : {VFIT_AXES_UNITY, VFIT_AXES_UNREAL})
            for (const bool mirror : {false, true}) {
                const Axes axes(convention, mirror);
                const PosedSkin own = pose_skin(t, method), out = pose_skin(t, method, axes);
                for (size_t v = 0; v < own.positions.size(); ++v) {
                    EXPECT_LT(glm::distance(out.positions[v], axes.point_out(own.positions[v])),
                              1e-6f * axes.unit());
                    EXPECT_LT(glm::distance(out.normals[v], axes.direction_out(own.normals[v])), 1e-5f);
                }
            }
}

TEST(Skin, LeavesTheHostsOtherBytesAlone) {
    const SkinnedTube t(1.2f);
    const PosedSkin packed = pose_skin(t);
    constexpr size_t kStride = 34;  // not even a multiple of a float
    std::vector<unsigned char> bytes(t.tube.rest.size() * kStride + 16, 0xA5);
    SkinTarget target;
    target.positions = bytes.data() + 1;
    target.normals = bytes.data() + 16;
    target.position_stride = target.normal_stride = kStride;
    Skin::Scratch scratch;
    t.skin().pose(t.matrices, SkinMethod::linear, Axes(), target, scratch, *Jobs::own(0));
    std::vector<bool> written(bytes.size(), false);
    for (size_t v = 0; v < t.tube.rest.size(); ++v) {
        EXPECT_EQ(std::memcmp(&bytes[v * kStride + 1], &packed.positions[v], 12), 0);
        EXPECT_EQ(std::memcmp(&bytes[v * kStride + 16], &packed.normals[v], 12), 0);
        for (size_t k = 0; k < 12; ++k) written[v * kStride + 1 + k] = written[v * kStride + 16 + k] = true;
    }
    for (size_t i = 0; i < bytes.size(); ++i) EXPECT_TRUE(written[i] || bytes[i] == 0xA5) << i;
}

TEST(Skin, PositionsAloneAreTheSame) {
    const SkinnedTube t(0.6f);
    std::vector<Vec3> positions(t.tube.rest.size());
    SkinTarget target;
    target.positions = positions.data();
    Skin::Scratch scratch;
    t.skin().pose(t.matrices, SkinMethod::linear, Axes(), target, scratch, *Jobs::own(0));
    EXPECT_EQ(positions, pose_skin(t).positions);
}

TEST(Skin, OneBoneMovesItsVerticesRigidlyByEitherMethod) {
    SkinnedTube t(0.0f);
    const auto bone = static_cast<uint16_t>(t.rig.limbs()[1].rig_bones[0]);
    for (size_t v = 0; v < t.tube.rest.size(); ++v) {
        t.tube.bones[v] = {bone};
        t.tube.weights[v] = {1.0f};
    }
    for (const SkinMethod method : {SkinMethod::linear, SkinMethod::dual_quaternion}) {
        const PosedSkin out = pose_skin(t, method);
        for (size_t v = 1; v < out.positions.size(); ++v) {
            EXPECT_LT(glm::distance(out.positions[v], Vec3(t.matrices[bone] * Vec4(t.tube.rest[v], 1.0f))),
                      1e-6f);
            EXPECT_LT(glm::distance(out.normals[v], Mat3(t.matrices[bone]) * t.normals[v]), 1e-5f);
        }
    }
}

TEST(Skin, DualQuaternionsKeepTheSectionOfATwist) {
    // A half turn between two bones alone: the linear blend's middle shrinks to a line.
    SkinnedTube t(3.0f);
    const auto near_bone = static_cast<uint16_t>(t.rig.limbs()[1].rig_bones.front());
    const auto far_bone = static_cast<uint16_t>(t.rig.limbs()[1].rig_bones.back());
    for (size_t v = 0; v < t.tube.rest.size(); ++v) {
        t.tube.bones[v] = {near_bone, far_bone};
        t.tube.weights[v] = {1.0f - t.tube.t[v], t.tube.t[v]};
        if (t.tube.t[v] > 0.5f) {
            std::swap(t.tube.bones[v][0], t.tube.bones[v][1]);
            std::swap(t.tube.weights[v][0], t.tube.weights[v][1]);
        }
    }
    const auto radius = [&](const PosedSkin& posed, size_t v) {
        Vec3 middle(0.0f);
        const size_t ring = v / 8 * 8;
        for (size_t k = 0; k < 8; ++k) middle += posed.positions[ring + k] / 8.0f;
        return glm::distance(posed.positions[v], middle);
    };
    const PosedSkin linear = pose_skin(t), dual = pose_skin(t, SkinMethod::dual_quaternion);
    EXPECT_LT(radius(linear, 5 * 8), 0.005f);
    for (size_t v = 0; v < t.tube.rest.size(); ++v) {
        EXPECT_NEAR(radius(dual, v), 0.04f, 1e-4f) << v;
        EXPECT_NEAR(glm::length(dual.normals[v]), 1.0f, 1e-5f);
    }
}

TEST(Skin, WorkerCountDoesNotChangeABit) {
    const SkinnedTube t(1.0f, 100);  // several chunks of work
    for (const SkinMethod method : {SkinMethod::linear, SkinMethod::dual_quaternion}) {
        const PosedSkin alone = pose_skin(t, method), together = pose_skin(t, method, Axes(), 3);
        EXPECT_EQ(alone.positions, together.positions);
        EXPECT_EQ(alone.normals, together.normals);
    }
}

TEST(Skin, VertexThatNoBoneCarriesIsRefused) {
    const std::vector<SkinBones> bones(2);
    std::vector<SkinWeights> weights(2);
    const std::vector<Vec3> rest(2);
    weights[0][0] = 1.0f;
    try {
        const Skin skin(bones, weights, rest, rest);
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), VFIT_ERROR_DATA);
    }
}

}  // namespace
}  // namespace vfit
