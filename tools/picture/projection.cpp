#include "picture/projection.h"

namespace vfit::tools {

namespace {

constexpr std::array<std::pair<vfit_joint_id, vfit_joint_id>, 22> kBones = {{
    {VFIT_JOINT_HEAD, VFIT_JOINT_NECK},
    {VFIT_JOINT_NECK, VFIT_JOINT_TORSO},
    {VFIT_JOINT_TORSO, VFIT_JOINT_PELVIS},
    {VFIT_JOINT_NECK, VFIT_JOINT_LEFT_SHOULDER},
    {VFIT_JOINT_NECK, VFIT_JOINT_RIGHT_SHOULDER},
    {VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_LEFT_ELBOW},
    {VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_RIGHT_ELBOW},
    {VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_WRIST},
    {VFIT_JOINT_RIGHT_ELBOW, VFIT_JOINT_RIGHT_WRIST},
    {VFIT_JOINT_LEFT_WRIST, VFIT_JOINT_LEFT_HAND},
    {VFIT_JOINT_RIGHT_WRIST, VFIT_JOINT_RIGHT_HAND},
    {VFIT_JOINT_PELVIS, VFIT_JOINT_LEFT_HIP},
    {VFIT_JOINT_PELVIS, VFIT_JOINT_RIGHT_HIP},
    {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_KNEE},
    {VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE},
    {VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_LEFT_FOOT},
    {VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_RIGHT_FOOT},
    {VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_LEFT_TOES},
    {VFIT_JOINT_RIGHT_FOOT, VFIT_JOINT_RIGHT_TOES},
    // Of a source that has only the paper's 15 joints:
    {VFIT_JOINT_TORSO, VFIT_JOINT_LEFT_HIP},
    {VFIT_JOINT_TORSO, VFIT_JOINT_RIGHT_HIP},
    {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP},
}};
// And of one without wrists.
constexpr std::array<std::array<vfit_joint_id, 3>, 2> kForearms = {{
    {VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_WRIST, VFIT_JOINT_LEFT_HAND},
    {VFIT_JOINT_RIGHT_ELBOW, VFIT_JOINT_RIGHT_WRIST, VFIT_JOINT_RIGHT_HAND},
}};

}  // namespace

Projection::Projection(vfit_frame frame, int scale) : camera_(camera_of(frame)), scale_(scale) {
    check(vfit_frame_intrinsics(frame, &k_));
}

std::optional<Projection::Pixel> Projection::operator()(const float (&world)[3]) const {
    const Point p = to_camera(camera_, world);
    if (p.z < 0.05f) return std::nullopt;
    const auto s = static_cast<float>(scale_);
    return Pixel{(p.x / p.z * k_.fx + k_.cx + 0.5f) * s, (p.y / p.z * k_.fy + k_.cy + 0.5f) * s,
                 k_.fx / p.z * s};
}

JointPixels project_joints(const Projection& projection, const std::vector<vfit_joint>& joints) {
    JointPixels at;
    for (const vfit_joint& j : joints) at[static_cast<size_t>(j.joint)] = projection(j.position);
    return at;
}

std::vector<std::pair<vfit_joint_id, vfit_joint_id>> drawn_bones(const JointPixels& at) {
    const auto there = [&](vfit_joint_id joint) { return at[static_cast<size_t>(joint)].has_value(); };
    std::vector<std::pair<vfit_joint_id, vfit_joint_id>> out;
    for (const auto& [a, b] : kBones) {
        const bool spare = (a == VFIT_JOINT_TORSO && b != VFIT_JOINT_PELVIS) ||
                           (a == VFIT_JOINT_LEFT_HIP && b == VFIT_JOINT_RIGHT_HIP);
        if (there(a) && there(b) && !(spare && there(VFIT_JOINT_PELVIS))) out.emplace_back(a, b);
    }
    for (const auto& [elbow, wrist, hand] : kForearms)
        if (there(elbow) && there(hand) && !there(wrist)) out.emplace_back(elbow, hand);
    return out;
}

}  // namespace vfit::tools
