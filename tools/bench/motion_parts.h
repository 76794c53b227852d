// The parts of vfit-bench motion, each a table and its targets.
#pragma once

#include "bench/motion_streams.h"
#include "bench/targets.h"

namespace vfit::tools {

struct RealStreams {
    std::vector<JointStream> kinect2, ui_prmd;  // both empty without the shared folder
    std::vector<MarkerStream> markers;
};

struct MotionJudge {
    Targets& targets;
    const RealStreams& real;
    bool quiet;
    std::string shared;  // folder with real streams, or one that is not there
};

Json judge_filters(const MotionJudge& judge);
Json judge_feet(const MotionJudge& judge);
Json judge_real(const MotionJudge& judge);
Json judge_vicon(const MotionJudge& judge);
Json judge_time(const MotionJudge& judge);
Json judge_skinning(const MotionJudge& judge);
Json judge_characters(const MotionJudge& judge);

}  // namespace vfit::tools
