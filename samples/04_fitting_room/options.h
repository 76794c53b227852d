// The command line.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vfit.h"

namespace room {

enum class Key { none, left, right, up, down, physics, camera, mirror, redress, fit_map, help, quit };

/// A key pressed by the script of --keys.
struct PlannedKey {
    uint64_t frame;
    Key key;
};

/// A click of the script of --clicks, in pixels of the picture.
struct PlannedClick {
    uint64_t frame;
    int x, y;
};

struct Options {
    std::string source;
    std::vector<std::string> garments;  // empty: all that there are
    std::string size;                   // empty: the recommended one
    vfit_sex sex = VFIT_SEX_UNKNOWN;    // as the scan finds
    double min_interval_s = 0.008;      // as in the paper
    bool tracked = false;               // joints by vfit's tracker, also where the source tells its own
    std::string data_dir;               // empty: vfit_data beside the library

    bool offscreen = false, draw = true, json = false, renderer = false;
    bool film = false;  // one camera image a picture, on the camera's clock
    int width = 1280, height = 720, samples = 4;
    uint32_t detail = 0;
    uint64_t frames = 0;   // 0: no end
    double seconds = 0.0;  // 0: no end
    std::string picture, record;
    std::vector<PlannedKey> keys;
    std::vector<PlannedClick> clicks;
};

/// Exits with 0 after --help; throws Usage for what it does not understand.
Options parse_options(int argc, char** argv);

class Usage {
public:
    std::string what;
};

const char* key_name(Key key);

}  // namespace room
