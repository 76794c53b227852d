// A small rig in an A-pose with the parts that matter: twist segments, bones between humanoid bones, fingers.
#pragma once

#include <string>
#include <vector>

#include "avatar/rig.h"

namespace vfit {

inline std::vector<AvatarBone> synthetic_rig() {
    std::vector<AvatarBone> bones;
    const auto add = [&](const std::string& name, int parent, int bone, const Vec3& head) {
        bones.push_back({name, parent, bone, head, head});
        return static_cast<int>(bones.size()) - 1;
    };
    const int root = add("root", -1, VFIT_BONE_HIPS, {0, 0.95f, -0.04f});
    const int spine = add("spine", root, VFIT_BONE_SPINE, {0, 1.0f, 0});
    const int between = add("spine.between", spine, -1, {0, 1.05f, 0});
    const int chest = add("chest", between, VFIT_BONE_CHEST, {0, 1.1f, 0.01f});
    const int upper = add("upperChest", chest, VFIT_BONE_UPPER_CHEST, {0, 1.3f, 0});
    const int neck = add("neck", upper, VFIT_BONE_NECK, {0, 1.45f, -0.01f});
    add("head", neck, VFIT_BONE_HEAD, {0, 1.55f, 0.02f});
    for (const float s : {1.0f, -1.0f}) {
        const bool left = s > 0.0f;
        const auto pick = [&](int l, int r) { return left ? l : r; };
        const std::string side = left ? ".L" : ".R";
        const int clavicle =
            add("clavicle" + side, upper, pick(VFIT_BONE_LEFT_SHOULDER, VFIT_BONE_RIGHT_SHOULDER),
                {s * 0.03f, 1.4f, 0});
        const int shoulder = add("shoulder" + side, clavicle, -1, {s * 0.1f, 1.42f, 0});
        const int arm = add("arm" + side, shoulder, pick(VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_RIGHT_UPPER_ARM),
                            {s * 0.17f, 1.40f, 0});
        const int arm2 = add("arm2" + side, arm, -1, {s * 0.25f, 1.29f, 0.0f});
        const int fore = add("fore" + side, arm2, pick(VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_RIGHT_LOWER_ARM),
                             {s * 0.35f, 1.20f, 0.01f});
        const int fore2 = add("fore2" + side, fore, -1, {s * 0.42f, 1.12f, 0.06f});
        const int hand = add("hand" + side, fore2, pick(VFIT_BONE_LEFT_HAND, VFIT_BONE_RIGHT_HAND),
                             {s * 0.50f, 1.03f, 0.12f});
        bones[static_cast<size_t>(hand)].rest_tail = {s * 0.55f, 0.97f, 0.17f};
        add("finger" + side, hand, -1, {s * 0.55f, 0.97f, 0.17f});
        const int thigh = add("thigh" + side, root, pick(VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG),
                              {s * 0.09f, 0.93f, 0});
        const int thigh2 = add("thigh2" + side, thigh, -1, {s * 0.1f, 0.8f, -0.01f});
        const int shank =
            add("shank" + side, thigh2, pick(VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_RIGHT_LOWER_LEG),
                {s * 0.12f, 0.5f, 0.01f});
        const int foot = add("foot" + side, shank, pick(VFIT_BONE_LEFT_FOOT, VFIT_BONE_RIGHT_FOOT),
                             {s * 0.15f, 0.09f, -0.02f});
        add("toes" + side, foot, pick(VFIT_BONE_LEFT_TOES, VFIT_BONE_RIGHT_TOES), {s * 0.16f, 0.02f, 0.1f});
    }
    return bones;
}

}  // namespace vfit
