// Landmarks of head, neck and limbs.
#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "measure/tape_landmarks.h"

namespace vfit {

namespace {

/// Elevation of the outline's normal at the acromion.
constexpr float kAcromionNormal_rad = kPi / 4.0f;

/// Upper share of the head that holds no ear. The ear's middle (tragion) lies 0.56 of head height below the crown,
/// the ear is 0.27 of head height long (Farkas 1994): its top is at 0.42.
constexpr float kSkullShare = 0.4f;

/// The vertex of these parts that lies farthest along the direction; null where there is none.
const Vec3* farthest(const TapeMesh& body, std::initializer_list<BodyPart> parts, const Vec3& direction, float above) {
    const TapeBody& b = body.body();
    const Vec3* best = nullptr;
    for (size_t i = 0; i < b.positions.size(); ++i) {
        const Vec3& p = b.positions[i];
        if (p.y < above || std::find(parts.begin(), parts.end(), b.parts[i]) == parts.end()) continue;
        if (!best || glm::dot(p, direction) > glm::dot(*best, direction)) best = &p;
    }
    return best;
}

float girth_about(const TapeMesh& body, const Axis& axis, float along_m, const Axis* apart) {
    const Vec3 direction = axis.direction(), place = axis.start + along_m * direction;
    const Section section = body.across(place, direction);
    const auto* loop = loop_about(section, place);
    if (!loop) return 0.0f;
    if (apart) {
        const Vec3 other = apart->end - apart->start;
        const float share = glm::dot(place - apart->start, direction) / glm::dot(other, direction);
        if (std::isfinite(share) && loop == loop_about(section, apart->at(share))) return 0.0f;
    }
    return hull_perimeter(*loop);
}

}  // namespace

float limb_girth(const TapeMesh& body, const Axis& limb, float along_m, const Axis& apart) {
    return girth_about(body, limb, along_m, &apart);
}

float largest_limb_girth(const TapeMesh& body, const Axis& limb, float share, const Axis& apart) {
    const auto girth = [&](float along_m) { return limb_girth(body, limb, along_m, apart); };
    const float largest = girth(place_of_largest(0.0f, share * glm::distance(limb.start, limb.end), girth));
    if (!(largest > 0.0f)) fail(VFIT_ERROR_DATA, "a limb of the body is nowhere apart from the rest");
    return largest;
}

Axis neck_axis(const TapeMesh& body) { return {body.joint(VFIT_JOINT_NECK), body.joint(VFIT_JOINT_HEAD)}; }

float neck_place(const TapeMesh& body) {
    const Axis neck = neck_axis(body);
    const auto tightness = [&](float along_m) {
        const float girth = girth_about(body, neck, along_m, nullptr);
        return girth > 0.0f ? -girth : -body.height();  // longer than any neck
    };
    return place_of_largest(0.0f, glm::distance(neck.start, neck.end), tightness);
}

Vec3 acromion(const TapeMesh& body, Side side) {
    const float sign = side == Side::kLeft ? 1.0f : -1.0f;
    const BodyPart arm = side == Side::kLeft ? BodyPart::kLeftUpperArm : BodyPart::kRightUpperArm;
    const Vec3 outwards(sign * std::cos(kAcromionNormal_rad), std::sin(kAcromionNormal_rad), 0.0f);
    // On the slope from the neck, points high above the shoulder would win: look beside the joint only.
    const TapeBody& b = body.body();
    const float joint = body.upper_arm(side).start.x;
    const Vec3* best = nullptr;
    for (size_t i = 0; i < b.positions.size(); ++i) {
        const Vec3& p = b.positions[i];
        if ((b.parts[i] != arm && b.parts[i] != BodyPart::kTorso) || sign * (p.x - joint) < 0.0f) continue;
        if (!best || glm::dot(p, outwards) > glm::dot(*best, outwards)) best = &p;
    }
    if (!best) fail(VFIT_ERROR_DATA, "the body has no skin outside its shoulder joint");
    return *best;
}

float chin_height(const TapeMesh& body) {
    const Axis neck = neck_axis(body);
    const Vec3 place = neck.start + neck_place(body) * neck.direction();
    const Section section = body.across(place, neck.direction());
    const auto* loop = loop_about(section, place);
    const Vec3* nose = farthest(body, {BodyPart::kHead}, Vec3(0, 0, 1), place.y);
    if (!loop || !nose) fail(VFIT_ERROR_DATA, "the body has no head on its neck");
    Vec3 throat = section.lift(loop->front());
    for (const Vec2& p : *loop)
        if (section.lift(p).z > throat.z) throat = section.lift(p);
    const float front = 0.5f * (throat.z + nose->z);
    float chin = nose->y;
    for (const Vec3& p : body.body().positions)
        if (p.z > front && p.y > throat.y) chin = std::min(chin, p.y);
    return chin;
}

float skull_breadth(const TapeMesh& body, float chin) {
    const float high = body.crown(), low = glm::mix(high, chin, kSkullShare);
    const auto breadth = [&](float y) { return extent(body.trunk(y).points()).breadth(); };
    return breadth(place_of_largest(low, high, breadth));
}

Vec3 fingertip(const TapeMesh& body, Side side) {
    const bool left = side == Side::kLeft;
    const Vec3 wrist = body.joint(left ? VFIT_JOINT_LEFT_WRIST : VFIT_JOINT_RIGHT_WRIST);
    const BodyPart hand = left ? BodyPart::kLeftHand : BodyPart::kRightHand;
    const TapeBody& b = body.body();
    const Vec3* best = nullptr;
    for (size_t i = 0; i < b.positions.size(); ++i)
        if (b.parts[i] == hand &&
            (!best || glm::distance(b.positions[i], wrist) > glm::distance(*best, wrist)))
            best = &b.positions[i];
    if (!best) fail(VFIT_ERROR_DATA, "the body has no hand");
    return *best;
}

}  // namespace vfit
