#include "motion/foot_pin.h"

#include <cmath>

namespace vfit {

Vec3 FootPin::update(const Vec3& tracked, bool planted, float floor_y, float dt_s) {
    const float decay = std::exp(-dt_s / kGlideTimeS);
    drag_ = Vec3(0.0f);
    if (!planted) {
        planted_ = false;
        offset_ *= decay;
        if (glm::dot(offset_, offset_) < 1e-10f) offset_ = Vec3(0.0f);
        return tracked + offset_;
    }
    if (!planted_) recorded_ = tracked + offset_;
    planted_ = true;
    recorded_.y = floor_y + (recorded_.y - floor_y) * decay;
    offset_ = recorded_ - tracked;
    const float length = glm::length(offset_);
    if (length > leash_m_) {
        drag_ = offset_ * (leash_m_ / length - 1.0f);
        offset_ += drag_;
        recorded_ += drag_;
    }
    return tracked + offset_;
}

}  // namespace vfit
