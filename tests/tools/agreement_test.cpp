// How two ways to measure agree, by figures worked out by hand.
#include "client/agreement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vfit::tools {
namespace {

/// Errors in millimetres, a person each, sigma 5 mm.
std::vector<Compared> people(const std::vector<double>& errors_mm) {
    std::vector<Compared> list;
    for (size_t i = 0; i < errors_mm.size(); ++i)
        list.push_back({"p" + std::to_string(i), 1.0 + 0.001 * errors_mm[i], 0.005, 1.0});
    return list;
}

TEST(Agreement, BiasScatterAndLimits) {
    const Agreement a = agreement(people({-2, 0, 2, 4, 6}));
    EXPECT_EQ(a.people, 5u);
    EXPECT_NEAR(a.bias, 0.002, 1e-9);
    EXPECT_NEAR(a.sd, std::sqrt(10.0) * 1e-3, 1e-9);
    EXPECT_NEAR(a.mean_absolute, 0.0028, 1e-9);
    EXPECT_NEAR(a.high - a.low, 2 * 1.96 * std::sqrt(10.0) * 1e-3, 1e-9);
    EXPECT_NEAR(a.confidence, 2.776 * std::sqrt(10.0 / 5.0) * 1e-3, 1e-5);
    EXPECT_NEAR(a.covered, 1.0, 1e-9);
    EXPECT_NEAR(agreement(people({-9, 0, 0, 9})).covered, 0.5, 1e-9);
}

TEST(Agreement, ScansWithoutASigmaAreNotCountedAsIntervals) {
    auto list = people({1, 2});
    list[0].sigma = 0.0;
    EXPECT_EQ(agreement(list).told, 1u);
    EXPECT_EQ(agreement(list).covered, 1.0);
}

TEST(Agreement, ManyScansOfOnePersonAreOnePerson) {
    auto list = people({0, 0, 12});
    for (int i = 0; i < 20; ++i) list.push_back(list[2]);
    const Agreement a = agreement(list);
    EXPECT_EQ(a.people, 3u);
    EXPECT_EQ(a.scans, 23u);
    EXPECT_NEAR(a.bias, 0.004, 1e-9) << "the mean over people, not over scans";
    EXPECT_TRUE(std::isinf(agreement(people({3})).confidence)) << "of one person nothing is known";
}

TEST(Agreement, StudentsTIsThatOfTheTables) {
    for (const auto& [degrees, t] : {std::pair(1u, 12.706),
                                     {2u, 4.303},
                                     {3u, 3.182},
                                     {4u, 2.776},
                                     {9u, 2.262},
                                     {29u, 2.045},
                                     {39u, 2.023},
                                     {1000u, 1.962}})
        EXPECT_NEAR(student_t_975(degrees), t, 0.004) << degrees;
}

TEST(Agreement, Iso20685AsksForFortyPeopleAndTheWholeInterval) {
    EXPECT_EQ(iso_20685_limit_m("stature_m"), 0.004);
    EXPECT_EQ(iso_20685_limit_m("waist_girth_m"), 0.009);
    EXPECT_EQ(iso_20685_limit_m("neck_girth_m"), 0.004);
    EXPECT_EQ(iso_20685_limit_m("hip_depth_m"), 0.005);
    EXPECT_EQ(iso_20685_limit_m("body_mass_kg"), 0.0);
    std::vector<double> errors;
    for (int i = 0; i < 40; ++i) errors.push_back(i % 2 ? 5.0 : 9.0);  // 7 +- 0.65
    const auto verdict = [&](double limit_m) {
        return iso_20685_verdict(agreement(people(errors)), limit_m);
    };
    EXPECT_EQ(verdict(0.009), Verdict::kPasses);
    EXPECT_EQ(verdict(0.005), Verdict::kFails);
    EXPECT_EQ(verdict(0.0072), Verdict::kOpen);
    errors.pop_back();
    EXPECT_EQ(verdict(0.009), Verdict::kOpen) << "of 39 people";
}

}  // namespace
}  // namespace vfit::tools
