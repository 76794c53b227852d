// The virtual people of vfit-bench track: what they do, before which sensor, in which room. Bodies, rooms and
// motions share no code and no seed with those that the network is trained on (training/).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vfit::tools {

struct TrackCase {
    std::string what;    // of the table: "arms crossed", "sitting down"
    std::string sensor;  // noise model
    std::string uri;
};

/// Everything follows from the seed. long_run: each motion with both sensors and three people.
std::vector<TrackCase> track_cases(uint32_t seed, bool long_run);

}  // namespace vfit::tools
