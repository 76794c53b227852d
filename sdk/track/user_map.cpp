#include "track/user_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vfit {

void write_user_map(const DepthImage& image, const DepthGrid& grid, const uint8_t* labels, uint8_t* users) {
    const uint32_t stride = grid.stride(), width = grid.width();
    const float unit = image.camera.depth_unit_m;
    std::memset(users, 0, size_t(image.width()) * image.height());
    for (uint32_t y = 0; y < grid.height(); ++y) {
        const uint8_t* const label = labels + size_t(y) * width;
        const float* const depth = grid.depth().data() + size_t(y) * width;
        for (uint32_t x = 0; x < width; ++x) {
            if (label[x] == 0) continue;
            const float z = depth[x];
            const int middle = int(z / unit), band = int(same_surface_m(z) / unit);
            for (uint32_t j = 0; j < stride; ++j) {
                const size_t first = image.index(x * stride, y * stride + j);
                for (uint32_t i = 0; i < stride; ++i) {
                    const int d = image.depth[first + i];
                    if (d != 0 && std::abs(d - middle) <= band) users[first + i] = label[x];
                }
            }
        }
    }
}

}  // namespace vfit
