#include "frame/in_view.h"

namespace vfit {

bool in_view(const Camera& camera, const Vec3& camera_space) {
    const Vec2 at = camera.project(camera_space);
    return camera_space.z > 0.0f && at.x >= 0.0f && at.y >= 0.0f && at.x < float(camera.width) &&
           at.y < float(camera.height);
}

void limit_states(Body& body, const Camera& camera) {
    for (Joint& joint : body.joints)
        if (joint.state == VFIT_JOINT_MEASURED && !in_view(camera, joint.position))
            joint.state = VFIT_JOINT_INFERRED;
}

}  // namespace vfit
