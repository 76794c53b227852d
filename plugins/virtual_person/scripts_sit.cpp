// The scripted motion sit: down on a stool behind the heels (furniture=stool), hands on the lap, and up
// again.
#include "furniture.h"
#include "keys.h"
#include "motion.h"

namespace vfit::virtual_person {

namespace {

constexpr float kHipsBack_m =
    0.40f;  // of the ankles: about a thigh's length, so that the shanks stand upright
constexpr ArmAngles kOnLap{2, 20, 40, -22};

}  // namespace

Script sit_script() {
    return {[](float t) {
                Figure f = standing();
                const float down = track({{0, 0}, {0.4f, 0}, {1.9f, 1}, {4.1f, 1}, {5.5f, 0}, {6, 0}}, t);
                f.seat_m = kStoolHeight_m, f.seated = down;
                f.root.y = -kHipsBack_m * down;
                // The trunk leans over the feet while the hips go back, and comes up again on the seat.
                const float leaning = 4.0f * down * (1.0f - down);
                f.pelvis = rotate_x(20.0f * leaning - 4.0f * down);
                set_trunk(f, 20.0f * leaning + 6.0f * down, 0, 0);
                f.rotation[VFIT_BONE_NECK] = rotate_x(-18.0f * leaning);
                for (const int side : {kLeft, kRight}) {
                    ArmAngles arm = mix(kHanging, kOnLap, down);
                    arm.flex += 25.0f * leaning;
                    set_arm(f.rotation, side, arm);
                }
                return f;
            },
            6.0f};
}

}  // namespace vfit::virtual_person
