// Position filters beside each other on the same streams: made noise at rest and on a swinging hand, and the
// still spans of real people.
#include <cmath>
#include <iomanip>
#include <iostream>

#include "bench/motion_noise.h"
#include "bench/motion_parts.h"
#include "motion/position_filter.h"

namespace vfit::tools {

namespace {

constexpr double kRateHz = 30.0;
constexpr float kSwingM = 0.15f, kSwingHz = 0.5f;  // 30 cm from end to end
constexpr int kSeconds = 60, kWarmUp = 30, kSeeds = 20;

struct NamedFilter {
    const char* name;
    bool raw;
    PositionFilterSettings settings;
};

PositionFilterSettings holt(float smoothing, float correction, float prediction, float jitter_m,
                            float deviation_m) {
    PositionFilterSettings s;
    s.kind = VFIT_POSITION_HOLT;
    s.holt = {smoothing, correction, prediction, jitter_m, deviation_m};
    return s;
}

PositionFilterSettings one_euro(float min_cutoff_hz, float beta) {
    PositionFilterSettings s;
    s.kind = VFIT_POSITION_ONE_EURO;
    s.one_euro.min_cutoff_hz = min_cutoff_hz;
    s.one_euro.beta = beta;
    return s;
}

std::vector<NamedFilter> filters() {
    return {{"raw", true, {}},
            {"vfit, the default", false, {}},
            {"Holt, the paper's (and MSDN's example)", false, holt(0.5f, 0.5f, 0.5f, 0.05f, 0.04f)},
            {"Holt, Microsoft's filter class", false, holt(0.25f, 0.25f, 0.25f, 0.03f, 0.05f)},
            {"Holt, Microsoft's smoother", false, holt(0.5f, 0.1f, 0.5f, 0.1f, 0.1f)},
            {"Holt, Microsoft's very smooth", false, holt(0.7f, 0.3f, 1.0f, 1.0f, 1.0f)},
            {"One Euro, 1 Hz, beta 1", false, one_euro(1.0f, 1.0f)},
            {"One Euro, 0.3 Hz, beta 3", false, one_euro(0.3f, 3.0f)}};
}

std::vector<Vec3> run(const NamedFilter& filter, const std::vector<Vec3>& readings) {
    if (filter.raw) return readings;
    PositionFilter f;
    std::vector<Vec3> out;
    for (const Vec3& reading : readings)
        out.push_back(f.update(filter.settings, reading, false, 1.0f, float(1.0 / kRateHz)));
    return out;
}

struct Swing {
    double lag_frames = 0, loss = 0;
};

/// Phase and amplitude of the fundamental, by least squares.
Swing fit_swing(const std::vector<Vec3>& shown) {
    double ss = 0, sc = 0, cc = 0, ys = 0, yc = 0;
    for (size_t i = kWarmUp; i < shown.size(); ++i) {
        const double a = 2 * 3.14159265358979 * kSwingHz * double(i) / kRateHz, s = std::sin(a),
                     c = std::cos(a);
        ss += s * s, sc += s * c, cc += c * c, ys += double(shown[i].x) * s, yc += double(shown[i].x) * c;
    }
    const double det = ss * cc - sc * sc, p = (ys * cc - yc * sc) / det, q = (yc * ss - ys * sc) / det;
    return {-std::atan2(q, p) / (2 * 3.14159265358979 * kSwingHz) * kRateHz,
            1.0 - std::hypot(p, q) / kSwingM};
}

struct Row {
    double rest_mm = 0, rest_axis_mm = 0;  // RMS to the truth, of the place and along one axis
    double swing_mm = 0;
    Swing swing;
    double still_mm = 0, still_ui_mm = 0;  // of real people, RMS
};

double mean_square(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sum = 0;
    for (size_t i = kWarmUp; i < a.size(); ++i) sum += double(glm::dot(a[i] - b[i], a[i] - b[i]));
    return sum / double(a.size() - kWarmUp);
}

Row made_streams(const NamedFilter& filter) {
    Row row;
    double rest = 0, moving = 0;
    for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
        NoisySensor sensor(seed);
        std::vector<Vec3> still, still_read, swing, swing_read;
        for (int i = 0; i < kSeconds * int(kRateHz); ++i) {
            still.emplace_back(0.3f, 1.2f, -2.5f);
            swing.emplace_back(kSwingM * std::sin(2 * kPi * kSwingHz * float(double(i) / kRateHz)), 1.2f,
                               -2.5f);
            still_read.push_back(sensor(still.back()));
            swing_read.push_back(sensor(swing.back()));
        }
        rest += mean_square(run(filter, still_read), still) / kSeeds;
        const auto shown = run(filter, swing_read);
        moving += mean_square(shown, swing) / kSeeds;
        const Swing s = fit_swing(shown);
        row.swing.lag_frames += s.lag_frames / kSeeds;
        row.swing.loss += s.loss / kSeeds;
    }
    row.rest_mm = 1e3 * std::sqrt(rest);
    row.rest_axis_mm = 1e3 * std::sqrt(rest / 3);
    row.swing_mm = 1e3 * std::sqrt(moving);
    return row;
}

// A joint is still where its mean over a quarter of a second stays within a centimetre for a second.
constexpr int kMeanHalf = 4, kStillHalf = 15;
constexpr float kStillM = 0.01f;

Vec3 mean_about(const std::vector<Vec3>& v, size_t i) {
    Vec3 sum(0.0f);
    for (size_t k = i - kMeanHalf; k <= i + kMeanHalf; ++k) sum += v[k];
    return sum / float(2 * kMeanHalf + 1);
}

/// Sum of squares of what trembles about the mean over a quarter of a second, and how many there are.
struct Jitter {
    double sum = 0;
    size_t count = 0;
    double rms_mm() const { return count ? 1e3 * std::sqrt(sum / double(count)) : NAN; }
};

void add_still(const JointStream& stream, const NamedFilter& filter, Jitter& jitter) {
    for (int j = 0; j < kJointCount; ++j) {
        std::vector<Vec3> raw, shown;
        PositionFilter f;
        int64_t before_ns = 0;
        for (const Body& body : stream.bodies) {
            const Joint& joint = body.joints[size_t(j)];
            if (joint.state != VFIT_JOINT_MEASURED) {  // spans of readings without a gap
                break;
            }
            const float dt_s = float(double(body.time_ns - before_ns) * 1e-9);
            before_ns = body.time_ns;
            raw.push_back(joint.position);
            shown.push_back(filter.raw ? joint.position
                                       : f.update(filter.settings, joint.position, false, 1.0f, dt_s));
        }
        if (raw.size() < size_t(kWarmUp + 2 * (kStillHalf + kMeanHalf))) continue;
        for (size_t i = kWarmUp; i + kStillHalf + kMeanHalf < raw.size(); ++i) {
            const Vec3 middle = mean_about(raw, i);
            bool still = true;
            for (size_t k = i - kStillHalf; still && k <= i + kStillHalf; ++k)
                still = glm::length(mean_about(raw, k) - middle) < kStillM;
            if (!still) continue;
            const Vec3 d = shown[i] - mean_about(shown, i);
            jitter.sum += double(glm::dot(d, d));
            ++jitter.count;
        }
    }
}

Jitter still_jitter(const std::vector<JointStream>& streams, const NamedFilter& filter) {
    Jitter jitter;
    for (const JointStream& stream : streams) add_still(stream, filter, jitter);
    return jitter;
}

}  // namespace

Json judge_filters(const MotionJudge& judge) {
    if (!judge.quiet)
        std::cout << "\nPosition filters. SYNTHETIC: white noise of sd 1 cm an axis, 1 % of readings 8 cm "
                     "off, 30 Hz, "
                  << kSeeds << " seeds of " << kSeconds
                  << " s;\nswing: 30 cm from end to end at 0.5 Hz. REAL: RMS about the running mean "
                  << "of a quarter of a second, joints that rest.\n"
                  << "  filter                                    at rest, mm  an axis   swing, mm  lag, "
                     "frames  loss, %   "
                  << "Kinect v2, mm  UI-PRMD, mm\n";
    Json rows = Json::array();
    Row raw, own;
    for (const NamedFilter& filter : filters()) {
        Row row = made_streams(filter);
        row.still_mm = still_jitter(judge.real.kinect2, filter).rms_mm();
        row.still_ui_mm = still_jitter(judge.real.ui_prmd, filter).rms_mm();
        if (filter.raw) raw = row;
        if (!filter.raw && filter.settings.kind == VFIT_POSITION_ADAPTIVE) own = row;
        rows.push_back({{"filter", filter.name},
                        {"rest_m", 1e-3 * row.rest_mm},
                        {"rest_axis_m", 1e-3 * row.rest_axis_mm},
                        {"swing_m", 1e-3 * row.swing_mm},
                        {"lag_frames", row.swing.lag_frames},
                        {"amplitude_loss", row.swing.loss},
                        {"kinect2_still_m", 1e-3 * row.still_mm},
                        {"ui_prmd_still_m", 1e-3 * row.still_ui_mm}});
        if (!judge.quiet)
            std::cout << "  " << std::left << std::setw(42) << filter.name << std::right << std::fixed
                      << std::setprecision(2) << std::setw(11) << row.rest_mm << std::setw(9)
                      << row.rest_axis_mm << std::setw(12) << row.swing_mm << std::setw(13)
                      << row.swing.lag_frames << std::setw(9) << 100 * row.swing.loss << std::setw(15)
                      << row.still_mm << std::setw(13) << row.still_ui_mm << "\n";
    }
    Targets& t = judge.targets;
    t.judge("SYNTHETIC, at rest, RMS to the truth", own.rest_mm, Aim::at_most, 2.0, 2, " mm");
    t.judge("SYNTHETIC, swing, lag", own.swing.lag_frames, Aim::at_most, 1.0, 2, " frames");
    t.judge("SYNTHETIC, swing, amplitude loss", 100 * std::abs(own.swing.loss), Aim::at_most, 5.0, 2, " %");
    if (!judge.real.kinect2.empty())
        t.judge("REAL, Kinect v2, still spans: raw over filtered", raw.still_mm / own.still_mm, Aim::at_least,
                5.0, 2);
    if (!judge.real.ui_prmd.empty())
        t.judge("REAL, UI-PRMD, still spans: raw over filtered", raw.still_ui_mm / own.still_ui_mm,
                Aim::at_least, 5.0, 2);
    return rows;
}

}  // namespace vfit::tools
