// Lines across the trunk in the picture, at levels along the fitted spine, and the person's readings on them.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "fit/body_fit.h"
#include "frame/depth_image.h"

namespace vfit {

/// Of the frame that was fitted last.
class TrunkLines {
public:
    struct Line {
        Vec3 centre;  // on the spine, camera space
        Vec2 at;      // the same in the picture
        Vec2 across;  // unit, square to the spine in the picture
    };

    TrunkLines(const DepthImage& image, uint8_t user, const BodyFit& fit)
        : image_(image), user_(user), ahead_(fit.body().bone_turns()[VFIT_BONE_HIPS] * Vec3(0, 0, 1)) {
        const auto& joints = fit.body().joints();
        hips_ = 0.5f * (joints[VFIT_JOINT_LEFT_HIP] + joints[VFIT_JOINT_RIGHT_HIP]);
        spine_ = joints[VFIT_JOINT_NECK] - hips_;
    }

    /// The way that the hips face, camera space.
    const Vec3& ahead() const { return ahead_; }
    /// `along`: of the way from between the hip joints (0) to the neck's joint (1). Nothing where the spine
    /// is too near, or points at the camera.
    std::optional<Line> line(float along) const {
        constexpr float kNearest_m = 0.5f;
        const Vec3 centre = hips_ + along * spine_;
        if (centre.z < kNearest_m) return std::nullopt;
        const Vec2 at = image_.camera.project(centre),
                   way = image_.camera.project(centre + 0.1f * spine_) - at;
        const float length = glm::length(way);
        if (!(length > 1.0f)) return std::nullopt;
        return Line{centre, at, Vec2(-way.y, way.x) / length};
    }
    /// Metres; 0: not the person's.
    float reading(const Vec2& p) const {
        const int x = int(std::lround(p.x)), y = int(std::lround(p.y));
        if (x < 0 || y < 0 || x >= int(image_.width()) || y >= int(image_.height())) return 0.0f;
        const size_t i = image_.index(uint32_t(x), uint32_t(y));
        return image_.users[i] == user_ ? image_.metres(i) : 0.0f;
    }

private:
    const DepthImage& image_;
    uint8_t user_;
    Vec3 ahead_, hips_{0.0f}, spine_{0.0f};
};

}  // namespace vfit
