#include "options.h"

#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace room {

namespace {

constexpr const char* kHelp =
    R"(A live fitting room: scans who stands before the camera, names the size, and shows the dressed avatar in a mirror.
    vfit-room [SOURCE] [options]
SOURCE              sensor URI or recording folder (default: a virtual person)
  --garment NAME    by name, or a file; again for more (default: all that come with vfit)
  --size LABEL      of the first garment, or "made to measure" (default: the recommended size)
  --sex f|m         whose default body the scan starts from (default f)
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
  --picture FILE    the last picture as PNG;  --record FOLDER  all of them
  --json            prints a report;  --renderer  prints what draws, and ends
Keys: left right (garment) up down (size) p (cloth on and off) c (camera) m (mirror) space (put on anew) f (fit map)
      h (help) esc
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

std::vector<PlannedKey> planned_keys(const std::string& text) {
    std::vector<PlannedKey> keys;
    for (size_t from = 0; from < text.size();) {
        size_t to = text.find(',', from);
        if (to == std::string::npos) to = text.size();
        const std::string item = text.substr(from, to - from);
        from = to + 1;
        const size_t colon = item.find(':');
        if (colon == std::string::npos) throw Usage{"--keys: '" + item + "' is not FRAME:KEY"};
        PlannedKey planned{number<uint64_t>("--keys", item.substr(0, colon), 0, 1'000'000'000), Key::none};
        for (const auto& known : kKeys)
            if (item.substr(colon + 1) == known.name) planned.key = known.key;
        if (planned.key == Key::none) throw Usage{"--keys: there is no key '" + item.substr(colon + 1) + "'"};
        keys.push_back(planned);
    }
    return keys;
}

void read_resolution(const std::string& text, Options& o) {
    const size_t x = text.find('x');
    if (x == std::string::npos) throw Usage{"--resolution: '" + text + "' is not WIDTHxHEIGHT"};
    o.width = number("--resolution", text.substr(0, x), 320, 8192);
    o.height = number("--resolution", text.substr(x + 1), 240, 8192);
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
            read_resolution(value(), o);
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
            o.keys = planned_keys(value());
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
