// vfit-paper figures: Figures 4, 8 and 9 of a recording or sensor.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <map>
#include <sstream>

#include "bench/frames.h"
#include "client/people.h"
#include "paper.h"
#include "picture/depth_picture.h"
#include "picture/line_plot.h"
#include "picture/projection.h"
#include "track/depth_filter.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string source = "virtual:motion=scan&sensor=kinect_v1&sex=m&distance=2.8&frames=60", out = "paper";
};

constexpr int kScale = 2;
constexpr Color kHeight{0.45f, 0.95f, 0.55f}, kWidth{1.00f, 0.75f, 0.25f}, kWhite{1, 1, 1};

/// The lines of Table 1 on the person that they were measured on.
Canvas figure_4(vfit_frame frame, const std::vector<vfit_joint>& joints,
                const std::map<std::string, float>& lines) {
    Canvas canvas = draw_depth(frame, kScale);
    const Projection project(frame, kScale);
    std::map<vfit_joint_id, std::array<float, 3>> at;
    for (const vfit_joint& j : joints)
        if (j.state != VFIT_JOINT_NOT_SEEN) at[j.joint] = {j.position[0], j.position[1], j.position[2]};
    const auto place = [&](vfit_joint_id joint) {
        const auto it = at.find(joint);
        if (it == at.end())
            throw Failure("Fig. 4: the last frame does not show the joint " + tools::joint_name(joint));
        return it->second;
    };
    const auto middle = [&](vfit_joint_id a, vfit_joint_id b) {
        const auto p = place(a), q = place(b);
        std::array<float, 3> m{};
        for (size_t i = 0; i < 3; ++i) m[i] = 0.5f * (p[i] + q[i]);
        return m;
    };
    const auto draw = [&](int number, const char* key, std::array<float, 3> a, std::array<float, 3> b,
                          const Color& color) {
        const auto p = project({a[0], a[1], a[2]}), q = project({b[0], b[1], b[2]});
        if (!p || !q) return;
        canvas.line(p->x, p->y, q->x, q->y, 2, color);
        for (const auto& end : {*p, *q}) canvas.disc(end.x, end.y, 3.0f, color);
        std::ostringstream text;
        text << "(" << number << ") " << std::fixed << std::setprecision(1) << 100.0f * lines.at(key);
        canvas.text(int(std::max(p->x, q->x)) + 6, int(0.5f * (p->y + q->y)) + 4, text.str(), 9, color);
    };
    const auto has = [&](const char* key) { return lines.count(key) > 0; };
    const auto hips = middle(VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP), neck = place(VFIT_JOINT_NECK),
               head = place(VFIT_JOINT_HEAD);
    // In the image the person's left is on the right: world x runs that way too.
    const auto upright = [&](int number, const char* key, float aside_m, float low, float high) {
        if (has(key))
            draw(number, key, {hips[0] + aside_m, low, hips[2]}, {hips[0] + aside_m, high, hips[2]}, kHeight);
    };
    const auto level = [&](int number, const char* key, const std::array<float, 3>& centre) {
        if (!has(key)) return;
        const float half = 0.5f * lines.at(key);
        draw(number, key, {centre[0] - half, centre[1], centre[2]}, {centre[0] + half, centre[1], centre[2]},
             kWidth);
    };
    const float stature = has("stature_m") ? lines.at("stature_m") : head[1];
    upright(3, "stature_m", -0.85f, 0.0f, stature);
    upright(4, "hip_height_m", 0.75f, 0.0f, has("hip_height_m") ? lines.at("hip_height_m") : 0.0f);
    if (has("head_height_m"))
        upright(2, "head_height_m", 0.22f, stature - lines.at("head_height_m"), stature);
    level(1, "head_width_m", head);
    level(7, "shoulder_breadth_m", middle(VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_RIGHT_SHOULDER));
    level(8, "hip_breadth_m", hips);
    if (has("torso_height_m")) draw(9, "torso_height_m", hips, neck, kHeight);
    if (at.count(VFIT_JOINT_LEFT_ELBOW) && at.count(VFIT_JOINT_LEFT_HAND)) {
        const auto elbow = at.at(VFIT_JOINT_LEFT_ELBOW), hand = at.at(VFIT_JOINT_LEFT_HAND);
        const float length = std::hypot(hand[0] - elbow[0], hand[1] - elbow[1], hand[2] - elbow[2]);
        const auto along = [&](float metres) {
            std::array<float, 3> p{};
            for (size_t i = 0; i < 3; ++i) p[i] = elbow[i] + (hand[i] - elbow[i]) / length * metres;
            return p;
        };
        if (has("elbow_fingertip_m") && length > 0.05f) {
            const float all = lines.at("elbow_fingertip_m");
            draw(5, "elbow_fingertip_m", elbow, along(all), kHeight);
            if (has("hand_length_m")) {
                constexpr float kBeside_m = 0.05f;
                auto wrist = along(all - lines.at("hand_length_m")), tip = along(all);
                wrist[0] += kBeside_m, tip[0] += kBeside_m;
                draw(6, "hand_length_m", wrist, tip, kWhite);
            }
        }
    }
    canvas.text(12, 24, "Fig. 4  lines of Table 1, cm", 12, kWhite);
    return canvas;
}

/// The upper body before and after the filter, enlarged.
Canvas figure_8(vfit_frame frame, uint32_t body) {
    constexpr int kEnlarged = 3, kGap = 12, kTitle = 30;
    const FrameImage image(frame);
    DepthFilter filter;
    const FilteredDepth filtered = filter.run(image.image(), body);
    const PixelBox& box = filtered.box;
    const int width = box.x1 - box.x0, height = (box.y1 - box.y0) * 6 / 10;
    if (width <= 0 || height <= 0) throw Failure("Fig. 8: no person is in the picture");
    constexpr float kReach_m = 0.25f;  // before and behind the person's mean
    const auto grey = [&](float metres) {
        const float t = std::clamp(0.5f - 0.5f * (metres - filtered.mean_m) / kReach_m, 0.0f, 1.0f);
        return Color{t, t, t};
    };
    Canvas canvas(2 * width * kEnlarged + kGap, height * kEnlarged + kTitle, {0.1f, 0.1f, 0.12f});
    for (int y = 0; y < height * kEnlarged; ++y)
        for (int x = 0; x < width * kEnlarged; ++x) {
            const int u = box.x0 + x / kEnlarged, v = box.y0 + y / kEnlarged;
            const size_t i = image.image().index(uint32_t(u), uint32_t(v));
            const uint16_t raw = image.users[i] == body ? image.depth[i] : uint16_t{0};
            canvas.set(x, y + kTitle, raw ? grey(0.001f * raw) : Color{0.25f, 0.05f, 0.05f});
            canvas.set(width * kEnlarged + kGap + x, y + kTitle, grey(filtered.at(u, v)));
        }
    std::ostringstream title;
    title << "Fig. 8  the person's depth as it came (red: none), and filtered: " << filtered.patched
          << " px patched";
    canvas.text(8, 20, title.str(), 10, kWhite);
    return canvas;
}

void figures(const Options& o) {
    std::filesystem::create_directories(o.out);
    const Context context = open_context();
    Source source(context.get(), o.source);
    ScanOptions options;
    options.method = VFIT_SCAN_PROPORTIONS;
    options.track.joints = options.track.user_map = VFIT_TRACK_BUILT_IN;
    Frame last;
    const ScanRun run = run_scan(context.get(), source, options, &last);
    std::map<std::string, float> lines;
    for (const vfit_measurement& m : measurements_of(run.scan.get())) lines[m.key] = m.value;
    const auto path = [&](const char* name) { return (std::filesystem::path(o.out) / name).string(); };
    figure_4(last.get(), joints_of(last.get(), run.body_id), lines).write_png(path("fig_4.png"));
    figure_8(last.get(), run.body_id).write_png(path("fig_8.png"));
    Curve curve{"Fig. 9  depth map correction by frame", "frame", "mean absolute change, mm", {}};
    for (size_t i = 0; i < run.corrections_m.size(); ++i)
        curve.points.emplace_back(float(i), 1000.0f * run.corrections_m[i]);
    draw_curve(curve, 800, 400).write_png(path("fig_9.png"));
    std::cout << "fig_4.png, fig_8.png, fig_9.png in " << o.out << "\n";
}

}  // namespace

void add_figures(Command& app) {
    Command command = app.add_subcommand("figures", "Figures 4, 8 and 9 as pictures");
    auto o = std::make_shared<Options>();
    command.add_option("--source", o->source, "Recording folder or sensor URI (default: a virtual person)");
    command.add_option("--out", o->out, "Folder for the pictures (default: paper)");
    command.callback([o] { figures(*o); });
}

}  // namespace vfit::tools
