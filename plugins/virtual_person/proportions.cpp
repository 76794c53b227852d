#include "proportions.h"

namespace vfit::virtual_person {

Proportions average_proportions() {
    constexpr float stature_m = 1.75f;
    Proportions p;
    for (const int side : {kLeft, kRight}) {
        const float s = side_sign(side);
        Leg& leg = p.leg[static_cast<size_t>(side)];
        leg.hip = Vec3(s * 0.0955f * stature_m * 0.5f, -0.02f, 0);
        leg.thigh = Vec3(0, -0.245f * stature_m, 0);
        leg.shank = Vec3(0, -0.246f * stature_m, 0);
        leg.foot = Vec3(0, -0.03f * stature_m, 0.075f * stature_m);
        p.upper_arm[static_cast<size_t>(side)] = Vec3(s * 0.186f * stature_m, 0, 0);
        p.forearm[static_cast<size_t>(side)] = Vec3(s * 0.146f * stature_m, 0, 0);
    }
    p.ankle_height_m = 0.039f * stature_m;
    return p;
}

}  // namespace vfit::virtual_person
