// vfit-bench fit: the body model fitted to people, and what that does to their joints. It runs sdk/fit
// without the C ABI, as the fit is a step inside the tracker. Figures of virtual and of real people stand
// apart.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>

#include "bench/bench.h"
#include "bench/fit_people.h"
#include "bench/frames.h"
#include "bench/track_score.h"
#include "core/platform.h"
#include "fit/body_fit.h"
#include "track/tracker.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string folder, only;
    uint32_t people = 6, frames = 90;
    bool json = false, each = false, naked = false;
    BodyFitOptions fit;
};

struct Models {
    std::shared_ptr<const BodyModel> body;
    std::shared_ptr<const FitModel> coarse;
    std::shared_ptr<const FitModel> fine;
    std::shared_ptr<JointNetwork> network;
};

Models load() {
    Models m;
    m.body = BodyModel::load(library_file("vfit_data/body.bin"));
    const Timer timer;
    m.coarse = std::make_shared<FitModel>(*m.body);
    std::cerr << "fit model made in " << timer.ms() << " ms\n";
    m.fine = std::make_shared<FitModel>(m.coarse->refined(*m.body));
    m.network =
        std::make_shared<JointNetwork>(library_file("vfit_modules/vfit_joint_network") + library_suffix(),
                                       library_file("vfit_data/networks/joints.onnx"));
    return m;
}

/// How well the full body of a fit meets one image, pixel by pixel.
struct Cover {
    double iou = 0.0, median_m = 0.0;
};

class Judge {
public:
    explicit Judge(const FitModel& fine) : body_(fine) {}

    Cover look(const FitState& state, const DepthImage& image, uint8_t user) {
        body_.place(state);
        draw_depth(body_.positions(), body_.model().triangles(), image.camera, depth_m_);
        size_t both = 0, either = 0;
        std::vector<float> differences;
        for (size_t i = 0; i < depth_m_.size(); ++i) {
            const bool seen = image.users[i] == user && image.depth[i] != 0, drawn = depth_m_[i] > 0.0f;
            // What something before the person hides belongs to nobody.
            if (!seen && drawn && image.depth[i] != 0 && image.metres(i) < depth_m_[i] - 0.05f) continue;
            both += seen && drawn;
            either += seen || drawn;
            if (seen && drawn) differences.push_back(std::abs(depth_m_[i] - image.metres(i)));
        }
        Cover out;
        out.iou = either ? double(both) / double(either) : 0.0;
        if (!differences.empty()) {
            const auto middle = differences.begin() + std::ptrdiff_t(differences.size() / 2);
            std::nth_element(differences.begin(), middle, differences.end());
            out.median_m = double(*middle);
        }
        return out;
    }

private:
    FitBody body_;
    std::vector<float> depth_m_;
};

/// Median of samples that are no times.
double median(std::vector<double> v) {
    if (v.empty()) return 0.0;
    std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
    return v[v.size() / 2];
}
double mean(const std::vector<double>& v) {
    double sum = 0.0;
    for (const double x : v) sum += x;
    return v.empty() ? 0.0 : sum / double(v.size());
}

struct Sequence {
    std::string name, person;
    std::vector<double> iou, median_m;
    std::vector<Pair> network, fitted;
    uint32_t frames = 0, poor = 0, nothing = 0, from_last = 0;
};

FitJoints seen_joints(const Body& body) {
    FitJoints out;
    for (int j = 0; j < kJointCount; ++j)
        out[size_t(j)] = {body.at(j), body.has(j) ? body.joints[size_t(j)].confidence : 0.0f};
    return out;
}

Joints joints_of_body(const Body& body) {
    Joints out;
    for (int j = 0; j < kScored; ++j)
        if (body.has(j)) out.at[size_t(j)] = {body.at(j).x, body.at(j).y, body.at(j).z};
    return out;
}

/// One frame: the network's joints, the fit, and both against the reference.
class Trial {
public:
    Trial(const Models& models, const Options& o)
        : tracker_(models.network), fit_(models.coarse, o.fit), judge_(*models.fine) {}

    void look(const DepthImage& image, int64_t time_ns, const Joints& reference, Sequence& out,
              Samples& times) {
        ++out.frames;
        find_targets(image, 1, targets_);
        tracker_.run(image, time_ns, targets_, bodies_);
        if (bodies_.empty()) {
            ++out.nothing;
            return;
        }
        const Body& body = bodies_.front();
        BodyFitInput input;
        input.image = image;
        input.user = uint8_t(body.id);
        input.box = targets_.front().box;
        input.time_ns = time_ns;
        input.joints = seen_joints(body);
        const Timer timer;
        const BodyFitOutput& fit = fit_.run(input);
        times.add(timer.ms());
        out.nothing += fit.state == BodyFitState::kNothing;
        out.poor += fit.state == BodyFitState::kPoor;
        out.from_last += fit.from_last;
        if (fit.state == BodyFitState::kNothing) return;
        const Cover cover = judge_.look(fit.pose, image, input.user);
        out.iou.push_back(cover.iou);
        out.median_m.push_back(cover.median_m);
        Pair network, fitted;
        network.reference = fitted.reference = reference;
        network.tracked = fitted.tracked = joints_of_body(body);
        if (fit.state == BodyFitState::kGood)
            for (int j = 0; j < kScored; ++j) {
                const Vec3 p = fit.joints[size_t(j)];
                fitted.tracked.at[size_t(j)] = {p.x, p.y, p.z};
            }
        out.network.push_back(network);
        out.fitted.push_back(fitted);
    }

private:
    vfit::Tracker tracker_;
    BodyFit fit_;
    Judge judge_;
    std::vector<TrackTarget> targets_;
    std::vector<Body> bodies_;
};

/// `shift`: frames that the reference lags behind the depth.
Errors errors_of(const std::vector<Sequence>& all, std::vector<Pair> Sequence::* pairs,
                 const Offsets& offsets, bool others_only, size_t shift = 0) {
    Errors errors;
    for (const Sequence& s : all) {
        if (others_only && s.person == "s1") continue;
        for (size_t i = shift; i < (s.*pairs).size(); ++i) {
            const Joints found = offsets.apply((s.*pairs)[i - shift].tracked);
            for (int j = 0; j < kScored; ++j)
                if (const double d = distance(found, (s.*pairs)[i].reference, j); std::isfinite(d))
                    errors.add(j, d);
        }
    }
    return errors;
}

Offsets offsets_of(const std::vector<Sequence>& all, std::vector<Pair> Sequence::* pairs) {
    std::vector<Pair> first;
    for (const Sequence& s : all)
        if (s.person == "s1") first.insert(first.end(), (s.*pairs).begin(), (s.*pairs).end());
    return Offsets::fit(first);
}

/// Trembling: the median second difference of joints, metres.
double tremble(const std::vector<Sequence>& all, std::vector<Pair> Sequence::* pairs) {
    std::vector<double> found;
    for (const Sequence& s : all)
        for (size_t i = 2; i < (s.*pairs).size(); ++i)
            for (size_t j = 0; j < size_t(kScored); ++j) {
                double squares = 0.0;
                for (size_t k = 0; k < 3; ++k) {
                    const double d = (s.*pairs)[i].tracked.at[j][k] -
                                     2.0 * (s.*pairs)[i - 1].tracked.at[j][k] +
                                     (s.*pairs)[i - 2].tracked.at[j][k];
                    squares += d * d;
                }
                if (std::isfinite(squares)) found.push_back(std::sqrt(squares));
            }
    return median(found);
}

void print_errors(const char* title, const Errors& e) {
    std::cout << "  " << std::left << std::setw(44) << title << std::right << " mean " << std::fixed
              << std::setprecision(1) << 1000 * e.mean() << "  median " << 1000 * e.median()
              << " mm  within 10 cm " << std::setprecision(3) << e.within(0.1) << "\n";
}

Json report(const std::string& title, const std::vector<Sequence>& all, const Samples& times, bool offsets,
            const Options& o) {
    std::vector<double> iou, median_m;
    uint32_t frames = 0, poor = 0, nothing = 0, from_last = 0;
    for (const Sequence& s : all) {
        iou.insert(iou.end(), s.iou.begin(), s.iou.end());
        median_m.insert(median_m.end(), s.median_m.begin(), s.median_m.end());
        frames += s.frames, poor += s.poor, nothing += s.nothing, from_last += s.from_last;
    }
    const Offsets none{};
    const Errors raw_network = errors_of(all, &Sequence::network, none, false),
                 raw_fit = errors_of(all, &Sequence::fitted, none, false);
    Json out = {{"input", title},
                {"frames", frames},
                {"poor", poor},
                {"nothing", nothing},
                {"from_last", from_last},
                {"depth_median_m", median(median_m)},
                {"iou_mean", mean(iou)},
                {"network", raw_network.json()},
                {"fit", raw_fit.json()},
                {"tremble_network_m", tremble(all, &Sequence::network)},
                {"tremble_fit_m", tremble(all, &Sequence::fitted)},
                {"fit_ms", times.json()}};
    Errors off_network, off_fit;
    if (offsets) {
        off_network = errors_of(all, &Sequence::network, offsets_of(all, &Sequence::network), true);
        off_fit = errors_of(all, &Sequence::fitted, offsets_of(all, &Sequence::fitted), true);
        out["network_offset"] = off_network.json();
        out["fit_offset"] = off_fit.json();
    }
    for (const Sequence& s : all)
        out["sequences"].push_back({{"name", s.name},
                                    {"frames", s.frames},
                                    {"poor", s.poor},
                                    {"nothing", s.nothing},
                                    {"depth_median_m", median(s.median_m)},
                                    {"iou_mean", mean(s.iou)},
                                    {"network", errors_of({s}, &Sequence::network, none, false).mean()},
                                    {"fit", errors_of({s}, &Sequence::fitted, none, false).mean()}});
    if (o.json) return out;
    std::cout << title << ": " << frames << " frames, " << poor << " poor, " << nothing << " without, "
              << from_last << " from the last\n"
              << std::fixed << std::setprecision(1) << "  depth difference on covered pixels: median "
              << 1000 * median(median_m) << " mm; outline IoU: mean " << std::setprecision(3) << mean(iou)
              << "\n";
    for (const Sequence& s : all)
        std::cout << "    " << std::left << std::setw(28) << s.name << std::right << std::setprecision(1)
                  << std::setw(5) << 1000 * median(s.median_m) << " mm, IoU " << std::setprecision(3)
                  << mean(s.iou) << ", joints mean " << std::setprecision(1)
                  << 1000 * errors_of({s}, &Sequence::network, none, false).mean() << " -> "
                  << 1000 * errors_of({s}, &Sequence::fitted, none, false).mean() << " mm, poor " << s.poor
                  << "\n";
    print_errors("network, as it is", raw_network);
    print_errors("network and fit, as it is", raw_fit);
    if (offsets) {
        print_errors("network, offsets fitted on s1, the others", off_network);
        print_errors("network and fit, the same", off_fit);
        for (const size_t shift : {size_t(1), size_t(2)}) {
            const std::string later = ", reference " + std::to_string(shift) + " later";
            print_errors(
                ("network" + later).c_str(),
                errors_of(all, &Sequence::network, offsets_of(all, &Sequence::network), true, shift));
            print_errors(("network and fit" + later).c_str(),
                         errors_of(all, &Sequence::fitted, offsets_of(all, &Sequence::fitted), true, shift));
        }
    }
    std::cout << "    median mm by joint, network -> fit" << (offsets ? " (offsets: network -> fit)" : "")
              << "\n";
    for (int j = 0; j < kScored; ++j) {
        std::cout << "      " << std::left << std::setw(16) << joint_name(j) << std::right << std::setw(4)
                  << std::lround(1000 * raw_network.median(j)) << " -> " << std::setw(4)
                  << std::lround(1000 * raw_fit.median(j));
        if (offsets)
            std::cout << "    (" << std::setw(4) << std::lround(1000 * off_network.median(j)) << " -> "
                      << std::setw(4) << std::lround(1000 * off_fit.median(j)) << ")";
        std::cout << "\n";
    }
    std::cout << std::setprecision(1) << "  trembling (median second difference): network "
              << 1000 * tremble(all, &Sequence::network) << " mm, fit "
              << 1000 * tremble(all, &Sequence::fitted) << " mm\n"
              << std::setprecision(2) << "  fit: median " << times.quantile(0.5) << " ms, p95 "
              << times.quantile(0.95) << " ms\n\n";
    return out;
}

Json synthetic(const Models& models, const Options& o) {
    std::vector<Sequence> all;
    Samples times;
    const char* motions[] = {"demo", "walk", "squat", "wave", "reach", "sway"};
    for (uint32_t i = 0; i < o.people; ++i) {
        const std::string motion = motions[i % std::size(motions)];
        Sequence s;
        s.name = motion + " " + std::to_string(i + 1);
        if (s.name.find(o.only) == std::string::npos) continue;
        Trial trial(models, o);
        play_person(models.body, motion, 100 + i, o.frames, !o.naked, [&](const FitShot& shot) {
            trial.look(shot.image(), shot.time_ns, joints_of_body(shot.truth), s, times);
        });
        all.push_back(std::move(s));
    }
    return all.empty() ? Json{}
                       : report("virtual people in clothes of 1 to 3 cm (synthetic)", all, times, false, o);
}

Json real(const Models& models, const Options& o) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(o.folder))
        if (entry.is_directory()) paths.push_back(entry.path());
    if (paths.empty()) throw Failure(o.folder + ": holds no recordings");
    std::sort(paths.begin(), paths.end());
    std::vector<Sequence> all;
    Samples times;
    for (const auto& path : paths) {
        Sequence s;
        s.name = path.filename().string();
        if (s.name.find(o.only) == std::string::npos) continue;
        const size_t a = s.name.find("_s"), b = s.name.find('_', a + 1);
        s.person = a == std::string::npos ? s.name : s.name.substr(a + 1, b - a - 1);
        const Context context = open_context();
        Source source(context.get(), path.string());
        Trial trial(models, o);
        while (const auto frame = source.next()) {
            if (!has_stream(frame->get(), VFIT_STREAM_USER_MAP)) throw Failure(s.name + ": has no mask");
            const FrameImage image(frame->get());
            Joints reference;
            if (const uint32_t id = first_body(frame->get()))
                reference = joints_in_camera(frame->get(), id, camera_of(frame->get()));
            trial.look(image.image(), int64_t(s.frames + 1) * 33333333, reference, s, times);
        }
        all.push_back(std::move(s));
    }
    return all.empty()
               ? Json{}
               : report("real people (recordings) against their middleware's joints", all, times, true, o);
}

void run(const Options& o) {
    pin_to_cores(1);
    const Models models = load();
    Json out = Json::array();
    if (o.people > 0) out.push_back(synthetic(models, o));
    if (!o.folder.empty()) out.push_back(real(models, o));
    if (o.json) std::cout << out.dump(2) << "\n";
}

}  // namespace

void add_fit(Command& app) {
    Command command =
        app.add_subcommand("fit", "The body model fitted to people: depth, outline, joints, time");
    auto o = std::make_shared<Options>();
    command.add_option("folder", o->folder,
                       "Folder of recordings named ..._s<person>_...: judges real people too");
    command.add_option("--people", o->people, "Virtual people; 0: none");
    command.add_option("--frames", o->frames, "Frames of each virtual person");
    command.add_option("--only", o->only, "Sequences whose name contains this");
    command.add_flag("--naked", o->naked, "Virtual people without clothes");
    command.add_option("--steps", o->fit.steps, "Gauss-Newton steps a frame");
    command.add_option("--depth-share", o->fit.weights.depth_share, "How much of a depth row counts");
    command.add_option("--reach-share", o->fit.weights.reach_share,
                       "How much of a row to a point aside counts");
    command.add_option("--outline-share", o->fit.weights.outline_share, "How much of an outline row counts");
    command.add_option("--joint-sd", o->fit.weights.joint_m,
                       "Standard deviation of the network's joints, metres");
    command.add_flag("--json", o->json, "Print JSON");
    command.callback([o] { run(*o); });
}

}  // namespace vfit::tools
