#include "scan/trunk_view.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "scan/trunk_lines.h"

namespace vfit {

namespace {

constexpr float kWidest_m = 0.45f;     // from the spine
constexpr float kDeepest_m = 0.35f;    // before or behind the spine
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

class Look {
public:
    Look(const DepthImage& image, uint8_t user, const BodyFit& fit, TrunkView& out)
        : image_(image),
          camera_(image.camera),
          lines_(image, user, fit),
          arms_(camera_, fit.body().joints()),
          user_(user),
          out_(out),
          up_(camera_.floor_normal) {
        const auto& joints = fit.body().joints();
        hips_ = 0.5f * (joints[VFIT_JOINT_LEFT_HIP] + joints[VFIT_JOINT_RIGHT_HIP]);
        spine_ = joints[VFIT_JOINT_NECK] - hips_;
    }

    void run() {
        out_.facing_rad = 0.0f;
        for (auto& level : out_.towards_m) level.fill(std::nanf(""));
        for (auto& level : out_.reach_m) level.fill(std::nanf(""));
        // Level axes of the view.
        const Vec3 middle = hips_ + 0.5f * spine_;
        const Vec3 away = middle - glm::dot(middle, up_) * up_;
        const float rise = glm::dot(spine_, up_);
        if (!(glm::length(away) > 0.5f) || !(rise > 0.2f)) return;
        towards_ = -glm::normalize(away);
        across_ = glm::cross(up_, towards_);
        const Vec3& ahead = lines_.ahead();
        out_.facing_rad = std::atan2(glm::dot(ahead, across_), glm::dot(ahead, towards_));
        see_surface(rise);
        for (int level = 0; level < TrunkView::kLevels; ++level) see_outline(level);
    }

private:
    /// All of the trunk's readings, each at the level where it lies in space.
    void see_surface(float rise) {
        std::array<std::array<uint32_t, TrunkView::kColumns>, TrunkView::kLevels> counts{};
        std::array<std::array<float, TrunkView::kColumns>, TrunkView::kLevels> sums{};
        int left = int(camera_.width), right = 0, top = int(camera_.height), bottom = 0;
        for (const float share : {TrunkProfile::along(0), TrunkProfile::along(TrunkView::kLevels - 1)})
            for (const Vec2 way : {Vec2(-1.0f, -1.0f), {-1.0f, 1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}}) {
                const Vec3 corner =
                    hips_ + share * spine_ + way.x * kWidest_m * across_ + way.y * kDeepest_m * towards_;
                if (corner.z < 0.3f) return;
                const Vec2 p = camera_.project(corner);
                left = std::min(left, int(p.x) - 1), right = std::max(right, int(p.x) + 2);
                top = std::min(top, int(p.y) - 1), bottom = std::max(bottom, int(p.y) + 2);
            }
        left = std::max(left, 0), top = std::max(top, 0);
        right = std::min(right, int(camera_.width) - 1), bottom = std::min(bottom, int(camera_.height) - 1);
        const float step = TrunkProfile::along(1) - TrunkProfile::along(0);
        for (int y = top; y <= bottom; ++y)
            for (int x = left; x <= right; ++x) {
                const size_t i = image_.index(uint32_t(x), uint32_t(y));
                if (image_.users[i] != user_ || image_.depth[i] == 0) continue;
                const float z = image_.metres(i);
                const Vec3 p = camera_.unproject(float(x), float(y), z);
                const float along = glm::dot(p - hips_, up_) / rise;
                const int level = int(std::lround((along - TrunkProfile::along(0)) / step));
                if (level < 0 || level >= TrunkView::kLevels) continue;
                const Vec3 from = p - (hips_ + along * spine_);
                const float towards = glm::dot(from, towards_);
                const int column =
                    int(std::floor(glm::dot(from, across_) / TrunkView::kColumn_m)) + TrunkView::kColumns / 2;
                if (column < 0 || column >= TrunkView::kColumns || std::abs(towards) > kDeepest_m) continue;
                if (arms_.have(Vec2(float(x), float(y)), z)) continue;
                sums[size_t(level)][size_t(column)] += towards, ++counts[size_t(level)][size_t(column)];
            }
        for (size_t l = 0; l < counts.size(); ++l)
            for (size_t c = 0; c < counts[l].size(); ++c)
                if (counts[l][c]) out_.towards_m[l][c] = sums[l][c] / float(counts[l][c]);
    }

    void see_outline(int level) {
        const auto line = lines_.line(TrunkProfile::along(level));
        if (!line || lines_.reading(line->at) == 0.0f) return;
        for (const float way : {1.0f, -1.0f}) {
            const auto ray = outline(*line, way);
            if (!ray) continue;
            const Vec3 centre = line->centre, beside = centre - glm::dot(centre, *ray) * *ray;
            // The ray passes the spine on its own side of the picture.
            const size_t side =
                glm::dot(beside, across_) < 0.0f ? TrunkView::kRightOfPicture : TrunkView::kLeftOfPicture;
            out_.reach_m[size_t(level)][side] = glm::length(beside);
            out_.aside_rad[size_t(level)][side] = std::asin(glm::length(beside) / glm::length(centre));
        }
    }

    /// The line of sight along the outline, from the camera; nothing where an arm hides it.
    std::optional<Vec3> outline(const TrunkLines::Line& line, float way) const {
        const float centre_z = line.centre.z;
        const int reach_px = int(kWidest_m * camera_.fx / centre_z);
        int last = 0, trunk = -1;  // pixels: the person's, the trunk's
        float z = 0.0f;            // of the trunk's
        float before = 0.0f;       // of the pixel before
        bool behind = false;       // what goes on there lies farther away than a trunk can
        int i = 0;
        for (; i <= reach_px && !(behind && i - trunk > kFlying + 1); ++i) {
            const Vec2 p = line.at + way * float(i) * line.across;
            const float here = lines_.reading(p);
            if (here == 0.0f) {
                if (i - last > kGap) break;
                continue;
            }
            last = i;
            behind = here > centre_z + kEdgeDepth_m;
            const bool settled = i > 0 && std::abs(here - before) < kSettled_m;
            before = here;
            if (settled && !behind && !arms_.have(p, here)) trunk = i, z = here;
        }
        // Sections are seen edge-on where their outline is, and that is about as far away as the spine.
        if (i > reach_px || trunk < 0 || z < centre_z - kEdgeDepth_m) return std::nullopt;
        const Vec2 beyond = line.at + way * float(last + 1) * line.across;
        if (beyond.x < 0.0f || beyond.y < 0.0f || beyond.x > float(camera_.width) - 1.0f ||
            beyond.y > float(camera_.height) - 1.0f)
            return std::nullopt;  // cut by the image's border
        const bool whole = last - trunk <= kFlying;
        if (!whole && !behind) return std::nullopt;  // an arm before it
        const Vec2 edge = line.at + way * (float(whole ? last : trunk) + 0.5f) * line.across;
        return glm::normalize(camera_.unproject(edge.x, edge.y, 1.0f));
    }

    const DepthImage& image_;
    const Camera& camera_;
    TrunkLines lines_;
    Arms arms_;
    uint8_t user_;
    TrunkView& out_;
    Vec3 up_, hips_{0.0f}, spine_{0.0f}, towards_{0.0f}, across_{0.0f};
};

}  // namespace

void look_at_trunk(const DepthImage& image, uint8_t user, const BodyFit& fit, TrunkView& out) {
    Look(image, user, fit, out).run();
}

}  // namespace vfit
