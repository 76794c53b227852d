// vfit-bench scan-features: what scans of virtual people tell, beside the truth, as JSON lines: what the
// measures are learnt from (training/measures).
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <set>
#include <system_error>

#include "bench/bench.h"
#include "bench/frames.h"
#include "bench/track_play.h"
#include "client/files.h"
#include "core/error.h"
#include "population/scan_scene.h"
#include "scan/seen_measures.h"

namespace vfit::tools {

namespace {

struct Options {
    uint32_t count = 10, first = 0, seed = 1000, scans = 2;
    std::string space = "in", out, recordings;
    bool turn = false, cameras = false;
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

constexpr uint32_t kFrontFrames = 20;  // before a turn
enum class Turning { kNo, kYes };

/// Calls `kept` after each frame that was kept; of a turn, after those from the front alone.
void play(
    const std::string& uri, vfit_context context, vfit_tracker tracker, BodyScan& scan,
    const std::function<void()>& kept = [] {}, Turning turning = Turning::kNo) {
    Source source(context, uri);
    while (const auto frame = source.next()) {
        Frame tracked;
        check(vfit_tracker_update(tracker, frame->get(), tracked.out()));
        const auto bodies = bodies_of(tracked.get());
        if (bodies.empty()) continue;
        const FrameImage image(tracked.get());
        const Body body =
            body_of(tracked.get(), bodies.front().body_id, image.camera, bodies.front().time_ns);
        if (turning == Turning::kYes && scan.frames(ViewKind::kFront) >= kFrontFrames) {
            if (scan.fit_turning(image.image(), body)) scan.keep_turning(image.image(), body);
        } else if (scan.add(image.image(), body) != ViewKind::kOther) {
            kept();
        }
    }
}

/// Four digits are enough, and keep the file small; null: not seen.
Json rounded(const ScanFeatures& features) {
    Json out = Json::array();
    for (const float f : features)
        out.push_back(std::isnan(f) ? Json() : Json(std::round(double(f) * 1e4) * 1e-4));
    return out;
}

Json number_or_null(float value) { return std::isnan(value) ? Json() : Json(value); }

Json json_of(const SeenMeasures& m) {
    return {{"stature_m", number_or_null(m.stature_m)},
            {"chest_girth_m", number_or_null(m.chest_girth_m)},
            {"waist_girth_m", number_or_null(m.waist_girth_m)},
            {"hip_girth_m", number_or_null(m.hip_girth_m)},
            {"waist_navel_girth_m", number_or_null(m.waist_navel_girth_m)},
            {"waist_minimum_girth_m", number_or_null(m.waist_minimum_girth_m)}};
}

Json seen(const ScanFeatures& features, bool female) {
    return json_of(seen_measures(features[kCrownFeature], section_girths(features), female));
}

Json seen_turning(const BodyScan& scan, bool female) {
    return json_of(seen_measures(scan.turned_trunk(), female));
}

/// Folders with a truth.json, by their names.
std::set<std::filesystem::path> recordings_in(const std::string& folder) {
    std::set<std::filesystem::path> out;
    std::error_code fault;
    for (const auto& entry : std::filesystem::directory_iterator(folder, fault))
        if (std::filesystem::exists(entry.path() / "truth.json")) out.insert(entry.path());
    if (out.empty()) throw Failure(folder + ": holds no recordings with a truth.json");
    return out;
}

Json truth_of(const std::filesystem::path& recording) {
    const std::string path = (recording / "truth.json").string();
    const Json truth = Json::parse(read_text(path), nullptr, false);
    const bool complete = truth.is_object() && truth.contains("measures") && truth.contains("sex") &&
                          (truth["sex"] == "f" || truth["sex"] == "m");
    if (!complete) throw Failure(path + ": has not \"sex\" (f, m) and \"measures\"");
    return truth;
}

/// Recordings of a person from the front and then from the side.
void run_recordings(const Options& o, std::ostream& out) {
    const auto model = std::make_shared<const FitModel>(*BodyModel::load(library_file("vfit_data/body.bin")));
    const Context context = open_context();
    uint32_t number = 0;
    for (const std::filesystem::path& folder : recordings_in(o.recordings)) {
        const Json truth = truth_of(folder);
        const Tracker tracker = open_own_tracker(context.get());
        BodyScan scan(model);
        const bool female = truth.at("sex") == "f";
        Json front, seen_front;
        const auto kept = [&] {
            if (scan.frames(ViewKind::kSide)) return;
            front = rounded(scan.features(false)), seen_front = seen(scan.features(false), female);
        };
        play(folder.string(), context.get(), tracker.get(), scan, kept,
             o.turn ? Turning::kYes : Turning::kNo);
        const bool both = scan.frames(ViewKind::kFront) && scan.frames(ViewKind::kSide);
        const Json line = {{"number", number++},
                           {"space", "recording"},
                           {"sex", truth.at("sex")},
                           {"truth", truth.at("measures")},
                           {"scene", {{"top_m", 0.0}, {"sleeves_m", 0.0}, {"trousers_m", 0.0}}},
                           {"outline_loss_px", scan.outline_loss_px()},
                           {"front", front},
                           {"both", both ? rounded(scan.features(true)) : Json()},
                           {"seen_front", seen_front},
                           {"seen_both", both ? seen(scan.features(true), female) : Json()},
                           {"seen_turn", o.turn ? seen_turning(scan, female) : Json()}};
        out << line.dump() << std::endl;
    }
}

void run(const Options& o) {
    if (!o.recordings.empty()) {
        std::ofstream file(o.out, std::ios::app);
        if (!file) throw Failure(o.out + ": cannot be written");
        return run_recordings(o, file);
    }
    const auto body = BodyModel::load(library_file("vfit_data/body.bin"));
    VirtualPeople population(body, body_space(o.space), o.seed);
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
            line["outline_loss_px"] = scan.outline_loss_px();
            line["front"] = rounded(scan.features(false));
            line["seen_front"] = seen(scan.features(false), person.sex == VFIT_SEX_FEMALE);
            play(scene.side_uri(person), context.get(), tracker.get(), scan);
            const bool both = scan.frames(ViewKind::kSide) >= scene.side_frames / 2;
            line["both"] = both ? rounded(scan.features(true)) : Json();
            line["seen_both"] = both ? seen(scan.features(true), person.sex == VFIT_SEX_FEMALE) : Json();
            line["seen_turn"] = Json();
            if (o.turn) {  // before a tracker that has not seen the person
                const Tracker other = open_own_tracker(context.get());
                BodyScan turn(model);
                play(scene.front_uri(person), context.get(), other.get(), turn);
                play(scene.turn_uri(person), context.get(), other.get(), turn, [] {}, Turning::kYes);
                line["seen_turn"] = seen_turning(turn, person.sex == VFIT_SEX_FEMALE);
            }
            line["seen_cameras"] = Json();
            if (o.cameras) {
                BodyScan around(model);
                play(scene.front_uri(person), context.get(), tracker.get(), around);
                for (const SceneCamera& camera : scene.around(person)) {
                    const Tracker own = open_own_tracker(context.get());
                    play(camera.uri, context.get(), own.get(), around, [] {}, Turning::kYes);
                }
                line["seen_cameras"] = seen_turning(around, person.sex == VFIT_SEX_FEMALE);
            }
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
    command.add_option("--recordings", o->recordings,
                       "Instead of generated people: a folder of recordings with a truth.json each "
                       "(tools/judge_measures)");
    command.add_flag("--turn", o->turn, "A turn on the spot as well");
    command.add_flag("--cameras", o->cameras, "Four cameras around the person as well");
    command.add_option("--out", o->out, "File of JSON lines that is added to").required();
    command.callback([o] { run(*o); });
}

}  // namespace vfit::tools
