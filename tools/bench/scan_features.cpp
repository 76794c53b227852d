// vfit-bench scan-features: what scans of virtual people tell, beside the truth, as JSON lines: what the
// measures are learnt from (training/measures).
#include <cmath>
#include <fstream>
#include <iostream>

#include "bench/bench.h"
#include "bench/frames.h"
#include "bench/track_play.h"
#include "core/error.h"
#include "population/scan_scene.h"
#include "scan/body_scan.h"

namespace vfit::tools {

namespace {

struct Options {
    uint32_t count = 10, first = 0, seed = 1000, scans = 2;
    std::string space = "in", out;
};

/// The active person's joints in camera space.
Body body_of(vfit_frame frame, uint32_t id, const Camera& camera, int64_t time_ns) {
    Body body;
    body.id = id;
    body.time_ns = time_ns;
    const Mat4 to_camera = camera.camera_from_world();
    for (const vfit_joint& j : joints_of(frame, id))
        if (j.state != VFIT_JOINT_NOT_SEEN)
            body.set(j.joint, transform_point(to_camera, Vec3(j.position[0], j.position[1], j.position[2])),
                     j.state, j.confidence);
    return body;
}

void play(const std::string& uri, vfit_context context, vfit_tracker tracker, BodyScan& scan) {
    Source source(context, uri);
    while (const auto frame = source.next()) {
        Frame tracked;
        check(vfit_tracker_update(tracker, frame->get(), tracked.out()));
        const auto bodies = bodies_of(tracked.get());
        if (bodies.empty()) continue;
        const FrameImage image(tracked.get());
        scan.add(image.image(),
                 body_of(tracked.get(), bodies.front().body_id, image.camera, bodies.front().time_ns));
    }
}

/// Four digits are enough, and keep the file small; null: not seen.
Json rounded(const ScanFeatures& features) {
    Json out = Json::array();
    for (const float f : features)
        out.push_back(std::isnan(f) ? Json() : Json(std::round(double(f) * 1e4) * 1e-4));
    return out;
}

void run(const Options& o) {
    const auto body = BodyModel::load(library_file("vfit_data/body.bin"));
    Population population(body, body_space(o.space), o.seed);
    const auto model = std::make_shared<const FitModel>(*body);
    const Context context = open_context();
    std::ofstream file(o.out, std::ios::app);
    if (!file) throw Failure(o.out + ": cannot be written");
    for (uint32_t i = o.first; i < o.first + o.count; ++i) {
        const PersonOfPopulation person = population.draw(i);
        Json line = {{"number", i},
                     {"space", o.space},
                     {"sex", person.sex == VFIT_SEX_MALE ? "m" : "f"},
                     {"bmi", person.bmi},
                     {"truth", person.measures}};
        for (uint32_t s = 0; s < o.scans; ++s) {
            const ScanScene scene = ScanScene::draw(Dress::kTraining, o.seed * 7919u + i * 13u + s);
            const Tracker tracker = open_own_tracker(context.get());
            BodyScan scan(model);
            play(scene.front_uri(person), context.get(), tracker.get(), scan);
            if (scan.frames(ViewKind::kFront) < scene.front_frames / 2) continue;
            line["scene"] = scene.json();
            line["front"] = rounded(scan.features(false));
            play(scene.side_uri(person), context.get(), tracker.get(), scan);
            line["both"] =
                scan.frames(ViewKind::kSide) < scene.side_frames / 2 ? Json() : rounded(scan.features(true));
            file << line.dump() << std::endl;
        }
    }
}

}  // namespace

void add_scan_features(Command& app) {
    Command command = app.add_subcommand(
        "scan-features", "What scans of virtual people tell, beside the truth (for training)");
    auto o = std::make_shared<Options>();
    command.add_option("--count", o->count, "How many people").within(1, 100000);
    command.add_option("--first", o->first, "Number of the first");
    command.add_option("--seed", o->seed, "Of the population");
    command.add_option("--scans", o->scans, "Scans of each, in other clothes").within(1, 100);
    command
        .add_option("--space", o->space,
                    "varied: as real people differ; in: of the fit's own body space; out: beyond it")
        .one_of({"varied", "in", "out"});
    command.add_option("--out", o->out, "File of JSON lines that is added to").required();
    command.callback([o] { run(*o); });
}

}  // namespace vfit::tools
