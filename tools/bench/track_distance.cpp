// How far away people are found: virtual people before a time-of-flight camera that reaches 5.46 m.
#include <iomanip>
#include <iostream>
#include <sstream>

#include "bench/track_parts.h"
#include "bench/track_play.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kPeople = 10, kFrames = 30;
constexpr double kDistances_m[] = {2.0, 3.0, 4.0, 5.0};

std::string person(uint32_t number, const JudgeOptions& options, double distance_m) {
    std::ostringstream uri;
    uri << "virtual:sensor=azure_binned&motion=sway&clothing=0.02&floor=unknown&wall=" << number % 2
        << "&facing=" << 6.0 * number - 27.0 << "&body=" << 60000 + 100 * options.seed + number
        << "&seed=" << number << "&distance=" << distance_m << "&frames=" << kFrames;
    return uri.str();
}

}  // namespace

Json judge_distance(const JudgeOptions& options, Targets& targets) {
    if (!options.quiet)
        std::cout << "\nSYNTHETIC: " << kPeople << " virtual people, Azure Kinect, binned, seed "
                  << options.seed << "\n  distance   frames   found   mAP@10 cm\n";
    Json rows = Json::array();
    for (const double distance_m : kDistances_m) {
        uint32_t frames = 0, found = 0;
        Errors errors;
        for (uint32_t i = 0; i < kPeople; ++i)
            play_tracked(
                person(i, options, distance_m), options.fit, [&](vfit_frame frame, vfit_frame tracked) {
                    const Joints truth = truth_of(frame);
                    const uint32_t id = body_near(tracked, truth);
                    const Joints joints = id ? joints_in_camera(tracked, id, camera_of(tracked)) : Joints{};
                    errors.add_all(id ? &joints : nullptr, truth);
                    ++frames, found += id != 0;
                });
        rows.push_back({{"distance_m", distance_m},
                        {"frames", frames},
                        {"found", found},
                        {"within_10cm", errors.within(0.1)}});
        if (!options.quiet)
            std::cout << std::fixed << std::setprecision(1) << std::setw(8) << distance_m << " m"
                      << std::setw(9) << frames << std::setw(8) << found << std::setprecision(3)
                      << std::setw(12) << errors.within(0.1) << "\n";
        if (distance_m == kDistances_m[std::size(kDistances_m) - 1])
            targets.judge("at 5 m: frames in which the person is found, of 100", 100.0 * found / frames,
                          Aim::at_least, 95.0, 1);
    }
    return rows;
}

}  // namespace vfit::tools
