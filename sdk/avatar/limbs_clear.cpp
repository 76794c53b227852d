#include "avatar/limbs_clear.h"

#include <algorithm>
#include <cmath>

#include "body/joint_bones.h"
#include "math/quaternion.h"
#include "math/two_bone_ik.h"

namespace vfit {

namespace {

constexpr float kRoom_m = 0.02f;  // between two limbs: for two layers of cloth at 4 mm, and the 8 mm by which
                                  // they span the skin's hollows and roundings
constexpr float kBlend_m = 0.02f;                // over which two neighbouring bones share a place
constexpr int kRounds = 8, kRoundsOnTheWay = 2;  // of the chain; each is one pass over all contacts
constexpr float kStep_m = 0.03f;                 // of an arm on its path: less than its radius
constexpr int kMaxSteps = 8;
constexpr float kLongestStep = 1.5f;            // of one that is held back, to the others
constexpr float kClose_m = 2.0f * kStep_m;      // two arms that are closer have sides
constexpr float kFreeEnd = 0.95f;               // of a hand: there, the other arm may pass
constexpr uint64_t kMaxPause_ns = 250'000'000;  // between two poses of a path
// An arm that is held back so far and for so long goes to its place at once.
constexpr float kHeldBack_m = 0.15f, kMaxHeld_s = 0.5f;
constexpr size_t kReach = 2;         // cells of an outline that a vertex speaks for, to either side
constexpr float kFingertips = 1.6f;  // from the wrist, times the way to the knuckles
constexpr float kAlongHand[] = {0.1f, kHandCentre, 1.0f,
                                kFingertips};   // from the wrist to the knuckles, and on to the fingers
constexpr float kAlongThumb[] = {0.7f, 0.95f};  // from the wrist to its tip
constexpr float kThumb_m = 0.01f;               // its radius
// Of the upper arm only what is below the armpit: above, it is one with the trunk.
constexpr float kAlongUpper[] = {0.65f, 0.8f, 1.0f}, kAlongLower[] = {0.25f, 0.5f, 0.75f};
constexpr float kLeastOut_m = 1e-4f, kMinBone_m = 1e-3f;
constexpr float kMinLever = 0.4f;  // of the upper arm: nearer to the shoulder, the elbow would go too far
// Quantile of a limb's radii. Of a hand's, fingers and thumb are the larger ones: the palm is meant, from the
// side.
constexpr float kRound = 0.5f, kPalm = 0.25f;
constexpr float kHandSize = 0.9f;  // quantile of the ways off a hand's line

struct ArmBones {
    int upper, lower, hand;
    float side;  // of the body: +X is left
};
constexpr ArmBones kArms[2] = {
    {VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_LEFT_HAND, 1.0f},
    {VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_RIGHT_LOWER_ARM, VFIT_BONE_RIGHT_HAND, -1.0f}};

using glm::dot;

enum Part { kUpper, kForearm, kHand };

Vec3 unit_or(const Vec3& v, const Vec3& otherwise) {
    const float length = glm::length(v);
    return length > 1e-9f ? v / length : otherwise;
}

struct NearestOfSegments {
    float on_a, on_b;
};
/// Ericson, Real-Time Collision Detection, 5.1.9.
NearestOfSegments nearest_of(const LimbSegment& a, const LimbSegment& b) {
    const Vec3 d1 = a.to - a.from, d2 = b.to - b.from, r = a.from - b.from;
    const float l1 = std::max(dot(d1, d1), 1e-8f), l2 = std::max(dot(d2, d2), 1e-8f), f = dot(d2, r),
                c = dot(d1, r), along = dot(d1, d2), square = l1 * l2 - along * along;
    float s = square > 1e-6f * l1 * l2 ? std::clamp((along * f - c * l2) / square, 0.0f, 1.0f) : 0.5f;
    const float t = std::clamp((along * s + f) / l2, 0.0f, 1.0f);
    s = std::clamp((along * t - c) / l1, 0.0f, 1.0f);
    return {s, t};
}

float quantile_of(std::vector<float>& values, float quantile) {
    if (values.empty()) return 0.0f;
    const auto rank = size_t(quantile * float(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(rank), values.end());
    return values[rank];
}

/// Quantile of the distance from the axis of the part's skin within a tenth of the bone's length.
float radius_about(std::span<const Vec3> rest, std::span<const BodyPart> parts, BodyPart part,
                   const LimbSegment& axis, float share, float quantile) {
    constexpr float kAlong = 0.1f;
    const Vec3 way = axis.to - axis.from;
    std::vector<float> off;
    for (size_t v = 0; v < rest.size(); ++v) {
        if (parts[v] != part) continue;
        const float along = dot(rest[v] - axis.from, way) / std::max(dot(way, way), 1e-8f);
        if (std::abs(along - share) < kAlong) off.push_back(glm::distance(rest[v], axis.at(along)));
    }
    return quantile_of(off, quantile);
}

}  // namespace

void LimbsClear::Outline::learn(std::span<const Vec3> points) {
    radius.fill(0.0f);
    std::array<bool, kLevels * kAngles> known{};
    for (const Vec3& p : points) {
        const Vec3 d = p - start;
        const float level = (dot(d, axis) - least) / length * float(kLevels);
        if (level < 0.0f || level >= float(kLevels)) continue;
        const float out = std::hypot(dot(d, x), dot(d, z));
        const float angle = std::atan2(dot(d, z), dot(d, x)) / (2.0f * kPi) + 0.5f;
        const auto cell =
            size_t(level) * kAngles + size_t(std::min(angle * float(kAngles), float(kAngles) - 0.5f));
        radius[cell] = std::max(radius[cell], out);
        known[cell] = true;
    }
    // Cells without a vertex take their neighbours' on the same level; where these have none either, nothing
    // is there.
    for (size_t level = 0; level < size_t(kLevels); ++level)
        for (size_t a = 0; a < size_t(kAngles); ++a) {
            const size_t cell = level * kAngles + a;
            if (known[cell]) continue;
            for (size_t step = 1; step <= kReach && radius[cell] == 0.0f; ++step) {
                const size_t row = level * kAngles;
                const size_t before = row + (a + kAngles - step) % kAngles,
                             after = row + (a + step) % kAngles;
                if (known[before] || known[after])
                    radius[cell] =
                        std::max(known[before] ? radius[before] : 0.0f, known[after] ? radius[after] : 0.0f);
            }
        }
}

float LimbsClear::Outline::at(float height, float angle) const {
    const float level =
        std::clamp((height - least) / length * float(kLevels) - 0.5f, 0.0f, float(kLevels - 1));
    const float turn = (angle / (2.0f * kPi) + 0.5f) * float(kAngles) - 0.5f + float(kAngles);
    const auto l0 = std::min(size_t(level), size_t(kLevels - 2));
    const auto a0 = size_t(turn) % kAngles, a1 = (a0 + 1) % kAngles;
    const float tl = level - float(l0), ta = turn - std::floor(turn);
    const auto cell = [&](size_t l, size_t a) { return radius[l * kAngles + a]; };
    return glm::mix(glm::mix(cell(l0, a0), cell(l0, a1), ta),
                    glm::mix(cell(l0 + 1, a0), cell(l0 + 1, a1), ta), tl);
}

LimbsClear::LimbsClear(const AvatarRig& rig, std::span<const Vec3> rest, std::span<const BodyPart> parts) {
    const auto add = [&](std::vector<int> humanoid, const Vec3& start, const Vec3& end, float before,
                         auto&& belongs) {
        Outline o;
        o.start = start;
        const float length = glm::distance(o.start, end);
        o.axis = length > 1e-3f ? (end - o.start) / length : Vec3(0, 1, 0);
        o.x = glm::normalize(Vec3(1, 0, 0) - o.axis.x * o.axis);
        o.z = glm::cross(o.x, o.axis);
        o.least = -before * length;
        o.length = std::max(length - o.least, 1e-3f);
        for (const int b : humanoid)
            if (rig.rig_bone(b) >= 0) {
                o.bones.push_back(rig.rig_bone(b));
                o.heights.push_back(dot(rig.rest_head(b) - o.start, o.axis));
            }
        std::vector<Vec3> points;
        for (size_t v = 0; v < rest.size(); ++v)
            if (belongs(parts[v])) points.push_back(rest[v]);
        o.learn(points);
        outlines_.push_back(std::move(o));
    };
    // From the crotch up to the armpits' height: above, shoulders and arms themselves are in the way.
    const Vec3 hips = rig.rest_head(VFIT_BONE_HIPS);
    const Vec3 shoulders =
        0.5f * (rig.rest_head(VFIT_BONE_LEFT_UPPER_ARM) + rig.rest_head(VFIT_BONE_RIGHT_UPPER_ARM));
    constexpr float kArmpit = 0.85f, kBelowHips = 0.3f;
    add({VFIT_BONE_HIPS, VFIT_BONE_SPINE, VFIT_BONE_CHEST, VFIT_BONE_UPPER_CHEST}, hips,
        glm::mix(hips, shoulders, kArmpit), kBelowHips,
        [](BodyPart part) { return part == BodyPart::kTorso; });
    // Thighs as seen from between them, so that the way out is always the hand's own side.
    const auto between = [&](int left, int right) {
        return 0.5f * (rig.rest_head(left) + rig.rest_head(right));
    };
    const Vec3 legs = between(VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG);
    const Vec3 knees = between(VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_RIGHT_LOWER_LEG);
    add({VFIT_BONE_LEFT_UPPER_LEG}, legs, knees, 0.0f,
        [](BodyPart part) { return part == BodyPart::kLeftThigh || part == BodyPart::kTorso; });
    add({VFIT_BONE_RIGHT_UPPER_LEG}, legs, knees, 0.0f,
        [](BodyPart part) { return part == BodyPart::kRightThigh || part == BodyPart::kTorso; });

    for (size_t i = 0; i < 2; ++i) learn_arm(rig, rest, parts, i);
}

void LimbsClear::learn_arm(const AvatarRig& rig, std::span<const Vec3> rest, std::span<const BodyPart> parts,
                           size_t number) {
    const ArmBones& bones = kArms[number];
    Arm& arm = arms_[number];
    const Vec3 shoulder = rig.rest_head(bones.upper), elbow = rig.rest_head(bones.lower),
               wrist = rig.rest_head(bones.hand);
    arm.hand_bone = rig.rig_bone(bones.hand);
    arm.hand = rig.bones()[size_t(arm.hand_bone)].rest_tail - wrist;
    const auto radius = [&](BodyPart part, const Vec3& from, const Vec3& to, float share) {
        return radius_about(rest, parts, part, {from, to}, share, kRound);
    };
    const bool left = number == 0;
    const BodyPart upper = left ? BodyPart::kLeftUpperArm : BodyPart::kRightUpperArm,
                   lower = left ? BodyPart::kLeftForearm : BodyPart::kRightForearm,
                   hand = left ? BodyPart::kLeftHand : BodyPart::kRightHand;
    for (const float share : kAlongUpper)
        arm.balls.push_back({share, 0.0f, Vec3(0.0f), radius(upper, shoulder, elbow, share)});
    for (const float share : kAlongLower)
        arm.balls.push_back({1.0f - share, share, Vec3(0.0f), radius(lower, elbow, wrist, share)});
    constexpr float kFrom = 0.2f, kTo = 0.9f;  // between which the skin of a bone is its alone
    const auto taper = [&](BodyPart part, const Vec3& from, const Vec3& to) {
        const float near_m = radius(part, from, to, kFrom), far_m = radius(part, from, to, kTo),
                    slope_m = (far_m - near_m) / (kTo - kFrom);
        return Arm::Taper{near_m - kFrom * slope_m, far_m + (1.0f - kTo) * slope_m};
    };
    arm.tapers[0] = taper(upper, shoulder, elbow), arm.tapers[1] = taper(lower, elbow, wrist);
    const Vec3 tail = wrist + arm.hand;
    const float palm_m = radius_about(rest, parts, hand, {wrist, tail}, kHandCentre, kPalm);
    for (const float share : kAlongHand) arm.balls.push_back({0.0f, 1.0f, share * arm.hand, palm_m});
    // The thumb stands off that line.
    const Vec3 along = unit_or(arm.hand, Vec3(0, -1, 0));
    Vec3 thumb(0.0f);
    float furthest = 0.0f;
    for (size_t v = 0; v < rest.size(); ++v) {
        if (parts[v] != hand) continue;
        const Vec3 from_wrist = rest[v] - wrist, off = from_wrist - dot(from_wrist, along) * along;
        if (glm::length(off) > furthest) furthest = glm::length(off), thumb = from_wrist;
    }
    const Vec3 off_line = thumb - dot(thumb, along) * along;
    arm.across = unit_or(off_line, arm.across);
    std::vector<float> wide, thick;
    for (size_t v = 0; v < rest.size(); ++v) {
        if (parts[v] != hand) continue;
        const Vec3 off = rest[v] - wrist;
        wide.push_back(std::abs(dot(off, arm.across)));
        thick.push_back(std::abs(dot(off, glm::cross(along, arm.across))));
    }
    arm.wide_m = quantile_of(wide, kHandSize), arm.thick_m = quantile_of(thick, kHandSize);
    for (const float share : kAlongThumb)
        arm.balls.push_back({0.0f, 1.0f, share * thumb, std::min(kThumb_m, palm_m)});
}

LimbsClear::Exit LimbsClear::exit_of(const Outline& o, std::span<const Mat4> matrices, const Vec3& p,
                                     float radius, float side) const {
    // The place in the rest mesh, as the bones near it see it.
    Vec3 rest(0.0f);
    Mat3 turn(0.0f);
    float total = 0.0f;
    for (size_t i = 0; i < o.bones.size(); ++i) {
        const Mat4& m = matrices[size_t(o.bones[i])];
        const Vec3 own = glm::transpose(Mat3(m)) * (p - Vec3(m[3]));
        const float height = dot(own - o.start, o.axis);
        const float low = i == 0 ? -1e9f : o.heights[i],
                    high = i + 1 < o.bones.size() ? o.heights[i + 1] : 1e9f;
        const float beyond = std::max({low - height, height - high, 0.0f});
        const float w = std::exp(-beyond * beyond / (kBlend_m * kBlend_m)) + 1e-6f;
        rest += w * own;
        turn += w * Mat3(m);
        total += w;
    }
    rest /= total;
    const Vec3 d = rest - o.start;
    const float height = dot(d, o.axis);
    const float along_x = dot(d, o.x), along_z = dot(d, o.z);
    const float distance = std::hypot(along_x, along_z);
    // Beyond the ends the outline fades out over the hand's own size.
    const float past = std::max(o.least - height, height - (o.least + o.length));
    const float fade = std::clamp(1.0f - past / std::max(radius, 0.02f), 0.0f, 1.0f);
    if (fade <= 0.0f) return {};
    const float clear = o.at(height, std::atan2(along_z, along_x)) + radius + kRoom_m;
    const float depth = fade * (clear - distance);
    if (depth <= 0.0f) return {};
    const Vec3 out = distance > 0.01f ? (along_x * o.x + along_z * o.z) / distance : side * o.x;
    return {glm::normalize(turn * out), depth};
}

void LimbsClear::Chain::move(float on_elbow, float on_wrist, const Vec3& by) {
    const float square = on_elbow * on_elbow + on_wrist * on_wrist;
    elbow += by * (on_elbow / square);
    wrist += by * (on_wrist / square);
}

LimbSegment LimbsClear::Chain::segment_of(int part) const {
    if (part == kUpper) return {shoulder, elbow};
    if (part == kForearm) return {elbow, wrist};
    return {wrist, wrist + kFingertips * hand};
}

/// What is so far along the part.
void LimbsClear::Chain::push(int part, float share, const Vec3& by) {
    if (part == kHand)
        move(0.0f, 1.0f, by);
    else if (part == kForearm)
        move(1.0f - share, share, by);
    else if (share > kMinLever)
        move(share, 0.0f, by);
}

/// Of the point that moves most.
float LimbsClear::Chain::way_to(const Chain& other) const {
    return std::max({glm::distance(elbow, other.elbow), glm::distance(wrist, other.wrist),
                     glm::distance(wrist + hand, other.wrist + other.hand)});
}

void LimbsClear::Chain::go_to(const Chain& other, float share) {
    if (share >= 1.0f) {
        *this = other;
        return;
    }
    elbow = glm::mix(elbow, other.elbow, share);
    wrist = glm::mix(wrist, other.wrist, share);
    hand = glm::mix(hand, other.hand, share);
    keep_lengths();
}

void LimbsClear::Chain::keep_lengths() {
    elbow = shoulder + upper_m * unit_or(elbow - shoulder, Vec3(0, -1, 0));
    wrist = elbow + lower_m * unit_or(wrist - elbow, Vec3(0, -1, 0));
}

bool LimbsClear::clear_of_body(size_t arm, std::span<const Mat4> matrices, Chain& chain) const {
    bool moved = false;
    for (const Outline& outline : outlines_)
        for (const Ball& ball : arms_[arm].balls) {
            const Exit exit = exit_of(outline, matrices, chain.at(ball), ball.radius_m, kArms[arm].side);
            if (exit.depth_m <= 0.0f) continue;
            chain.move(ball.elbow, ball.wrist, exit.depth_m * exit.direction);
            moved = true;
        }
    if (moved) chain.keep_lengths();
    return moved;
}

LimbsClear::Meeting LimbsClear::meeting_of(int left, int right, const Vec3& otherwise,
                                           const Chain (&chains)[2]) const {
    const LimbSegment a = chains[0].segment_of(left), b = chains[1].segment_of(right);
    const NearestOfSegments nearest = nearest_of(a, b);
    const Vec3 way = a.at(nearest.on_a) - b.at(nearest.on_b), direction = unit_or(way, otherwise);
    return {left,
            right,
            nearest.on_a,
            nearest.on_b,
            way,
            radius_m(0, chains[0], left, nearest.on_a, direction) +
                radius_m(1, chains[1], right, nearest.on_b, direction) + kRoom_m,
            (left == kHand && nearest.on_a > kFreeEnd) || (right == kHand && nearest.on_b > kFreeEnd)};
}

/// Capsules of one arm against those of the other. Where their axes nearly meet, the direction between them
/// says little: an arm stays on the side where it was, or in front if it is in front. Forearm and hand are on
/// one side.
bool LimbsClear::clear_of_each_other(const Vec3& forward, Sides& sides, Chain (&chains)[2]) const {
    constexpr std::array<std::array<int, 2>, 2> kPartsOf = {
        {{kUpper, kUpper}, {kForearm, kHand}}};  // first, last
    bool moved = false;
    for (size_t of_left = 0; of_left < 2; ++of_left)
        for (size_t of_right = 0; of_right < 2; ++of_right) {
            Vec3& side = sides[of_left][of_right];
            std::array<Meeting, 4> meetings;
            size_t count = 0, closest = 0;
            const auto gap_m = [&](size_t i) { return glm::length(meetings[i].way) - meetings[i].apart_m; };
            for (int left = kPartsOf[of_left][0]; left <= kPartsOf[of_left][1]; ++left)
                for (int right = kPartsOf[of_right][0]; right <= kPartsOf[of_right][1]; ++right) {
                    meetings[count] = meeting_of(left, right, forward, chains);
                    if (gap_m(count) < gap_m(closest)) closest = count;
                    ++count;
                }
            if (gap_m(closest) >= kClose_m) {
                side = Vec3(0.0f);
                continue;
            }
            const auto towards = [&](const Meeting& m, const Vec3& beside) {
                return unit_or(m.way + beside * std::max(0.0f, 0.5f * m.apart_m - glm::length(m.way)),
                               beside);
            };
            const Meeting& first = meetings[closest];
            const bool keeps = side != Vec3(0.0f) && !first.at_free_end;
            if (!keeps || dot(first.way, side) >= 0.0f)
                side = towards(first, keeps ? side : dot(first.way, forward) < 0.0f ? -forward : forward);
            for (size_t i = 0; i < count; ++i) {
                const Meeting m = meeting_of(meetings[i].left, meetings[i].right, forward, chains);
                const Vec3 out = dot(m.way, side) >= 0.0f ? towards(m, side) : side;
                const float depth = m.apart_m - dot(m.way, out);
                if (glm::length(m.way) >= m.apart_m || depth <= 0.0f) continue;
                moved = true;
                chains[0].push(m.left, m.on_left, 0.5f * depth * out);
                chains[1].push(m.right, m.on_right, -0.5f * depth * out);
            }
        }
    if (moved)
        for (Chain& chain : chains) chain.keep_lengths();
    return moved;
}

/// So far along the part, towards the other arm. A hand is flat.
float LimbsClear::radius_m(size_t arm, const Chain& chain, int part, float share,
                           const Vec3& direction) const {
    const Arm& of = arms_[arm];
    if (part != kHand) return glm::mix(of.tapers[part].from_m, of.tapers[part].to_m, share);
    const float across = dot(direction, chain.turn * of.across);
    return std::hypot(across * of.wide_m, std::sqrt(std::max(0.0f, 1.0f - across * across)) * of.thick_m);
}

void LimbsClear::clear(std::span<const Mat4> matrices, const Vec3& forward, int rounds, Sides& sides,
                       Chain (&chains)[2]) const {
    for (int round = 0; round < rounds; ++round) {
        bool moved = false;
        for (size_t i = 0; i < 2; ++i) moved |= clear_of_body(i, matrices, chains[i]);
        moved |= clear_of_each_other(forward, sides, chains);
        if (!moved) break;
    }
}

void LimbsClear::run(const PosedSkeleton& posed, std::span<const Mat4> matrices, Memory& memory,
                     Pose& pose) const {
    const auto at = [&](int bone) { return posed.position[size_t(bone)]; };
    const auto turn = [&](int bone) { return posed.rotation[size_t(bone)]; };
    Chain wanted[2];
    for (size_t i = 0; i < 2; ++i) {
        const ArmBones& arm = kArms[i];
        const Mat4& hand = matrices[size_t(arms_[i].hand_bone)];
        wanted[i] = {at(arm.upper),
                     at(arm.lower),
                     at(arm.hand),
                     Mat3(hand) * arms_[i].hand,
                     Mat3(hand),
                     glm::distance(at(arm.upper), at(arm.lower)),
                     glm::distance(at(arm.lower), at(arm.hand))};
    }
    if (pose.time_ns != memory.now_.time_ns) memory.before_ = memory.now_;
    Memory::State& now = memory.now_;
    const Memory::State& before = memory.before_;
    // Times are the host's: their difference may not fit.
    const uint64_t pause_ns = uint64_t(pose.time_ns) - uint64_t(before.time_ns);
    const bool has_path = before.is_known && pose.time_ns > before.time_ns && pause_ns <= kMaxPause_ns &&
                          before.held_s < kMaxHeld_s;
    const Quat chest = turn(VFIT_BONE_CHEST);
    const Vec3 forward = chest * Vec3(0, 0, 1);
    Chain chains[2] = {wanted[0], wanted[1]};
    Sides sides{};
    int steps = 1;
    float step_m = INFINITY;
    if (has_path) {
        float way_m = 0.0f;
        for (size_t i = 0; i < 2; ++i) {
            Chain& c = chains[i];
            const Memory::Arm& arm = before.arms[i];
            c.elbow = c.shoulder + chest * arm.elbow;
            c.wrist = c.shoulder + chest * arm.wrist;
            c.hand = chest * arm.hand;
            c.keep_lengths();
            way_m = std::max(way_m, c.way_to(wanted[i]));
        }
        steps = std::clamp(int(std::ceil(way_m / kStep_m)), 1, kMaxSteps);
        step_m = kLongestStep * std::max(way_m / float(steps), kStep_m);
        for (size_t l = 0; l < 2; ++l)
            for (size_t r = 0; r < 2; ++r) sides[l][r] = chest * before.sides[l][r];
    }
    for (int left = steps; left > 0; --left) {
        for (size_t i = 0; i < 2; ++i) {
            const float way_m = chains[i].way_to(wanted[i]);
            chains[i].go_to(wanted[i], std::min(1.0f / float(left), step_m / std::max(way_m, 1e-6f)));
        }
        clear(matrices, forward, left > 1 ? kRoundsOnTheWay : kRounds, sides, chains);
    }
    float held_m = 0.0f;
    for (size_t i = 0; i < 2; ++i)
        held_m = std::max({held_m, glm::distance(chains[i].elbow, wanted[i].elbow),
                           glm::distance(chains[i].wrist, wanted[i].wrist)});
    now = {pose.time_ns, true, {}, {}, 0.0f};
    if (held_m > kHeldBack_m && has_path) now.held_s = before.held_s + 1e-9f * float(pause_ns);
    const Quat to_chest = glm::conjugate(chest);
    for (size_t i = 0; i < 2; ++i) {
        const Chain& c = chains[i];
        now.arms[i] = {to_chest * (c.elbow - c.shoulder), to_chest * (c.wrist - c.shoulder),
                       to_chest * c.hand};
    }
    for (size_t l = 0; l < 2; ++l)
        for (size_t r = 0; r < 2; ++r) now.sides[l][r] = to_chest * sides[l][r];
    for (size_t i = 0; i < 2; ++i) {
        const ArmBones& arm = kArms[i];
        const Vec3 shoulder = at(arm.upper), elbow = at(arm.lower), wrist = at(arm.hand);
        const Chain& to = chains[i];
        if (std::min(to.upper_m, to.lower_m) < kMinBone_m) continue;  // a rig without one has no direction
        if (glm::distance(to.elbow, elbow) + glm::distance(to.wrist, wrist) < kLeastOut_m) continue;
        const Quat upper_turn =
            glm::normalize(shortest_arc(elbow - shoulder, to.elbow - shoulder) * turn(arm.upper));
        const Quat lower_turn =
            glm::normalize(shortest_arc(wrist - elbow, to.wrist - to.elbow) * turn(arm.lower));
        pose.rotation[size_t(arm.upper)] = glm::conjugate(turn(bone_parent(arm.upper))) * upper_turn;
        pose.rotation[size_t(arm.lower)] = glm::conjugate(upper_turn) * lower_turn;
        pose.rotation[size_t(arm.hand)] = glm::conjugate(lower_turn) * turn(arm.hand);
    }
}

}  // namespace vfit
