// Which limbs a garment goes around, as the benches count it.
#include "bench/limb_cover.h"

#include <gtest/gtest.h>

#include "client/assets.h"

namespace vfit::tools {
namespace {

std::vector<LimbCover> cover_by(const char* name) {
    const Context context = open_context();
    vfit_avatar_desc body = vfit_avatar_desc_init();
    body.sex = VFIT_SEX_MALE;
    Avatar avatar;
    check(vfit_avatar_create_from_shape(context.get(), &body, nullptr, 0, 0, avatar.out()));
    stand(avatar.get(), 0.1f);
    const Garment garment = open_garment(context.get(), name);
    Cloth cloth;
    check(vfit_cloth_create(avatar.get(), garment.get(), nullptr, cloth.out()));
    return cover_of_limbs(avatar.get(), mesh_of(cloth.get()));
}

TEST(LimbCover, AShirtGoesAroundArmsAndTrousersAroundLegs) {
    const std::vector<LimbCover> shirt = cover_by("shirt_men"), trousers = cover_by("pants_men");
    ASSERT_EQ(shirt.size(), limb_places().size());
    ASSERT_EQ(trousers.size(), limb_places().size());
    // The plane through a limb may leave the trunk's cloth at a hem: an open line counts as part of a turn.
    constexpr float kOpen = 0.15f;
    for (size_t i = 0; i < limb_places().size(); ++i) {
        const bool of_arm = limb_places()[i].from <= VFIT_JOINT_RIGHT_ELBOW;
        EXPECT_NEAR(shirt[i].turns, of_arm ? 1.0f : 0.0f, kOpen) << i;
        EXPECT_NEAR(trousers[i].turns, of_arm ? 0.0f : 1.0f, kOpen) << i;
        EXPECT_EQ(shirt[i].stays, of_arm) << i;
        EXPECT_EQ(trousers[i].stays, !of_arm) << i;
    }
}

TEST(LimbCover, ASkirtIsToStayAroundLegsAndACoatThatIsOpenInFrontAroundArms) {
    const std::vector<LimbCover> coat = cover_by("duster"), skirt = cover_by("sundress");
    for (size_t i = 0; i < limb_places().size(); ++i) {
        const bool of_arm = limb_places()[i].from <= VFIT_JOINT_RIGHT_ELBOW;
        EXPECT_EQ(coat[i].stays, of_arm) << i;
        if (limb_places()[i].from == VFIT_JOINT_LEFT_HIP || limb_places()[i].from == VFIT_JOINT_RIGHT_HIP)
            EXPECT_TRUE(skirt[i].stays) << i;
    }
}

TEST(LimbCover, WhatIsToStayAroundALimbMayBeOffIt) {
    EXPECT_TRUE(is_off_limb({1.0f, true}, {0.2f, false}));
    EXPECT_TRUE(is_off_limb({1.1f, true}, {0.2f, false})) << "with part of another line";
    EXPECT_FALSE(is_off_limb({1.0f, true}, {0.9f, false})) << "its hem is there";
    EXPECT_FALSE(is_off_limb({0.99f, false}, {0.2f, false})) << "a front that opened";
}

}  // namespace
}  // namespace vfit::tools
