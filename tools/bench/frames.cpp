#include "bench/frames.h"

namespace vfit::tools {

Camera camera_of_frame(vfit_frame frame) {
    vfit_intrinsics k = vfit_intrinsics_init();
    check(vfit_frame_intrinsics(frame, &k));
    const vfit_camera c = camera_of(frame);
    Camera camera;
    camera.width = k.width;
    camera.height = k.height;
    camera.fx = k.fx;
    camera.fy = k.fy;
    camera.cx = k.cx;
    camera.cy = k.cy;
    camera.depth_unit_m = c.depth_unit_m;
    camera.floor_state = c.floor_state;
    camera.floor_normal = Vec3(c.floor_normal[0], c.floor_normal[1], c.floor_normal[2]);
    camera.floor_distance_m = c.floor_distance_m;
    return camera;
}

FrameImage::FrameImage(vfit_frame frame) : camera(camera_of_frame(frame)) {
    copy_pixels(view_of(frame, VFIT_STREAM_DEPTH), depth);
    copy_pixels(view_of(frame, VFIT_STREAM_USER_MAP), users);
}

}  // namespace vfit::tools
