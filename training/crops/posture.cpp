// Postures are drawn as anatomical angles within human limits (ranges as in reference tables of joint
// motion); arms that have a task get there by two-bone inverse kinematics.
#include "posture.h"

#include <algorithm>

#include "math/two_bone_ik.h"

namespace vfit::training {

namespace {

enum Side { kLeft, kRight };
constexpr float sign_of(Side side) { return side == kLeft ? 1.0f : -1.0f; }

struct SideBones {
    int clavicle, upper_arm, forearm, hand, thigh, shank, foot, toes;
};
constexpr SideBones kBones[2] = {
    {VFIT_BONE_LEFT_SHOULDER, VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_LEFT_HAND,
     VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_LEFT_FOOT, VFIT_BONE_LEFT_TOES},
    {VFIT_BONE_RIGHT_SHOULDER, VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_RIGHT_LOWER_ARM, VFIT_BONE_RIGHT_HAND,
     VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG, VFIT_BONE_RIGHT_FOOT, VFIT_BONE_RIGHT_TOES}};

Quat turn(float degrees, const Vec3& axis) { return glm::angleAxis(glm::radians(degrees), axis); }
Quat about_x(float degrees) { return turn(degrees, {1, 0, 0}); }
Quat about_y(float degrees) { return turn(degrees, {0, 1, 0}); }
Quat about_z(float degrees) { return turn(degrees, {0, 0, 1}); }

/// Normal, cut at two standard deviations.
float spread(Random& random, float mean, float sd) {
    return std::clamp(random.normal(mean, sd), mean - 2 * sd, mean + 2 * sd);
}

class Builder {
public:
    Builder(const Skeleton& skeleton, Random& random) : skeleton_(skeleton), random_(random) {}

    Pose build() {
        pose_.hips_position = skeleton_.offset[VFIT_BONE_HIPS];
        if (random_.chance(0.85f)) {
            usual_legs();
            trunk(1.0f);
            usual_arms();
        } else {
            any_legs();
            trunk(2.2f);
            for (const Side side : {kLeft, kRight}) any_arm(side);
        }
        head();
        return pose_;
    }

private:
    Quat& rotation(int bone) { return pose_.rotation[static_cast<size_t>(bone)]; }

    void usual_legs() {
        switch (random_.pick({0.34f, 0.25f, 0.13f, 0.11f, 0.10f, 0.07f})) {
            case 0: standing(); break;
            case 1: walking(); break;
            case 2: squat(); break;
            case 3: one_leg_free(); break;
            case 4: sitting(); break;
            default: kneeling(); break;
        }
    }

    /// The foot's sole parallel to the floor but for `pitch`; its yaw is the leg's own.
    void leg(Side side, float flex, float abduct, float toes_out, float knee, float foot_pitch) {
        const float s = sign_of(side);
        const SideBones& b = kBones[side];
        const Quat thigh = about_x(-flex) * about_z(s * abduct) * about_y(s * toes_out);
        rotation(b.thigh) = thigh;
        rotation(b.shank) = about_x(knee);
        const Quat shank = rotation(VFIT_BONE_HIPS) * thigh * rotation(b.shank);
        const Vec3 flat = shank * Vec3(1, 0, 0);
        const float yaw = std::atan2(-flat.z, flat.x);
        Quat local = glm::conjugate(shank) * turn(glm::degrees(yaw), {0, 1, 0}) * about_x(foot_pitch);
        // The ankle gives way no further than it can.
        const float most = glm::radians(55.0f),
                    angle = 2.0f * std::acos(std::clamp(std::abs(local.w), 0.0f, 1.0f));
        if (angle > most) local = glm::slerp(Quat(1, 0, 0, 0), local.w < 0 ? -local : local, most / angle);
        rotation(b.foot) = local;
        if (foot_pitch > 15.0f) rotation(b.toes) = about_x(-std::min(foot_pitch - 10.0f, 35.0f));
    }

    void standing() {
        const float apart = std::max(-3.0f, random_.normal(2.5f, 4.0f));
        const float bow = random_.chance(0.12f) ? random_.between(8, 65) : 0.0f;
        bend_ = bow * random_.between(0.2f, 0.8f);
        rotation(VFIT_BONE_HIPS) = about_z(spread(random_, 0, 2)) * about_x(bow + spread(random_, 0, 3));
        for (const Side side : {kLeft, kRight}) {
            const float knee = std::abs(spread(random_, 2, 4));
            leg(side, spread(random_, bow + knee * 0.5f, 4), apart + spread(random_, 0, 2),
                spread(random_, 8, 8), knee, 0);
        }
        if (random_.chance(0.15f)) wide_stance(bow);
    }

    void wide_stance(float bow) {
        for (const Side side : {kLeft, kRight})
            leg(side, bow + spread(random_, 5, 6), random_.between(8, 25), random_.between(0, 30),
                random_.between(0, 15), 0);
    }

    void walking() {
        const float phase = random_.between(0, 2 * kPi), stride = random_.between(6, 34),
                    lift = random_.between(10, 70);
        const float heel_strike = random_.between(-5, 25), push_off = random_.between(0, 40),
                    bend = random_.between(20, 65);
        const bool in_place = random_.chance(0.35f);
        for (const Side side : {kLeft, kRight}) {
            const float p = phase + (side == kLeft ? 0.0f : kPi), swing = std::max(0.0f, std::cos(p));
            if (in_place) {  // marching or jogging on the spot: the knee rises, the shank hangs or kicks back
                const float heel = random_.between(-20, 40) * swing;
                leg(side, lift * swing + 3, spread(random_, 1, 3), spread(random_, 5, 6),
                    lift * 1.3f * swing + heel * swing + 4, 25 * swing * random_.unit());
            } else {
                // Toes up as the heel comes down before the body, heel up as the foot is left behind it.
                const float ahead = std::sin(p),
                            pitch = ahead < 0 ? -push_off * ahead : -heel_strike * ahead * ahead;
                leg(side, stride * ahead + 4, spread(random_, 0, 2), spread(random_, 5, 5), 8 + bend * swing,
                    pitch);
            }
        }
        rotation(VFIT_BONE_HIPS) =
            about_y(6 * std::sin(phase) + spread(random_, 0, 3)) * about_x(spread(random_, 2, 3));
    }

    void squat() {
        const float depth = random_.unit(), knee = 15 + 110 * depth, apart = random_.between(0, 14);
        const float pelvis = 5 + 30 * depth * random_.between(0.4f, 1.2f);
        rotation(VFIT_BONE_HIPS) = about_x(pelvis);
        for (const Side side : {kLeft, kRight})
            leg(side, knee * random_.between(0.5f, 0.62f) + pelvis, apart, random_.between(0, 25), knee,
                random_.chance(0.2f) ? 20 * depth : 0.0f);
        bend_ = random_.between(0, 25) * depth;
    }

    void one_leg_free() {
        const Side free = random_.chance(0.5f) ? kLeft : kRight;
        standing();
        leg(free, random_.between(-20, 80), random_.between(-8, 35), random_.between(-20, 30),
            random_.between(0, 100), random_.between(0, 30));
        rotation(VFIT_BONE_HIPS) = about_z(sign_of(free) * random_.between(-4, 10));
    }

    void sitting() {
        const float pelvis = spread(random_, -5, 6), knee = random_.between(70, 105),
                    apart = random_.between(0, 20);
        rotation(VFIT_BONE_HIPS) = about_x(pelvis);
        for (const Side side : {kLeft, kRight})
            leg(side, random_.between(75, 95) + pelvis, apart + spread(random_, 0, 4), spread(random_, 0, 8),
                knee, 0);
    }

    /// On one knee or on both, upright or sitting on the heels.
    void kneeling() {
        const float lean = spread(random_, 5, 8);
        const bool both = random_.chance(0.5f);
        const Side ahead = random_.chance(0.5f) ? kLeft : kRight;
        const float heels = both && random_.chance(0.5f) ? random_.between(0, 55) : spread(random_, 0, 5);
        const float apart = random_.between(0, 15);
        rotation(VFIT_BONE_HIPS) = about_x(lean);
        for (const Side side : {kLeft, kRight}) {
            if (!both && side == ahead)
                leg(side, random_.between(60, 105) + lean, apart, spread(random_, 5, 8),
                    random_.between(75, 115), 0);
            else {
                leg(side, lean + heels, apart, spread(random_, 0, 8), 90 + heels + spread(random_, 0, 8), 0);
                rotation(kBones[side].foot) = about_x(random_.between(-10, 45));
            }
        }
    }

    void any_legs() {
        rotation(VFIT_BONE_HIPS) = about_z(spread(random_, 0, 8)) * about_x(spread(random_, 4, 12));
        for (const Side side : {kLeft, kRight}) {
            const float flex = random_.between(-20, 95);
            leg(side, flex, random_.between(-10, 35), random_.between(-20, 35),
                random_.between(0, flex > 30 ? 120.0f : 60.0f), random_.between(-5, 35));
        }
    }

    void trunk(float width) {
        const Quat third = about_y(spread(random_, 0, 9 * width) / 3) *
                           about_x((spread(random_, 2, 5 * width) + bend_) / 3) *
                           about_z(spread(random_, 0, 5 * width) / 3);
        for (const int bone : {VFIT_BONE_SPINE, VFIT_BONE_CHEST, VFIT_BONE_UPPER_CHEST})
            rotation(bone) = third;
    }

    void head() {
        const float wide = random_.chance(0.2f) ? 2.5f : 1.0f;
        const Quat half = about_y(spread(random_, 0, 10 * wide)) * about_x(spread(random_, 0, 7 * wide)) *
                          about_z(spread(random_, 0, 4 * wide));
        rotation(VFIT_BONE_NECK) = half;
        rotation(VFIT_BONE_HEAD) = half;
    }

    void usual_arms() {
        const Side busy = random_.chance(0.5f) ? kLeft : kRight;
        const Side other = busy == kLeft ? kRight : kLeft;
        switch (random_.pick({0.13f, 0.19f, 0.13f, 0.10f, 0.10f, 0.06f, 0.09f, 0.06f, 0.05f, 0.06f, 0.03f})) {
            case 0: hang(kLeft), hang(kRight); break;
            case 1: reach(busy), hang(other); break;
            case 2: clap(); break;
            case 3: cross(); break;
            case 4: fold(busy); break;
            case 5: sweep(busy), hang(other); break;
            case 6: jog(); break;
            case 7: hands_on_self(); break;
            case 8: at_work(); break;
            case 9: raise(kLeft), raise(kRight); break;
            default: any_arm(kLeft), any_arm(kRight); break;
        }
        for (const Side side : {kLeft, kRight})
            rotation(kBones[side].hand) = about_z(spread(random_, 0, 18)) * about_y(spread(random_, 0, 15));
    }

    /// Anatomical angles from the arm that hangs straight down, palm inwards.
    void arm(Side side, float abduct, float flex, float elbow, float turn_out) {
        const float s = sign_of(side);
        const Quat blade = about_z(s * std::max(0.0f, abduct - 60.0f) / 3.0f);  // Inman 1944
        const Quat whole = about_x(-flex) * about_z(-s * (90.0f - abduct)) * about_x(-turn_out);
        rotation(kBones[side].clavicle) = blade;
        rotation(kBones[side].upper_arm) = glm::conjugate(blade) * whole;
        rotation(kBones[side].forearm) = about_y(-s * elbow) * about_x(spread(random_, 0, 25));
    }

    void hang(Side side) {
        arm(side, std::max(3.0f, random_.normal(12, 6)), spread(random_, 2, 9),
            std::abs(spread(random_, 14, 10)), spread(random_, 0, 20));
    }

    void any_arm(Side side) {
        arm(side, random_.between(0, 165), random_.between(-35, 120), random_.between(0, 140),
            random_.between(-60, 80));
    }

    /// Up beside the head or above it: greeting, cheering, stretching.
    void raise(Side side) {
        if (random_.chance(0.2f))
            hang(side);
        else
            arm(side, random_.between(100, 178), random_.between(-25, 35), random_.between(0, 110),
                random_.between(-30, 90));
    }

    void jog() {
        const float swing = random_.between(10, 45), phase = random_.between(0, 2 * kPi);
        for (const Side side : {kLeft, kRight})
            arm(side, random_.between(8, 25), swing * std::sin(phase + (side == kLeft ? 0.0f : kPi)) + 5,
                random_.between(65, 120), random_.between(-45, 10));
    }

    /// Where the bones are, with the pose as far as it is made.
    PosedSkeleton placed() const { return forward_kinematics(skeleton_, pose_); }
    float arm_length() const {
        return glm::length(skeleton_.offset[VFIT_BONE_LEFT_LOWER_ARM]) +
               glm::length(skeleton_.offset[VFIT_BONE_LEFT_HAND]);
    }
    /// A point in the chest's own axes, metres from the middle between the shoulders, in the unit of an arm.
    Vec3 before_chest(const PosedSkeleton& at, float left, float up, float ahead) const {
        const Vec3 middle =
            0.5f * (at.position[VFIT_BONE_LEFT_UPPER_ARM] + at.position[VFIT_BONE_RIGHT_UPPER_ARM]);
        return middle + at.rotation[VFIT_BONE_UPPER_CHEST] * (arm_length() * Vec3(left, up, ahead));
    }

    /// Wrist to that point; the elbow lies below the line and a random turn about it.
    void place_wrist(Side side, const Vec3& target) {
        const float s = sign_of(side);
        const SideBones& b = kBones[side];
        const PosedSkeleton at = placed();
        const Vec3 shoulder = at.position[static_cast<size_t>(b.upper_arm)];
        const float upper = glm::length(skeleton_.offset[static_cast<size_t>(b.forearm)]);
        const float lower = glm::length(skeleton_.offset[static_cast<size_t>(b.hand)]);
        const Quat chest = at.rotation[VFIT_BONE_UPPER_CHEST];
        const Vec3 pole = chest * Vec3(s * random_.between(0.1f, 1.2f), -1.0f, random_.between(-0.9f, 0.2f));
        const TwoBoneSolution ik = solve_two_bone(shoulder, upper, lower, target, pole, 0.02f);
        const Vec3 along = glm::normalize(ik.middle - shoulder), on = glm::normalize(ik.end - ik.middle);
        Vec3 hinge = glm::cross(along, on);
        hinge = glm::dot(hinge, hinge) < 1e-6f ? chest * Vec3(0, -s, 0) : glm::normalize(hinge);
        const Quat parent = at.rotation[static_cast<size_t>(b.clavicle)];
        const Quat upper_world = frame_turn(s, along, hinge), lower_world = frame_turn(s, on, hinge);
        rotation(b.upper_arm) = glm::normalize(glm::conjugate(parent) * upper_world);
        rotation(b.forearm) =
            glm::normalize(glm::conjugate(upper_world) * lower_world * about_x(spread(random_, 0, 30)));
    }

    /// From the T-pose's arm (along +-X, elbow hinge +-Y) to that direction and hinge.
    static Quat frame_turn(float s, const Vec3& along, const Vec3& hinge) {
        const Vec3 y = glm::normalize(hinge - along * glm::dot(hinge, along));
        const Mat3 to(along, y, glm::cross(along, y));
        const Vec3 x0(s, 0, 0), y0(0, -s, 0);
        const Mat3 from(x0, y0, glm::cross(x0, y0));
        return glm::normalize(glm::quat_cast(to * glm::transpose(from)));
    }

    void reach(Side side) {
        const float s = sign_of(side);
        Vec3 d;
        do d = random_.direction();
        while (d.z < -0.25f || s * d.x < -0.8f);
        const float far = random_.between(0.45f, 1.0f), raised = std::max(0.0f, d.y);
        rotation(kBones[side].clavicle) =
            about_z(s * 20.0f * raised) * about_y(-s * 15.0f * std::max(0.0f, d.z) * far);
        const PosedSkeleton at = placed();
        const Vec3 shoulder = at.position[static_cast<size_t>(kBones[side].upper_arm)];
        Vec3 target = shoulder + at.rotation[VFIT_BONE_UPPER_CHEST] * (d * far * arm_length());
        place_wrist(side, keep_ahead(at, target));
    }

    /// Moves a target out of the trunk.
    Vec3 keep_ahead(const PosedSkeleton& at, Vec3 target) const {
        const Quat chest = at.rotation[VFIT_BONE_UPPER_CHEST];
        const Vec3 middle = before_chest(at, 0, 0, 0);
        Vec3 local = glm::conjugate(chest) * (target - middle);
        const float half = std::abs(middle.x - at.position[VFIT_BONE_LEFT_UPPER_ARM].x) + 0.03f;
        if (std::abs(local.x) < half && local.y < 0.1f) local.z = std::max(local.z, 0.17f);
        return middle + chest * local;
    }

    void clap() {
        const PosedSkeleton at = placed();
        const float left = random_.normal(0, 0.1f), up = random_.normal(-0.1f, 0.3f),
                    ahead = random_.between(0.4f, 0.95f);
        const float half = random_.chance(0.5f) ? random_.between(0.02f, 0.1f) : random_.between(0.1f, 0.8f);
        for (const Side side : {kLeft, kRight}) {
            const float s = sign_of(side);
            place_wrist(side, keep_ahead(at, before_chest(at, left + s * half, up + random_.normal(0, 0.04f),
                                                          ahead + random_.normal(0, 0.05f))));
        }
    }

    void cross() {
        const PosedSkeleton at = placed();
        const float over = random_.between(-0.35f, 0.55f), up = random_.normal(-0.25f, 0.15f),
                    ahead = random_.between(0.32f, 0.75f);
        for (const Side side : {kLeft, kRight}) {
            const float s = sign_of(side);
            place_wrist(side, keep_ahead(at, before_chest(at, -s * (over + random_.normal(0, 0.05f)),
                                                          up + random_.normal(0, 0.08f),
                                                          ahead + (side == kLeft ? 0.08f : 0.0f))));
        }
    }

    /// Arms folded: the forearms level before the trunk, each hand at or under the other arm.
    void fold(Side upper) {
        const PosedSkeleton at = placed();
        const float up = random_.between(-0.62f, -0.28f), ahead = random_.between(0.26f, 0.42f);
        for (const Side side : {kLeft, kRight}) {
            const float over = random_.between(0.12f, 0.48f), level = random_.normal(0, 0.05f);
            const float on_top = side == upper ? random_.between(0.04f, 0.16f) : 0.0f;
            place_wrist(side, keep_ahead(at, before_chest(at, -sign_of(side) * over,
                                                          up + level + 0.5f * on_top, ahead + on_top)));
        }
    }

    /// A hand that passes before the body from its own side to beyond the other.
    void sweep(Side side) {
        const PosedSkeleton at = placed();
        const float out = sign_of(side) * random_.between(-0.75f, 0.6f);
        place_wrist(side, keep_ahead(at, before_chest(at, out, random_.normal(-0.1f, 0.2f),
                                                      random_.between(0.35f, 0.95f))));
    }

    /// Hands held before the trunk, each for itself.
    void at_work() {
        const PosedSkeleton at = placed();
        for (const Side side : {kLeft, kRight}) {
            if (random_.chance(0.3f)) {
                hang(side);
                continue;
            }
            const float out = sign_of(side) * random_.between(-0.3f, 0.5f),
                        ahead = random_.between(0.35f, 0.85f);
            place_wrist(side, keep_ahead(at, before_chest(at, out, random_.between(-0.85f, 0.1f), ahead)));
        }
    }

    void hands_on_self() {
        const PosedSkeleton at = placed();
        const size_t where = random_.pick({0.4f, 0.3f, 0.3f});
        for (const Side side : {kLeft, kRight}) {
            const float s = sign_of(side);
            if (random_.chance(0.3f)) {
                hang(side);
            } else if (where == 0) {  // on the hip
                place_wrist(side, before_chest(at, s * 0.42f, random_.between(-0.85f, -0.65f),
                                               random_.between(0.0f, 0.2f)));
            } else if (where == 1) {  // at the head
                place_wrist(side, before_chest(at, s * random_.between(0.1f, 0.3f),
                                               random_.between(0.1f, 0.5f), random_.between(0.1f, 0.3f)));
            } else {  // overhead
                place_wrist(side, before_chest(at, s * random_.between(0.0f, 0.6f),
                                               random_.between(0.6f, 1.2f), random_.between(-0.1f, 0.4f)));
            }
        }
    }

    const Skeleton& skeleton_;
    Random& random_;
    Pose pose_;
    float bend_ = 0.0f;  // of the trunk, that goes with the legs' posture; degrees
};

}  // namespace

Pose random_posture(const Skeleton& skeleton, Random& random) { return Builder(skeleton, random).build(); }

}  // namespace vfit::training
