#include "client/people.h"

#include <cmath>
#include <cstring>
#include <iomanip>
#include <iostream>
#include <string>

#include "client/files.h"
#include "client/progress.h"
#include "client/refused_frames.h"

namespace vfit::tools {

namespace {

// A source without end must not be waited on for ever: ten times the frames that are wanted.
constexpr uint32_t kPatience = 10;

// A label that is likelier than this is named alone; else the two best are, where one of them is right as
// often.
constexpr double kSure = 0.7;

std::string no_frame_text(const ScanRun& run, const RefusedFrames& refused) {
    std::string out = "no frame ";
    if (run.side_frames_taken)
        out += "from the front could be used, " + std::to_string(run.side_frames_taken) + " from the side";
    else
        out += "could be used";
    return refused.text().empty() ? out : out + ": " + refused.text();
}

}  // namespace

const char* guidance_text(vfit_guidance guidance) {
    switch (guidance) {
        case VFIT_GUIDANCE_NONE: return "nothing is wrong";
        case VFIT_GUIDANCE_STEP_BACK: return "the person is too close, or cut by the image border";
        case VFIT_GUIDANCE_STEP_CLOSER: return "the person is too far away";
        case VFIT_GUIDANCE_ARMS_OUT: return "the arms are not clear of the body";
        case VFIT_GUIDANCE_HOLD_STILL: return "the person moves, or does not stand upright";
        case VFIT_GUIDANCE_TURN_SIDEWAYS: return "a side view is wanted";
        case VFIT_GUIDANCE_FEET_NOT_VISIBLE: return "the feet are not visible";
        case VFIT_GUIDANCE_ONE_PERSON_ONLY: return "more than one person is in view";
        case VFIT_GUIDANCE_NOBODY: return "no person is in view";
        case VFIT_GUIDANCE_JOINTS_MISSING: return "joints are missing";
        case VFIT_GUIDANCE_FACE_CAMERA: return "the person does not face the camera";
        case VFIT_GUIDANCE_TURN_ROUND: return "the person does not go on turning";
        case VFIT_GUIDANCE_TURN_SLOWER: return "the person turns too fast";
        case VFIT_GUIDANCE_ARMS_FORWARD: return "from the side, an arm hides the body";
        default: return "unknown reason";
    }
}

namespace {

/// A scan and what has come of it so far.
class Scanning {
public:
    Scanning(vfit_context context, const ScanOptions& options, size_t cameras) : bodies_(cameras) {
        vfit_scan_desc desc = vfit_scan_desc_init();
        desc.frame_count = options.frames;
        desc.sex = options.sex;
        desc.method = options.method;
        desc.side_frame_count = options.side_frames;
        desc.flags = options.flags;
        desc.camera_count = uint32_t(cameras);
        check(vfit_scan_create(context, &desc, run_.scan.out()));
        run_.method = options.method == VFIT_SCAN_DEFAULT ? VFIT_SCAN_FIT : options.method;
    }

    /// Whether the frame was taken.
    bool add(uint32_t camera, vfit_frame tracked) {
        // Frames of one person alone are averaged, also where somebody else takes their place.
        uint32_t& scanned = bodies_[camera];
        const uint32_t body = scanned ? scanned : active_body(tracked);
        vfit_scan_state state = vfit_scan_state_init();
        const vfit_result result = check(vfit_scan_add_from(run_.scan.get(), camera, tracked, body, &state));
        const bool taken = result != VFIT_INCOMPLETE;
        if (taken) {
            scanned = body;
            run_.compute_ms += state.compute_ms;
            run_.last_ms = state.compute_ms;
            run_.corrections_m.push_back(state.correction_m);
        } else {
            refused_.add(state.guidance);
        }
        run_.frames_wanted = state.frames_wanted;
        run_.frames_taken = state.frames_taken;
        run_.side_frames_taken = state.side_frames_taken;
        run_.turn_seen = state.turn_seen;
        run_.complete = result == VFIT_OK;
        progress_.at(run_.frames_taken, run_.frames_wanted);
        return taken;
    }
    /// Complete, or no use to wait any longer; asked once after each moment.
    bool ended() { return run_.complete || ++moments_ == kPatience * run_.frames_wanted; }
    ScanRun finish() {
        if (run_.frames_wanted == 0) throw Failure("the source has no frames");
        if (run_.frames_taken == 0) throw NoFrameTaken(no_frame_text(run_, refused_));
        run_.body_id = bodies_.front();
        return std::move(run_);
    }

private:
    ScanRun run_;
    RefusedFrames refused_;
    std::vector<uint32_t> bodies_;  // id of the scanned person in each camera; 0: none yet
    uint32_t moments_ = 0;
    Progress progress_{"scanning"};
};

ScanRun run_scan(vfit_context context, Cameras& cameras, const ScanOptions& options, Frame* last_frame) {
    Scanning scanning(context, options, cameras.count());
    while (cameras.next()) {
        for (size_t i = 0; i < cameras.count(); ++i)
            if (scanning.add(uint32_t(i), cameras.tracked(i)) && i == 0 && last_frame)
                *last_frame = cameras.take_tracked(i);
        if (scanning.ended()) break;
    }
    return scanning.finish();
}

}  // namespace

ScanRun run_scan(vfit_context context, Source& source, const ScanOptions& options, Frame* last_frame) {
    const Tracker tracker = open_tracker(context, options.track);
    Scanning scanning(context, options, 1);
    while (auto frame = source.next()) {
        Frame tracked;
        check(vfit_tracker_update(tracker.get(), frame->get(), tracked.out()));
        if (scanning.add(0, tracked.get()) && last_frame) *last_frame = std::move(tracked);
        if (scanning.ended()) break;
    }
    return scanning.finish();
}

ScanRun scan_source(vfit_context context, const std::string& uri, const ScanOptions& options,
                    Frame* last_frame) {
    const auto scan = [&](const ScanOptions& with) {
        if (with.other_cameras.empty()) {
            Source source(context, uri);
            return run_scan(context, source, with, last_frame);
        }
        std::vector<std::string> uris{uri};
        uris.insert(uris.end(), with.other_cameras.begin(), with.other_cameras.end());
        Cameras cameras(context, uris, with.track, with.places);
        return run_scan(context, cameras, with, last_frame);
    };
    std::string reason;
    try {
        return scan(options);
    } catch (const NoFrameTaken& refused) {
        if (options.method != VFIT_SCAN_DEFAULT) throw;
        reason = refused.what();
    }
    ScanOptions paper = options;
    paper.method = VFIT_SCAN_PROPORTIONS;
    paper.other_cameras.clear(), paper.places.clear();
    try {
        ScanRun run = scan(paper);
        run.note = "measured by the paper's method, without girths: for the fitted body, " + reason;
        return run;
    } catch (const NoFrameTaken&) {
        throw NoFrameTaken(reason);
    }
}

Json measurements_json(const std::vector<vfit_measurement>& measurements) {
    Json out = Json::object();
    for (const vfit_measurement& m : measurements)
        out[m.key] = {{"value", m.value}, {"sigma", m.sigma}, {"observed", m.observed != 0}};
    return out;
}

void print_measurements(const Json& measurements) {
    std::cout << std::fixed;
    for (const auto& [key, m] : measurements.items()) {
        const bool mass = key.size() > 3 && key.substr(key.size() - 3) == "_kg";
        const auto print_amount = [&](double value) {
            std::cout << std::setprecision(mass ? 1 : 3) << std::setw(7) << value << (mass ? " kg" : " m ");
        };
        std::cout << std::left << std::setw(24) << key << std::right;
        print_amount(m["value"]);
        std::cout << "  +-";
        print_amount(m["sigma"]);
        std::cout << (m["observed"].get<bool>() ? "" : "  (inferred)") << "\n";
    }
}

std::vector<vfit_measurement> measurements_of(vfit_scan scan) {
    return list<vfit_measurement>(
        [&](auto* items, uint32_t stride, uint32_t* n) { return vfit_scan_measure(scan, items, stride, n); });
}

StoredMeasures measurements_from(const std::string& text) {
    StoredMeasures out;
    out.measurements = list<vfit_measurement>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_measurements_read(text.data(), text.size(), items, stride, n, &out.sex);
    });
    return out;
}

StoredMeasures read_measures(const std::string& path) {
    const std::string text = read_text(path);
    try {
        return measurements_from(text);
    } catch (const Failure& failure) {
        throw Failure(path + ": " + failure.what());
    }
}

std::vector<vfit_measurement> calibrated_measurements(const std::string& calibration,
                                                      const std::vector<vfit_measurement>& scanned) {
    return list<vfit_measurement>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_calibration_apply(calibration.data(), calibration.size(), scanned.data(),
                                      sizeof(vfit_measurement), uint32_t(scanned.size()), items, stride, n);
    });
}

std::vector<vfit_measurement> merged_measurements(const std::vector<vfit_measurement>& a,
                                                  const std::vector<vfit_measurement>& b) {
    return list<vfit_measurement>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_measurements_merge(a.data(), sizeof(vfit_measurement), static_cast<uint32_t>(a.size()),
                                       b.data(), sizeof(vfit_measurement), static_cast<uint32_t>(b.size()),
                                       items, stride, n);
    });
}

std::string profile_text(const std::vector<vfit_measurement>& measurements, vfit_sex sex) {
    const auto count = static_cast<uint32_t>(measurements.size());
    uint32_t capacity = 0;
    check(vfit_measurements_write(measurements.data(), sizeof(vfit_measurement), count, sex, nullptr,
                                  &capacity));
    std::string text(capacity, 0);
    check(vfit_measurements_write(measurements.data(), sizeof(vfit_measurement), count, sex, text.data(),
                                  &capacity));
    text.resize(capacity - 1);
    return text;
}

Json sizes_json(vfit_size_chart chart, const std::string& garment_kind,
                const std::vector<vfit_measurement>& measurements) {
    const auto sizes = list<vfit_size>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_size_recommend(chart, garment_kind.c_str(), measurements.data(), sizeof(vfit_measurement),
                                   static_cast<uint32_t>(measurements.size()), items, stride, n);
    });
    Json out = Json::array();
    for (const vfit_size& s : sizes) out.push_back({{"label", s.label}, {"probability", s.probability}});
    return out;
}

Json between_json(const Json& sizes) {
    const double best = sizes.at(0).at("probability");
    if (sizes.size() < 2 || best >= kSure) return Json();
    const double second = sizes.at(1).at("probability");
    return best + second >= kSure ? Json{sizes.at(0).at("label"), sizes.at(1).at("label")} : Json();
}

std::string size_text(const Json& sizes) {
    const std::string label = sizes.at(0).at("label");
    const double best = sizes.at(0).at("probability");
    const std::string percent = " (" + std::to_string(std::lround(100.0 * best)) + " %)";
    if (best >= kSure) return label + percent;
    const Json between = between_json(sizes);
    if (between.empty()) return "no clear size, " + label + " is likeliest" + percent;
    return "between " + between.at(0).get<std::string>() + " and " + between.at(1).get<std::string>();
}

Json zones_json(vfit_size_chart chart, const std::string& garment_kind, const std::string& label,
                const std::vector<vfit_measurement>& measurements) {
    const auto zones = list<vfit_size_zone>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_size_zones(chart, garment_kind.c_str(), label.c_str(), measurements.data(),
                               sizeof(vfit_measurement), static_cast<uint32_t>(measurements.size()), items,
                               stride, n);
    });
    Json out = Json::object();
    for (const vfit_size_zone& z : zones)
        out[z.key] = {{"ease", z.ease},
                      {"sigma", z.sigma},
                      {"tight", z.tight},
                      {"regular", z.regular},
                      {"loose", z.loose}};
    return out;
}

const char* scan_method_text(vfit_scan_method method) {
    return method == VFIT_SCAN_PROPORTIONS              ? "paper"
           : method == VFIT_SCAN_PROPORTIONS_AS_PRINTED ? "paper-as-printed"
                                                        : "fit";
}

vfit_scan_method scan_method_from(const std::string& option) {
    if (option.empty()) return VFIT_SCAN_DEFAULT;
    if (option == "fit") return VFIT_SCAN_FIT;
    return option == "paper-as-printed" ? VFIT_SCAN_PROPORTIONS_AS_PRINTED : VFIT_SCAN_PROPORTIONS;
}

const char* sex_text(vfit_sex sex) {
    return sex == VFIT_SEX_FEMALE ? "f" : sex == VFIT_SEX_MALE ? "m" : "unknown";
}

vfit_sex sex_from(const std::string& option) {
    return option == "f" ? VFIT_SEX_FEMALE : option == "m" ? VFIT_SEX_MALE : VFIT_SEX_UNKNOWN;
}

}  // namespace vfit::tools
