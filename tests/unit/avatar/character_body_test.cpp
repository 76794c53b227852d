// The body model inside a character: another body, of another size and sex, plays the character.
#include "avatar/character_body.h"

#include <gtest/gtest.h>

#include <numeric>

#include "body_fixture.h"
#include "geometry/mesh_query.h"

namespace vfit {
namespace {

constexpr float kLarger = 1.3f;

/// The default man, larger than life.
AvatarSource large_man() {
    AvatarSource man = body_source(body_model(), 0, VFIT_SEX_MALE, {}, Vec2(1.0f));
    for (Vec3& p : man.rest.positions) p *= kLarger;
    for (AvatarBone& bone : man.bones) bone.rest_head *= kLarger, bone.rest_tail *= kLarger;
    man.is_body = false;
    return man;
}

const CharacterBody& woman_in_him() {
    static const CharacterBody body = body_in(large_man(), body_model(), VFIT_SEX_FEMALE);
    return body;
}

TEST(CharacterBody, LiesOnTheSkinOfTheCharacter) {
    const CharacterBody& body = woman_in_him();
    const AvatarSource man = large_man();
    const size_t count = man.topology->vertex_count;
    const MeshQuery skin(std::span(body.skin).first(count), man.topology->indices);
    const std::vector<BodyPart>& parts = body.source.topology->parts;
    double sum = 0.0;
    size_t n = 0, off = 0;
    for (size_t v = 0; v < count; ++v) {
        if (parts[v] == BodyPart::kHead || parts[v] == BodyPart::kLeftHand ||
            parts[v] == BodyPart::kRightHand || parts[v] == BodyPart::kLeftFoot ||
            parts[v] == BodyPart::kRightFoot)
            continue;
        const float distance = skin.closest(body.source.rest.positions[v]).distance;
        sum += double(distance), ++n, off += distance > 0.015f;
    }
    EXPECT_LT(sum / double(n), 0.004);
    EXPECT_LT(off, n / 50);
    const float outside = *std::max_element(body.outside_m.begin(), body.outside_m.end());
    EXPECT_LT(outside, 0.015f);
}

TEST(CharacterBody, IsAsLargeAsAPerson) {
    const CharacterBody& body = woman_in_him();
    EXPECT_GT(body.scale, 0.8f / kLarger);
    EXPECT_LT(body.scale, 1.1f / kLarger);
    float low = 1e9f, high = -1e9f;
    for (const Vec3& p : body.source.rest.positions) low = std::min(low, p.y), high = std::max(high, p.y);
    EXPECT_NEAR(low, 0.0f, 1e-4f);
    EXPECT_GT(high, 1.4f);
    EXPECT_LT(high, 1.8f);
}

TEST(CharacterBody, ItsSkinGoesWithTheCharactersBones) {
    const CharacterBody& body = woman_in_him();
    const AvatarSource man = large_man();
    const std::vector<BodyPart>& parts = body.source.topology->parts;
    size_t wrong = 0, limbs = 0;
    for (size_t v = 0; v < body.skin_bones.size(); ++v) {
        EXPECT_NEAR(std::accumulate(body.skin_weights[v].begin(), body.skin_weights[v].end(), 0.0f), 1.0f,
                    1e-4f);
        if (parts[v] != BodyPart::kLeftForearm && parts[v] != BodyPart::kRightShank) continue;
        const std::string& name = man.bones[body.skin_bones[v][0]].name;
        const bool is_left = parts[v] == BodyPart::kLeftForearm;
        ++limbs;
        wrong += name.find(is_left ? ".L" : ".R") == std::string::npos;
    }
    EXPECT_GT(limbs, 400u);
    EXPECT_LT(wrong, limbs / 100);
}

TEST(CharacterBody, WhatIsLeftOutIsNotWornOver) {
    // A board before the chest, on the bones of the skin behind it.
    AvatarSource man = large_man();
    size_t chest = 0;
    for (size_t v = 0; v < man.topology->vertex_count; ++v)
        if (man.topology->parts[v] == BodyPart::kTorso &&
            (man.topology->parts[chest] != BodyPart::kTorso ||
             man.rest.positions[v].z > man.rest.positions[chest].z))
            chest = v;
    const Vec3 at = man.rest.positions[chest] + Vec3(0, 0, 0.04f);
    const auto first = uint32_t(man.rest.positions.size());
    auto topology = std::make_shared<BodyTopology>(*man.topology);
    for (const Vec3& corner : {Vec3(-0.1f, -0.1f, 0), Vec3(0.1f, -0.1f, 0), Vec3(0, 0.1f, 0)}) {
        man.rest.positions.push_back(at + corner), man.rest.normals.push_back(Vec3(0, 0, 1));
        man.skin_bones.push_back(SkinBones(man.skin_bones[chest]));
        man.skin_weights.push_back(SkinWeights(man.skin_weights[chest]));
        topology->parts.push_back(BodyPart::kTorso);
    }
    man.rest.indices.insert(man.rest.indices.end(), {first, first + 1, first + 2});
    man.topology = topology;
    std::vector<uint8_t> left_out(man.rest.indices.size() / 3, 0);
    const CharacterBody over = body_in(man, body_model(), VFIT_SEX_MALE, left_out);
    left_out.back() = 1;
    const CharacterBody below = body_in(man, body_model(), VFIT_SEX_MALE, left_out);
    const auto furthest = [](const CharacterBody& body) {
        float z = -1e9f;
        for (size_t v = 0; v < body.source.rest.positions.size(); ++v)
            if (body.source.topology->parts[v] == BodyPart::kTorso)
                z = std::max(z, body.source.rest.positions[v].z);
        return z;
    };
    EXPECT_GT(furthest(over), furthest(below) + 0.02f);
}

}  // namespace
}  // namespace vfit
