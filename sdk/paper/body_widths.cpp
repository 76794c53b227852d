// Shoulder and hip width, and the forearm with the hand: joints plus the way from them to the contour.
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>

#include "paper/body_lines.h"
#include "paper/silhouette.h"

namespace vfit {

namespace {

// Directions out of the frontal plane by more than this are too foreshortened to measure along (cos 40 =
// 0.77).
constexpr float kForeshortened_rad = 40.0f * kPi / 180.0f;
// Only the fingers are seen in that plane, the rest of the forearm comes from the joints: more is allowed.
constexpr float kBentForearm_rad = 50.0f * kPi / 180.0f;
// The posture of the bideltoid breadth: upper arms 5 degrees from the vertical.
constexpr float kHangingArm_rad = 5.0f * kPi / 180.0f;

/// The largest of a row of extents, each taken as the mean of itself and its neighbours: the largest of many
/// single contour pixels would be the noisiest one. Negative entries are unseen; none seen: -1.
template <size_t N>
float largest(const std::array<float, N>& extents, size_t count) {
    float best = -1.0f;
    for (size_t i = 0; i < count; ++i) {
        float sum = 0.0f;
        int seen = 0;
        for (size_t k = i > 0 ? i - 1 : 0; k <= i + 1 && k < count; ++k) {
            if (extents[k] < 0.0f) continue;
            sum += extents[k];
            ++seen;
        }
        if (extents[i] >= 0.0f) best = std::max(best, sum / float(seen));
    }
    return best;
}

bool has_all(const Body& body, std::initializer_list<int> joints) {
    return std::all_of(joints.begin(), joints.end(),
                       [&](int j) { return body.has(j) && body.at(j).z > 0.0f; });
}

/// In the frontal plane: its level and its upright part.
Vec2 frontal(const FrontalPlane& plane, const Vec3& v) {
    return {glm::dot(v, plane.right()), glm::dot(v, plane.up())};
}

/// How far the deltoid stands out beyond the shoulder joint once the arm hangs; negative: not seen.
///
/// The outside of the upper arm is measured square to the arm as it is held, then turned to where it hangs:
/// the breadth so obtained changes little with the angle of the arm.
float deltoid_overhang(const FilteredDepth& depth, const Camera& camera, const Vec3& shoulder,
                       const Vec3& elbow, const Vec3& other_shoulder) {
    const FrontalPlane plane(camera, shoulder);
    const Vec2 arm = frontal(plane, elbow - shoulder);
    const float length = glm::length(elbow - shoulder);
    if (length < 1e-3f || glm::length(arm) < length * std::cos(kForeshortened_rad)) return -1.0f;

    const Vec2 along = glm::normalize(arm);
    // Of the two sides of the arm the one away from the trunk: outside where it hangs, on top where it is
    // out.
    const float side = frontal(plane, shoulder - other_shoulder).x > 0.0f ? 1.0f : -1.0f;
    const Vec2 square(-along.y * side, along.x * side);
    const Vec3 outward = plane.right() * square.x + plane.up() * square.y;

    // The deltoid ends at about half of the upper arm; its bulk lies in the first third.
    constexpr float kDeltoid_arm = 0.35f;
    constexpr size_t kSteps = 10;
    std::array<float, kSteps> overhang;
    overhang.fill(-1.0f);
    for (size_t i = 0; i < kSteps; ++i) {
        const float share = kDeltoid_arm * float(i) / float(kSteps - 1);
        const Vec3 from = shoulder + (elbow - shoulder) * share;
        const auto reach = plane.reach(depth, from, outward);
        if (!reach.seen()) continue;
        const FrontalPlane here(camera, from);
        const float extent = glm::dot(here.point(reach.edge) - from, outward);
        overhang[i] = extent * std::cos(kHangingArm_rad) + share * length * std::sin(kHangingArm_rad);
    }
    return largest(overhang, kSteps);
}

/// From the palm to the furthest contour within the wrist's reach to either side of the forearm's direction;
/// 0 where that is no hand's length.
float fingertip_distance(const FilteredDepth& depth, const FrontalPlane& plane, const Vec3& palm,
                         const Vec3& forearm) {
    constexpr float kWrist_rad = 30.0f * kPi / 180.0f;  // relaxed hands hang at up to that angle
    constexpr int kDirections = 9;
    const Vec2 along = glm::normalize(frontal(plane, forearm));
    float furthest = 0.0f;
    for (int i = 0; i < kDirections; ++i) {
        const float angle = kWrist_rad * (2.0f * float(i) / float(kDirections - 1) - 1.0f);
        const float c = std::cos(angle), s = std::sin(angle);
        const Vec3 direction =
            plane.right() * (c * along.x - s * along.y) + plane.up() * (s * along.x + c * along.y);
        const auto reach = plane.reach(depth, palm, direction);
        if (!reach.seen()) return 0.0f;
        furthest = std::max(furthest, glm::length(frontal(plane, reach.point - palm)));
    }
    // Palm to fingertip is two thirds to three quarters of a hand (194 mm men, 181 mm women, ANSUR II): a
    // longer way to the contour runs on over the thigh, a shorter one is a fist or a tracker's error.
    constexpr float kShortest_m = 0.06f, kLongest_m = 0.18f;
    return furthest >= kShortest_m && furthest <= kLongest_m ? furthest : 0.0f;
}

}  // namespace

Estimate shoulder_width(const FilteredDepth& depth, const Camera& camera, const Body& body) {
    if (!has_all(body, {VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_RIGHT_SHOULDER})) return {};
    const Vec3& left = body.at(VFIT_JOINT_LEFT_SHOULDER);
    const Vec3& right = body.at(VFIT_JOINT_RIGHT_SHOULDER);
    const float between = glm::length(left - right);
    if (!(std::abs(right.z - left.z) < between * std::sin(kForeshortened_rad))) return {};

    float sides[2] = {-1.0f, -1.0f};
    if (has_all(body, {VFIT_JOINT_LEFT_ELBOW}))
        sides[0] = deltoid_overhang(depth, camera, left, body.at(VFIT_JOINT_LEFT_ELBOW), right);
    if (has_all(body, {VFIT_JOINT_RIGHT_ELBOW}))
        sides[1] = deltoid_overhang(depth, camera, right, body.at(VFIT_JOINT_RIGHT_ELBOW), left);
    if (sides[0] < 0.0f && sides[1] < 0.0f) return {};

    // The measure itself is defined to about 10 mm; an unseen side is taken from the other one.
    constexpr float kBothSigma_m = 0.012f, kOneSigma_m = 0.025f;
    if (sides[0] < 0.0f) return {between + 2.0f * sides[1], kOneSigma_m, true};
    if (sides[1] < 0.0f) return {between + 2.0f * sides[0], kOneSigma_m, true};
    return {between + sides[0] + sides[1], kBothSigma_m, true};
}

Estimate hip_width(const FilteredDepth& depth, const Camera& camera, const Body& body) {
    if (!has_all(body, {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP})) return {};
    const Vec3 hips[2] = {body.at(VFIT_JOINT_LEFT_HIP), body.at(VFIT_JOINT_RIGHT_HIP)};
    const Vec3 centre = 0.5f * (hips[0] + hips[1]);
    const FrontalPlane plane(camera, centre);
    const float pixel_m = centre.z / camera.fx;

    // From the hip joint (0.530 of stature, Drillis and Contini) down to the crotch (0.481, ANSUR II),
    // of 1.69 m.
    constexpr float kRows_m = 0.08f;
    constexpr float kHalfForearm_m = 0.05f;
    constexpr size_t kMostRows = 32;
    const float step_m = std::max(pixel_m, kRows_m / float(kMostRows - 1));
    float sides[2] = {-1.0f, -1.0f};
    bool hidden = false;
    for (int s = 0; s < 2; ++s) {
        std::array<float, kMostRows> extents;
        size_t rows = 0;
        const int elbow = s == 0 ? VFIT_JOINT_LEFT_ELBOW : VFIT_JOINT_RIGHT_ELBOW;
        const int hand = s == 0 ? VFIT_JOINT_LEFT_HAND : VFIT_JOINT_RIGHT_HAND;
        const float side = glm::dot(hips[s] - hips[1 - s], plane.right()) > 0.0f ? 1.0f : -1.0f;
        for (float below = 0.0f; below <= kRows_m && rows < kMostRows; below += step_m) {
            extents[rows++] = -1.0f;
            const auto reach = plane.reach(depth, hips[s] - plane.up() * below, plane.right() * side);
            if (!reach.seen()) continue;
            const float extent = glm::dot(reach.point - hips[s], plane.right()) * side;
            // Where the hand hangs on the contour, the contour is the hand's.
            bool is_arm = false;
            if (has_all(body, {elbow, hand})) {
                const Vec3 e = body.at(elbow), h = body.at(hand);
                const Vec3 tip = h + (h - e) * 0.5f;  // the fingers reach half a forearm beyond the palm
                const float height = plane.height(reach.point);
                const float top = plane.height(e), bottom = plane.height(tip);
                const float share = std::abs(top - bottom) > 1e-3f ? (top - height) / (top - bottom) : 0.5f;
                if (share > 0.0f && share < 1.0f) {
                    const float arm = glm::dot(e + (tip - e) * share - hips[s], plane.right()) * side;
                    is_arm = extent > arm - 0.5f * kHalfForearm_m;
                }
            }
            if (is_arm)
                hidden = true;
            else
                extents[rows - 1] = extent;
        }
        sides[s] = largest(extents, rows);
    }
    if (sides[0] < 0.0f && sides[1] < 0.0f) return {};
    const float between = glm::length(hips[0] - hips[1]);
    constexpr float kBothSigma_m = 0.015f,
                    kOneSigma_m = 0.025f;  // clothes; a side that the arm hides wholly or partly
    if (sides[0] < 0.0f) return {between + 2.0f * sides[1], kOneSigma_m, true};
    if (sides[1] < 0.0f) return {between + 2.0f * sides[0], kOneSigma_m, true};
    return {between + sides[0] + sides[1], hidden ? kOneSigma_m : kBothSigma_m, true};
}

Estimate elbow_fingertip(const FilteredDepth& depth, const Camera& camera, const Body& body,
                         bool from_wrist) {
    float sum = 0.0f;
    int sides = 0;
    const int arms[2][3] = {{VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_WRIST, VFIT_JOINT_LEFT_HAND},
                            {VFIT_JOINT_RIGHT_ELBOW, VFIT_JOINT_RIGHT_WRIST, VFIT_JOINT_RIGHT_HAND}};
    for (const auto& [elbow, wrist, hand] : arms) {
        if (!has_all(body, {elbow, hand}) || (from_wrist && !has_all(body, {wrist}))) continue;
        const Vec3 forearm = body.at(hand) - body.at(elbow);
        const FrontalPlane plane(camera, body.at(hand));
        const float cosine = glm::length(frontal(plane, forearm)) / std::max(1e-3f, glm::length(forearm));
        if (!(cosine >= std::cos(kBentForearm_rad))) continue;
        const float fingers = fingertip_distance(depth, plane, body.at(hand), forearm) / cosine;
        if (fingers <= 0.0f) continue;
        sum += glm::length(body.at(hand) - body.at(from_wrist ? wrist : elbow)) + fingers;
        ++sides;
    }
    if (sides == 0) return {};
    constexpr float kSigma_m = 0.02f;  // bent fingers and the place of the elbow joint
    return {sum / float(sides), kSigma_m, true};
}

}  // namespace vfit
