// What holds a garment, on skin that stretches.
#include "cloth/garment/held_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace vfit {
namespace {

constexpr uint32_t kRows = 10, kColumns = 10;

/// Squares of 2 cm, row by row along x.
struct Sheet {
    std::vector<Vec3> rest;
    std::vector<uint32_t> indices, all;

    Sheet() {
        for (uint32_t row = 0; row < kRows; ++row)
            for (uint32_t column = 0; column < kColumns; ++column)
                rest.push_back(0.02f * Vec3(float(column), float(row), 0.0f));
        for (uint32_t row = 0; row + 1 < kRows; ++row)
            for (uint32_t column = 0; column + 1 < kColumns; ++column) {
                const uint32_t v = row * kColumns + column, up = v + kColumns;
                for (const uint32_t corner : {v, v + 1, up, up, v + 1, up + 1}) indices.push_back(corner);
            }
        all.resize(rest.size());
        std::iota(all.begin(), all.end(), 0u);
    }
    std::vector<Vec3> stretched(float by) const {
        std::vector<Vec3> out = rest;
        for (Vec3& p : out) p.x *= by;
        return out;
    }
    float longest(const std::vector<Vec3>& places) const {
        float out = 0.0f;
        for (size_t i = 0; i < indices.size(); ++i) {
            const uint32_t a = indices[i], b = indices[i % 3 == 2 ? i - 2 : i + 1];
            out = std::max(out, glm::distance(places[a], places[b]) / glm::distance(rest[a], rest[b]));
        }
        return out;
    }
};

Vec3 centre_of(const std::vector<Vec3>& places) {
    return std::accumulate(places.begin(), places.end(), Vec3(0.0f)) / float(places.size());
}

TEST(HeldShape, StretchesLessThanTheSkinAndStaysWhereItIs) {
    const Sheet sheet;
    const HeldShape shape(sheet.all, sheet.indices, sheet.rest);
    std::vector<Vec3> places = sheet.stretched(1.6f);
    const Vec3 centre = centre_of(places);
    ASSERT_GT(sheet.longest(places), 1.55f);
    shape.keep_lengths(places);
    EXPECT_LT(sheet.longest(places), 1.4f);
    EXPECT_LT(glm::distance(centre_of(places), centre), 1e-4f);
}

TEST(HeldShape, StaysToTheBitWhereTheSkinStretchesLittleOrGetsShorter) {
    const Sheet sheet;
    const HeldShape shape(sheet.all, sheet.indices, sheet.rest);
    for (const float by : {0.5f, 1.0f, 1.05f}) {
        std::vector<Vec3> places = sheet.stretched(by);
        shape.keep_lengths(places);
        EXPECT_EQ(places, sheet.stretched(by)) << by;
    }
}

TEST(HeldShape, MovesNothingButWhatHolds) {
    constexpr uint32_t kHeld = 8 * kColumns;
    const Sheet sheet;
    const HeldShape shape(std::span(sheet.all).first(kHeld), sheet.indices, sheet.rest);
    const std::vector<Vec3> before = sheet.stretched(1.6f);
    std::vector<Vec3> places = before;
    shape.keep_lengths(places);
    EXPECT_NE(places[0], before[0]);
    EXPECT_TRUE(std::equal(before.begin() + kHeld, before.end(), places.begin() + kHeld));
}

TEST(HeldShape, LeavesABandWhereTheSkinCarriesIt) {
    const Sheet sheet;
    const HeldShape shape(std::span(sheet.all).first(2 * kColumns), sheet.indices, sheet.rest);
    std::vector<Vec3> places = sheet.stretched(1.6f);
    shape.keep_lengths(places);
    EXPECT_EQ(places, sheet.stretched(1.6f));
}

}  // namespace
}  // namespace vfit
