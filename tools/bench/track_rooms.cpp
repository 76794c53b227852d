// Whether the tracker finds a person and the floor in rooms, and before cameras, of many kinds: a virtual
// person of known joints, put by depth test into a virtual room, seen by a camera that stands in any way.
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "bench/frames.h"
#include "bench/track_parts.h"
#include "bench/track_play.h"
#include "bench/virtual_room.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kRooms = 200, kFrames = 45, kRate_hz = 15;
constexpr uint32_t kJudgedFrom = 30;            // two seconds to look around
constexpr uint32_t kWrongFloor = 2 * kRate_hz;  // frames in a row
constexpr double kFound = 0.9, kJoints = 0.8;   // of the judged frames; of their joints within 15 cm
constexpr float kFloorOff_rad = 10.0f * kPi / 180.0f, kFloorOff_m = 0.2f;
constexpr float kRadian = kPi / 180.0f, kTrunk_m = 0.95f;

struct Range {
    float low, high;
};

/// How a camera stands, and what is special about the room.
struct Kind {
    const char* name;
    Range height_m, tilt_deg, roll_deg;  // tilt from where the trunk is in the middle; roll to either side
    FloorLook floor = FloorLook::kMatt;
    bool wall_beside = false, cut_away = false, starts_close = false;
    float closer_m = 0.0f;
};

constexpr Kind kKinds[] = {
    {"level", {0.8f, 1.4f}, {-5, 5}, {0, 4}},
    {"low, looks up", {0.25f, 0.6f}, {-3, 7}, {0, 4}},
    {"high, looks down", {1.7f, 2.2f}, {-5, 5}, {0, 4}},
    {"below the ceiling, rolled", {2.2f, 2.6f}, {-5, 5}, {10, 35}},
    {"rolled", {0.9f, 1.8f}, {-5, 5}, {15, 35}},
    {"on its side", {0.9f, 1.6f}, {-5, 5}, {86, 94}},
    {"upside down", {1.0f, 2.3f}, {-5, 5}, {175, 185}},
    {"black floor", {0.3f, 1.4f}, {-5, 5}, {0, 4}, FloorLook::kBlack},
    {"shiny floor", {0.6f, 1.6f}, {-5, 5}, {0, 4}, FloorLook::kShiny},
    {"a wall close to one side", {0.6f, 1.6f}, {-5, 5}, {0, 4}, FloorLook::kMatt, true},
    {"no floor in view", {1.2f, 1.5f}, {-14, -9}, {0, 4}, FloorLook::kMatt, false, false, false, 0.9f},
    {"background cut away", {0.8f, 1.6f}, {-5, 5}, {0, 4}, FloorLook::kMatt, false, true},
    {"cut away, on its side", {0.8f, 1.6f}, {-5, 5}, {86, 94}, FloorLook::kMatt, false, true},
    {"cut away, upside down", {0.8f, 1.6f}, {-5, 5}, {175, 185}, FloorLook::kMatt, false, true},
    {"a person close at first", {0.8f, 1.5f}, {-5, 5}, {0, 4}, FloorLook::kMatt, false, false, true},
};
constexpr const char* kMotions[] = {"sway", "wave", "forward", "reach", "squat"};

struct Draw {
    std::mt19937 random;
    float from(Range r) { return r.low + (r.high - r.low) * std::uniform_real_distribution<float>()(random); }
    bool one_in(uint32_t n) { return random() % n == 0; }
};

struct Stage {
    const Kind* kind;
    bool time_of_flight;
    float height_m, tilt_rad, roll_rad, distance_m;
    std::string person, close;  // URIs
    VirtualRoom room;
};

VirtualRoom room_of(const Kind& kind, float height_m, float distance_m, Draw& draw) {
    VirtualRoom room;
    room.floor = kind.floor;
    room.empty = kind.cut_away;
    if (!draw.one_in(8)) room.walls.push_back({{0, 0, 1}, distance_m + draw.from({0.4f, 2.0f})});
    const bool beside = draw.one_in(2);
    for (const float side : {-1.0f, 1.0f}) {
        const bool close = kind.wall_beside && beside == (side < 0);
        if (close || !draw.one_in(3))
            room.walls.push_back({{side, 0, 0}, draw.from(close ? Range{0.45f, 0.8f} : Range{1.2f, 3.0f})});
    }
    if (!draw.one_in(3)) room.walls.push_back({{0, -1, 0}, std::max(2.4f, height_m + 0.15f)});
    for (const float side : {-1.0f, 1.0f}) {  // a table, a cupboard
        if (kind.wall_beside || draw.one_in(2)) continue;
        const float x = side * draw.from({0.8f, 1.6f}),
                    z = -draw.from({distance_m - 0.3f, distance_m + 0.8f});
        const float top = draw.one_in(2) ? draw.from({0.4f, 0.8f}) : draw.from({1.2f, 2.0f});
        room.boxes.push_back({{x - 0.3f, 0.0f, z - 0.3f}, {x + 0.3f, top, z + 0.3f}});
    }
    return room;
}

Stage stage_of(uint32_t number, uint32_t seed) {
    Draw draw{std::mt19937(1000 * seed + number)};
    Stage s;
    s.kind = &kKinds[number % std::size(kKinds)];
    s.time_of_flight = number / std::size(kKinds) % 2;
    s.height_m = draw.from(s.kind->height_m);
    s.roll_rad = draw.from(s.kind->roll_deg) * kRadian * (draw.one_in(2) ? 1.0f : -1.0f);
    s.distance_m = draw.from({2.4f, 3.1f}) - s.kind->closer_m;
    s.tilt_rad = std::atan((s.height_m - kTrunk_m) / s.distance_m) + draw.from(s.kind->tilt_deg) * kRadian;
    const auto person = [&](float distance_m, uint32_t frames) {
        std::ostringstream uri;
        uri << "virtual:sensor=" << (s.time_of_flight ? "tof" : "kinect_v1")
            << "&motion=" << kMotions[draw.random() % std::size(kMotions)]
            << "&facing=" << draw.from({-50, 50}) << "&body=" << 40000 + 1000 * seed + number
            << "&seed=" << number << "&clothing=0.02&wall=0&side_wall=0&rate=" << kRate_hz
            << "&distance=" << distance_m << "&camera_height=" << s.height_m
            << "&tilt=" << s.tilt_rad / kRadian << "&frames=" << frames;
        return uri.str();
    };
    s.person = person(s.distance_m, kFrames);
    if (s.kind->starts_close) s.close = person(draw.from({0.9f, 1.1f}), kRate_hz);
    s.room = room_of(*s.kind, s.height_m, s.distance_m, draw);
    return s;
}

/// Turns what a camera without roll sees into what it sees when it is rolled about its axis.
class Roll {
public:
    explicit Roll(float roll_rad) : cos_(std::cos(roll_rad)), sin_(std::sin(roll_rad)) {}
    Joints turn(const Joints& level) const {
        Joints out = level;
        for (size_t j = 0; j < out.at.size(); ++j) {
            out.at[j][0] = double(cos_) * level.at[j][0] + double(sin_) * level.at[j][1];
            out.at[j][1] = -double(sin_) * level.at[j][0] + double(cos_) * level.at[j][1];
        }
        return out;
    }
    /// Index of the pixel without roll that pixel (u, v) shows; -1: beyond its image.
    int source(const Camera& c, uint32_t u, uint32_t v) const {
        const float x = (float(u) - c.cx) / c.fx, y = (float(v) - c.cy) / c.fy;
        const int su = int(std::lround((cos_ * x - sin_ * y) * c.fx + c.cx)),
                  sv = int(std::lround((sin_ * x + cos_ * y) * c.fy + c.cy));
        if (su < 0 || sv < 0 || su >= int(c.width) || sv >= int(c.height)) return -1;
        return sv * int(c.width) + su;
    }

private:
    float cos_, sin_;
};

bool in_view(const std::array<double, 3>& p, const Camera& camera) {
    const Vec2 at = camera.project(Vec3(p[0], p[1], p[2]));
    return at.x > 0.0f && at.y > 0.0f && at.x < float(camera.width) && at.y < float(camera.height);
}

struct Outcome {
    uint32_t judged = 0, found = 0, wrong_floor = 0, longest_wrong_floor = 0;
    Errors errors;

    bool is_found() const {
        return double(found) >= kFound * double(judged) && errors.within(0.15) >= kJoints;
    }
};

class Show {
public:
    Show(const Stage& stage, uint32_t seed)
        : stage_(stage),
          roll_(stage.roll_rad),
          random_(seed),
          context_(open_context()),
          tracker_(open_own_tracker(context_.get())) {}

    Outcome run() {
        if (!stage_.close.empty()) play(stage_.close, false);
        play(stage_.person, true);
        return out_;
    }

private:
    void play(const std::string& uri, bool judged) {
        Source source(context_.get(), uri);
        uint32_t index = 0;
        while (const auto frame = source.next()) show(frame->get(), judged, index++);
    }

    void show(vfit_frame frame, bool judged, uint32_t index) {
        const FrameImage image(frame);
        Camera camera = image.camera;
        set_floor(camera, stage_.height_m, stage_.tilt_rad, stage_.roll_rad, VFIT_FLOOR_GIVEN);
        stage_.room.render(camera, stage_.time_of_flight, random_, room_m_);
        depth_.assign(room_m_.size(), 0);
        for (uint32_t v = 0; v < camera.height; ++v)
            for (uint32_t u = 0; u < camera.width; ++u) {
                const size_t i = size_t(v) * camera.width + u;
                const int from = roll_.source(camera, u, v);
                const auto wall = uint16_t(std::lround(1000.0f * room_m_[i]));
                const uint16_t person =
                    from >= 0 && image.users[size_t(from)] ? image.depth[size_t(from)] : uint16_t(0);
                depth_[i] = person && (!wall || person < wall) ? person : wall;
            }
        time_ns_ += 1'000'000'000 / kRate_hz;
        const Frame given = make_depth_frame(context_.get(), camera, depth_, time_ns_);
        Frame tracked;
        check(vfit_tracker_update(tracker_.get(), given.get(), tracked.out()));
        const Joints truth = roll_.turn(truth_of(frame));
        if (judged) judge(tracked.get(), truth, camera, index);
    }

    void judge(vfit_frame tracked, const Joints& truth, const Camera& camera, uint32_t index) {
        const vfit_camera c = camera_of(tracked);
        const Vec3 normal(c.floor_normal[0], c.floor_normal[1], c.floor_normal[2]);
        const bool wrong = c.floor_state != VFIT_FLOOR_DEFAULT &&
                           (glm::dot(normal, camera.floor_normal) < std::cos(kFloorOff_rad) ||
                            std::abs(c.floor_distance_m - camera.floor_distance_m) > kFloorOff_m);
        out_.wrong_floor = wrong ? out_.wrong_floor + 1 : 0;
        out_.longest_wrong_floor = std::max(out_.longest_wrong_floor, out_.wrong_floor);
        if (index < kJudgedFrom) return;
        ++out_.judged;
        const uint32_t id = body_near(tracked, truth);
        out_.found += id != 0;
        if (!id) return;
        const Joints found = joints_in_camera(tracked, id, c);
        for (int j = 0; j < kScored; ++j)
            if (in_view(truth.at[size_t(j)], camera)) out_.errors.add(j, distance(found, truth, j));
    }

    const Stage& stage_;
    Roll roll_;
    std::mt19937 random_;
    Context context_;
    Tracker tracker_;
    std::vector<float> room_m_;
    std::vector<uint16_t> depth_;
    int64_t time_ns_ = 0;
    Outcome out_;
};

}  // namespace

Json judge_rooms(const JudgeOptions& options, Targets& targets) {
    struct Row {
        uint32_t rooms = 0, found = 0, floors_wrong = 0;
        Errors errors;
    };
    std::array<Row, std::size(kKinds)> rows;
    uint32_t found = 0, floors_wrong = 0;
    Json report = Json::array();
    for (uint32_t i = 0; i < kRooms; ++i) {
        const Stage stage = stage_of(i, options.seed);
        const Outcome outcome = Show(stage, i).run();
        Row& row = rows[size_t(stage.kind - kKinds)];
        const bool wrong_floor = outcome.longest_wrong_floor >= kWrongFloor;
        ++row.rooms, row.found += outcome.is_found(), row.floors_wrong += wrong_floor;
        row.errors.merge(outcome.errors);
        found += outcome.is_found(), floors_wrong += wrong_floor;
        report.push_back({{"room", i},
                          {"kind", stage.kind->name},
                          {"height_m", stage.height_m},
                          {"tilt_deg", stage.tilt_rad / kRadian},
                          {"roll_deg", stage.roll_rad / kRadian},
                          {"frames_found", outcome.found},
                          {"frames", outcome.judged},
                          {"within_15cm", outcome.errors.within(0.15)},
                          {"wrong_floor_frames", outcome.longest_wrong_floor}});
    }
    if (!options.quiet) {
        std::cout
            << "\nSYNTHETIC: " << kRooms << " virtual rooms, seed " << options.seed
            << "; found: a body in 90 % of the frames after 2 s, with 80 % of its joints in\nview within 15 "
               "cm\n"
            << "  camera or room              rooms   found   wrong floor for 2 s   mAP@10 cm where found\n";
        for (size_t k = 0; k < rows.size(); ++k)
            std::cout << "  " << std::left << std::setw(28) << kKinds[k].name << std::right << std::setw(5)
                      << rows[k].rooms << std::setw(8) << rows[k].found << std::setw(12)
                      << rows[k].floors_wrong << std::fixed << std::setprecision(3) << std::setw(20)
                      << rows[k].errors.within(0.1) << "\n";
        std::cout << "\n";
    }
    targets.judge("rooms: the person is found, of 100 rooms", 100.0 * found / kRooms, Aim::at_least, 98.0, 1);
    targets.judge("rooms: a wrong floor is kept over 2 s", floors_wrong, Aim::exactly, 0);
    return report;
}

}  // namespace vfit::tools
