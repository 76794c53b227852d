// Levels of the trunk: crotch, hip, waist, chest, armpit.
#include <algorithm>
#include <cmath>
#include <limits>

#include "anthropometry/tape_landmarks.h"
#include "core/error.h"

namespace vfit {

namespace {

/// Height of the waist's level as a share of the way from the hip joint to the foot of the neck, from the
/// mean heights of ANSUR II: trochanterion, cervicale, and the mean of tenth rib and iliac crest. Women
/// (0.630 - 0.519) / (0.857 - 0.519), men (0.621 - 0.513) / (0.864 - 0.513) of stature.
constexpr float kWaistShareWomen = 0.328f, kWaistShareMen = 0.308f;

/// The same of the navel, which lies at 0.602 of stature in women and in men (waistheightomphalion; from
/// person to person 0.035 of the way, 1 cm and a half).
constexpr float kNavelShareWomen = 0.245f, kNavelShareMen = 0.252f;

/// The rib arch as a share of the way from the waist to the foot of the neck; the bust and a man's chest lie
/// above it, by the same tables at 0.47 (0.735 of stature).
constexpr float kRibArchShare = 0.2f;

/// A breast's vertices lie a centimetre apart and a millimetre behind one another: what is so far behind the
/// foremost one counts a third.
constexpr float kBustDepth_m = 0.002f;

float hip_joints_height(const TapeMesh& body) {
    return 0.5f * (body.joint(VFIT_JOINT_LEFT_HIP).y + body.joint(VFIT_JOINT_RIGHT_HIP).y);
}

float at_share(const TapeMesh& body, float share) {
    return glm::mix(hip_joints_height(body), body.joint(VFIT_JOINT_NECK).y, share);
}

float rib_arch_height(const TapeMesh& body) { return at_share(body, rib_arch_share(body.body().sex)); }

float by_sex(vfit_sex sex, float woman, float man) {
    return sex == VFIT_SEX_FEMALE ? woman : sex == VFIT_SEX_MALE ? man : 0.5f * (woman + man);
}

float trunk_girth(const TapeMesh& body, float y) { return hull_perimeter(body.trunk(y).points()); }

bool legs_apart(const TapeMesh& body, float y) {
    const Section section = body.trunk(y);
    const auto* left = loop_about(section, body.thigh(Side::kLeft).at_height(y));
    const auto* right = loop_about(section, body.thigh(Side::kRight).at_height(y));
    return left && right && left != right;
}

bool arm_apart(const TapeMesh& body, Side side, float y) {
    const Section section = body.level(y);
    const auto* arm = loop_about(section, body.upper_arm(side).at_height(y));
    return arm && arm != loop_about(section, body.spine().at_height(y));
}

float armpit_height(const TapeMesh& body, Side side) {
    const Axis arm = body.upper_arm(side);
    // Just above the elbow's joint, whose own level may cut the forearm of a bent arm.
    const float low = arm.at(0.9f).y, high = arm.start.y;
    if (!(low < high) || !arm_apart(body, side, low) || arm_apart(body, side, high))
        fail(VFIT_ERROR_DATA, "the body's arms do not hang clear of its trunk");
    return border(low, high, [&](float y) { return arm_apart(body, side, y); });
}

/// The frontmost z at which an outline in the plane x = constant passes that height; -infinity where none
/// does.
float front_at(const Section& profile, float y) {
    float front = -std::numeric_limits<float>::infinity();
    for (const auto& loop : profile.loops)
        for (size_t i = 0; i < loop.size(); ++i) {
            const Vec3 a = profile.lift(loop[i]), b = profile.lift(loop[(i + 1) % loop.size()]);
            if ((a.y > y) != (b.y > y)) front = std::max(front, glm::mix(a.z, b.z, (y - a.y) / (b.y - a.y)));
        }
    return front;
}

}  // namespace

float crotch_height(const TapeMesh& body) {
    const float high = hip_joints_height(body);
    const float knees = 0.5f * (body.joint(VFIT_JOINT_LEFT_KNEE).y + body.joint(VFIT_JOINT_RIGHT_KNEE).y);
    const float low = 0.5f * (high + knees);
    if (!(low < high) || !legs_apart(body, low) || legs_apart(body, high))
        fail(VFIT_ERROR_DATA, "the body's legs do not part between its hips and the middle of its thighs");
    return border(low, high, [&](float y) { return legs_apart(body, y); });
}

float armpit_height(const TapeMesh& body) {
    return std::min(armpit_height(body, Side::kLeft), armpit_height(body, Side::kRight));
}

float waist_share(vfit_sex sex) { return by_sex(sex, kWaistShareWomen, kWaistShareMen); }

float navel_share(vfit_sex sex) { return by_sex(sex, kNavelShareWomen, kNavelShareMen); }

float rib_arch_share(vfit_sex sex) { return std::lerp(waist_share(sex), 1.0f, kRibArchShare); }

float waist_height(const TapeMesh& body) { return at_share(body, waist_share(body.body().sex)); }

float navel_height(const TapeMesh& body) { return at_share(body, navel_share(body.body().sex)); }

float minimum_waist_height(const TapeMesh& body) {
    return place_of_largest(navel_height(body), rib_arch_height(body),
                            [&](float y) { return -trunk_girth(body, y); });
}

/// The middle of what stands out most: where a breast does, it moves evenly with the body and does not leap
/// from one vertex to the next one, a centimetre away.
Vec3 bust_point(const TapeMesh& body, Side side, float armpit) {
    // From the rib arch up: a round upper belly below it stands out more than a small breast.
    const float arch = rib_arch_height(body), middle = body.joint(VFIT_JOINT_NECK).x;
    const auto front_of_trunk = [&](float y) { return -extent(body.trunk(y).points()).minimum.y; };
    const float foot = front_of_trunk(arch), slope = (front_of_trunk(armpit) - foot) / (armpit - arch);
    const TapeBody& b = body.body();
    const auto prominence = [&](const Vec3& p) { return p.z - (foot + slope * (p.y - arch)); };
    std::vector<Vec3> chest;
    float most = -std::numeric_limits<float>::infinity();
    for (size_t i = 0; i < b.positions.size(); ++i) {
        const Vec3& p = b.positions[i];
        if (b.parts[i] != BodyPart::kTorso || p.y <= arch || p.y >= armpit ||
            (p.x > middle) != (side == Side::kLeft))
            continue;
        chest.push_back(p);
        most = std::max(most, prominence(p));
    }
    if (chest.empty()) fail(VFIT_ERROR_DATA, "the body has no chest between its rib arch and its armpits");
    Vec3 sum(0.0f);
    float weights = 0.0f;
    for (const Vec3& p : chest) {
        const float weight = std::exp((prominence(p) - most) / kBustDepth_m);
        sum += weight * p, weights += weight;
    }
    return sum / weights;
}

float chest_height(const TapeMesh& body, float armpit) {
    if (body.body().sex == VFIT_SEX_FEMALE)
        return 0.5f * (bust_point(body, Side::kLeft, armpit).y + bust_point(body, Side::kRight, armpit).y);
    return place_of_largest(rib_arch_height(body), armpit - kTapeHalfWidth_m,
                            [&](float y) { return trunk_girth(body, y); });
}

float underbust_height(const TapeMesh& body, float armpit, float waist) {
    float height = 0.0f;
    for (const Side side : {Side::kLeft, Side::kRight}) {
        const Vec3 bust = bust_point(body, side, armpit);
        const Section profile = body.profile(bust.x);
        const float slope = (bust.z - front_at(profile, waist)) / (bust.y - waist);
        height += 0.5f * place_of_largest(waist, bust.y, [&](float y) {
                      return bust.z + slope * (y - bust.y) - front_at(profile, y);
                  });
    }
    return height;
}

float hip_height(const TapeMesh& body, float crotch, float waist) {
    const float high = 0.5f * (hip_joints_height(body) + waist);
    return place_of_largest(crotch, high, [&](float y) { return trunk_girth(body, y); });
}

}  // namespace vfit
