// The report of --json.
#pragma once

#include <vector>

#include "options.h"
#include "room.h"
#include "times.h"
#include "window.h"

namespace room {

struct Report {
    const Options& options;
    const Room& room;
    const Times& times;
    const Renderer& renderer;
    const std::vector<Key>& pressed;
    bool mirror, fit_map;
    int width, height;
};

void print_report(const Report& report);

}  // namespace room
