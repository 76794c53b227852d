#include "body/pose_osc.h"

#include <array>

#include "body/human_bone_name.h"
#include "core/osc_writer.h"
#include "math/euler.h"

namespace vfit {

namespace {

// X is mirrored. A rotation's axis is a pseudo-vector: the reflection turns it about as well.
Vec3 to_unity(const Vec3& p) { return {-p.x, p.y, p.z}; }
Quat to_unity(const Quat& q) { return Quat(q.w, q.x, -q.y, -q.z); }

void put(OscWriter& out, const Vec3& v) {
    for (int i = 0; i < 3; ++i) out.put(v[i]);
}

void put_transform(OscWriter& out, const char* address, std::string_view name, const Vec3& position,
                   const Quat& rotation) {
    out.begin(address, "sfffffff");
    out.put(name);
    put(out, to_unity(position));
    const Quat q = to_unity(rotation);
    put(out, Vec3(q.x, q.y, q.z));
    out.put(q.w);
}

/// A tracker: the joint that it is at, and the bone that it is strapped to.
struct Tracker {
    const char* name;
    int joint, bone;
};

// Numbers are free; VRChat finds out by their places which tracker is which. A knee is held by the thigh, an
// elbow by the upper arm ("elbows (upper arms)").
constexpr Tracker kTrackers[] = {
    {"1", VFIT_BONE_HIPS, VFIT_BONE_HIPS},
    {"2", VFIT_BONE_UPPER_CHEST, VFIT_BONE_UPPER_CHEST},
    {"3", VFIT_BONE_LEFT_FOOT, VFIT_BONE_LEFT_FOOT},
    {"4", VFIT_BONE_RIGHT_FOOT, VFIT_BONE_RIGHT_FOOT},
    {"5", VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_LEFT_UPPER_LEG},
    {"6", VFIT_BONE_RIGHT_LOWER_LEG, VFIT_BONE_RIGHT_UPPER_LEG},
    {"7", VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_LEFT_UPPER_ARM},
    {"8", VFIT_BONE_RIGHT_LOWER_ARM, VFIT_BONE_RIGHT_UPPER_ARM},
    {"head", VFIT_BONE_HEAD, VFIT_BONE_HEAD},
};

void begin_tracker(OscWriter& out, const char* name, std::string_view what) {
    std::array<char, 48> address;
    size_t n = 0;
    for (const std::string_view part :
         {std::string_view("/tracking/trackers/"), std::string_view(name), what})
        n += part.copy(address.data() + n, address.size() - n);
    out.begin({address.data(), n}, "fff");
}

}  // namespace

OscPacket vmc_packet(const Skeleton& skeleton, const Pose& pose) {
    OscPacket packet;
    OscWriter out(packet.bytes);
    // The root stays at the origin on the floor: the hips carry the person.
    put_transform(out, "/VMC/Ext/Root/Pos", "root", Vec3(0.0f), Quat(1, 0, 0, 0));
    for (int b = 0; b < kBoneCount; ++b) {
        const auto i = static_cast<size_t>(b);
        const Vec3& position = b == VFIT_BONE_HIPS ? pose.hips_position : skeleton.offset[i];
        put_transform(out, "/VMC/Ext/Bone/Pos", human_bone_name(b).view(), position, pose.rotation[i]);
    }
    // Behind the bones, as the protocol's own samples have it: some receivers show the pose when these come.
    out.begin("/VMC/Ext/OK", "i");
    out.put(int32_t(1));  // loaded: bones are sent
    out.begin("/VMC/Ext/T", "f");
    out.put(float(1e-9 * double(pose.time_ns)));
    packet.size = out.finish();
    return packet;
}

OscPacket vrchat_packet(const Skeleton& skeleton, const Pose& pose) {
    constexpr float kDegrees = 180.0f / kPi;
    const PosedSkeleton posed = forward_kinematics(skeleton, pose);
    OscPacket packet;
    OscWriter out(packet.bytes);
    for (const Tracker& tracker : kTrackers) {
        begin_tracker(out, tracker.name, "/position");
        put(out, to_unity(posed.position[static_cast<size_t>(tracker.joint)]));
        const EulerAngles a = euler_yxz(to_unity(posed.rotation[static_cast<size_t>(tracker.bone)]));
        begin_tracker(out, tracker.name, "/rotation");
        put(out, kDegrees * Vec3(a.x, a.y, a.z));
    }
    packet.size = out.finish();
    return packet;
}

}  // namespace vfit
