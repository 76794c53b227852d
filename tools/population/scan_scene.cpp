#include "population/scan_scene.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace vfit::tools {

namespace {

std::string text_of(float value) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << value;
    return out.str();
}

// Nearer, a Kinect v1 does not see head and feet at once; a time-of-flight camera sees more.
constexpr float kNearestKinect_m = 2.65f, kNearestTof_m = 2.4f, kFarthest_m = 3.1f, kTall_m = 1.85f,
                kTaller_m = 0.3f;
constexpr float kWall_m = 0.7f;
constexpr float kThickest_m = 0.03f;
// The camera's height: half of them about a metre, the others from a low table up to a shelf.
constexpr float kLowest_m = 0.6f, kHighest_m = 1.6f, kUsualLeast_m = 0.9f, kUsualMost_m = 1.1f;
constexpr float kMiddle_m = 0.95f;    // of a person, that it looks at
constexpr float kAim_deg = 1.5f;      // give or take
constexpr float kFloorFound = 0.5f;   // share of cameras that do not know where the floor is
constexpr float kTurned_deg = 12.0f;  // give or take: people face a camera by eye

}  // namespace

ScanScene ScanScene::draw(Dress dress, uint32_t seed) {
    Random random(seed ^ 0x5ca9u);
    ScanScene scene;
    scene.seed = seed;
    const bool kinect = random.unit() < 0.5f;
    scene.sensor = kinect ? "kinect_v1" : "tof";
    scene.distance_m = random.between(kinect ? kNearestKinect_m : kNearestTof_m, kFarthest_m);
    scene.camera_height_m = random.unit() < 0.5f ? random.between(kUsualLeast_m, kUsualMost_m)
                                                 : random.between(kLowest_m, kHighest_m);
    scene.tilt_deg = glm::degrees(std::atan2(scene.camera_height_m - kMiddle_m, scene.distance_m)) +
                     random.between(-kAim_deg, kAim_deg);
    scene.floor_given = random.unit() >= kFloorFound;
    scene.turned_deg = random.between(-kTurned_deg, kTurned_deg);
    scene.side_turned_deg = 90.0f + random.between(-kTurned_deg, kTurned_deg);
    scene.arms_deg = random.between(28.0f, 45.0f);
    scene.side_arms_deg = random.between(30.0f, 45.0f);
    scene.turn_arms_deg = Random(seed ^ 0x7a63u).between(35.0f, 50.0f);
    const bool tight = dress == Dress::kTight || (dress == Dress::kTraining && random.unit() < 0.45f);
    if (tight) return scene;
    for (float* zone : {&scene.top_m, &scene.sleeves_m, &scene.trousers_m}) {
        const float a = random.unit(), b = random.unit();
        // In training thin clothes are more frequent than thick ones, and the thickest are thicker.
        *zone = dress == Dress::kClothed ? kThickest_m * a : 1.2f * kThickest_m * std::min(a, b);
    }
    return scene;
}

ScanScene ScanScene::with_black_hair() const {
    ScanScene scene = *this;
    scene.black_hair_m = Random(seed ^ 0xb1acu).between(0.03f, 0.12f);
    return scene;
}

ScanScene ScanScene::again(uint32_t day) const {
    constexpr float kNear_m = 0.1f, kTurn_deg = 5.0f;
    Random random(seed * 7919u + day);
    ScanScene scene = *this;
    scene.seed = seed * 31u + day;
    scene.distance_m += random.between(0.0f, kNear_m);
    scene.turned_deg += random.between(-kTurn_deg, kTurn_deg);
    scene.side_turned_deg += random.between(-kTurn_deg, kTurn_deg);
    scene.arms_deg = random.between(28.0f, 45.0f);
    scene.side_arms_deg = random.between(30.0f, 45.0f);
    return scene;
}

std::string ScanScene::uri(const PersonOfPopulation& person) const {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << "virtual:" << person.options() << "&sensor=" << sensor << "&seed=" << seed
        << "&distance=" << distance_to(person) << "&camera_height=" << camera_height_m << "&tilt=" << tilt_deg
        << "&floor=" << (floor_given ? "given" : "unknown") << "&top=" << top_m << "&sleeves=" << sleeves_m
        << "&trousers=" << trousers_m;
    // Before a wall that both sensors see: without one it cannot be told where the head ends.
    if (black_hair_m > 0.0f) out << "&black_hair=" << black_hair_m << "&wall=" << kWall_m;
    return out.str();
}

std::string ScanScene::front_uri(const PersonOfPopulation& person) const {
    return uri(person) + "&motion=scan&facing=" + text_of(turned_deg) + "&arms=" + text_of(arms_deg) +
           "&frames=" + std::to_string(front_frames);
}

std::string ScanScene::side_uri(const PersonOfPopulation& person) const {
    return uri(person) + "&motion=side&facing=" + text_of(side_turned_deg) +
           "&arms=" + text_of(side_arms_deg) + "&frames=" + std::to_string(side_frames);
}

std::string ScanScene::turn_uri(const PersonOfPopulation& person) const {
    return uri(person) + "&motion=round&facing=" + text_of(turned_deg) + "&arms=" + text_of(turn_arms_deg) +
           "&rate=15&frames=" + std::to_string(turn_frames);
}

std::vector<SceneCamera> ScanScene::around(const PersonOfPopulation& person) const {
    constexpr int kCameras = 4;
    Random random(seed ^ 0x3c4du);
    std::vector<SceneCamera> out;
    float first_deg = 0.0f;
    for (int k = 0; k < kCameras; ++k) {
        const float facing_deg =
            turned_deg + 360.0f * float(k) / float(kCameras) + random.between(-kTurned_deg, kTurned_deg);
        if (k == 0) first_deg = facing_deg;
        out.push_back({uri(person) + "&motion=scan&facing=" + text_of(facing_deg) +
                           "&arms=" + text_of(turn_arms_deg) + "&frames=" + std::to_string(around_frames),
                       first_deg - facing_deg});
    }
    return out;
}

float ScanScene::distance_to(const PersonOfPopulation& person) const {
    // All of a tall person is in view from farther away only.
    return distance_m + (person.measures.at("stature_m") > double(kTall_m) ? kTaller_m : 0.0f);
}

Json ScanScene::json() const {
    return {{"sensor", sensor},
            {"distance_m", distance_m},
            {"camera_height_m", camera_height_m},
            {"tilt_deg", tilt_deg},
            {"floor_given", floor_given},
            {"turned_deg", turned_deg},
            {"side_turned_deg", side_turned_deg},
            {"arms_deg", arms_deg},
            {"side_arms_deg", side_arms_deg},
            {"top_m", top_m},
            {"sleeves_m", sleeves_m},
            {"trousers_m", trousers_m}};
}

}  // namespace vfit::tools
