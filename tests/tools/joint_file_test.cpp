// Files of joints without pictures: what is read, and which fault of a file is named how.
#include "client/joint_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "client/client.h"

namespace vfit::tools {
namespace {

class JointFile : public testing::Test {
protected:
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        path_ =
            (std::filesystem::temp_directory_path() / ("vfit_joints_" + std::string(test->name()))).string();
    }
    void TearDown() override { std::filesystem::remove(path_); }
    std::vector<JointRow> read(const std::string& text) {
        std::ofstream(path_, std::ios::binary) << text;
        return read_joint_file(path_);
    }
    std::string fault(const std::string& text) {
        try {
            read(text);
        } catch (const Failure& failure) {
            const std::string said = failure.what();
            EXPECT_EQ(said.find(path_), 0u) << said;
            return said.substr(path_.size());
        }
        return "no fault";
    }
    std::string path_;
};

void expect_words(const std::string& text, const std::vector<std::string>& words) {
    for (const std::string& word : words)
        EXPECT_NE(text.find(word), std::string::npos) << word << ": " << text;
}

constexpr const char* kHeader = "time_s,HEAD_x,HEAD_y,HEAD_z,HEAD_confidence,PELVIS_x,PELVIS_y,PELVIS_z\n";

std::string table(std::string_view rows) { return std::string(kHeader).append(rows); }

using Change = std::function<void(size_t row, std::vector<std::string>& cells)>;

/// Three rows of a Kinect v2: the person stands 2.5 m away, their left at -X.
std::string kinect2(const Change& change = [](size_t, std::vector<std::string>&) {}) {
    std::string text;
    for (size_t row = 0; row < 3; ++row) {
        std::vector<std::string> cells{std::to_string(89810293609 + int64_t(row) * 333'000)};
        for (int joint = 0; joint < 25; ++joint) {
            const double x = joint == 4 ? -0.2 : joint == 8 ? 0.2 : 0.0;
            const double y = joint == 3 ? 0.6 : joint == 14 || joint == 18 ? -0.9 : 0.0;
            for (const double v : {x, y, 2.5}) cells.push_back(std::to_string(v));
            cells.push_back(joint == 5 ? "1" : joint == 6 ? "0" : "2");
        }
        change(row, cells);
        for (size_t c = 0; c < cells.size(); ++c) text += (c ? "," : "") + cells[c];
        text += "\n";
    }
    return text;
}

const vfit_joint* find(const JointRow& row, vfit_joint_id id) {
    for (const vfit_joint& joint : row.joints)
        if (joint.joint == id) return &joint;
    return nullptr;
}

TEST_F(JointFile, ATableIsReadAsItStands) {
    const auto rows =
        read(table("0.5,0.1,1.6,-2,0.9,0.2,0.9,-2\r\n"
                   "\n"
                   "0.533,nan,nan,NaN,0.9, 0.2 ,0.9,-2\n"
                   "0.566,0.1,1.6,-2,0.3,,,\n"
                   "0.6,0.1,1.6,-2,0.1,0.2,0.9,-2"));
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0].time_ns, 500'000'000);
    const vfit_joint* head = find(rows[0], VFIT_JOINT_HEAD);
    ASSERT_TRUE(head);
    EXPECT_EQ(head->state, VFIT_JOINT_MEASURED);
    EXPECT_FLOAT_EQ(head->confidence, 0.9f);
    EXPECT_FLOAT_EQ(head->position[1], 1.6f);
    EXPECT_FLOAT_EQ(find(rows[0], VFIT_JOINT_PELVIS)->confidence, 1.0f);
    EXPECT_FALSE(find(rows[1], VFIT_JOINT_HEAD)) << "three NaN: not seen";
    EXPECT_TRUE(find(rows[1], VFIT_JOINT_PELVIS));
    EXPECT_EQ(find(rows[2], VFIT_JOINT_HEAD)->state, VFIT_JOINT_INFERRED);
    EXPECT_FALSE(find(rows[2], VFIT_JOINT_PELVIS)) << "three empty fields: not seen";
    EXPECT_FALSE(find(rows[3], VFIT_JOINT_HEAD)) << "hardly any confidence: not seen";
}

TEST_F(JointFile, RowsOfAKinectV2AreTurnedIntoTheWorldAndStoodOnTheFloor) {
    const auto rows = read(kinect2());
    ASSERT_EQ(rows.size(), 3u);
    EXPECT_EQ(rows[1].time_ns - rows[0].time_ns, 33'300'000);
    const vfit_joint* left = find(rows[0], VFIT_JOINT_LEFT_SHOULDER);
    ASSERT_TRUE(left);
    EXPECT_FLOAT_EQ(left->position[0], 0.2f) << "the left is at +X";
    EXPECT_FLOAT_EQ(left->position[2], -2.5f);
    EXPECT_FLOAT_EQ(find(rows[0], VFIT_JOINT_LEFT_FOOT)->position[1], 0.08f);
    EXPECT_FLOAT_EQ(find(rows[0], VFIT_JOINT_HEAD)->position[1], 1.58f);
    EXPECT_EQ(find(rows[0], VFIT_JOINT_LEFT_ELBOW)->state, VFIT_JOINT_INFERRED);
    EXPECT_FALSE(find(rows[0], VFIT_JOINT_LEFT_WRIST)) << "not tracked";
    const auto with_commas = read(kinect2([](size_t, auto& cells) { cells.push_back(""); }));
    EXPECT_EQ(with_commas.size(), 3u) << "recorders end a row with a comma";
}

TEST_F(JointFile, WhatIsNoStreamOfJointsIsToldWhatIsWanted) {
    expect_words(fault(""), {"empty", "time_s"});
    expect_words(fault("\n \n"), {"empty"});
    expect_words(fault("hello, world\n"), {"line 1", "'hello'", "time_s", "Kinect v2"});
    expect_words(fault("1,2,3\n"), {"line 1", "has 3", "101 columns"});
    expect_words(fault("TIME_S,HEAD_x,HEAD_y,HEAD_z\n"), {"'TIME_S'"});
    expect_words(fault(kHeader), {"no row"});
}

TEST_F(JointFile, AWrongHeaderIsNamed) {
    expect_words(fault("time_s,NOSE_x,NOSE_y,NOSE_z\n"), {"line 1", "column 2", "'NOSE_x'", "LEFT_ELBOW"});
    expect_words(fault("time_s,HEAD_x,HEAD_y\n"), {"line 1", "HEAD_z is missing"});
    expect_words(fault("time_s,HEAD_x,HEAD_y,HEAD_z,HEAD_y\n"), {"column 5", "twice"});
    expect_words(fault("time_s,HEAD_x,HEAD_y,HEAD_z,HEAD\n"), {"column 5", "'HEAD'", "_confidence"});
    expect_words(fault("time_s\n0\n"), {"no joint"});
}

TEST_F(JointFile, AWrongRowIsNamedByLineAndColumn) {
    const auto row = [&](const std::string& text) {
        return fault(table("0,0.1,1.6,-2,0.9,0.2,0.9,-2\n" + text + "\n"));
    };
    expect_words(row("0.03,0.1,1.6,-2,0.9,0.2"), {"line 3", "6 columns", "8"});
    expect_words(row("0.03,0.1,1.6,-2,0.9,0.2,0.9,-2,7"), {"line 3", "9 columns"});
    expect_words(row("0.03,0.1,abc,-2,0.9,0.2,0.9,-2"), {"line 3", "column 3", "'abc'"});
    expect_words(row("0.03,0.1,1.6m,-2,0.9,0.2,0.9,-2"), {"column 3", "'1.6m'"});
    expect_words(row("0.03,0.1,inf,-2,0.9,0.2,0.9,-2"), {"column 3", "'inf'"});
    expect_words(row("0.03,0.1,nan,-2,0.9,0.2,0.9,-2"), {"line 3", "HEAD", "some of its coordinates"});
    expect_words(row("0.03,0.1,1.6,-2,1.5,0.2,0.9,-2"), {"column 5", "confidence"});
    expect_words(row("nan,0.1,1.6,-2,0.9,0.2,0.9,-2"), {"column 1", "'nan'"});
    expect_words(row("1e30,0.1,1.6,-2,0.9,0.2,0.9,-2"), {"column 1", "seconds"});
    expect_words(row("0,0.1,1.6,-2,0.9,0.2,0.9,-2"), {"line 3", "column 1", "not after"});
    expect_words(row("-1,0.1,1.6,-2,0.9,0.2,0.9,-2"), {"not after"});
}

TEST_F(JointFile, AWrongRowOfAKinectV2IsNamed) {
    const auto changed = [&](size_t column, const std::string& value) {
        return fault(kinect2([&](size_t row, auto& cells) {
            if (row == 1) cells[column] = value;
        }));
    };
    expect_words(changed(0, "89810293609"), {"line 2", "column 1", "not after"});
    expect_words(changed(0, "99999999999999999999"), {"line 2", "column 1"});
    expect_words(changed(7, "x"), {"line 2", "column 8", "'x'"});
    expect_words(changed(8, "3"), {"line 2", "column 9", "tracking state"});
    expect_words(fault(kinect2([](size_t row, auto& cells) {
                     if (row == 2) cells.resize(60);
                 })),
                 {"line 3", "60 columns", "101"});
    const auto rows = read(kinect2([](size_t, auto& cells) { cells[14] = "nan"; }));
    EXPECT_FALSE(find(rows[0], VFIT_JOINT_HEAD)) << "a joint without a place was not seen";
}

TEST_F(JointFile, AnotherUnitIsNamed) {
    const auto scaled = [&](double unit, double second) {
        std::string text = kHeader;
        for (int i = 0; i < 5; ++i) {
            text += std::to_string(second * 0.033 * i);
            for (const double v : {0.1, 1.6, -2.0}) text += "," + std::to_string(unit * v);
            text += ",1";
            for (const double v : {0.1, 0.9, -2.0}) text += "," + std::to_string(unit * v);
            text += "\n";
        }
        return fault(text);
    };
    EXPECT_EQ(scaled(1, 1), "no fault");
    expect_words(scaled(1000, 1), {"700", "metres", "millimetres?"});
    expect_words(scaled(100, 1), {"70", "centimetres?"});
    expect_words(scaled(0.001, 1), {"no person in metres"});
    expect_words(scaled(1, 1000), {"33 s apart", "another unit"});
    expect_words(scaled(1, 1e-3), {"another unit"});
    expect_words(fault(kinect2([](size_t, auto& cells) {
                     for (size_t c = 1; c < cells.size(); ++c)
                         if (c % 4 != 0) cells[c] = std::to_string(1000.0 * std::stod(cells[c]));
                 })),
                 {"millimetres?"});
}

TEST_F(JointFile, APersonBelowTheFloorIsNamed) {
    expect_words(fault(table("0,0,0.3,2,1,0,-0.6,2\n0.03,0,0.3,2,1,0,-0.6,2\n")), {"-0.6", "floor"});
}

TEST_F(JointFile, DamagedFilesGiveUsableRowsOrAFault) {
    const std::string whole[] = {table("0,0.1,1.6,-2,0.9,0.2,0.9,-2\n0.03,0.1,1.6,-2,0.4,,,\n"), kinect2()};
    constexpr std::string_view kBytes = "0123456789.,-+einfa\n\r \0\xff";
    std::mt19937 bits(1);
    size_t read_ones = 0, faults = 0;
    for (int run = 0; run < 1000; ++run) {
        std::string text = whole[run % 2];
        for (size_t n = 1 + bits() % 2; n > 0 && !text.empty(); --n) {
            const size_t at = bits() % text.size();
            if (bits() % 3 == 0)
                text.erase(at, bits() % 40);
            else
                text[at] = kBytes[bits() % kBytes.size()];
        }
        try {
            const auto rows = read(text);
            ++read_ones;
            for (size_t i = 0; i < rows.size(); ++i) {
                ASSERT_TRUE(i == 0 || rows[i].time_ns > rows[i - 1].time_ns) << text;
                for (const vfit_joint& joint : rows[i].joints)
                    for (const float v : joint.position) ASSERT_TRUE(std::isfinite(v)) << text;
            }
        } catch (const Failure&) {
            ++faults;
        }
    }
    EXPECT_GT(read_ones, 100u);
    EXPECT_GT(faults, 100u);
}

TEST_F(JointFile, OnlyFilesOfTextAreTakenForJoints) {
    std::ofstream(path_, std::ios::binary) << "time_s,HEAD_x\n";
    EXPECT_TRUE(is_joint_file(path_));
    std::ofstream(path_, std::ios::binary) << std::string("ONI1\0\0\1", 7);
    EXPECT_FALSE(is_joint_file(path_)) << "a file of a sensor";
    EXPECT_FALSE(is_joint_file(path_ + "_absent"));
    EXPECT_FALSE(is_joint_file(std::filesystem::temp_directory_path().string()));
    EXPECT_FALSE(is_joint_file("virtual:motion=demo"));
}

}  // namespace
}  // namespace vfit::tools
