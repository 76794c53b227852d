#include "frame/floor.h"

#include <algorithm>

namespace vfit {

namespace {

// Height of the ankle joint above the sole: lateral malleolus 73 mm (men), ANSUR II, plus half the joint.
constexpr float kAnkleHeight = 0.08f;  // m
// Of the ball of the foot, where trackers put TOES.
constexpr float kToesHeight = 0.03f;  // m

Body carried(const Body& body, const Mat4& m) {
    const Quat turn = glm::quat_cast(Mat3(m));
    Body out = body;
    for (Joint& joint : out.joints) {
        joint.position = transform_point(m, joint.position);
        if (joint.has_rotation) joint.rotation = turn * joint.rotation;
    }
    return out;
}

}  // namespace

bool estimate_floor(Camera& camera, const Body& body) {
    float lowest = -1e9f;  // camera y points down
    for (const int foot : {VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_RIGHT_FOOT})
        if (body.has(foot)) lowest = std::max(lowest, body.at(foot).y + kAnkleHeight);
    for (const int toes : {VFIT_JOINT_LEFT_TOES, VFIT_JOINT_RIGHT_TOES})
        if (body.has(toes)) lowest = std::max(lowest, body.at(toes).y + kToesHeight);
    // A camera below the feet is no camera in a room: such joints say nothing about the floor.
    if (lowest <= 0.0f) return false;
    set_floor(camera, lowest, 0.0f, 0.0f, VFIT_FLOOR_ESTIMATED);
    return true;
}

Body to_world(const Body& body, const Camera& camera) { return carried(body, camera.world_from_camera()); }

Body to_camera(const Body& body, const Camera& camera) { return carried(body, camera.camera_from_world()); }

}  // namespace vfit
