// Outfits of the tools: what is worn by default, layers, and when a picture says that cloth has torn.
#include "client/outfit.h"

#include <gtest/gtest.h>

namespace vfit::tools {
namespace {

TEST(Outfit, IsCalledTornBeyondTwiceTheRestLengthOnly) {
    EXPECT_EQ(WornOutfit::warning_of({0.0f, 0.0f, ""}), "");
    EXPECT_EQ(WornOutfit::warning_of({1.0f, 2.0f, "coat"}), "");
    const std::string warning = WornOutfit::warning_of({2.5f, 1.25f, "coat"});
    for (const char* part : {"TORN", "coat", "3.5 times as long as cut", "1.2 s", "not a valid fit"})
        EXPECT_NE(warning.find(part), std::string::npos) << part << " in " << warning;
    EXPECT_EQ(warned("172 cm", ""), "172 cm");
    EXPECT_EQ(warned("172 cm", warning).find(warning), 0u);
}

TEST(Outfit, SplitsNames) {
    EXPECT_EQ(split("a+b", '+'), (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(split("", '+'), (std::vector<std::string>{""}));
}

class OutfitOnABody : public testing::Test {
protected:
    void SetUp() override {
        context = open_context();
        vfit_avatar_desc desc = vfit_avatar_desc_init();
        desc.sex = VFIT_SEX_MALE;
        check(vfit_avatar_create_from_shape(context.get(), &desc, nullptr, sizeof(vfit_shape_value), 0,
                                            avatar.out()));
        stand(avatar.get(), 0.08f);
    }
    Context context;
    Avatar avatar;
    vfit_cloth_desc cloth = vfit_cloth_desc_init();
};

TEST_F(OutfitOnABody, IsWornInLayersAndStaysWhole) {
    cloth.flags = VFIT_CLOTH_SKIN;
    WornOutfit outfit(context.get(), avatar.get(), default_outfit(VFIT_SEX_MALE), cloth);
    ASSERT_EQ(outfit.layers().size(), 2u);
    EXPECT_STREQ(outfit.layers()[0].info.name, "pants_men");
    for (int i = 0; i < 30; ++i) outfit.step(1.0f / 60.0f);
    EXPECT_GT(outfit.worst().strain, 0.0f);
    EXPECT_LT(outfit.worst().strain, 0.5f);
    EXPECT_EQ(outfit.warning(), "");
    outfit.reset();
    EXPECT_EQ(outfit.worst().strain, 0.0f);
}

TEST_F(OutfitOnABody, IsRefusedWithTheGarmentsReason) {
    EXPECT_THROW(WornOutfit(context.get(), avatar.get(), "vest+no_such", cloth), Failure);
    EXPECT_THROW(WornOutfit(context.get(), avatar.get(), "", cloth), Failure);
    cloth.size_label = "XS";
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.sex = VFIT_SEX_FEMALE;
    vfit_shape_value heavy = vfit_shape_value_init();
    std::snprintf(heavy.key, sizeof heavy.key, "weight");
    heavy.value = 1.15f;
    check(vfit_avatar_create_from_shape(context.get(), &desc, &heavy, sizeof heavy, 1, avatar.out()));
    EXPECT_THROW(WornOutfit(context.get(), avatar.get(), "jeans_women", cloth), NotWearable);
}

}  // namespace
}  // namespace vfit::tools
