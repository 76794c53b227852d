#include "bench/track_cases.h"

#include <cmath>
#include <random>
#include <sstream>

namespace vfit::tools {

namespace {

constexpr double kPi = 3.14159265358979;

struct Play {
    const char* what;
    const char* motion;
    double facing_deg;
    uint32_t frames;  // until what the motion is about has been seen
    double room_m;    // how much farther away, for motions that leave their spot
};
constexpr Play kPlays[] = {
    {"waving", "wave", 0, 120, 0},
    {"reaching to a shelf", "reach", 20, 160, 0},
    {"squatting", "squat", -15, 110, 0},
    {"clapping", "clap", 10, 110, 0},
    {"reaching ahead", "forward", 0, 90, 0},
    {"jogging", "jog", -20, 80, 0},
    {"arms crossed", "cross", 0, 120, 0},
    {"arms crossed", "cross", -25, 120, 0},
    {"sitting down", "sit", 15, 140, 0},
    {"sitting down", "sit", -30, 140, 0},
    {"walking in a circle", "walk", 0, 150, 0.4},
    {"turning round", "spin", 0, 216, 0},
    {"seen from the left", "wave", -90, 100, 0},
    {"seen from the right", "jog", 90, 80, 0},
    {"seen from the left", "sway", -90, 60, 0},
    {"seen from the right", "forward", 90, 80, 0},
    {"seen from behind", "wave", 180, 100, 0},
    {"seen from behind", "jog", 180, 80, 0},
};

class Draw {
public:
    explicit Draw(uint32_t seed) : random_(seed) {}
    double between(double low, double high) {
        // Not std::uniform_real_distribution: its numbers differ between standard libraries.
        return low + (high - low) * double(random_()) / double(std::mt19937::max());
    }
    bool chance(double probability) { return between(0.0, 1.0) < probability; }

private:
    std::mt19937 random_;
};

TrackCase make_case(const Play& play, const char* sensor, uint32_t body, Draw& draw) {
    const bool kinect = std::string(sensor) == "kinect_v1";
    // The Kinect v1 sees 44 degrees upright, the time-of-flight camera 60.
    const double distance = draw.between(kinect ? 2.7 : 2.3, kinect ? 3.2 : 3.0) + play.room_m;
    const double height = draw.between(0.7, 1.7), middle_m = 0.95;
    const double tilt = std::atan2(height - middle_m, distance) * 180.0 / kPi;
    const std::string motion = play.motion;
    std::string furniture = motion == "sit" ? "stool" : "";
    for (const char* piece : {"chair", "rack"})
        if (play.room_m == 0.0 && draw.chance(0.25))  // who walks would walk into it
            furniture.append(furniture.empty() ? "" : ",").append(piece);
    std::ostringstream uri;
    uri << "virtual:sensor=" << sensor << "&motion=" << motion
        << "&facing=" << play.facing_deg + draw.between(-5, 5) << "&body=" << body << "&seed=" << body
        << "&clothing=" << draw.between(0.01, 0.03) << "&distance=" << distance << "&camera_height=" << height
        << "&tilt=" << tilt << "&wall=" << draw.between(0.4, 1.4) << "&side_wall=" << draw.between(1.3, 2.2)
        << "&furniture=" << furniture << "&floor=unknown&frames=" << play.frames;
    return {play.what, sensor, uri.str()};
}

}  // namespace

std::vector<TrackCase> track_cases(uint32_t seed, bool long_run) {
    constexpr const char* kSensors[] = {"kinect_v1", "tof"};
    Draw draw(seed);
    std::vector<TrackCase> cases;
    uint32_t body = 1000 * seed;
    for (uint32_t person = 0; person < (long_run ? 3u : 1u); ++person)
        for (size_t i = 0; i < std::size(kPlays); ++i)
            for (size_t s = 0; s < 2; ++s)
                if (long_run || s == i % 2) cases.push_back(make_case(kPlays[i], kSensors[s], ++body, draw));
    return cases;
}

}  // namespace vfit::tools
