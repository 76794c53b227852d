// The table of measure keys.
#include "measure/measure_keys.h"

#include <algorithm>
#include <iterator>

namespace vfit {

namespace {

// Definitions after ISO 8559-1:2017 (item numbers where one stands); girths are taut tapes: the convex hull
// of the section. New keys are appended: the index is part of the ABI.
constexpr MeasureKey kKeys[] = {
    {"stature_m",
     "height: floor to crown, barefoot, feet together, head level, without hair (ISO 8559-1 5.1.1)"},
    {"shoulder_breadth_m",
     "bideltoid: largest breadth over the deltoids, upper arms 5 degrees from vertical"},
    {"biacromial_breadth_m", "breadth between the outermost points of the two acromia"},
    {"chest_girth_m",
     "men: largest horizontal girth of the chest (5.3.4); women: over the bust points; no arms"},
    {"underbust_girth_m", "horizontal girth directly below the breasts"},
    {"waist_girth_m", "horizontal girth midway between lowest rib and iliac crest (5.3.10)"},
    {"hip_girth_m", "largest horizontal girth over the buttocks (5.3.13)"},
    {"neck_girth_m", "girth just below the larynx, square to the neck"},
    {"thigh_girth_m", "largest girth of the thigh, square to it"},
    {"upper_arm_girth_m", "largest girth of the hanging upper arm, square to it"},
    {"inside_leg_m", "crotch to floor, feet slightly apart"},
    {"arm_length_m", "acromion over the slightly bent elbow to the wrist bone"},
    {"torso_height_m", "from the NECK joint to the PELVIS joint"},
    {"hip_height_m", "height of the hip joints above the floor"},
    {"hip_breadth_m", "horizontal extent from side to side of the section of hip_girth_m"},
    {"elbow_fingertip_m", "elbow to the tip of the middle finger"},
    {"head_height_m", "chin to crown, vertical"},
    {"head_width_m", "largest breadth of the head above the ears"},
    {"chest_breadth_m", "horizontal extent from side to side of the section of chest_girth_m"},
    {"chest_depth_m", "horizontal extent from front to back of the section of chest_girth_m"},
    {"waist_breadth_m", "horizontal extent from side to side of the section of waist_girth_m"},
    {"waist_depth_m", "horizontal extent from front to back of the section of waist_girth_m"},
    {"hip_depth_m", "horizontal extent from front to back of the section of hip_girth_m"},
    {"hand_length_m", "wrist to the tip of the middle finger"},
    {"body_mass_kg", "what a scale shows, without clothes; in kilograms"},
};

}  // namespace

std::span<const MeasureKey> measure_keys() { return kKeys; }

int measure_index(std::string_view key) {
    int index = 0;
    for (const MeasureKey& known : kKeys) {
        if (key == known.key) return index;
        ++index;
    }
    return -1;
}

int measure_order(std::string_view key) {
    const int index = measure_index(key);
    return index >= 0 ? index : int(std::size(kKeys));
}

bool is_own_measure(std::string_view key) {
    constexpr size_t kLongest = 47;  // vfit_measurement.key
    const auto usual = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
    return key.size() > 4 && key.size() <= kLongest && key.substr(0, 2) == "x_" &&
           key.substr(key.size() - 2) == "_m" && std::all_of(key.begin(), key.end(), usual);
}

}  // namespace vfit
