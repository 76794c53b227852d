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

TEST(TurnRing, ClosesByViewsHalfATurnApartAtMost) {
    const auto of = [](std::initializer_list<int> ways) {
        TurnRing ring;
        for (const int way : ways) ring.add(way);
        return ring;
    };
    EXPECT_FALSE(of({}).closed());
    EXPECT_FALSE(of({0}).closed());
    EXPECT_FALSE(of({0, 12}).closed()) << "both outlines are the same";
    EXPECT_TRUE(of({0, 6, 12}).closed());
    EXPECT_TRUE(of({18, 0, 12}).closed());
    EXPECT_FALSE(of({0, 5, 11}).closed());
    EXPECT_FALSE(of({2, 3, 4, 5}).closed());
    EXPECT_TRUE(of({4, 12, 20}).closed());
}

TEST(TurnRing, DoubtsFewViewsAndASideThatIsNotSeen) {
    const auto from_to = [](int first, int last, int step) {
        TurnRing ring;
        for (int way = first; way <= last; way += step) ring.add(way);
        return ring.doubt();
    };
    const float whole = from_to(0, 23, 1), half = from_to(0, 12, 1), quarters = from_to(0, 18, 6),
                back = from_to(0, 12, 6);
    EXPECT_EQ(whole, 1.0f);
    EXPECT_EQ(from_to(0, 18, 1), whole) << "the quarter that is left is seen from both sides";
    EXPECT_GT(half, whole);
    EXPECT_GT(quarters, whole);
    EXPECT_GT(back, quarters);
    EXPECT_GT(back, half);
}

}  // namespace
}  // namespace vfit
