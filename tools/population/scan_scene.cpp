#include "population/scan_scene.h"

#include <locale>
#include <sstream>

namespace vfit::tools {

namespace {

// Nearer, a Kinect v1 at 1 m over the floor does not see head and feet; a time-of-flight camera sees more at once.
constexpr float kNearestKinect_m = 2.65f, kNearestTof_m = 2.4f, kFarthest_m = 3.1f, kTall_m = 1.85f;
constexpr float kThickest_m = 0.03f;

}  // namespace

ScanScene ScanScene::draw(Dress dress, uint32_t seed) {
    Random random(seed ^ 0x5ca9u);
    ScanScene scene;
    scene.seed = seed;
    const bool kinect = random.unit() < 0.5f;
    scene.sensor = kinect ? "kinect_v1" : "tof";
    scene.distance_m = random.between(kinect ? kNearestKinect_m : kNearestTof_m, kFarthest_m);
    const bool tight = dress == Dress::kTight || (dress == Dress::kTraining && random.unit() < 1.0f / 3.0f);
    if (tight) return scene;
    for (float* zone : {&scene.top_m, &scene.sleeves_m, &scene.trousers_m}) {
        const float a = random.unit(), b = random.unit();
        // In training thin clothes are more frequent than thick ones, and the thickest are thicker.
        *zone = dress == Dress::kClothed ? kThickest_m * a : 1.2f * kThickest_m * std::min(a, b);
    }
    return scene;
}

std::string ScanScene::uri(const PersonOfPopulation& person) const {
    // All of a tall person is in view from farther away only.
    const double far = person.measures.at("stature_m") > double(kTall_m) ? 0.3 : 0.0;
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << "virtual:" << person.options() << "&sensor=" << sensor << "&seed=" << seed << "&distance=" << double(distance_m) + far
        << "&top=" << top_m << "&sleeves=" << sleeves_m << "&trousers=" << trousers_m;
    return out.str();
}

std::string ScanScene::front_uri(const PersonOfPopulation& person) const {
    return uri(person) + "&motion=scan&frames=" + std::to_string(front_frames);
}

std::string ScanScene::side_uri(const PersonOfPopulation& person) const {
    return uri(person) + "&motion=side&facing=90&frames=" + std::to_string(side_frames);
}

}  // namespace vfit::tools
