// Scripted motions on two planted feet: scan, side, sway, wave, reach, squat.
#include "keys.h"
#include "motion.h"

namespace vfit::virtual_person {

Script scan_script(float arms_deg) {
    return {[arms_deg](float) {
                Figure f = standing();
                for (const int side : {kLeft, kRight}) set_arm(f.rotation, side, {arms_deg, 0, 6, 0});
                return f;
            },
            10.0f};
}

// For a side view (facing=90): the arms hang before the trunk, so that its outline is free.
Script side_script(float arms_deg) {
    return {[arms_deg](float) {
                Figure f = standing();
                for (const int side : {kLeft, kRight}) set_arm(f.rotation, side, {6, arms_deg, 6, 0});
                return f;
            },
            10.0f};
}

// The weight goes from one leg to the other; the pelvis drops on the free side and the trunk rights itself.
Script sway_script() {
    return {[](float t) {
                Figure f = standing();
                const float shift = wave(0.25f, t);
                f.root.x = 0.05f * shift;
                f.pelvis = rotate_z(-3.0f * shift) * rotate_y(4.0f * shift);
                f.drop_m = 0.004f;
                set_trunk(f, 0, -4.0f * shift, -4.0f * shift);
                for (const int side : {kLeft, kRight})
                    set_arm(f.rotation, side,
                            {12 + 3 * side_sign(side) * shift, 3 + 4 * wave(0.25f, t - 0.3f), 14, 0});
                return f;
            },
            4.0f};
}

Script wave_script() {
    return {[](float t) {
                Figure f = standing();
                const float up = track({{0, 0}, {0.5f, 0}, {1.3f, 1}, {3.7f, 1}, {4.6f, 0}, {5, 0}}, t);
                const float swing =
                    track({{0, 0}, {1.2f, 0}, {1.6f, 1}, {3.4f, 1}, {3.8f, 0}}, t) * wave(1.5f, t);
                set_arm(f.rotation, kRight, {12 + 68 * up, 3 + 12 * up, 14 + 86 * up + 18 * swing, 80 * up});
                f.root.x = 0.012f * up;
                set_trunk(f, 0, 2.0f * up, 0);
                return f;
            },
            5.0f};
}

// To a shelf ahead with the right hand, then to one above with the left.
Script reach_script() {
    return {[](float t) {
                Figure f = standing();
                const float ahead = track({{0, 0}, {0.4f, 0}, {1.4f, 1}, {2, 1}, {3, 0}, {6, 0}}, t);
                const float above = track({{0, 0}, {3.2f, 0}, {4.2f, 1}, {4.8f, 1}, {5.8f, 0}, {6, 0}}, t);
                // On the way the elbow is bent, at the shelf the arm is all but straight.
                const float bent_ahead = 120 * ahead * (1 - ahead), bent_above = 100 * above * (1 - above);
                set_arm(f.rotation, kRight, {12 - 8 * ahead, 3 + 77 * ahead, 14 - 6 * ahead + bent_ahead, 0});
                set_arm(f.rotation, kLeft,
                        {12 + 10 * above, 3 + 150 * above, 14 - 6 * above + bent_above, 0});
                f.root.y = 0.03f * ahead;
                set_trunk(f, 14 * ahead - 4 * above, -4 * above, 14 * ahead - 8 * above);
                f.rotation[VFIT_BONE_NECK] = rotate_x(-5 * ahead - 12 * above);
                return f;
            },
            6.0f};
}

// Hips back and down, trunk forward over the feet, arms ahead for balance, heels on the floor.
Script squat_script() {
    return {[](float t) {
                Figure f = standing();
                const float down = track({{0, 0}, {0.4f, 0}, {1.8f, 1}, {2.2f, 1}, {3.6f, 0}, {4, 0}}, t);
                f.drop_m = 0.34f * down;
                f.root.y = -0.15f * down;
                f.pelvis = rotate_x(24 * down);
                set_trunk(f, 14 * down, 0, 0);
                f.rotation[VFIT_BONE_NECK] = rotate_x(-20 * down);
                for (const int side : {kLeft, kRight})
                    set_arm(f.rotation, side, {12 - 6 * down, 3 + 112 * down, 14 - 6 * down, 0});
                return f;
            },
            4.0f};
}

}  // namespace vfit::virtual_person
