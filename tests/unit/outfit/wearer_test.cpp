// The body that wears a garment: its girths, the meaning of size labels, and the obstacles that it is.
#include "outfit/wearer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "outfit/body_obstacles.h"
#include "outfit/size_choice.h"
#include "people.h"
#include "unit/cloth/cloth_support.h"

namespace vfit {
namespace {

using namespace test;

TEST(Wearer, ItsGirthLevelsAreThoseOfItsMeasures) {
    const Person she(VFIT_SEX_FEMALE);
    const auto& levels = she.wearer.girth_levels();
    ASSERT_EQ(levels.size(), 3u);
    for (const GirthLevel& level : levels) {
        const Measurement* measure = find(she.wearer.measures(), level.key);
        ASSERT_NE(measure, nullptr) << level.key;
        EXPECT_EQ(level.body_m, measure->value);
        EXPECT_GT(level.height_m, 0.7f);
    }
    EXPECT_EQ(&she.wearer.girth_levels(), &levels) << "found once";
}

TEST(Wearer, ItsBodyIsTheClosedSurfaceOfTheRestMesh) {
    const Person she(VFIT_SEX_FEMALE);
    const DressBody body = she.wearer.body();
    EXPECT_EQ(body.positions.size(), she.avatar.topology().vertex_count);
    EXPECT_LT(body.positions.size(), she.avatar.rest().positions.size()) << "without the copies at seams";
    EXPECT_GT(she.wearer.contact_skin().places.size(), 0u);
    EXPECT_NEAR(she.wearer.skin().closest(body.positions[0]).distance, 0.0f, 1e-5f);
}

TEST(SizeChoice, ALabelIsLengthsOfItsOwnOrARatioToTheBody) {
    const Person she(VFIT_SEX_FEMALE);
    const WearableGarment scaled = wearable("sundress"), cut = wearable("sundress_pattern");
    const SizeChoice to_measure = choose_size(cut.garment(), {}, she.wearer);
    EXPECT_EQ(to_measure.ratio, 1.0f);
    EXPECT_EQ(to_measure.own, nullptr);
    const SizeChoice own = choose_size(cut.garment(), "L", she.wearer);
    EXPECT_EQ(own.ratio, 1.0f);
    ASSERT_NE(own.own, nullptr);
    EXPECT_EQ(own.own->label, "L");
    const SizeChoice small = choose_size(scaled.garment(), "XS", she.wearer),
                     large = choose_size(scaled.garment(), "XL", she.wearer);
    EXPECT_EQ(large.own, nullptr);
    EXPECT_LT(small.ratio, 1.0f);
    EXPECT_GT(large.ratio, small.ratio + 0.2f);
    EXPECT_NE(error_of([&] { choose_size(cut.garment(), "huge", she.wearer); }).find("no size \"huge\""),
              std::string::npos);
}

TEST(WearOptions, FrictionIsTheFabricsUnlessItIsGiven) {
    FabricMaterial material = cotton();
    material.friction = 0.7f;
    WearOptions options;
    EXPECT_EQ(options.settings_of(material).friction, 0.7f);
    options.friction = 0.0f;
    EXPECT_EQ(options.settings_of(material).friction, 0.0f);
    EXPECT_FALSE(options.settings_of(material).follows_fixed);
}

class BodyObstaclesTest : public testing::Test {
protected:
    std::unique_ptr<Jobs> jobs = Jobs::own(0);
    const Person she{VFIT_SEX_FEMALE};

    /// Those of the avatar's colliders that the garment meets, and the ones beside them.
    size_t colliders(const char* name, const WearOptions& options) {
        const WearableGarment garment = wearable(name);
        const Dress dress(garment.garment(), garment.bound(0, *jobs), garment.material(), she.wearer.body());
        BodyObstacles obstacles(she.wearer, garment.garment(), dress, options);
        std::vector<Collider> found;
        she.avatar.colliders(found);
        obstacles.select(she.avatar.skinning_matrices(), found, *jobs);
        return found.size();
    }
};

TEST_F(BodyObstaclesTest, HandsPassThroughWithTheirForearmsExceptWithSleeves) {
    WearOptions options;
    EXPECT_EQ(colliders("sundress", options), size_t(kColliderCount));
    options.hands = false;
    EXPECT_EQ(colliders("sundress", options), size_t(kColliderCount) - 4) << "two spheres, two capsules";
    EXPECT_EQ(colliders("duster", options), size_t(kColliderCount));
}

TEST(ArmFilter, ASleeveMeetsTheArmInItAndOtherClothBothOrNone) {
    const std::vector<BodyPart> skin{BodyPart::kTorso, BodyPart::kLeftForearm, BodyPart::kLeftHand,
                                     BodyPart::kRightForearm, BodyPart::kRightHand};
    Garment garment;
    garment.on_arm = {0, 1, 1};
    const std::vector<Vec3> rest{{0.1f, 1, 0}, {0.4f, 1, 0}, {-0.4f, 1, 0}};  // trunk, left and right sleeve
    for (const bool hands : {false, true}) {
        const ArmFilter filter = arm_filter(skin, garment, rest, hands);
        const std::vector<std::vector<int>> expected{
            {1, hands, hands, hands, hands}, {1, 1, 1, 0, 0}, {1, 0, 0, 1, 1}};
        for (size_t v = 0; v < rest.size(); ++v)
            for (size_t s = 0; s < skin.size(); ++s)
                EXPECT_EQ((filter.mask[v] & filter.category[s]) != 0, expected[v][s] != 0) << v << " " << s;
    }
}

TEST_F(BodyObstaclesTest, TheSkinReplacesCollidersAndACoverAddsSome) {
    WearOptions options;
    options.cover_m = 0.01f;
    EXPECT_GT(colliders("sundress", options), size_t(kColliderCount));
    options.cover_m = 0.0f;
    options.on_skin = true;
    EXPECT_EQ(colliders("sundress", options), 0u);
}

}  // namespace
}  // namespace vfit
