#include "seen_joints.h"

namespace vfit::virtual_person {

namespace {

// A joint lies inside the body: it counts as seen where the skin in front of it is that of its own part, that
// is no farther than the part is thick.
constexpr float kTrunkThickness_m = 0.22f, kLimbThickness_m = 0.12f;

float thickness_m(vfit_joint_id joint) {
    switch (joint) {
        case VFIT_JOINT_HEAD:
        case VFIT_JOINT_NECK:
        case VFIT_JOINT_TORSO:
        case VFIT_JOINT_PELVIS:
        case VFIT_JOINT_CHEST:
        case VFIT_JOINT_LEFT_HIP:
        case VFIT_JOINT_RIGHT_HIP:
        case VFIT_JOINT_LEFT_CLAVICLE:
        case VFIT_JOINT_RIGHT_CLAVICLE: return kTrunkThickness_m;
        default: return kLimbThickness_m;
    }
}

struct Sight {
    bool in_view = false, seen = false;
};

Sight look_at(const vfit_joint& joint, const Vec3& p, const DepthCamera& camera, const CleanImage& image,
              uint32_t id) {
    if (p.z <= 0.0f) return {};
    const Vec2 pixel = camera.project(p) + 0.5f;
    if (!(pixel.x >= 0.0f && pixel.y >= 0.0f && pixel.x < static_cast<float>(image.width) &&
          pixel.y < static_cast<float>(image.height)))
        return {};
    const size_t i = static_cast<size_t>(pixel.y) * image.width + static_cast<size_t>(pixel.x);
    return {true, image.user[i] == id && p.z - image.depth_m[i] < thickness_m(joint.joint)};
}

}  // namespace

void see_joints(std::span<const vfit_joint> world, const DepthCamera& camera, const CleanImage& image,
                SeenBody& out) {
    out.joints.assign(world.begin(), world.end());
    out.flags = 0, out.in_view = false;
    const Quat to_camera = glm::quat_cast(glm::transpose(camera.world_from_camera()));
    for (vfit_joint& joint : out.joints) {
        const Vec3 p = camera.to_camera({joint.position[0], joint.position[1], joint.position[2]});
        for (int k = 0; k < 3; ++k) joint.position[k] = p[k];
        const Quat turned =
            to_camera * Quat(joint.rotation[3], joint.rotation[0], joint.rotation[1], joint.rotation[2]);
        joint.rotation[0] = turned.x, joint.rotation[1] = turned.y;
        joint.rotation[2] = turned.z, joint.rotation[3] = turned.w;
        const Sight sight = look_at(joint, p, camera, image, out.id);
        joint.state = sight.seen ? VFIT_JOINT_MEASURED : VFIT_JOINT_INFERRED;
        joint.confidence = 1.0f;  // its place is known exactly either way
        out.in_view = out.in_view || sight.in_view;
        if (!sight.in_view) out.flags |= VFIT_BODY_PARTLY_OUT_OF_VIEW;
    }
}

}  // namespace vfit::virtual_person
