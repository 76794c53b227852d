// A frame of the C ABI as the library's own rooms see it, for benches that run them without it.
#pragma once

#include <cstring>
#include <vector>

#include "client/client.h"
#include "frame/depth_image.h"

namespace vfit::tools {

Camera camera_of_frame(vfit_frame frame);

/// Copies one stream, row by row.
template <typename T>
void copy_pixels(const vfit_view& view, std::vector<T>& out) {
    out.resize(size_t(view.width) * view.height);
    for (uint32_t y = 0; y < view.height; ++y)
        std::memcpy(out.data() + size_t(y) * view.width, row_of<T>(view, y), view.width * sizeof(T));
}

/// A frame of millimetres from a camera of the host that knows its lens and no floor.
Frame make_depth_frame(vfit_context context, const Camera& camera, const std::vector<uint16_t>& depth,
                       int64_t time_ns);

/// Depth and user map of a frame, copied.
struct FrameImage {
    explicit FrameImage(vfit_frame frame);
    DepthImage image() const { return {depth.data(), users.data(), camera}; }

    std::vector<uint16_t> depth;
    std::vector<uint8_t> users;
    Camera camera;
};

}  // namespace vfit::tools
