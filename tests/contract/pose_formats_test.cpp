// Poses for other programs, read as those would: packets of Open Sound Control, and BVH files. Joints alone
// go in.
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "contract/support.h"
#include "support/allocation_count.h"  // counted by carry_test.cpp
#include "support/bvh_reader.h"
#include "support/osc_reader.h"

using contract::ContextTest;
using vfit::test::about;
using vfit::test::Bvh;
using vfit::test::BvhPlace;
using vfit::test::Matrix;
using vfit::test::OscMessage;
using vfit::test::Point;
using vfit::test::product;

namespace {

constexpr double kMetreTolerance = 1e-5, kMatrixTolerance = 1e-5;

const char* const kHumanBodyBones[VFIT_BONE_COUNT] = {
    "Hips",          "Spine",         "Chest",        "UpperChest",   "Neck",          "Head",
    "LeftShoulder",  "LeftUpperArm",  "LeftLowerArm", "LeftHand",     "RightShoulder", "RightUpperArm",
    "RightLowerArm", "RightHand",     "LeftUpperLeg", "LeftLowerLeg", "LeftFoot",      "LeftToes",
    "RightUpperLeg", "RightLowerLeg", "RightFoot",    "RightToes"};

/// Of a quaternion x, y, z, w. The same numbers mean a rotation in a left-handed frame too.
template <typename Number>
Matrix matrix_of(const Number* q) {
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    return {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
            2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
            2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

double difference(const Matrix& a, const Matrix& b) {
    double worst = 0;
    for (size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

Point to_unity(const Point& p) { return {-p[0], p[1], p[2]}; }
Matrix to_unity(Matrix m) {
    for (const size_t i : {1u, 2u, 3u, 6u}) m[i] = -m[i];  // S M S with S = diag(-1, 1, 1)
    return m;
}

using Places = std::vector<BvhPlace>;

/// Each bone in the frame of its numbers, from local positions and rotations.
Places chained(const std::vector<BvhPlace>& local) {
    Places out = local;
    for (size_t b = 1; b < local.size(); ++b) {
        const BvhPlace& parent = out[size_t(vfit_bone_parent(int(b)))];
        const Point moved = product(parent.rotation, local[b].position);
        for (size_t i = 0; i < 3; ++i) out[b].position[i] = parent.position[i] + moved[i];
        out[b].rotation = product(parent.rotation, local[b].rotation);
    }
    return out;
}

Places places_of(const std::vector<vfit_bone>& bones) {
    std::vector<BvhPlace> local;
    for (const vfit_bone& b : bones)
        local.push_back({{b.position[0], b.position[1], b.position[2]}, matrix_of(b.rotation)});
    return chained(local);
}

/// A person of usual proportions in the T-pose.
std::vector<vfit_bone> t_pose() {
    constexpr float kOffsets[VFIT_BONE_COUNT][3] = {
        {0.2f, 0.95f, -2.0f}, {0, 0.12f, 0},     {0, 0.12f, 0},      {0, 0.13f, 0},  {0, 0.12f, 0},
        {0, 0.1f, 0},         {0.03f, 0.1f, 0},  {0.15f, 0, 0},      {0.3f, 0, 0},   {0.25f, 0, 0},
        {-0.03f, 0.1f, 0},    {-0.15f, 0, 0},    {-0.3f, 0, 0},      {-0.25f, 0, 0}, {0.08f, 0, 0},
        {0, -0.42f, 0},       {0, -0.42f, 0},    {0, -0.06f, 0.12f}, {-0.08f, 0, 0}, {0, -0.42f, 0},
        {0, -0.42f, 0},       {0, -0.06f, 0.12f}};
    std::vector<vfit_bone> bones;
    for (size_t b = 0; b < VFIT_BONE_COUNT; ++b) {
        vfit_bone bone = vfit_bone_init();
        bone.bone = int(b);
        bone.rotation[3] = 1.0f;
        std::copy_n(kOffsets[b], 3, bone.position);
        bones.push_back(bone);
    }
    return bones;
}

void turn(vfit_bone& bone, int axis, double degrees) {
    const double half = degrees * 3.14159265358979323846 / 360.0;
    std::fill_n(bone.rotation, 4, 0.0f);
    bone.rotation[axis] = float(std::sin(half));
    bone.rotation[3] = float(std::cos(half));
}

std::vector<vfit_bone> random_pose(uint32_t seed) {
    std::mt19937 bits(seed);
    std::normal_distribution<float> normal;
    std::vector<vfit_bone> bones = t_pose();
    for (vfit_bone& b : bones) {
        float length = 0.0f;
        for (float& q : b.rotation) q = normal(bits), length += q * q;
        for (float& q : b.rotation) q /= std::sqrt(length);
    }
    return bones;
}

class PoseFormats : public ContextTest {
protected:
    std::vector<OscMessage> osc(const std::vector<vfit_bone>& bones, vfit_osc kind, int64_t time_ns = 0) {
        vfit_pose pose = vfit_pose_init();
        pose.time_ns = time_ns;
        uint32_t size = 0;
        EXPECT_EQ(vfit_pose_osc(context, &pose, bones.data(), sizeof(vfit_bone), uint32_t(bones.size()), kind,
                                nullptr, &size),
                  VFIT_OK)
            << contract::last_error();
        std::vector<uint8_t> bytes(size);
        EXPECT_EQ(vfit_pose_osc(context, &pose, bones.data(), sizeof(vfit_bone), uint32_t(bones.size()), kind,
                                bytes.data(), &size),
                  VFIT_OK);
        EXPECT_LE(size, 2048u);
        return vfit::test::OscReader(bytes).bundle();
    }
    vfit_result try_osc(const std::vector<vfit_bone>& bones, vfit_osc kind = VFIT_OSC_VMC) {
        const vfit_pose pose = vfit_pose_init();
        uint32_t size = 0;
        return vfit_pose_osc(context, &pose, bones.data(), sizeof(vfit_bone), uint32_t(bones.size()), kind,
                             nullptr, &size);
    }
    vfit_result try_bvh(const std::vector<vfit_pose>& poses, const std::vector<vfit_bone>& bones,
                        float frame_time_s, std::string* text) {
        const auto call = [&](char* to, uint32_t* capacity) {
            return vfit_pose_bvh(context, poses.data(), sizeof(vfit_pose), uint32_t(poses.size()),
                                 bones.data(), sizeof(vfit_bone), uint32_t(bones.size()), frame_time_s, to,
                                 capacity);
        };
        uint32_t capacity = 0;
        const vfit_result result = call(nullptr, &capacity);
        if (result != VFIT_OK || !text) return result;
        text->assign(capacity, '?');
        uint32_t less = capacity - 1;
        EXPECT_EQ(call(text->data(), &less), VFIT_ERROR_CAPACITY);
        EXPECT_EQ(less, capacity);
        EXPECT_EQ(call(text->data(), &capacity), VFIT_OK) << contract::last_error();
        EXPECT_EQ(text->back(), '\0');
        text->pop_back();
        return VFIT_OK;
    }
    /// A motion of these poses at these times.
    std::string bvh(const std::vector<int64_t>& times_ns, const std::vector<std::vector<vfit_bone>>& motion,
                    float frame_time_s = 0.0f) {
        std::vector<vfit_pose> poses;
        std::vector<vfit_bone> bones;
        for (size_t i = 0; i < motion.size(); ++i) {
            poses.push_back(vfit_pose_init());
            poses.back().time_ns = times_ns[i];
            bones.insert(bones.end(), motion[i].begin(), motion[i].end());
        }
        std::string text;
        EXPECT_EQ(try_bvh(poses, bones, frame_time_s, &text), VFIT_OK) << contract::last_error();
        return text;
    }
};

Places vmc_places(const std::vector<OscMessage>& messages) {
    std::vector<BvhPlace> local;
    for (const OscMessage& m : messages) {
        if (m.address != "/VMC/Ext/Bone/Pos") continue;
        EXPECT_EQ(m.types, ",sfffffff");
        EXPECT_EQ(m.texts.at(0), kHumanBodyBones[local.size()]);
        local.push_back({{m.floats[0], m.floats[1], m.floats[2]}, matrix_of(&m.floats[3])});
    }
    return chained(local);
}

Point position_of(const std::vector<OscMessage>& messages, const std::string& tracker) {
    for (const OscMessage& m : messages)
        if (m.address == "/tracking/trackers/" + tracker + "/position")
            return {m.floats.at(0), m.floats.at(1), m.floats.at(2)};
    ADD_FAILURE() << tracker << " has no position";
    return {};
}

/// Degrees about X, Y and Z.
Point angles_of(const std::vector<OscMessage>& messages, const std::string& tracker) {
    for (const OscMessage& m : messages)
        if (m.address == "/tracking/trackers/" + tracker + "/rotation")
            return {m.floats.at(0), m.floats.at(1), m.floats.at(2)};
    ADD_FAILURE() << tracker << " has no rotation";
    return {};
}

Matrix unity_rotation(const Point& degrees) {
    // "performed around the Z axis, the X axis, and the Y axis, in that order" (Unity,
    // Transform.eulerAngles).
    return product(about('Y', degrees[1]), product(about('X', degrees[0]), about('Z', degrees[2])));
}

}  // namespace

TEST_F(PoseFormats, AVmcReceiverPutsEveryBoneWhereThePoseHasIt) {
    for (uint32_t seed = 0; seed < 20; ++seed) {
        const std::vector<vfit_bone> bones = random_pose(seed);
        const std::vector<OscMessage> messages = osc(bones, VFIT_OSC_VMC, 2'500'000'000);
        ASSERT_EQ(messages.size(), 3 + VFIT_BONE_COUNT);
        EXPECT_EQ(messages[0].address, "/VMC/Ext/Root/Pos");
        EXPECT_EQ(messages[0].texts.at(0), "root");
        for (size_t i = 0; i < 7; ++i) EXPECT_EQ(messages[0].floats.at(i), i == 6 ? 1.0f : 0.0f);
        EXPECT_EQ(messages[23].address, "/VMC/Ext/OK");
        EXPECT_EQ(messages[23].ints, std::vector<int32_t>{1});
        EXPECT_EQ(messages[24].address, "/VMC/Ext/T");
        EXPECT_FLOAT_EQ(messages[24].floats.at(0), 2.5f);
        const Places got = vmc_places(messages), wanted = places_of(bones);
        ASSERT_EQ(got.size(), wanted.size());
        for (size_t b = 0; b < got.size(); ++b) {
            EXPECT_LT(distance(got[b].position, to_unity(wanted[b].position)), kMetreTolerance) << b;
            EXPECT_LT(difference(got[b].rotation, to_unity(wanted[b].rotation)), kMatrixTolerance) << b;
        }
    }
}

TEST_F(PoseFormats, VrchatsTrackersAreWhereTheJointsAreAndTurnWithTheirBones) {
    struct Tracker {
        const char* name;
        size_t joint, bone;
    };
    constexpr Tracker kTrackers[] = {{"1", VFIT_BONE_HIPS, VFIT_BONE_HIPS},
                                     {"2", VFIT_BONE_UPPER_CHEST, VFIT_BONE_UPPER_CHEST},
                                     {"3", VFIT_BONE_LEFT_FOOT, VFIT_BONE_LEFT_FOOT},
                                     {"4", VFIT_BONE_RIGHT_FOOT, VFIT_BONE_RIGHT_FOOT},
                                     {"5", VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_LEFT_UPPER_LEG},
                                     {"6", VFIT_BONE_RIGHT_LOWER_LEG, VFIT_BONE_RIGHT_UPPER_LEG},
                                     {"7", VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_LEFT_UPPER_ARM},
                                     {"8", VFIT_BONE_RIGHT_LOWER_ARM, VFIT_BONE_RIGHT_UPPER_ARM},
                                     {"head", VFIT_BONE_HEAD, VFIT_BONE_HEAD}};
    for (uint32_t seed = 0; seed < 20; ++seed) {
        const std::vector<vfit_bone> bones = random_pose(seed);
        const std::vector<OscMessage> messages = osc(bones, VFIT_OSC_VRCHAT);
        EXPECT_EQ(messages.size(), 18u);
        const Places wanted = places_of(bones);
        for (const Tracker& t : kTrackers) {
            EXPECT_LT(distance(position_of(messages, t.name), to_unity(wanted[t.joint].position)),
                      kMetreTolerance)
                << t.name;
            EXPECT_LT(
                difference(unity_rotation(angles_of(messages, t.name)), to_unity(wanted[t.bone].rotation)),
                kMatrixTolerance)
                << t.name;
        }
    }
}

// In vfit the left is +X and a turn from +Z to +X is positive about Y; in Unity the left is -X, and a
// positive turn about Y goes from +Z to +X, to the right.
TEST_F(PoseFormats, AHeadThatTurnsNodsAndTiltsDoesSoInUnity) {
    const auto head = [&](int axis, double degrees) {
        std::vector<vfit_bone> bones = t_pose();
        turn(bones[VFIT_BONE_HEAD], axis, degrees);
        return angles_of(osc(bones, VFIT_OSC_VRCHAT), "head");
    };
    const auto expect = [](const Point& got, const Point& wanted) {
        for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], 1e-3) << i;
    };
    expect(head(1, 30.0), {0, -30, 0});  // turns to the left
    expect(head(0, 30.0), {30, 0, 0});   // looks down
    expect(head(2, -30.0), {0, 0, 30});  // tilts to the left shoulder
    const std::vector<OscMessage> still = osc(t_pose(), VFIT_OSC_VRCHAT);
    EXPECT_LT(position_of(still, "3")[0], position_of(still, "4")[0]) << "the left foot is at -X in Unity";
}

TEST_F(PoseFormats, PacketsAndFilesAreTheSameFromAnyAxes) {
    const std::vector<vfit_bone> bones = random_pose(5);
    const Places wanted = vmc_places(osc(bones, VFIT_OSC_VMC));
    const Bvh file(bvh({0}, {bones}));
    for (const vfit_axes axes : {VFIT_AXES_UNITY, VFIT_AXES_UNREAL})
        for (const uint32_t flags : {0u, uint32_t(VFIT_CONTEXT_MIRROR)}) {
            vfit_context_desc desc = contract::context_desc();
            desc.axes = axes;
            desc.flags = flags;
            vfit_context other{};
            ASSERT_EQ(vfit_context_create(&desc, &other), VFIT_OK);
            // What the other context's motion stage would give: the bones through a packet, and offsets.
            const vfit_pose pose = vfit_pose_init();
            std::vector<uint8_t> packet(128);
            uint32_t size = 128, count = VFIT_BONE_COUNT;
            ASSERT_EQ(
                vfit_pose_pack(context, &pose, bones.data(), sizeof(vfit_bone), 22, packet.data(), &size),
                VFIT_OK);
            std::vector<vfit_bone> theirs(VFIT_BONE_COUNT, vfit_bone_init());
            ASSERT_EQ(vfit_pose_unpack(other, packet.data(), size, nullptr, theirs.data(), sizeof(vfit_bone),
                                       &count),
                      VFIT_OK);
            for (size_t b = 1; b < VFIT_BONE_COUNT; ++b) {
                // In a mirror the left bone has the right one's numbers.
                size_t from = b;
                if (flags && b >= 6) from = (b - 6) / 4 % 2 == 0 ? b + 4 : b - 4;
                const float* p = bones[from].position;
                const float x = flags ? -p[0] : p[0];
                const float unity[3] = {-x, p[1], p[2]};
                const float unreal[3] = {100 * p[2], -100 * x, 100 * p[1]};
                std::copy_n(axes == VFIT_AXES_UNITY ? unity : unreal, 3, theirs[b].position);
            }
            std::swap(context, other);
            const Places got = vmc_places(osc(theirs, VFIT_OSC_VMC));
            const auto in_file = Bvh(bvh({0}, {theirs})).places(0);
            std::swap(context, other);
            for (size_t b = 0; b < got.size(); ++b) {
                // The packet above is exact to 0.1 degrees a bone.
                EXPECT_LT(distance(got[b].position, wanted[b].position), 0.01) << axes << flags << " " << b;
                EXPECT_LT(difference(got[b].rotation, wanted[b].rotation), 0.02) << axes << flags << " " << b;
                EXPECT_LT(distance(in_file.at(kHumanBodyBones[b]).position,
                                   file.places(0).at(kHumanBodyBones[b]).position),
                          1.0)
                    << axes << flags << " " << b;
            }
            EXPECT_EQ(vfit_context_destroy(other), VFIT_OK);
        }
}

TEST_F(PoseFormats, IncompletePosesAreRefused) {
    for (const vfit_osc kind : {VFIT_OSC_VMC, VFIT_OSC_VRCHAT}) {
        std::vector<vfit_bone> missing = t_pose(), broken = t_pose(), bare = t_pose(), endless = t_pose();
        missing.erase(missing.begin() + VFIT_BONE_LEFT_FOOT);
        broken[4].rotation[1] = std::numeric_limits<float>::quiet_NaN();
        endless[4].position[1] = std::numeric_limits<float>::infinity();
        for (size_t b = 1; b < bare.size(); ++b) std::fill_n(bare[b].position, 3, 0.0f);
        EXPECT_EQ(try_osc(missing, kind), VFIT_ERROR_DATA);
        EXPECT_NE(contract::last_error().find("leftFoot"), std::string::npos) << contract::last_error();
        EXPECT_EQ(try_osc(broken, kind), VFIT_ERROR_DATA);
        EXPECT_EQ(try_osc(endless, kind), VFIT_ERROR_DATA);
        EXPECT_EQ(try_osc(bare, kind), VFIT_ERROR_DATA);
        EXPECT_NE(contract::last_error().find("vfit_pose_unpack"), std::string::npos);
        EXPECT_EQ(try_osc({}, kind), VFIT_ERROR_DATA);
    }
    EXPECT_EQ(try_osc(t_pose(), 2), VFIT_ERROR_ARGUMENT);
    const vfit_pose pose = vfit_pose_init();
    const std::vector<vfit_bone> bones = t_pose();
    uint8_t small[64];
    uint32_t size = sizeof small;
    EXPECT_EQ(vfit_pose_osc(context, &pose, bones.data(), sizeof(vfit_bone), 22, VFIT_OSC_VMC, small, &size),
              VFIT_ERROR_CAPACITY);
    EXPECT_GT(size, 1000u);
}

TEST_F(PoseFormats, APacketIsMadeWithoutAnAllocation) {
    const vfit_pose pose = vfit_pose_init();
    const std::vector<vfit_bone> bones = random_pose(3);
    std::vector<uint8_t> bytes(2048);
    for (const vfit_osc kind : {VFIT_OSC_VMC, VFIT_OSC_VRCHAT}) {
        const uint64_t before = vfit::test::allocations;
        uint32_t size = 2048;
        const vfit_result result =
            vfit_pose_osc(context, &pose, bones.data(), sizeof(vfit_bone), 22, kind, bytes.data(), &size);
        EXPECT_EQ(vfit::test::allocations - before, 0u);
        EXPECT_EQ(result, VFIT_OK);
    }
}

TEST_F(PoseFormats, ABvhReaderPutsEveryJointWhereThePoseHasIt) {
    std::vector<std::vector<vfit_bone>> motion;
    std::vector<int64_t> times;
    for (uint32_t i = 0; i < 12; ++i) {
        motion.push_back(random_pose(i));
        times.push_back(7'000'000'000 + int64_t(i) * 20'000'000);
    }
    const Bvh file(bvh(times, motion, 0.02f));
    ASSERT_EQ(file.frame_count, motion.size());
    EXPECT_EQ(file.frame_time_s, 0.02) << "0.02f means a fiftieth";
    ASSERT_EQ(file.joints.size(), size_t(VFIT_BONE_COUNT));
    for (size_t b = 0; b < file.joints.size(); ++b) {
        EXPECT_EQ(file.joints[b].name, kHumanBodyBones[b]);
        EXPECT_EQ(file.joints[b].parent, vfit_bone_parent(int(b)));
        EXPECT_EQ(file.joints[b].channels.size(), b == 0 ? 6u : 3u);
        const bool last = b == 5 || b == 9 || b == 13 || b == 17 || b == 21;
        EXPECT_EQ(file.joints[b].ends, last ? 1 : 0) << b;
    }
    for (size_t f = 0; f < motion.size(); ++f) {
        const auto got = file.places(f);
        const Places wanted = places_of(motion[f]);
        for (size_t b = 0; b < wanted.size(); ++b) {
            Point centimetres = wanted[b].position;
            for (double& v : centimetres) v *= 100.0;
            EXPECT_LT(distance(got.at(kHumanBodyBones[b]).position, centimetres), 0.01) << f << " " << b;
            EXPECT_LT(difference(got.at(kHumanBodyBones[b]).rotation, wanted[b].rotation), 1e-4)
                << f << " " << b;
        }
    }
}

TEST_F(PoseFormats, AMotionIsResampledByTime) {
    // Hips that move at 1 m/s and a head that turns by 90 degrees a second, seen at uneven times.
    const std::vector<int64_t> times = {0, 10'000'000, 45'000'000, 160'000'000, 161'000'000, 300'000'000};
    std::vector<std::vector<vfit_bone>> motion;
    for (const int64_t t : times) {
        motion.push_back(t_pose());
        motion.back()[0].position[0] = float(1e-9 * double(t));
        turn(motion.back()[VFIT_BONE_HEAD], 1, 90e-9 * double(t));
    }
    const Bvh file(bvh(times, motion));
    EXPECT_NEAR(file.frame_time_s, 1.0 / 30.0, 1e-8);
    ASSERT_EQ(file.frame_count, 10u);
    for (size_t f = 0; f < file.frame_count; ++f) {
        const double t = double(f) / 30.0;
        EXPECT_NEAR(file.frames[f][0], 100.0 * t, 1e-3) << f;
        EXPECT_LT(difference(file.places(f).at("Head").rotation, about('Y', 90.0 * t)), 1e-5) << f;
    }
    EXPECT_EQ(Bvh(bvh({5}, {t_pose()})).frame_count, 1u);
    EXPECT_EQ(Bvh(bvh({5}, {t_pose()}, 1.0f / 30.0f)).frame_time_s, 0.03333333)
        << "1.0f / 30.0f means a thirtieth";
}

TEST_F(PoseFormats, TheSkeletonOfAFileIsThatOfTheLastPoseAndTheFeetStay) {
    std::vector<vfit_bone> first = t_pose(), last = t_pose();
    turn(first[VFIT_BONE_LEFT_UPPER_LEG], 0, -40.0);
    turn(first[VFIT_BONE_RIGHT_UPPER_LEG], 0, -40.0);
    last[VFIT_BONE_LEFT_LOWER_ARM].position[0] = 0.31f;
    for (const size_t knee : {VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_RIGHT_LOWER_LEG})
        last[knee].position[1] = -0.45f;
    const Bvh file(bvh({0, 40'000'000}, {first, last}));
    EXPECT_NEAR(file.joints[VFIT_BONE_LEFT_LOWER_ARM].offset[0], 31.0, 1e-3);
    EXPECT_NEAR(file.joints[VFIT_BONE_LEFT_LOWER_LEG].offset[1], -45.0, 1e-3);
    const Places wanted = places_of(first);
    const auto got = file.places(0);
    for (const size_t foot : {VFIT_BONE_LEFT_FOOT, VFIT_BONE_RIGHT_FOOT}) {
        Point centimetres = wanted[foot].position;
        for (double& v : centimetres) v *= 100.0;
        EXPECT_LT(distance(got.at(kHumanBodyBones[foot]).position, centimetres), 0.01) << foot;
    }
}

TEST_F(PoseFormats, MotionsThatAreNoneAreRefused) {
    const auto motion = [&](const std::vector<int64_t>& times, float frame_time_s, size_t less = 0) {
        std::vector<vfit_pose> poses;
        std::vector<vfit_bone> bones;
        for (const int64_t t : times) {
            poses.push_back(vfit_pose_init());
            poses.back().time_ns = t;
            const std::vector<vfit_bone> pose = t_pose();
            bones.insert(bones.end(), pose.begin(), pose.end());
        }
        bones.resize(bones.size() - less);
        return try_bvh(poses, bones, frame_time_s, nullptr);
    };
    constexpr int64_t kSecond = 1'000'000'000;
    EXPECT_EQ(motion({0, kSecond}, 0.0f), VFIT_OK);
    EXPECT_EQ(motion({}, 0.0f), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(motion({0, kSecond}, 0.0f, 1), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("44"), std::string::npos) << contract::last_error();
    EXPECT_EQ(motion({0, kSecond, kSecond}, 0.0f), VFIT_ERROR_DATA);
    EXPECT_NE(contract::last_error().find("pose 2"), std::string::npos) << contract::last_error();
    EXPECT_EQ(motion({kSecond, 0}, 0.0f), VFIT_ERROR_DATA);
    for (const float frame : {-1.0f, 1e-6f, 60.0f, std::numeric_limits<float>::quiet_NaN()})
        EXPECT_EQ(motion({0, kSecond}, frame), VFIT_ERROR_ARGUMENT) << frame;
    EXPECT_EQ(motion({0, 1'000'000 * kSecond}, 0.001f), VFIT_ERROR_ARGUMENT) << "a billion frames";
    EXPECT_EQ(motion({INT64_MIN, INT64_MAX}, 0.001f), VFIT_ERROR_ARGUMENT) << "a span beyond 64 bits";
}

TEST_F(PoseFormats, JointsAloneMoveTheStageAsAFramesDo) {
    contract::HostImage image;
    const vfit_frame_desc desc = image.desc();
    vfit_tracker_desc unfiltered = vfit_tracker_desc_init();
    unfiltered.filter = VFIT_FILTER_OFF;
    vfit_tracker tracker{};
    vfit_motion by_frame{}, by_joints{};
    ASSERT_EQ(vfit_tracker_create(context, &unfiltered, &tracker), VFIT_OK);
    ASSERT_EQ(vfit_motion_create(context, nullptr, &by_frame), VFIT_OK);
    ASSERT_EQ(vfit_motion_create(context, nullptr, &by_joints), VFIT_OK);
    for (int i = 0; i < 20; ++i) {
        std::vector<vfit_joint> joints = contract::standing_joints();
        for (vfit_joint& j : joints) j.position[0] += 0.01f * float(i);
        vfit_body body = vfit_body_init();
        body.body_id = 1;
        body.time_ns = 1'000'000'000 + i * 33'000'000;
        vfit_frame frame{}, tracked{};
        ASSERT_EQ(vfit_frame_create(context, &desc, &frame), VFIT_OK) << contract::last_error();
        ASSERT_EQ(vfit_tracker_submit(tracker, frame, &body, joints.data(), sizeof(vfit_joint),
                                      uint32_t(joints.size()), &tracked),
                  VFIT_OK)
            << contract::last_error();
        ASSERT_EQ(vfit_motion_step(by_frame, tracked, 1, body.time_ns), VFIT_OK);
        ASSERT_EQ(vfit_motion_step_body(by_joints, &body, joints.data(), sizeof(vfit_joint),
                                        uint32_t(joints.size()), body.time_ns),
                  VFIT_OK)
            << contract::last_error();
        std::vector<vfit_bone> a(VFIT_BONE_COUNT), b(VFIT_BONE_COUNT);
        uint32_t n = VFIT_BONE_COUNT;
        ASSERT_EQ(vfit_motion_pose(by_frame, nullptr, a.data(), sizeof(vfit_bone), &n), VFIT_OK);
        ASSERT_EQ(vfit_motion_pose(by_joints, nullptr, b.data(), sizeof(vfit_bone), &n), VFIT_OK);
        EXPECT_EQ(std::memcmp(a.data(), b.data(), sizeof(vfit_bone) * a.size()), 0) << i;
        vfit_frame_release(tracked);
        vfit_frame_release(frame);
    }
}

TEST_F(PoseFormats, JointsThatTellNoPersonAreRefusedOrNotReady) {
    vfit_motion motion{};
    ASSERT_EQ(vfit_motion_create(context, nullptr, &motion), VFIT_OK);
    std::vector<vfit_joint> joints = contract::standing_joints();
    vfit_body body = vfit_body_init();
    body.body_id = 1;
    const auto step = [&](const vfit_body* who, uint32_t count) {
        return vfit_motion_step_body(motion, who, joints.data(), sizeof(vfit_joint), count, 5);
    };
    EXPECT_EQ(step(nullptr, 15), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(step(&body, 0), VFIT_ERROR_ARGUMENT);
    EXPECT_EQ(step(&body, 1), VFIT_NOT_READY) << "a head has no trunk";
    vfit_body seen_by_a_camera = body;
    seen_by_a_camera.flags = VFIT_BODY_CAMERA_SPACE;
    EXPECT_EQ(step(&seen_by_a_camera, 15), VFIT_ERROR_ARGUMENT);
    EXPECT_NE(contract::last_error().find("camera"), std::string::npos);
    body.time_ns = 10;
    EXPECT_EQ(step(&body, 15), VFIT_OK) << contract::last_error();
    joints[3].position[1] = std::numeric_limits<float>::quiet_NaN();
    body.time_ns = 20;
    EXPECT_EQ(step(&body, 15), VFIT_ERROR_DATA);
}
