#include "client/fitting.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace vfit::tools {

namespace {

constexpr double kClothStep_s = 1.0 / 60.0;
// Before the first frame the garment hangs for a while, so that it does not fall into the picture: first on a
// body that stands straight with its arms held out, which then moves into the pose. Put on in the pose, a skirt
// would start between two legs that step, or around a hand.
constexpr int kHangSteps = 30, kMoveSteps = 45, kSettleSteps = 15;
constexpr float kArmsOut_rad = 0.9f;  // of the upper arms below the T-pose's level

double seconds(int64_t ns) { return double(ns) * 1e-9; }

/// A turn about Z.
void set_turn(float (&q)[4], float angle) {
    q[0] = q[1] = 0.0f;
    q[2] = std::sin(0.5f * angle);
    q[3] = std::cos(0.5f * angle);
}

/// From rotation a to b on the short way: normalised linear blend.
void blend(float (&a)[4], const float (&b)[4], float t) {
    float dot = 0.0f, length2 = 0.0f, out[4];
    for (int i = 0; i < 4; ++i) dot += a[i] * b[i];
    for (int i = 0; i < 4; ++i) {
        out[i] = a[i] * (1.0f - t) + (dot < 0.0f ? -b[i] : b[i]) * t;
        length2 += out[i] * out[i];
    }
    for (int i = 0; i < 4; ++i) a[i] = out[i] / std::sqrt(length2);
}

/// That share of the way from standing straight, arms held out, to the pose; hips stay where they are.
std::vector<vfit_bone> on_the_way(std::vector<vfit_bone> bones, float share) {
    for (vfit_bone& bone : bones) {
        if (bone.bone == VFIT_BONE_HIPS) continue;
        const float turn = bone.bone == VFIT_BONE_LEFT_UPPER_ARM    ? -kArmsOut_rad
                           : bone.bone == VFIT_BONE_RIGHT_UPPER_ARM ? kArmsOut_rad
                                                                      : 0.0f;
        float straight[4];
        set_turn(straight, turn);
        blend(straight, bone.rotation, share);
        std::copy(std::begin(straight), std::end(straight), bone.rotation);
    }
    return bones;
}

}  // namespace

Fitting::Fitting(vfit_context context, const FittingOptions& options) : context_(context), options_(options) {
    Source source(context, options.source);
    scan_ = run_scan(context, source, options.scan, &scan_frame_);
    const auto start = std::chrono::steady_clock::now();
    dress();
    dress_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    const SizeChart chart = open_chart(context, options.chart);
    sizes_ = sizes_json(chart.get(), garment_kind_, measurements_of(scan_.scan.get()));
}

void Fitting::dress() {
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.sex = options_.scan.sex;
    desc.detail = options_.detail;
    check(vfit_avatar_create_from_scan(context_, &desc, scan_.scan.get(), avatar_.out()));
    check(vfit_garment_open(context_, options_.garment.c_str(), garment_.out()));
    vfit_garment_info info = vfit_garment_info_init();
    check(vfit_garment_describe(garment_.get(), &info));
    garment_kind_ = info.garment_kind;
    check(vfit_motion_create(context_, nullptr, motion_.out()));
    check(vfit_motion_bind(motion_.get(), avatar_.get()));
    const vfit_view depth = view_of(scan_frame_.get(), VFIT_STREAM_DEPTH);
    check(vfit_motion_step(motion_.get(), scan_frame_.get(), scan_.body_id, depth.time_ns));
    pose_avatar(1.0f);
    vfit_cloth_desc cloth = vfit_cloth_desc_init();
    cloth.flags = options_.hands ? 0 : VFIT_CLOTH_NO_HANDS;
    if (!options_.size.empty()) cloth.size_label = options_.size.c_str();
    check(vfit_cloth_create(avatar_.get(), garment_.get(), &cloth, cloth_.out()));
    Frame body, garment;
    check(vfit_avatar_acquire(avatar_.get(), body.out()));
    check(vfit_cloth_acquire(cloth_.get(), garment.out()));
}

std::vector<vfit_bone> Fitting::bones(vfit_pose& pose) const {
    return list<vfit_bone>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_motion_pose(motion_.get(), &pose, items, stride, n);
    });
}

void Fitting::pose_avatar(float share) {
    vfit_pose pose = vfit_pose_init();
    const auto posed = on_the_way(bones(pose), share);
    check(vfit_avatar_pose(avatar_.get(), &pose, posed.data(), sizeof(vfit_bone), static_cast<uint32_t>(posed.size())));
}

void Fitting::settle() {
    pose_avatar(0.0f);
    check(vfit_cloth_reset(cloth_.get()));
    for (int i = 0; i < kHangSteps + kMoveSteps + kSettleSteps; ++i) {
        pose_avatar(std::clamp(float(i - kHangSteps) / kMoveSteps, 0.0f, 1.0f));
        check(vfit_cloth_step(cloth_.get(), float(kClothStep_s)));
    }
}

void Fitting::play(const std::function<void(vfit_frame, double)>& on_frame) {
    Source source(context_, options_.source);
    Tracker tracker;
    check(vfit_tracker_create(context_, nullptr, tracker.out()));
    check(vfit_motion_reset(motion_.get()));
    int64_t first_ns = 0;
    double cloth_time = 0.0;
    uint32_t body = 0;
    while (const auto frame = source.next()) {
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        if (body == 0) body = first_body(tracked.get());
        const int64_t now_ns = view_of(tracked.get(), VFIT_STREAM_DEPTH).time_ns;
        if (check(vfit_motion_step(motion_.get(), tracked.get(), body, now_ns)) == VFIT_OK) {
            if (frames_played_++ == 0) {
                first_ns = now_ns;
                settle();
            }
            pose_avatar(1.0f);
            const double time = seconds(now_ns - first_ns);
            for (; cloth_time < time; cloth_time += kClothStep_s) check(vfit_cloth_step(cloth_.get(), float(kClothStep_s)));
            on_frame(tracked.get(), time);
        }
        if (options_.max_frames && frames_played_ == options_.max_frames) break;
    }
    if (frames_played_ == 0) throw Failure("nobody was in view while the source played");
}

}  // namespace vfit::tools
