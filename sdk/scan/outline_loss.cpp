#include "scan/outline_loss.h"

#include <cmath>
#include <cstddef>

namespace vfit {

namespace {

constexpr float kBehind_m = 0.08f;  // farther than the person's last reading: it is background
constexpr float kSettled = 0.03f;   // of its depth: two readings side by side that are of one surface
constexpr int kWidestGap = 4;       // pixels; a wider one is the shadow of a structured light's projector

}  // namespace

void OutlineLoss::add(const DepthImage& image, uint8_t user) {
    const int width = int(image.width()), height = int(image.height());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t here = image.index(uint32_t(x), uint32_t(y));
            if (image.users[here] != user || image.depth[here] == 0) continue;
            constexpr int kWays[][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
            for (const auto& way : kWays) {
                // One more than the gap: two readings tell that the background has settled.
                for (int gap = 0; gap <= kWidestGap; ++gap) {
                    const int u = x + (gap + 1) * way[0], v = y + (gap + 1) * way[1];
                    const int u2 = u + way[0], v2 = v + way[1];
                    if (u2 < 0 || v2 < 0 || u2 >= width || v2 >= height) break;
                    const size_t next = image.index(uint32_t(u), uint32_t(v)),
                                 after = image.index(uint32_t(u2), uint32_t(v2));
                    if (image.users[next] != 0) break;
                    const float z = image.metres(next), z2 = image.metres(after);
                    const bool settled = image.depth[next] && image.depth[after] && image.users[after] == 0 &&
                                         z > image.metres(here) + kBehind_m &&
                                         std::abs(z2 - z) < kSettled * z;
                    if (!settled) continue;
                    gaps_ += uint64_t(gap), ++count_;
                    break;
                }
            }
        }
}

}  // namespace vfit
