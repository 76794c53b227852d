// Character files: vfit's own body with four rigs, read back and posed, moved and written again, damaged and
// odd.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/gtc/type_ptr.hpp>
#include <random>

#include "client/files.h"
#include "export/character.h"
#include "export/character_animation.h"
#include "export/compressed_gltf.h"
#include "export/glb_writer.h"

namespace vfit::tools {
namespace {

using glm::mat4;
using glm::quat;
using glm::vec3;

bool keep_bytes(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                int size, void*) {
    image->image.assign(bytes, bytes + size);
    image->as_is = true;
    return true;
}

tinygltf::Model read_model(const std::string& bytes) {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keep_bytes, nullptr);
    tinygltf::Model model;
    std::string error, warning;
    EXPECT_TRUE(loader.LoadBinaryFromMemory(&model, &error, &warning,
                                            reinterpret_cast<const unsigned char*>(bytes.data()),
                                            uint32_t(bytes.size())))
        << error;
    return model;
}

class Characters : public testing::Test {
protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() /
                  ("vfit_characters_test_" + std::to_string(std::random_device()()));
        std::filesystem::create_directories(folder_);
        context = open_context();
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    std::string exported(const std::string& rig) {
        vfit_avatar_desc desc = vfit_avatar_desc_init();
        desc.sex = VFIT_SEX_FEMALE;
        export_character(context.get(), desc, {}, rig_style_from(rig), path(rig + ".glb"));
        return path(rig + ".glb");
    }
    vfit_result load(const std::string& bytes, Avatar& avatar, const char* map = nullptr,
                     uint32_t flags = 0) {
        vfit_avatar_desc desc = vfit_avatar_desc_init();
        desc.flags = flags;
        vfit_character_desc character = vfit_character_desc_init();
        character.bytes = bytes.data();
        character.byte_count = bytes.size();
        character.bone_map = map;
        return vfit_avatar_load(context.get(), &desc, &character, avatar.out());
    }
    /// The exported file after a change of its glTF.
    std::string changed(const std::string& rig, const std::function<void(tinygltf::Model&)>& change) {
        GlbWriter writer(read_model(read_text(exported(rig))));
        change(writer.model());
        writer.save(path("changed.glb"));
        return read_text(path("changed.glb"));
    }
    void expect_refused(const std::string& bytes, vfit_result code, const char* word,
                        const char* map = nullptr) {
        Avatar avatar;
        EXPECT_EQ(load(bytes, avatar, map), code) << word << ": " << last_error();
        EXPECT_NE(last_error().find(word), std::string::npos) << last_error();
    }

    Context context;

private:
    std::filesystem::path folder_;
};

/// A pose of many turned bones, arms away from the trunk, the hips at a height of their own.
std::vector<vfit_bone> lively(float phase = 0.0f) {
    const auto turned = [](vfit_bone_id id, const vec3& axis, float angle) {
        vfit_bone b = vfit_bone_init();
        b.bone = id;
        const quat q = glm::angleAxis(angle, glm::normalize(axis));
        b.rotation[0] = q.x, b.rotation[1] = q.y, b.rotation[2] = q.z, b.rotation[3] = q.w;
        return b;
    };
    std::vector<vfit_bone> bones = {turned(VFIT_BONE_HIPS, {0, 1, 0}, 0.5f + phase)};
    bones[0].position[0] = 0.3f;
    bones[0].position[1] = 0.95f;
    bones[0].position[2] = -1.0f + phase;
    bones.push_back(turned(VFIT_BONE_SPINE, {1, 0, 0}, 0.15f));
    bones.push_back(turned(VFIT_BONE_CHEST, {0, 1, 0.2f}, 0.2f + 0.1f * phase));
    bones.push_back(turned(VFIT_BONE_NECK, {0, 1, 0}, 0.2f));
    bones.push_back(turned(VFIT_BONE_HEAD, {1, 0, 0}, -0.2f));
    bones.push_back(turned(VFIT_BONE_LEFT_SHOULDER, {0, 0, 1}, 0.1f));
    bones.push_back(turned(VFIT_BONE_LEFT_UPPER_ARM, {0, 0.4f, 1}, -0.7f - phase));
    bones.push_back(turned(VFIT_BONE_LEFT_LOWER_ARM, {0.3f, 1, 0}, -0.9f));
    bones.push_back(turned(VFIT_BONE_LEFT_HAND, {1, 0.2f, 0}, 0.5f));
    bones.push_back(turned(VFIT_BONE_RIGHT_UPPER_ARM, {0.2f, 0, 1}, 0.5f));
    bones.push_back(turned(VFIT_BONE_LEFT_UPPER_LEG, {1, 0, 0}, -0.6f - phase));
    bones.push_back(turned(VFIT_BONE_LEFT_LOWER_LEG, {1, 0, 0}, 0.9f));
    bones.push_back(turned(VFIT_BONE_RIGHT_FOOT, {1, 0.2f, 0}, 0.3f));
    return bones;
}

std::vector<vec3> skin_of(vfit_avatar avatar, const std::vector<vfit_bone>& bones) {
    set_pose(avatar, vfit_pose_init(), bones);
    Frame frame;
    check(vfit_avatar_acquire(avatar, frame.out()));
    return items_of<vec3>(frame.get(), VFIT_STREAM_POSITION);
}

vfit_character_info describe(vfit_avatar avatar) {
    vfit_character_info info = vfit_character_info_init();
    check(vfit_avatar_describe(avatar, &info));
    return info;
}

TEST_F(Characters, OfFourRigsArePosedAsTheBodyItself) {
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.sex = VFIT_SEX_FEMALE;
    Avatar own;
    check(vfit_avatar_create_from_shape(context.get(), &desc, nullptr, 0, 0, own.out()));
    const std::vector<vec3> wanted = skin_of(own.get(), lively());
    struct Case {
        const char* rig;
        vfit_character_kind kind;
        float mean_m;   // missing bones bend the trunk at other places; twist bones differ
        float joint_m;  // of the largest; VRM 1 needs neither neck nor toes
    };
    for (const Case& c : {Case{"vrm0", VFIT_CHARACTER_VRM0, 0.0005f, 0.015f},
                          Case{"vrm1", VFIT_CHARACTER_VRM1, 0.015f, 0.08f},
                          Case{"mixamo", VFIT_CHARACTER_GLTF, 0.0005f, 0.015f},
                          Case{"bones31", VFIT_CHARACTER_GLTF, 0.005f, 0.015f}}) {
        Avatar avatar;
        ASSERT_EQ(load(read_text(exported(c.rig)), avatar), VFIT_OK) << c.rig << ": " << last_error();
        const vfit_character_info info = describe(avatar.get());
        EXPECT_EQ(info.kind, c.kind) << c.rig;
        EXPECT_NEAR(info.stature_m, describe(own.get()).stature_m, 0.002f) << c.rig;
        EXPECT_EQ(info.part_count, 1u);
        const std::vector<vec3> got = skin_of(avatar.get(), lively());
        ASSERT_EQ(got.size(), wanted.size()) << c.rig;
        double mean = 0.0;
        for (size_t v = 0; v < got.size(); ++v)
            mean += double(glm::distance(got[v], wanted[v])) / double(got.size());
        EXPECT_LT(mean, c.mean_m) << c.rig;
        const auto joints = [](vfit_avatar a) {
            return list<vfit_joint>([&](auto* items, uint32_t stride, uint32_t* n) {
                return vfit_avatar_joints(a, items, stride, n);
            });
        };
        const auto mine = joints(own.get()), theirs = joints(avatar.get());
        ASSERT_EQ(mine.size(), theirs.size());
        for (size_t j = 0; j < mine.size(); ++j) {
            const auto at = [](const vfit_joint& joint) {
                return vec3(joint.position[0], joint.position[1], joint.position[2]);
            };
            EXPECT_LT(glm::distance(at(mine[j]), at(theirs[j])), c.joint_m)
                << c.rig << ": " << joint_name(mine[j].joint);
        }
    }
}

TEST_F(Characters, TwistBonesOfAFileShareTheTwist) {
    Avatar avatar;
    ASSERT_EQ(load(read_text(exported("bones31")), avatar), VFIT_OK) << last_error();
    std::vector<vfit_bone> bones = lively();
    bones.resize(1);
    bones[0].rotation[0] = bones[0].rotation[1] = bones[0].rotation[2] = 0.0f;
    bones[0].rotation[3] = 1.0f;
    vfit_bone hand = vfit_bone_init();
    hand.bone = VFIT_BONE_LEFT_HAND;  // a forearm turned by 80 degrees
    hand.rotation[0] = std::sin(0.7f);
    hand.rotation[3] = std::cos(0.7f);
    bones.push_back(hand);
    set_pose(avatar.get(), vfit_pose_init(), bones);
    Frame frame;
    check(vfit_avatar_acquire(avatar.get(), frame.out()));
    const auto matrices = items_of<mat4>(frame.get(), VFIT_STREAM_BONE_MATRIX);
    const auto rig = rig_of(avatar.get());
    const auto turn = [&](const std::string& name) {
        for (size_t i = 0; i < rig.size(); ++i)
            if (name == rig[i].name) return glm::quat_cast(glm::mat3(matrices[i]));
        ADD_FAILURE() << name;
        return quat();
    };
    const auto between = [&](const char* a, const char* b) {
        return 2.0f * std::acos(std::min(1.0f, std::abs(glm::dot(turn(a), turn(b)))));
    };
    EXPECT_NEAR(between("lowerarm_l", "hand_l"), 1.4f, 0.01f);
    EXPECT_NEAR(between("lowerarm_l", "lowerarm_twist_01_l"), 0.7f, 0.01f);
    EXPECT_NEAR(between("upperarm_l", "upperarm_twist_01_l"), 0.0f, 0.01f);
}

/// The skin of a glTF file at a key frame of its animation, by the rules of glTF alone.
std::vector<vec3> skin_by_gltf(const tinygltf::Model& model, size_t key) {
    const auto floats = [&](int accessor, size_t first, size_t count) {
        const tinygltf::Accessor& a = model.accessors[size_t(accessor)];
        const tinygltf::BufferView& view = model.bufferViews[size_t(a.bufferView)];
        std::vector<float> out(count);
        std::memcpy(
            out.data(),
            model.buffers[size_t(view.buffer)].data.data() + view.byteOffset + a.byteOffset + 4 * first,
            4 * count);
        return out;
    };
    std::vector<tinygltf::Node> nodes = model.nodes;
    for (const tinygltf::AnimationChannel& channel : model.animations[0].channels) {
        const int output = model.animations[0].samplers[size_t(channel.sampler)].output;
        tinygltf::Node& node = nodes[size_t(channel.target_node)];
        const size_t n = channel.target_path == "rotation" ? 4 : 3;
        const auto v = floats(output, n * key, n);
        (n == 4 ? node.rotation : node.translation).assign(v.begin(), v.end());
    }
    std::vector<mat4> world(nodes.size());
    const std::function<void(int, const mat4&)> place = [&](int n, const mat4& above) {
        const tinygltf::Node& node = nodes[size_t(n)];
        mat4 m(1.0f);
        if (node.rotation.size() == 4)
            m = glm::mat4_cast(quat(float(node.rotation[3]), float(node.rotation[0]), float(node.rotation[1]),
                                    float(node.rotation[2])));
        for (int c = 0; c < 3; ++c) {
            if (node.scale.size() == 3) m[c] *= float(node.scale[size_t(c)]);
            if (node.translation.size() == 3) m[3][c] = float(node.translation[size_t(c)]);
        }
        world[size_t(n)] = above * m;
        for (const int child : node.children) place(child, world[size_t(n)]);
    };
    for (const int root : model.scenes[0].nodes) place(root, mat4(1.0f));
    const tinygltf::Skin& skin = model.skins[0];
    std::vector<mat4> joints;
    for (size_t j = 0; j < skin.joints.size(); ++j)
        joints.push_back(world[size_t(skin.joints[j])] *
                         glm::make_mat4(floats(skin.inverseBindMatrices, 16 * j, 16).data()));
    const tinygltf::Primitive& p = model.meshes[0].primitives[0];
    const size_t count = model.accessors[size_t(p.attributes.at("POSITION"))].count;
    const auto positions = floats(p.attributes.at("POSITION"), 0, 3 * count);
    std::vector<vec3> out(count, vec3(0.0f));
    for (const char* set : {"0", "1"}) {
        const auto weights = floats(p.attributes.at(std::string("WEIGHTS_") + set), 0, 4 * count);
        const tinygltf::Accessor& a = model.accessors[size_t(p.attributes.at(std::string("JOINTS_") + set))];
        const tinygltf::BufferView& view = model.bufferViews[size_t(a.bufferView)];
        std::vector<uint16_t> bones(4 * count);
        std::memcpy(bones.data(), model.buffers[0].data.data() + view.byteOffset + a.byteOffset, 8 * count);
        for (size_t v = 0; v < count; ++v)
            for (size_t k = 4 * v; k < 4 * v + 4; ++k)
                out[v] +=
                    weights[k] * vec3(joints[bones[k]] * glm::vec4(positions[3 * v], positions[3 * v + 1],
                                                                   positions[3 * v + 2], 1.0f));
    }
    return out;
}

TEST_F(Characters, AMovedCopyKeepsItsMaterialsAndMovesByTheRulesOfGltf) {
    for (const char* rig : {"vrm0", "vrm1", "mixamo", "bones31"}) {
        const std::string file = exported(rig);
        Avatar avatar;
        ASSERT_EQ(load(read_text(file), avatar, nullptr, VFIT_AVATAR_SINGLE_BONES), VFIT_OK) << last_error();
        CharacterAnimation animation(avatar.get(), file);
        std::vector<std::vector<vec3>> shown;
        for (const float phase : {0.0f, 0.3f, -0.4f}) {
            shown.push_back(skin_of(avatar.get(), lively(phase)));
            animation.add_key(0.1f * float(shown.size()));
        }
        EXPECT_THROW(animation.write(path("no such folder/moved.glb")), Failure);
        animation.write(path("moved.glb"));
        const tinygltf::Model before = read_model(read_text(file)),
                              after = read_model(read_text(path("moved.glb")));
        ASSERT_EQ(after.materials.size(), 1u);
        EXPECT_TRUE(after.materials[0] == before.materials[0]) << rig;
        ASSERT_EQ(after.images.size(), 1u);
        EXPECT_EQ(after.images[0].image, before.images[0].image) << rig;
        EXPECT_FALSE(after.images[0].image.empty());
        EXPECT_EQ(after.extensions.size(), before.extensions.size()) << rig;
        const mat4 to_file = glm::inverse(glm::make_mat4(describe(avatar.get()).from_file));
        for (size_t key = 0; key < shown.size(); ++key) {
            const std::vector<vec3> got = skin_by_gltf(after, key);
            ASSERT_EQ(got.size(), shown[key].size());
            double worst = 0.0;
            for (size_t v = 0; v < got.size(); ++v)
                worst = std::max(
                    worst, double(glm::distance(got[v], vec3(to_file * glm::vec4(shown[key][v], 1.0f)))));
            // bones31 hands limbs' weights to twist bones, which here follow their limb.
            EXPECT_LT(worst, 1e-4) << rig << ", key " << key;
        }
    }
}

TEST_F(Characters, ThatCannotBePosedAreRefusedWithTheReason) {
    const auto node_named = [](tinygltf::Model& m, const std::string& name) -> tinygltf::Node& {
        for (tinygltf::Node& n : m.nodes)
            if (n.name == name) return n;
        throw Failure("no node " + name);
    };
    expect_refused("not a glTF file at all, but text", VFIT_ERROR_DATA, "glTF");
    expect_refused("short", VFIT_ERROR_DATA, "5 bytes");
    expect_refused(changed("mixamo",
                           [](auto& m) {
                               m.skins.clear();
                               for (auto& n : m.nodes) n.skin = -1;
                           }),
                   VFIT_ERROR_DATA, "no skinned mesh");
    expect_refused(changed("mixamo", [](auto& m) { m.extensionsRequired = {"EXT_mesh_gpu_instancing"}; }),
                   VFIT_ERROR_UNSUPPORTED, "EXT_mesh_gpu_instancing");
    const std::string renamed = changed("mixamo", [&](auto& m) {
        node_named(m, "mixamorig:LeftArm").name = "Ast 7";
        node_named(m, "mixamorig:LeftForeArm").name = "Zweig";
    });
    expect_refused(renamed, VFIT_ERROR_DATA, "leftUpperArm");
    expect_refused(renamed, VFIT_ERROR_DATA, "JSON", "leftUpperArm=Ast 7");
    expect_refused(renamed, VFIT_ERROR_ARGUMENT, "leftWing", R"({"leftWing": "Ast 7"})");
    expect_refused(renamed, VFIT_ERROR_DATA, "Ast 8", R"({"leftUpperArm": "Ast 8"})");
    expect_refused(renamed, VFIT_ERROR_DATA, "does not hang on",
                   R"({"leftUpperArm": "mixamorig:RightArm", "leftLowerArm": "Zweig"})");
    Avatar mapped;
    EXPECT_EQ(load(renamed, mapped, R"({"leftUpperArm": "Ast 7"})"), VFIT_OK) << last_error();
    expect_refused(changed("mixamo", [&](auto& m) { node_named(m, "Armature").scale = {1, 1, 1}; }),
                   VFIT_ERROR_DATA, "m tall");
    expect_refused(
        changed("vrm1", [&](auto& m) { node_named(m, "Armature").rotation = {0.7071, 0, 0, 0.7071}; }),
        VFIT_ERROR_DATA, "upright");
    expect_refused(
        changed("vrm1", [](auto& m) { m.meshes[0].primitives[0].mode = TINYGLTF_MODE_TRIANGLE_STRIP; }),
        VFIT_ERROR_UNSUPPORTED, "strips");
    expect_refused(changed("vrm1",
                           [](auto& m) {
                               m.accessors[size_t(m.meshes[0].primitives[0].attributes["POSITION"])].count =
                                   1u << 30;
                           }),
                   VFIT_ERROR_DATA, "beyond its buffer");
    expect_refused(changed("vrm1",
                           [](auto& m) {
                               const float nan = std::nanf("");
                               const auto& a =
                                   m.accessors[size_t(m.meshes[0].primitives[0].attributes["POSITION"])];
                               std::memcpy(m.buffers[0].data.data() +
                                               m.bufferViews[size_t(a.bufferView)].byteOffset + 120,
                                           &nan, 4);
                           }),
                   VFIT_ERROR_DATA, "not finite");
    expect_refused(
        changed("vrm1",
                [](auto& m) {
                    const uint32_t far = 1'000'000;
                    const auto& a = m.accessors[size_t(m.meshes[0].primitives[0].indices)];
                    std::memcpy(m.buffers[0].data.data() + m.bufferViews[size_t(a.bufferView)].byteOffset + 8,
                                &far, 4);
                }),
        VFIT_ERROR_DATA, "index 1000000");
    expect_refused(
        changed("vrm1",
                [](auto& m) {
                    const uint16_t far = 999;
                    const auto& a = m.accessors[size_t(m.meshes[0].primitives[0].attributes["JOINTS_0"])];
                    std::memcpy(m.buffers[0].data.data() + m.bufferViews[size_t(a.bufferView)].byteOffset,
                                &far, 2);
                }),
        VFIT_ERROR_DATA, "joint 999");
    Avatar avatar;
    vfit_character_desc nothing = vfit_character_desc_init();
    EXPECT_EQ(vfit_avatar_load(context.get(), nullptr, &nothing, avatar.out()), VFIT_ERROR_ARGUMENT);
    nothing.path = "/does/not/exist.glb";
    EXPECT_EQ(vfit_avatar_load(context.get(), nullptr, &nothing, avatar.out()), VFIT_ERROR_IO);
    EXPECT_NE(last_error().find("/does/not/exist.glb"), std::string::npos);
}

TEST_F(Characters, WhatTheyDoNotNeedIsLeftOut) {
    // A morph target, a mesh in nobody's hand, one on the head without a skin, vertices without weights.
    const std::string bytes = changed("mixamo", [](auto& m) {
        m.meshes[0].primitives[0].targets = {
            {{"POSITION", m.meshes[0].primitives[0].attributes["POSITION"]}}};
        tinygltf::Node lost, hat;
        lost.mesh = hat.mesh = 0;
        lost.name = "lost";
        hat.name = "hat";
        m.nodes.push_back(lost);
        m.scenes[0].nodes.push_back(int(m.nodes.size()) - 1);
        m.nodes.push_back(hat);
        for (auto& n : m.nodes)
            if (n.name == "mixamorig:Head") n.children.push_back(int(m.nodes.size()) - 1);
        for (const char* set : {"WEIGHTS_0", "WEIGHTS_1"}) {
            const auto& a = m.accessors[size_t(m.meshes[0].primitives[0].attributes[set])];
            std::memset(m.buffers[0].data.data() + m.bufferViews[size_t(a.bufferView)].byteOffset, 0, 16);
        }
    });
    Avatar avatar;
    ASSERT_EQ(load(bytes, avatar), VFIT_OK) << last_error();
    const auto parts = list<vfit_avatar_part>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_avatar_parts(avatar.get(), items, stride, n);
    });
    ASSERT_EQ(parts.size(), 2u);  // the skinned one and the hat
    EXPECT_STREQ(parts[0].material_name, "skin");
    EXPECT_EQ(parts[1].first_index, parts[0].index_count);
    // The hat keeps its distance to the head in every pose.
    const auto rest = skin_of(avatar.get(), {lively()[0]}), posed = skin_of(avatar.get(), lively());
    const size_t half = rest.size() / 2;
    EXPECT_NEAR(glm::distance(posed[half], posed[half + 5000]), glm::distance(rest[half], rest[half + 5000]),
                1e-3f);
}

TEST_F(Characters, ThatAreDamagedNeverTakeTheHostDown) {
    const std::string good = read_text(exported("vrm1"));
    std::mt19937 bits(11);
    int refused = 0, runs = 0;
    for (size_t cut = 0; cut < good.size(); cut += 1 + good.size() / 60, ++runs) {
        Avatar avatar;
        refused += load(good.substr(0, cut), avatar) < 0;
    }
    EXPECT_EQ(refused, runs);
    // Flips in the JSON part, where all the indices and offsets are.
    uint32_t json_bytes = 0;
    std::memcpy(&json_bytes, good.data() + 12, 4);
    for (int run = 0; run < 150; ++run) {
        std::string bad = good;
        for (int k = 0; k < 3; ++k) bad[20 + bits() % json_bytes] = char(bits());
        Avatar avatar;
        const vfit_result result = load(bad, avatar);
        EXPECT_TRUE(result == VFIT_OK || result == VFIT_ERROR_DATA || result == VFIT_ERROR_UNSUPPORTED ||
                    result == VFIT_ERROR_OUT_OF_MEMORY)
            << vfit_result_name(result) << ": " << last_error();
    }
}

TEST_F(Characters, AreNoBodiesToMeasurePackOrDress) {
    Avatar avatar;
    ASSERT_EQ(load(read_text(exported("vrm0")), avatar), VFIT_OK) << last_error();
    uint32_t count = 0;
    EXPECT_EQ(vfit_avatar_measure(avatar.get(), nullptr, 0, &count), VFIT_ERROR_UNSUPPORTED);
    EXPECT_EQ(vfit_avatar_pack(avatar.get(), "M", nullptr, &count), VFIT_ERROR_UNSUPPORTED);
    Garment garment;
    check(vfit_garment_open(context.get(), "sundress", garment.out()));
    vfit_cloth cloth{};
    EXPECT_EQ(vfit_cloth_create(avatar.get(), garment.get(), nullptr, &cloth), VFIT_ERROR_UNSUPPORTED);
    std::vector<vfit_collider> colliders(64);
    count = 64;
    ASSERT_EQ(vfit_avatar_colliders(avatar.get(), colliders.data(), sizeof(vfit_collider), &count), VFIT_OK);
    for (uint32_t i = 0; i < count; ++i) EXPECT_GT(colliders[i].radius, 0.005f) << i;
}

/// A GLB of that text and eight bytes.
std::string glb_of(const std::string& text) {
    std::string out = "glTF";
    const auto number = [&](size_t n) {
        for (int i = 0; i < 4; ++i) out += char(n >> (8 * i));
    };
    const std::string padded = text + std::string((4 - text.size() % 4) % 4, ' ');
    number(2), number(28 + padded.size() + 8), number(padded.size());
    out += "JSON" + padded;
    number(8);
    return out + std::string("BIN\0", 4) + "01234567";
}

TEST(CompressedGltf, PassesThroughTinygltfAsItIs) {
    const std::string meshopt = R"({"buffer":0,"byteOffset":0,"byteLength":4,"byteStride":12,"count":8,)"
                                R"("mode":"ATTRIBUTES"})";
    const std::string file = glb_of(
        R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":8},{"byteLength":96,"extensions":)"
        R"({"EXT_meshopt_compression":{"fallback":true}}}],"bufferViews":[{"buffer":1,"byteLength":96,)"
        R"("extensions":{"EXT_meshopt_compression":)" +
        meshopt +
        R"(}},{"buffer":0,"byteOffset":4,"byteLength":4}],"accessors":[{"bufferView":0,"componentType":5126,)"
        R"("count":8,"type":"VEC3"},{"componentType":5123,"count":3,"type":"SCALAR"}],"meshes":)"
        R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1,"extensions":)"
        R"({"KHR_draco_mesh_compression":{"bufferView":1,"attributes":{"POSITION":0}}}}]}]})");
    const std::string readable = with_stand_ins(file);
    GlbWriter writer(read_model(readable));
    const std::vector<glm::vec3> places(3, glm::vec3(1.0f));
    writer.add_vectors(places, true);
    for (tinygltf::Buffer& buffer : writer.model().buffers) buffer.uri.clear();
    const std::string written = with_compressed_data(writer.bytes("a.glb"), file);
    const auto json = [](const std::string& glb) {
        uint32_t size = 0;
        std::memcpy(&size, glb.data() + 12, 4);
        return Json::parse(glb.substr(20, size));
    };
    const Json before = json(file), after = json(written);
    uint32_t size = 0;
    std::memcpy(&size, written.data() + 8, 4);
    EXPECT_EQ(size, written.size());
    EXPECT_EQ(after["buffers"][1], before["buffers"][1]);
    EXPECT_EQ(after["bufferViews"][0], before["bufferViews"][0]);
    EXPECT_FALSE(after["accessors"][1].contains("bufferView"));
    const auto draco = [](const Json& file) {
        return file["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["bufferView"];
    };
    EXPECT_EQ(draco(after), draco(before));
    EXPECT_EQ(after["accessors"].size(), 3u);
    EXPECT_NE(written.find("01234567"), std::string::npos) << "compressed bytes stay in their place";
    const std::string plain = glb_of(R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":8}]})");
    EXPECT_EQ(with_stand_ins(plain), plain);
    EXPECT_EQ(with_compressed_data(plain, plain), plain);
}

}  // namespace
}  // namespace vfit::tools
