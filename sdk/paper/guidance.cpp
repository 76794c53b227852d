#include "paper/guidance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "core/clock.h"
#include "paper/silhouette.h"

namespace vfit {

namespace {

// Structured light and time of flight read nothing nearer (Kinect v1: 0.8 m) and little useful beyond 5.5 m
// (Azure Kinect, binned: 5.46 m).
constexpr float kNearest_m = 0.8f;
constexpr float kFarthest_m = 5.5f;
// A pixel of 2 cm leaves half a pixel, 1 cm, of error at the crown.
constexpr float kCoarsestPixel_m = 0.02f;
// Fewer pixels than a raised hand has at 3 m: nothing that could be a person.
constexpr uint32_t kFewestPixels = 200;
// Walking pace is 1.4 m/s; at 30 Hz a faster trunk is blurred by more than a Kinect's noise.
constexpr float kFastest_m_s = 1.5f;
constexpr float kFrameTime_s = 1.0f / 30.0f;
// Straight legs are as high as they are long; trackers put the hips of a person who stands straight up to 0.1
// m before the ankles, which leaves 0.98. Below 0.96, 2 cm and more is missing at the crown.
constexpr float kStraightLegs = 0.96f;
constexpr float kLeaning_rad = 20.0f * kPi / 180.0f;

bool all_seen(const Body& body, std::initializer_list<int> joints) {
    return std::all_of(joints.begin(), joints.end(),
                       [&](int j) { return body.has(j) && body.at(j).z > 0.0f; });
}

bool on_person(const FilteredDepth& depth, const Camera& camera, const Vec3& joint) {
    const Pixel pixel = nearest_pixel(camera.project(joint));
    return depth.inside(pixel.x, pixel.y);
}

/// At the top or the bottom of the view; for a camera that is mounted on its side those are the image's
/// sides.
bool cut_vertically(const FilteredDepth& depth, const Camera& camera) {
    const Vec3& up = camera.floor_normal;
    if (std::abs(up.x) > std::abs(up.y)) return depth.box.x0 <= 0 || depth.box.x1 >= int(depth.width);
    return depth.box.y0 <= 0 || depth.box.y1 >= int(depth.height);
}

/// Share of its length that the straighter leg stands upright (-1: upside down); 1 where no leg can be
/// judged.
float leg_uprightness(const Vec3& up, const Body& body) {
    constexpr float kNoLeg = -2.0f;
    float best = kNoLeg;
    for (const auto& [hip, knee, foot] :
         {std::array{VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_LEFT_FOOT},
          std::array{VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_RIGHT_FOOT}}) {
        if (!all_seen(body, {hip, knee, foot})) continue;
        const float length =
            glm::length(body.at(hip) - body.at(knee)) + glm::length(body.at(knee) - body.at(foot));
        if (length > 0.0f) best = std::max(best, glm::dot(body.at(hip) - body.at(foot), up) / length);
    }
    return best == kNoLeg ? 1.0f : best;
}

bool upright(const Vec3& up, const Body& body) {
    const Vec3 hips = 0.5f * (body.at(VFIT_JOINT_LEFT_HIP) + body.at(VFIT_JOINT_RIGHT_HIP));
    const Vec3 trunk = body.at(VFIT_JOINT_NECK) - hips;
    return glm::dot(trunk, up) > std::cos(kLeaning_rad) * glm::length(trunk) &&
           leg_uprightness(up, body) > kStraightLegs;
}

bool moved(const Body& body, const Body& previous) {
    float sum = 0.0f;
    int joints = 0;
    for (const int j : {VFIT_JOINT_HEAD, VFIT_JOINT_NECK, VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP}) {
        if (!body.has(j) || !previous.has(j)) continue;
        sum += glm::length(body.at(j) - previous.at(j));
        ++joints;
    }
    const float given_s = float(seconds_between(previous.time_ns, body.time_ns));
    const float elapsed_s = given_s > 0.0f ? given_s : kFrameTime_s;
    return joints > 0 && sum / float(joints) > kFastest_m_s * elapsed_s;
}

}  // namespace

vfit_guidance check_frame(const FilteredDepth& depth, const Camera& camera, const Body* body,
                          const Body* previous, uint32_t person_count) {
    if (!body || depth.pixels < kFewestPixels) return VFIT_GUIDANCE_NOBODY;
    if (person_count > 1) return VFIT_GUIDANCE_ONE_PERSON_ONLY;
    if (depth.mean_m < kNearest_m || cut_vertically(depth, camera)) return VFIT_GUIDANCE_STEP_BACK;
    if (depth.mean_m > kFarthest_m || depth.mean_m / std::min(camera.fx, camera.fy) > kCoarsestPixel_m)
        return VFIT_GUIDANCE_STEP_CLOSER;

    if (!all_seen(*body, {VFIT_JOINT_HEAD, VFIT_JOINT_NECK, VFIT_JOINT_LEFT_SHOULDER,
                          VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP}) ||
        !on_person(depth, camera, body->at(VFIT_JOINT_HEAD)))
        return VFIT_GUIDANCE_JOINTS_MISSING;
    bool foot_visible = false;
    for (const int foot : {VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_RIGHT_FOOT})
        foot_visible = foot_visible || (all_seen(*body, {foot}) && on_person(depth, camera, body->at(foot)));
    if (!foot_visible) return VFIT_GUIDANCE_FEET_NOT_VISIBLE;

    if (!upright(camera.floor_normal, *body) || (previous && moved(*body, *previous)))
        return VFIT_GUIDANCE_HOLD_STILL;
    return VFIT_GUIDANCE_NONE;
}

}  // namespace vfit
