// Scripted motions of both arms before the trunk, where they hide and are hidden: cross, clap, forward.
#include <algorithm>

#include "keys.h"
#include "motion.h"

namespace vfit::virtual_person {

namespace {

// Angles that bring the wrists of an arm of usual proportions where the comments say.
constexpr ArmAngles kFolded[2] = {{1, 44, 79, -82},   // left: before the other, wrist at the right ribs
                                  {5, 33, 86, -90}};  // right: below it, wrist at the left ribs
constexpr ArmAngles kPalmsApart{7, 33, 78, 18}, kPalmsTogether{1, 38, 75, -39};  // wrists 0.37 m ahead
constexpr ArmAngles kAhead{6, 86, 4, 0};  // at the height of the shoulders, elbows all but straight

}  // namespace

// The arms come up and fold before the chest, stay for two seconds and open again.
Script cross_script() {
    return {[](float t) {
                Figure f = standing();
                const float folded = track({{0, 0}, {0.3f, 0}, {1.4f, 1}, {3.6f, 1}, {4.6f, 0}, {5, 0}}, t);
                for (const int side : {kLeft, kRight}) {
                    const float lead = side == kLeft ? 0.0f : 0.06f;  // one arm lays itself over the other
                    const float s = std::max(0.0f, folded - lead * folded * (1.0f - folded) * 4.0f);
                    set_arm(f.rotation, side, mix(kHanging, kFolded[side], s));
                }
                f.pelvis = rotate_y(3.0f * folded * wave(0.4f, t));
                set_trunk(f, -2.0f * folded, 0, 4.0f * folded * wave(0.4f, t - 0.2f));
                return f;
            },
            5.0f};
}

// Four claps before the chest.
Script clap_script() {
    return {[](float t) {
                Figure f = standing();
                const float up = track({{0, 0}, {0.3f, 0}, {1.1f, 1}, {3.9f, 1}, {4.7f, 0}, {5, 0}}, t);
                const float clapping = track({{0, 0}, {1.0f, 0}, {1.3f, 1}, {3.6f, 1}, {3.9f, 0}}, t);
                const float closed = clapping * (0.5f - 0.5f * std::cos(2.0f * kPi * 1.6f * (t - 1.1f)));
                const ArmAngles ready = mix(kPalmsApart, kPalmsTogether, closed);
                for (const int side : {kLeft, kRight}) set_arm(f.rotation, side, mix(kHanging, ready, up));
                f.root.y = 0.01f * up;
                return f;
            },
            5.0f};
}

// Both arms reach straight ahead: hands and elbows lie before the shoulders on nearly one line of sight.
Script forward_script() {
    return {[](float t) {
                Figure f = standing();
                const float out = track({{0, 0}, {0.3f, 0}, {1.3f, 1}, {2.6f, 1}, {3.6f, 0}, {4, 0}}, t);
                const float bent = 90.0f * out * (1.0f - out);  // on the way the elbows bend
                for (const int side : {kLeft, kRight}) {
                    ArmAngles arm = mix(kHanging, kAhead, out);
                    arm.elbow += bent;
                    set_arm(f.rotation, side, arm);
                }
                f.root.y = -0.02f * out;  // against the weight of the arms
                set_trunk(f, 3.0f * out, 0, 0);
                return f;
            },
            4.0f};
}

}  // namespace vfit::virtual_person
