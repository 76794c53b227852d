// The parts of vfit-bench track. Each prints its table, unless it is told to be quiet, and returns it as
// JSON.
#pragma once

#include <cstdint>
#include <string>

#include "bench/targets.h"
#include "client/client.h"

namespace vfit::tools {

struct JudgeOptions {
    uint32_t seed = 1;
    bool long_run = false;  // every case with both sensors and several people
    bool quiet = false;
    vfit_track_fit fit = VFIT_FIT_AUTO;  // where joints are judged
};

/// REAL: recordings below the folder.
Json judge_real(const std::string& folder, const JudgeOptions& options, Targets& targets);
/// REAL: the stills of five people and of one who is too close.
Json judge_stills(const std::string& folder, bool quiet, Targets& targets);
/// SYNTHETIC: joints of virtual people.
Json judge_virtual(const JudgeOptions& options, Targets& targets);
/// SYNTHETIC: which way people face, after a cut and through a turn.
Json judge_facing(const JudgeOptions& options, Targets& targets);
/// SYNTHETIC: cameras that stand in many ways, in rooms of many kinds: whether person and floor are found.
Json judge_rooms(const JudgeOptions& options, Targets& targets);
/// SYNTHETIC: things that move into a room and are no people, and people who stand still.
Json judge_furniture(const JudgeOptions& options, Targets& targets);
/// SYNTHETIC: people with their back close to a wall.
Json judge_walls(const JudgeOptions& options, Targets& targets);
/// SYNTHETIC: people of whom a half is seen.
Json judge_half_seen(const JudgeOptions& options, Targets& targets);
/// SYNTHETIC: how far away people are found.
Json judge_distance(const JudgeOptions& options, Targets& targets);
/// SYNTHETIC: people who come, go and are hidden, and rooms without anybody.
Json judge_events(const JudgeOptions& options, Targets& targets);
/// SYNTHETIC: time of the whole tracker a frame, and from a frame's time stamp to the pose.
Json judge_time(const JudgeOptions& options, Targets& targets);

}  // namespace vfit::tools
