// Where one camera's world space lies in another's.
#include "frame/world_align.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/error.h"

namespace vfit {
namespace {

struct Walk {
    std::vector<Vec3> here, there;

    /// Of a person on a circle.
    Walk(const WorldPlace& place, int count, float noise_m, float radius_m = 0.5f) {
        std::mt19937 random(7);
        std::normal_distribution<float> noise(0.0f, noise_m > 0.0f ? noise_m : 1e-9f);
        for (int i = 0; i < count; ++i) {
            const float turn = 2.0f * kPi * float(i) / float(count);
            const Vec3 p(radius_m * std::sin(turn), 0.9f + 0.1f * float(i % 3),
                         -2.5f + radius_m * std::cos(turn));
            there.push_back(p + Vec3(noise(random), noise(random), noise(random)));
            here.push_back(place.point(p) + Vec3(noise(random), noise(random), noise(random)));
        }
    }
};

WorldPlace turned(float rad, const Vec3& position) { return {position, glm::angleAxis(rad, Vec3(0, 1, 0))}; }

float turn_between(const WorldPlace& a, const WorldPlace& b) {
    return glm::angle(glm::normalize(glm::inverse(a.rotation) * b.rotation));
}

TEST(WorldAlign, FindsTheOtherCamera) {
    for (const float rad : {0.0f, 0.5f, -1.57f, 3.1f}) {
        const WorldPlace truth = turned(rad, {2.0f, 0.03f, -1.5f});
        const Walk walk(truth, 40, 0.0f);
        float rms_m = 1.0f;
        const WorldPlace found = align_worlds(walk.here, walk.there, rms_m);
        EXPECT_LT(glm::distance(found.position, truth.position), 1e-4f) << rad;
        EXPECT_LT(std::abs(std::remainder(turn_between(found, truth), 2.0f * kPi)), 1e-3f) << rad;
        EXPECT_LT(rms_m, 1e-4f);
    }
}

TEST(WorldAlign, WrongPointsHardlyCount) {
    const WorldPlace truth = turned(1.2f, {1.0f, 0.0f, -3.0f});
    Walk walk(truth, 100, 0.02f);
    for (size_t i = 0; i < walk.here.size(); i += 6) walk.here[i] += Vec3(0.8f, 0.2f, -0.5f);
    float rms_m = 0.0f;
    const WorldPlace found = align_worlds(walk.here, walk.there, rms_m);
    EXPECT_LT(glm::distance(found.point({0, 1, -2.5f}), truth.point({0, 1, -2.5f})), 0.03f);
    EXPECT_LT(std::abs(std::remainder(turn_between(found, truth), 2.0f * kPi)), 0.03f);
    EXPECT_GT(rms_m, 0.02f);
    EXPECT_LT(rms_m, 0.1f);
}

TEST(WorldAlign, RefusesWhatDoesNotTellIt) {
    float rms_m = 0.0f;
    const auto fault = [&](const std::vector<Vec3>& here, const std::vector<Vec3>& there) -> std::string {
        try {
            align_worlds(here, there, rms_m);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), VFIT_ERROR_DATA);
            return error.what();
        }
        return "";
    };
    const WorldPlace place = turned(0.3f, Vec3(0.0f));
    const Walk few(place, 7, 0.0f), standing(place, 30, 0.0f, 0.1f);
    Walk broken(place, 30, 0.0f);
    EXPECT_NE(fault(few.here, few.there).find("7 points"), std::string::npos);
    EXPECT_NE(fault(standing.here, standing.there).find("walk about"), std::string::npos);
    for (const float nowhere : {NAN, 1e20f, 1e10f}) {
        broken.there[4].y = nowhere;
        EXPECT_NE(fault(broken.here, broken.there).find("finite"), std::string::npos) << nowhere;
    }
}

}  // namespace
}  // namespace vfit
