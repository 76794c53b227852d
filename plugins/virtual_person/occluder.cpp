#include "occluder.h"

#include <algorithm>

namespace vfit::virtual_person {

namespace {

// As wide as a cupboard that is carried past, taller than a person.
constexpr float kBoxHalfWidth_m = 0.55f, kBoxHalfHeight_m = 1.05f, kBoxHalfDepth_m = 0.25f;
constexpr float kNearer_m = 0.8f;   // than the person
constexpr float kPerson_m = 0.35f;  // width of a trunk (chest breadth 0.28 to 0.38 m)
constexpr float kHidden_s = 1.0f;

}  // namespace

Solid Occluder::at(double t_s) const {
    // Seen from the camera a nearer thing covers what is wider by the ratio of the distances.
    const float distance = -stand_.z, nearer = std::max(distance - kNearer_m, 0.3f * distance);
    const float covered = 2.0f * kBoxHalfWidth_m - kPerson_m * nearer / distance;
    const float speed = covered / kHidden_s;
    const float x = stand_.x + speed * static_cast<float>(t_s - double{begin_s_} - double{kHidden_s} / 2);
    return box({x, kBoxHalfHeight_m, -nearer}, {kBoxHalfWidth_m, kBoxHalfHeight_m, kBoxHalfDepth_m});
}

}  // namespace vfit::virtual_person
