// What a foot says about the root's height changes without a jump when it touches down and while it is free.
#include "motion/height_vote.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vfit {
namespace {

constexpr float kStepTime = 1.0f / 30.0f;

TEST(HeightVote, AsksForTheHeightAtWhichTheLegIsAsLongAsItWasTracked) {
    HeightVote vote;
    vote.stand({0, 0.9f, 0}, {0.3f, 0.1f, 0}, 0.5f,
               kStepTime);  // level distance 0.3, so the hip belongs at 0.1 + 0.4
    EXPECT_NEAR(vote.rise_m(), -0.4f, 1e-6f);
    EXPECT_EQ(vote.weight(), 1.0f) << "the first frame is not eased into";
}

TEST(HeightVote, OfATouchdownGrowsFromWhatWasSaidBefore) {
    HeightVote vote;
    for (int i = 0; i < 10; ++i) vote.stand({0, 0.90f, 0}, {0, 0.1f, 0}, 0.8f, kStepTime);
    for (int i = 0; i < 10; ++i) vote.swing(0.001f, kStepTime);
    EXPECT_NEAR(vote.rise_m(), 0.01f, 1e-5f) << "it goes along with the foot that stands";
    EXPECT_LT(vote.weight(), 0.5f);
    float before = vote.rise_m(), fastest = 0.0f;
    for (int i = 0; i < 30; ++i) {
        vote.stand({0, 0.86f, 0}, {0, 0.1f, 0}, 0.8f, kStepTime);
        fastest = std::max(fastest, std::abs(vote.rise_m() - before));
        EXPECT_NEAR(vote.change_m(), vote.rise_m() - before, 1e-6f);
        before = vote.rise_m();
    }
    EXPECT_NEAR(vote.rise_m(), 0.04f, 1e-5f);
    EXPECT_LT(fastest, 0.006f) << "of 3 cm";
}

}  // namespace
}  // namespace vfit
