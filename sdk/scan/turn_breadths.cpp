#include "scan/turn_breadths.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/wipe.h"
#include "scan/even_waves.h"
#include "scan/trunk_lines.h"

namespace vfit {

namespace {

constexpr float kWidest_m = 0.45f;     // from the spine
constexpr float kEdgeDepth_m = 0.10f;  // before or behind the spine: it is not the trunk's outline
constexpr float kArmRadius_m = 0.08f;  // about the bones
constexpr float kArmDepth_m = 0.12f;   // before or behind the bones: it is not the arm
constexpr float kHand_m = 0.12f;       // from the hand's joint to the fingertips
constexpr float kSettled_m = 0.05f;    // from pixel to pixel: they see one surface
constexpr int kFlying = 2;             // pixels of an outline that see what is behind as well
constexpr int kGap = 2;                // pixels without a reading inside the person

/// The arms in the picture.
class Arms {
public:
    Arms(const Camera& camera, const std::array<Vec3, kJointCount>& joints) {
        size_t n = 0;
        for (const auto& arm :
             {std::array{VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_HAND},
              {VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_RIGHT_ELBOW, VFIT_JOINT_RIGHT_HAND}}) {
            const Vec3 shoulder = joints[size_t(arm[0])], elbow = joints[size_t(arm[1])],
                       hand = joints[size_t(arm[2])];
            const Vec3 tip = hand + kHand_m * glm::normalize(hand - elbow);
            for (const auto& [a, b] : {std::pair(shoulder, elbow), {elbow, tip}}) {
                const float z = std::max(0.3f, 0.5f * (a.z + b.z));
                bones_[n++] = {camera.project(a), camera.project(b), a.z, b.z, kArmRadius_m * camera.fx / z};
            }
        }
    }
    /// Whether a reading is an arm's.
    bool have(const Vec2& p, float z) const {
        return std::any_of(bones_.begin(), bones_.end(), [&](const Bone& bone) {
            const Vec2 way = bone.to - bone.from;
            const float along =
                std::clamp(glm::dot(p - bone.from, way) / std::max(glm::dot(way, way), 1e-6f), 0.0f, 1.0f);
            return glm::distance(p, bone.from + along * way) < bone.radius &&
                   std::abs(z - std::lerp(bone.from_z, bone.to_z, along)) < kArmDepth_m;
        });
    }

private:
    struct Bone {
        Vec2 from, to;
        float from_z, to_z, radius;
    };
    std::array<Bone, 4> bones_;
};

}  // namespace

void TurnBreadths::reset() { wipe(sums_); }

float TurnBreadths::breadth_m(int level, int direction) const {
    const Sum& sum = sums_[size_t(level)][size_t(direction)];
    return sum.count ? float(sum.metres / sum.count) : std::nanf("");
}

float TurnBreadths::girth_m(int level) const {
    std::array<float, kDirections> breadths;
    for (int d = 0; d < kDirections; ++d) breadths[size_t(d)] = breadth_m(level, d);
    return kPi * fit_even_waves(breadths).mean;
}

void TurnBreadths::add(const DepthImage& image, uint8_t user, const BodyFit& fit) {
    const TrunkLines lines(image, user, fit);
    const Camera& camera = image.camera;
    const Arms arms(camera, fit.body().joints());
    const float turn = std::atan2(lines.ahead().x, -lines.ahead().z) / kPi;  // half turns
    const float part = turn - std::floor(turn);
    const size_t direction = size_t(std::lround(part * kDirections)) % kDirections;
    const auto reading = [&](const Vec2& p) { return lines.reading(p); };
    for (int l = 0; l < kLevels; ++l) {
        const auto line = lines.line(TrunkProfile::along(l));
        if (!line) continue;
        const Vec3 centre = line->centre;
        const Vec2 at = line->at, across = line->across;
        if (reading(at) == 0.0f) continue;
        const int reach_px = int(kWidest_m * camera.fx / centre.z);
        // How far the line of sight along the outline passes from the spine.
        const auto reach = [&](float way) -> std::optional<float> {
            int last = 0, trunk = -1;  // pixels: the person's, the trunk's
            float z = 0.0f;            // of the trunk's
            float before = 0.0f;       // of the pixel before
            bool behind = false;       // what goes on beyond the trunk lies farther than it can
            int i = 0;
            for (; i <= reach_px && !(behind && i - trunk > kFlying + 1); ++i) {
                const Vec2 p = at + way * float(i) * across;
                const float here = reading(p);
                if (here == 0.0f) {
                    if (i - last > kGap) break;
                    continue;
                }
                last = i;
                behind = here > centre.z + kEdgeDepth_m;
                const bool settled = i > 0 && std::abs(here - before) < kSettled_m;
                before = here;
                if (settled && !behind && !arms.have(p, here)) trunk = i, z = here;
            }
            // Sections are seen edge-on where their outline is, and that is about as far away as the spine.
            if (i > reach_px || trunk < 0 || z < centre.z - kEdgeDepth_m) return std::nullopt;
            const bool whole = last - trunk <= kFlying;
            if (!whole && !behind) return std::nullopt;  // an arm before it
            const Vec2 edge = at + way * (float(whole ? last : trunk) + 0.5f) * across;
            const Vec3 ray = glm::normalize(camera.unproject(edge.x, edge.y, 1.0f));
            return glm::length(centre - glm::dot(centre, ray) * ray);
        };
        const auto one = reach(1.0f), other = reach(-1.0f);
        if (!one || !other) continue;
        Sum& sum = sums_[size_t(l)][direction];
        sum.metres += double(*one + *other), ++sum.count;
    }
}

}  // namespace vfit
