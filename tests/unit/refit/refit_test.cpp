// Garments put on a character for good: the default man, larger than life, plays the character.
#include "refit/refit.h"

#include <gtest/gtest.h>

#include <numeric>

#include "avatar/character_body.h"
#include "core/error.h"
#include "core/files.h"

namespace vfit {
namespace {

constexpr float kLarger = 1.3f;

const std::shared_ptr<const BodyModel>& body_model() {
    static const std::shared_ptr<const BodyModel> model = BodyModel::load(VFIT_DATA_DIR "/body.bin");
    return model;
}

const FabricLibrary& fabrics() {
    static const FabricLibrary library = FabricLibrary::parse(read_file(VFIT_DATA_DIR "/fabrics.json"));
    return library;
}

std::vector<Garment> garments(std::initializer_list<const char*> names) {
    std::vector<Garment> out;
    for (const char* name : names)
        out.push_back(parse_garment(
            read_file(std::string(VFIT_DATA_DIR "/garments/") + name + ".json", 1u << 24), fabrics()));
    return out;
}

Character large_man() {
    Character man;
    man.source = body_source(body_model(), 0, VFIT_SEX_MALE, {}, Vec2(1.0f));
    for (Vec3& p : man.source.rest.positions) p *= kLarger;
    for (AvatarBone& bone : man.source.bones) bone.rest_head *= kLarger, bone.rest_tail *= kLarger;
    man.source.is_body = false;
    CharacterPart all;
    all.mesh = "body", all.material = "skin";
    all.index_count = uint32_t(man.source.rest.indices.size());
    man.parts = {all};
    return man;
}

Refitted on_him(std::initializer_list<const char*> names, const RefitRequest& request = {}) {
    const auto alone = Jobs::own(0);
    const std::vector<Garment> worn = garments(names);
    return refit(large_man(), worn, body_model(), fabrics(), request, *alone);
}

TEST(Refit, AShirtLiesOnTheCharacterAndHidesWhatIsBelow) {
    const Character man = large_man();
    const Refitted out = on_him({"shirt_men"});
    ASSERT_EQ(out.garments.size(), 1u);
    const RefittedGarment& shirt = out.garments[0];
    EXPECT_EQ(shirt.skin_crossings, 0u);
    EXPECT_EQ(shirt.self_crossings, 0u);
    EXPECT_EQ(shirt.positions.size(), size_t(garments({"shirt_men"})[0].drawn_count()));
    Vec3 low(1e9f), high(-1e9f);
    for (size_t v = 0; v < shirt.positions.size(); ++v) {
        low = glm::min(low, shirt.positions[v]), high = glm::max(high, shirt.positions[v]);
        EXPECT_NEAR(std::accumulate(shirt.weights[v].begin(), shirt.weights[v].end(), 0.0f), 1.0f, 1e-4f);
        for (size_t k = 4; k < size_t(kSkinBones); ++k) EXPECT_EQ(shirt.weights[v][k], 0.0f);
        EXPECT_NEAR(glm::length(shirt.normals[v]), 1.0f, 1e-3f);
    }
    // In the size of the character, and on its trunk and arms.
    EXPECT_GT(low.y, 0.7f * kLarger);
    EXPECT_GT(high.y, 1.35f * kLarger);
    EXPECT_GT(high.x - low.x, 0.8f * kLarger);

    // The elbows are hidden, hands and head are not.
    const std::vector<BodyPart>& parts = man.source.topology->parts;
    size_t hidden = 0, elbows = 0, hidden_elbows = 0, bare = 0, hidden_bare = 0;
    const Vec3 elbow = [&] {
        for (const AvatarBone& bone : man.source.bones)
            if (bone.bone == VFIT_BONE_LEFT_LOWER_ARM) return bone.rest_head;
        return Vec3(0.0f);
    }();
    for (size_t t = 0; t < out.hidden.size(); ++t) {
        const uint32_t v = man.source.rest.indices[3 * t];
        hidden += out.hidden[t];
        if (glm::distance(man.source.rest.positions[v], elbow) < 0.08f)
            ++elbows, hidden_elbows += out.hidden[t];
        if (parts[v] == BodyPart::kHead || parts[v] == BodyPart::kLeftHand)
            ++bare, hidden_bare += out.hidden[t];
    }
    EXPECT_GT(hidden, out.hidden.size() / 10);
    EXPECT_GT(hidden_elbows, elbows * 95 / 100);
    EXPECT_LT(hidden_bare, bare / 20);
}

TEST(Refit, TrousersBelowAShirt) {
    const Refitted both = on_him({"pants_men", "shirt_men"});
    ASSERT_EQ(both.garments.size(), 2u);
    for (const RefittedGarment& garment : both.garments) EXPECT_EQ(garment.skin_crossings, 0u);
    const Refitted shirt = on_him({"shirt_men"});
    EXPECT_GT(std::accumulate(both.hidden.begin(), both.hidden.end(), 0),
              std::accumulate(shirt.hidden.begin(), shirt.hidden.end(), 0));
}

TEST(Refit, WhatCannotBeTakenOffIsNamed) {
    Character man = large_man();
    // The left half of the file is another material.
    CharacterPart rest = man.parts[0];
    const uint32_t half = rest.index_count / 6 * 3;
    man.parts[0].index_count = rest.first_index = half, rest.index_count -= half, rest.material = "cloak";
    man.parts.push_back(rest);
    const auto alone = Jobs::own(0);
    const std::vector<Garment> vest = garments({"vest"});
    const auto expect_refused = [&](const char* name, const char* words) {
        RefitRequest request;
        request.taken_off = {name};
        try {
            refit(man, vest, body_model(), fabrics(), request, *alone);
            FAIL() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), VFIT_ERROR_ARGUMENT);
            EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
        }
    };
    expect_refused("cape", "\"body\" (cloak)");
    expect_refused("body", "nothing of the character is left");
}

}  // namespace
}  // namespace vfit
