// A BVH file as it is: a tree of joints, and their channels over time.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace vfit::tools {

struct BvhJoint {
    enum class Channel { x, y, z, turn_x, turn_y, turn_z };

    std::string name;  // of an end: its parent's with "_end" behind it
    int parent = -1;   // parents stand before children
    glm::vec3 offset{0.0f};
    std::vector<Channel> channels;  // in the file's order
    size_t first_value = 0;         // of a frame's values
    bool is_end = false;
};

struct BvhFile {
    std::vector<BvhJoint> joints;
    double frame_time_s = 0.0;
    size_t frame_count = 0, values_per_frame = 0;
    std::vector<float> values;  // frame after frame

    /// World transforms of all joints, in the file's units and axes.
    std::vector<glm::mat4> pose(size_t frame) const;
    /// The places of all joints where no channel moves them.
    std::vector<glm::vec3> rest() const;
};

/// By its first word.
bool is_bvh_file(const std::string& path);

/// Throws Failure, which names file and line, for a file that is cut, and for numbers that are none or not
/// finite.
BvhFile read_bvh(const std::string& path);

}  // namespace vfit::tools
