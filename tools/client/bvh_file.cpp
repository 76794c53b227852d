#include "client/bvh_file.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <concepts>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>
#include <iomanip>
#include <limits>

#include "client/client.h"
#include "client/files.h"

namespace vfit::tools {

namespace {

// More than any person has; deeper trees than that are none of people either.
constexpr size_t kMaxJoints = 2000;

using Channel = BvhJoint::Channel;

struct ChannelName {
    const char* name;
    Channel channel;
};
constexpr ChannelName kChannels[] = {{"Xposition", Channel::x},      {"Yposition", Channel::y},
                                     {"Zposition", Channel::z},      {"Xrotation", Channel::turn_x},
                                     {"Yrotation", Channel::turn_y}, {"Zrotation", Channel::turn_z}};

std::string name_of(Channel channel) { return kChannels[size_t(channel)].name; }

std::string lower(std::string_view word) {
    std::string out(word);
    for (char& c : out) c = char(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

/// The words of the file, with the line that each stands in.
class Words {
public:
    Words(std::string_view text, const std::string& path) : text_(text), path_(path) {}

    /// Empty at the end.
    std::string_view next() {
        skip_blanks();
        const size_t start = at_;
        while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
        return text_.substr(start, at_ - start);
    }
    std::string_view peek() {
        const size_t at = at_, line = line_;
        const std::string_view word = next();
        at_ = at, line_ = line;
        return word;
    }
    /// Names may have blanks in them.
    std::string rest_of_line() {
        while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
        const size_t end = std::min(text_.find('\n', at_), text_.size());
        size_t last = end;
        while (last > at_ && is_blank(text_[last - 1])) --last;
        std::string out(text_.substr(at_, last - at_));
        at_ = end;
        return out;
    }
    void expect(const char* wanted) {
        const std::string_view word = next();
        if (lower(word) != lower(wanted)) fail(found(word) + " where " + wanted + " is due");
    }
    double number(const std::string& what) {
        return number([&] { return what; });
    }
    /// what() is asked where there is a fault alone: there may be millions of numbers.
    template <typename What>
    double number(const What& what)
        requires std::invocable<What>
    {
        const std::string_view word = next();
        if (word.empty()) fail("the file ends where " + what() + " is due");
        double value = 0.0;
        const char* start = word.data() + (word[0] == '+' ? 1 : 0);
        const auto [end, error] = std::from_chars(start, word.data() + word.size(), value);
        const bool fits =
            std::abs(value) <= double(std::numeric_limits<float>::max());  // not a number does not
        if (error != std::errc() || end != word.data() + word.size() || !fits)
            fail(what() + " is '" + std::string(word.substr(0, 40)) + "', no finite number");
        return value;
    }
    size_t whole(const std::string& what, size_t max) {
        const std::string_view word = next();
        size_t value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (word.empty() || error != std::errc() || end != word.data() + word.size() || value > max)
            fail(what + " is " + found(word) + ", no whole number up to " + std::to_string(max));
        return value;
    }
    [[noreturn]] void fail(const std::string& fault) const {
        throw Failure(path_ + ", line " + std::to_string(line_) + ": " + fault);
    }
    static std::string found(std::string_view word) {
        return word.empty() ? "the end of the file" : "'" + std::string(word.substr(0, 40)) + "'";
    }

private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
    void skip_blanks() {
        for (; at_ < text_.size() && is_blank(text_[at_]); ++at_) line_ += text_[at_] == '\n';
    }

    std::string_view text_;
    const std::string& path_;
    size_t at_ = 0, line_ = 1;
};

void read_offset(Words& words, BvhJoint& joint) {
    words.expect("OFFSET");
    for (int axis = 0; axis < 3; ++axis)
        joint.offset[axis] = float(words.number("an offset of " + joint.name));
}

void read_channels(Words& words, BvhFile& file, BvhJoint& joint) {
    words.expect("CHANNELS");
    const size_t count = words.whole("the number of channels of " + joint.name, 6);
    joint.first_value = file.values_per_frame;
    for (size_t c = 0; c < count; ++c) {
        const std::string_view word = words.next();
        const auto known = std::find_if(std::begin(kChannels), std::end(kChannels),
                                        [&](const ChannelName& n) { return lower(n.name) == lower(word); });
        if (known == std::end(kChannels))
            words.fail(Words::found(word) +
                       " is no channel; known are Xposition to Zposition and Xrotation "
                       "to Zrotation");
        joint.channels.push_back(known->channel);
    }
    file.values_per_frame += count;
}

/// Opens with the word behind HIERARCHY.
void read_tree(Words& words, BvhFile& file) {
    std::vector<int> open;  // the joints whose brackets are open
    do {
        const std::string_view found = words.next();
        const std::string word = lower(found);
        if (word == "}" && !open.empty()) {
            open.pop_back();
            continue;
        }
        const bool is_end = word == "end", is_root = word == "root";
        if (is_root ? !open.empty() : (!is_end && word != "joint") || open.empty())
            words.fail(Words::found(found) + " where " + (open.empty() ? "ROOT" : "JOINT, End Site or }") +
                       " is due");
        if (file.joints.size() >= kMaxJoints)
            words.fail("more than " + std::to_string(kMaxJoints) + " joints");
        BvhJoint joint;
        joint.parent = open.empty() ? -1 : open.back();
        joint.is_end = is_end;
        joint.name = words.rest_of_line();
        if (is_end) joint.name = file.joints[size_t(joint.parent)].name + "_end";
        if (joint.name.empty()) words.fail("a joint without a name");
        words.expect("{");
        read_offset(words, joint);
        if (!is_end) read_channels(words, file, joint);
        if (is_end) words.expect("}");
        file.joints.push_back(joint);
        if (!is_end) open.push_back(int(file.joints.size()) - 1);
    } while (!open.empty());
}

void read_motion(Words& words, BvhFile& file) {
    words.expect("MOTION");
    words.expect("Frames:");
    constexpr size_t kMaxFrames = 10000000;
    file.frame_count = words.whole("the number of frames", kMaxFrames);
    if (file.frame_count == 0) words.fail("the file has no frame");
    if (file.values_per_frame == 0) words.fail("no joint has a channel");
    words.expect("Frame");
    words.expect("Time:");
    file.frame_time_s = words.number("the frame time");
    if (!(file.frame_time_s > 0.0)) words.fail("the frame time is not above 0");
    for (size_t f = 0; f < file.frame_count; ++f) {
        for (const BvhJoint& joint : file.joints)
            for (size_t c = 0; c < joint.channels.size(); ++c)
                file.values.push_back(float(words.number([&] {
                    return name_of(joint.channels[c]) + " of " + joint.name + " in frame " +
                           std::to_string(f) + " of " + std::to_string(file.frame_count);
                })));
    }
    if (const std::string_view more = words.next(); !more.empty())
        words.fail("more values than " + std::to_string(file.frame_count) + " frames of " +
                   std::to_string(file.values_per_frame) + " channels have");
}

}  // namespace

std::vector<glm::mat4> BvhFile::pose(size_t frame) const {
    std::vector<glm::mat4> world;
    world.reserve(joints.size());
    for (const BvhJoint& joint : joints) {
        // A channel of a place stands in for the offset, as exporters write it.
        glm::vec3 place = joint.offset;
        glm::mat4 turn(1.0f);
        const float* value = values.data() + frame * values_per_frame + joint.first_value;
        for (const Channel channel : joint.channels) {
            const float v = *value++;
            if (channel < Channel::turn_x) {
                place[int(channel)] = v;
            } else {
                glm::vec3 axis(0.0f);
                axis[int(channel) - int(Channel::turn_x)] = 1.0f;
                turn = glm::rotate(turn, glm::radians(v), axis);
            }
        }
        const glm::mat4 local = glm::translate(glm::mat4(1.0f), place) * turn;
        world.push_back(joint.parent < 0 ? local : world[size_t(joint.parent)] * local);
    }
    return world;
}

std::vector<glm::vec3> BvhFile::rest() const {
    std::vector<glm::vec3> places;
    for (const BvhJoint& joint : joints)
        places.push_back(joint.offset + (joint.parent < 0 ? glm::vec3(0.0f) : places[size_t(joint.parent)]));
    return places;
}

bool is_bvh_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    std::string word;
    file >> std::setw(16) >> word;
    return lower(word) == "hierarchy";
}

BvhFile read_bvh(const std::string& path) {
    const std::string text = read_text(path);
    Words words(text, path);
    words.expect("HIERARCHY");
    BvhFile file;
    read_tree(words, file);
    if (lower(words.peek()) == "root") words.fail("a second ROOT: files of one person can be played");
    read_motion(words, file);
    return file;
}

}  // namespace vfit::tools
