// The filters of one joint: what each promises on rest, motion, outliers and odd times.
#include "motion/position_filter.h"

#include <gtest/gtest.h>

#include <random>

#include "motion_support.h"

namespace vfit {
namespace {

constexpr float kFrame_s = 1.0f / 30.0f;

struct Sensor {
    std::mt19937 engine{5};
    std::normal_distribution<float> normal{0.0f, 1.0f};
    Vec3 noise(float sd) {
        const float x = normal(engine), y = normal(engine), z = normal(engine);
        return sd * Vec3(x, y, z);
    }
};

PositionFilterSettings of_kind(vfit_position_filter kind) {
    PositionFilterSettings s;
    s.kind = kind;
    return s;
}

/// RMS distance to `truth(t)` from the second second on.
template <typename Truth>
float rms(const PositionFilterSettings& settings, Truth&& truth, float sd, float dt_s = kFrame_s) {
    Sensor sensor;
    PositionFilter filter;
    float sum = 0;
    int count = 0;
    for (int i = 0; static_cast<float>(i) * dt_s < 20.0f; ++i) {
        const float t = static_cast<float>(i) * dt_s;
        const Vec3 shown = filter.update(settings, truth(t) + sensor.noise(sd), false, 1.0f, dt_s);
        if (t < 2.0f) continue;
        sum += glm::dot(shown - truth(t), shown - truth(t));
        ++count;
    }
    return std::sqrt(sum / static_cast<float>(count));
}

Vec3 rest(float) { return {0.2f, 1.1f, -2.4f}; }
Vec3 swing(float t) { return {0.15f * std::sin(kPi * t), 1.1f, -2.4f}; }

TEST(AdaptiveFilter, RestsAtATenthOfTheNoiseAndFollowsASwing) {
    const auto own = of_kind(VFIT_POSITION_ADAPTIVE);
    EXPECT_LT(rms(own, rest, 0.01f), 0.0022f);
    EXPECT_LT(rms(own, swing, 0.01f), 0.014f);
    EXPECT_LT(rms(own, swing, 0.0f), 0.007f);
}

TEST(AdaptiveFilter, IsBetterAtRestAndInMotionThanThoseBesideIt) {
    const auto own = of_kind(VFIT_POSITION_ADAPTIVE);
    for (const vfit_position_filter other : {VFIT_POSITION_HOLT, VFIT_POSITION_ONE_EURO}) {
        EXPECT_LT(2.5f * rms(own, rest, 0.01f), rms(of_kind(other), rest, 0.01f)) << other;
        EXPECT_LT(rms(own, swing, 0.01f), rms(of_kind(other), swing, 0.01f)) << other;
    }
}

TEST(AdaptiveFilter, WorksAtAnyFrameRate) {
    const auto own = of_kind(VFIT_POSITION_ADAPTIVE);
    for (const float rate : {15.0f, 60.0f, 120.0f}) {
        EXPECT_LT(rms(own, rest, 0.01f, 1.0f / rate), 0.0035f) << rate;
        EXPECT_LT(rms(own, swing, 0.005f, 1.0f / rate), 0.011f) << rate;
    }
}

TEST(AdaptiveFilter, HoldsOneReadingThatLeapsAndFollowsTwo) {
    const auto own = of_kind(VFIT_POSITION_ADAPTIVE);
    PositionFilter filter;
    Sensor sensor;
    Vec3 shown(0.0f);
    const auto read = [&](const Vec3& at) {
        return shown = filter.update(own, at + sensor.noise(0.002f), false, 1.0f, kFrame_s);
    };
    for (int i = 0; i < 60; ++i) read({0, 1, -2});
    read({0.3f, 1, -2});
    EXPECT_LT(glm::length(shown - Vec3(0, 1, -2)), 0.01f);
    read({0, 1, -2});
    EXPECT_LT(glm::length(shown - Vec3(0, 1, -2)), 0.01f);
    read({0.3f, 1, -2});
    read({0.32f, 1, -2});
    EXPECT_LT(glm::length(shown - Vec3(0.32f, 1, -2)), 0.02f);
}

TEST(AdaptiveFilter, LearnsHowNoisyEachAxisIs) {
    AdaptiveFilter filter;
    Sensor sensor;
    for (int i = 0; i < 300; ++i)
        filter.update(Vec3(1.0f) + sensor.noise(1.0f) * Vec3(0.008f, 0.008f, 0.03f), 1.0f, kFrame_s);
    EXPECT_NEAR(filter.noise_m().x, 0.008f, 0.003f);
    EXPECT_NEAR(filter.noise_m().z, 0.03f, 0.01f);
}

TEST(PositionFilter, AnUnsureReadingMovesLess) {
    const auto own = of_kind(VFIT_POSITION_ADAPTIVE);
    const auto moved = [&](bool inferred, float confidence) {
        PositionFilter filter;
        for (int i = 0; i < 30; ++i) filter.update(own, Vec3(0.0f), false, 1.0f, kFrame_s);
        Vec3 shown(0.0f);
        for (int i = 0; i < 2; ++i)
            shown = filter.update(own, Vec3(0.02f, 0, 0), inferred, confidence, kFrame_s);
        return shown.x;
    };
    EXPECT_LT(moved(true, 1.0f), 0.7f * moved(false, 1.0f));
    EXPECT_LT(moved(false, 0.4f), 0.7f * moved(false, 1.0f));
}

TEST(OneEuroFilter, IsALowPassAtItsLeastCutoffWhereBetaIsNone) {
    OneEuroSettings settings{1.0f, 0.0f, 1.0f};
    OneEuroFilter filter;
    filter.update(settings, Vec3(0.0f), kFrame_s);
    // Casiez 2012: alpha = 1 / (1 + tau / dt), tau = 1 / (2 pi fc).
    const float alpha = 1.0f / (1.0f + 30.0f / (2.0f * kPi));
    float expected = 0.0f;
    for (int i = 0; i < 5; ++i) {
        expected += alpha * (1.0f - expected);
        EXPECT_NEAR(filter.update(settings, Vec3(1.0f), kFrame_s).y, expected, 1e-5f);
    }
}

TEST(OneEuroFilter, OpensWithSpeed) {
    const auto lag = [](float beta) {
        OneEuroSettings settings{1.0f, beta, 1.0f};
        OneEuroFilter filter;
        float x = 0, shown = 0;
        for (int i = 0; i < 60; ++i) shown = filter.update(settings, Vec3(x += 0.03f, 0, 0), kFrame_s).x;
        return x - shown;
    };
    EXPECT_LT(lag(2.0f), 0.5f * lag(0.0f));
}

}  // namespace
}  // namespace vfit
