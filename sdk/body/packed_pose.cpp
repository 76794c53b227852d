#include "body/packed_pose.h"

#include <cmath>

#include "core/bits.h"
#include "math/finite.h"

namespace vfit {

namespace {

constexpr uint64_t kPoseVersion = 1;
constexpr int kPoseVersionBits = 8, kContactBits = 2, kTimeBits = 64, kHipsBits = 24, kLargestBits = 2,
              kPartBits = 11;
constexpr float kHipsStep_m = 1e-4f;
constexpr int64_t kHipsMiddle = int64_t(1) << (kHipsBits - 1);
constexpr float kPackedReach_m = 800.0f;
constexpr float kHalfRoot = 0.70710678f;  // no part but the largest is larger
constexpr int kBits =
    kPoseVersionBits + kContactBits + kTimeBits + 3 * kHipsBits + kBoneCount * (kLargestBits + 3 * kPartBits);
static_assert((kBits + 7) / 8 == kPackedPoseBytes);

void put_rotation(BitWriter& out, const Quat& q) {
    const float part[4] = {q.x, q.y, q.z, q.w};
    int largest = 0;
    for (int i = 1; i < 4; ++i)
        if (std::abs(part[i]) > std::abs(part[largest])) largest = i;
    // q and -q are one rotation: the largest part is sent as a positive one, and left out.
    const float sign = part[largest] < 0.0f ? -1.0f : 1.0f;
    out.put(uint64_t(largest), kLargestBits);
    for (int i = 0; i < 4; ++i)
        if (i != largest) out.put_in_range(sign * part[i], -kHalfRoot, kHalfRoot, kPartBits);
}

Quat get_rotation(BitReader& in) {
    const int largest = int(in.get(kLargestBits));
    float part[4], sum = 0.0f;
    for (int i = 0; i < 4; ++i) {
        if (i == largest) continue;
        part[i] = in.get_in_range(-kHalfRoot, kHalfRoot, kPartBits);
        sum += part[i] * part[i];
    }
    part[largest] = std::sqrt(std::fmax(0.0f, 1.0f - sum));
    return glm::normalize(Quat(part[3], part[0], part[1], part[2]));
}

}  // namespace

std::array<uint8_t, kPackedPoseBytes> pack_pose(const Pose& pose) {
    if (!finite(pose.hips_position)) fail(VFIT_ERROR_DATA, "the pose's hips position is not finite");
    for (int i = 0; i < 3; ++i)
        if (std::abs(pose.hips_position[i]) > kPackedReach_m)
            fail(VFIT_ERROR_DATA, "the hips are ", pose.hips_position[i],
                 " m from the origin; a packed pose reaches ", kPackedReach_m, " m");
    std::array<uint8_t, kPackedPoseBytes> bytes;
    BitWriter out(bytes);
    out.put(kPoseVersion, kPoseVersionBits);
    out.put(pose.contacts, kContactBits);
    out.put(uint64_t(pose.time_ns), kTimeBits);
    for (int i = 0; i < 3; ++i)
        out.put(uint64_t(kHipsMiddle + std::lround(pose.hips_position[i] / kHipsStep_m)), kHipsBits);
    for (int b = 0; b < kBoneCount; ++b) {
        const Quat& q = pose.rotation[size_t(b)];
        if (!finite(q) || std::abs(glm::dot(q, q) - 1.0f) > 0.01f)
            fail(VFIT_ERROR_DATA, "the rotation of bone ", bone_name(b),
                 " is not finite or not of unit length");
        put_rotation(out, q);
    }
    return bytes;
}

Pose unpack_pose(std::span<const uint8_t> bytes) {
    BitReader in(bytes);
    if (const uint64_t version = in.get(kPoseVersionBits); version != kPoseVersion)
        fail(VFIT_ERROR_VERSION, "a packed pose of version ", version, ", this library reads version ",
             kPoseVersion);
    if (bytes.size() != kPackedPoseBytes)
        fail(VFIT_ERROR_DATA, "a packed pose has ", kPackedPoseBytes, " bytes, not ", bytes.size());
    Pose pose;
    pose.contacts = uint32_t(in.get(kContactBits));
    pose.time_ns = int64_t(in.get(kTimeBits));
    for (int i = 0; i < 3; ++i)
        pose.hips_position[i] = kHipsStep_m * float(int64_t(in.get(kHipsBits)) - kHipsMiddle);
    for (Quat& q : pose.rotation) q = get_rotation(in);
    return pose;
}

}  // namespace vfit
