#include "picture/depth_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace vfit::tools {

namespace {

constexpr std::array<std::pair<int, int>, 22> kBones = {{
    {VFIT_JOINT_HEAD, VFIT_JOINT_NECK},
    {VFIT_JOINT_NECK, VFIT_JOINT_TORSO},
    {VFIT_JOINT_TORSO, VFIT_JOINT_PELVIS},
    {VFIT_JOINT_NECK, VFIT_JOINT_LEFT_SHOULDER},
    {VFIT_JOINT_NECK, VFIT_JOINT_RIGHT_SHOULDER},
    {VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_LEFT_ELBOW},
    {VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_RIGHT_ELBOW},
    {VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_WRIST},
    {VFIT_JOINT_RIGHT_ELBOW, VFIT_JOINT_RIGHT_WRIST},
    {VFIT_JOINT_LEFT_WRIST, VFIT_JOINT_LEFT_HAND},
    {VFIT_JOINT_RIGHT_WRIST, VFIT_JOINT_RIGHT_HAND},
    {VFIT_JOINT_PELVIS, VFIT_JOINT_LEFT_HIP},
    {VFIT_JOINT_PELVIS, VFIT_JOINT_RIGHT_HIP},
    {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_LEFT_KNEE},
    {VFIT_JOINT_RIGHT_HIP, VFIT_JOINT_RIGHT_KNEE},
    {VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_LEFT_FOOT},
    {VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_RIGHT_FOOT},
    {VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_LEFT_TOES},
    {VFIT_JOINT_RIGHT_FOOT, VFIT_JOINT_RIGHT_TOES},
    // Of a source that has only the paper's 15 joints:
    {VFIT_JOINT_TORSO, VFIT_JOINT_LEFT_HIP},
    {VFIT_JOINT_TORSO, VFIT_JOINT_RIGHT_HIP},
    {VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP},
}};

constexpr Color kBone{0.98f, 0.98f, 0.95f};
constexpr Color kLeft{0.35f, 0.80f, 1.00f}, kRight{1.00f, 0.60f, 0.25f}, kMiddle{0.55f, 0.95f, 0.45f};
constexpr Color kSphere{1.00f, 0.85f, 0.30f}, kCapsule{0.95f, 0.65f, 0.20f};

/// The intrinsics and the way into the picture.
class View {
public:
    View(vfit_frame frame, int scale) : camera_(camera_of(frame)), scale_(scale) {
        check(vfit_frame_intrinsics(frame, &k_));
    }
    struct Pixel {
        float x, y, per_metre;
    };
    std::optional<Pixel> project(const float (&world)[3]) const {
        const Point p = to_camera(camera_, world);
        if (p.z < 0.05f) return std::nullopt;
        const auto s = static_cast<float>(scale_);
        return Pixel{(p.x / p.z * k_.fx + k_.cx + 0.5f) * s, (p.y / p.z * k_.fy + k_.cy + 0.5f) * s,
                     k_.fx / p.z * s};
    }

private:
    vfit_camera camera_;
    vfit_intrinsics k_ = vfit_intrinsics_init();
    int scale_;
};

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
            if (const uint16_t d = row_of<uint16_t>(depth, y)[x]) (is_person(x, y) ? of_person : of_room).push_back(d);
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
    const View view(frame, scale);
    std::array<std::optional<View::Pixel>, VFIT_JOINT_COUNT> at;
    for (const vfit_joint& j : joints) at[static_cast<size_t>(j.joint)] = view.project(j.position);
    const bool pelvis = at[VFIT_JOINT_PELVIS].has_value();
    for (const auto& [a, b] : kBones) {
        const auto& p = at[static_cast<size_t>(a)];
        const auto& q = at[static_cast<size_t>(b)];
        const bool spare = a == VFIT_JOINT_TORSO && b != VFIT_JOINT_PELVIS;
        if (p && q && !(spare && pelvis)) canvas.line(p->x, p->y, q->x, q->y, std::max(1, 3 * scale / 2), kBone);
    }
    for (const vfit_joint& j : joints)
        if (const auto& p = at[static_cast<size_t>(j.joint)])
            canvas.disc(p->x, p->y, 2.2f * static_cast<float>(scale), side_color(j.joint));
}

void draw_colliders(Canvas& canvas, vfit_frame frame, const std::vector<vfit_collider>& colliders, int scale) {
    const View view(frame, scale);
    for (const vfit_collider& c : colliders) {
        const auto p = view.project(c.center);
        if (!p || c.radius <= 0.0f) continue;
        if (c.joint_b < 0) {
            canvas.ring(p->x, p->y, c.radius * p->per_metre, std::max(1, scale), kSphere);
            continue;
        }
        const auto q = view.project(c.center_b);
        if (!q) continue;
        const float dx = q->x - p->x, dy = q->y - p->y, length = std::hypot(dx, dy);
        const float ra = c.radius * p->per_metre, rb = c.radius_b * q->per_metre;
        if (length <= std::abs(ra - rb)) continue;
        // Outer tangents of the two circles.
        const float sine = (ra - rb) / length, cosine = std::sqrt(1.0f - sine * sine);
        for (const float side : {-1.0f, 1.0f}) {
            const float nx = (dx * sine - side * dy * cosine) / length, ny = (dy * sine + side * dx * cosine) / length;
            canvas.line(p->x + nx * ra, p->y + ny * ra, q->x + nx * rb, q->y + ny * rb, 1, kCapsule);
        }
    }
}

}  // namespace vfit::tools
