// The parts of vfit-bench drape, each a table and its targets.
#pragma once

#include "bench/targets.h"

namespace vfit::tools {

struct DrapeJudge {
    Targets& targets;
    bool quiet;
    double minutes;  // of random motion
};

Json judge_strip(const DrapeJudge& judge);
Json judge_fabrics(const DrapeJudge& judge);
Json judge_scale(const DrapeJudge& judge);
Json judge_self(const DrapeJudge& judge);
Json judge_skin(const DrapeJudge& judge);
Json judge_frame(const DrapeJudge& judge);
Json judge_crowd(const DrapeJudge& judge);
Json judge_random(const DrapeJudge& judge);

}  // namespace vfit::tools
