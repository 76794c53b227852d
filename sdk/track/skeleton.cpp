#include "track/skeleton.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vfit {

namespace {

constexpr float kLeastHeat =
    -14.0f;  // logit below the highest: all cells of a map together then weigh under 0.001
// Of the facing, frame by frame.
constexpr float kScale_m = 0.3f,
                kScaleShare = 0.5f;   // of distances summed over joints, by which sides are told
constexpr float kLeast = 1e-4f;       // probability that they are told wrongly, and of the other
constexpr float kWeight = 0.35f;      // of the network's answer: those of frames in a row are alike
constexpr float kAnswerLimit = 3.0f;  // one frame's logit counts no more
constexpr float kLegs = 3.0f;         // logit of toes that point straight behind
constexpr float kSeenFoot = 0.15f;    // confidence
// Largest distance between the positions of one person by two cameras; people who touch stand farther apart.
constexpr float kSamePlace_m = 0.4f;

/// The first cell whose middle may lie within `reach` of `place`, and the one after the last.
std::pair<int, int> cells_within(float place, float reach) {
    constexpr float half = 0.5f * JointMaps::kSide;
    return {int(std::max(0.0f, (place - reach + 1.0f) * half - 1.0f)),
            int(std::min(2.0f * half, (place + reach + 1.0f) * half + 1.0f))};
}

void exchange_sides(SeenJoints& joints) {
    for (int j = 0; j < kJointCount; ++j)
        if (const int other = mirrored_joint(j); other > j)
            std::swap(joints[size_t(j)], joints[size_t(other)]);
}

constexpr int kOfTrunk[] = {VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_LEFT_HIP,
                            VFIT_JOINT_RIGHT_HIP};

/// Towards the left of a trunk; `at`: where a joint is.
template <typename At>
Vec3 left_of(const At& at) {
    return at(VFIT_JOINT_LEFT_SHOULDER) - at(VFIT_JOINT_RIGHT_SHOULDER) + at(VFIT_JOINT_LEFT_HIP) -
           at(VFIT_JOINT_RIGHT_HIP);
}

template <typename At>
Vec3 middle_of(const At& at) {
    Vec3 sum(0.0f);
    for (const int joint : kOfTrunk) sum += at(joint);
    return sum / float(std::size(kOfTrunk));
}

float probability_of(float log_odds) { return 1.0f / (1.0f + std::exp(-log_odds)); }

/// Sum over paired joints of the distance between the same joint in both.
float distance_between(const SeenJoints& a, const SeenJoints& b) {
    float sum = 0.0f;
    for (int j = 0; j < kJointCount; ++j)
        if (mirrored_joint(j) != j)
            sum += std::min(0.3f, glm::length(a[size_t(j)].position - b[size_t(j)].position));
    return sum;
}

/// How surely legs like these are of a person who faces as the sides say, from 1 to -1 (legs of one who faces
/// the other way); 0 where they do not say. Toes point ahead of the shank, whatever way that points, and
/// knees bend back alone.
float legs_agree(const SeenJoints& joints, const Vec3& up) {
    const auto at = [&](int joint) { return joints[size_t(joint)].position; };
    const Vec3 left = left_of(at);
    float said = 0.0f, most = 0.0f;
    const auto leg = [&](int hip, int knee, int foot, int toes) {
        const auto seen = [&](int joint) { return joints[size_t(joint)].confidence > kSeenFoot; };
        if (!seen(foot)) return;
        const bool bends = seen(knee) && seen(hip);
        const Vec3 shank = bends ? at(foot) - at(knee) : -up;
        if (seen(toes)) {
            const Vec3 way = at(toes) - at(foot);
            said += glm::dot(glm::cross(shank, left), way) / (glm::length(shank) * glm::length(way) + 1e-6f);
            most += glm::length(left);
        }
        if (bends) {
            const Vec3 thigh = at(knee) - at(hip);
            said +=
                glm::dot(glm::cross(thigh, shank), left) / (glm::length(thigh) * glm::length(shank) + 1e-6f);
        }
    };
    leg(VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_LEFT_TOES);
    leg(VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_RIGHT_FOOT, VFIT_JOINT_RIGHT_TOES);
    most = std::max(most, glm::length(left));
    return most > 1e-6f ? std::clamp(said / most, -1.0f, 1.0f) : 0.0f;
}

/// Logit that the person faces away, by the frames of other cameras. Cameras exchange the evidence of single
/// frames and no decisions: a decision that came back would confirm itself.
float away_by_others(std::span<const Body> elsewhere, const SeenJoints& joints) {
    const auto seen = [&](int joint) { return joints[size_t(joint)].position; };
    const Vec3 left = left_of(seen), middle = middle_of(seen);
    float said = 0.0f;
    for (const Body& body : elsewhere) {
        const auto at = [&](int joint) { return body.at(joint); };
        const bool whole =
            std::all_of(std::begin(kOfTrunk), std::end(kOfTrunk), [&](int joint) { return body.has(joint); });
        if (!whole || glm::distance(middle_of(at), middle) > kSamePlace_m) continue;
        const Vec3 other = left_of(at);
        said -= body.facing_logit * glm::dot(left, other) / (glm::length(left) * glm::length(other) + 1e-6f);
    }
    return said;
}

}  // namespace

void read_maps(const JointMaps& maps, const CropView& view, const Camera& camera, SeenJoints& out) {
    constexpr float reach = kNear_m / (0.5f * CropView::kSide_m);
    std::array<float, JointMaps::kCells> heat;
    for (size_t j = 0; j < size_t(kJointCount); ++j) {
        const float* logits = maps.heat.data() + j * JointMaps::kCells;
        const float* depth = maps.depth.data() + j * JointMaps::kCells;
        const float highest = *std::max_element(logits, logits + JointMaps::kCells);
        float sum = 0.0f;
        Vec3 place(0.0f);
        for (int y = 0; y < JointMaps::kSide; ++y) {
            float row = 0.0f;
            for (int x = 0; x < JointMaps::kSide; ++x) {
                const size_t i = size_t(y * JointMaps::kSide + x);
                const float below = logits[i] - highest;
                if (!(below >= kLeastHeat)) {  // or not a number
                    heat[i] = 0.0f;
                    continue;
                }
                const float h = heat[i] = std::exp(below);
                row += h;
                place.x += h * JointMaps::place_of(x);
                place.z += h * depth[i];
            }
            place.y += row * JointMaps::place_of(y);
            sum += row;
        }
        place /= sum;
        float close = 0.0f;
        const auto [y0, y1] = cells_within(place.y, reach);
        const auto [x0, x1] = cells_within(place.x, reach);
        for (int y = y0; y < y1; ++y)
            for (int x = x0; x < x1; ++x) {
                const float dx = JointMaps::place_of(x) - place.x, dy = JointMaps::place_of(y) - place.y;
                if (dx * dx + dy * dy <= reach * reach) close += heat[size_t(y * JointMaps::kSide + x)];
            }
        out[j] = {view.to_camera(camera, place), close / sum};
    }
}

void Facing::apply(float away_logit, const Vec3& up, SeenJoints& joints, std::span<const Body> elsewhere) {
    const float legs = -kLegs * legs_agree(joints, up);
    if (known_) {
        SeenJoints other = joints;
        exchange_sides(other);
        const float same_m = distance_between(joints, last_), exchanged_m = distance_between(other, last_);
        const float scale_m = kScale_m + kScaleShare * std::min(same_m, exchanged_m);
        const float stays =
            std::clamp(probability_of((exchanged_m - same_m) / scale_m), kLeast, 1.0f - kLeast);
        const float was = probability_of(log_odds_);
        const float is = stays * was + (1.0f - stays) * (1.0f - was);
        log_odds_ = std::log(is / (1.0f - is));
    }
    known_ = true;
    said_ = legs;
    if (!std::isnan(away_logit)) said_ += std::clamp(away_logit, -kAnswerLimit, kAnswerLimit);
    log_odds_ += kWeight * (said_ + away_by_others(elsewhere, joints));
    last_ = joints;
    if (away()) exchange_sides(joints);
}

}  // namespace vfit
