// People whose back is close to a wall that is not learnt: whether they are found from the first image
// on.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <random>
#include <sstream>

#include "bench/frames.h"
#include "bench/track_parts.h"
#include "bench/track_play.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kPeople = 20, kFrames = 10;
constexpr const char* kSensors[] = {"kinect_v1", "tof", "azure_binned"};
constexpr float kGaps_m[] = {0.03f, 0.05f, 0.08f};
constexpr const char* kMotions[] = {"scan", "sway", "wave", "forward"};

struct Stander {
    std::string options;
    float distance_m, height_m, tilt_rad;
    float back_m;  // from where they stand to the rearmost of their surface
};

Stander stander_of(uint32_t number, uint32_t seed, vfit_context context) {
    std::mt19937 random(9000 * seed + number);
    const auto draw = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    Stander s;
    s.distance_m = draw(2.2f, 3.1f), s.height_m = draw(0.8f, 1.8f);
    s.tilt_rad = std::atan((s.height_m - 0.95f) / s.distance_m);
    std::ostringstream uri;
    uri << "&side_wall=0&floor=unknown&clothing=0.015&body=" << 80000 + 1000 * seed + number
        << "&seed=" << number + 1 << "&distance=" << s.distance_m << "&camera_height=" << s.height_m
        << "&tilt=" << s.tilt_rad * 180.0f / kPi;
    s.options = uri.str();
    // Seen from behind, the back is what is nearest.
    Source source(context,
                  "virtual:sensor=ideal&noise=0&facing=180&motion=scan&arms=8&wall=0&frames=1" + s.options);
    const auto frame = source.next();
    const FrameImage image(frame->get());
    Camera camera = image.camera;
    set_floor(camera, s.height_m, s.tilt_rad, 0.0f, VFIT_FLOOR_GIVEN);
    const Mat4 world = camera.world_from_camera();
    float rear = 0.0f;
    for (uint32_t v = 0; v < camera.height; ++v)
        for (uint32_t u = 0; u < camera.width; ++u) {
            const size_t i = size_t(v) * camera.width + u;
            if (!image.users[i]) continue;
            const float z = float(image.depth[i]) * camera.depth_unit_m;
            rear = std::max(rear,
                            s.distance_m + transform_point(world, camera.unproject(float(u), float(v), z)).z);
        }
    s.back_m = rear;
    s.options += std::string("&motion=") + kMotions[number % 4] + (number % 4 == 0 ? "&arms=12" : "");
    return s;
}

struct Row {
    uint32_t frames = 0, found = 0, first = 0;
    Errors errors;
};

}  // namespace

Json judge_walls(const JudgeOptions& options, Targets& targets) {
    const Context context = open_context();
    Json report = Json::array();
    std::vector<Stander> people;
    for (uint32_t i = 0; i < kPeople; ++i) people.push_back(stander_of(i, options.seed, context.get()));
    if (!options.quiet)
        std::cout << "\nSYNTHETIC: " << kPeople << " people before a wall that was not learnt, seed "
                  << options.seed << "\n  sensor          gap    frames   found   in the first   mAP@10 cm\n";
    struct {
        uint32_t frames = 0, found = 0, starts = 0, first = 0;
    } close, touching;  // of the smallest gap
    for (const char* sensor : kSensors)
        for (const float gap_m : kGaps_m) {
            Row row;
            for (const Stander& person : people) {
                std::ostringstream uri;
                uri << "virtual:sensor=" << sensor << "&wall=" << person.back_m + gap_m
                    << "&frames=" << kFrames << person.options;
                uint32_t index = 0;
                play_tracked(uri.str(), options.fit, [&](vfit_frame frame, vfit_frame tracked) {
                    const Joints truth = truth_of(frame);
                    const uint32_t id = body_near(tracked, truth);
                    ++row.frames, row.found += id != 0, row.first += id != 0 && index == 0;
                    ++index;
                    Joints joints;
                    if (id) joints = joints_in_camera(tracked, id, camera_of(tracked));
                    row.errors.add_all(id ? &joints : nullptr, truth);
                });
            }
            auto& sum = gap_m < 0.04f ? touching : close;
            sum.frames += row.frames, sum.found += row.found, sum.starts += kPeople, sum.first += row.first;
            report.push_back({{"sensor", sensor},
                              {"gap_m", gap_m},
                              {"frames", row.frames},
                              {"found", row.found},
                              {"found_in_the_first", row.first},
                              {"within_10cm", row.errors.within(0.1)}});
            if (!options.quiet)
                std::cout << "  " << std::left << std::setw(14) << sensor << std::right << std::fixed
                          << std::setprecision(0) << std::setw(3) << 100 * gap_m << " cm" << std::setw(10)
                          << row.frames << std::setw(8) << row.found << std::setw(15) << row.first
                          << std::setprecision(3) << std::setw(12) << row.errors.within(0.1) << "\n";
        }
    if (!options.quiet) std::cout << "\n";
    const auto percent = [](uint32_t of, uint32_t all) { return 100.0 * of / all; };
    targets.judge("a back 5 or 8 cm from the wall: found in the first image, of 100",
                  percent(close.first, close.starts), Aim::at_least, 98, 1);
    targets.judge("a back 5 or 8 cm from the wall: found, images of 100", percent(close.found, close.frames),
                  Aim::at_least, 98, 1);
    targets.judge("a back 3 cm from the wall: found in the first image, of 100",
                  percent(touching.first, touching.starts), Aim::at_least, 90, 1);
    return report;
}

}  // namespace vfit::tools
