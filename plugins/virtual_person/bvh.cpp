#include "bvh.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <locale>
#include <sstream>

#include "error.h"

namespace vfit::virtual_person {

namespace {

// Bounds against files that only pretend: far above any real capture.
constexpr size_t kMostJoints = 1024, kMostFrames = 2'000'000;
constexpr std::streamoff kMostBytes = 1 << 29;
constexpr double kMost = 1e7;  // degrees and file units: a skeleton of such bones still adds up in floats

class Reader {
public:
    Reader(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    template <typename... Parts>
    [[noreturn]] void error(const Parts&... parts) const {
        fail(VFIT_ERROR_DATA, file_, ", line ", line_, ": ", parts...);
    }

    /// Empty at the end of the text.
    std::string_view next() {
        while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n';
        const size_t begin = at_;
        while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
        return text_.substr(begin, at_ - begin);
    }
    std::string_view need(const char* what) {
        const std::string_view token = next();
        if (token.empty()) error("the file ends where ", what, " is expected");
        return token;
    }
    void expect(std::string_view word) {
        const std::string_view token = next();
        if (token.empty()) error("the file ends where '", word, "' is expected");
        if (token != word) error("'", token, "' where '", word, "' is expected");
    }
    double number(const char* what) {
        const std::string_view token = need(what);
        // A stream, since not every supported library has from_chars for floating point.
        stream_.clear();
        stream_.str(std::string(token));
        double value = 0;
        if (!(stream_ >> value) || stream_.peek() != std::char_traits<char>::eof() ||
            !(std::abs(value) <= kMost))
            error("'", token, "' is not a number for ", what);
        return value;
    }
    size_t count(const char* what, size_t most) {
        const std::string_view token = need(what);
        size_t value = 0;
        const auto [end, code] = std::from_chars(token.data(), token.data() + token.size(), value);
        if (code != std::errc() || end != token.data() + token.size() || value > most)
            error("'", token, "' is not a ", what, " from 0 to ", most);
        return value;
    }

private:
    static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

    std::string_view text_;
    const std::string& file_;
    size_t at_ = 0, line_ = 1;
    std::istringstream stream_ = [] {
        std::istringstream s;
        s.imbue(std::locale::classic());
        return s;
    }();
};

char channel_code(std::string_view name) {
    static constexpr struct {
        std::string_view name;
        char code;
    } kChannels[] = {{"Xposition", 'X'}, {"Yposition", 'Y'}, {"Zposition", 'Z'},
                     {"Xrotation", 'x'}, {"Yrotation", 'y'}, {"Zrotation", 'z'}};
    for (const auto& c : kChannels)
        if (c.name == name) return c.code;
    return 0;
}

Vec3 read_offset(Reader& reader) {
    reader.expect("OFFSET");
    Vec3 offset;
    for (int k = 0; k < 3; ++k) offset[k] = static_cast<float>(reader.number("an offset"));
    return offset;
}

void read_end_site(Reader& reader) {
    reader.expect("Site");
    reader.expect("{");
    read_offset(reader);
    reader.expect("}");
}

// After ROOT or JOINT has been read. The joints that are open lie on a stack, not in recursion, so that no
// depth of nesting is a danger.
void read_hierarchy(Reader& reader, Bvh& bvh) {
    std::vector<int> open;
    do {
        if (bvh.joints.size() == kMostJoints) reader.error("more than ", kMostJoints, " joints");
        BvhJoint joint;
        joint.name = reader.need("a joint's name");
        joint.parent = open.empty() ? -1 : open.back();
        reader.expect("{");
        joint.offset = read_offset(reader);
        reader.expect("CHANNELS");
        const size_t channels = reader.count("channel count", 6);
        for (size_t i = 0; i < channels; ++i) {
            const std::string_view name = reader.need("a channel's name");
            const char code = channel_code(name);
            if (!code) reader.error("unknown channel '", name, "' of joint ", joint.name);
            joint.channels += code;
        }
        joint.first_channel = bvh.channel_count;
        bvh.channel_count += channels;
        open.push_back(static_cast<int>(bvh.joints.size()));
        bvh.joints.push_back(std::move(joint));

        std::string_view token;
        while (!open.empty() && (token = reader.need("'JOINT', 'End' or '}'")) != "JOINT") {
            if (token == "End")
                read_end_site(reader);
            else if (token == "}")
                open.pop_back();
            else
                reader.error("'", token, "' where 'JOINT', 'End' or '}' is expected");
        }
    } while (!open.empty());
}

}  // namespace

int Bvh::find(std::string_view name) const {
    for (size_t i = 0; i < joints.size(); ++i)
        if (joints[i].name == name) return static_cast<int>(i);
    return -1;
}

Bvh parse_bvh(std::string_view text, const std::string& file_name) {
    Reader reader(text, file_name);
    Bvh bvh;
    reader.expect("HIERARCHY");
    reader.expect("ROOT");
    read_hierarchy(reader, bvh);
    reader.expect("MOTION");
    reader.expect("Frames:");
    bvh.frame_count = reader.count("frame count", kMostFrames);
    if (bvh.frame_count == 0) reader.error("there is no frame");
    if (bvh.channel_count == 0) reader.error("no joint has a channel");
    reader.expect("Frame");
    reader.expect("Time:");
    bvh.frame_time_s = reader.number("the frame time");
    if (!(bvh.frame_time_s > 1e-5 && bvh.frame_time_s < 10.0))
        reader.error("a frame time of ", bvh.frame_time_s, " s is out of range");
    // Each value takes two characters at least: a count that the file cannot hold reserves no memory.
    if (bvh.frame_count > text.size() / (2 * bvh.channel_count) + 1)
        reader.error("the file is too short for ", bvh.frame_count, " frames of ", bvh.channel_count,
                     " values");
    bvh.values.resize(bvh.frame_count * bvh.channel_count);
    for (float& value : bvh.values) value = static_cast<float>(reader.number("a motion value"));
    if (!reader.next().empty())
        reader.error("more motion values than ", bvh.frame_count, " frames of ", bvh.channel_count);
    return bvh;
}

Bvh read_bvh(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) fail(VFIT_ERROR_IO, path, ": cannot be opened");
    const std::streamoff size = file.tellg();
    if (size < 0 || size > kMostBytes)
        fail(VFIT_ERROR_DATA, path, ": is no file of at most ", kMostBytes, " bytes");
    std::string text(static_cast<size_t>(size), '\0');
    file.seekg(0);
    if (size > 0 && !file.read(text.data(), size)) fail(VFIT_ERROR_IO, path, ": cannot be read");
    return parse_bvh(text, path);
}

void evaluate(const Bvh& bvh, size_t frame, BvhFrame& out) {
    out.position.resize(bvh.joints.size());
    out.rotation.resize(bvh.joints.size());
    const float* values = bvh.values.data() + frame * bvh.channel_count;
    for (size_t j = 0; j < bvh.joints.size(); ++j) {
        const BvhJoint& joint = bvh.joints[j];
        Vec3 place = joint.offset;
        Quat turn = kNoRotation;
        for (size_t c = 0; c < joint.channels.size(); ++c) {
            const float value = values[joint.first_channel + c];
            switch (joint.channels[c]) {
                case 'X': place.x += value; break;
                case 'Y': place.y += value; break;
                case 'Z': place.z += value; break;
                case 'x': turn = turn * rotate_x(value); break;
                case 'y': turn = turn * rotate_y(value); break;
                default: turn = turn * rotate_z(value); break;
            }
        }
        if (joint.parent < 0) {
            out.position[j] = place, out.rotation[j] = turn;
        } else {
            const auto p = static_cast<size_t>(joint.parent);
            out.position[j] = out.position[p] + out.rotation[p] * place;
            out.rotation[j] = glm::normalize(out.rotation[p] * turn);
        }
    }
}

}  // namespace vfit::virtual_person
