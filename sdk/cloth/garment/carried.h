// Places that bones carry, as they are gathered for a Skin.
#pragma once

#include <span>
#include <vector>

#include "avatar/skin.h"
#include "math/types.h"

namespace vfit {

struct Carried {
    std::vector<Vec3> rest;
    std::vector<SkinBones> bones;
    std::vector<SkinWeights> weights;

    void add(const Vec3& place, const SkinBones& by, const SkinWeights& shares) {
        rest.push_back(place), bones.push_back(by), weights.push_back(shares);
    }
    /// By the heaviest of all bones; smoothed weights have long tails.
    void add(const Vec3& place, std::span<const float> bone_weights);
    Skin skin() const { return Skin(bones, weights, rest, {}); }
};

}  // namespace vfit
