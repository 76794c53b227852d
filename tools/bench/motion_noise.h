// The noise that the motion stage is judged under: white on each axis, and now and then a reading far off.
#pragma once

#include <random>

#include "bench/motion_streams.h"

namespace vfit::tools {

class NoisySensor {
public:
    explicit NoisySensor(uint32_t seed) : engine_(seed) {}
    Vec3 operator()(const Vec3& truth) {
        Vec3 v = truth + kNoiseM * gauss();
        if (uniform_(engine_) < kOutlierShare) v += kOutlierM * glm::normalize(gauss());
        return v;
    }

    static constexpr float kNoiseM = 0.01f, kOutlierM = 0.08f, kOutlierShare = 0.01f;

private:
    Vec3 gauss() { return {normal_(engine_), normal_(engine_), normal_(engine_)}; }
    std::mt19937 engine_;
    std::normal_distribution<float> normal_{0.0f, 1.0f};
    std::uniform_real_distribution<float> uniform_{0.0f, 1.0f};
};

}  // namespace vfit::tools
