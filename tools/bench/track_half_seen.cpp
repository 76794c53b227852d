// People of whom a half is seen: trousers that send back no light, a desk before them. Whether their upper
// body stays found.
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <random>
#include <sstream>

#include "bench/frames.h"
#include "bench/track_parts.h"
#include "bench/track_play.h"
#include "bench/virtual_room.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kPeople = 20, kFrames = 60, kRate_hz = 15;
constexpr float kRadian = kPi / 180.0f;
constexpr float kShoe_m = 0.1f;       // shoes are seen
constexpr float kDeskHigh_m = 0.74f;  // EN 527-1
constexpr const char* kMotions[] = {"sway", "wave", "forward", "cross"};
constexpr int kUpper[] = {VFIT_JOINT_HEAD,           VFIT_JOINT_NECK,       VFIT_JOINT_LEFT_SHOULDER,
                          VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_RIGHT_ELBOW};

enum class Hides { kTrousers, kSomeOfTrousers, kDesk };
constexpr const char* kNames[] = {"black trousers", "trousers, one reading in three", "a desk"};

struct Stage {
    Hides hides;
    bool time_of_flight;
    float height_m, tilt_rad, distance_m, crotch_m;
    std::string person;
    VirtualRoom room;
};

Stage stage_of(Hides hides, uint32_t number, uint32_t seed) {
    std::mt19937 random(11000 * seed + 100 * uint32_t(hides) + number);
    const auto draw = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    Stage s{hides, number % 2 == 1, draw(0.9f, 1.9f), 0.0f, draw(2.3f, 3.1f), draw(0.8f, 0.95f), "", {}};
    s.tilt_rad = std::atan((s.height_m - 0.95f) / s.distance_m) + draw(-3, 3) * kRadian;
    if (number % 5) s.room.walls.push_back({{0, 0, 1}, s.distance_m + draw(0.6f, 2.0f)});
    if (number % 3) s.room.walls.push_back({{1, 0, 0}, draw(1.3f, 2.5f)});
    if (hides == Hides::kDesk) {
        const float x = draw(-0.3f, 0.3f), half = draw(0.6f, 0.9f), z = -s.distance_m + draw(0.2f, 0.35f);
        s.room.boxes.push_back({{x - half, kDeskHigh_m - 0.03f, z}, {x + half, kDeskHigh_m, z + 0.7f}});
        if (number % 2)
            s.room.boxes.push_back({{x - half, 0.1f, z + 0.66f}, {x + half, kDeskHigh_m, z + 0.68f}});
        for (const float side : {-1.0f, 1.0f})
            s.room.boxes.push_back({{x + side * half - 0.03f, 0.0f, z + 0.05f},
                                    {x + side * half + 0.03f, kDeskHigh_m, z + 0.65f}});
    }
    std::ostringstream uri;
    uri << "virtual:sensor=" << (s.time_of_flight ? "tof" : "kinect_v1") << "&motion=" << kMotions[number % 4]
        << "&facing=" << draw(-30, 30) << "&body=" << 90000 + 1000 * seed + number << "&seed=" << number + 1
        << "&clothing=0.02&wall=0&side_wall=0&rate=" << kRate_hz << "&distance=" << s.distance_m
        << "&camera_height=" << s.height_m << "&tilt=" << s.tilt_rad / kRadian << "&frames=" << kFrames;
    s.person = uri.str();
    return s;
}

struct Row {
    uint32_t frames = 0, found = 0;
    Errors upper;
};

class Show {
public:
    Show(const Stage& stage, uint32_t seed)
        : stage_(stage),
          random_(seed),
          context_(open_context()),
          tracker_(open_own_tracker(context_.get())) {}

    void run(Row& row) {
        Source source(context_.get(), stage_.person);
        while (const auto frame = source.next()) show(frame->get(), row);
    }

private:
    bool sent_back(const Camera& camera, const Mat4& world, uint32_t u, uint32_t v, uint16_t depth) {
        if (stage_.hides == Hides::kDesk) return true;
        const float y = transform_point(world, camera.unproject(float(u), float(v), 0.001f * float(depth))).y;
        if (y < kShoe_m || y > stage_.crotch_m) return true;
        return stage_.hides == Hides::kSomeOfTrousers && random_() % 3 == 0;
    }

    void show(vfit_frame frame, Row& row) {
        const FrameImage image(frame);
        Camera camera = image.camera;
        set_floor(camera, stage_.height_m, stage_.tilt_rad, 0.0f, VFIT_FLOOR_GIVEN);
        const Mat4 world = camera.world_from_camera();
        stage_.room.render(camera, stage_.time_of_flight, random_, room_m_);
        depth_.assign(room_m_.size(), 0);
        for (uint32_t v = 0; v < camera.height; ++v)
            for (uint32_t u = 0; u < camera.width; ++u) {
                const size_t i = size_t(v) * camera.width + u;
                const auto thing = uint16_t(std::lround(1000.0f * room_m_[i]));
                const uint16_t person = image.users[i] ? image.depth[i] : uint16_t(0);
                const bool before = person && (!thing || person < thing);
                depth_[i] = !before ? thing : sent_back(camera, world, u, v, person) ? person : uint16_t(0);
            }
        time_ns_ += 1'000'000'000 / kRate_hz;
        Frame tracked;
        const Frame given = make_depth_frame(context_.get(), camera, depth_, time_ns_);
        check(vfit_tracker_update(tracker_.get(), given.get(), tracked.out()));
        const Joints truth = truth_of(frame);
        const uint32_t id = body_near(tracked.get(), truth);
        ++row.frames, row.found += id != 0;
        if (!id) return;
        const Joints found = joints_in_camera(tracked.get(), id, camera_of(tracked.get()));
        for (const int joint : kUpper)
            if (truth.has(joint)) row.upper.add(joint, distance(found, truth, joint));
    }

    const Stage& stage_;
    std::mt19937 random_;
    Context context_;
    Tracker tracker_;
    std::vector<float> room_m_;
    std::vector<uint16_t> depth_;
    int64_t time_ns_ = 0;
};

}  // namespace

Json judge_half_seen(const JudgeOptions& options, Targets& targets) {
    Json report = Json::array();
    if (!options.quiet)
        std::cout << "\nSYNTHETIC: " << kPeople << " people of whom a half is seen, seed " << options.seed
                  << "\n";
    for (const Hides hides : {Hides::kTrousers, Hides::kSomeOfTrousers, Hides::kDesk}) {
        Row row;
        Json people = Json::array();
        for (uint32_t i = 0; i < kPeople; ++i) {
            const Stage stage = stage_of(hides, i, options.seed);
            const uint32_t before = row.found;
            Show(stage, i).run(row);
            people.push_back(row.found - before);
        }
        const std::string name = kNames[size_t(hides)];
        const double found = 100.0 * row.found / row.frames, joints = 100.0 * row.upper.within(0.15);
        report.push_back(
            {{"hidden_by", name}, {"frames", kFrames}, {"found", people}, {"within_15cm", joints}});
        targets.judge(name + ": the person is found, images of 100", found, Aim::at_least, 98, 1);
        targets.judge(name + ": head, shoulders, elbows within 15 cm where found, of 100", joints,
                      Aim::at_least, 95, 1);
    }
    return report;
}

}  // namespace vfit::tools
