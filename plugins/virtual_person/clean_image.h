// What a perfect depth camera would see: the input of the sensor models and the ground truth of the user map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vfit::virtual_person {

struct CleanImage {
    uint32_t width = 0, height = 0;
    std::vector<float> depth_m;  // along the optical axis; 0: nothing
    std::vector<float> cosine;   // between the line of sight and the surface normal, 0..1
    std::vector<uint8_t> user;   // 0 room, 1 person

    void resize(uint32_t w, uint32_t h) {
        width = w, height = h;
        const size_t n = size_t{w} * h;
        depth_m.assign(n, 0.0f), cosine.assign(n, 0.0f), user.assign(n, 0);
    }
    size_t pixel_count() const { return depth_m.size(); }
};

}  // namespace vfit::virtual_person
