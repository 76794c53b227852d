#include "options.h"

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <tuple>
#include <utility>

namespace room {

namespace {

constexpr const char* kHelp =
    R"(A live fitting room: scans the person before the camera, recommends a size, and shows the dressed
avatar as in a mirror.
    vfit-room [SOURCE] [options]
SOURCE              sensor URI or recording folder (default: a virtual person)
  --garment NAME    by name, or a file; again for more (default: all that come with vfit)
  --size LABEL      of the first garment, or "made to measure" (default: the recommended size)
  --sex f|m         of the person (default: as the scan finds)
  --tracked         joints by vfit's own tracker, also where the source tells them
  --min-interval MS between two steps of the cloth at least (default 8)
  --detail N        of the body's mesh, 0 to 2 (default 0)
  --data DIR        vfit's data (default: vfit_data beside the library)
  --resolution WxH  of the picture (default 1280x720); --samples N of its anti-aliasing (default 4)
  --offscreen       draws without a window or display
  --no-draw         the whole chain without drawing
  --film            one camera image a picture, however long a picture takes (with --record always)
  --frames N        ends so many pictures after the person was dressed; --seconds S likewise
  --keys LIST       presses keys so many pictures after that: "30:right,60:up"
  --clicks LIST     clicks into the picture likewise, in pixels: "30:100x320"
  --picture FILE    the last picture as PNG;  --record FOLDER  all of them
  --json            prints a report;  --renderer  prints what draws, and ends
Keys: left right (garment) up down (size) p (cloth on and off) c (camera) m (mirror) space (put on anew)
      f (fit map) h (help) esc
)";

constexpr struct {
    const char* name;
    Key key;
} kKeys[] = {{"left", Key::left}, {"right", Key::right}, {"up", Key::up},    {"down", Key::down},
             {"p", Key::physics}, {"c", Key::camera},    {"m", Key::mirror}, {"space", Key::redress},
             {"f", Key::fit_map}, {"h", Key::help},      {"esc", Key::quit}};

template <typename T>
T number(const char* option, const std::string& text, T least, T most) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value >= least && value <= most))
        throw Usage{std::string(option) + ": '" + text + "' is not a number from " + std::to_string(least) +
                    " to " + std::to_string(most)};
    return value;
}

/// Calls add(frame, rest) for each "FRAME:REST" of a list with commas. what: REST in words.
template <typename Add>
void read_plan(const char* option, const std::string& text, const char* what, Add&& add) {
    for (size_t from = 0; from < text.size();) {
        size_t to = text.find(',', from);
        if (to == std::string::npos) to = text.size();
        const std::string item = text.substr(from, to - from);
        from = to + 1;
        const size_t colon = item.find(':');
        if (colon == std::string::npos)
            throw Usage{std::string(option) + ": '" + item + "' is not FRAME:" + what};
        add(number<uint64_t>(option, item.substr(0, colon), 0, 1'000'000'000), item.substr(colon + 1));
    }
}

Key key_named(const std::string& name) {
    for (const auto& known : kKeys)
        if (name == known.name) return known.key;
    throw Usage{"--keys: there is no key '" + name + "'"};
}

/// Two numbers with an x between them.
std::pair<int, int> pair_of(const char* option, const std::string& text, const char* what, int min_x,
                            int min_y) {
    constexpr int kMaxPixels = 8192;
    const size_t x = text.find('x');
    if (x == std::string::npos) throw Usage{std::string(option) + ": '" + text + "' is not " + what};
    return {number(option, text.substr(0, x), min_x, kMaxPixels),
            number(option, text.substr(x + 1), min_y, kMaxPixels)};
}

vfit_sex sex_of(const std::string& text) {
    if (text == "f") return VFIT_SEX_FEMALE;
    if (text == "m") return VFIT_SEX_MALE;
    throw Usage{"--sex: '" + text + "' is neither f nor m"};
}

}  // namespace

const char* key_name(Key key) {
    for (const auto& known : kKeys)
        if (known.key == key) return known.name;
    return "";
}

Options parse_options(int argc, char** argv) {
    Options o;
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        const auto is = [&](const char* name) { return option == name; };
        const auto value = [&]() -> std::string {
            if (i + 1 == argc) throw Usage{option + " needs a value"};
            return argv[++i];
        };
        if (is("--help") || is("-h")) {
            std::fputs(kHelp, stdout);
            std::exit(0);
        } else if (is("--garment"))
            o.garments.push_back(value());
        else if (is("--size"))
            o.size = value();
        else if (is("--sex"))
            o.sex = sex_of(value());
        else if (is("--tracked"))
            o.tracked = true;
        else if (is("--min-interval"))
            o.min_interval_s = 1e-3 * number("--min-interval", value(), 0.0, 100.0);
        else if (is("--detail"))
            o.detail = number<uint32_t>("--detail", value(), 0, 2);
        else if (is("--data"))
            o.data_dir = value();
        else if (is("--resolution"))
            std::tie(o.width, o.height) = pair_of("--resolution", value(), "WIDTHxHEIGHT", 320, 240);
        else if (is("--samples"))
            o.samples = number("--samples", value(), 0, 16);
        else if (is("--offscreen"))
            o.offscreen = true;
        else if (is("--no-draw"))
            o.draw = false;
        else if (is("--film"))
            o.film = true;
        else if (is("--frames"))
            o.frames = number<uint64_t>("--frames", value(), 1, 1'000'000'000);
        else if (is("--seconds"))
            o.seconds = number("--seconds", value(), 0.1, 1e9);
        else if (is("--keys"))
            read_plan("--keys", value(), "KEY", [&](uint64_t frame, const std::string& name) {
                o.keys.push_back({frame, key_named(name)});
            });
        else if (is("--clicks"))
            read_plan("--clicks", value(), "XxY", [&](uint64_t frame, const std::string& place) {
                const auto [x, y] = pair_of("--clicks", place, "XxY", 0, 0);
                o.clicks.push_back({frame, x, y});
            });
        else if (is("--picture"))
            o.picture = value();
        else if (is("--record"))
            o.record = value();
        else if (is("--json"))
            o.json = true;
        else if (is("--renderer"))
            o.renderer = true;
        else if (option.size() > 1 && option[0] == '-')
            throw Usage{"there is no option " + option};
        else if (o.source.empty())
            o.source = option;
        else
            throw Usage{"one source is enough: '" + option + "'"};
    }
    if (o.source.empty())
        o.source =
            o.sex == VFIT_SEX_MALE ? "virtual:motion=demo&sex=m&seed=7" : "virtual:motion=demo&sex=f&seed=7";
    if (!o.record.empty()) o.film = true;
    if (!o.draw && (!o.picture.empty() || !o.record.empty()))
        throw Usage{"--no-draw leaves no picture to write"};
    return o;
}

}  // namespace room
