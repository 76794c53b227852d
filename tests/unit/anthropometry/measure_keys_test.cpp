// The vocabulary of measures.
#include "anthropometry/measure_keys.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace vfit {
namespace {

TEST(MeasureKeys, AreUniqueNameTheirUnitAndAreDefinedOnOneLine) {
    std::set<std::string> seen;
    for (const MeasureKey& key : measure_keys()) {
        const std::string name = key.key, text = key.text;
        EXPECT_TRUE(seen.insert(name).second) << name;
        EXPECT_TRUE(name.ends_with("_m") || is_mass(name)) << name;
        EXPECT_LT(name.size(), 48u);  // vfit_measurement.key
        EXPECT_FALSE(text.empty());
        EXPECT_EQ(text.find('\n'), std::string::npos);
    }
}

TEST(MeasureKeys, NameTheClauseOfTheStandardThatTheyFollow) {
    for (const auto& [key, clause] : {std::pair("stature_m", "5.1.1"),
                                      {"inside_leg_m", "5.1.15"},
                                      {"neck_girth_m", "5.3.2"},
                                      {"chest_girth_m", "5.3.4"},
                                      {"underbust_girth_m", "5.3.8"},
                                      {"waist_girth_m", "5.3.10"},
                                      {"hip_girth_m", "5.3.14"},
                                      {"upper_arm_girth_m", "5.3.16"},
                                      {"thigh_girth_m", "5.3.20"},
                                      {"arm_length_m", "5.7.8"}}) {
        const int index = measure_index(key);
        ASSERT_GE(index, 0) << key;
        const std::string text = measure_keys()[static_cast<size_t>(index)].text;
        EXPECT_NE(text.find(clause), std::string::npos) << text;
    }
}

TEST(MeasureKeys, AreFoundByName) {
    for (int i = 0; i < static_cast<int>(measure_keys().size()); ++i)
        EXPECT_EQ(measure_index(measure_keys()[static_cast<size_t>(i)].key), i);
    EXPECT_EQ(measure_index("stature"), -1);
    EXPECT_EQ(measure_index(""), -1);
}

TEST(MeasureKeys, HoldEveryDocumentedKey) {
    for (const char* key :
         {"stature_m",          "chest_girth_m",        "underbust_girth_m", "waist_girth_m",
          "hip_girth_m",        "neck_girth_m",         "thigh_girth_m",     "upper_arm_girth_m",
          "shoulder_breadth_m", "biacromial_breadth_m", "hip_breadth_m",     "inside_leg_m",
          "arm_length_m",       "torso_height_m",       "hip_height_m",      "elbow_fingertip_m",
          "head_height_m",      "head_width_m",         "chest_breadth_m",   "waist_breadth_m",
          "chest_depth_m",      "waist_depth_m",        "hip_depth_m"})
        EXPECT_GE(measure_index(key), 0) << key;
}

TEST(MeasureKeys, HaveBoundsThatTellMetresFromInches) {
    constexpr float kInch_m = 0.0254f;
    for (const MeasureKey& key : measure_keys()) {
        EXPECT_GT(key.smallest, 0.0f) << key.key;
        EXPECT_LT(key.smallest, key.largest) << key.key;
        if (is_mass(key.key)) continue;
        // A newborn has at least 1.5 times the smallest bound.
        EXPECT_GT(1.5f * key.smallest / kInch_m, key.largest) << key.key;
    }
}

}  // namespace
}  // namespace vfit
