// A strict reader of BVH, and where a frame puts the joints: what other programs make of a file.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace vfit::test {

using Matrix = std::array<double, 9>;  // rows
using Point = std::array<double, 3>;

inline Matrix product(const Matrix& a, const Matrix& b) {
    Matrix out{};
    for (size_t r = 0; r < 3; ++r)
        for (size_t c = 0; c < 3; ++c)
            for (size_t k = 0; k < 3; ++k) out[3 * r + c] += a[3 * r + k] * b[3 * k + c];
    return out;
}

inline Point product(const Matrix& a, const Point& p) {
    Point out{};
    for (size_t r = 0; r < 3; ++r)
        for (size_t c = 0; c < 3; ++c) out[r] += a[3 * r + c] * p[c];
    return out;
}

inline Matrix about(char axis, double degrees) {
    const double s = std::sin(degrees * 3.14159265358979323846 / 180.0),
                 c = std::cos(degrees * 3.14159265358979323846 / 180.0);
    if (axis == 'X') return {1, 0, 0, 0, c, -s, 0, s, c};
    if (axis == 'Y') return {c, 0, s, 0, 1, 0, -s, 0, c};
    return {c, -s, 0, s, c, 0, 0, 0, 1};
}

struct BvhJoint {
    std::string name;
    int parent = -1;
    Point offset{};
    std::vector<std::string> channels;
    int ends = 0;  // End Sites
};

struct BvhPlace {
    Point position{};
    Matrix rotation{};
};

class Bvh {
public:
    explicit Bvh(const std::string& text) : in_(text) {
        expect("HIERARCHY");
        expect("ROOT");
        read_joint(-1);
        expect("MOTION");
        expect("Frames:");
        frame_count = size_t(number());
        expect("Frame");
        expect("Time:");
        frame_time_s = number();
        std::string line;
        std::getline(in_, line);
        size_t channels = 0;
        for (const BvhJoint& joint : joints) channels += joint.channels.size();
        while (std::getline(in_, line)) {
            std::istringstream cells(line);
            std::vector<double> row;
            for (std::string cell; cells >> cell;) row.push_back(std::stod(cell));
            if (row.size() != channels) throw std::runtime_error("a frame with another number of channels");
            frames.push_back(row);
        }
        if (frames.size() != frame_count) throw std::runtime_error("another number of frames");
    }

    /// The joints of a frame, in the file's unit. Channels are applied in their order: R = R1 R2 R3.
    std::map<std::string, BvhPlace> places(size_t frame) const {
        std::vector<BvhPlace> all;
        std::map<std::string, BvhPlace> named;
        size_t at = 0;
        for (const BvhJoint& joint : joints) {
            Matrix local = about('X', 0);
            Point shift = joint.offset;
            for (const std::string& channel : joint.channels) {
                const double value = frames[frame][at++];
                if (channel.ends_with("position"))
                    shift[size_t(channel[0] - 'X')] += value;
                else
                    local = product(local, about(channel[0], value));
            }
            BvhPlace place{shift, local};
            if (joint.parent >= 0) {
                const BvhPlace& parent = all[size_t(joint.parent)];
                const Point moved = product(parent.rotation, shift);
                for (size_t i = 0; i < 3; ++i) place.position[i] = parent.position[i] + moved[i];
                place.rotation = product(parent.rotation, local);
            }
            all.push_back(place);
            named[joint.name] = place;
        }
        return named;
    }

    std::vector<BvhJoint> joints;
    std::vector<std::vector<double>> frames;
    size_t frame_count = 0;
    double frame_time_s = 0;

private:
    std::string word() {
        std::string out;
        if (!(in_ >> out)) throw std::runtime_error("the file is cut");
        return out;
    }
    void expect(const std::string& wanted) {
        const std::string got = word();
        if (got != wanted) throw std::runtime_error("'" + got + "' where '" + wanted + "' was due");
    }
    double number() { return std::stod(word()); }
    Point point() {
        Point out;
        for (double& v : out) v = number();
        return out;
    }
    void read_joint(int parent) {
        const size_t self = joints.size();
        joints.push_back({word(), parent, {}, {}, 0});
        expect("{");
        expect("OFFSET");
        joints[self].offset = point();
        expect("CHANNELS");
        for (int n = int(number()); n > 0; --n) joints[self].channels.push_back(word());
        for (std::string next = word(); next != "}"; next = word()) {
            if (next == "JOINT") {
                read_joint(int(self));
            } else if (next == "End") {
                expect("Site");
                expect("{");
                expect("OFFSET");
                point();
                expect("}");
                ++joints[self].ends;
            } else {
                throw std::runtime_error("'" + next + "' in a joint");
            }
        }
    }

    std::istringstream in_;
};

}  // namespace vfit::test
