// vfit-paper rates: Fig. 10, the frame rate of the fitting room through the paper's four phases: the avatar
// stands; the sensor moves it; without physics; without sensor.
#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "client/files.h"
#include "client/output.h"
#include "drawing.h"
#include "paper.h"
#include "picture/line_plot.h"

namespace vfit::tools {

namespace {

struct RateOptions {
    std::string out = "paper";
    float seconds = 6.0f;
    bool json = false, only_undrawn = false;
    std::vector<std::string> garments;
};

constexpr int kWidth = 1280, kHeight = 720;
constexpr float kBin_s = 0.1f;         // of the plot
constexpr double kPatience_s = 120.0;  // for the person to be dressed
constexpr const char* kPhases[] = {"static", "sensor on", "physics off", "sensor off"};

/// One garment through all phases.
struct Run {
    std::string garment;
    CurvePoints fps, ms;
    Json phases = Json::array();
};

/// As the room's own program goes from picture to picture.
class Mirror {
public:
    Mirror(const std::string& garment, vfit_sex sex, Drawing* drawing)
        : room_(options(garment, sex)), drawing_(drawing) {}

    void picture(room::Times& times, float last_s) {
        room_.sense();
        if (room_.dressed()) {
            room_.move(drawing_ ? drawing_->map_body(room_) : memory(body_, room_.body_vertices()));
            if (drawing_) drawing_->unmap_body();
            room_.run_cloth(times);
            room_.write_cloth(drawing_ ? drawing_->map_cloth(room_) : memory(cloth_, room_.cloth_vertices()));
            if (drawing_) drawing_->unmap_cloth();
        }
        if (drawing_) drawing_->draw(room_, last_s);
    }
    room::Room& room() { return room_; }

private:
    static room::Options options(const std::string& garment, vfit_sex sex) {
        room::Options o;
        o.source =
            sex == VFIT_SEX_MALE ? "virtual:motion=demo&seed=7&sex=m" : "virtual:motion=demo&seed=7&sex=f";
        o.garments = {garment};
        o.sex = sex;
        return o;
    }
    template <typename T>
    static T* memory(std::vector<T>& items, size_t count) {
        items.resize(count);
        return items.data();
    }

    room::Room room_;
    Drawing* drawing_;
    std::vector<room::BodyVertex> body_;
    std::vector<room::ClothVertex> cloth_;
};

/// The garment is put on whom it was made for.
vfit_sex sex_of(const std::string& garment) {
    for (const char* of_men : {"flight_suit", "pants_men", "shirt_men", "martial_jacket", "martial_pants"})
        if (garment == of_men) return VFIT_SEX_MALE;
    return VFIT_SEX_FEMALE;
}

Run run(const RateOptions& o, const std::string& garment, Drawing* drawing) {
    Run out{garment, {}, {}};
    Mirror mirror(garment, sex_of(garment), drawing);
    room::Room& room = mirror.room();
    room::Watch watch;
    float last_ms = 0.0f;
    {
        room::Times before;
        for (double waited_s = 0.0; !room.dressed(); waited_s += 1e-3 * double(last_ms = watch.lap_ms())) {
            if (waited_s > kPatience_s)
                throw Failure("Fig. 10: no person could be dressed within two minutes: " +
                              std::string(room.message()));
            mirror.picture(before, 1e-3f * last_ms);
        }
    }
    room.switch_camera();
    float start_s = 0.0f;
    for (size_t phase = 0; phase < std::size(kPhases); ++phase) {
        if (phase == 1 || phase == 3) room.switch_camera();
        if (phase == 2) room.switch_physics();
        room::Times times;
        std::vector<float> frames_ms, bin;
        watch.lap_ms();
        float now_s = 0.0f, bin_s = 0.0f;
        while (now_s < o.seconds) {
            mirror.picture(times, 1e-3f * last_ms);
            last_ms = watch.lap_ms();
            frames_ms.push_back(last_ms), bin.push_back(last_ms);
            now_s += 1e-3f * last_ms, bin_s += 1e-3f * last_ms;
            if (bin_s < kBin_s) continue;
            const float at_s = start_s + now_s - 0.5f * bin_s;
            out.fps.emplace_back(at_s, float(bin.size()) / bin_s);
            out.ms.emplace_back(at_s, float(room::spread_of(bin).median));
            bin.clear(), bin_s = 0.0f;
        }
        start_s += now_s;
        const room::Spread frame = room::spread_of(frames_ms);
        Json json = {{"phase", kPhases[phase]},
                     {"frames", frames_ms.size()},
                     {"fps", double(frames_ms.size()) / double(now_s)},
                     {"frame_ms", {{"median", frame.median}, {"p95", frame.p95}}},
                     {"cloth_steps", phase < 2 ? times.cloth_steps() : 0}};
        if (phase < 2) {  // later there are none but one that had begun before
            json["cloth_step_ms"] = {{"median", times.cloth_step().median}, {"p95", times.cloth_step().p95}};
            json["cloth_interval_ms"] = {{"median", times.cloth_interval().median},
                                         {"p95", times.cloth_interval().p95}};
        }
        out.phases.push_back(std::move(json));
    }
    return out;
}

/// Frames a second above, milliseconds of one below.
void plot(const std::vector<Run>& runs, const std::string& how, float phase_s, const std::string& path) {
    constexpr int kPlotWidth = 1300, kPlotHeight = 420;
    Canvas out(kPlotWidth, 2 * kPlotHeight, {1, 1, 1});
    for (const bool is_ms : {false, true}) {
        Curve curve;
        curve.title = is_ms ? how : "Fig. 10  frame rate through the paper's four phases";
        curve.x_label = "seconds";
        curve.y_label = is_ms ? "ms a frame, medians of 0.1 s" : "frames a second, over 0.1 s";
        curve.points = is_ms ? runs[0].ms : runs[0].fps;
        curve.name = runs[0].garment;
        for (size_t i = 1; i < runs.size(); ++i)
            curve.behind.push_back({runs[i].garment, is_ms ? runs[i].ms : runs[i].fps});
        for (size_t p = 0; p < std::size(kPhases); ++p)
            curve.marks.emplace_back(phase_s * float(p), kPhases[p]);
        out.blit(draw_curve(curve, kPlotWidth, kPlotHeight), 0, is_ms ? kPlotHeight : 0, kPlotWidth,
                 kPlotHeight);
    }
    out.write_png(path);
}

void print(const Json& way) {
    std::cout << way["how"].get<std::string>() << "\n";
    for (const auto& [garment, phases] : way["garments"].items())
        for (const Json& p : phases) {
            std::cout << "  " << std::left << std::setw(18) << garment << std::setw(13)
                      << p["phase"].get<std::string>() << std::right << std::fixed << std::setprecision(0)
                      << std::setw(6) << p["fps"].get<double>() << " frames a second, a frame "
                      << std::setprecision(3) << p["frame_ms"]["median"].get<double>() << " ms, 95 % "
                      << p["frame_ms"]["p95"].get<double>();
            if (p.contains("cloth_step_ms"))
                std::cout << "; a step of the cloth " << std::setprecision(2)
                          << p["cloth_step_ms"]["median"].get<double>() << " ms, every "
                          << p["cloth_interval_ms"]["median"].get<double>() << " ms";
            std::cout << "\n";
        }
}

void rates(const RateOptions& o) {
    create_folder(o.out);
    const std::vector<std::string> garments =
        o.garments.empty() ? std::vector<std::string>{"sundress", "flight_suit"} : o.garments;
    Json out = Json::array();
    for (const bool drawn : {true, false}) {
        if (drawn && o.only_undrawn) continue;
        auto drawing = drawn ? open_drawing(kWidth, kHeight) : nullptr;
        if (drawn && !drawing) {
            std::cerr << "not drawn: this build has no OpenGL\n";
            continue;
        }
        std::ostringstream how;
        if (drawing)
            how << "drawn, " << kWidth << " x " << kHeight << ", by " << drawing->renderer()
                << (drawing->is_software() ? ", a software renderer" : "");
        else
            how << "not drawn: motion, skinning and cloth alone";
        std::vector<Run> runs;
        Json way = {{"drawn", drawn}, {"how", how.str()}};
        if (drawing) way["renderer"] = drawing->renderer(), way["software_renderer"] = drawing->is_software();
        for (const std::string& garment : garments) {
            if (drawn && !runs.empty()) {
                // A view keeps the meshes of its room. The old one ends first: its context is the thread's
                // current one.
                drawing.reset();
                drawing = open_drawing(kWidth, kHeight);
            }
            runs.push_back(run(o, garment, drawing.get()));
            way["garments"][garment] = runs.back().phases;
        }
        const std::string file = drawn ? "fig_10_drawn.png" : "fig_10_not_drawn.png";
        plot(runs, how.str(), o.seconds, (std::filesystem::path(o.out) / file).string());
        way["picture"] = file;
        if (!o.json) print(way);
        out.push_back(std::move(way));
    }
    if (o.json) print_document(out);
}

}  // namespace

void add_rates(Command& app) {
    Command command = app.add_subcommand("rates", "Figure 10 as pictures, drawn and not drawn");
    auto o = std::make_shared<RateOptions>();
    command.add_option_function(
        "--garment", [o](const std::string& name) { o->garments.push_back(name); },
        "By name; again for more (default: sundress, flight_suit)");
    command.add_option("--seconds", o->seconds, "Of each of the four phases (default 6)").positive();
    command.add_option("--out", o->out, "Folder for the pictures (default: paper)");
    command.add_flag("--not-drawn", o->only_undrawn, "Leaves the drawing out");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { rates(*o); });
}

}  // namespace vfit::tools
