// Holt filter against numbers worked out by hand from its definition.
#include "motion/holt_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace vfit {
namespace {

Vec3 along_x(float x) { return {x, 0, 0}; }

TEST(HoltFilter, GivesTheNumbersOfItsDefinitionAt30Hz) {
    const float readings[] = {0.0f, 0.02f, 0.06f, 0.20f, 0.19f, 0.20f};
    const float outputs[] = {0.0f, 0.0125f, 0.045625f, 0.16f, 0.2125390625f, 0.2361819458f};
    HoltFilter filter;
    for (int i = 0; i < 6; ++i)
        EXPECT_NEAR(filter.update({}, along_x(readings[i]), false, 1.0f).x, outputs[i], 1e-6f)
            << "reading " << i;
    EXPECT_NEAR(filter.trend().x, 0.0426915283f, 1e-6f);
}

TEST(HoltFilter, DoublesBothRadiiForAnInferredJoint) {
    // Jitter radius 0.1: 0.06 lies 0.05 from the level, so half of it counts; deviation radius 0.08.
    HoltFilter filter;
    filter.update({}, along_x(0.0f), true, 1.0f);
    filter.update({}, along_x(0.02f), true, 1.0f);
    EXPECT_NEAR(filter.update({}, along_x(0.06f), true, 1.0f).x, 0.0300f, 1e-6f);
    HoltFilter jump;
    jump.update({}, along_x(0.0f), true, 1.0f);
    jump.update({}, along_x(0.0f), true, 1.0f);
    // Level 0.5, trend 0.25, forecast 0.625: held to 0.08 from the reading.
    EXPECT_NEAR(jump.update({}, along_x(1.0f), true, 1.0f).x, 0.92f, 1e-6f);
}

TEST(HoltFilter, KeepsAConstantConstantAtAnyRate) {
    for (float frames : {0.1f, 0.25f, 1.0f, 2.0f}) {
        HoltFilter filter;
        for (int i = 0; i < 50; ++i) {
            const Vec3 out = filter.update({}, {0.3f, 1.2f, -2.0f}, false, frames);
            EXPECT_LT(glm::length(out - Vec3(0.3f, 1.2f, -2.0f)), 1e-6f);
        }
    }
}

TEST(HoltFilter, FollowsARampWithTheSameTrendAtAnyRate) {
    const float per_frame = 0.01f;  // 0.3 m/s
    for (float frames : {0.25f, 0.5f, 1.0f, 2.0f}) {
        HoltFilter filter;
        Vec3 out(0.0f);
        float x = 0;
        for (int i = 0; i < 400; ++i, x = per_frame * frames * static_cast<float>(i))
            out = filter.update({}, along_x(x), false, frames);
        EXPECT_NEAR(filter.trend().x, per_frame, 2e-4f) << frames;
        EXPECT_NEAR(out.x, per_frame * frames * 399.0f, 0.015f) << frames;
    }
}

TEST(HoltFilter, HalvesJitterAtLeast) {
    std::mt19937 engine(1);
    std::normal_distribution<float> noise(0.0f, 0.01f);
    HoltFilter filter;
    double in = 0, out = 0;
    for (int i = 0; i < 2000; ++i) {
        const float reading = noise(engine);
        const float x = filter.update({}, along_x(reading), false, 1.0f).x;
        in += reading * reading;
        out += x * x;
    }
    EXPECT_LT(std::sqrt(out), 0.5 * std::sqrt(in));
}

}  // namespace
}  // namespace vfit
