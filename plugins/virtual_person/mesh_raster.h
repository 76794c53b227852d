// Draws a triangle mesh into a clean image: at each pixel's centre the nearest of what is there and what the
// ray through it meets. Exact like a ray caster, and faster, since every triangle touches a few pixels.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "clean_image.h"
#include "sensor_model.h"
#include "types.h"

namespace vfit::virtual_person {

class MeshRaster {
public:
    explicit MeshRaster(const SensorModel& model);

    /// The mesh, three vertices a triangle.
    void set_triangles(std::span<const uint32_t> indices, uint32_t vertex_count);
    /// points: vertex_count of them in camera space; they may lie anywhere, behind the camera too.
    void draw(const Vec3* points, CleanImage& image);

private:
    struct Box {  // of pixel centres, both ends included
        int x0, y0, x1, y1;
    };

    bool box_of(const uint32_t* corners, Box& box) const;
    Vec3 side(uint32_t from, uint32_t to) const;
    void draw_triangle(const uint32_t* corners, CleanImage& image) const;

    float fx_, fy_, cx_, cy_;
    int last_x_, last_y_;
    std::vector<float> ray_x_, ray_y_;  // of the columns and rows, at z = 1
    std::vector<uint32_t> indices_;
    std::vector<Vec3> pixels_;  // of the vertices: u, v; z = 0 where they cannot be projected
    const Vec3* points_ = nullptr;
};

}  // namespace vfit::virtual_person
