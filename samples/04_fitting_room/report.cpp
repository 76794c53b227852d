#include "report.h"

#include <cstdio>
#include <string>

namespace room {

namespace {

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (static_cast<unsigned char>(c) < 0x20) continue;
        out += c;
    }
    return out + '"';
}

const char* truth(bool b) { return b ? "true" : "false"; }

void print_spread(const char* name, const Spread& s, const char* end) {
    std::printf("    \"%s\": {\"median\": %.3f, \"p95\": %.3f}%s\n", name, s.median, s.p95, end);
}

}  // namespace

void print_report(const Report& r) {
    const Room& room = r.room;
    std::printf("{\n  \"source\": %s,\n", quoted(room.source()).c_str());
    if (r.options.draw)
        std::printf(
            "  \"renderer\": %s,\n  \"software_renderer\": %s,\n  \"width\": %d,\n  \"height\": %d,\n  "
            "\"samples\": %d,\n",
            quoted(r.renderer.name).c_str(), truth(r.renderer.software), r.width, r.height,
            r.options.samples);
    else
        std::printf("  \"renderer\": null,\n");
    std::printf("  \"frames\": %llu,\n  \"fps\": %.1f,\n  \"camera_images\": %llu,\n",
                static_cast<unsigned long long>(r.times.frames()), r.times.fps(),
                static_cast<unsigned long long>(room.camera_images()));
    std::printf("  \"stage_ms\": {\n");
    for (size_t s = 0; s < kStages; ++s)
        if (r.options.draw || Stage(s) != Stage::draw)
            print_spread(kStageNames[s], r.times.stage(Stage(s)), ",");
    print_spread("frame", r.times.frame(), "");
    std::printf("  },\n  \"cloth_steps\": %llu,\n  \"cloth_ms\": {\n",
                static_cast<unsigned long long>(r.times.cloth_steps()));
    print_spread("step", r.times.cloth_step(), ",");
    print_spread("interval", r.times.cloth_interval(), "");
    const Room::Person& p = room.person();
    std::printf("  },\n  \"dress_ms\": %.1f,\n", room.dress_ms());
    std::printf(
        "  \"person\": {\"stature_m\": %.4f, \"stature_sigma_m\": %.4f, \"size\": %s, \"probability\": "
        "%.3f},\n",
        double(p.stature_m), double(p.stature_sigma_m), quoted(p.size).c_str(), double(p.probability));
    std::printf("  \"garment\": %s,\n  \"size\": %s,\n", quoted(room.garment()).c_str(),
                quoted(room.size()).c_str());
    std::printf("  \"physics\": %s,\n  \"camera\": %s,\n  \"mirror\": %s,\n  \"fit_map\": %s,\n",
                truth(room.physics()), truth(room.camera_on()), truth(r.mirror), truth(r.fit_map));
    std::printf("  \"message\": %s,\n  \"keys\": [", quoted(room.message()).c_str());
    for (size_t i = 0; i < r.pressed.size(); ++i)
        std::printf("%s\"%s\"", i ? ", " : "", key_name(r.pressed[i]));
    std::printf("]\n}\n");
}

}  // namespace room
