#include "options.h"

#include <cmath>
#include <cstring>
#include <locale>
#include <sstream>

#include "error.h"
#include "furniture.h"
#include "motion.h"
#include "sensor_model.h"

namespace vfit::virtual_person {

namespace {

enum class Kind { kNumber, kWhole, kSensor, kMotion, kSex, kPace, kFile, kFurniture, kFloor };

struct Entry {
    const char* key;
    Kind kind;
    const char* value;   // default
    double least, most;  // of numbers
    const char* text;
};

constexpr double kMostWhole = 9.0e15;  // below 2^53: a double holds it exactly
constexpr Entry kEntries[] = {
    {"sensor", Kind::kSensor, "kinect_v1", 0, 0,
     "Depth camera that is played: kinect_v1, kinect_v1_320, azure, azure_binned, tof, ideal"},
    {"mode", Kind::kSensor, "kinect_v1", 0, 0,
     "The same as sensor, by the name that every sensor of vfit has for it"},
    {"motion", Kind::kMotion, "scan", 0, 0,
     "What the person does: scan, walk, sit, ...; a wrong name is answered by the list"},
    {"arms", Kind::kNumber, "-1", -1, 80,
     "Upper arms from hanging, in degrees, of motion scan and round (outwards) and side (forwards); below 0: "
     "as the "
     "motion has them"},
    {"bvh", Kind::kFile, "", 0, 0, "Motion capture file to play instead of motion (CMU joint names)"},
    {"seed", Kind::kWhole, "1", 0, kMostWhole, "Of noise, sway and breath; equal seeds give equal bits"},
    {"frames", Kind::kWhole, "0", 0, kMostWhole, "Frames until the end of the stream; 0: without end"},
    {"rate", Kind::kNumber, "30", 1, 240, "Frames a second of the person's time"},
    {"pace", Kind::kPace, "none", 0, 0, "none: as fast as frames are taken; realtime: at rate"},
    {"sex", Kind::kSex, "", 0, 0, "Default body: f, m, or empty for one halfway"},
    {"distance", Kind::kNumber, "2.7", 0.5, 10, "From the camera to where the person stands, in metres"},
    {"facing", Kind::kNumber, "0", -360, 360,
     "Turns person and motion to their left, in degrees; 0 faces the camera"},
    {"camera_height", Kind::kNumber, "1", 0.1, 5, "Of the camera above the floor, in metres"},
    {"tilt", Kind::kNumber, "0", -60, 60, "Of the camera, in degrees; above 0 it looks down"},
    {"wall", Kind::kNumber, "1.2", 0, 50, "From the person to the wall behind, in metres; 0: none"},
    {"side_wall", Kind::kNumber, "1.7", 0, 50,
     "From the camera to the wall on the image's left, in metres; 0: none"},
    {"noise", Kind::kNumber, "1", 0, 10,
     "Scale of noise and drop-out; 0 leaves depth exact except for its steps"},
    {"quantise", Kind::kWhole, "1", 0, 1, "Depth in steps of 1/8 px of disparity (kinect_v1)"},
    {"shadow", Kind::kWhole, "1", 0, 1, "No depth where the projector's light does not reach (kinect_v1)"},
    {"body", Kind::kWhole, "0", 0, kMostWhole,
     "Draws an adult's sex, stature and build by this number; what is set itself stays; 0: the default body"},
    {"clothing", Kind::kNumber, "0", 0, 0.1,
     "Mean thickness of top and trousers, in metres: uneven, by seed; the joints stay the body's"},
    {"top", Kind::kNumber, "-1", -1, 0.1,
     "Thickness of the top on the trunk, in metres; below 0: as clothing says"},
    {"sleeves", Kind::kNumber, "-1", -1, 0.1, "The same of its sleeves"},
    {"trousers", Kind::kNumber, "-1", -1, 0.1, "The same of the trousers"},
    {"black_hair", Kind::kNumber, "0", 0, 0.2,
     "How far down from the crown the person comes without a reading, as black hair does, in metres"},
    {"people", Kind::kWhole, "1", 0, 3,
     "How many; those beside the first are drawn by seed; 0: an empty room"},
    {"furniture", Kind::kFurniture, "", 0, 0, "In the room: any of chair, rack, stool, separated by commas"},
    {"occluder", Kind::kNumber, "0", 0, 1e6,
     "Second from which a passing box hides the person for about 1 s; 0: none"},
    {"floor", Kind::kFloor, "given", 0, 0, "given: frames tell where the floor is; unknown: as most cameras"},
    {"detail", Kind::kWhole, "0", 0, 2, "Vertices of the body: 0 13.7k, 1 54.8k, 2 219k"},
};

const Entry* find_entry(const std::string& key, size_t& index) {
    for (index = 0; index < std::size(kEntries); ++index)
        if (key == kEntries[index].key) return &kEntries[index];
    return nullptr;
}

size_t index_of(const char* key) {
    size_t index = 0;
    if (!find_entry(key, index)) fail(VFIT_ERROR_UNKNOWN, "virtual: the table of options lacks ", key);
    return index;
}

void check_choice(const std::string& key, const std::string& value, bool known, const std::string& choices) {
    if (!known)
        fail(VFIT_ERROR_ARGUMENT, "virtual: option ", key, ": unknown '", value, "'; known are ", choices);
}

void check_value(const Entry& e, const std::string& value) {
    switch (e.kind) {
        case Kind::kNumber: parse_number(e.key, value, e.least, e.most); break;
        case Kind::kWhole:
            if (const double v = parse_number(e.key, value, e.least, e.most); v != std::floor(v))
                fail(VFIT_ERROR_ARGUMENT, "virtual: option ", e.key, ": '", value, "' is not a whole number");
            break;
        case Kind::kSensor:
            check_choice(e.key, value, find_sensor_model(value) != nullptr, sensor_model_names());
            break;
        case Kind::kMotion: check_choice(e.key, value, is_motion(value), motion_names()); break;
        case Kind::kSex:
            check_choice(e.key, value, value.empty() || value == "f" || value == "m",
                         "f, m and the empty text");
            break;
        case Kind::kPace:
            check_choice(e.key, value, value == "none" || value == "realtime", "none, realtime");
            break;
        case Kind::kFurniture: check_choice(e.key, value, is_furniture(value), furniture_names()); break;
        case Kind::kFloor:
            check_choice(e.key, value, value == "given" || value == "unknown", "given, unknown");
            break;
        case Kind::kFile: break;
    }
}

void copy_text(char* out, size_t capacity, const std::string& text) {
    const size_t n = std::min(capacity - 1, text.size());
    std::memcpy(out, text.data(), n);
    out[n] = 0;
}

}  // namespace

double parse_number(const std::string& key, const std::string& value, double least, double most) {
    std::istringstream stream(value);
    stream.imbue(std::locale::classic());
    double v = 0;
    if (!(stream >> v) || stream.peek() != std::char_traits<char>::eof() || !(v >= least && v <= most))
        fail(VFIT_ERROR_ARGUMENT, "virtual: option ", key, ": '", value, "' is not a number from ", least,
             " to ", most);
    return v;
}

Options::Options() {
    for (const Entry& e : kEntries) values_.emplace_back(e.value);
}

bool Options::set(const std::string& key, const std::string& value) {
    size_t index = 0;
    const Entry* entry = find_entry(key, index);
    if (!entry) return false;
    check_value(*entry, value);
    if (entry->kind == Kind::kSensor)  // two names of one thing
        values_[index_of("sensor")] = values_[index_of("mode")] = value;
    else
        values_[index] = value;
    return true;
}

const std::string& Options::text(const char* key) const { return values_[index_of(key)]; }

double Options::number(const char* key) const {
    const size_t i = index_of(key);
    return parse_number(key, values_[i], kEntries[i].least, kEntries[i].most);
}

uint64_t Options::whole(const char* key) const { return static_cast<uint64_t>(number(key)); }

uint32_t Options::count() const { return static_cast<uint32_t>(std::size(kEntries)); }

void Options::describe(uint32_t index, vfit_sensor_option& out) const {
    copy_text(out.key, sizeof out.key, kEntries[index].key);
    copy_text(out.value, sizeof out.value, values_[index]);
    copy_text(out.text, sizeof out.text, kEntries[index].text);
}

std::string Options::names() {
    std::string names;
    for (const Entry& e : kEntries) names += (names.empty() ? "" : ", ") + std::string(e.key);
    return names;
}

}  // namespace vfit::virtual_person
