// Foot-skate correction on the character (paper, Algorithm 6): planted feet are held where they were
// recorded, hips and knees follow by inverse kinematics, and the root takes what the legs cannot reach: its
// height and the pelvis' roll, which nobody sees, follow the knees, which everybody does.
#pragma once

#include <array>

#include "body/range_of_motion.h"
#include "motion/foot_pin.h"
#include "motion/glide.h"
#include "motion/leg_return.h"
#include "motion/rest_pose.h"
#include "motion/root_height.h"

namespace vfit {

// Where a body's limbs foreshorten (a squat), the character's tracked foot strays from the person's by a good
// part of a shank; further than this something else is wrong and the foot follows.
inline constexpr float kCharacterLeashM = 0.4f;

class FootPlanter {
public:
    void reset() { *this = FootPlanter(); }

    /// Of one foot, as tracked.
    struct Seen {
        bool planted = false;
        bool known = false;    // its ankle is seen now
        float ankle_m = 0.0f;  // that height, of the character's ankle
        Vec3 drag{0.0f};       // how far the person slid it since the last call while it stood
    };

    /// Changes the legs and the root of `pose` and fills its contacts, root_correction and foot_correction_m.
    void apply(const Skeleton& skeleton, const RestPose& rest, const RangeOfMotion& rom, const Seen seen[2],
               float dt_s, Pose& pose);

    /// Where joint limits have since taken the legs off their places, the root gives way and the legs follow
    /// again.
    void hold(const Skeleton& skeleton, const RestPose& rest, const bool planted[2], Pose& pose) const;

private:
    struct Foot {
        FootPin pin{kCharacterLeashM};
        LegReturn back;
        Vec3 shown{0.0f};  // where the last apply() put the ankle
        // Of the tracked hip, over where the foot stands or over the tracked ankle; low-passed.
        Vec3 way{0.0f}, velocity{0.0f};
        float reserve = 0.0f;  // of the leg's length
    };

    static void keep_reserve(Foot& foot, const Leg& tracked, bool planted, float dt_s);
    Quat level_hips(Leg legs[2], const Vec3& root, float& lift_m) const;
    Vec3 pull_root(const Leg legs[2], const Seen seen[2], float lift_m, float dt_s);

    static void move_leg(Foot& foot, Leg& leg, const Leg& tracked, bool planted, bool released, float dt_s);

    std::array<Foot, 2> feet_;
    RootHeight height_;
    Glide pull_;  // of the root, beside its lift; fades when no leg needs it
};

}  // namespace vfit
