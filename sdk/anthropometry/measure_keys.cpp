// The table of measure keys.
#include "anthropometry/measure_keys.h"

#include <algorithm>
#include <iterator>

namespace vfit {

namespace {

// Definitions that follow ISO 8559-1:2017 name its clause, the others follow none. Girths are taut tapes: the
// convex hull of the section. New keys are appended: the index is part of the ABI.
//
// Plausible bounds, rounded outwards. Smallest: a fifth of the smallest of the 6,068 adults of ANSUR II
// (stature 1.41 m, chest girth 0.70 m); a newborn has a third of that stature (0.45 m) and two fifths of
// those girths. Largest: for bones 1.5 times the largest of ANSUR II (stature 1.99 m; the tallest human known
// had 2.72 m); for girths, and for breadths and depths with flesh, 2.5 times (chest 1.47 m, waist 1.38 m; the
// largest known had 3.15 m and 3.02 m). A measure that ANSUR II lacks has the bounds of the nearest that it
// has. Mass: the heaviest human known had 635 kg.
constexpr MeasureKey kKeys[] = {
    {"stature_m",
     "height: floor to crown, barefoot, feet together, head level, without hair (ISO 8559-1 5.1.1)", 0.28f,
     3.0f},
    {"shoulder_breadth_m", "bideltoid: largest breadth over the deltoids, upper arms 5 degrees from vertical",
     0.07f, 1.6f},
    {"biacromial_breadth_m", "breadth between the outermost points of the two acromia", 0.05f, 0.75f},
    {"chest_girth_m",
     "women: over the bust points (5.3.4 bust girth); men: largest horizontal girth of the chest below the "
     "axillae (at them 5.3.6); no arms",
     0.14f, 3.7f},
    {"underbust_girth_m", "horizontal girth directly below the breasts (5.3.8)", 0.14f, 3.7f},
    {"waist_girth_m", "horizontal girth midway between lowest rib and iliac crest (5.3.10)", 0.12f, 3.5f},
    {"hip_girth_m",
     "largest horizontal girth over the buttocks (5.3.14; at their greatest prominence 5.3.13)", 0.14f, 3.4f},
    {"neck_girth_m", "girth just below the larynx, square to the neck (5.3.2)", 0.05f, 1.3f},
    {"thigh_girth_m", "largest girth of the thigh, square to it (5.3.20, there horizontal)", 0.08f, 2.2f},
    {"upper_arm_girth_m", "largest girth of the hanging upper arm, square to it (5.3.16)", 0.04f, 1.25f},
    {"inside_leg_m", "crotch to floor, feet slightly apart (5.1.15)", 0.12f, 1.55f},
    {"arm_length_m", "acromion over the slightly bent elbow to the wrist bone (5.7.8)", 0.08f, 1.1f},
    {"torso_height_m", "from the NECK joint to the PELVIS joint", 0.08f, 1.0f},
    {"hip_height_m", "height of the hip joints above the floor", 0.13f, 1.65f},
    {"hip_breadth_m", "horizontal extent from side to side of the section of hip_girth_m", 0.05f, 1.2f},
    {"elbow_fingertip_m", "elbow to the tip of the middle finger", 0.06f, 0.9f},
    {"head_height_m", "chin to crown, vertical", 0.05f, 0.4f},
    {"head_width_m", "largest breadth of the head above the ears", 0.02f, 0.3f},
    {"chest_breadth_m", "horizontal extent from side to side of the section of chest_girth_m", 0.04f, 0.95f},
    {"chest_depth_m", "horizontal extent from front to back of the section of chest_girth_m", 0.03f, 1.0f},
    {"waist_breadth_m", "horizontal extent from side to side of the section of waist_girth_m", 0.04f, 1.2f},
    {"waist_depth_m", "horizontal extent from front to back of the section of waist_girth_m", 0.02f, 1.05f},
    {"hip_depth_m", "horizontal extent from front to back of the section of hip_girth_m", 0.03f, 0.9f},
    {"hand_length_m", "wrist to the tip of the middle finger", 0.02f, 0.4f},
    {"body_mass_kg", "what a scale shows, without clothes; in kilograms", 1.0f, 700.0f},
    {"waist_navel_girth_m", "horizontal girth at the height of the navel, as ANSUR II measures the waist",
     0.12f, 3.5f},
    {"waist_minimum_girth_m", "smallest horizontal girth between navel and rib arch", 0.12f, 3.5f},
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
