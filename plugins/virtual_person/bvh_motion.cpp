// Carries a captured motion over to the person: rotations relative to the T-pose, the path scaled by the
// length of the legs and centred, the feet planted on the floor.
#include <algorithm>
#include <cmath>

#include "bvh.h"
#include "error.h"
#include "foot_plant.h"
#include "motion.h"

namespace vfit::virtual_person {

namespace {

// Names of the joints that carry each bone, in the two forms in which the CMU captures are passed round: made
// for MotionBuilder ("LeftHip"), and for 3ds Max ("LeftUpLeg").
struct BoneSource {
    int bone;
    const char* hip_form;
    const char* upleg_form;
};
constexpr BoneSource kSources[] = {
    {VFIT_BONE_HIPS, "Hips", "Hips"},
    {VFIT_BONE_SPINE, "lowerback", "LowerBack"},
    {VFIT_BONE_CHEST, "Chest", "Spine"},
    {VFIT_BONE_UPPER_CHEST, "Chest2", "Spine1"},
    {VFIT_BONE_NECK, "Neck", "Neck1"},
    {VFIT_BONE_HEAD, "Head", "Head"},
    {VFIT_BONE_LEFT_SHOULDER, "LeftCollar", "LeftShoulder"},
    {VFIT_BONE_LEFT_UPPER_ARM, "LeftShoulder", "LeftArm"},
    {VFIT_BONE_LEFT_LOWER_ARM, "LeftElbow", "LeftForeArm"},
    {VFIT_BONE_LEFT_HAND, "LeftWrist", "LeftHand"},
    {VFIT_BONE_RIGHT_SHOULDER, "RightCollar", "RightShoulder"},
    {VFIT_BONE_RIGHT_UPPER_ARM, "RightShoulder", "RightArm"},
    {VFIT_BONE_RIGHT_LOWER_ARM, "RightElbow", "RightForeArm"},
    {VFIT_BONE_RIGHT_HAND, "RightWrist", "RightHand"},
    {VFIT_BONE_LEFT_UPPER_LEG, "LeftHip", "LeftUpLeg"},
    {VFIT_BONE_LEFT_LOWER_LEG, "LeftKnee", "LeftLeg"},
    {VFIT_BONE_LEFT_FOOT, "LeftAnkle", "LeftFoot"},
    {VFIT_BONE_LEFT_TOES, "LeftToe", "LeftToeBase"},
    {VFIT_BONE_RIGHT_UPPER_LEG, "RightHip", "RightUpLeg"},
    {VFIT_BONE_RIGHT_LOWER_LEG, "RightKnee", "RightLeg"},
    {VFIT_BONE_RIGHT_FOOT, "RightAnkle", "RightFoot"},
    {VFIT_BONE_RIGHT_TOES, "RightToe", "RightToeBase"},
};
static_assert(std::size(kSources) == VFIT_BONE_COUNT);

constexpr double kHipSmoothing_s = 0.08;  // half window in which the hips give way to a leg that is too short

using Rotations = std::array<Quat, VFIT_BONE_COUNT>;

Quat shortest_arc(const Vec3& from, const Vec3& to) {
    const Vec3 a = glm::normalize(from), b = glm::normalize(to);
    const float w = 1.0f + glm::dot(a, b);
    if (w < 1e-5f) return glm::angleAxis(kPi, Vec3(0, 0, 1));
    return glm::normalize(Quat(w, glm::cross(a, b)));
}

int leg_bone(int side, int part) {
    return (side == kLeft ? VFIT_BONE_LEFT_UPPER_LEG : VFIT_BONE_RIGHT_UPPER_LEG) + part;
}
int arm_bone(int side, int part) {
    return (side == kLeft ? VFIT_BONE_LEFT_SHOULDER : VFIT_BONE_RIGHT_SHOULDER) + part;
}

class Retarget {
public:
    Retarget(const Bvh& bvh, const std::string& name, const Proportions& proportions)
        : bvh_(bvh), proportions_(proportions) {
        const bool upleg_form = bvh.find("LeftUpLeg") >= 0;
        for (const BoneSource& s : kSources) {
            const char* wanted = upleg_form ? s.upleg_form : s.hip_form;
            joint_[size_t(s.bone)] = bvh.find(wanted);
            if (joint_[size_t(s.bone)] < 0) fail(VFIT_ERROR_DATA, name, ": there is no joint ", wanted);
        }
        correction_.fill(kNoRotation);
        float source_leg = 0, person_leg = 0;
        for (const int side : {kLeft, kRight}) {
            const auto i = static_cast<size_t>(side);
            const Leg& leg = proportions.leg[i];
            correct(leg_bone(side, 0), leg_bone(side, 1), leg.thigh, name);
            correct(leg_bone(side, 1), leg_bone(side, 2), leg.shank, name);
            correct(arm_bone(side, 1), arm_bone(side, 2), proportions.upper_arm[i], name);
            correct(arm_bone(side, 2), arm_bone(side, 3), proportions.forearm[i], name);
            correction_[size_t(arm_bone(side, 3))] = correction_[size_t(arm_bone(side, 2))];
            source_leg +=
                glm::length(rest_offset(leg_bone(side, 1))) + glm::length(rest_offset(leg_bone(side, 2)));
            person_leg += glm::length(leg.thigh) + glm::length(leg.shank);
        }
        scale_ = person_leg / source_leg;
    }

    std::vector<BonePose> run() {
        read_frames();
        ground();
        for (FootTrack& f : foot_) {
            find_contacts(f, bvh_.frame_time_s);
            plant(f, bvh_.frame_time_s, proportions_.ankle_height_m);
            keep_above_floor(f);
        }
        give_way();
        return assemble();
    }

private:
    Vec3 rest_offset(int bone) const { return bvh_.joints[size_t(joint_[size_t(bone)])].offset; }

    // The file's zero pose is not a T-pose: what carries the T-pose's limb into it comes before the captured
    // rotation.
    void correct(int bone, int child, const Vec3& t_pose, const std::string& name) {
        const Vec3 rest = rest_offset(child);
        if (!(glm::length(rest) > 1e-6f))
            fail(VFIT_ERROR_DATA, name, ": ", bvh_.joints[size_t(joint_[size_t(bone)])].name,
                 " has no length");
        correction_[size_t(bone)] = shortest_arc(t_pose, rest);
    }

    void read_frames() {
        const size_t n = bvh_.frame_count;
        world_.resize(n), hips_.resize(n);
        for (FootTrack& f : foot_) f.ankle.resize(n), f.ball.resize(n), f.rotation.resize(n);
        BvhFrame source;
        Vec2 low(1e9f), high(-1e9f);
        for (size_t i = 0; i < n; ++i) {
            evaluate(bvh_, i, source);
            for (size_t b = 0; b < VFIT_BONE_COUNT; ++b)
                world_[i][b] = glm::normalize(source.rotation[size_t(joint_[b])] * correction_[b]);
            const Quat& pelvis = world_[i][VFIT_BONE_HIPS];
            // The middle of the hip joints is the same point in both bodies; the root is not.
            const Vec3 middle = (source.position[size_t(joint_[VFIT_BONE_LEFT_UPPER_LEG])] +
                                 source.position[size_t(joint_[VFIT_BONE_RIGHT_UPPER_LEG])]) *
                                0.5f;
            hips_[i] =
                middle * scale_ - pelvis * ((proportions_.leg[0].hip + proportions_.leg[1].hip) * 0.5f);
            low = glm::min(low, Vec2(hips_[i].x, hips_[i].z)),
            high = glm::max(high, Vec2(hips_[i].x, hips_[i].z));
        }
        const Vec2 middle = (low + high) * 0.5f;
        for (size_t i = 0; i < n; ++i) {
            hips_[i] -= Vec3(middle.x, 0, middle.y);
            for (const int side : {kLeft, kRight}) {
                const Leg& leg = proportions_.leg[size_t(side)];
                FootTrack& f = foot_[size_t(side)];
                f.rotation[i] = world_[i][size_t(leg_bone(side, 2))];
                f.ankle[i] = hips_[i] + world_[i][VFIT_BONE_HIPS] * leg.hip +
                             world_[i][size_t(leg_bone(side, 0))] * leg.thigh +
                             world_[i][size_t(leg_bone(side, 1))] * leg.shank;
                f.ball[i] = f.ankle[i] + f.rotation[i] * leg.foot;
            }
        }
    }

    // The file's floor is nowhere stated: it lies where the lower ankle of a frame usually is at rest.
    void ground() {
        std::vector<float> lower(hips_.size());
        for (size_t i = 0; i < lower.size(); ++i)
            lower[i] = std::min(foot_[0].ankle[i].y, foot_[1].ankle[i].y);
        auto median = lower.begin() + static_cast<std::ptrdiff_t>(lower.size() / 2);
        std::nth_element(lower.begin(), median, lower.end());
        const float down = *median - proportions_.ankle_height_m;
        for (size_t i = 0; i < hips_.size(); ++i) {
            hips_[i].y -= down;
            for (FootTrack& f : foot_) f.ankle[i].y -= down, f.ball[i].y -= down;
        }
    }

    // A swinging foot keeps ball and heel above the floor. The heel reaches back about a third of the way
    // from ankle to ball.
    void keep_above_floor(FootTrack& f) const {
        const Leg& leg = proportions_.leg[size_t(&f - foot_.data())];
        const float sole = -proportions_.ankle_height_m;
        const Vec3 ball(leg.foot.x, sole, leg.foot.z), heel(0, sole, -leg.foot.z / 3);
        for (size_t i = 0; i < f.ankle.size(); ++i) {
            const float lowest = std::min((f.rotation[i] * ball).y, (f.rotation[i] * heel).y);
            f.ankle[i].y = std::max(f.ankle[i].y, -lowest);
        }
    }

    // Lowers the hips where a leg cannot reach its foot. Largest need within a window, then the mean over the
    // same window: smooth, and never less than what is needed.
    void give_way() {
        const size_t n = hips_.size();
        std::vector<float> need(n, 0.0f), most(n);
        for (size_t i = 0; i < n; ++i) {
            for (const int side : {kLeft, kRight}) {
                const Leg& leg = proportions_.leg[size_t(side)];
                const Vec3 hip = hips_[i] + world_[i][VFIT_BONE_HIPS] * leg.hip,
                           &ankle = foot_[size_t(side)].ankle[i];
                const float reach = standing_reach_m(leg),
                            aside = glm::length(Vec2(ankle.x - hip.x, ankle.z - hip.z));
                const float limit = ankle.y + std::sqrt(std::max(0.0f, reach * reach - aside * aside));
                need[i] = std::max(need[i], hip.y - limit);
            }
        }
        const auto half = static_cast<size_t>(std::lround(kHipSmoothing_s / bvh_.frame_time_s));
        const auto window = [&](size_t i) {
            return std::pair(i > half ? i - half : 0, std::min(n, i + half + 1));
        };
        for (size_t i = 0; i < n; ++i) {
            const auto [a, b] = window(i);
            most[i] = *std::max_element(need.begin() + std::ptrdiff_t(a), need.begin() + std::ptrdiff_t(b));
        }
        for (size_t i = 0; i < n; ++i) {
            const auto [a, b] = window(i);
            float sum = 0;
            for (size_t k = a; k < b; ++k) sum += most[k];
            hips_[i].y -= sum / static_cast<float>(b - a);
        }
    }

    std::vector<BonePose> assemble() const {
        std::vector<BonePose> poses(hips_.size());
        for (size_t i = 0; i < poses.size(); ++i) {
            BonePose& pose = poses[i];
            const Rotations& world = world_[i];
            pose.hips = hips_[i];
            for (size_t b = 0; b < VFIT_BONE_COUNT; ++b) {
                const int parent = vfit_bone_parent(static_cast<vfit_bone_id>(b));
                pose.rotation[b] =
                    parent < 0 ? world[b] : glm::normalize(glm::conjugate(world[size_t(parent)]) * world[b]);
            }
            for (const int side : {kLeft, kRight}) {
                const Leg& leg = proportions_.leg[size_t(side)];
                const FootTrack& f = foot_[size_t(side)];
                const Vec3 hip = hips_[i] + world[VFIT_BONE_HIPS] * leg.hip;
                const Vec3 knee_forward = world[size_t(leg_bone(side, 0))] * Vec3(0, 0, 1);
                const Quat toes =
                    f.planted[i] ? f.rotation[i] : f.rotation[i] * pose.rotation[size_t(leg_bone(side, 3))];
                set_leg(pose.rotation, side, world[VFIT_BONE_HIPS],
                        reach_ankle(leg, hip, f.ankle[i], knee_forward), f.rotation[i], toes);
                pose.contact[size_t(side)] = f.planted[i] != 0;
                pose.rolls[size_t(side)] = f.rolls[i] != 0;
            }
        }
        return poses;
    }

    const Bvh& bvh_;
    const Proportions& proportions_;
    std::array<int, VFIT_BONE_COUNT> joint_{};
    Rotations correction_;
    float scale_ = 1;
    std::vector<Rotations> world_;
    std::vector<Vec3> hips_;
    std::array<FootTrack, 2> foot_;
};

// Played forwards and backwards in turn, so that the person never jumps.
class BvhMotion : public Motion {
public:
    BvhMotion(std::vector<BonePose> poses, double frame_time_s)
        : poses_(std::move(poses)), frame_time_s_(frame_time_s) {}

    BonePose at(double t) const override {
        const double last = static_cast<double>(poses_.size() - 1);
        if (last <= 0) return poses_.front();
        double frame = std::fmod(t / frame_time_s_, 2 * last);
        if (frame > last) frame = 2 * last - frame;
        const auto i = std::min(static_cast<size_t>(frame), poses_.size() - 2);
        const auto s = static_cast<float>(frame - static_cast<double>(i));
        const BonePose &a = poses_[i], &b = poses_[i + 1];
        BonePose pose;
        pose.hips = a.hips + (b.hips - a.hips) * s;
        for (size_t k = 0; k < pose.rotation.size(); ++k)
            pose.rotation[k] = glm::slerp(a.rotation[k], b.rotation[k], s);
        for (size_t side = 0; side < 2; ++side) {
            pose.contact[side] = a.contact[side] && b.contact[side];
            pose.rolls[side] = !pose.contact[side] && (a.contact[side] || a.rolls[side]) &&
                               (b.contact[side] || b.rolls[side]);
        }
        return pose;
    }

private:
    std::vector<BonePose> poses_;
    double frame_time_s_;
};

}  // namespace

std::unique_ptr<Motion> make_bvh_motion(const std::string& path, const Proportions& proportions) {
    const Bvh bvh = read_bvh(path);
    return std::make_unique<BvhMotion>(Retarget(bvh, path, proportions).run(), bvh.frame_time_s);
}

}  // namespace vfit::virtual_person
