// Things that move into a room and are no people: what the tracker says to furniture that a cart, a person or
// an unseen hand brings in, and to people who stand as still as furniture.
#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

#include "bench/frames.h"
#include "bench/track_parts.h"
#include "bench/track_play.h"
#include "bench/virtual_furniture.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kScenes = 60, kStanders = 12, kRate_hz = 15;
constexpr uint32_t kSlow_hz = 6;    // of people who do nothing
constexpr double kGrace_s = 1.0;    // after the thing has come to rest and the last person has left
constexpr double kAfter_s = 4.0;    // for which it is watched then
constexpr double kEmpty_s = 2.0;    // of an empty room, where a background is learnt
constexpr double kCovered_s = 0.5;  // the camera
constexpr double kStill_s = 60.0;   // for which people stand
constexpr double kArrived_s = 8.5;  // in which the motion visit brings them before the camera
constexpr double kWhole = 0.7;      // of a person is seen
constexpr double kFound = 0.9;      // of the images with a whole person
constexpr float kRadian = kPi / 180.0f, kMiddle_m = 0.85f;

enum class Way { kGlides, kAppears, kPushed };
constexpr const char* kWays[] = {"glides in", "appears", "pushed by a person"};

struct Draw {
    std::mt19937 random;
    float operator()(float low, float high) {
        return low + (high - low) * std::uniform_real_distribution<float>()(random);
    }
    bool one_in(uint32_t n) { return random() % n == 0; }
};

/// How the person of the motion visit walks (plugins/virtual_person/scripts_visit.cpp): 0 outside the view, 1
/// where they stop.
constexpr double kVisitBegins_s = 0.5, kVisitWay_s = 4.4, kVisitEnds_s = 16.8;
constexpr float kVisit_m = 2.9f;
float eased(double t, double total, double ramp) {
    const double speed = 1.0 / (total - ramp);
    t = std::clamp(t, 0.0, total);
    if (t < ramp) return float(0.5 * speed * t * t / ramp);
    if (t > total - ramp) return float(1.0 - 0.5 * speed * (total - t) * (total - t) / ramp);
    return float(speed * (t - 0.5 * ramp));
}

/// A part of a scene.
struct Play {
    std::string uri;  // of the person or of an empty room
    double length_s;
    uint32_t rate_hz = kRate_hz;
    bool thing = true, covered = false;  // the thing is there; the camera is covered
};

struct Stage {
    Furniture kind;
    Way way;
    bool learnt, time_of_flight;
    float height_m, tilt_rad, distance_m;
    float x_m, from_x_m, yaw_rad, from_yaw_rad;  // of the thing: at rest, and before
    double rest_s, end_s;                        // from when the room is no longer empty
    std::string dummy;                           // URI of the person whom a mannequin looks like
    std::vector<Play> plays;
    VirtualRoom room;
    std::vector<VirtualRoom::Solid> piece;
};

std::string uri_of(const Stage& s, const std::string& what) {
    std::ostringstream uri;
    uri << "virtual:sensor=" << (s.time_of_flight ? "tof" : "kinect_v1") << "&wall=0&side_wall=0"
        << "&distance=" << s.distance_m << "&camera_height=" << s.height_m << "&tilt=" << s.tilt_rad / kRadian
        << "&" << what;
    return uri.str();
}

void stand_camera(Stage& s, Draw& draw) {
    s.height_m = draw(0.8f, 2.2f);
    s.distance_m = draw(2.4f, 3.1f);
    s.tilt_rad = std::atan((s.height_m - kMiddle_m) / s.distance_m) + draw(-3, 3) * kRadian;
    if (!draw.one_in(6)) s.room.walls.push_back({{0, 0, 1}, s.distance_m + draw(0.5f, 2.0f)});
    if (draw.one_in(2)) s.room.walls.push_back({{1, 0, 0}, draw(1.3f, 2.5f)});  // on the left
}

Stage stage_of(uint32_t number, uint32_t seed) {
    Draw draw{std::mt19937(1000 * seed + number)};
    Stage s;
    s.kind = Furniture(number % kFurnitureKinds);
    s.way = Way((number + number / kFurnitureKinds) % 3);
    s.learnt = draw.one_in(2);
    s.time_of_flight = draw.one_in(2);
    stand_camera(s, draw);
    s.piece = make_furniture(s.kind, draw.random);
    s.yaw_rad = draw(-kPi, kPi), s.from_yaw_rad = s.yaw_rad + draw(-1, 1);
    const std::string body = "&body=" + std::to_string(60000 + 1000 * seed + number) +
                             "&seed=" + std::to_string(number + 1) + "&clothing=0.02";
    if (s.kind == Furniture::kMannequin)
        s.dummy = uri_of(s, "noise=0&quantise=0&motion=scan&arms=" + std::to_string(int(draw(8, 30))) +
                                "&facing=" + std::to_string(int(draw(-40, 40))) + "&frames=1" + body);
    const float side = draw.one_in(2) ? 1.0f : -1.0f;
    s.x_m = s.way == Way::kPushed ? -draw(0.65f, 0.85f) : draw(-0.7f, 0.7f);
    s.from_x_m = s.way == Way::kAppears  ? s.x_m
                 : s.way == Way::kPushed ? s.x_m + kVisit_m
                                         : s.x_m + 2.6f * side;
    s.rest_s = s.way == Way::kAppears  ? 0.0
               : s.way == Way::kPushed ? kVisitBegins_s + kVisitWay_s
                                       : 2.6 / draw(0.5f, 0.9f);
    if (s.kind == Furniture::kDoor || s.kind == Furniture::kCurtain) {  // stay where they hang
        s.from_x_m = s.x_m;
        s.yaw_rad = draw(-0.3f, 0.3f), s.from_yaw_rad = s.yaw_rad;
        if (s.kind == Furniture::kDoor) s.yaw_rad = -draw(0.9f, 1.9f);
        if (s.kind == Furniture::kCurtain) s.from_x_m = s.x_m + side * 0.8f;
        if (s.way == Way::kAppears) s.from_x_m = s.x_m, s.from_yaw_rad = s.yaw_rad;
    }
    s.end_s = (s.way == Way::kPushed ? kVisitEnds_s : s.rest_s) + kGrace_s + kAfter_s;
    const std::string empty = uri_of(s, "people=0");
    if (s.learnt) s.plays.push_back({empty, kEmpty_s, kRate_hz, false});
    if (s.learnt && s.way == Way::kAppears) s.plays.push_back({empty, kCovered_s, kRate_hz, false, true});
    s.plays.push_back({s.way == Way::kPushed ? uri_of(s, "motion=visit" + body) : empty, s.end_s});
    return s;
}

/// A person who comes in, or is there from the first image on, and stands before the mirror.
Stage stander_of(uint32_t number, uint32_t seed) {
    Draw draw{std::mt19937(7000 * seed + number)};
    Stage s{};
    s.time_of_flight = number % 2;
    stand_camera(s, draw);
    const std::string body = "&body=" + std::to_string(70000 + 1000 * seed + number) +
                             "&seed=" + std::to_string(number + 1) + "&clothing=0.02";
    if (number / 2 % 2) s.plays.push_back({uri_of(s, "motion=visit" + body), kArrived_s});
    const int facing = number % 3 ? 0 : int(draw(-180, 180));
    s.plays.push_back(
        {uri_of(s, "motion=scan&arms=12&facing=" + std::to_string(facing) + body), kStill_s, kSlow_hz});
    s.end_s = 1e9;
    return s;
}

/// A picture of a person's surface that is put into others by depth test, as if it were carried.
class Dummy {
public:
    Dummy(vfit_context context, const std::string& uri, float distance_m, float height_m, float tilt_rad) {
        Source source(context, uri);
        const auto frame = source.next();
        const FrameImage image(frame->get());
        Camera camera = image.camera;
        set_floor(camera, height_m, tilt_rad, 0.0f, VFIT_FLOOR_GIVEN);
        const Mat4 world = camera.world_from_camera();
        for (uint32_t v = 0; v < camera.height; ++v)
            for (uint32_t u = 0; u < camera.width; ++u) {
                const size_t i = size_t(v) * camera.width + u;
                if (!image.users[i] || !image.depth[i]) continue;
                const float z = float(image.depth[i]) * camera.depth_unit_m;
                points_.push_back(transform_point(world, camera.unproject(float(u), float(v), z)) +
                                  Vec3(0, 0, distance_m));
            }
    }

    void put(const Camera& camera, const Vec3& at, bool time_of_flight, std::mt19937& random,
             std::vector<float>& depth_m) const {
        const Mat4 into = camera.camera_from_world();
        seen_.assign(depth_m.size(), 1e9f);
        for (const Vec3& point : points_) {
            const Vec3 p = transform_point(into, point + at);
            if (p.z < 0.3f) continue;
            const Vec2 pixel = camera.project(p);
            for (int y = int(std::ceil(pixel.y - 0.7f)); float(y) < pixel.y + 0.7f; ++y)
                for (int x = int(std::ceil(pixel.x - 0.7f)); float(x) < pixel.x + 0.7f; ++x) {
                    if (x < 0 || y < 0 || x >= int(camera.width) || y >= int(camera.height)) continue;
                    float& z = seen_[size_t(y) * camera.width + size_t(x)];
                    z = std::min(z, p.z);
                }
        }
        for (size_t i = 0; i < depth_m.size(); ++i)
            if (seen_[i] < 1e8f && (depth_m[i] == 0.0f || seen_[i] < depth_m[i]))
                depth_m[i] = VirtualRoom::reading(seen_[i], time_of_flight, random);
    }

private:
    std::vector<Vec3> points_;  // about where it stands
    mutable std::vector<float> seen_;
};

struct Outcome {
    uint32_t judged = 0, with_body = 0;  // images without a person
    uint32_t whole = 0, found = 0;       // images with a whole person
    bool passes() const { return with_body == 0 && double(found) >= kFound * double(whole); }
};

class Show {
public:
    Show(const Stage& stage, uint32_t seed)
        : stage_(stage), random_(seed), context_(open_context()), tracker_(open_own_tracker(context_.get())) {
        if (!stage.dummy.empty())
            dummy_.emplace(context_.get(), stage.dummy, stage.distance_m, stage.height_m, stage.tilt_rad);
    }

    Outcome run() {
        for (const Play& play : stage_.plays) {
            Source source(context_.get(), play.uri + "&rate=" + std::to_string(play.rate_hz) + "&frames=" +
                                              std::to_string(uint32_t(play.length_s * play.rate_hz)));
            uint32_t index = 0;
            while (const auto frame = source.next()) {
                time_ns_ += 1'000'000'000 / play.rate_hz;
                show(frame->get(), play.thing ? double(index++) / play.rate_hz : -1e9, play.covered);
            }
        }
        return out_;
    }

private:
    /// t_s: since the thing is on its way; before, there is none.
    void show(vfit_frame frame, double t_s, bool covered) {
        const FrameImage image(frame);
        Camera camera = image.camera;
        set_floor(camera, stage_.height_m, stage_.tilt_rad, 0.0f, VFIT_FLOOR_GIVEN);
        VirtualRoom room = stage_.room;
        const float way = stage_.rest_s > 0.0
                              ? eased(stage_.way == Way::kPushed ? t_s - kVisitBegins_s : t_s,
                                      stage_.way == Way::kPushed ? kVisitWay_s : stage_.rest_s, 0.8)
                              : 1.0f;
        const Vec3 at(stage_.from_x_m + way * (stage_.x_m - stage_.from_x_m), 0.0f, -stage_.distance_m);
        const bool hangs = stage_.kind == Furniture::kDoor || stage_.kind == Furniture::kCurtain;
        if (t_s >= 0.0 || (hangs && stage_.way != Way::kAppears))
            place(stage_.piece, stage_.from_yaw_rad + way * (stage_.yaw_rad - stage_.from_yaw_rad), at,
                  room.solids);
        room.render(camera, stage_.time_of_flight, random_, room_m_);
        if (dummy_ && t_s >= 0.0) dummy_->put(camera, at, stage_.time_of_flight, random_, room_m_);
        depth_.assign(room_m_.size(), 0);
        uint32_t person = 0, all = 0;
        for (size_t i = 0; i < depth_.size() && !covered; ++i) {
            const auto thing = uint16_t(std::lround(1000.0f * room_m_[i]));
            const uint16_t who = image.users[i] ? image.depth[i] : uint16_t(0);
            const bool before = who && (!thing || who < thing);
            depth_[i] = before ? who : thing;
            person += before, all += who != 0;
        }
        if (person) person_s_ = t_s;
        seen_share_ = all ? double(person) / double(all) : 0.0;
        Frame tracked;
        const Frame given = make_depth_frame(context_.get(), camera, depth_, time_ns_);
        check(vfit_tracker_update(tracker_.get(), given.get(), tracked.out()));
        judge(frame, tracked.get(), t_s);
    }

    void judge(vfit_frame frame, vfit_frame tracked, double t_s) {
        const auto people = bodies_of(frame);
        if (seen_share_ > kWhole && !people.empty() && !(people[0].flags & VFIT_BODY_PARTLY_OUT_OF_VIEW)) {
            ++out_.whole;
            out_.found += body_near(tracked, truth_of(frame)) != 0;
        }
        if (t_s <= std::max(stage_.rest_s, person_s_) + kGrace_s || person_s_ == t_s) return;
        ++out_.judged;
        out_.with_body += !bodies_of(tracked).empty();
    }

    const Stage& stage_;
    std::mt19937 random_;
    Context context_;
    Tracker tracker_;
    std::optional<Dummy> dummy_;
    std::vector<float> room_m_;
    std::vector<uint16_t> depth_;
    int64_t time_ns_ = 0;
    double person_s_ = -1e9;   // when the last one was in view
    double seen_share_ = 0.0;  // of the person, in this image
    Outcome out_;
};

struct Row {
    uint32_t scenes = 0, passed = 0, judged = 0, with_body = 0;
    void add(const Outcome& o) {
        ++scenes, passed += o.passes(), judged += o.judged, with_body += o.with_body;
    }
};

void print(const std::array<Row, kFurnitureKinds>& kinds, const std::array<Row, 3>& ways) {
    std::cout << "  thing                scenes   passed   images without a person   with a body\n";
    const auto line = [](const char* name, const Row& row) {
        std::cout << "  " << std::left << std::setw(20) << name << std::right << std::setw(7) << row.scenes
                  << std::setw(9) << row.passed << std::setw(26) << row.judged << std::setw(14)
                  << row.with_body << "\n";
    };
    for (size_t k = 0; k < kinds.size(); ++k) line(name_of(Furniture(k)), kinds[k]);
    for (size_t k = 0; k < ways.size(); ++k) line(kWays[k], ways[k]);
    std::cout << "\n";
}

}  // namespace

Json judge_furniture(const JudgeOptions& options, Targets& targets) {
    std::array<Row, kFurnitureKinds> kinds;
    std::array<Row, 3> ways;
    Row things, dummies;
    uint32_t whole = 0, found = 0;
    Json report = Json::array();
    for (uint32_t i = 0; i < kScenes; ++i) {
        const Stage stage = stage_of(i, options.seed);
        const Outcome o = Show(stage, i).run();
        kinds[size_t(stage.kind)].add(o), ways[size_t(stage.way)].add(o);
        (stage.kind == Furniture::kMannequin ? dummies : things).add(o);
        whole += o.whole, found += o.found;
        report.push_back({{"scene", i},
                          {"thing", name_of(stage.kind)},
                          {"way", kWays[size_t(stage.way)]},
                          {"background_learnt", stage.learnt},
                          {"images", o.judged},
                          {"with_body", o.with_body},
                          {"person_images", o.whole},
                          {"person_found", o.found}});
    }
    Outcome standing;
    for (uint32_t i = 0; i < kStanders; ++i) {
        const Stage stage = stander_of(i, options.seed);
        const Outcome o = Show(stage, 500 + i).run();
        standing.whole += o.whole, standing.found += o.found;
        report.push_back({{"stands", i}, {"person_images", o.whole}, {"person_found", o.found}});
    }
    if (!options.quiet) {
        std::cout << "\nSYNTHETIC: " << kScenes << " things that move into a virtual room, seed "
                  << options.seed << "; passed: no body from " << kGrace_s
                  << " s after\nthe thing stands still and the last person has left, and a person who brings "
                     "it is found "
                     "in 90 % of the images\n";
        print(kinds, ways);
    }
    const auto percent = [](uint32_t of, uint32_t all) { return 100.0 * of / std::max(1u, all); };
    targets.judge("furniture: scenes passed, of 100", percent(things.passed, things.scenes), Aim::at_least,
                  100, 1);
    targets.judge("furniture: a mannequin: scenes passed, of 100", percent(dummies.passed, dummies.scenes),
                  Aim::at_least, 100, 1);
    targets.judge("furniture: images with a body without a person", things.with_body + dummies.with_body,
                  Aim::exactly, 0);
    targets.judge("furniture: a person who brings it is found, images of 100", percent(found, whole),
                  Aim::at_least, 98, 1);
    targets.judge("people who stand still for 60 s are found, images of 100",
                  percent(standing.found, standing.whole), Aim::at_least, 99.5, 2);
    return report;
}

}  // namespace vfit::tools
