#include "frame/camera_struct.h"

#include <algorithm>
#include <cstring>

#include "core/error.h"

namespace vfit {

void set_intrinsics(Camera& camera, const vfit_intrinsics& in) {
    Camera next = camera;
    next.width = in.width;
    next.height = in.height;
    next.fx = in.fx;
    next.fy = in.fy;
    next.cx = in.cx;
    next.cy = in.cy;
    std::copy(std::begin(in.distortion), std::end(in.distortion), next.distortion);
    validate_lens(next);
    camera = next;
}

void set_placement(Camera& camera, const vfit_camera& in) {
    if (in.floor_state < VFIT_FLOOR_DEFAULT || in.floor_state > VFIT_FLOOR_GIVEN)
        fail(VFIT_ERROR_ARGUMENT, "camera: floor_state ", in.floor_state, " is not one of its values");
    const Camera level;
    Camera next = camera;
    next.depth_unit_m = in.depth_unit_m != 0.0f ? in.depth_unit_m : level.depth_unit_m;
    next.floor_state = in.floor_state;
    next.floor_normal = level.floor_normal;
    next.floor_distance_m = level.floor_distance_m;
    if (in.floor_state != VFIT_FLOOR_DEFAULT) {
        next.floor_normal = {in.floor_normal[0], in.floor_normal[1], in.floor_normal[2]};
        next.floor_distance_m = in.floor_distance_m;
    }
    validate_placement(next);
    // Hand-written normals are a little off unit length; bodies must not be scaled by that.
    next.floor_normal = glm::normalize(next.floor_normal);
    camera = next;
}

vfit_intrinsics intrinsics_out(const Camera& camera) {
    vfit_intrinsics out{};
    out.width = camera.width;
    out.height = camera.height;
    out.fx = camera.fx;
    out.fy = camera.fy;
    out.cx = camera.cx;
    out.cy = camera.cy;
    std::copy(std::begin(camera.distortion), std::end(camera.distortion), out.distortion);
    return out;
}

vfit_camera placement_out(const Camera& camera) {
    vfit_camera out{};
    out.floor_state = camera.floor_state;
    out.depth_unit_m = camera.depth_unit_m;
    out.height_m = camera.camera_height_m();
    out.tilt_rad = camera.tilt_rad();
    out.roll_rad = camera.roll_rad();
    std::memcpy(out.floor_normal, &camera.floor_normal, sizeof out.floor_normal);
    out.floor_distance_m = camera.floor_distance_m;
    const Mat4 m = camera.world_from_camera();
    std::memcpy(out.world_from_camera, &m, sizeof out.world_from_camera);
    return out;
}

}  // namespace vfit
