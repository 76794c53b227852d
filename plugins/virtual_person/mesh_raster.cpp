#include "mesh_raster.h"

#include <algorithm>
#include <cmath>

#include "error.h"

namespace vfit::virtual_person {

namespace {

constexpr float kNearest_m =
    0.05f;  // a vertex nearer than this is not projected: its triangles may be anywhere
constexpr float kRounding_px = 1.0f / 64;  // more than the projection's rounding, to 8192 px

}  // namespace

MeshRaster::MeshRaster(const SensorModel& model)
    : fx_(model.fx),
      fy_(model.fy),
      cx_(model.cx),
      cy_(model.cy),
      last_x_(static_cast<int>(model.width) - 1),
      last_y_(static_cast<int>(model.height) - 1) {
    for (uint32_t x = 0; x < model.width; ++x) ray_x_.push_back((static_cast<float>(x) - cx_) / fx_);
    for (uint32_t y = 0; y < model.height; ++y) ray_y_.push_back((static_cast<float>(y) - cy_) / fy_);
}

void MeshRaster::set_triangles(std::span<const uint32_t> indices, uint32_t vertex_count) {
    if (indices.empty() || indices.size() % 3 != 0)
        fail(VFIT_ERROR_DATA, "virtual: the body's mesh has no triangles");
    for (const uint32_t i : indices)
        if (i >= vertex_count)
            fail(VFIT_ERROR_DATA, "virtual: the body's mesh names vertex ", i, " of ", vertex_count);
    indices_.assign(indices.begin(), indices.end());
    pixels_.resize(vertex_count);
}

// False where no pixel centre lies in it: so it is with most triangles of a fine body.
bool MeshRaster::box_of(const uint32_t* corners, Box& box) const {
    const Vec3 &a = pixels_[corners[0]], &b = pixels_[corners[1]], &c = pixels_[corners[2]];
    if (a.z <= 0.0f || b.z <= 0.0f || c.z <= 0.0f) {
        box = {0, 0, last_x_, last_y_};
        return true;
    }
    const float least_x = std::min(a.x, std::min(b.x, c.x)) - kRounding_px;
    const float least_y = std::min(a.y, std::min(b.y, c.y)) - kRounding_px;
    const float most_x = std::max(a.x, std::max(b.x, c.x)) + kRounding_px;
    const float most_y = std::max(a.y, std::max(b.y, c.y)) + kRounding_px;
    if (most_x < 0.0f || most_y < 0.0f || least_x > static_cast<float>(last_x_) ||
        least_y > static_cast<float>(last_y_))
        return false;
    // Upwards as 1 + floor, which a conversion is from -1 on: a box that begins earlier begins at 0 anyway.
    box.x0 = static_cast<int>(std::max(least_x, -1.0f) + 1.0f);
    box.y0 = static_cast<int>(std::max(least_y, -1.0f) + 1.0f);
    box.x1 = static_cast<int>(std::min(most_x, static_cast<float>(last_x_)));
    box.y1 = static_cast<int>(std::min(most_y, static_cast<float>(last_y_)));
    return box.x0 <= box.x1 && box.y0 <= box.y1;
}

// Normal of the plane through the camera and an edge: a ray's product with it says on which side of the edge
// the ray passes. Two triangles compute it from the same end, so that no ray passes between them.
Vec3 MeshRaster::side(uint32_t from, uint32_t to) const {
    const Vec3 &a = points_[from], &b = points_[to];
    return from < to ? glm::cross(a, b - a) : -glm::cross(b, a - b);
}

// The ray d meets the triangle where it passes all three edges on the side on which the camera lies of it
// (homogeneous edge functions, Olano and Greer 1997: nothing need be clipped, not even behind the camera).
void MeshRaster::draw_triangle(const uint32_t* corners, CleanImage& image) const {
    Box box;
    if (!box_of(corners, box)) return;
    const Vec3 &a = points_[corners[0]], &b = points_[corners[1]], &c = points_[corners[2]];
    Vec3 normal = glm::cross(b - a, c - a);
    float distance = glm::dot(a, normal);  // of the plane, times the normal's length
    if (distance == 0.0f) return;          // seen from its edge
    const float facing = distance > 0.0f ? 1.0f : -1.0f;
    const Vec3 sides[3] = {facing * side(corners[0], corners[1]), facing * side(corners[1], corners[2]),
                           facing * side(corners[2], corners[0])};
    normal *= facing, distance *= facing;
    const float normal2 = glm::dot(normal, normal);
    for (int y = box.y0; y <= box.y1; ++y) {
        const float dy = ray_y_[size_t(y)], row0 = sides[0].y * dy + sides[0].z,
                    row1 = sides[1].y * dy + sides[1].z, row2 = sides[2].y * dy + sides[2].z,
                    row = normal.y * dy + normal.z;
        const size_t first = size_t(y) * image.width;
        for (int x = box.x0; x <= box.x1; ++x) {
            const float dx = ray_x_[size_t(x)], along_normal = normal.x * dx + row;
            const float least =
                std::min(std::min(sides[0].x * dx + row0, sides[1].x * dx + row1), sides[2].x * dx + row2);
            if (least < 0.0f || !(along_normal > 0.0f)) continue;
            const float depth = distance / along_normal;
            float& nearest = image.depth_m[first + size_t(x)];
            if (nearest > 0.0f && nearest < depth) continue;
            nearest = depth;
            image.cosine[first + size_t(x)] = along_normal / std::sqrt(normal2 * (dx * dx + dy * dy + 1.0f));
            image.user[first + size_t(x)] = 1;
        }
    }
}

void MeshRaster::draw(const Vec3* points, CleanImage& image) {
    points_ = points;
    for (size_t i = 0; i < pixels_.size(); ++i) {
        const Vec3& p = points[i];
        pixels_[i] = p.z > kNearest_m ? Vec3(p.x / p.z * fx_ + cx_, p.y / p.z * fy_ + cy_, p.z) : Vec3(0.0f);
    }
    for (size_t i = 0; i < indices_.size(); i += 3) draw_triangle(&indices_[i], image);
}

}  // namespace vfit::virtual_person
