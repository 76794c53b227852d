#include "sensor_model.h"

#include <algorithm>
#include <cmath>

#include "types.h"

namespace vfit::virtual_person {

namespace {

// Intrinsics of calibrated units, distortion removed (images are rectified). kinect_v1_320 is the same camera
// with 2 x 2 pixels as one. Ranges are the makers': Kinect v1 default mode, Kinect v2, Azure Kinect narrow
// field of view unbinned and binned, which is 2 x 2 pixels as one too.
constexpr SensorModel kModels[] = {
    {"kinect_v1", DepthPrinciple::kStructuredLight, 640, 480, 594.21434f, 591.04054f, 339.30781f, 242.73914f,
     0.8f, 4.0f, 0.075f},
    {"kinect_v1_320", DepthPrinciple::kStructuredLight, 320, 240, 297.10717f, 295.52027f, 169.403905f,
     121.11957f, 0.8f, 4.0f, 0.075f},
    {"azure", DepthPrinciple::kTimeOfFlight, 640, 576, 503.92764f, 503.97873f, 332.06427f, 325.88062f, 0.5f,
     3.86f, 0.0f},
    {"azure_binned", DepthPrinciple::kTimeOfFlight, 320, 288, 251.96382f, 251.989365f, 165.782135f,
     162.69031f, 0.5f, 5.46f, 0.0f},
    {"tof", DepthPrinciple::kTimeOfFlight, 512, 424, 365.456f, 365.456f, 254.878f, 205.395f, 0.5f, 4.5f,
     0.0f},
    {"ideal", DepthPrinciple::kIdeal, 640, 480, 594.21434f, 591.04054f, 339.30781f, 242.73914f, 0.1f, 65.0f,
     0.0f},
};

constexpr float kRightAngle = kPi / 2;
constexpr float kSteepestAngle = kRightAngle - 0.01f;  // rad; the formulas grow without end at 90 degrees

// A grazing surface sends back too little. Published generators cut at 70 to 80 degrees; here pixels get lost
// from 75 degrees on, all of them at 85, so that the cut is at 80 on average and not sharp.
constexpr float kDropoutStart = 75.0f * kPi / 180.0f, kDropoutEnd = 85.0f * kPi / 180.0f;

}  // namespace

uint32_t sensor_model_count() { return static_cast<uint32_t>(std::size(kModels)); }

const SensorModel& sensor_model(uint32_t index) { return kModels[index]; }

const SensorModel* find_sensor_model(const std::string& name) {
    for (const SensorModel& m : kModels)
        if (name == m.name) return &m;
    return nullptr;
}

std::string sensor_model_names() {
    std::string names;
    for (const SensorModel& m : kModels) names += (names.empty() ? "" : ", ") + std::string(m.name);
    return names;
}

float axial_sigma_m(DepthPrinciple principle, float z, float theta) {
    theta = std::clamp(theta, 0.0f, kSteepestAngle);
    const float slant = theta / (kRightAngle - theta);
    switch (principle) {
        case DepthPrinciple::kIdeal: return 0.0f;
        case DepthPrinciple::kStructuredLight: {  // Nguyen, Izadi and Lovell 2012
            const float frontal = 0.0012f + 0.0019f * (z - 0.4f) * (z - 0.4f);
            return theta < kPi / 3 ? frontal : frontal + 0.0001f / std::sqrt(z) * slant * slant;
        }
        case DepthPrinciple::kTimeOfFlight:  // Fankhauser et al. 2015, which gives millimetres
            return 0.001f * (1.5f - 0.5f * z + 0.3f * z * z + 0.1f * z * std::sqrt(z) * slant * slant);
    }
    return 0.0f;
}

float lateral_sigma_px(DepthPrinciple principle, float theta) {
    if (principle != DepthPrinciple::kStructuredLight) return 0.0f;
    theta = std::clamp(theta, 0.0f, kSteepestAngle);
    return 0.8f + 0.035f * theta / (kRightAngle - theta);  // Nguyen, Izadi and Lovell 2012
}

float dropout_probability(DepthPrinciple principle, float theta) {
    if (principle == DepthPrinciple::kIdeal) return 0.0f;
    return std::clamp((theta - kDropoutStart) / (kDropoutEnd - kDropoutStart), 0.0f, 1.0f);
}

}  // namespace vfit::virtual_person
