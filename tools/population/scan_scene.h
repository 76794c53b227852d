// How somebody of a population stands before the virtual camera for a scan.
#pragma once

#include <string>
#include <vector>

#include "core/json.h"
#include "population/population.h"

namespace vfit::tools {

/// Clothes of a scan's people.
enum class Dress {
    kTight,     // skin
    kClothed,   // each zone evenly between 0 and 3 cm
    kTraining,  // nearly half of them tight, else thicknesses of another distribution than kClothed's
};

/// One of several cameras around a person.
struct SceneCamera {
    std::string uri;
    float turned_deg = 0.0f;  // of its world space in that of the first one, to the left
};

/// All that is random follows from the seed.
struct ScanScene {
    std::string sensor = "kinect_v1";
    float distance_m = 2.7f, camera_height_m = 1.0f, tilt_deg = 0.0f;
    bool floor_given = true;  // else it is found in the picture
    float turned_deg = 0.0f, side_turned_deg = 90.0f, arms_deg = 35.0f, side_arms_deg = 37.0f,
          turn_arms_deg = 42.0f;
    float top_m = 0.0f, sleeves_m = 0.0f, trousers_m = 0.0f;
    float black_hair_m = 0.0f;  // of the crown, without a reading
    uint32_t front_frames = 30, side_frames = 15, turn_frames = 144, around_frames = 8, seed = 1;

    /// A Kinect v1 or a time-of-flight camera on a stand or a shelf, looking at the middle of the person, as
    /// near as it sees all of them or up to 3.1 m away; clothes as said.
    static ScanScene draw(Dress dress, uint32_t seed);
    /// The same, and 3 to 12 cm of the crown under black hair.
    ScanScene with_black_hair() const;
    /// The same clothes before the same camera on another day: another seed of noise and sway, another place
    /// to stand.
    ScanScene again(uint32_t day) const;
    /// Of the front view, and of the side view after it.
    std::string front_uri(const PersonOfPopulation& person) const;
    std::string side_uri(const PersonOfPopulation& person) const;
    std::string turn_uri(const PersonOfPopulation& person) const;
    /// Arms out, by four cameras around the person.
    std::vector<SceneCamera> around(const PersonOfPopulation& person) const;
    /// Of the person from every camera.
    float distance_to(const PersonOfPopulation& person) const;
    Json json() const;

private:
    std::string uri(const PersonOfPopulation& person) const;
};

}  // namespace vfit::tools
