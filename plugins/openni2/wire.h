// What the plug-in and its reader say to each other over a socket: a head, then as many bytes as it names.
// Both are built together and run on one machine, so these structs are sent as they lie. The plug-in believes
// nothing of it: a damaged file may have got hold of the reader.
#pragma once

#include <cstdint>

namespace openni2 {

constexpr uint32_t kMagic = 0x6e693276;
constexpr int kReaderSocket = 3;  // the reader's end of the socket
constexpr uint32_t kMostModes = 64;
constexpr uint32_t kMostPixels = 16384;  // a side, as vfit_plugin.h says

enum class Kind : uint32_t {
    // From the reader.
    listed = 1,  // Listed, one a device
    list_end = 2,
    opened = 3,   // Opened
    image = 4,    // Image, then depth (U16), then colour (RGBA8) where it has some; rows without gaps
    state = 5,    // State: nothing more comes, of the stream or of the device that could not be opened
    stopped = 6,  // after stop: nothing more comes
    // To the reader.
    start = 7,  // Start
    stop = 8
};

struct Head {
    uint32_t magic;
    Kind kind;
    uint32_t bytes, reserved;
};

struct Listed {
    char uri[256], name[64];
};

struct Mode {
    uint32_t width, height;
    float rate_hz;
    uint32_t depth_100um;  // 1: depth in 0.1 mm, 0: in mm
};

struct Opened {
    char name[64];
    uint32_t is_file, frames;      // frames: of a file; 0: not told
    uint32_t mode_count, mode;     // mode: the one that it is in
    uint32_t offers_registration;  // of depth to colour
    uint32_t has_color;
    Mode modes[kMostModes];
};

struct Start {
    uint32_t mode;
    uint32_t registration, color;  // 1: if it can be
    uint32_t first, count;         // frames of a file; count 0: all
};

struct Image {
    uint32_t index;  // from 0 on in a file, as the device counts otherwise
    uint32_t width, height;
    uint32_t has_color;
    int64_t time_us;  // on the device's clock
    float depth_unit_m;
    float horizontal_fov_rad, vertical_fov_rad;
    uint32_t reserved;
};

enum class Ending : uint32_t {
    end = 0,
    lost = 1,
    damaged = 2,
    unsupported = 3,
    no_library = 4,
    no_device = 5,
    failed = 6
};
struct State {
    Ending ending;
    uint32_t reserved;
    char text[504];  // one sentence
};

}  // namespace openni2
