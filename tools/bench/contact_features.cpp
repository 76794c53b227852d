// vfit-bench contact-features: what the network of foot contacts learns from. Virtual people of many kinds
// who stand, step, turn and jump at many paces; each as the tracker sees them, as that without toes, as the
// truth with noise of another source laid over it, and as that with jumps.
#include <cmath>
#include <fstream>
#include <iostream>
#include <random>

#include "bench/bench.h"
#include "bench/motion_people.h"
#include "client/progress.h"
#include "motion/contact_features.h"

namespace vfit::tools {

namespace {

struct Options {
    std::string out;
    uint32_t seed = 1, count = 20, frames = 240;
};

constexpr const char* kMotions[] = {"walk",  "walk",  "walk", "step",  "step",    "turn",   "turn",
                                    "jump",  "jump",  "jog",  "spin",  "balance", "demo",   "sway",
                                    "squat", "reach", "wave", "visit", "stride",  "stride", "stride"};
constexpr const char* kSensors[] = {"kinect_v1", "kinect_v1_320", "azure", "tof"};
constexpr size_t kWarmUp = 20;

/// Everyday noise of a source: white, a slow wander of each joint, and single readings far off.
class Noise {
public:
    explicit Noise(uint32_t seed) : engine_(seed) {
        std::uniform_real_distribution<float> u(0.0f, 1.0f);
        white_m_ = 0.0001f * std::exp(4.8f * u(engine_));  // 0.1 to 12 mm
        wander_m_ = 0.018f * u(engine_);
        keep_ = std::exp(-1.0f / (30.0f * (0.1f + u(engine_))));
        outliers_ = 0.02f * u(engine_);
        outlier_m_ = 0.02f + 0.06f * u(engine_);
        for (Vec3& w : wander_) w = wander_m_ * gauss();
    }
    void add_to(Body& body) {
        for (size_t j = 0; j < body.joints.size(); ++j) {
            wander_[j] = keep_ * wander_[j] + std::sqrt(1.0f - keep_ * keep_) * wander_m_ * gauss();
            const bool outlier = std::uniform_real_distribution<float>()(engine_) < outliers_;
            body.joints[j].position += wander_[j] + (outlier ? outlier_m_ : white_m_) * gauss();
        }
    }

private:
    Vec3 gauss() {
        const float x = normal_(engine_), y = normal_(engine_), z = normal_(engine_);
        return {x, y, z};
    }
    std::mt19937 engine_;
    std::normal_distribution<float> normal_{0.0f, 1.0f};
    float white_m_, wander_m_, keep_, outliers_, outlier_m_;
    std::array<Vec3, kJointCount> wander_{};
};

std::string uri_of(uint32_t seed, uint32_t frames) {
    std::mt19937 engine(seed);
    const auto uniform = [&](double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(engine);
    };
    const auto pick = [&](const auto& list) { return std::string(list[engine() % std::size(list)]); };
    // Frames count as 30 a second: at a rate of 24 the person is a quarter quicker.
    return "virtual:sensor=" + pick(kSensors) + "&motion=" + pick(kMotions) +
           "&body=" + std::to_string(100000 + seed) + "&seed=" + std::to_string(seed) +
           "&rate=" + std::to_string(uniform(23, 42)) + "&distance=" + std::to_string(uniform(2.3, 3.6)) +
           "&facing=" + std::to_string(engine() % 3 == 0 ? uniform(-180, 180) : uniform(-30, 30)) +
           "&camera_height=" + std::to_string(uniform(0.6, 1.8)) +
           "&clothing=" + std::to_string(uniform(0, 0.03)) + "&frames=" + std::to_string(frames);
}

using Planted = std::vector<std::array<bool, 2>>;

/// Whoever stands on both feet now and then flies up and comes down again, of a sudden and to any height that
/// people jump: no source shows crouch and landing the same way.
void add_jumps(uint32_t seed, std::vector<Body>& bodies, Planted& planted) {
    constexpr float kGravity = 9.81f, kFrame_s = 1.0f / 30.0f;
    std::mt19937 engine(seed);
    std::uniform_real_distribution<float> speed(0.7f, 2.9f), phase(0.0f, kFrame_s);
    for (size_t i = 30; i < bodies.size(); i += 20 + engine() % 40) {
        const float up = speed(engine), start = phase(engine), flight_s = 2.0f * up / kGravity;
        const auto frames = size_t((flight_s - start) / kFrame_s) + 1;
        bool stands = i + frames + 3 < bodies.size();
        for (size_t k = i - 3; stands && k < i + frames + 3; ++k) stands = planted[k][0] && planted[k][1];
        if (!stands) continue;
        for (size_t k = 0; k < frames; ++k) {
            const float t = start + kFrame_s * float(k);
            if (t >= flight_s) break;
            for (Joint& joint : bodies[i + k].joints) joint.position.y += up * t - 0.5f * kGravity * t * t;
            planted[i + k] = {false, false};
        }
    }
}

void write_rows(const Planted& planted, const std::vector<Body>& bodies, uint32_t stream,
                std::ofstream& out) {
    ContactFeatures features;
    for (size_t i = 0; i < bodies.size(); ++i) {
        features.update(bodies[i]);
        std::array<float, kContactFeatureCount + 3> row{};
        for (int side = 0; side < 2 && i >= kWarmUp; ++side) {
            if (!features.of(side, std::span<float, kContactFeatureCount>(row.data(), kContactFeatureCount)))
                continue;
            row[kContactFeatureCount] = planted[i][size_t(side)] ? 1.0f : 0.0f;
            row[kContactFeatureCount + 1] = float(2 * stream + uint32_t(side));
            row[kContactFeatureCount + 2] = float(i);
            out.write(reinterpret_cast<const char*>(row.data()), sizeof row);
        }
    }
}

void contact_features(const Options& options) {
    std::ofstream out(options.out, std::ios::binary);
    if (!out) throw Failure(options.out + ": cannot be written");
    Progress progress("streams");
    uint32_t stream = 0;
    for (uint32_t i = 0; i < options.count; ++i) {
        progress.at(i, options.count);
        std::vector<PersonFrame> frames = person_on_feet(uri_of(options.seed + i, options.frames));
        for (size_t k = 0; k < frames.size(); ++k) {
            const auto ns = int64_t(std::llround(1e9 * double(k) / 30.0));
            frames[k].tracked.time_ns = frames[k].truth.time_ns = ns;
        }
        std::vector<Body> tracked, without_toes, noisy, noisier;
        Noise noise(options.seed + i), more(options.seed + i + 50000);
        Planted planted, jumping;
        for (const PersonFrame& frame : frames) {
            planted.push_back(frame.planted);
            tracked.push_back(frame.tracked);
            without_toes.push_back(frame.tracked);
            for (const int toes : {VFIT_JOINT_LEFT_TOES, VFIT_JOINT_RIGHT_TOES})
                without_toes.back().joints[size_t(toes)] = Joint();
            noisy.push_back(frame.truth);
            noise.add_to(noisy.back());
            noisier.push_back(frame.truth);
            more.add_to(noisier.back());
        }
        jumping = planted;
        add_jumps(options.seed + i, noisier, jumping);
        for (const auto* bodies : {&tracked, &without_toes, &noisy})
            write_rows(planted, *bodies, stream++, out);
        write_rows(jumping, noisier, stream++, out);
    }
    out.close();
    if (!out) throw Failure(options.out + ": cannot be written");
}

}  // namespace

void add_contact_features(Command& app) {
    Command command =
        app.add_subcommand("contact-features", "Write what the network of foot contacts learns from");
    auto o = std::make_shared<Options>();
    command.add_option("--out", o->out, "File of float rows: features, planted, stream, frame").required();
    command.add_option("--seed", o->seed, "Of the first person");
    command.add_option("--count", o->count, "People");
    command.callback([o] { contact_features(*o); });
}

}  // namespace vfit::tools
