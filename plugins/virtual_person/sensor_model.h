// The depth cameras that can be played: size, intrinsics, range, and how depth errs (formulas and their
// sources in docs/virtual-person.md).
#pragma once

#include <cstdint>
#include <string>

namespace vfit::virtual_person {

enum class DepthPrinciple { kIdeal, kStructuredLight, kTimeOfFlight };

struct SensorModel {
    const char* name;
    DepthPrinciple principle;
    uint32_t width, height;
    float fx, fy, cx, cy;  // px; pixel centres lie at whole numbers
    float range_min_m, range_max_m;
    float baseline_m;  // projector to camera, the projector at +x; 0: none
};

uint32_t sensor_model_count();
const SensorModel& sensor_model(uint32_t index);
/// Null if no model has that name.
const SensorModel* find_sensor_model(const std::string& name);
/// "kinect_v1, kinect_v1_320, ...", for messages.
std::string sensor_model_names();

/// Standard deviation of depth for a surface at z whose normal is theta off the line of sight.
float axial_sigma_m(DepthPrinciple principle, float z_m, float theta_rad);
/// Standard deviation of where on the image a depth edge is seen, in pixels.
float lateral_sigma_px(DepthPrinciple principle, float theta_rad);
/// Probability that a surface at that angle returns no depth.
float dropout_probability(DepthPrinciple principle, float theta_rad);
/// Distance between neighbouring depth values of a structured-light sensor at z.
/// dZ = kDisparityQuantum * Z^2: 2.85e-5 / cm (Khoshelham and Elberink 2012), 1/8 px of disparity.
inline constexpr float kDisparityQuantumPerM = 2.85e-3f;
inline float quantum_m(float z_m) { return kDisparityQuantumPerM * z_m * z_m; }

}  // namespace vfit::virtual_person
