// Landmarks of head, neck and limbs.
#include <algorithm>
#include <cmath>
#include <optional>

#include "anthropometry/tape_landmarks.h"
#include "core/error.h"

namespace vfit {

namespace {

/// From the centre of the humeral head the outer edge of the acromion lies 12 mm outwards and 33 mm up: the
/// head's radius is 24 mm, the gap above it 9 mm, and the acromion covers 0.68 of the head (acromion index,
/// Nyffeler 2006).
constexpr float kAcromionOutwards = 12.0f, kAcromionUp = 33.0f;

/// Upper share of the head that holds no ear. The ear's middle (tragion) lies 0.56 of head height below the
/// crown, the ear is 0.27 of head height long (Farkas 1994): its top is at 0.42.
constexpr float kSkullShare = 0.4f;

/// The vertex of the highest score, of those that have one; null where none has.
template <typename Score>
const Vec3* best_vertex(const TapeMesh& body, const Score& score) {
    const TapeBody& b = body.body();
    const Vec3* best = nullptr;
    float best_score = 0.0f;
    for (size_t i = 0; i < b.positions.size(); ++i) {
        const std::optional<float> here = score(b.positions[i], b.parts[i]);
        if (here && (!best || *here > best_score)) best = &b.positions[i], best_score = *here;
    }
    return best;
}

const Vec3& frontmost(const std::vector<Vec3>& points) {
    return *std::max_element(points.begin(), points.end(),
                             [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
}

float collar_bones_height(const TapeMesh& body) {
    return 0.5f * (body.joint(VFIT_JOINT_LEFT_CLAVICLE).y + body.joint(VFIT_JOINT_RIGHT_CLAVICLE).y);
}

/// Along the neck's axis: no neck reaches as far below its joint as the joint lies above the collar bones'
/// own level.
float lowest_tape_on_neck(const TapeMesh& body) {
    return std::min(0.0f, collar_bones_height(body) - body.joint(VFIT_JOINT_NECK).y);
}

/// Tape about a limb, square to its axis, that many metres along it; 0 where the section is not of the limb
/// alone, but holds the trunk's or the other limb's axis as well.
float limb_girth(const TapeLimb& limb, float along_m, const Axis& apart) {
    const Vec3 place = limb.place(along_m);
    const Section section = limb.across(along_m);
    const auto* loop = loop_about(section, place);
    if (!loop) return 0.0f;
    const float share =
        glm::dot(place - apart.start, limb.direction()) / glm::dot(apart.end - apart.start, limb.direction());
    if (std::isfinite(share) && loop == loop_about(section, apart.at(share))) return 0.0f;
    return hull_perimeter(*loop);
}

/// Frontal section of the whole body: what lies more than 0.1 m above or below the place is left out.
Section frontal_near(const TapeBody& body, const Vec3& place) {
    constexpr float kReach_m = 0.1f;
    std::vector<uint32_t> near;
    for (size_t t = 0; t < body.indices.size(); t += 3) {
        const uint32_t* v = &body.indices[t];
        const auto [low, high] =
            std::minmax({body.positions[v[0]].y, body.positions[v[1]].y, body.positions[v[2]].y});
        if (high >= place.y - kReach_m && low <= place.y + kReach_m) near.insert(near.end(), v, v + 3);
    }
    return cut(body.positions, near, place, Vec3(0, 0, 1));
}

}  // namespace

float largest_limb_girth(const TapeMesh& body, const Axis& axis, float share, const Axis& apart) {
    const float last = share * glm::distance(axis.start, axis.end);
    const TapeLimb limb(body.body(), axis, 0.0f, last);
    const auto girth = [&](float along_m) { return limb_girth(limb, along_m, apart); };
    if (!(girth(last) > 0.0f)) fail(VFIT_ERROR_DATA, "a limb of the body is nowhere apart from the rest");
    const float first = border(last, 0.0f, [&](float along_m) { return girth(along_m) > 0.0f; });
    return girth(place_of_largest(std::min(first + kTapeHalfWidth_m, last), last, girth));
}

TapeLimb neck_of(const TapeMesh& body) {
    const Axis axis{body.joint(VFIT_JOINT_NECK), body.joint(VFIT_JOINT_HEAD)};
    return {body.body(), axis, lowest_tape_on_neck(body), glm::distance(axis.start, axis.end)};
}

float length(const std::vector<Vec3>& loop) {
    float sum = 0.0f;
    for (size_t i = 0; i < loop.size(); ++i) sum += glm::distance(loop[i], loop[(i + 1) % loop.size()]);
    return sum;
}

std::vector<Vec3> neck_loop(const TapeLimb& neck, float along_m) {
    const Section section = neck.across(along_m);
    const auto* loop = loop_about(section, neck.place(along_m));
    if (!loop) fail(VFIT_ERROR_DATA, "the line from the NECK to the HEAD joint does not run inside the body");
    std::vector<Vec3> tape;
    for (const Vec2& p : convex_hull(*loop)) tape.push_back(section.lift(p));
    return tape;
}

float narrowest_neck(const TapeLimb& neck) {
    return place_of_largest(0.0f, glm::distance(neck.axis().start, neck.axis().end),
                            [&](float along_m) { return -length(neck_loop(neck, along_m)); });
}

float larynx_place(const TapeMesh& body, const TapeLimb& neck, float narrowest_m, float chin) {
    const float larynx = glm::mix(chin, collar_bones_height(body), 1.0f / 3.0f);
    return border(narrowest_m, lowest_tape_on_neck(body),
                  [&](float along_m) { return frontmost(neck_loop(neck, along_m)).y > larynx; });
}

Vec3 acromion(const TapeBody& body, Side side) {
    const Vec3 joint = upper_arm(body, side).start;
    const Vec3 direction =
        glm::normalize(Vec3(side == Side::kLeft ? kAcromionOutwards : -kAcromionOutwards, kAcromionUp, 0.0f));
    // In the frontal plane through the joint: the outline's farthest crossing of the line to the bone's edge.
    const Section frontal = frontal_near(body, joint);
    const Vec2 along(glm::dot(direction, frontal.u), glm::dot(direction, frontal.v)),
        square(-along.y, along.x);
    float farthest = 0.0f;
    const auto visit = [&](const Vec2& a, const Vec2& b) {
        const float sa = glm::dot(a, square), sb = glm::dot(b, square);
        if ((sa > 0.0f) != (sb > 0.0f))
            farthest = std::max(farthest, glm::dot(glm::mix(a, b, sa / (sa - sb)), along));
    };
    for (const auto& loop : frontal.loops)
        for (size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[(i + 1) % loop.size()]);
    for (const auto& chain : frontal.chains)
        for (size_t i = 0; i + 1 < chain.size(); ++i) visit(chain[i], chain[i + 1]);
    if (!(farthest > 0.0f)) fail(VFIT_ERROR_DATA, "the body has no skin above its shoulder joint");
    return joint + farthest * direction;
}

float chin_height(const TapeMesh& body, const TapeLimb& neck, float narrowest_m) {
    const Vec3 throat = frontmost(neck_loop(neck, narrowest_m));
    const Vec3* nose = best_vertex(body, [&](const Vec3& p, BodyPart part) -> std::optional<float> {
        return part == BodyPart::kHead && p.y > throat.y ? std::optional(p.z) : std::nullopt;
    });
    if (!nose) fail(VFIT_ERROR_DATA, "the body has no head on its neck");
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
    const Vec3* found = best_vertex(body, [&](const Vec3& p, BodyPart part) -> std::optional<float> {
        return part == hand ? std::optional(glm::distance(p, wrist)) : std::nullopt;
    });
    if (!found) fail(VFIT_ERROR_DATA, "the body has no hand");
    return *found;
}

}  // namespace vfit
