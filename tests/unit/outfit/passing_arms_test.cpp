// An arm that pushes cloth further than it goes passes through it, and meets it again when it has come back.
#include "outfit/passing_arms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "unit/cloth/cloth_support.h"

namespace vfit {
namespace {

using namespace test;

/// A bar along X behind a sheet that is held at two opposite sides, which it is pushed through.
class PassingArmsTest : public testing::Test {
protected:
    static constexpr uint32_t kRound = 16, kRings = 21;

    explicit PassingArmsTest(uint8_t mask = kOther) : arms_(filter(mask), bar_indices()) {
        settings_.self_thickness_m = 0.004f;
        for (const uint32_t row : {0u, sheet_.rows - 1})
            for (uint32_t c = 0; c < sheet_.columns; ++c) sheet_.simulated[sheet_.at(row, c)] = 0;
        cloth_.emplace(fabric(sheet_.cook(cotton())), settings_, sheet_.positions);
        mesh_ = cloth_->add_mesh(kRound * kRings, bar_indices(), {}, MeshOf::solid, arms_.filter());
        move_to(kBehind_m);
    }

    static constexpr uint8_t kOther =
                                 1 | ArmFilter::category_of(Arm::left) | ArmFilter::category_of(Arm::right),
                             kSleeve = 1 | ArmFilter::category_of(Arm::left);
    static constexpr float kBehind_m = -0.05f, kTaut_m = 0.0f, kBeyond_m = 0.15f;

    ArmFilter filter(uint8_t mask) const {
        return {std::vector<uint8_t>(kRound * kRings, ArmFilter::category_of(Arm::left)),
                std::vector<uint8_t>(sheet_.positions.size(), mask)};
    }
    static std::vector<uint32_t> bar_indices() {
        std::vector<uint32_t> out;
        for (uint32_t ring = 0; ring + 1 < kRings; ++ring)
            for (uint32_t i = 0; i < kRound; ++i) {
                const uint32_t a = ring * kRound + i, b = ring * kRound + (i + 1) % kRound;
                out.insert(out.end(), {a, b, a + kRound, b, b + kRound, a + kRound});
            }
        return out;
    }
    std::vector<Vec3> bar(float z) const {
        std::vector<Vec3> out;
        for (uint32_t ring = 0; ring < kRings; ++ring)
            for (uint32_t i = 0; i < kRound; ++i) {
                const float angle = 2.0f * kPi * float(i) / float(kRound);
                out.emplace_back(-0.1f + 0.02f * float(ring), -0.1f + 0.03f * std::cos(angle),
                                 z + 0.03f * std::sin(angle));
            }
        return out;
    }
    void move_to(float z) {
        from_ = std::exchange(to_, bar(z));
        if (from_.empty()) from_ = to_;
        cloth_->move_mesh(mesh_, to_);
        cloth_->step(kFrame_s, sheet_.positions, {}, *jobs_, [this](float share, float dt) {
            if (arms_.look({*cloth_, 0}, {from_, to_, share}, dt, *jobs_))
                cloth_->set_mesh_mask(mesh_, arms_.mask());
        });
        most_ = std::max(most_, cloth_->stats().strain_max);
        z_ = z;
    }
    void go_to(float z, int frames) {
        const float begin = z_;
        for (int i = 1; i <= frames; ++i) move_to(glm::mix(begin, z, float(i) / float(frames)));
    }
    float middle_z() const { return cloth_->positions()[sheet_.at(sheet_.rows / 2, sheet_.columns / 2)].z; }

    Sheet sheet_{11, 11, 0.02f};
    ClothSettings settings_;
    std::unique_ptr<Jobs> jobs_ = Jobs::own(0);
    PassingArms arms_;
    std::optional<Cloth> cloth_;
    std::vector<Vec3> from_, to_;
    uint32_t mesh_ = 0;
    float most_ = 0.0f, z_ = 0.0f;
};

TEST_F(PassingArmsTest, ClothGivesWayAndDoesNotTear) {
    go_to(kTaut_m, 30);
    EXPECT_FALSE(arms_.passes(Arm::left)) << "it goes as far as the cloth does";
    EXPECT_GT(middle_z(), 0.02f);
    go_to(kBeyond_m, 10);
    EXPECT_TRUE(arms_.passes(Arm::left));
    EXPECT_FALSE(arms_.passes(Arm::right));
    go_to(kBeyond_m, 5);
    constexpr float kWay_m = (kBeyond_m - kTaut_m) / 10.0f, kEdge_m = 0.02f, kHeld = 0.6f;
    EXPECT_LT(most_, kHeld + kWay_m / kEdge_m) << "a step's way beyond what is seen as held";
    EXPECT_LT(cloth_->stats().strain_max, 0.2f) << "it has come back";
}

TEST_F(PassingArmsTest, SoDoesASlowArm) {
    go_to(kTaut_m, 30);
    float passes_m = kBeyond_m;
    for (int i = 0; i < 300; ++i) {
        move_to(z_ + (kBeyond_m - kTaut_m) / 300.0f);
        if (arms_.passes(Arm::left)) passes_m = std::min(passes_m, z_);
    }
    EXPECT_LT(passes_m, kTaut_m + 0.004f) << "as soon as it is held";
    EXPECT_LT(most_, 0.52f);
}

TEST_F(PassingArmsTest, MeetsItAgainOnceItIsFree) {
    go_to(kBeyond_m, 10);
    go_to(0.0f, 5);
    go_to(0.0f, 60);
    EXPECT_TRUE(arms_.passes(Arm::left)) << "the cloth goes through it";
    go_to(kBehind_m, 10);
    EXPECT_FALSE(arms_.passes(Arm::left));
    go_to(kTaut_m, 30);
    EXPECT_GT(middle_z(), 0.02f);
}

TEST_F(PassingArmsTest, MeetsClothThatIsPutOnAnew) {
    go_to(kBeyond_m, 10);
    ASSERT_TRUE(arms_.passes(Arm::left));
    ASSERT_NE(arms_.mask()[0], kOther);
    arms_.meet_again();
    EXPECT_FALSE(arms_.passes(Arm::left));
    for (const uint8_t mask : arms_.mask()) ASSERT_EQ(mask, kOther);
}

class ArmOfNoHandsTest : public PassingArmsTest {
protected:
    ArmOfNoHandsTest() : PassingArmsTest(1) {}
};

TEST_F(ArmOfNoHandsTest, ThatMeetsNothingHoldsNothing) {
    go_to(kBeyond_m, 10);
    EXPECT_FALSE(arms_.passes(Arm::left));
    EXPECT_LT(most_, 0.1f);
}

class ArmInSleeveTest : public PassingArmsTest {
protected:
    ArmInSleeveTest() : PassingArmsTest(kSleeve) {}
};

TEST_F(ArmInSleeveTest, ASleeveKeepsTheArmInIt) {
    go_to(kBeyond_m, 10);
    EXPECT_FALSE(arms_.passes(Arm::left));
    EXPECT_LT(most_, 0.6f) << "it gives way";
}

}  // namespace
}  // namespace vfit
