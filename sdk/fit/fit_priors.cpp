#include "fit/fit_priors.h"

#include <algorithm>
#include <cmath>

#include "body/range_of_motion.h"

namespace vfit {

namespace {

constexpr float kRad = kPi / 180.0f;
constexpr float kWall_rad = 0.05f;  // standard deviation beyond a natural range
constexpr float kFree = 1e3f;       // radians: no wall

struct BonePrior {
    int bone;
    Vec3 mean, spread;  // turn vector, radians
    Vec3 least, most;
};

/// A bone in the middle, symmetric about x bend only.
BonePrior middle(int bone, Vec3 spread, Vec3 least, Vec3 most) {
    return {bone, Vec3(0.0f), spread, least, most};
}

struct Priors {
    std::array<BonePrior, kFitBones - 1> bones;
    Priors() {
        const RangeOfMotion& rom = RangeOfMotion::natural();
        const Vec3 free(kFree);
        // The spine's range is that of its three bones together.
        const Vec3 spine_least(rom.spine_flexion.least_deg / 3 * kRad, -rom.spine_rotation / 3 * kRad,
                               -rom.spine_lateral / 3 * kRad);
        const Vec3 spine_most(rom.spine_flexion.most_deg / 3 * kRad, rom.spine_rotation / 3 * kRad,
                              rom.spine_lateral / 3 * kRad);
        const Vec3 neck_least(rom.neck_flexion.least_deg / 2 * kRad, -rom.neck_rotation / 2 * kRad,
                              -rom.neck_lateral / 2 * kRad);
        const Vec3 neck_most(rom.neck_flexion.most_deg / 2 * kRad, rom.neck_rotation / 2 * kRad,
                             rom.neck_lateral / 2 * kRad);
        size_t n = 0;
        for (const int b : {VFIT_BONE_SPINE, VFIT_BONE_CHEST, VFIT_BONE_UPPER_CHEST})
            bones[n++] = middle(b, Vec3(0.15f, 0.10f, 0.08f), spine_least, spine_most);
        for (const int b : {VFIT_BONE_NECK, VFIT_BONE_HEAD})
            bones[n++] = middle(b, Vec3(0.20f, 0.25f, 0.12f), neck_least, neck_most);
        for (const float side : {1.0f, -1.0f}) {
            const auto bone = [&](int left, int right) { return side > 0 ? left : right; };
            // Of the right side: turns about y and z are mirrored.
            const auto sided = [&](Vec3 v) { return Vec3(v.x, side * v.y, side * v.z); };
            const auto add = [&](int id, Vec3 mean, Vec3 spread, Vec3 least, Vec3 most) {
                const Vec3 a = sided(least), b = sided(most);
                bones[n++] = {id, sided(mean), spread, glm::min(a, b), glm::max(a, b)};
            };
            add(bone(VFIT_BONE_LEFT_SHOULDER, VFIT_BONE_RIGHT_SHOULDER), Vec3(0.0f),
                Vec3(0.08f, 0.12f, 0.12f), -free, free);
            // Arms mostly hang. The range of a ball joint is no box of turn vectors: no walls.
            add(bone(VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_RIGHT_UPPER_ARM), Vec3(0, 0, -1.1f),
                Vec3(0.6f, 0.9f, 0.8f), -free, free);
            // The elbow: flexion about y, pronation about x; little else.
            add(bone(VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_RIGHT_LOWER_ARM), Vec3(0, -0.4f, 0),
                Vec3(0.4f, 0.9f, 0.10f),
                Vec3(-rom.forearm_supination * kRad, -rom.elbow_flexion.most_deg * kRad, -kFree),
                Vec3(rom.forearm_pronation * kRad, -rom.elbow_flexion.least_deg * kRad, kFree));
            add(bone(VFIT_BONE_LEFT_HAND, VFIT_BONE_RIGHT_HAND), Vec3(0.0f), Vec3(0.05f, 0.20f, 0.25f), -free,
                free);
            add(bone(VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG), Vec3(-0.1f, 0.05f, 0.04f),
                Vec3(0.7f, 0.25f, 0.25f),
                Vec3(-rom.hip_flexion.most_deg * kRad, -kFree, rom.hip_abduction.least_deg * kRad),
                Vec3(-rom.hip_flexion.least_deg * kRad, kFree, rom.hip_abduction.most_deg * kRad));
            add(bone(VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_RIGHT_LOWER_LEG), Vec3(0.15f, 0, 0),
                Vec3(0.8f, 0.06f, 0.05f), Vec3(rom.knee_flexion.least_deg * kRad, -kFree, -kFree),
                Vec3(rom.knee_flexion.most_deg * kRad, kFree, kFree));
            add(bone(VFIT_BONE_LEFT_FOOT, VFIT_BONE_RIGHT_FOOT), Vec3(0.0f), Vec3(0.30f, 0.20f, 0.12f),
                Vec3(rom.ankle_plantarflexion.least_deg * kRad, -kFree, -kFree),
                Vec3(rom.ankle_plantarflexion.most_deg * kRad, kFree, kFree));
        }
    }
};

// Spread of a bone's turn and of the hips' place from one frame of 1/30 s to the next: brisk motion (a hand
// at 3 m/s is 0.2 rad of a forearm).
constexpr float kLimbStep_rad = 0.25f, kTrunkStep_rad = 0.10f, kHipsStep_m = 0.05f;
constexpr float kLongestGap = 6.0f;  // frames; after more the last pose says little

bool is_limb(int bone) {
    return bone == VFIT_BONE_LEFT_UPPER_ARM || bone == VFIT_BONE_LEFT_LOWER_ARM ||
           bone == VFIT_BONE_LEFT_HAND || bone == VFIT_BONE_RIGHT_UPPER_ARM ||
           bone == VFIT_BONE_RIGHT_LOWER_ARM || bone == VFIT_BONE_RIGHT_HAND ||
           bone >= VFIT_BONE_LEFT_UPPER_LEG;
}

}  // namespace

Mat3 turn_derivative(const Vec3& v) {
    const float angle = glm::length(v);
    const Mat3 cross(Vec3(0, v.z, -v.y), Vec3(-v.z, 0, v.x), Vec3(v.y, -v.x, 0));
    // 1 / angle^2 - (1 + cos) / (2 angle sin); its limit at 0 is 1/12.
    const float c = angle < 1e-2f
                        ? 1.0f / 12.0f
                        : 1.0f / (angle * angle) -
                              (1.0f + std::cos(angle)) / (2.0f * angle * std::max(1e-4f, std::sin(angle)));
    return Mat3(1.0f) + 0.5f * cross + c * (cross * cross);
}

void add_pose_priors(const FitState& state, FitEquations& equations) {
    static const Priors priors;
    for (const BonePrior& prior : priors.bones) {
        const Vec3 turn = log_of(state.rotation[size_t(prior.bone)]);
        const Mat3 derivative = turn_derivative(turn);
        const int column = fit_column(prior.bone);
        equations.add_turn_prior(column, derivative, prior.mean - turn, 1.0f / (prior.spread * prior.spread));
        const Vec3 inside = glm::clamp(turn, prior.least, prior.most);
        Vec3 weight(0.0f);
        for (int k = 0; k < 3; ++k)
            if (inside[k] != turn[k]) weight[k] = 1.0f / (kWall_rad * kWall_rad);
        if (weight != Vec3(0.0f)) equations.add_turn_prior(column, derivative, inside - turn, weight);
    }
}

void add_motion_priors(const FitState& state, const FitState& last, float frames, FitEquations& equations) {
    if (!(frames > 0.0f) || frames > kLongestGap) return;
    for (int b = 0; b < kBoneCount; ++b) {
        if (fit_column(b) < 0) continue;
        const Vec3 back = log_of(glm::conjugate(state.rotation[size_t(b)]) * last.rotation[size_t(b)]);
        const float spread = (is_limb(b) ? kLimbStep_rad : kTrunkStep_rad) * frames;
        equations.add_turn_prior(fit_column(b), Mat3(1.0f), back, Vec3(1.0f / (spread * spread)));
    }
    const float weight = 1.0f / (kHipsStep_m * kHipsStep_m * frames * frames);
    for (int axis = 0; axis < 3; ++axis)
        equations.add_prior(kFitHipsColumn + axis, double(last.hips[axis] - state.hips[axis]),
                            double(weight));
}

}  // namespace vfit
