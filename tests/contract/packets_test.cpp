// Poses and bodies as packets for the network, and skin written into the host's own memory.
#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "contract/support.h"

using contract::ContextTest;

namespace {

vfit_bone make_bone(vfit_bone_id id, std::mt19937& bits) {
    std::normal_distribution<float> normal;
    vfit_bone b = vfit_bone_init();
    b.bone = id;
    float length = 0.0f;
    for (float& q : b.rotation) {
        q = normal(bits);
        length += q * q;
    }
    for (float& q : b.rotation) q /= std::sqrt(length);
    for (float& p : b.position) p = normal(bits);
    return b;
}

std::vector<vfit_bone> random_bones(uint32_t seed) {
    std::mt19937 bits(seed);
    std::vector<vfit_bone> bones;
    for (vfit_bone_id b = 0; b < vfit_bone_id(VFIT_BONE_COUNT); ++b) bones.push_back(make_bone(b, bits));
    return bones;
}

double degrees_between(const vfit_bone& a, const vfit_bone& b) {
    double dot = 0.0;
    for (int i = 0; i < 4; ++i) dot += double(a.rotation[i]) * double(b.rotation[i]);
    return 2.0 * std::acos(std::min(1.0, std::abs(dot))) * 180.0 / 3.14159265358979;
}

class PacketTest : public ContextTest {
protected:
    std::vector<uint8_t> pack(const std::vector<vfit_bone>& bones, const vfit_pose& pose, vfit_context in) {
        uint32_t count = 0;
        EXPECT_EQ(vfit_pose_pack(in, &pose, bones.data(), sizeof(vfit_bone), uint32_t(bones.size()), nullptr,
                                 &count),
                  VFIT_OK)
            << contract::last_error();
        EXPECT_LE(count, 120u);
        std::vector<uint8_t> bytes(count);
        EXPECT_EQ(vfit_pose_pack(in, &pose, bones.data(), sizeof(vfit_bone), uint32_t(bones.size()),
                                 bytes.data(), &count),
                  VFIT_OK);
        return bytes;
    }
    std::vector<vfit_bone> unpack(const std::vector<uint8_t>& bytes, vfit_pose& pose, vfit_context in) {
        std::vector<vfit_bone> bones(VFIT_BONE_COUNT);
        uint32_t count = VFIT_BONE_COUNT;
        EXPECT_EQ(vfit_pose_unpack(in, bytes.data(), uint32_t(bytes.size()), &pose, bones.data(),
                                   sizeof(vfit_bone), &count),
                  VFIT_OK)
            << contract::last_error();
        return bones;
    }
    vfit_avatar make_avatar(vfit_avatar_desc desc = vfit_avatar_desc_init(), float weight = 0.7f) {
        desc.sex = VFIT_SEX_FEMALE;
        vfit_shape_value value = vfit_shape_value_init();
        std::snprintf(value.key, sizeof value.key, "weight");
        value.value = weight;
        vfit_avatar avatar{};
        EXPECT_EQ(vfit_avatar_create_from_shape(context, &desc, &value, sizeof value, 1, &avatar), VFIT_OK)
            << contract::last_error();
        return avatar;
    }
};

}  // namespace

TEST_F(PacketTest, APoseComesBackWithinTenthsOfADegree) {
    double worst = 0.0;
    for (uint32_t seed = 0; seed < 50; ++seed) {
        std::vector<vfit_bone> bones = random_bones(seed);
        bones[0].position[0] = -731.25f + 30.0f * float(seed);
        vfit_pose pose = vfit_pose_init(), back = vfit_pose_init();
        pose.time_ns = -5'000'000'000 + int64_t(seed) * 123'456'789'012'345;
        pose.contact_flags = seed % 4;
        const auto got = unpack(pack(bones, pose, context), back, context);
        EXPECT_EQ(back.time_ns, pose.time_ns);
        EXPECT_EQ(back.contact_flags, pose.contact_flags);
        for (int i = 0; i < 3; ++i)
            EXPECT_NEAR(got[0].position[i], bones[0].position[i],
                        1e-4f + 1e-6f * std::abs(bones[0].position[i]));
        for (size_t b = 0; b < got.size(); ++b) worst = std::max(worst, degrees_between(got[b], bones[b]));
    }
    std::cout << "packed rotations: " << worst << " degrees off at most\n";
    EXPECT_LT(worst, 0.12);
}

TEST_F(PacketTest, APoseIsTheSameToAnEngineOfOtherAxes) {
    vfit_context_desc desc = contract::context_desc();
    desc.axes = VFIT_AXES_UNREAL;
    vfit_context other{};
    ASSERT_EQ(vfit_context_create(&desc, &other), VFIT_OK);
    vfit_pose pose = vfit_pose_init(), back = vfit_pose_init(), again = vfit_pose_init();
    const auto bones = random_bones(3);
    const auto there = unpack(pack(bones, pose, context), back, other);
    EXPECT_NEAR(there[0].position[2], 100.0f * bones[0].position[1], 0.02f);  // up, in centimetres
    const auto home = unpack(pack(there, back, other), again, context);
    for (size_t b = 0; b < bones.size(); ++b) EXPECT_LT(degrees_between(home[b], bones[b]), 0.2) << b;
    EXPECT_EQ(vfit_context_destroy(other), VFIT_OK);
}

TEST_F(PacketTest, BadPosesAndPacketsAreRefused) {
    vfit_pose pose = vfit_pose_init();
    std::vector<vfit_bone> bones = random_bones(1);
    const std::vector<uint8_t> good = pack(bones, pose, context);
    uint32_t count = 0;
    const auto packed = [&](const std::vector<vfit_bone>& list) {
        count = 0;
        return vfit_pose_pack(context, &pose, list.data(), sizeof(vfit_bone), uint32_t(list.size()), nullptr,
                              &count);
    };
    auto far = bones, broken = bones, without = bones;
    far[0].position[2] = 900.0f;
    broken[4].rotation[1] = std::numeric_limits<float>::quiet_NaN();
    without.erase(without.begin());
    EXPECT_EQ(packed(far), VFIT_ERROR_DATA);
    EXPECT_NE(contract::last_error().find("900"), std::string::npos);
    EXPECT_EQ(packed(broken), VFIT_ERROR_DATA);
    EXPECT_EQ(packed(without), VFIT_ERROR_DATA);
    uint8_t small[8];
    count = sizeof small;
    EXPECT_EQ(vfit_pose_pack(context, &pose, bones.data(), sizeof(vfit_bone), 22, small, &count),
              VFIT_ERROR_CAPACITY);
    EXPECT_EQ(count, good.size());

    const auto unpacked = [&](const std::vector<uint8_t>& bytes) {
        count = 0;
        return vfit_pose_unpack(context, bytes.data(), uint32_t(bytes.size()), &pose, nullptr, 0, &count);
    };
    EXPECT_EQ(vfit_pose_unpack(context, nullptr, 0, &pose, nullptr, 0, &count), VFIT_ERROR_ARGUMENT);
    for (size_t n = 1; n < good.size(); ++n)
        EXPECT_EQ(unpacked({good.begin(), good.begin() + std::ptrdiff_t(n)}), VFIT_ERROR_DATA) << n;
    auto version = good, longer = good;
    version[0] = 9;
    longer.push_back(0);
    EXPECT_EQ(unpacked(version), VFIT_ERROR_VERSION);
    EXPECT_EQ(unpacked(longer), VFIT_ERROR_DATA);
    // Whatever else the bytes say, unit rotations come out.
    std::mt19937 bits(5);
    for (int run = 0; run < 200; ++run) {
        std::vector<uint8_t> noise(good.size());
        for (uint8_t& b : noise) b = uint8_t(bits());
        noise[0] = good[0];
        for (const vfit_bone& b : unpack(noise, pose, context)) {
            float length = 0.0f;
            for (const float q : b.rotation) length += q * q;
            ASSERT_NEAR(length, 1.0f, 1e-4f);
        }
    }
}

TEST_F(PacketTest, ABodyComesBackWithItsShapeAndSize) {
    const vfit_avatar avatar = make_avatar();
    uint32_t count = 0;
    ASSERT_EQ(vfit_avatar_pack(avatar, "XL long", nullptr, &count), VFIT_OK) << contract::last_error();
    std::cout << "packed body: " << count << " bytes\n";
    EXPECT_LE(count, 240u);
    std::vector<uint8_t> bytes(count);
    ASSERT_EQ(vfit_avatar_pack(avatar, "XL long", bytes.data(), &count), VFIT_OK);
    vfit_avatar back{};
    char label[32];
    ASSERT_EQ(vfit_avatar_unpack(context, nullptr, bytes.data(), count, label, sizeof label, &back), VFIT_OK)
        << contract::last_error();
    EXPECT_STREQ(label, "XL long");
    const auto measures = [](vfit_avatar a) {
        std::vector<vfit_measurement> list(64);
        uint32_t n = 64;
        EXPECT_EQ(vfit_avatar_measure(a, list.data(), sizeof(vfit_measurement), &n), VFIT_OK)
            << contract::last_error();
        list.resize(n);
        return list;
    };
    const auto a = measures(avatar), b = measures(back);
    ASSERT_EQ(a.size(), b.size());
    for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i].value, b[i].value, 0.002f) << a[i].key;
    std::vector<vfit_collider> ca(64), cb(64);
    uint32_t na = 64, nb = 64;
    ASSERT_EQ(vfit_avatar_colliders(avatar, ca.data(), sizeof(vfit_collider), &na), VFIT_OK);
    ASSERT_EQ(vfit_avatar_colliders(back, cb.data(), sizeof(vfit_collider), &nb), VFIT_OK);
    ASSERT_EQ(na, nb);
    for (uint32_t i = 0; i < na; ++i) EXPECT_NEAR(ca[i].radius, cb[i].radius, 0.002f) << i;
}

TEST_F(PacketTest, BadBodyPacketsAreRefused) {
    const vfit_avatar avatar = make_avatar();
    uint32_t count = 240;
    std::vector<uint8_t> good(240);
    EXPECT_EQ(vfit_avatar_pack(avatar, "a label of twenty by", good.data(), &count), VFIT_ERROR_ARGUMENT);
    count = 10;
    EXPECT_EQ(vfit_avatar_pack(avatar, nullptr, good.data(), &count), VFIT_ERROR_CAPACITY);
    ASSERT_EQ(vfit_avatar_pack(avatar, nullptr, good.data(), &count), VFIT_OK) << contract::last_error();
    good.resize(count);
    vfit_avatar out{7};
    const auto unpacked = [&](const std::vector<uint8_t>& bytes) {
        return vfit_avatar_unpack(context, nullptr, bytes.data(), uint32_t(bytes.size()), nullptr, 0, &out);
    };
    auto cut = good, version = good, other = good;
    cut.resize(100);
    version[0] = 2;
    other[1] = uint8_t(other[1] ^ 0x5A);
    EXPECT_EQ(unpacked(cut), VFIT_ERROR_DATA);
    EXPECT_EQ(out.id, 0u);
    EXPECT_EQ(unpacked(version), VFIT_ERROR_VERSION);
    EXPECT_EQ(unpacked(other), VFIT_ERROR_VERSION);
    EXPECT_NE(contract::last_error().find("another body model"), std::string::npos);

    // A label that no string of a host's language takes.
    EXPECT_EQ(vfit_avatar_pack(avatar, "L\xDC", nullptr, &count), VFIT_ERROR_ARGUMENT);
    std::vector<uint8_t> labelled(240);
    count = 240;
    ASSERT_EQ(vfit_avatar_pack(avatar, "\xC3\x9C", labelled.data(), &count), VFIT_OK)
        << contract::last_error();
    labelled.resize(count);
    EXPECT_EQ(unpacked(labelled), VFIT_OK) << contract::last_error();
    EXPECT_EQ(vfit_avatar_destroy(out), VFIT_OK);
    int refused = 0;  // of the label's last sixteen bits, each flipped
    for (uint32_t bit = 8 * (count - 2); bit < 8 * count; ++bit) {
        auto damaged = labelled;
        damaged[bit / 8] = uint8_t(damaged[bit / 8] ^ (1u << bit % 8));
        if (unpacked(damaged) == VFIT_OK) {
            EXPECT_EQ(vfit_avatar_destroy(out), VFIT_OK);
            continue;
        }
        EXPECT_NE(contract::last_error().find("UTF-8"), std::string::npos) << contract::last_error();
        ++refused;
    }
    EXPECT_GE(refused, 3);  // a lead byte or its successor that is none
}

TEST_F(PacketTest, PosingIntoOwnMemoryGivesTheSameSkin) {
    const vfit_avatar avatar = make_avatar();
    vfit_pose pose = vfit_pose_init();
    const auto bones = random_bones(2);
    ASSERT_EQ(vfit_avatar_pose(avatar, &pose, bones.data(), sizeof(vfit_bone), 22), VFIT_OK)
        << contract::last_error();
    vfit_frame frame{};
    ASSERT_EQ(vfit_avatar_acquire(avatar, &frame), VFIT_OK);
    vfit_view p = vfit_view_init(), n = vfit_view_init();
    ASSERT_EQ(vfit_frame_view(frame, VFIT_STREAM_POSITION, &p), VFIT_OK);
    ASSERT_EQ(vfit_frame_view(frame, VFIT_STREAM_NORMAL, &n), VFIT_OK);

    struct Vertex {
        float position[3], normal[3], uv[2];
    };
    std::vector<Vertex> vertices(p.width, Vertex{{}, {}, {0.25f, 0.5f}});
    vfit_target to = vfit_target_init(), normals = vfit_target_init();
    to.data = vertices[0].position;
    normals.data = vertices[0].normal;
    to.item_stride = normals.item_stride = sizeof(Vertex);
    to.capacity = sizeof(Vertex) * (vertices.size() - 1) + 12;
    normals.capacity = to.capacity;
    ASSERT_EQ(vfit_avatar_pose_into(avatar, &pose, bones.data(), sizeof(vfit_bone), 22, &to, &normals),
              VFIT_OK)
        << contract::last_error();
    for (uint32_t v = 0; v < p.width; ++v) {
        ASSERT_EQ(std::memcmp(vertices[v].position, static_cast<const float*>(p.data) + 3 * v, 12), 0) << v;
        ASSERT_EQ(std::memcmp(vertices[v].normal, static_cast<const float*>(n.data) + 3 * v, 12), 0) << v;
        ASSERT_EQ(vertices[v].uv[1], 0.5f);
    }
    const auto into = [&](const vfit_target* positions, const vfit_target* n2) {
        return vfit_avatar_pose_into(avatar, &pose, bones.data(), sizeof(vfit_bone), 22, positions, n2);
    };
    EXPECT_EQ(into(&to, nullptr), VFIT_OK);
    EXPECT_EQ(into(nullptr, &normals), VFIT_ERROR_ARGUMENT);
    vfit_target bad = to;
    --bad.capacity;
    EXPECT_EQ(into(&bad, nullptr), VFIT_ERROR_CAPACITY);
    bad = to;
    bad.item_stride = 8;
    EXPECT_EQ(into(&bad, nullptr), VFIT_ERROR_ARGUMENT);
    bad = to;
    bad.format = VFIT_FORMAT_U16;
    EXPECT_EQ(into(&bad, nullptr), VFIT_ERROR_UNSUPPORTED);
    bad = to;
    bad.data = nullptr;
    EXPECT_EQ(into(&bad, nullptr), VFIT_ERROR_ARGUMENT);
    vfit_frame_release(frame);
}

TEST_F(PacketTest, DualQuaternionsAreAnotherSkinOfTheSameBones) {
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.flags = VFIT_AVATAR_DUAL_QUATERNIONS | VFIT_AVATAR_SINGLE_BONES;
    vfit_avatar_desc plain = desc;
    plain.flags = VFIT_AVATAR_SINGLE_BONES;
    const vfit_avatar dual = make_avatar(desc), linear = make_avatar(plain);
    vfit_pose pose = vfit_pose_init();
    std::vector<vfit_bone> bones(2, vfit_bone_init());
    bones[0].bone = VFIT_BONE_HIPS;
    bones[0].rotation[3] = 1.0f;
    bones[1].bone = VFIT_BONE_LEFT_LOWER_LEG;  // knee bent by 110 degrees
    bones[1].rotation[0] = std::sin(0.96f);
    bones[1].rotation[3] = std::cos(0.96f);
    std::vector<std::vector<float>> skins;
    for (const vfit_avatar avatar : {dual, linear}) {
        ASSERT_EQ(vfit_avatar_pose(avatar, &pose, bones.data(), sizeof(vfit_bone), 2), VFIT_OK)
            << contract::last_error();
        vfit_frame frame{};
        ASSERT_EQ(vfit_avatar_acquire(avatar, &frame), VFIT_OK);
        vfit_view view = vfit_view_init();
        ASSERT_EQ(vfit_frame_view(frame, VFIT_STREAM_POSITION, &view), VFIT_OK);
        const auto* p = static_cast<const float*>(view.data);
        skins.emplace_back(p, p + 3 * view.width);
        vfit_frame_release(frame);
    }
    size_t apart = 0;
    for (size_t i = 0; i < skins[0].size(); ++i) {
        ASSERT_NEAR(skins[0][i], skins[1][i], 0.12f);
        apart += std::abs(skins[0][i] - skins[1][i]) > 0.005f;
    }
    EXPECT_GT(apart, 50u);
}
