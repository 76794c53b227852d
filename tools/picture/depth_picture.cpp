#include "picture/depth_picture.h"

#include <algorithm>
#include <cmath>

#include "picture/projection.h"

namespace vfit::tools {

namespace {

constexpr Color kBone{0.98f, 0.98f, 0.95f};
constexpr Color kLeft{0.35f, 0.80f, 1.00f}, kRight{1.00f, 0.60f, 0.25f}, kMiddle{0.55f, 0.95f, 0.45f};
constexpr Color kSphere{1.00f, 0.85f, 0.30f}, kCapsule{0.95f, 0.65f, 0.20f};

struct Range {
    float near, far;
};

/// Where all but `share` of the readings on either side lie, so that a few specks do not flatten the picture.
Range depth_range(std::vector<uint16_t> seen, double share) {
    if (seen.empty()) return {0.0f, 1.0f};
    std::sort(seen.begin(), seen.end());
    const auto cut = static_cast<size_t>(double(seen.size()) * share);
    const float near = seen[cut], far = seen[seen.size() - 1 - cut];
    return {near, std::max(far, near + 1.0f)};
}

Color room_color(float t) { return mix({0.62f, 0.68f, 0.78f}, {0.12f, 0.14f, 0.22f}, t); }
Color person_color(float t) { return mix({1.00f, 0.90f, 0.70f}, {0.52f, 0.22f, 0.36f}, t); }

Color side_color(vfit_joint_id joint) {
    const std::string name = joint_name(joint);
    return name.rfind("LEFT", 0) == 0 ? kLeft : name.rfind("RIGHT", 0) == 0 ? kRight : kMiddle;
}

}  // namespace

Canvas draw_depth(vfit_frame frame, int scale) {
    const vfit_view depth = view_of(frame, VFIT_STREAM_DEPTH);
    vfit_view map = vfit_view_init();
    if (has_stream(frame, VFIT_STREAM_USER_MAP)) map = view_of(frame, VFIT_STREAM_USER_MAP);
    const auto is_person = [&](uint32_t x, uint32_t y) { return map.data && row_of<uint8_t>(map, y)[x]; };
    std::vector<uint16_t> of_room, of_person;
    for (uint32_t y = 0; y < depth.height; ++y)
        for (uint32_t x = 0; x < depth.width; ++x)
            if (const uint16_t d = row_of<uint16_t>(depth, y)[x])
                (is_person(x, y) ? of_person : of_room).push_back(d);
    const Range room = depth_range(std::move(of_room), 0.01), body = depth_range(std::move(of_person), 0.08);
    Canvas canvas(static_cast<int>(depth.width) * scale, static_cast<int>(depth.height) * scale);
    for (int y = 0; y < canvas.height(); ++y)
        for (int x = 0; x < canvas.width(); ++x) {
            const auto column = static_cast<uint32_t>(x / scale), row = static_cast<uint32_t>(y / scale);
            const uint16_t d = row_of<uint16_t>(depth, row)[column];
            if (d == 0) continue;
            const bool person = is_person(column, row);
            const Range& range = person ? body : room;
            const float s = std::clamp((d - range.near) / (range.far - range.near), 0.0f, 1.0f);
            canvas.set(x, y, person ? person_color(s) : room_color(s));
        }
    return canvas;
}

void draw_skeleton(Canvas& canvas, vfit_frame frame, const std::vector<vfit_joint>& joints, int scale) {
    const JointPixels at = project_joints(Projection(frame, scale), joints);
    const auto pixel = [&](vfit_joint_id joint) { return at[static_cast<size_t>(joint)]; };
    for (const auto& [a, b] : drawn_bones(at))
        canvas.line(pixel(a)->x, pixel(a)->y, pixel(b)->x, pixel(b)->y, std::max(1, 3 * scale / 2), kBone);
    for (const vfit_joint& j : joints)
        if (const auto p = pixel(j.joint))
            canvas.disc(p->x, p->y, 2.2f * static_cast<float>(scale), side_color(j.joint));
}

void draw_colliders(Canvas& canvas, vfit_frame frame, const std::vector<vfit_collider>& colliders,
                    int scale) {
    const Projection project(frame, scale);
    for (const vfit_collider& c : colliders) {
        const auto p = project(c.center);
        if (!p || c.radius <= 0.0f) continue;
        if (c.joint_b < 0) {
            canvas.ring(p->x, p->y, c.radius * p->per_metre, std::max(1, scale), kSphere);
            continue;
        }
        const auto q = project(c.center_b);
        if (!q) continue;
        const float dx = q->x - p->x, dy = q->y - p->y, length = std::hypot(dx, dy);
        const float ra = c.radius * p->per_metre, rb = c.radius_b * q->per_metre;
        if (length <= std::abs(ra - rb)) continue;
        // Outer tangents of the two circles.
        const float sine = (ra - rb) / length, cosine = std::sqrt(1.0f - sine * sine);
        for (const float side : {-1.0f, 1.0f}) {
            const float nx = (dx * sine - side * dy * cosine) / length,
                        ny = (dy * sine + side * dx * cosine) / length;
            canvas.line(p->x + nx * ra, p->y + ny * ra, q->x + nx * rb, q->y + ny * rb, 1, kCapsule);
        }
    }
}

}  // namespace vfit::tools
