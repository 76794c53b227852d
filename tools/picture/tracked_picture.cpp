#include "picture/tracked_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "picture/projection.h"

namespace vfit::tools {

namespace {

// Colours that also those who see few colours tell apart (Okabe, Ito 2008), lightened for a dark ground.
constexpr std::array<Color, 7> kPeople = {{{0.99f, 0.72f, 0.25f},
                                           {0.40f, 0.76f, 0.98f},
                                           {0.30f, 0.82f, 0.62f},
                                           {0.95f, 0.60f, 0.80f},
                                           {0.98f, 0.93f, 0.45f},
                                           {0.98f, 0.52f, 0.32f},
                                           {0.60f, 0.66f, 1.00f}}};
constexpr Color kNoReading{0.045f, 0.050f, 0.065f}, kNear{0.60f, 0.65f, 0.73f}, kFar{0.13f, 0.15f, 0.21f};
constexpr Color kBone{1.00f, 0.99f, 0.96f}, kDark{0.06f, 0.065f, 0.08f}, kInk{0.88f, 0.89f, 0.92f},
    kSoftInk{0.58f, 0.60f, 0.66f};

// The room's colour runs from this to that depth; the same in all frames, so that a film of them does not
// flicker.
constexpr float kNearest_m = 0.6f, kFarthest_m = 4.5f;
// Smoothing before the surface's slope is taken: as far as a depth camera's noise reaches.
constexpr int kSmoothing_px = 7;
constexpr double kSameSurface_m = 0.04;
constexpr float kEdge_m = 0.12f;  // a larger step between neighbours has no slope
// Towards the light: above and to the left of the camera.
constexpr std::array<float, 3> kLight = {-0.38f, -0.55f, -0.74f};

Color person_color(uint32_t id) { return kPeople[(id - 1) % kPeople.size()]; }

Color times(const Color& c, float k) {
    return {std::min(1.0f, c.r * k), std::min(1.0f, c.g * k), std::min(1.0f, c.b * k)};
}

/// Metres, smoothed where neighbours are on one surface; 0: no reading.
cv::Mat smooth_depth(vfit_frame frame) {
    const vfit_view depth = view_of(frame, VFIT_STREAM_DEPTH);
    const float unit = camera_of(frame).depth_unit_m;
    cv::Mat metres(static_cast<int>(depth.height), static_cast<int>(depth.width), CV_32F), out;
    for (uint32_t y = 0; y < depth.height; ++y)
        for (uint32_t x = 0; x < depth.width; ++x)
            metres.at<float>(static_cast<int>(y), static_cast<int>(x)) = unit * row_of<uint16_t>(depth, y)[x];
    cv::bilateralFilter(metres, out, kSmoothing_px, kSameSurface_m, kSmoothing_px / 2.0);
    out.setTo(0.0f, metres == 0.0f);
    return out;
}

/// Slope of the depth along one axis, in metres a pixel, from the neighbours on the same surface.
float slope(float before, float here, float after) {
    const bool b = before > 0.0f && std::abs(before - here) < kEdge_m,
               a = after > 0.0f && std::abs(after - here) < kEdge_m;
    return a && b ? 0.5f * (after - before) : a ? after - here : b ? here - before : 0.0f;
}

/// How much light each pixel's surface sends back, 0..1.
cv::Mat relief(const cv::Mat& depth, const vfit_intrinsics& k) {
    cv::Mat out(depth.size(), CV_32F, cv::Scalar(0));
    for (int y = 0; y < depth.rows; ++y)
        for (int x = 0; x < depth.cols; ++x) {
            const float z = depth.at<float>(y, x);
            if (z == 0.0f) continue;
            const auto at = [&](int u, int v) {
                return depth.at<float>(std::clamp(v, 0, depth.rows - 1), std::clamp(u, 0, depth.cols - 1));
            };
            const float gx = slope(at(x - 1, y), z, at(x + 1, y)) * k.fx / z;
            const float gy = slope(at(x, y - 1), z, at(x, y + 1)) * k.fy / z;
            const float length = std::sqrt(gx * gx + gy * gy + 1.0f);  // of the normal (gx, gy, -1)
            out.at<float>(y, x) = std::max(0.0f, (gx * kLight[0] + gy * kLight[1] - kLight[2]) / length);
        }
    return out;
}

class UserMap {
public:
    explicit UserMap(vfit_frame frame) {
        if (has_stream(frame, VFIT_STREAM_USER_MAP)) map_ = view_of(frame, VFIT_STREAM_USER_MAP);
    }
    uint8_t at(int x, int y) const {
        if (!map_.data || x < 0 || y < 0 || x >= int(map_.width) || y >= int(map_.height)) return 0;
        return row_of<uint8_t>(map_, uint32_t(y))[x];
    }
    bool outline(int x, int y) const {
        const uint8_t id = at(x, y);
        return id && (at(x - 1, y) != id || at(x + 1, y) != id || at(x, y - 1) != id || at(x, y + 1) != id);
    }

private:
    vfit_view map_ = vfit_view_init();
};

Canvas draw_scene(vfit_frame frame) {
    const cv::Mat depth = smooth_depth(frame);
    vfit_intrinsics k = vfit_intrinsics_init();
    check(vfit_frame_intrinsics(frame, &k));
    const cv::Mat light = relief(depth, k);
    const UserMap users(frame);
    Canvas canvas(depth.cols, depth.rows, kNoReading);
    for (int y = 0; y < depth.rows; ++y)
        for (int x = 0; x < depth.cols; ++x) {
            const float z = depth.at<float>(y, x);
            if (z == 0.0f) continue;
            const float t = std::clamp((z - kNearest_m) / (kFarthest_m - kNearest_m), 0.0f, 1.0f);
            const float lit = light.at<float>(y, x);
            const uint8_t id = users.at(x, y);
            if (id == 0)
                canvas.set(x, y, times(mix(kNear, kFar, std::sqrt(t)), 0.75f + 0.35f * lit));
            else if (users.outline(x, y))
                canvas.set(x, y, person_color(id));
            else
                canvas.set(x, y, times(mix(person_color(id), kNear, 0.15f), 0.30f + 0.70f * lit));
        }
    return canvas;
}

/// Sizes of lines and letters, in pixels, go with the picture's width.
struct Pen {
    explicit Pen(const Canvas& canvas) : unit(float(canvas.width()) / 320.0f) {}
    int line() const { return int(std::lround(1.2f * unit)); }
    float dot() const { return 1.9f * unit; }
    int letters() const { return int(std::lround(6.0f * unit)); }
    float label() const { return 6.0f * unit; }
    float unit;
};

/// A line with a dark rim, in dashes where asked for.
void draw_bone(Canvas& canvas, const Projection::Pixel& a, const Projection::Pixel& b, int width,
               bool dashed) {
    const float length = std::hypot(b.x - a.x, b.y - a.y);
    const int parts = dashed ? std::max(1, int(length / (6.0f * float(width)) + 0.5f)) * 2 + 1 : 1;
    for (const bool rim : {true, false})
        for (int part = 0; part < parts; part += 2) {
            const float t0 = float(part) / float(parts), t1 = float(part + 1) / float(parts);
            canvas.line(a.x + (b.x - a.x) * t0, a.y + (b.y - a.y) * t0, a.x + (b.x - a.x) * t1,
                        a.y + (b.y - a.y) * t1, rim ? width + 3 : width, rim ? kDark : kBone);
        }
}

void draw_joint(Canvas& canvas, float x, float y, float radius, bool measured, const Color& color) {
    canvas.disc(x, y, radius + 1.5f, kDark);
    canvas.disc(x, y, radius, color);
    if (!measured) canvas.disc(x, y, 0.55f * radius, kDark);
}

/// The id on a round label, above the highest joint; with a ring where it is the active person's.
void draw_id(Canvas& canvas, const JointPixels& at, const vfit_camera& camera, uint32_t id, bool active) {
    // Up in the picture of a camera that stands in any way; of one that looks straight down, the picture's
    // own.
    float up_x = camera.floor_normal[0], up_y = camera.floor_normal[1];
    const float length = std::hypot(up_x, up_y);
    if (length < 0.2f)
        up_x = 0.0f, up_y = -1.0f;
    else
        up_x /= length, up_y /= length;
    float x = 0.0f, y = 0.0f, highest = -1e9f;
    for (const auto& p : at)
        if (p && p->x * up_x + p->y * up_y > highest) x = p->x, y = p->y, highest = p->x * up_x + p->y * up_y;
    if (highest == -1e9f) return;
    const auto& head = at[VFIT_JOINT_HEAD];
    const float above = 0.17f * (head ? head->per_metre : 0.0f);  // the top of the head and some air
    const std::string text = std::to_string(id);
    const Pen pen(canvas);
    const int height = pen.letters(), width = Canvas::text_width(text, height);
    const float radius = pen.label();
    const float away = above + radius, room = radius + 2.0f;
    x = std::clamp(x + up_x * away, 2.0f * radius, float(canvas.width()) - 2.0f * radius);
    y = std::clamp(y + up_y * away, room, float(canvas.height()) - room);
    canvas.disc(x, y, radius + 2.0f, kDark);
    canvas.disc(x, y, radius, person_color(id));
    if (active) canvas.ring(x, y, radius + 2.0f * pen.unit, pen.line(), kBone);
    canvas.text(int(x) - width / 2, int(y) + height / 2, text, height, kDark);
}

void draw_person(Canvas& canvas, vfit_frame frame, uint32_t id, bool active, int scale) {
    const auto joints = joints_of(frame, id);
    const JointPixels at = project_joints(Projection(frame, scale), joints);
    std::array<bool, VFIT_JOINT_COUNT> measured{};
    for (const vfit_joint& j : joints) measured[size_t(j.joint)] = j.state == VFIT_JOINT_MEASURED;
    const Pen pen(canvas);
    std::array<bool, VFIT_JOINT_COUNT> on_a_bone{};  // others would be loose dots: chest and clavicles
    for (const auto& [a, b] : drawn_bones(at)) {
        on_a_bone[size_t(a)] = on_a_bone[size_t(b)] = true;
        draw_bone(canvas, *at[size_t(a)], *at[size_t(b)], pen.line(),
                  !measured[size_t(a)] || !measured[size_t(b)]);
    }
    for (const vfit_joint& j : joints)
        if (on_a_bone[size_t(j.joint)])
            draw_joint(canvas, at[size_t(j.joint)]->x, at[size_t(j.joint)]->y, pen.dot(),
                       measured[size_t(j.joint)], person_color(id));
    draw_id(canvas, at, camera_of(frame), id, active);
}

/// The caption, and what the dots mean.
void draw_footer(Canvas& canvas, int top, int height, const std::string& caption) {
    const int letters = height * 3 / 8, base = top + (height + letters) / 2, middle = top + height / 2;
    canvas.fill_rect(0, top, canvas.width(), height, kDark);
    canvas.text(height / 2, base, caption, letters, kInk);
    int x = canvas.width() - height / 2;
    for (const auto& [text, measured] : {std::pair{"inferred", false}, std::pair{"measured", true}}) {
        x -= Canvas::text_width(text, letters);
        canvas.text(x, base, text, letters, kSoftInk);
        x -= height / 2;
        draw_joint(canvas, float(x), float(middle), Pen(canvas).dot(), measured, kInk);
        x -= height * 3 / 4;
    }
}

}  // namespace

Canvas draw_tracked(vfit_frame frame, int scale, const std::string& caption) {
    const Canvas scene = draw_scene(frame);
    const int width = scene.width() * scale, height = scene.height() * scale,
              footer = std::max(24, height / 26);
    Canvas canvas(width, height + footer, kDark);
    canvas.blit(scene, 0, 0, width, height);
    const auto bodies = list<vfit_body>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_frame_bodies(frame, items, stride, n);
    });
    const uint32_t active = bodies.size() > 1 ? active_body(frame) : 0;
    for (const vfit_body& body : bodies)
        draw_person(canvas, frame, body.body_id, body.body_id == active, scale);
    draw_footer(canvas, height, footer, caption);
    return canvas;
}

}  // namespace vfit::tools
