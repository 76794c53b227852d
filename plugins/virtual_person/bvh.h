// Motion capture files in Biovision's BVH format, as text in and numbers out.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "types.h"

namespace vfit::virtual_person {

struct BvhJoint {
    std::string name;
    int parent = -1;
    Vec3 offset{0.0f};         // file units
    std::string channels;      // in file order: 'x' 'y' 'z' rotations, 'X' 'Y' 'Z' positions
    size_t first_channel = 0;  // of a frame's values
};

struct Bvh {
    std::vector<BvhJoint> joints;  // parents stand before children; end sites are left out
    size_t frame_count = 0, channel_count = 0;
    double frame_time_s = 0;
    std::vector<float> values;  // frame_count x channel_count, degrees and file units

    /// -1 if there is no such joint.
    int find(std::string_view name) const;
};

/// World placement of every joint in one frame, in file units.
struct BvhFrame {
    std::vector<Vec3> position;
    std::vector<Quat> rotation;
};
void evaluate(const Bvh& bvh, size_t frame, BvhFrame& out);

/// VFIT_ERROR_DATA with the file's name and the line where it goes wrong.
Bvh parse_bvh(std::string_view text, const std::string& file_name);
Bvh read_bvh(const std::string& path);

}  // namespace vfit::virtual_person
