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

Frame make_depth_frame(vfit_context context, const Camera& camera, const std::vector<uint16_t>& depth,
                       int64_t time_ns) {
    vfit_view view = vfit_view_init();
    view.data = depth.data();
    view.width = camera.width, view.height = camera.height;
    view.row_stride = camera.width * 2;
    view.format = VFIT_FORMAT_U16;
    vfit_intrinsics intrinsics = vfit_intrinsics_init();
    intrinsics.width = camera.width, intrinsics.height = camera.height;
    intrinsics.fx = camera.fx, intrinsics.fy = camera.fy;
    intrinsics.cx = camera.cx, intrinsics.cy = camera.cy;
    const vfit_stream stream = VFIT_STREAM_DEPTH;
    vfit_frame_desc desc = vfit_frame_desc_init();
    desc.count = 1, desc.streams = &stream, desc.views = &view;
    desc.intrinsics = &intrinsics, desc.time_ns = time_ns;
    Frame frame;
    check(vfit_frame_create(context, &desc, frame.out()));
    return frame;
}

FrameImage::FrameImage(vfit_frame frame) : camera(camera_of_frame(frame)) {
    copy_pixels(view_of(frame, VFIT_STREAM_DEPTH), depth);
    copy_pixels(view_of(frame, VFIT_STREAM_USER_MAP), users);
}

}  // namespace vfit::tools
