#include "bench/carried_props.h"

#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace vfit::tools {

namespace {

constexpr float kTurn_rad = 6.2831853f;

vfit_prop_desc desc_of(vfit_prop_shape shape, float x, float y = 0.0f, float z = 0.0f) {
    vfit_prop_desc desc = vfit_prop_desc_init();
    desc.shape = shape;
    desc.size[0] = x, desc.size[1] = y, desc.size[2] = z;
    return desc;
}

/// A part of the trunk: x to the person's left, y up the spine, z forward.
struct Frame3 {
    glm::vec3 at;
    glm::mat3 axes;

    Frame3(const glm::vec3& left, const glm::vec3& right, const glm::vec3& above)
        : at(0.5f * (left + right)) {
        const glm::vec3 x = glm::normalize(left - right), up = above - at;
        const glm::vec3 y = glm::normalize(up - glm::dot(up, x) * x);
        axes = glm::mat3(x, y, glm::cross(x, y));
    }
};

void move_to(vfit_prop prop, const glm::vec3& at, const glm::mat3& axes) {
    const glm::quat turn = glm::quat_cast(axes);
    const float rotation[4] = {turn.x, turn.y, turn.z, turn.w};
    check(vfit_prop_move(prop, &at.x, rotation));
}

}  // namespace

CarriedProps::CarriedProps(vfit_context context) {
    const auto make = [&](const vfit_prop_desc& desc, Prop& out) {
        check(vfit_prop_create(context, &desc, out.out()));
    };
    make(desc_of(VFIT_PROP_CAPSULE, 0.02f, 0.35f), scabbard_);
    make(desc_of(VFIT_PROP_BOX, 0.14f, 0.2f, 0.08f), backpack_);
    make(desc_of(VFIT_PROP_SPHERE, 0.11f), ball_);
}

void CarriedProps::move(vfit_avatar avatar, double time_s) {
    std::array<glm::vec3, VFIT_JOINT_COUNT> at{};
    for (const vfit_joint& j : list<vfit_joint>([&](auto* items, uint32_t stride, uint32_t* count) {
             return vfit_avatar_joints(avatar, items, stride, count);
         }))
        at[size_t(j.joint)] = {j.position[0], j.position[1], j.position[2]};
    const Frame3 hips(at[VFIT_JOINT_LEFT_HIP], at[VFIT_JOINT_RIGHT_HIP], at[VFIT_JOINT_TORSO]),
        chest(at[VFIT_JOINT_LEFT_SHOULDER], at[VFIT_JOINT_RIGHT_SHOULDER],
              2.0f * at[VFIT_JOINT_NECK] - at[VFIT_JOINT_TORSO]);
    // Behind the left hip, its lower end further back.
    const glm::mat3 tilted =
        hips.axes * glm::mat3(glm::mat3_cast(glm::angleAxis(0.5f, glm::vec3(1.0f, 0.0f, 0.0f))));
    move_to(scabbard_.get(), hips.at + hips.axes * glm::vec3(0.17f, -0.12f, -0.2f), tilted);
    move_to(backpack_.get(), chest.at + chest.axes * glm::vec3(0.0f, -0.2f, -0.24f), chest.axes);
    // About the knees, 1.6 m/s.
    const float angle = kTurn_rad * 0.6f * float(time_s);
    const glm::vec3 around(std::cos(angle), 0.0f, std::sin(angle));
    move_to(ball_.get(), hips.at + 0.42f * around + glm::vec3(0.0f, -0.4f, 0.0f), glm::mat3(1.0f));
}

void CarriedProps::add_to(std::span<const vfit_cloth> cloths) const {
    for (const vfit_cloth cloth : cloths)
        for (const Prop* prop : {&scabbard_, &backpack_, &ball_})
            check(vfit_cloth_add_prop(cloth, prop->get()));
}

size_t prop_crossings(std::span<const vfit_cloth> cloths) {
    size_t pairs = 0;
    for (const vfit_crossing& c : list<vfit_crossing>([&](auto* items, uint32_t stride, uint32_t* count) {
             return vfit_outfit_check(cloths.data(), uint32_t(cloths.size()), items, stride, count);
         }))
        if (c.kind == VFIT_CROSSING_PROP) pairs += c.pair_count;
    return pairs;
}

}  // namespace vfit::tools
