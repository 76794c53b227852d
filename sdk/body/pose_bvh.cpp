#include "body/pose_bvh.h"

#include <array>
#include <charconv>
#include <cmath>

#include "body/human_bone_name.h"
#include "core/error.h"
#include "math/euler.h"

namespace vfit {

namespace {

constexpr double kCentimetres = 100.0;
constexpr double kDegrees = 180.0 / 3.14159265358979323846;
constexpr double kMinFrame_s = 1e-3, kMaxFrame_s = 10.0;
constexpr int64_t kMaxFrames = 1'000'000;
// A last pose this much before its frame still makes one: rounding of the time stamps.
constexpr double kSlack_ns = 1000.0;

class Text {
public:
    void add(std::string_view text) { text_ += text; }
    void number(double value, int decimals) {
        char digits[40];
        const auto end =
            std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals);
        text_.append(digits, end.ptr);
    }
    void count(int64_t value) { text_ += std::to_string(value); }
    void triple(double x, double y, double z) {
        // A micrometre, and a ten thousandth of a degree.
        for (const double v : {x, y, z}) {
            text_ += text_.empty() || text_.back() == '\n' ? "" : " ";
            number(v, 4);
        }
    }
    void line(int depth, std::string_view text) {
        text_.append(size_t(depth), '\t');
        text_ += text;
        text_ += '\n';
    }
    void offset(int depth, const Vec3& metres) {
        text_.append(size_t(depth), '\t');
        text_ += "OFFSET";
        triple(kCentimetres * double(metres.x), kCentimetres * double(metres.y),
               kCentimetres * double(metres.z));
        text_ += '\n';
    }
    std::string take() { return std::move(text_); }

private:
    std::string text_;
};

/// How far the last bone of a chain is drawn: half of the bone before it, the way that it points in the
/// T-pose. It moves nothing.
Vec3 end_site(const Skeleton& skeleton, int bone) {
    const float length = 0.5f * glm::length(skeleton.offset[size_t(bone)]);
    switch (bone) {
        case VFIT_BONE_LEFT_HAND: return {length, 0, 0};
        case VFIT_BONE_RIGHT_HAND: return {-length, 0, 0};
        case VFIT_BONE_LEFT_TOES:
        case VFIT_BONE_RIGHT_TOES: return {0, 0, length};
        default: return {0, length, 0};
    }
}

/// Bones are listed depth first, so that the tree is written in one pass.
void write_hierarchy(Text& out, const Skeleton& skeleton) {
    std::array<int, kBoneCount> depth{};
    out.line(0, "HIERARCHY");
    for (int b = 0; b < kBoneCount; ++b) {
        const int parent = bone_parent(b);
        const int d = parent < 0 ? 0 : depth[size_t(parent)] + 1;
        depth[size_t(b)] = d;
        out.line(d, std::string(parent < 0 ? "ROOT " : "JOINT ").append(human_bone_name(b).view()));
        out.line(d, "{");
        out.offset(d + 1, parent < 0 ? Vec3(0.0f) : skeleton.offset[size_t(b)]);
        out.line(d + 1, parent < 0 ? "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation"
                                   : "CHANNELS 3 Zrotation Xrotation Yrotation");
        const int next = b + 1;
        if (next < kBoneCount && bone_parent(next) == b) continue;
        out.line(d + 1, "End Site");
        out.line(d + 1, "{");
        out.offset(d + 2, end_site(skeleton, b));
        out.line(d + 1, "}");
        const int next_depth = next < kBoneCount ? depth[size_t(bone_parent(next))] + 1 : 0;
        for (int open = d; open >= next_depth; --open) out.line(open, "}");
    }
}

Pose between(const Pose& a, const Pose& b, float share) {
    Pose out = a;
    out.hips_position = glm::mix(a.hips_position, b.hips_position, share);
    for (size_t i = 0; i < out.rotation.size(); ++i)
        out.rotation[i] = glm::slerp(a.rotation[i], b.rotation[i], share);
    return out;
}

Pose on_skeleton(const BvhPose& given, const Skeleton& skeleton) {
    Pose pose = given.pose;
    const PosedSkeleton was = forward_kinematics(given.skeleton, pose),
                        is = forward_kinematics(skeleton, pose);
    for (const size_t foot : {VFIT_BONE_LEFT_FOOT, VFIT_BONE_RIGHT_FOOT})
        pose.hips_position += 0.5f * (was.position[foot] - is.position[foot]);
    return pose;
}

/// From one time stamp to a later one; between any two it fits without a sign.
uint64_t span_ns(int64_t from_ns, int64_t to_ns) { return uint64_t(to_ns) - uint64_t(from_ns); }

/// The motion at any time after the first pose that does not decrease from one call to the next.
class Resampler {
public:
    Resampler(size_t count, const std::function<Pose(size_t)>& pose)
        : count_(count), pose_(pose), before_(pose(0)), after_(before_), start_ns_(before_.time_ns) {}

    Pose at(uint64_t since_start_ns) {
        while (span_ns(start_ns_, after_.time_ns) < since_start_ns && next_ < count_) {
            before_ = after_;
            after_ = pose_(next_++);
        }
        const uint64_t before_ns = span_ns(start_ns_, before_.time_ns),
                       after_ns = span_ns(start_ns_, after_.time_ns);
        if (since_start_ns >= after_ns) return after_;
        return between(before_, after_,
                       float(double(since_start_ns - before_ns) / double(after_ns - before_ns)));
    }

private:
    size_t count_, next_ = 1;
    const std::function<Pose(size_t)>& pose_;
    Pose before_, after_;
    int64_t start_ns_;
};

void write_frame(Text& out, const Pose& pose, std::array<EulerAngles, kBoneCount>& angles) {
    const Vec3& hips = pose.hips_position;
    out.triple(kCentimetres * double(hips.x), kCentimetres * double(hips.y), kCentimetres * double(hips.z));
    for (size_t b = 0; b < size_t(kBoneCount); ++b) {
        EulerAngles& a = angles[b];
        a = euler_zxy(pose.rotation[b], a);
        out.triple(kDegrees * a.z, kDegrees * a.x, kDegrees * a.y);
    }
    out.add("\n");
}

/// The time from the first pose to the last.
uint64_t length_ns(size_t pose_count, const std::function<Pose(size_t)>& pose) {
    const int64_t start_ns = pose(0).time_ns;
    int64_t last_ns = start_ns;
    for (size_t i = 1; i < pose_count; ++i) {
        const int64_t time_ns = pose(i).time_ns;
        if (time_ns <= last_ns)
            fail(VFIT_ERROR_DATA, "pose ", i, " of the motion is at ", time_ns,
                 " ns, not after the one before (", last_ns, " ns)");
        last_ns = time_ns;
    }
    return span_ns(start_ns, last_ns);
}

}  // namespace

std::string bvh_text(size_t pose_count, const std::function<BvhPose(size_t)>& given, double frame_time_s) {
    if (pose_count == 0) fail(VFIT_ERROR_ARGUMENT, "a motion without a pose");
    if (!(frame_time_s >= kMinFrame_s && frame_time_s <= kMaxFrame_s))
        fail(VFIT_ERROR_ARGUMENT, "frame_time_s ", frame_time_s, " is not in ", kMinFrame_s, "..",
             kMaxFrame_s);
    const Skeleton skeleton = given(pose_count - 1).skeleton;
    const std::function<Pose(size_t)> pose = [&](size_t i) { return on_skeleton(given(i), skeleton); };
    const double frame_ns = 1e9 * frame_time_s;
    const double frames = std::floor((double(length_ns(pose_count, pose)) + kSlack_ns) / frame_ns) + 1.0;
    if (frames > double(kMaxFrames))
        fail(VFIT_ERROR_ARGUMENT, "a motion of ", frames, " frames; at most ", kMaxFrames, " are written");
    Text out;
    write_hierarchy(out, skeleton);
    out.line(0, "MOTION");
    out.add("Frames: ");
    out.count(int64_t(frames));
    out.add("\nFrame Time: ");
    out.number(frame_time_s, 8);
    out.add("\n");
    Resampler motion(pose_count, pose);
    std::array<EulerAngles, kBoneCount> angles{};
    for (int64_t k = 0; k < int64_t(frames); ++k)
        write_frame(out, motion.at(uint64_t(std::llround(double(k) * frame_ns))), angles);
    return out.take();
}

}  // namespace vfit
