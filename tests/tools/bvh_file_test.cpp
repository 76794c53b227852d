// BVH files: how joints are posed, which fault of a file is named how, and where vfit's joints are found.
#include "client/bvh_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "client/bvh_joints.h"
#include "client/client.h"

namespace vfit::tools {
namespace {

class Bvh : public testing::Test {
protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        path_ = (std::filesystem::temp_directory_path() / ("vfit_bvh_" + std::string(test->name()))).string();
    }
    void TearDown() override { std::filesystem::remove(path_); }
    const std::string& written(const std::string& text) {
        std::ofstream(path_, std::ios::binary) << text;
        return path_;
    }
    std::vector<JointRow> joints(const std::string& text, const BvhOptions& options = {}) {
        return read_bvh_joints(context_.get(), written(text), options);
    }
    void expect_fault(const std::string& text, const std::vector<std::string>& words,
                      const BvhOptions& options = {}) {
        try {
            joints(text, options);
            ADD_FAILURE() << "accepted: " << words.front();
        } catch (const Failure& failure) {
            const std::string said = failure.what();
            EXPECT_EQ(said.find(path_), 0u) << said;
            for (const std::string& word : words) EXPECT_NE(said.find(word), std::string::npos) << said;
        }
    }

    Context context_ = open_context();
    std::string path_;
};

/// A person of 1.7 m in T-pose, to be written with any unit and axes.
struct Person {
    float unit_m = 0.01f;
    bool is_z_up = false;
    bool root_turns_up = false;  // it is so at rest alone
    bool lies = false;           // at rest, along X; the root turns it up
    bool has_left_leg = true;

    std::string offset(float x, float y, float z) const {
        if (is_z_up) std::swap(y, z), y = -y;
        if (lies) std::swap(x, y), y = -y;
        std::string out = " OFFSET";
        for (const float v : {x, y, z}) out += " " + std::to_string(v / unit_m);
        return out + "\n";
    }
    std::string joint(const std::string& name, float x, float y, float z, const std::string& below) const {
        return "JOINT " + name + "\n{\n" + offset(x, y, z) + "CHANNELS 3 Zrotation Xrotation Yrotation\n" +
               below + "}\n";
    }
    std::string end(float x, float y, float z) const { return "End Site\n{\n" + offset(x, y, z) + "}\n"; }
    std::string text(const std::string& frames) const {
        const auto leg = [&](const std::string& side, float x) {
            return joint(
                side + "UpLeg", x, -0.05f, 0,
                joint(side + "Leg", 0, -0.42f, 0, joint(side + "Foot", 0, -0.41f, 0, end(0, -0.07f, 0.15f))));
        };
        const auto arm = [&](const std::string& side, float s) {
            return joint(side + "Arm", 0.18f * s, 0.40f, 0,
                         joint(side + "ForeArm", 0.28f * s, 0, 0,
                               joint(side + "Hand", 0.25f * s, 0, 0, end(0.1f * s, 0, 0))));
        };
        return "HIERARCHY\nROOT Hips\n{\n" + offset(0, 0, 0) +
               "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n" +
               joint("Spine", 0, 0.1f, 0,
                     joint("Neck", 0, 0.45f, 0, joint("Head", 0, 0.1f, 0, end(0, 0.2f, 0))) + arm("Left", 1) +
                         arm("Right", -1)) +
               (has_left_leg ? leg("Left", 0.1f) : "") + leg("Right", -0.1f) + "}\n" + frames;
    }
    /// The hips 0.95 m above the floor; the left arm turned about the axis that points forward.
    std::string standing(float arm_deg) const {
        const std::string height = std::to_string(0.95f / unit_m);
        std::string row = is_z_up && !root_turns_up ? "0 0 " + height : "0 " + height + " 0";
        row += lies ? " 90 0 0" : root_turns_up ? " 0 -90 0" : " 0 0 0";
        const int joints = has_left_leg ? 15 : 12;
        for (int j = 0; j < joints; ++j)
            row += j != 3 ? " 0 0 0"
                          : (is_z_up ? " 0 0 " : " ") + std::to_string(is_z_up ? -arm_deg : arm_deg) +
                                (is_z_up ? "" : " 0 0");
        return row + "\n";
    }
    std::string file() const {
        return text("MOTION\nFrames: 3\nFrame Time: 0.04\n" + standing(0) + standing(-45) + standing(-90));
    }
};

glm::vec3 at(const JointRow& row, vfit_joint_id joint) {
    for (const vfit_joint& j : row.joints)
        if (j.joint == joint) return {j.position[0], j.position[1], j.position[2]};
    return glm::vec3(NAN);
}

TEST_F(Bvh, ChannelsTurnInTheOrderOfTheFile) {
    const BvhFile file = read_bvh(written(
        "HIERARCHY\nROOT a b\n{\nOFFSET 1 2 3\nCHANNELS 6 Zposition Xposition Yposition Yrotation "
        "Xrotation Zrotation\nJOINT c\n{\nOFFSET 0 0 2\nCHANNELS 1 Xrotation\nEnd Site\n{\nOFFSET 0 1 "
        "0\n}\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.5\n30 10 20 90 90 0 90\n"));
    ASSERT_EQ(file.joints.size(), 3u);
    EXPECT_EQ(file.joints[0].name, "a b");
    EXPECT_EQ(file.joints[2].name, "c_end");
    EXPECT_EQ(file.rest()[2], glm::vec3(1, 3, 5));
    const std::vector<glm::mat4> pose = file.pose(0);
    EXPECT_EQ(glm::vec3(pose[0][3]), glm::vec3(10, 20, 30));
    // Y * X takes +Z to -Y, then to -Y; and so on.
    EXPECT_LT(glm::distance(glm::vec3(pose[1][3]), glm::vec3(10, 18, 30)), 1e-5f);
    // The end: X of the joint takes +Y to +Z, which the root takes to -Y.
    EXPECT_LT(glm::distance(glm::vec3(pose[2][3]), glm::vec3(10, 17, 30)), 1e-5f);
}

TEST_F(Bvh, JointsAreWhereTheBonesBringThemInAnyUnitAndAxes) {
    Person inches, z_up, cmu, turned_up, lying;
    turned_up.is_z_up = turned_up.root_turns_up = true;
    lying.lies = true;
    inches.unit_m = 0.0254f;
    z_up.is_z_up = true, z_up.unit_m = 1.0f;
    cmu.unit_m = 0.0254f / 0.45f;
    for (const Person& person : {Person(), inches, z_up, cmu, turned_up, lying}) {
        const std::vector<JointRow> rows = joints(person.file());
        ASSERT_EQ(rows.size(), 3u);
        EXPECT_EQ(rows[2].time_ns, 80'000'000);
        EXPECT_EQ(rows[0].joints.size(), size_t(VFIT_JOINT_COUNT));
        for (const JointRow& row : rows) {
            // The ankles stand 8 cm above the floor.
            EXPECT_LT(glm::distance(at(row, VFIT_JOINT_LEFT_FOOT), glm::vec3(0.1f, 0.08f, 0)), 2e-3f);
            EXPECT_LT(glm::distance(at(row, VFIT_JOINT_LEFT_TOES), glm::vec3(0.1f, 0.01f, 0.15f)), 2e-3f);
            EXPECT_LT(glm::distance(at(row, VFIT_JOINT_PELVIS), glm::vec3(0, 0.96f, 0)), 2e-3f);
            EXPECT_LT(glm::distance(at(row, VFIT_JOINT_RIGHT_WRIST), glm::vec3(-0.71f, 1.46f, 0)), 2e-3f);
        }
        const glm::vec3 shoulder(0.18f, 1.46f, 0);
        for (const JointRow& row : rows)
            EXPECT_LT(glm::distance(at(row, VFIT_JOINT_LEFT_SHOULDER), shoulder), 2e-3f);
        EXPECT_LT(glm::distance(at(rows[0], VFIT_JOINT_LEFT_WRIST), glm::vec3(0.71f, 1.46f, 0)), 2e-3f);
        EXPECT_LT(glm::distance(at(rows[2], VFIT_JOINT_LEFT_WRIST), glm::vec3(0.18f, 0.93f, 0)), 2e-3f);
        EXPECT_LT(glm::distance(at(rows[2], VFIT_JOINT_LEFT_ELBOW), glm::vec3(0.18f, 1.18f, 0)), 2e-3f);
        EXPECT_LT(at(rows[2], VFIT_JOINT_LEFT_HAND).y, 0.9f) << "the hand hangs below the wrist";
    }
}

TEST_F(Bvh, AScaleGoesBeforeTheStature) {
    const auto rows = joints(Person().file(), {"", 0.008f});
    EXPECT_NEAR(at(rows[0], VFIT_JOINT_LEFT_WRIST).x, 0.8f * 0.71f, 2e-3f);
    Person giant;
    giant.unit_m = 0.003f;
    expect_fault(giant.file(), {"units tall", "--scale"});
    EXPECT_NEAR(at(joints(giant.file(), {"", 0.003f})[0], VFIT_JOINT_LEFT_WRIST).x, 0.71f, 2e-3f);
}

TEST_F(Bvh, AMissingBoneIsToldWithTheTreeAndAMapToFillIn) {
    Person person;
    person.has_left_leg = false;
    expect_fault(person.file(), {"no bone for leftUpperLeg, leftLowerLeg, leftFoot", "\"leftUpperLeg\": \"\"",
                                 "\n        LeftForeArm\n"});
    person = Person();
    std::string odd = person.file();
    for (size_t p; (p = odd.find("LeftForeArm")) != std::string::npos;) odd.replace(p, 11, "Ast");
    for (size_t p; (p = odd.find("LeftArm")) != std::string::npos;) odd.replace(p, 7, "Zweig");
    expect_fault(odd, {"leftUpperArm"});
    const auto rows = joints(odd, {R"({"leftUpperArm": "Zweig", "leftLowerArm": "Ast"})", 0.0f});
    EXPECT_LT(glm::distance(at(rows[2], VFIT_JOINT_LEFT_ELBOW), glm::vec3(0.18f, 1.18f, 0)), 2e-3f);
}

TEST_F(Bvh, FaultsAreNamedWithTheirLine) {
    const std::string good = Person().file();
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        return text;
    };
    expect_fault("HIERARCHY\n", {"line 2", "the end of the file", "ROOT"});
    expect_fault(changed("OFFSET 0.000000 10.000000", "OFFSET 0.000000 ten"), {"line 8", "Spine", "'ten'"});
    expect_fault(changed("Zrotation", "Wrotation"), {"line 5", "'Wrotation'", "Xposition"});
    expect_fault(changed("CHANNELS 3", "CHANNELS 7"), {"line 9", "channels of Spine", "'7'"});
    expect_fault(changed("JOINT Spine", "JUNCTION Spine"), {"line 6", "'JUNCTION'"});
    expect_fault(changed("MOTION", "ROOT b\n{\nOFFSET 0 0 0\nCHANNELS 0\n}\nMOTION"), {"second ROOT"});
    expect_fault(changed("Frames: 3", "Frames: 0"), {"no frame"});
    expect_fault(changed("Frames: 3", "Frames: -3"), {"'-3'"});
    expect_fault(changed("Frames: 3", "Frames: 4"), {"the file ends", "Xposition", "frame 3 of 4"});
    expect_fault(changed("Frames: 3", "Frames: 2"), {"more values than 2 frames of 51"});
    expect_fault(changed("Time: 0.04", "Time: 0"), {"above 0"});
    expect_fault(changed("Time: 0.04", "Time: 4"), {"4 s apart"});
    expect_fault(changed("Time: 0.04\n0 ", "Time: 0.04\nnan "), {"'nan'", "Xposition of Hips in frame 0"});
    expect_fault(changed("Time: 0.04\n0 ", "Time: 0.04\n1e99 "), {"'1e99'"});
    expect_fault(good.substr(0, good.size() / 3), {"line"});
    expect_fault(good.substr(0, good.size() - 9), {"the file ends"});
}

TEST_F(Bvh, DamageIsAnErrorAndNoHarm) {
    const std::string good = Person().file();
    std::mt19937 bits(4);
    int refused = 0;
    for (int run = 0; run < 300; ++run) {
        std::string bad = good;
        if (run % 3 == 0) bad.resize(bits() % bad.size());
        for (int k = 0; k < 2 && !bad.empty(); ++k) bad[bits() % bad.size()] = char(bits());
        try {
            joints(bad);
        } catch (const Failure&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 150);
    EXPECT_LT(refused, 300);
}

TEST_F(Bvh, AreKnownByTheirFirstWord) {
    EXPECT_TRUE(is_bvh_file(written("\n hierarchy\r\nROOT a")));
    EXPECT_FALSE(is_bvh_file(written("time_s,HEAD_x")));
    EXPECT_FALSE(is_bvh_file(written("")));
    EXPECT_FALSE(is_bvh_file("/no/such/file"));
}

}  // namespace
}  // namespace vfit::tools
