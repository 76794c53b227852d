#include "scan/trunk_profile.h"

#include <algorithm>
#include <cmath>

#include "core/wipe.h"
#include "scan/trunk_lines.h"

namespace vfit {

namespace {

constexpr float kJump_m = 0.05f;    // from pixel to pixel: another part of the body begins
constexpr float kWidest_m = 0.40f;  // from the spine
constexpr int kGap = 2;             // pixels without a reading inside the person

struct Edge {
    float metres = 0.0f;  // across the line of sight
    bool found = false;
};

}  // namespace

void TrunkProfile::reset() { wipe(sums_); }

TrunkProfile::Reaches TrunkProfile::reaches_m(ViewKind view, int level) const {
    Reaches out;
    for (size_t r = 0; r < out.size(); ++r) {
        const Sum& sum = sums_[size_t(view)][size_t(level)][r];
        out[r] = sum.count ? float(sum.metres / sum.count) : std::nanf("");
    }
    return out;
}

void TrunkProfile::add(const DepthImage& image, uint8_t user, const BodyFit& fit, ViewKind view) {
    const TrunkLines lines(image, user, fit);
    const Camera& camera = image.camera;
    const auto reading = [&](const Vec2& p) { return lines.reading(p); };
    for (int l = 0; l < kLevels; ++l) {
        const auto line = lines.line(along(l));
        if (!line) continue;
        const Vec3 centre = line->centre;
        const Vec2 at = line->at, across = line->across;
        const float pixel_m = centre.z / camera.fx;
        const float surface = reading(at);
        if (surface == 0.0f) continue;
        const auto edge = [&](float way) {
            Edge out;
            float z = surface;
            int last = 0;
            const int far = int(kWidest_m / pixel_m);
            for (int i = 1; i <= far; ++i) {
                const float here = reading(at + way * float(i) * across);
                if (here == 0.0f) {
                    if (i - last <= kGap) continue;
                    out.found = true;
                    break;
                }
                if (here < z - kJump_m) return out;  // an arm before it
                if (here > z + kJump_m) {            // an arm behind it
                    out.found = true;
                    break;
                }
                z = here, last = i;
            }
            out.metres = (float(last) + 0.5f) * pixel_m;
            return out;
        };
        auto& sums = sums_[size_t(view)][size_t(l)];
        const auto add_to = [&](int reach, float metres) {
            sums[size_t(reach)].metres += double(metres), ++sums[size_t(reach)].count;
        };
        add_to(kTowards, centre.z - surface);
        const auto add_side = [&](float way, int reach) {
            const Edge outline = edge(way);
            if (!outline.found) return;
            add_to(reach, outline.metres);
            for (int quarters = 1; quarters <= 3; ++quarters) {
                const float z =
                    reading(at + way * 0.25f * float(quarters) * outline.metres / pixel_m * across);
                if (std::abs(z - surface) < kWidest_m) add_to(reach + quarters, centre.z - z);
            }
        };
        // Which way is ahead in the picture?
        const bool one_ahead = glm::dot(camera.project(centre + 0.1f * lines.ahead()) - at, across) > 0.0f;
        add_side(1.0f, view == ViewKind::kFront || one_ahead ? kAhead : kBehind);
        add_side(-1.0f, view == ViewKind::kFront || !one_ahead ? kAhead : kBehind);
    }
}

}  // namespace vfit
