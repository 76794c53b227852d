#include "record/recorder.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/error.h"
#include "core/json.h"
#include "frame/floor.h"
#include "math/finite.h"
#include "record/camera_file.h"

namespace vfit {

namespace fs = std::filesystem;

namespace {

constexpr uint32_t kMaxFrames = 1'000'000;  // six digits of a file's name
constexpr uint8_t kFirstPerson = 255;       // body 1 in a mask: white in any viewer
constexpr float kFarthest = 1e6f;           // m; beyond it a coordinate is no place in a room
constexpr float kMaxRate = 1000.0f;         // Hz

/// Micrometres, whatever the locale of the host: -1234567 is "-1.234567".
void append_decimal(std::string& row, float value) {
    const long long millionths = std::llround(double(value) * 1e6);
    const unsigned long long magnitude = static_cast<unsigned long long>(std::llabs(millionths));
    char digits[48];
    std::snprintf(digits, sizeof digits, ",%s%llu.%06llu", millionths < 0 ? "-" : "", magnitude / 1'000'000,
                  magnitude % 1'000'000);
    row += digits;
}

/// Every joint, for one that the first body hides may be seen later.
const std::string& joints_header() {
    static const std::string header = [] {
        std::string text = "frame,id";
        for (int j = 0; j < kJointCount; ++j)
            for (const char* column : {"_x", "_y", "_z", "_c"})
                text.append(",").append(joint_name(j)).append(column);
        return text;
    }();
    return header;
}

Json object_from(const std::string& json, const char* key) {
    Json value = parse_json(json, key);
    if (!value.is_object()) fail(VFIT_ERROR_DATA, "the frame's \"", key, "\" is not a JSON object");
    return value;
}

/// 0 free, 1 the whole foot stands, 2 only heel or ball does.
int contact_of(const Json& object, const char* key) {
    const auto value = object.find(key);
    if (value != object.end() && value->is_boolean()) return value->get<bool>() ? 1 : 0;
    if (value != object.end() && value->is_number()) {
        const double state = value->get<double>();
        return state == 0.0 ? 0 : state == 2.0 ? 2 : 1;
    }
    fail(VFIT_ERROR_DATA, "the frame's \"contacts\" says nothing about \"", key, "\"");
}

}  // namespace

Recorder::Recorder(const std::string& path, const RecorderDesc& desc) : path_(path), desc_(desc) {
    if (path.empty()) fail(VFIT_ERROR_ARGUMENT, "the recording's path is empty");
    if (desc_.rate_hz == 0.0f) desc_.rate_hz = 30.0f;
    if (!(desc_.rate_hz > 0.0f && desc_.rate_hz <= kMaxRate))
        fail(VFIT_ERROR_ARGUMENT, "rate_hz ", desc_.rate_hz, " is not in (0, ", kMaxRate, "]");
    std::error_code error;
    const fs::path folder(path);
    if (fs::exists(folder, error)) {
        if (!fs::is_directory(folder, error)) fail(VFIT_ERROR_ARGUMENT, path, ": is not a folder");
        const bool empty = fs::is_empty(folder, error);
        if (error) fail(VFIT_ERROR_IO, path, ": ", error.message());
        if (!empty)
            fail(VFIT_ERROR_ARGUMENT, path, ": the folder is not empty; a recording starts in a new one");
    }
    // With the first picture's folder at once, so that a place that cannot be written is known early.
    fs::create_directories(folder / "depth", error);
    if (error) fail(VFIT_ERROR_IO, path, ": cannot be made: ", error.message());
}

Recorder::~Recorder() = default;

void Recorder::write(const Frame& frame) {
    if (closed_) fail(VFIT_ERROR_STATE, path_, ": the recording is closed");
    if (count_ == kMaxFrames)
        fail(VFIT_ERROR_CAPACITY, path_, ": a recording has at most ", kMaxFrames, " frames");
    check(frame);
    const Truth truth = read_truth(frame);
    if (count_ == 0) begin(frame);
    write_images(frame);
    // Half a row cannot be taken back: what is there stays readable, and nothing follows it.
    closed_ = true;
    write_rows(frame, truth);
    closed_ = false;
    ++count_;
}

void Recorder::close() {
    closed_ = true;
    timestamps_.close();
    joints_file_.close();
    contacts_.close();
}

void Recorder::check(const Frame& frame) const {
    const Stream* depth = frame.find(VFIT_STREAM_DEPTH);
    if (!depth) fail(VFIT_ERROR_DATA, path_, ": the frame has no depth");
    if (depth->width != frame.camera.width || depth->height != frame.camera.height)
        fail(VFIT_ERROR_DATA, path_, ": the frame's intrinsics are not those of its depth image");
    const Stream* mask = frame.find(VFIT_STREAM_USER_MAP);
    const Stream* color = frame.find(VFIT_STREAM_COLOR);
    for (const Stream* other : {mask, color})
        if (other && (other->width != depth->width || other->height != depth->height))
            fail(VFIT_ERROR_DATA, path_, ": stream ", other->kind, " has not the size of the depth image");
    for (const Body& body : frame.bodies)
        for (const Joint& joint : body.joints)
            if (joint.seen() && !(finite(joint.position) && glm::length(joint.position) < kFarthest &&
                                  finite(joint.confidence)))
                fail(VFIT_ERROR_DATA, path_, ": a joint of body ", body.id, " is not finite");
    if (count_ == 0) return;
    const Camera& c = frame.camera;
    if (c.width != camera_.width || c.height != camera_.height)
        fail(VFIT_ERROR_DATA, path_, ": the frame has ", c.width, " x ", c.height, " pixels, the recording ",
             camera_.width, " x ", camera_.height);
    if (c.fx != camera_.fx || c.fy != camera_.fy || c.cx != camera_.cx || c.cy != camera_.cy ||
        c.depth_unit_m != camera_.depth_unit_m)
        fail(VFIT_ERROR_DATA, path_, ": the frame's intrinsics are not those of the recording");
    if ((mask != nullptr) != has_mask_ || (color != nullptr) != has_color_)
        fail(VFIT_ERROR_DATA, path_, ": the frame has not the streams of the recording's first");
}

void Recorder::begin(const Frame& frame) {
    camera_ = frame.camera;
    has_mask_ = frame.find(VFIT_STREAM_USER_MAP) != nullptr;
    has_color_ = frame.find(VFIT_STREAM_COLOR) != nullptr;
    std::error_code error;
    if (has_mask_) fs::create_directories(fs::path(path_) / "mask", error);
    if (!error && has_color_) fs::create_directories(fs::path(path_) / "color", error);
    if (error) fail(VFIT_ERROR_IO, path_, ": ", error.message());
    const std::string json = camera_json(camera_, desc_.sensor_name, desc_.rate_hz, desc_.segmented);
    write_file_atomically(path_ + "/camera.json", json.data(), json.size());
}

std::string Recorder::image_path(const char* folder) const {
    char name[32];
    std::snprintf(name, sizeof name, "/%s/%06u.png", folder, count_);
    return path_ + name;
}

void Recorder::write_images(const Frame& frame) {
    if (has_mask_) {
        const Stream& s = *frame.find(VFIT_STREAM_USER_MAP);
        mask_.resize(s.items());
        for (uint32_t y = 0; y < s.height; ++y) {
            const uint8_t* row = s.as<uint8_t>() + size_t(y) * s.row_stride;
            for (uint32_t x = 0; x < s.width; ++x) {
                if (row[x] == 255) fail(VFIT_ERROR_DATA, path_, ": a mask can hold the ids 1..254, not 255");
                mask_[size_t(y) * s.width + x] = row[x] == 1 ? kFirstPerson : row[x];
            }
        }
        png_.write_grey8(image_path("mask"), mask_.data(), s.width, s.height, s.width);
    }
    if (has_color_) {
        const Stream& s = *frame.find(VFIT_STREAM_COLOR);
        png_.write_rgba8(image_path("color"), s.data, s.width, s.height, s.row_stride);
    }
    // Last: a reader counts frames by their depth, and finds the other pictures there.
    const Stream& s = *frame.find(VFIT_STREAM_DEPTH);
    png_.write_grey16(image_path("depth"), s.data, s.width, s.height, s.row_stride);
}

Recorder::Truth Recorder::read_truth(const Frame& frame) const {
    Truth truth;
    if (const std::string* json = frame.meta("contacts")) {
        const Json contacts = object_from(*json, "contacts");
        for (const char* side : {"left", "right"}) {
            truth.contacts += ',';
            truth.contacts += std::to_string(contact_of(contacts, side));
        }
    }
    const std::string* json = has_measures_ ? nullptr : frame.meta("measures");
    if (json) truth.measures = json_text(object_from(*json, "measures"), 1) + "\n";
    return truth;
}

void Recorder::write_rows(const Frame& frame, const Truth& truth) {
    const std::string number = std::to_string(count_);
    row_ = number + "," + std::to_string(frame.time_ns);
    append_row(timestamps_, "/timestamps.csv", "frame,time_ns");
    write_joints(frame);
    if (!truth.contacts.empty()) {
        row_ = number + truth.contacts;
        append_row(contacts_, "/contacts.csv", "frame,left,right");
    }
    if (!truth.measures.empty()) {
        write_file_atomically(path_ + "/measures.json", truth.measures.data(), truth.measures.size());
        has_measures_ = true;
    }
}

void Recorder::write_joints(const Frame& frame) {
    // A table without rows: the source tells its bodies, and nobody was there.
    if (frame.meta("bodies")) open_table(joints_file_, "/joints.csv", joints_header());
    for (const Body& world : frame.bodies) {
        const Body body = to_camera(world, frame.camera);
        row_ = std::to_string(count_) + "," + std::to_string(body.id);
        for (const Joint& joint : body.joints) {
            // All zero: not seen. No joint lies in the camera's centre.
            for (int axis = 0; axis < 3; ++axis)
                append_decimal(row_, joint.seen() ? joint.position[axis] : 0.0f);
            append_decimal(row_, joint.seen() ? glm::clamp(joint.confidence, 0.0f, 1.0f) : 0.0f);
        }
        append_row(joints_file_, "/joints.csv", joints_header());
    }
}

void Recorder::open_table(std::ofstream& file, const char* name, const std::string& header) {
    if (file.is_open()) return;
    // The header as a whole or not at all: a table without one could not be read.
    const std::string first = header + '\n';
    write_file_atomically(path_ + name, first.data(), first.size());
    file.open(fs::path(path_ + name), std::ios::binary | std::ios::app);
    if (!file) fail(VFIT_ERROR_IO, path_, name, ": cannot be written");
}

void Recorder::append_row(std::ofstream& file, const char* name, const std::string& header) {
    open_table(file, name, header);
    row_ += '\n';
    file.write(row_.data(), static_cast<std::streamsize>(row_.size()));
    file.flush();
    if (!file) fail(VFIT_ERROR_IO, path_, name, ": cannot be written");
}

}  // namespace vfit
