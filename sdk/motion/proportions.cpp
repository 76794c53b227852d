#include "motion/proportions.h"

#include <algorithm>

#include "motion/trunk.h"

namespace vfit {

namespace {

// Before anything is measured: fractions of stature (Drillis & Contini, in Winter) of a person of 1.69 m, the
// mean of both sexes in ANSUR II.
constexpr float kStatureM = 1.69f;
constexpr float kTrunkShare = 0.288f;          // shoulder height .818 less hip height .530
constexpr float kHipHalfShare = 0.0955f / 2;   // joint centres: half of the hip breadth .191
constexpr float kShoulderHalfShare = 0.1295f;  // half of biacromial .259
constexpr float kShoulderDropShare = 0.0f;
constexpr float kNeckShare = 0.052f;  // .870 (chin) less .818
constexpr float kUpperArmShare = 0.186f, kForearmShare = 0.146f;
constexpr float kPalmShare = 0.040f;  // wrist to the hand's centre of mass, as on the avatar
constexpr float kThighShare = 0.245f, kShankShare = 0.246f, kAnkleShare = 0.039f;
constexpr float kToesForwardShare = 0.070f;  // of the foot's .152: ankle to toe joint

constexpr int kMeanCount = 300;  // readings that a mean spans: 10 s at 30 Hz
// Two joints of a segment that lie closer are one reading given twice: a leg without length would put the
// character's hips nowhere.
constexpr float kLeastSegmentM = 0.01f;
constexpr float kClavicleStart = 0.15f;  // its inner end, share of the half breadth: the sternum's half

bool measured(const Body& body, int joint) {
    return body.joints[static_cast<size_t>(joint)].state == VFIT_JOINT_MEASURED;
}

}  // namespace

Proportions::Proportions() { reset(); }

void Proportions::reset() {
    constexpr float kShares[kSegmentCount] = {
        kTrunkShare, kHipHalfShare,  kShoulderHalfShare, kShoulderDropShare,
        kNeckShare,  kUpperArmShare, kForearmShare,      kThighShare,
        kShankShare, 0.0801f};  // kFoot: sqrt(.039^2 + .070^2)
    for (size_t i = 0; i < lengths_.size(); ++i) lengths_[i] = {kShares[i] * kStatureM, 0};
    build();
}

void Proportions::add(Segment segment, float length_m) {
    Mean& mean = lengths_[static_cast<size_t>(segment)];
    mean.count = std::min(mean.count + 1, kMeanCount);
    mean.value_m += (length_m - mean.value_m) / static_cast<float>(mean.count);
}

void Proportions::add_between(const Body& body, Segment segment, int from, int to, float share) {
    if (!measured(body, from) || !measured(body, to)) return;
    const float length_m = glm::length(body.at(to) - body.at(from));
    if (length_m >= kLeastSegmentM) add(segment, share * length_m);
}

void Proportions::update(const Body& body) {
    const int left = VFIT_JOINT_LEFT_SHOULDER, right = VFIT_JOINT_RIGHT_SHOULDER;
    const bool shoulders = measured(body, left) && measured(body, right);
    Trunk trunk;
    if (find_trunk(body, trunk) && trunk.hips_seen) {
        add(kTrunk, glm::length(trunk.neck - trunk.hip_middle));
        if (shoulders) {
            const Vec3 middle = 0.5f * (body.at(left) + body.at(right));
            add(kShoulderDrop, glm::dot(trunk.neck - middle, trunk.up()));
        }
    }
    add_between(body, kHipHalf, VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP, 0.5f);
    add_between(body, kShoulderHalf, VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_RIGHT_SHOULDER, 0.5f);
    // HEAD is the middle of the head: half of the way lies below the skull.
    add_between(body, kNeck, VFIT_JOINT_NECK, VFIT_JOINT_HEAD, 0.5f);
    for (int side = 0; side < 2; ++side) {
        add_between(body, kUpperArm, VFIT_JOINT_LEFT_SHOULDER + side, VFIT_JOINT_LEFT_ELBOW + side, 1.0f);
        if (body.has(VFIT_JOINT_LEFT_WRIST + side))
            add_between(body, kForearm, VFIT_JOINT_LEFT_ELBOW + side, VFIT_JOINT_LEFT_WRIST + side, 1.0f);
        else
            add_between(body, kForearm, VFIT_JOINT_LEFT_ELBOW + side, VFIT_JOINT_LEFT_HAND + side,
                        kForearmShare / (kForearmShare + kPalmShare));
        add_between(body, kThigh, VFIT_JOINT_LEFT_HIP + side, VFIT_JOINT_LEFT_KNEE + side, 1.0f);
        add_between(body, kShank, VFIT_JOINT_LEFT_KNEE + side, VFIT_JOINT_LEFT_FOOT + side, 1.0f);
        add_between(body, kFoot, VFIT_JOINT_LEFT_FOOT + side, VFIT_JOINT_LEFT_TOES + side, 1.0f);
    }
    build();
}

void Proportions::build() {
    const auto m = [this](Segment s) { return lengths_[static_cast<size_t>(s)].value_m; };
    Skeleton& s = skeleton_;
    s.ankle_height = kAnkleShare / (kThighShare + kShankShare) * (m(kThigh) + m(kShank));
    s.offset[VFIT_BONE_HIPS] = Vec3(0, m(kThigh) + m(kShank) + s.ankle_height, 0);
    const Vec3 quarter(0, 0.25f * m(kTrunk), 0);  // hips to neck in four equal parts
    s.offset[VFIT_BONE_SPINE] = s.offset[VFIT_BONE_CHEST] = quarter;
    s.offset[VFIT_BONE_UPPER_CHEST] = s.offset[VFIT_BONE_NECK] = quarter;
    s.offset[VFIT_BONE_HEAD] = Vec3(0, m(kNeck), 0);
    const Vec3 toes = m(kFoot) * glm::normalize(Vec3(0, -kAnkleShare, kToesForwardShare));
    for (int side = 0; side < 2; ++side) {
        const float x = side == 0 ? 1.0f : -1.0f;
        const int arm = side == 0 ? VFIT_BONE_LEFT_SHOULDER : VFIT_BONE_RIGHT_SHOULDER;
        const int leg = side == 0 ? VFIT_BONE_LEFT_UPPER_LEG : VFIT_BONE_RIGHT_UPPER_LEG;
        Vec3* offset = s.offset.data();
        offset[arm] = Vec3(x * kClavicleStart * m(kShoulderHalf), quarter.y - m(kShoulderDrop), 0);
        offset[arm + 1] = Vec3(x * (1.0f - kClavicleStart) * m(kShoulderHalf), 0, 0);
        offset[arm + 2] = Vec3(x * m(kUpperArm), 0, 0);
        offset[arm + 3] = Vec3(x * m(kForearm), 0, 0);
        offset[leg] = Vec3(x * m(kHipHalf), 0, 0);
        offset[leg + 1] = Vec3(0, -m(kThigh), 0);
        offset[leg + 2] = Vec3(0, -m(kShank), 0);
        offset[leg + 3] = toes;
    }
}

}  // namespace vfit
