// Which limbs a garment goes around, as the benches count it.
#include "bench/limb_cover.h"

#include <gtest/gtest.h>

#include "client/assets.h"

namespace vfit::tools {
namespace {

std::vector<float> turns_of(const char* name) {
    const Context context = open_context();
    vfit_avatar_desc body = vfit_avatar_desc_init();
    body.sex = VFIT_SEX_MALE;
    Avatar avatar;
    check(vfit_avatar_create_from_shape(context.get(), &body, nullptr, 0, 0, avatar.out()));
    stand(avatar.get(), 0.1f);
    const Garment garment = open_garment(context.get(), name);
    Cloth cloth;
    check(vfit_cloth_create(avatar.get(), garment.get(), nullptr, cloth.out()));
    return turns_around_limbs(avatar.get(), mesh_of(cloth.get()));
}

TEST(LimbCover, AShirtGoesAroundArmsAndTrousersAroundLegs) {
    const std::vector<float> shirt = turns_of("shirt_men"), trousers = turns_of("pants_men");
    ASSERT_EQ(shirt.size(), limb_places().size());
    ASSERT_EQ(trousers.size(), limb_places().size());
    // The plane through a limb may leave the trunk's cloth at a hem: an open line counts as part of a turn.
    constexpr float kOpen = 0.15f;
    for (size_t i = 0; i < limb_places().size(); ++i) {
        const bool of_arm = limb_places()[i].from <= VFIT_JOINT_RIGHT_ELBOW;
        EXPECT_NEAR(shirt[i], of_arm ? 1.0f : 0.0f, kOpen) << i;
        EXPECT_NEAR(trousers[i], of_arm ? 0.0f : 1.0f, kOpen) << i;
    }
}

}  // namespace
}  // namespace vfit::tools
