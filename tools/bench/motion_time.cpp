// What a step of the motion stage costs: with a new body, and between bodies, as a quick renderer asks for
// it.
#include <cmath>
#include <iomanip>
#include <iostream>

#include "bench/bench.h"
#include "bench/motion_parts.h"
#include "bench/motion_people.h"
#include "motion/motion.h"

namespace vfit::tools {

namespace {

constexpr int kRuns = 200;
constexpr int kPredicted = 20;  // steps between two bodies: 600 Hz over 30 Hz

}  // namespace

Json judge_time(const MotionJudge& judge) {
    const PersonStream stream = {"walk",
                                 person_on_feet("virtual:sensor=kinect_v1_320&motion=walk&frames=120")};
    Samples body_us, between_us;
    for (int run = 0; run < kRuns; ++run) {
        vfit::Motion motion{MotionSettings()};
        double bodies = 0, between = 0;
        for (const PersonFrame& frame : stream.frames) {
            Body body = frame.tracked;
            body.id = 1;
            const Timer timer;
            motion.step(&body, body.time_ns);
            bodies += timer.ms();
            const Timer later;
            for (int k = 1; k <= kPredicted; ++k) motion.step(nullptr, body.time_ns + k * 1'666'666);
            between += later.ms();
        }
        const double count = double(stream.frames.size());
        body_us.add(1e3 * bodies / count);
        between_us.add(1e3 * between / (count * kPredicted));
    }
    if (!judge.quiet)
        std::cout << "\nTime of a step, one core, median of " << kRuns << " runs of " << stream.frames.size()
                  << " bodies (the paper: 520 microseconds)\n";
    judge.targets.judge("a step with a new body", body_us.quantile(0.5), Aim::at_most, 20.0, 1, " us");
    judge.targets.judge("a step between bodies", between_us.quantile(0.5), Aim::at_most, 20.0, 1, " us");
    return {{"body_us", body_us.quantile(0.5)}, {"between_us", between_us.quantile(0.5)}};
}

}  // namespace vfit::tools
