// Reads every measure off a body's landmarks and sections.
#include "anthropometry/tape.h"

#include <algorithm>
#include <cmath>

#include "anthropometry/measure_keys.h"
#include "anthropometry/tape_landmarks.h"
#include "core/error.h"

namespace vfit {

namespace {

constexpr Side kSides[] = {Side::kLeft, Side::kRight};

/// Mean of the two sides.
template <typename Function>
float both(const Function& value) {
    return 0.5f * (value(Side::kLeft) + value(Side::kRight));
}

struct Joints {
    int shoulder, elbow, wrist, hip;
};
Joints joints_of(Side side) {
    if (side == Side::kLeft)
        return {VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_WRIST, VFIT_JOINT_LEFT_HIP};
    return {VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_RIGHT_ELBOW, VFIT_JOINT_RIGHT_WRIST, VFIT_JOINT_RIGHT_HIP};
}

/// Collects in the order of measure_keys().
class Sheet {
public:
    void set(const char* key, float value) { list_.push_back({key, value, 0.0f, true}); }
    std::vector<Measurement> sorted() && {
        std::sort(list_.begin(), list_.end(), [](const Measurement& a, const Measurement& b) {
            return measure_index(a.key) < measure_index(b.key);
        });
        return std::move(list_);
    }

private:
    std::vector<Measurement> list_;
};

void measure_trunk(const TapeMesh& body, Sheet& sheet) {
    const float crotch = crotch_height(body), armpit = armpit_height(body), waist = waist_height(body);
    const auto girth = [&](const char* girth_key, const char* breadth_key, const char* depth_key, float y) {
        const std::vector<Vec2> outline = body.trunk(y).points();
        const Extent size = extent(outline);
        sheet.set(girth_key, hull_perimeter(outline));
        sheet.set(breadth_key, size.breadth());
        sheet.set(depth_key, size.depth());
    };
    girth("chest_girth_m", "chest_breadth_m", "chest_depth_m", chest_height(body, armpit));
    girth("waist_girth_m", "waist_breadth_m", "waist_depth_m", waist);
    girth("hip_girth_m", "hip_breadth_m", "hip_depth_m", hip_height(body, crotch, waist));
    const auto trunk_girth = [&](float y) { return hull_perimeter(body.trunk(y).points()); };
    sheet.set("waist_navel_girth_m", trunk_girth(navel_height(body)));
    sheet.set("waist_minimum_girth_m", trunk_girth(minimum_waist_height(body)));
    if (body.body().sex == VFIT_SEX_FEMALE) {
        const float underbust = underbust_height(body, armpit, waist);
        sheet.set("underbust_girth_m", trunk_girth(underbust));
    }
    sheet.set("inside_leg_m", crotch - body.floor());
    sheet.set("hip_height_m", both([&](Side s) { return body.joint(joints_of(s).hip).y; }) - body.floor());
    sheet.set("torso_height_m", glm::distance(body.joint(VFIT_JOINT_NECK), body.joint(VFIT_JOINT_PELVIS)));
}

void measure_limbs(const TapeMesh& body, Sheet& sheet) {
    // Below these shares knee and elbow begin.
    constexpr float kThighShare = 0.6f, kUpperArmShare = 0.7f;
    const Axis spine = body.spine();
    sheet.set("thigh_girth_m", both([&](Side s) {
                  return largest_limb_girth(body, body.thigh(s), kThighShare,
                                            body.thigh(s == Side::kLeft ? Side::kRight : Side::kLeft));
              }));
    sheet.set("upper_arm_girth_m", both([&](Side s) {
                  return largest_limb_girth(body, body.upper_arm(s), kUpperArmShare, spine);
              }));
    const auto between = [&](int a, int b) { return glm::distance(body.joint(a), body.joint(b)); };
    sheet.set("arm_length_m", both([&](Side s) {
                  const Joints j = joints_of(s);
                  return glm::distance(acromion(body.body(), s), body.joint(j.elbow)) +
                         between(j.elbow, j.wrist);
              }));
    const auto hand = [&](Side s) {
        return glm::distance(body.joint(joints_of(s).wrist), fingertip(body, s));
    };
    sheet.set("hand_length_m", both(hand));
    sheet.set("elbow_fingertip_m",
              both([&](Side s) { return between(joints_of(s).elbow, joints_of(s).wrist) + hand(s); }));
}

void measure_head(const TapeMesh& body, Sheet& sheet) {
    const TapeLimb neck = neck_of(body);
    const float narrowest_m = narrowest_neck(neck), chin = chin_height(body, neck, narrowest_m);
    sheet.set("neck_girth_m", length(neck_loop(neck, larynx_place(body, neck, narrowest_m, chin))));
    sheet.set("head_height_m", body.crown() - chin);
    sheet.set("head_width_m", skull_breadth(body, chin));
}

/// Largest horizontal breadth over the deltoids: the outermost points of the two upper arms' upper halves
/// (the deltoid ends at the middle of the humerus).
float bideltoid_breadth(const TapeBody& b) {
    float breadth = 0.0f;
    for (const Side side : kSides) {
        const Axis arm = upper_arm(b, side);
        const BodyPart part = side == Side::kLeft ? BodyPart::kLeftUpperArm : BodyPart::kRightUpperArm;
        const float lowest = arm.at(0.5f).y, sign = side == Side::kLeft ? 1.0f : -1.0f;
        float outermost = sign * arm.start.x;
        for (size_t i = 0; i < b.positions.size(); ++i)
            if (b.parts[i] == part && b.positions[i].y >= lowest)
                outermost = std::max(outermost, sign * b.positions[i].x);
        breadth += outermost;
    }
    return breadth;
}

}  // namespace

std::vector<Measurement> tape_measures(const TapePostures& postures) {
    const TapeMesh body(postures.arms_out);
    const TapeBody& arms_down = postures.arms_down;
    check(arms_down);
    check(postures.feet_together);
    const HeightRange standing = height_range(postures.feet_together.positions);
    Sheet sheet;
    sheet.set("stature_m", standing.crown - standing.floor);
    sheet.set("shoulder_breadth_m", bideltoid_breadth(arms_down));
    sheet.set("biacromial_breadth_m",
              glm::distance(acromion(arms_down, Side::kLeft), acromion(arms_down, Side::kRight)));
    measure_trunk(body, sheet);
    measure_limbs(body, sheet);
    measure_head(body, sheet);
    return std::move(sheet).sorted();
}

}  // namespace vfit
