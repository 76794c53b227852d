// A live fitting room on vfit's C ABI: one picture after the other, until somebody leaves.
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "options.h"
#include "overlay.h"
#include "picture.h"
#include "report.h"
#include "room.h"
#include "view.h"
#include "window.h"

namespace room {

namespace {

constexpr double kPatience_s = 120.0;  // for a person to come, where nobody watches

volatile std::sig_atomic_t interrupted = 0;

/// Where vertices go when nothing is drawn.
struct Memory {
    std::vector<BodyVertex> body;
    std::vector<ClothVertex> cloth;
};

class Program {
public:
    explicit Program(const Options& options) : options_(options), room_(options) {
        if (!options.draw) return;
        window_ = options.offscreen ? open_offscreen(options.width, options.height)
                                    : open_window(options.width, options.height, "vfit fitting room");
        renderer_ = renderer();
        std::fprintf(stderr, "drawn by %s%s\n", renderer_.name.c_str(),
                     renderer_.software ? " (a software renderer)" : "");
        view_.emplace(window_->width(), window_->height(), options.samples);
        overlay_.emplace();
        if (!options.record.empty()) std::filesystem::create_directories(options.record);
    }

    void run() {
        Watch clock;
        double waited_s = 0.0, dressed_s = 0.0;
        while (!ended_ && !interrupted) {
            const bool was_dressed = room_.dressed();
            take_keys();
            if (ended_) break;
            one_picture(1e-3f * last_frame_ms_);
            if (room_.film_ended()) {
                if (!room_.dressed())
                    throw Failure(options_.source + " ended before anybody could be dressed");
                break;
            }
            last_frame_ms_ = clock.lap_ms();
            if (!was_dressed || !room_.dressed()) {
                // What came before the person was dressed is another story, as is the picture in which they
                // were.
                waited_s += 1e-3 * double(last_frame_ms_);
                if (is_limited() && waited_s > kPatience_s)
                    throw Failure(std::string("no person could be dressed within two minutes: ") +
                                  room_.message());
                continue;
            }
            times_.add(stages_, last_frame_ms_);
            dressed_s += 1e-3 * double(last_frame_ms_);
            if (options_.frames && times_.frames() >= options_.frames) break;
            if (options_.seconds > 0.0 && dressed_s >= options_.seconds) break;
        }
        if (!options_.picture.empty() && view_) {
            compose(0.0f);  // once more: what a window has shown cannot be read
            last_.read(view_->width(), view_->height());
            last_.write_png(options_.picture);
        }
        if (options_.json)
            print_report({options_, room_, times_, renderer_, pressed_, mirror_, fit_map_,
                          view_ ? view_->width() : 0, view_ ? view_->height() : 0});
    }

private:
    bool is_limited() const { return options_.frames || options_.seconds > 0.0; }

    void take_keys() {
        for (const PlannedKey& planned : options_.keys)
            if (room_.dressed() && planned.frame == times_.frames()) press(planned.key);
        if (!window_) return;
        for (const Key key : window_->keys()) press(key);
        window_->keys().clear();
        take_clicks();
    }

    /// What the overlay's widgets were clicked for in the last picture, and the pointer for the next.
    void take_clicks() {
        const Wish wish = overlay_->take_wish();
        if (wish.garment != 0) room_.choose_garment(wish.garment);
        if (wish.size != 0) room_.choose_size(wish.size);
        press(wish.key);
        if (options_.clicks.empty()) {
            pointer_ = window_->pointer();
            return;
        }
        pointer_.down = false;  // a planned click is held for one picture
        for (const PlannedClick& click : options_.clicks)
            if (room_.dressed() && click.frame == times_.frames())
                pointer_ = {float(click.x), float(click.y), true};
    }

    void press(Key key) {
        pressed_.push_back(key);
        switch (key) {
            case Key::left: room_.choose_garment(-1); break;
            case Key::right: room_.choose_garment(1); break;
            case Key::up: room_.choose_size(1); break;
            case Key::down: room_.choose_size(-1); break;
            case Key::physics: room_.switch_physics(); break;
            case Key::camera: room_.switch_camera(); break;
            case Key::mirror: mirror_ = !mirror_; break;
            case Key::redress: room_.redress(); break;
            case Key::fit_map: fit_map_ = !fit_map_; break;
            case Key::help: help_ = !help_; break;
            case Key::quit: ended_ = true; break;
            case Key::none: pressed_.pop_back(); break;
        }
    }

    /// The chain, stage by stage.
    void one_picture(float seconds) {
        Watch watch;
        room_.sense();
        stages_[size_t(Stage::sense)] = watch.lap_ms();
        if (room_.dressed()) {
            room_.move(map_body());
            if (view_) view_->unmap_body();
            stages_[size_t(Stage::move)] = watch.lap_ms();
            room_.run_cloth(times_);
            room_.write_cloth(map_cloth());
            if (view_) view_->unmap_cloth();
            stages_[size_t(Stage::cloth)] = watch.lap_ms();
        }
        if (view_) draw(seconds);
        stages_[size_t(Stage::draw)] = watch.lap_ms();
    }

    BodyVertex* map_body() {
        if (view_) return view_->map_body(room_);
        memory_.body.resize(room_.body_vertices());
        return memory_.body.data();
    }
    ClothVertex* map_cloth() {
        if (view_) return view_->map_cloth(room_);
        memory_.cloth.resize(room_.cloth_vertices());
        return memory_.cloth.data();
    }

    void compose(float seconds) {
        view_->resize(window_->width(), window_->height());
        view_->draw(room_, {mirror_, fit_map_, seconds}, window_->framebuffer());
        overlay_->draw(room_, times_, {mirror_, fit_map_, help_, renderer_.name.c_str(), renderer_.software},
                       pointer_, view_->width(), view_->height(), seconds);
    }
    void draw(float seconds) {
        compose(seconds);
        if (!options_.record.empty()) {
            last_.read(view_->width(), view_->height());
            char name[32];
            std::snprintf(name, sizeof name, "/%06llu.png", static_cast<unsigned long long>(recorded_++));
            last_.write_png(options_.record + name);
        }
        window_->present();
    }

    const Options options_;
    std::unique_ptr<Window> window_;  // closed last: what is drawn with lives in it
    Room room_;
    Renderer renderer_;
    std::optional<View> view_;
    std::optional<Overlay> overlay_;
    Memory memory_;
    Picture last_;
    uint64_t recorded_ = 0;
    Times times_;
    StageMs stages_{};
    float last_frame_ms_ = 0.0f;
    std::vector<Key> pressed_;
    Pointer pointer_;
    bool mirror_ = true, fit_map_ = false, help_ = false, ended_ = false;
};

int run(int argc, char** argv) {
    try {
        const Options options = parse_options(argc, argv);
        if (options.renderer) {
            const auto window = options.offscreen ? open_offscreen(64, 64) : open_window(64, 64, "");
            const Renderer r = renderer();
            std::printf("%s%s\n", r.name.c_str(), r.software ? " (a software renderer)" : "");
            return 0;
        }
        std::signal(SIGINT, [](int) { interrupted = 1; });
        Program(options).run();
        return 0;
    } catch (const Usage& usage) {
        std::fprintf(stderr, "vfit-room: %s; --help tells all\n", usage.what.c_str());
        return 2;
    } catch (const std::exception& failure) {
        std::fprintf(stderr, "vfit-room: %s\n", failure.what());
        return 1;
    }
}

}  // namespace

}  // namespace room

int main(int argc, char** argv) { return room::run(argc, argv); }
