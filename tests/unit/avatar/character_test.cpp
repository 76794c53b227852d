// Character files as they come: names of bones, damaged and odd files.
#include "avatar/character.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <random>

#include "avatar/avatar.h"
#include "avatar/gltf_document.h"
#include "avatar/humanoid_map.h"
#include "core/error.h"
#include "support/shared_folder.h"
#include "support/tiny_character.h"

namespace vfit {
namespace {

TEST(HumanoidMap, KnowsTheNamesThatCommonToolsGive) {
    struct Case {
        const char* name;
        int bone;
    };
    for (const Case& c :
         {Case{"mixamorig:LeftUpLeg", VFIT_BONE_LEFT_UPPER_LEG},
          Case{"mixamorig1:RightLeg", VFIT_BONE_RIGHT_LOWER_LEG},
          Case{"upperarm_l", VFIT_BONE_LEFT_UPPER_ARM}, Case{"Bip01 R Calf", VFIT_BONE_RIGHT_LOWER_LEG},
          Case{"J_Bip_L_LowerArm", VFIT_BONE_LEFT_LOWER_ARM},
          Case{"DEF-upper_arm.R", VFIT_BONE_RIGHT_UPPER_ARM}, Case{"lowerleg01.L", VFIT_BONE_LEFT_LOWER_LEG},
          Case{"Left shoulder", VFIT_BONE_LEFT_SHOULDER}, Case{"RightHand", VFIT_BONE_RIGHT_HAND},
          Case{"ball_r", VFIT_BONE_RIGHT_TOES}, Case{"Head", VFIT_BONE_HEAD}, Case{"pelvis", VFIT_BONE_HIPS},
          Case{"J_Bip_C_Hips", VFIT_BONE_HIPS}, Case{"L_armUpper0001_bind_JNT", VFIT_BONE_LEFT_UPPER_ARM},
          Case{"R_legLower0001_bind_JNT", VFIT_BONE_RIGHT_LOWER_LEG},
          Case{"ValveBiped.Bip01_R_Forearm", VFIT_BONE_RIGHT_LOWER_ARM},
          Case{"Bip001 L Clavicle", VFIT_BONE_LEFT_SHOULDER}, Case{"lThighBend", VFIT_BONE_LEFT_UPPER_LEG},
          Case{"rShldrBend", VFIT_BONE_RIGHT_UPPER_ARM}, Case{"lForeArm", VFIT_BONE_LEFT_LOWER_ARM},
          Case{"CC_Base_L_Upperarm", VFIT_BONE_LEFT_UPPER_ARM}, Case{"LShoulder", VFIT_BONE_LEFT_SHOULDER},
          Case{"Character1_RightUpLeg", VFIT_BONE_RIGHT_UPPER_LEG}, Case{"wrist.R", VFIT_BONE_RIGHT_HAND},
          // Not these:
          Case{"HeadTop_End", -1}, Case{"LeftHandThumb1", -1}, Case{"upperarm_twist_01_l", -1},
          Case{"LHipJoint", -1}, Case{"Hand", -1}, Case{"LeftHead", -1}, Case{"", -1}, Case{"arm_l_r", -1}})
        EXPECT_EQ(bone_of_name(c.name), c.bone) << c.name;
}

Character load(const TinyCharacter& tiny, const std::string& map = "") {
    return load_character(GltfDocument(tiny.glb()), map);
}

TEST(Character, TheLeastOfThemMovesAndHasNormals) {
    const Character character = load(TinyCharacter());
    EXPECT_EQ(character.kind, CharacterKind::gltf);
    EXPECT_EQ(character.source.rest.positions.size(), 15u * 8);
    for (const Vec3& n : character.source.rest.normals) EXPECT_NEAR(glm::length(n), 1.0f, 1e-5f);
    Avatar avatar(character.source, AvatarDesc());
    Pose pose;
    pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    pose.rotation[VFIT_BONE_LEFT_UPPER_ARM] = glm::angleAxis(-0.5f * kPi, Vec3(0, 0, 1));
    avatar.pose(pose, *Jobs::own(0));
    const Vec3 shoulder = avatar.joints().at(VFIT_JOINT_LEFT_SHOULDER),
               wrist = avatar.joints().at(VFIT_JOINT_LEFT_WRIST);
    EXPECT_NEAR(wrist.y, shoulder.y - 0.53f, 1e-3f);  // the arm hangs
    EXPECT_NEAR(wrist.x, shoulder.x, 1e-3f);
}

TEST(Character, FacesForwardFromWhereverItLooks) {
    const Character straight = load(TinyCharacter());
    for (const float quarter : {1.0f, 2.0f, 3.0f}) {
        TinyCharacter turned;
        const float half = 0.25f * kPi * quarter;
        turned.json["nodes"].push_back(
            {{"name", "root"}, {"rotation", {0, std::sin(half), 0, std::cos(half)}}, {"children", {0}}});
        turned.json["scenes"][0]["nodes"] = {16, 15};
        const Character character = load(turned);
        for (size_t v = 0; v < straight.source.rest.positions.size(); ++v)
            EXPECT_LT(glm::distance(character.source.rest.positions[v], straight.source.rest.positions[v]),
                      1e-4f)
                << quarter << " " << v;
    }
}

void expect_error(const TinyCharacter& tiny, const char* word, vfit_result code = VFIT_ERROR_DATA) {
    try {
        load(tiny);
        ADD_FAILURE() << "accepted: " << word;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code) << error.what();
        EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
}

/// The name of the bone's node, and of that of the bone it hangs on in the rig.
std::pair<std::string, std::string> hung(const Character& character, int bone) {
    for (const AvatarBone& b : character.source.bones)
        if (b.bone == bone)
            return {b.name, b.parent < 0 ? "" : character.source.bones[size_t(b.parent)].name};
    return {};
}

TEST(Character, BonesAreFoundByTheirPlacesWhereNamesSayNothing) {
    TinyCharacter tiny;
    const char* names[] = {"Skeleton_torso_joint_1", "torso_joint_2",   "neck_joint_1",  "arm_joint_L__4_",
                           "arm_joint_L__3_",        "arm_joint_L__2_", "arm_joint_R",   "arm_joint_R__2_",
                           "arm_joint_R__3_",        "leg_joint_L_1",   "leg_joint_L_2", "leg_joint_L_3",
                           "leg_joint_R_1",          "leg_joint_R_2",   "leg_joint_R_3"};
    for (size_t i = 0; i < std::size(names); ++i) tiny.json["nodes"][i]["name"] = names[i];
    // The neck has a joint of its own above it, which is the head.
    tiny.json["nodes"][2]["children"] = {16};
    tiny.json["nodes"].push_back({{"name", "neck_joint_2"}, {"translation", {0, 0.1, 0}}});
    tiny.json["skins"][0]["joints"][14] = 16;
    tiny.json["skins"][0]["joints"].push_back(14);
    tiny.json["skins"][0].erase("inverseBindMatrices");
    const Character character = load(tiny);
    EXPECT_EQ(hung(character, VFIT_BONE_HIPS).first, "Skeleton_torso_joint_1");
    EXPECT_EQ(hung(character, VFIT_BONE_SPINE).first, "torso_joint_2");
    EXPECT_EQ(hung(character, VFIT_BONE_HEAD).first, "neck_joint_2");
    EXPECT_EQ(hung(character, VFIT_BONE_LEFT_UPPER_ARM).first, "arm_joint_L__4_");
    EXPECT_EQ(hung(character, VFIT_BONE_LEFT_HAND).first, "arm_joint_L__2_");
    EXPECT_EQ(hung(character, VFIT_BONE_RIGHT_LOWER_ARM).first, "arm_joint_R__2_");
    EXPECT_EQ(hung(character, VFIT_BONE_LEFT_UPPER_LEG).first, "leg_joint_L_1");
    EXPECT_EQ(hung(character, VFIT_BONE_RIGHT_FOOT).first, "leg_joint_R_3");
}

/// A skeleton of nodes alone, and which of them are bones.
class NamedRig {
public:
    explicit NamedRig(std::initializer_list<std::pair<const char*, const char*>> nodes) {
        nlohmann::json json;
        json["asset"]["version"] = "2.0";
        std::map<std::string, size_t> index;
        for (const auto& [name, parent] : nodes) {
            index[name] = json["nodes"].size();
            json["nodes"].push_back({{"name", name}});
            json["skins"][0]["joints"].push_back(index[name]);
            if (*parent) json["nodes"][index.at(parent)]["children"].push_back(index[name]);
        }
        const std::string text = json.dump();
        const GltfDocument document(std::as_bytes(std::span(text.data(), text.size())));
        const HumanoidMap map = find_humanoid(document, "");
        for (size_t b = 0; b < size_t(kBoneCount); ++b)
            if (map.node[b] >= 0) names_[b] = document.node_name(map.node[b]);
    }
    const std::string& operator[](int bone) const { return names_[size_t(bone)]; }

private:
    std::array<std::string, kBoneCount> names_;
};

TEST(HumanoidMap, OfJointsTheOneAboveAnElbowIsTheUpperArm) {
    // SMPL.
    const NamedRig rig({{"Pelvis", ""},
                        {"L_Hip", "Pelvis"},
                        {"L_Knee", "L_Hip"},
                        {"L_Ankle", "L_Knee"},
                        {"L_Foot", "L_Ankle"},
                        {"R_Hip", "Pelvis"},
                        {"R_Knee", "R_Hip"},
                        {"R_Ankle", "R_Knee"},
                        {"R_Foot", "R_Ankle"},
                        {"Spine1", "Pelvis"},
                        {"Spine2", "Spine1"},
                        {"Spine3", "Spine2"},
                        {"Neck", "Spine3"},
                        {"Head", "Neck"},
                        {"L_Collar", "Spine3"},
                        {"L_Shoulder", "L_Collar"},
                        {"L_Elbow", "L_Shoulder"},
                        {"L_Wrist", "L_Elbow"},
                        {"L_Hand", "L_Wrist"},
                        // And a side without a collar bone, as Kinect's.
                        {"ShoulderRight", "Spine3"},
                        {"ElbowRight", "ShoulderRight"},
                        {"WristRight", "ElbowRight"}});
    EXPECT_EQ(rig[VFIT_BONE_LEFT_SHOULDER], "L_Collar");
    EXPECT_EQ(rig[VFIT_BONE_LEFT_UPPER_ARM], "L_Shoulder");
    EXPECT_EQ(rig[VFIT_BONE_LEFT_HAND], "L_Wrist");
    EXPECT_EQ(rig[VFIT_BONE_RIGHT_SHOULDER], "");
    EXPECT_EQ(rig[VFIT_BONE_RIGHT_UPPER_ARM], "ShoulderRight");
    EXPECT_EQ(rig[VFIT_BONE_LEFT_UPPER_LEG], "L_Hip");
    EXPECT_EQ(rig[VFIT_BONE_RIGHT_FOOT], "R_Ankle");
    EXPECT_EQ(rig[VFIT_BONE_HIPS], "Pelvis");
    EXPECT_EQ(rig[VFIT_BONE_SPINE], "Spine1");
}

TEST(HumanoidMap, AHeadThatIsCalledSpineIsFoundAboveTheArms) {
    // Rigify's deforming bones.
    const NamedRig rig({{"DEF-spine", ""},
                        {"DEF-pelvis.L", "DEF-spine"},
                        {"DEF-thigh.L", "DEF-spine"},
                        {"DEF-thigh.L.001", "DEF-thigh.L"},
                        {"DEF-shin.L", "DEF-thigh.L.001"},
                        {"DEF-foot.L", "DEF-shin.L"},
                        {"DEF-thigh.R", "DEF-spine"},
                        {"DEF-shin.R", "DEF-thigh.R"},
                        {"DEF-foot.R", "DEF-shin.R"},
                        {"DEF-spine.001", "DEF-spine"},
                        {"DEF-spine.002", "DEF-spine.001"},
                        {"DEF-spine.003", "DEF-spine.002"},
                        {"DEF-breast.L", "DEF-spine.003"},
                        {"DEF-shoulder.L", "DEF-spine.003"},
                        {"DEF-upper_arm.L", "DEF-shoulder.L"},
                        {"DEF-upper_arm.L.001", "DEF-upper_arm.L"},
                        {"DEF-forearm.L", "DEF-upper_arm.L.001"},
                        {"DEF-hand.L", "DEF-forearm.L"},
                        {"DEF-shoulder.R", "DEF-spine.003"},
                        {"DEF-upper_arm.R", "DEF-shoulder.R"},
                        {"DEF-forearm.R", "DEF-upper_arm.R"},
                        {"DEF-hand.R", "DEF-forearm.R"},
                        {"DEF-spine.004", "DEF-spine.003"},
                        {"DEF-spine.005", "DEF-spine.004"},
                        {"DEF-spine.006", "DEF-spine.005"},
                        {"DEF-jaw", "DEF-spine.006"},
                        {"DEF-eye.L", "DEF-spine.006"}});
    EXPECT_EQ(rig[VFIT_BONE_HEAD], "DEF-spine.006");
    EXPECT_EQ(rig[VFIT_BONE_NECK], "DEF-spine.004");
    EXPECT_EQ(rig[VFIT_BONE_UPPER_CHEST], "DEF-spine.003");
    EXPECT_EQ(rig[VFIT_BONE_SPINE], "DEF-spine.001");
    EXPECT_EQ(rig[VFIT_BONE_HIPS], "DEF-spine");
    EXPECT_EQ(rig[VFIT_BONE_LEFT_UPPER_ARM], "DEF-upper_arm.L");
    EXPECT_EQ(rig[VFIT_BONE_LEFT_UPPER_LEG], "DEF-thigh.L");
}

TEST(HumanoidMap, BonesThatBendAndTwistInHalvesAreOneLimb) {
    // Daz Genesis 8.
    const NamedRig rig({{"hip", ""},
                        {"pelvis", "hip"},
                        {"lThighBend", "pelvis"},
                        {"lThighTwist", "lThighBend"},
                        {"lShin", "lThighTwist"},
                        {"lFoot", "lShin"},
                        {"lToe", "lFoot"},
                        {"rThighBend", "pelvis"},
                        {"rThighTwist", "rThighBend"},
                        {"rShin", "rThighTwist"},
                        {"rFoot", "rShin"},
                        {"abdomenLower", "hip"},
                        {"abdomenUpper", "abdomenLower"},
                        {"chestLower", "abdomenUpper"},
                        {"chestUpper", "chestLower"},
                        {"lCollar", "chestUpper"},
                        {"lShldrBend", "lCollar"},
                        {"lShldrTwist", "lShldrBend"},
                        {"lForearmBend", "lShldrTwist"},
                        {"lForearmTwist", "lForearmBend"},
                        {"lHand", "lForearmTwist"},
                        {"rCollar", "chestUpper"},
                        {"rShldrBend", "rCollar"},
                        {"rForearmBend", "rShldrBend"},
                        {"rHand", "rForearmBend"},
                        {"neckLower", "chestUpper"},
                        {"neckUpper", "neckLower"},
                        {"head", "neckUpper"}});
    EXPECT_EQ(rig[VFIT_BONE_HIPS], "hip");
    EXPECT_EQ(rig[VFIT_BONE_SPINE], "abdomenLower");
    EXPECT_EQ(rig[VFIT_BONE_LEFT_UPPER_LEG], "lThighBend");
    EXPECT_EQ(rig[VFIT_BONE_RIGHT_LOWER_LEG], "rShin");
    EXPECT_EQ(rig[VFIT_BONE_LEFT_SHOULDER], "lCollar");
    EXPECT_EQ(rig[VFIT_BONE_LEFT_UPPER_ARM], "lShldrBend");
    EXPECT_EQ(rig[VFIT_BONE_LEFT_LOWER_ARM], "lForearmBend");
    EXPECT_EQ(rig[VFIT_BONE_HEAD], "head");
    EXPECT_EQ(rig[VFIT_BONE_NECK], "neckLower");
    EXPECT_EQ(rig[VFIT_BONE_UPPER_CHEST], "chestUpper");
}

TEST(Character, AScaleThatDiffersAlongItsAxesIsSaidAndShearsNothing) {
    EXPECT_TRUE(load(TinyCharacter()).notes.empty());
    TinyCharacter tiny;
    // The spine is scaled: all above it stands and turns below that scale.
    tiny.json["nodes"][1]["scale"] = {1, 1.3, 1};
    tiny.json["nodes"][3]["rotation"] = {0, 0, std::sin(0.2), std::cos(0.2)};
    const Character character = load(tiny);
    ASSERT_FALSE(character.notes.empty());
    EXPECT_NE(character.notes.back().find("differs along its axes"), std::string::npos);
    // The arm's own axes are sheared; a rotation keeps the first.
    const Vec3 first = glm::normalize(Vec3(std::cos(0.4f), 1.3f * std::sin(0.4f), 0));
    for (const AvatarBone& bone : character.source.bones)
        if (bone.bone == VFIT_BONE_LEFT_UPPER_ARM) {
            EXPECT_LT(glm::distance(bone.rest_rotation * Vec3(1, 0, 0), first), 1e-5f);
        }
    // Turned, the forearm is as long as it stands at rest.
    Avatar avatar(character.source, AvatarDesc());
    Pose pose;
    pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    avatar.pose(pose, *Jobs::own(0));
    const auto length = [&] {
        return glm::distance(avatar.joints().at(VFIT_JOINT_LEFT_ELBOW),
                             avatar.joints().at(VFIT_JOINT_LEFT_WRIST));
    };
    const float straight = length();
    pose.rotation[VFIT_BONE_LEFT_UPPER_ARM] = glm::angleAxis(-0.5f * kPi, Vec3(0, 0, 1));
    avatar.pose(pose, *Jobs::own(0));
    EXPECT_NEAR(length(), straight, 1e-4f);
}

TEST(Character, HipsAreWhatTrunkAndLegsHaveInCommon) {
    TinyCharacter tiny;
    tiny.json["nodes"][0]["name"] = "Root", tiny.json["nodes"][1]["name"] = "Hips";
    const Character character = load(tiny);
    EXPECT_EQ(hung(character, VFIT_BONE_HIPS).first, "Root");
    EXPECT_EQ(hung(character, VFIT_BONE_SPINE).first, "Hips");
}

TEST(Character, AFootThatHangsOnTheGroundGoesWithTheLeg) {
    TinyCharacter tiny;
    tiny.json["nodes"][10].erase("children");
    tiny.json["nodes"][0]["children"].push_back(11);
    tiny.json["nodes"][11]["translation"] = {0.1, -0.87, 0};
    const Character character = load(tiny);
    EXPECT_EQ(hung(character, VFIT_BONE_LEFT_FOOT),
              std::pair(std::string("leftFoot"), std::string("leftLowerLeg")));
    Avatar avatar(character.source, AvatarDesc());
    Pose pose;
    pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS];
    const Vec3 before = avatar.joints().at(VFIT_JOINT_LEFT_FOOT);
    pose.rotation[VFIT_BONE_LEFT_UPPER_LEG] = glm::angleAxis(-0.5f * kPi, Vec3(1, 0, 0));
    avatar.pose(pose, *Jobs::own(0));
    EXPECT_GT(avatar.joints().at(VFIT_JOINT_LEFT_FOOT).y, before.y + 0.5f) << "the leg is raised";
}

nlohmann::json turned_about_x(float angle) { return {std::sin(0.5f * angle), 0, 0, std::cos(0.5f * angle)}; }

TEST(Character, IsAtRestAsItsSkinIsBoundWhereTheSceneIsInMidStride) {
    const Character straight = load(TinyCharacter());
    TinyCharacter striding;
    striding.json["nodes"][9]["rotation"] = turned_about_x(-0.6f);
    striding.json["nodes"][10]["rotation"] = turned_about_x(0.8f);
    striding.json["nodes"][12]["rotation"] = turned_about_x(0.5f);
    // Whichever way the node of the mesh is turned, as exporters leave it.
    for (const bool turned : {false, true}) {
        if (turned) striding.json["nodes"][15]["rotation"] = turned_about_x(-0.5f * kPi);
        const Character got = load(striding);
        for (size_t v = 0; v < straight.source.rest.positions.size(); ++v)
            EXPECT_LT(glm::distance(got.source.rest.positions[v], straight.source.rest.positions[v]), 1e-4f)
                << v;
        EXPECT_EQ(hung(got, VFIT_BONE_LEFT_FOOT).first, "leftFoot");
    }
}

TEST(Character, IsAtRestAsTheSceneStandsWhereItStandsStraighter) {
    TinyCharacter tiny;
    // Bound with a bent leg: the matrix of the left shank leads elsewhere.
    auto* binds = reinterpret_cast<float*>(tiny.binary.data() +
                                           tiny.json["bufferViews"].back()["byteOffset"].get<size_t>());
    binds[16 * 11 + 14] -= 0.4f;  // the foot, 0.4 m further forward
    const Character got = load(tiny), straight = load(TinyCharacter());
    for (size_t b = 0; b < got.source.bones.size(); ++b)
        EXPECT_LT(glm::distance(got.source.bones[b].rest_head, straight.source.bones[b].rest_head), 0.05f)
            << got.source.bones[b].name;
}

TEST(Character, AHandEndsAtItsFingersAlsoBelowABoneThatStartsWhereItDoes) {
    TinyCharacter tiny;
    tiny.json["nodes"][5]["children"] = {16};
    tiny.json["nodes"].push_back({{"name", "inner"}, {"children", {17}}});
    tiny.json["nodes"].push_back({{"name", "finger"}, {"translation", {0.1, 0, 0}}});
    for (const size_t node : {16, 17}) tiny.json["skins"][0]["joints"].push_back(node);
    tiny.json["skins"][0].erase("inverseBindMatrices");
    for (const AvatarBone& bone : load(tiny).source.bones)
        if (bone.bone == VFIT_BONE_LEFT_HAND) {
            EXPECT_LT(glm::distance(bone.rest_tail, bone.rest_head + Vec3(0.1f, 0, 0)), 1e-4f);
        }
}

TEST(Character, ABoneThatNoSkinUsesIsOneWhereAMapNamesIt) {
    TinyCharacter tiny;
    tiny.json["nodes"][11]["children"] = {16};
    tiny.json["nodes"].push_back({{"name", "tip"}, {"translation", {0, 0, 0.1}}});
    EXPECT_EQ(hung(load(tiny), VFIT_BONE_LEFT_TOES).first, "");
    EXPECT_EQ(hung(load(tiny, R"({"leftToes": "tip"})"), VFIT_BONE_LEFT_TOES),
              std::pair(std::string("tip"), std::string("leftFoot")));
}

TEST(Character, WhereBonesMissTheTreeAndAMapToFillInAreTold) {
    TinyCharacter tiny;
    for (const size_t leg : {9, 10, 11}) tiny.json["nodes"][leg]["name"] = "stick";
    expect_error(tiny, "no bone for leftUpperLeg, leftLowerLeg, leftFoot");
    expect_error(tiny, "\"leftUpperLeg\": \"\"");
    expect_error(tiny, "\"rightUpperLeg\": \"rightUpperLeg\"");
    expect_error(tiny, "\n    stick\n");
}

TEST(Character, ScaleIsMetresInAUnitOfTheFile) {
    const Character as_it_is = load(TinyCharacter());
    const Character twice = load_character(GltfDocument(TinyCharacter().glb()), "", 2.0f);
    for (size_t v = 0; v < as_it_is.source.rest.positions.size(); ++v)
        EXPECT_LT(glm::distance(twice.source.rest.positions[v], 2.0f * as_it_is.source.rest.positions[v]),
                  1e-4f);
    EXPECT_THROW(load_character(GltfDocument(TinyCharacter().glb()), "", 3.0f), Error) << "too tall";
}

TEST(Character, ThoseOfOtherMakersAreKnown) {
    const std::string folder = test::shared_data("field/characters");
    if (folder.empty()) GTEST_SKIP() << "no shared/data/field/characters";
    struct Case {
        const char* file;
        float scale;
        const char *hips, *left_hand, *right_foot;
    };
    for (const Case& c :
         {Case{"CesiumMan.glb", 1.0f, "Skeleton_torso_joint_1", "Skeleton_arm_joint_L__2_", "leg_joint_R_3"},
          Case{"RobotExpressive.glb", 0.4f, "Body", "Palm2.L", "Foot.R"},
          Case{"q_modular_women_Suit.glb", 1.0f, "Root", "Hand.L", "Foot.R"},
          Case{"q_single_knight_pack_KnightCharacter.glb", 0.3f, "Body", "Palm.L", "Foot.R"}}) {
        const Character character = load_character(GltfDocument(folder + "/" + c.file), "", c.scale);
        EXPECT_EQ(hung(character, VFIT_BONE_HIPS).first, c.hips) << c.file;
        EXPECT_EQ(hung(character, VFIT_BONE_LEFT_HAND).first, c.left_hand) << c.file;
        EXPECT_EQ(hung(character, VFIT_BONE_RIGHT_FOOT).first, c.right_foot) << c.file;
    }
}

TEST(Character, AreRefusedWithTheReason) {
    const auto with = [](auto&& change) {
        TinyCharacter tiny;
        change(tiny.json);
        return tiny;
    };
    expect_error(with([](auto& j) { j["nodes"][3]["children"].push_back(1); }), "");  // two parents, a ring
    expect_error(with([](auto& j) { j["nodes"][11]["children"] = {99}; }), "child 99");
    expect_error(with([](auto& j) { j["skins"][0]["joints"][2] = 77; }), "node 77");
    expect_error(with([](auto& j) { j["accessors"][0]["count"] = 4000000000u; }), "beyond its buffer");
    expect_error(with([](auto& j) { j["accessors"][0]["byteOffset"] = 1u << 30; }), "beyond its buffer");
    expect_error(with([](auto& j) { j["bufferViews"][1]["byteOffset"] = 1u << 20; }), "");
    expect_error(with([](auto& j) { j["accessors"][0]["type"] = "VEC2"; }), "another shape");
    expect_error(with([](auto& j) { j["accessors"][1]["componentType"] = 5122; }), "whole numbers");
    expect_error(with([](auto& j) { j["accessors"][2]["count"] = 7; }), "another count");
    expect_error(with([](auto& j) { j["meshes"][0]["primitives"][0]["attributes"].erase("POSITION"); }),
                 "positions");
    expect_error(with([](auto& j) { j["nodes"][15]["mesh"] = 4; }), "mesh that is not there");
    expect_error(with([](auto& j) { j["nodes"][15]["skin"] = 4; }), "skin that is not there");
    expect_error(with([](auto& j) { j["nodes"][3]["scale"] = {0, 0, 0}; }), "scaled to nothing");
    expect_error(with([](auto& j) { j["nodes"][3]["scale"] = {-1, 1, 1}; }), "mirrored",
                 VFIT_ERROR_UNSUPPORTED);
    expect_error(with([](auto& j) { j["nodes"][0]["translation"] = {0, 1e30, 0}; }), "");
    expect_error(with([](auto& j) { j["asset"]["version"] = "1.0"; }), "version", VFIT_ERROR_UNSUPPORTED);
    expect_error(with([](auto& j) {
                     j["accessors"][0]["sparse"] = {{"count", 1},
                                                    {"indices", {{"bufferView", 0}, {"componentType", 5123}}},
                                                    {"values", {{"bufferView", 0}}}};
                 }),
                 "sparse", VFIT_ERROR_UNSUPPORTED);
}

/// A .gltf beside a buffer of its own.
class OwnFolder : public testing::Test {
protected:
    void SetUp() override {
        folder =
            std::filesystem::temp_directory_path() / ("vfit_gltf_" + std::to_string(std::random_device()()));
        std::filesystem::create_directories(folder / "inside" / "buffers");
        before = std::filesystem::current_path();
    }
    void TearDown() override {
        std::filesystem::current_path(before);
        std::filesystem::remove_all(folder);
    }
    void write(const std::filesystem::path& name, const std::string& bytes) const {
        std::ofstream(folder / name, std::ios::binary) << bytes;
    }
    std::string text_with(const std::string& uri) const {
        TinyCharacter tiny;
        tiny.json["buffers"][0]["uri"] = uri;
        return tiny.json.dump();
    }
    std::string buffer() const {
        const TinyCharacter tiny;
        return {tiny.binary.begin(), tiny.binary.end()};
    }
    bool loads(const std::string& uri) const {
        write("inside/c.gltf", text_with(uri));
        try {
            load_character(GltfDocument((folder / "inside" / "c.gltf").string()), "");
            return true;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), VFIT_ERROR_DATA) << error.what();
            return false;
        }
    }
    std::filesystem::path folder, before;
};

TEST_F(OwnFolder, IsTheOnlyPlaceThatAFileMayReadFrom) {
    for (const char* name : {"inside/own.bin", "inside/buffers/own.bin", "outside.bin"})
        write(name, buffer());
    EXPECT_TRUE(loads("own.bin"));
    EXPECT_TRUE(loads("buffers/own.bin"));
    EXPECT_FALSE(loads("../outside.bin"));
    EXPECT_FALSE(loads("buffers/../../outside.bin"));
    EXPECT_FALSE(loads((folder / "outside.bin").string()));
    EXPECT_FALSE(loads("missing.bin"));
    EXPECT_FALSE(loads("buffers"));         // a folder
    std::filesystem::current_path(folder);  // nor is where the host happens to work
    EXPECT_FALSE(loads("outside.bin"));
    // By a bare name its folder is the one the host works in.
    EXPECT_TRUE(loads("own.bin"));
    std::filesystem::current_path(folder / "inside");
    EXPECT_NO_THROW(load_character(GltfDocument(std::string("c.gltf")), ""));
}

TEST_F(OwnFolder, OfAFileInMemoryIsNone) {
    write("inside/own.bin", buffer());
    std::filesystem::current_path(folder / "inside");
    const std::string text = text_with("own.bin");
    EXPECT_THROW(GltfDocument(std::as_bytes(std::span(text.data(), text.size()))), Error);
}

TEST(Character, AskedForTooMuchIsRefusedAtOnce) {
    const auto refused = [](const std::vector<std::byte>& bytes, const char* word) {
        try {
            load_character(GltfDocument(bytes), "");
            ADD_FAILURE() << "accepted: " << word;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), VFIT_ERROR_DATA);
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    };
    refused(std::vector<std::byte>(1 << 20, std::byte('[')), "deeper");
    TinyCharacter deep;
    deep.json["extras"] = nlohmann::json::parse(std::string(200, '[') + std::string(200, ']'));
    refused(deep.glb(), "deeper");
    TinyCharacter nodes;
    for (int i = 0; i < 60001; ++i) nodes.json["nodes"].push_back(nlohmann::json::object());
    refused(nodes.glb(), "nodes");
    TinyCharacter copies;  // 48,000 nodes show one mesh of 180 triangles, 540 corners
    for (int i = 0; i < 48000; ++i) copies.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
    refused(copies.glb(), "triangles");
    TinyCharacter map;
    try {
        load(map, std::string(100000, '['));
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), VFIT_ERROR_DATA);
    }
}

TEST(Character, AChunkThatReachesBeyondTheFileIsRefused) {
    const std::vector<std::byte> good = TinyCharacter().glb();
    const auto refused = [](std::vector<std::byte> bad, const char* word) {
        try {
            const GltfDocument document(bad);
            ADD_FAILURE() << "accepted: " << word;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), VFIT_ERROR_DATA);
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        }
    };
    const auto with = [&](size_t at, uint32_t value, size_t cut) {
        std::vector<std::byte> bad(good.begin(), good.end() - long(cut));
        std::memcpy(bad.data() + at, &value, 4);
        return bad;
    };
    refused(with(8, uint32_t(good.size()), 1), "it is cut");
    // By the eight bytes before the chunk.
    refused(with(8, uint32_t(good.size()) - 4, 4), "beyond its end");
    refused(with(12, uint32_t(good.size()), 0), "beyond its end");
}

TEST(Character, DamageNeverReadsBeyondTheFile) {
    const std::vector<std::byte> good = TinyCharacter().glb();
    uint32_t text_size = 0;
    std::memcpy(&text_size, good.data() + 12, 4);
    std::mt19937 bits(3);
    int accepted = 0;
    for (int run = 0; run < 600; ++run) {
        std::vector<std::byte> bad = good;
        if (run % 3 == 0) {
            bad.resize(bits() % bad.size());
        } else {
            // Digits of the text lead somewhere else, or any byte of the file is another one.
            for (int k = 0; k < 3; ++k) {
                size_t at = bits() % bad.size();
                if (run % 3 == 1) do
                        at = 20 + bits() % text_size;
                    while (!std::isdigit(std::to_integer<int>(bad[at])));
                bad[at] = std::byte(run % 3 == 1 ? '0' + bits() % 10 : bits());
            }
        }
        try {
            const Character character = load_character(GltfDocument(bad), "");
            Avatar avatar(character.source, AvatarDesc());
            ++accepted;
        } catch (const Error& error) {
            EXPECT_TRUE(error.code() == VFIT_ERROR_DATA || error.code() == VFIT_ERROR_UNSUPPORTED)
                << error.what();
        }
    }
    EXPECT_GT(accepted, 10);  // many a digit does no harm
}

}  // namespace
}  // namespace vfit
