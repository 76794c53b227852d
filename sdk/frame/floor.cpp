#include "frame/floor.h"

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

std::optional<Vec3> lowest_sole(const Body& body, const Vec3& up) {
    std::optional<Vec3> sole;
    const auto take = [&](int joint, float above_m) {
        if (body.joints[size_t(joint)].state != VFIT_JOINT_MEASURED) return;
        const Vec3 below = body.at(joint) - above_m * up;
        if (!sole || glm::dot(below, up) < glm::dot(*sole, up)) sole = below;
    };
    take(VFIT_JOINT_LEFT_FOOT, kAnkleHeight), take(VFIT_JOINT_RIGHT_FOOT, kAnkleHeight);
    take(VFIT_JOINT_LEFT_TOES, kToesHeight), take(VFIT_JOINT_RIGHT_TOES, kToesHeight);
    // A camera below the feet is no camera in a room: such joints say nothing about the floor.
    if (sole && glm::dot(*sole, up) >= 0.0f) sole.reset();
    return sole;
}

bool estimate_floor(Camera& camera, const Body& body) {
    const Vec3 up(0, -1, 0);
    const auto sole = lowest_sole(body, up);
    if (!sole) return false;
    set_floor(camera, -glm::dot(*sole, up), 0.0f, 0.0f, VFIT_FLOOR_ESTIMATED);
    return true;
}

Body to_world(const Body& body, const Camera& camera) { return carried(body, camera.world_from_camera()); }

Body to_camera(const Body& body, const Camera& camera) { return carried(body, camera.camera_from_world()); }

}  // namespace vfit
