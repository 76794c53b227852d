// Which ways a person has faced in a turn.
#include "scan/turn_ring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>

namespace vfit {
namespace {

TEST(TurnRing, CountsWaysToThePersonsLeft) {
    EXPECT_EQ(TurnRing::way_of(0.1f), 0);
    EXPECT_EQ(TurnRing::way_of(-0.1f), 0);
    EXPECT_EQ(TurnRing::way_of(0.5f * kPi), 6);
    EXPECT_EQ(TurnRing::way_of(-0.5f * kPi), 18);
    EXPECT_EQ(TurnRing::way_of(kPi), 12);
    EXPECT_EQ(TurnRing::way_of(-kPi), 12);
    TurnRing ring;
    for (int way = 0; way < TurnRing::kWays; ++way) {
        EXPECT_NE(ring.seen(), TurnRing::kAll);
        ring.add(way);
    }
    EXPECT_EQ(ring.seen(), TurnRing::kAll);
    EXPECT_TRUE(ring.complete());
    ring.reset();
    EXPECT_EQ(ring.seen(), 0u);
    EXPECT_FALSE(ring.complete());
}

TEST(TurnRing, IsCompleteWhereTheOppositeOfWhatIsMissingWasSeen) {
    const auto without = [](std::initializer_list<int> missing) {
        TurnRing ring;
        for (int way = 0; way < TurnRing::kWays; ++way)
            if (std::find(missing.begin(), missing.end(), way) == missing.end()) ring.add(way);
        return ring.complete();
    };
    EXPECT_TRUE(without({3, 4}));
    EXPECT_TRUE(without({0, 1, 2, 3}));
    EXPECT_FALSE(without({0, 1, 2, 3, 4})) << "too many";
    EXPECT_FALSE(without({5, 17})) << "opposite each other";
}

TEST(TurnRing, ClosesAfterHalfATurn) {
    const auto from_to = [](int first, int last, int step = 1) {
        TurnRing ring;
        for (int way = first; way <= last; way += step) ring.add(way % TurnRing::kWays);
        return ring;
    };
    EXPECT_FALSE(TurnRing().closed());
    EXPECT_FALSE(from_to(0, 11).closed());
    EXPECT_TRUE(from_to(0, 12).closed());
    EXPECT_TRUE(from_to(18, 30).closed());
    EXPECT_FALSE(from_to(0, 18, 6).closed()) << "few views are often of the wrong way";
    EXPECT_TRUE(from_to(0, 22, 2).closed());
    EXPECT_GT(from_to(0, 12).doubt(), 1.0f) << "one side is not seen";
    EXPECT_EQ(from_to(0, 18).doubt(), 1.0f) << "the quarter that is left is seen from both sides";
    EXPECT_EQ(from_to(0, 23).doubt(), 1.0f);
}

TEST(TurnRing, CamerasThatStandAroundSurroundAPerson) {
    const auto ways = [](std::initializer_list<int> seen) {
        TurnRing ring;
        for (const int way : seen) ring.add(way);
        return ring;
    };
    EXPECT_TRUE(ways({0, 6, 12, 18}).surrounded());
    EXPECT_TRUE(ways({1, 9, 17}).surrounded());
    EXPECT_TRUE(ways({0, 6, 12}).surrounded()) << "both sides are seen from before and behind";
    EXPECT_FALSE(ways({0, 12}).surrounded()) << "outlines alone";
    EXPECT_FALSE(ways({0, 1, 12}).surrounded()) << "the person sways";
    EXPECT_FALSE(ways({0, 6}).surrounded());
    EXPECT_FALSE(ways({0, 6, 18}).surrounded()) << "no back";
    EXPECT_FALSE(ways({}).surrounded());
    EXPECT_GT(ways({0, 6, 12}).doubt_between_cameras(), ways({0, 8, 16}).doubt_between_cameras());
    EXPECT_GT(ways({0, 8, 16}).doubt_between_cameras(), ways({0, 6, 12, 18}).doubt_between_cameras());
}

}  // namespace
}  // namespace vfit
