// vfit-bench stages: milliseconds of every stage on one pinned core, on the virtual person.
#include <iomanip>
#include <iostream>
#include <map>
#include <thread>

#include "avatar/avatar_measures.h"
#include "bench/bench.h"
#include "bench/targets.h"
#include "client/output.h"
#include "client/people.h"
#include "population/library_file.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kScanFrames = 30;
constexpr int kRepeats = 5;  // of what happens once a person
constexpr const char* kShapedBody = "body of a shape, every value set";
constexpr double kShapedBody_ms = 16.0;  // a slider that a player moves, at 60 Hz

struct Options {
    std::string source = "virtual:motion=demo&sex=f&sensor=kinect_v1";
    uint32_t frames = 200;
    bool json = false;
};

struct Stages {
    std::map<std::string, Samples> per_frame, per_person;
};

/// The sensor's thread makes a frame ahead and then sleeps. It shares the pinned core and would be timed with
/// whatever runs beside it, so it is given the time to finish.
void let_sensor_finish() { std::this_thread::sleep_for(std::chrono::milliseconds(30)); }

/// Frames taken one after the other: each takes what the sensor needs to make one.
void time_sensor(const Options& options, Stages& stages) {
    const Context context = open_context();
    Source source(context.get(), options.source);
    for (uint32_t i = 0; i < options.frames; ++i) {
        const Timer timer;
        if (!source.next()) return;
        if (i > 2) stages.per_frame["sensor (virtual person)"].add(timer.ms());
    }
}

/// What making and taping a body costs.
void time_bodies(Stages& stages) {
    const auto model = BodyModel::load(library_file("vfit_data/body.bin"));
    EvaluatedBody body;
    std::vector<float> shape = model->default_shape(VFIT_SEX_FEMALE);
    for (int i = 0; i < 4 * kRepeats; ++i) {
        for (size_t p = 0; p < shape.size(); ++p) {
            const ShapeParameter& range = model->parameters()[p];
            shape[p] = glm::mix(range.minimum, range.maximum, (float((i + 3 * int(p)) % 7) + 0.3f) / 7.0f);
        }
        const Timer timer;
        model->evaluate(shape, body);
        stages.per_person[kShapedBody].add(timer.ms());
    }
    const vfit::Avatar avatar(model, {VFIT_SEX_FEMALE}, {}, Vec2(1.0f));
    for (int i = 0; i < 4 * kRepeats; ++i) {
        const Timer timer;
        measure_avatar(avatar, VFIT_SEX_FEMALE);
        stages.per_person["tape measures of a body"].add(timer.ms());
    }
}

/// A person is scanned and dressed; the time from the last scan frame to the first buffers.
struct Dressed {
    Avatar avatar;
    Garment garment;
    Motion motion;
    Cloth cloth;
};

Dressed dress(vfit_context context, vfit_scan scan, vfit_frame tracked, uint32_t body, Stages& stages) {
    Dressed d;
    const Timer all;
    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.sex = VFIT_SEX_FEMALE;
    const Timer avatar;
    check(vfit_avatar_create_from_scan(context, &desc, scan, d.avatar.out()));
    stages.per_person["avatar from scan"].add(avatar.ms());
    check(vfit_motion_create(context, nullptr, d.motion.out()));
    check(vfit_motion_bind(d.motion.get(), d.avatar.get()));
    check(vfit_motion_step(d.motion.get(), tracked, body, view_of(tracked, VFIT_STREAM_DEPTH).time_ns));
    vfit_pose pose = vfit_pose_init();
    const auto bones = bones_of(d.motion.get(), pose);
    set_pose(d.avatar.get(), pose, bones);
    const Timer garment;
    check(vfit_garment_open(context, "sundress", d.garment.out()));
    stages.per_person["garment load"].add(garment.ms());
    const Timer cloth;
    check(vfit_cloth_create(d.avatar.get(), d.garment.get(), nullptr, d.cloth.out()));
    stages.per_person["cloth create"].add(cloth.ms());
    Frame body_mesh, cloth_mesh;
    check(vfit_avatar_acquire(d.avatar.get(), body_mesh.out()));
    check(vfit_cloth_acquire(d.cloth.get(), cloth_mesh.out()));
    stages.per_person["last scan frame to first dressed buffer"].add(all.ms());
    return d;
}

/// One person from sensor to buffers; the context is new, so that nothing is warm that would not be.
void run(const Options& options, bool with_frames, Stages& stages) {
    const Context context = open_context();
    Source source(context.get(), options.source);
    Tracker tracker;
    check(vfit_tracker_create(context.get(), nullptr, tracker.out()));
    Scan scan;
    vfit_scan_desc scan_desc = vfit_scan_desc_init();
    scan_desc.frame_count = kScanFrames;
    scan_desc.sex = VFIT_SEX_FEMALE;
    check(vfit_scan_create(context.get(), &scan_desc, scan.out()));
    double scan_ms = 0.0;
    Frame tracked;
    uint32_t body = 0;
    for (vfit_result result = VFIT_NOT_READY; result != VFIT_OK;) {
        const auto frame = source.next();
        if (!frame || source.taken() > 10 * kScanFrames) throw Failure("the scan does not get complete");
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        body = first_body(tracked.get());
        let_sensor_finish();
        const Timer timer;
        result = check(vfit_scan_add(scan.get(), tracked.get(), body, nullptr));
        const double ms = timer.ms();
        scan_ms += ms;
        if (with_frames) stages.per_frame["scan"].add(ms);
    }
    stages.per_person["scan of 30 frames beyond capture"].add(scan_ms);
    Dressed d = dress(context.get(), scan.get(), tracked.get(), body, stages);
    if (!with_frames) return;

    std::vector<Avatar> fine;
    for (uint32_t detail = 1; detail <= 2; ++detail) {
        vfit_avatar_desc desc = vfit_avatar_desc_init();
        desc.sex = VFIT_SEX_FEMALE;
        desc.detail = detail;
        fine.emplace_back();
        check(vfit_avatar_create_from_scan(context.get(), &desc, scan.get(), fine.back().out()));
    }
    for (uint32_t i = 0; i < options.frames; ++i) {
        const auto frame = source.next();
        if (!frame) break;
        let_sensor_finish();
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        const int64_t now_ns = view_of(tracked.get(), VFIT_STREAM_DEPTH).time_ns;
        const Timer motion;
        check(vfit_motion_step(d.motion.get(), tracked.get(), body, now_ns));
        stages.per_frame["motion"].add(motion.ms());
        vfit_pose pose = vfit_pose_init();
        const auto bones = bones_of(d.motion.get(), pose);
        const auto pose_timed = [&](vfit_avatar avatar, const char* name) {
            const Timer timer;
            set_pose(avatar, pose, bones);
            stages.per_frame[name].add(timer.ms());
        };
        pose_timed(d.avatar.get(), "avatar 13.7k vertices");
        pose_timed(fine[0].get(), "avatar 54.8k vertices");
        pose_timed(fine[1].get(), "avatar 219k vertices");
        for (int half = 0; half < 2; ++half) {
            const Timer cloth;
            check(vfit_cloth_step(d.cloth.get(), 1.0f / 60.0f));
            stages.per_frame["cloth 1/60 s"].add(cloth.ms());
        }
    }
}

void print(const char* title, const std::map<std::string, Samples>& samples) {
    std::cout << title << "\n";
    for (const auto& [name, s] : samples)
        std::cout << "  " << std::left << std::setw(42) << name << std::right << std::fixed
                  << std::setprecision(3) << std::setw(9) << s.quantile(0.5) << " ms median " << std::setw(9)
                  << s.quantile(0.95) << " ms p95\n";
}

}  // namespace

void add_stages(Command& app) {
    Command command = app.add_subcommand("stages", "Milliseconds of every stage, one pinned core");
    auto o = std::make_shared<Options>();
    command.add_option("--source", o->source, "Sensor URI; must supply joints and a user map");
    command.add_option("--frames", o->frames, "Frames after the scan");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] {
        pin_to_cores(1);
        Stages stages;
        time_sensor(*o, stages);
        time_bodies(stages);
        for (int i = 0; i < kRepeats; ++i) run(*o, i == 0, stages);
        if (!o->json) {
            print("per frame", stages.per_frame);
            print("once a person", stages.per_person);
        }
        Targets targets(o->json);
        targets.judge(kShapedBody, stages.per_person[kShapedBody].quantile(0.5), Aim::at_most, kShapedBody_ms,
                      1, " ms");
        if (!o->json) return;
        Json out;
        for (const auto& [name, s] : stages.per_frame) out["per_frame_ms"][name] = s.json();
        for (const auto& [name, s] : stages.per_person) out["per_person_ms"][name] = s.json();
        out["targets"] = targets.json();
        print_document(out);
    });
}

}  // namespace vfit::tools
