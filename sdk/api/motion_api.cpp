// vfit.h, part "motion".
#include <cmath>

#include "api/avatar_object.h"
#include "api/bodies.h"
#include "api/guard.h"
#include "body/packed_pose.h"
#include "body/pose_bvh.h"
#include "body/pose_osc.h"
#include "motion/motion.h"

using namespace vfit;
using namespace vfit::api;

namespace {

struct MotionObject : ContextChild {
    static constexpr Kind kKind = Kind::motion;
    MotionObject(Ref<Context> owner, const MotionSettings& settings)
        : ContextChild(std::move(owner)), motion(settings) {}

    Motion motion;
    bool seen = false;  // somebody was there: the pose means something
};

MotionSettings motion_settings(const vfit_motion_desc& d) {
    check_flags(
        d.flags,
        VFIT_MOTION_NO_FILTER | VFIT_MOTION_NO_LIMITS | VFIT_MOTION_NO_SMOOTHING | VFIT_MOTION_NO_FEET,
        "desc.flags");
    MotionSettings s;
    s.flags = d.flags;
    s.filter.kind = d.filter;
    s.contact_rule = d.contact_rule;
    if (d.range_of_motion) s.range_of_motion = RangeOfMotion::read(d.range_of_motion, s.range_of_motion);
    HoltSettings& holt = s.filter.holt;
    holt.smoothing = setting(d.smoothing, holt.smoothing);
    holt.correction = setting(d.correction, holt.correction);
    holt.prediction = setting(d.prediction, holt.prediction);
    holt.jitter_radius_m = setting(d.jitter_radius_m, holt.jitter_radius_m);
    holt.max_deviation_radius_m = setting(d.max_deviation_radius_m, holt.max_deviation_radius_m);
    OneEuroSettings& euro = s.filter.one_euro;
    euro.min_cutoff_hz = setting(d.min_cutoff_hz, euro.min_cutoff_hz);
    euro.beta = setting(d.beta, euro.beta);
    euro.derivative_cutoff_hz = setting(d.derivative_cutoff_hz, euro.derivative_cutoff_hz);
    s.prediction_s = setting(d.prediction_s, s.prediction_s);
    s.rotation_divisor = setting(d.rotation_divisor, s.rotation_divisor);
    s.rotation_divisor_switched = setting(d.rotation_divisor_switched, s.rotation_divisor_switched);
    return s;
}

/// 0 is 1/30 s. The float that is nearest to one part of a second means exactly that.
double frame_time(float given_s) {
    constexpr double kDefaultRate_hz = 30.0;
    const double rate_hz = given_s == 0.0f ? kDefaultRate_hz : std::round(1.0 / double(given_s));
    return given_s == 0.0f || given_s == float(1.0 / rate_hz) ? 1.0 / rate_hz : double(given_s);
}

void require_pose(const MotionObject& motion) {
    if (!motion.seen) fail(VFIT_ERROR_STATE, "the motion has not seen a person yet");
}

}  // namespace

vfit_result vfit_motion_create(vfit_context handle, const vfit_motion_desc* desc, vfit_motion* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        const MotionSettings settings = motion_settings(read_or_default(desc, "desc"));
        out->id = context->publish(Kind::motion, make<MotionObject>(context.ref(), settings));
        return VFIT_OK;
    });
}

vfit_result vfit_motion_destroy(vfit_motion motion) {
    return guard([&] {
        destroy<MotionObject>(motion.id);
        return VFIT_OK;
    });
}

vfit_result vfit_motion_reset(vfit_motion handle) {
    return guard([&] {
        Use<MotionObject, Mode::exclusive> motion(handle.id);
        motion->motion.reset();
        motion->seen = false;
        return VFIT_OK;
    });
}

vfit_result vfit_motion_bind(vfit_motion handle, vfit_avatar avatar_handle) {
    return guard([&] {
        Use<MotionObject, Mode::exclusive> motion(handle.id);
        Use<AvatarObject, Mode::read> avatar(avatar_handle.id);
        motion->motion.bind(avatar->avatar.skeleton());
        return VFIT_OK;
    });
}

vfit_result vfit_motion_step(vfit_motion handle, vfit_frame tracked, uint32_t body_id, int64_t now_ns) {
    return guard([&]() -> vfit_result {
        Use<MotionObject, Mode::exclusive> motion(handle.id);
        Profile::Scope time(motion->context->profile, Stage::motion);
        bool there = true;
        if (tracked.id == 0) {
            motion->seen = motion->motion.step(nullptr, now_ns);
        } else {
            UseFrame frame(tracked);
            const Body* body = frame->body(body_id);
            there = body != nullptr;
            motion->seen = motion->motion.step(body, now_ns);
        }
        return there && motion->seen ? VFIT_OK : VFIT_NOT_READY;
    });
}

vfit_result vfit_motion_step_body(vfit_motion handle, const vfit_body* body, const vfit_joint* items,
                                  uint32_t stride, uint32_t count, int64_t now_ns) {
    return guard([&]() -> vfit_result {
        Use<MotionObject, Mode::exclusive> motion(handle.id);
        Profile::Scope time(motion->context->profile, Stage::motion);
        const vfit_body given = read(body, "body");
        if (given.flags & VFIT_BODY_CAMERA_SPACE)
            fail(VFIT_ERROR_ARGUMENT, "body ", given.body_id,
                 " is in camera space, and without a frame there is no camera: give world space, or use "
                 "vfit_tracker_submit");
        const Body in =
            body_in(given, Items<vfit_joint>(items, stride, count, "items"), motion->context->axes);
        motion->seen = motion->motion.step(&in, now_ns);
        return motion->seen ? VFIT_OK : VFIT_NOT_READY;
    });
}

vfit_result vfit_motion_pose(vfit_motion handle, vfit_pose* pose, vfit_bone* items, uint32_t stride,
                             uint32_t* count) {
    return guard([&] {
        Use<MotionObject, Mode::read> motion(handle.id);
        require_pose(*motion);
        if (pose) check_output(pose, "pose");
        const Axes& axes = motion->context->axes;
        const vfit_result result =
            write_bones(motion->motion.pose(), motion->motion.skeleton(), axes, items, stride, count);
        if (pose) write(pose, pose_out(motion->motion.pose(), axes));
        return result;
    });
}

vfit_result vfit_motion_joints(vfit_motion handle, vfit_joint* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        Use<MotionObject, Mode::read> motion(handle.id);
        require_pose(*motion);
        return write_joints(motion->motion.joints(), motion->context->axes, items, stride, count);
    });
}

vfit_result vfit_pose_pack(vfit_context handle, const vfit_pose* pose, const vfit_bone* items,
                           uint32_t stride, uint32_t count, void* bytes, uint32_t* byte_count) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        const auto packed = pack_pose(
            pose_in(read(pose, "pose"), Items<vfit_bone>(items, stride, count, "items"), context->axes));
        return write_bytes(packed.data(), packed.size(), bytes, byte_count);
    });
}

vfit_result vfit_pose_osc(vfit_context handle, const vfit_pose* pose, const vfit_bone* items, uint32_t stride,
                          uint32_t count, vfit_osc kind, void* bytes, uint32_t* byte_count) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        check_enum(kind, VFIT_OSC_VRCHAT, "kind");
        const Items<vfit_bone> bones(items, stride, count, "items");
        const Pose in = pose_in(read(pose, "pose"), bones, context->axes);
        const Skeleton skeleton = skeleton_in(bones, context->axes);
        const OscPacket packet =
            kind == VFIT_OSC_VMC ? vmc_packet(skeleton, in) : vrchat_packet(skeleton, in);
        return write_bytes(packet.bytes.data(), packet.size, bytes, byte_count);
    });
}

vfit_result vfit_pose_bvh(vfit_context handle, const vfit_pose* poses, uint32_t pose_stride,
                          uint32_t pose_count, const vfit_bone* items, uint32_t stride, uint32_t count,
                          float frame_time_s, char* text, uint32_t* capacity) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        check_pointer(capacity, "capacity");
        const Items<vfit_pose> infos(poses, pose_stride, pose_count, "poses");
        if (pose_count == 0) fail(VFIT_ERROR_ARGUMENT, "a motion without a pose");
        if (uint64_t(count) != uint64_t(pose_count) * VFIT_BONE_COUNT)
            fail(VFIT_ERROR_ARGUMENT, "count ", count, ": ", pose_count, " poses have ",
                 uint64_t(pose_count) * VFIT_BONE_COUNT, " bones");
        check_pointer(items, "items");
        const auto bones_of = [&](size_t i) {
            const auto* first = reinterpret_cast<const unsigned char*>(items) + i * VFIT_BONE_COUNT * stride;
            return Items<vfit_bone>(reinterpret_cast<const vfit_bone*>(first), stride, VFIT_BONE_COUNT,
                                    "items");
        };
        const auto pose = [&](size_t i) {
            const Items<vfit_bone> bones = bones_of(i);
            return BvhPose{pose_in(infos[static_cast<uint32_t>(i)], bones, context->axes),
                           skeleton_in(bones, context->axes)};
        };
        return write_whole_text(bvh_text(pose_count, pose, frame_time(frame_time_s)), text, capacity);
    });
}

vfit_result vfit_pose_unpack(vfit_context handle, const void* bytes, uint32_t byte_count, vfit_pose* pose,
                             vfit_bone* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        check_pointer(bytes, "bytes");
        if (pose) check_output(pose, "pose");
        const Pose unpacked = unpack_pose({static_cast<const uint8_t*>(bytes), byte_count});
        const vfit_result result = write_bones(unpacked, Skeleton(), context->axes, items, stride, count);
        if (pose) write(pose, pose_out(unpacked, context->axes));
        return result;
    });
}
