#include "population/body_with_measures.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "anthropometry/tape_mesh.h"
#include "avatar/avatar_measures.h"
#include "core/error.h"
#include "geometry/section.h"

namespace vfit::tools {

namespace {

constexpr int kSteps = 24;
constexpr double kProbe = 0.25;        // of a value's spread, for its slope
constexpr double kNavelShare = 0.601;  // of stature (ANSUR II)
constexpr double kFarthestStep = 1.5;  // spreads: as far as slopes hold
constexpr double kMargin = 1e-3;       // inside a value's range, so that its text is as well
constexpr double kShortestStep = 0.3;  // spreads, after which slopes are looked at anew
constexpr double kStill = 0.01;        // spreads: then it has come to rest
constexpr double kGain = 0.98;         // of the cost: a step that gains less comes to rest too
constexpr double kGood = 8.0;          // squared tolerances a measure: good enough
// Bodies about which slopes are looked at: heavy ones gain more centimetres by the same change than slim
// ones.
constexpr float kAnchorWeights[] = {0.4f, 0.7f, 1.0f};

/// The least of |system x - right|'s quadratic form with every x between its bounds: values that would leave
/// them are held there and the others solved for again.
cv::Mat_<double> solve_within(const cv::Mat_<double>& system, const cv::Mat_<double>& right,
                              const cv::Mat_<double>& least, const cv::Mat_<double>& most) {
    const int n = right.rows;
    cv::Mat_<double> x = cv::Mat_<double>::zeros(n, 1);
    std::vector<bool> held(size_t(n), false);
    for (bool again = true; again;) {
        cv::Mat_<double> left = system.clone(), wanted = right - system * x, change;
        for (int i = 0; i < n; ++i)
            if (held[size_t(i)]) {
                left.row(i) = 0.0, left.col(i) = 0.0;
                left(i, i) = 1.0, wanted(i) = 0.0;
            }
        cv::solve(left, wanted, change, cv::DECOMP_CHOLESKY);
        again = false;
        for (int i = 0; i < n; ++i) {
            if (held[size_t(i)]) continue;
            x(i) += change(i);
            if (x(i) >= least(i) && x(i) <= most(i)) continue;
            x(i) = std::clamp(x(i), least(i), most(i));
            held[size_t(i)] = again = true;
        }
    }
    return x;
}

}  // namespace

BodyMeasures measures_of(const std::shared_ptr<const BodyModel>& model, vfit_sex sex,
                         const std::vector<float>& shape, double navel_share) {
    const vfit::Avatar avatar(model, {sex}, shape, Vec2(1.0f));
    BodyMeasures out;
    for (const Measurement& m : measure_avatar(avatar, sex)) out[m.key] = double(m.value);
    Body joints;
    const Mesh mesh = avatar.measuring_mesh({}, &joints);
    const TapeMesh tape(
        {mesh.positions, mesh.indices, avatar.parts().first(mesh.positions.size()), joints, sex});
    const std::vector<Vec2> navel = tape.trunk(float(navel_share * out["stature_m"])).points();
    out["navel_girth_m"] = double(hull_perimeter(navel));
    out["navel_breadth_m"] = double(extent(navel).breadth());
    out["navel_depth_m"] = double(extent(navel).depth());
    return out;
}

void write_mesh(const std::string& path, const std::shared_ptr<const BodyModel>& model, vfit_sex sex,
                const std::vector<float>& shape) {
    const vfit::Avatar avatar(model, {sex}, shape, Vec2(1.0f));
    Body body;
    const Mesh mesh = avatar.measuring_mesh({}, &body);
    std::ofstream out(path);
    for (const int joint : {VFIT_JOINT_NECK, VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP}) {
        const Vec3& p = body.at(joint);
        out << "# joint " << joint_name(joint) << " " << p.x << " " << p.y << " " << p.z << "\n";
    }
    for (const Vec3& p : mesh.positions) out << "v " << p.x << " " << p.y << " " << p.z << "\n";
    for (const bool arms : {false, true}) {
        out << (arms ? "g arms\n" : "g body\n");
        for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
            const uint32_t* f = &mesh.indices[i];
            if (is_arm(avatar.parts()[f[0]]) == arms)
                out << "f " << f[0] + 1 << " " << f[1] + 1 << " " << f[2] + 1 << "\n";
        }
    }
    if (!out.flush()) fail(VFIT_ERROR_IO, path, ": cannot be written");
}

BodyWithMeasures::BodyWithMeasures(std::shared_ptr<const BodyModel> model, vfit_sex sex,
                                   std::vector<FreeShape> free, std::vector<std::string> keys)
    : model_(std::move(model)), sex_(sex), free_(std::move(free)), keys_(std::move(keys)) {
    std::vector<float> shape = model_->default_shape(sex);
    for (const float weight : kAnchorWeights) {
        shape[size_t(model_->parameter("weight"))] = weight;
        slopes_.push_back(slopes_about(shape, measures_of(model_, sex, shape, kNavelShare), kNavelShare));
    }
}

cv::Mat_<double> BodyWithMeasures::slopes_about(const std::vector<float>& shape, const BodyMeasures& here,
                                                double navel_share) const {
    cv::Mat_<double> slopes(int(keys_.size()), int(free_.size()));
    for (size_t f = 0; f < free_.size(); ++f) {
        std::vector<float> moved = shape;
        const auto p = size_t(model_->parameter(free_[f].key));
        const ShapeParameter& range = model_->parameters()[p];
        const float step = float(kProbe * free_[f].spread);
        moved[p] += moved[p] + step <= range.maximum ? step : -step;
        const BodyMeasures there = measures_of(model_, sex_, moved, navel_share);
        for (size_t k = 0; k < keys_.size(); ++k)
            slopes(int(k), int(f)) = (there.at(keys_[k]) - here.at(keys_[k])) / double(moved[p] - shape[p]);
    }
    return slopes;
}

/// Squares of what is missed over its tolerance and of free values over their spread.
double BodyWithMeasures::cost(const std::vector<WantedMeasure>& wanted, const BodyMeasures& measures,
                              const std::vector<float>& shape) const {
    double sum = 0.0;
    for (const WantedMeasure& w : wanted)
        sum += std::pow((w.value_m - measures.at(w.key)) / w.tolerance_m, 2);
    for (const FreeShape& f : free_)
        sum += std::pow((double(shape[size_t(model_->parameter(f.key))]) - f.usual) / f.spread, 2);
    return sum;
}

BodyMeasures BodyWithMeasures::solve(const std::vector<WantedMeasure>& wanted, double navel_share,
                                     std::vector<float>& shape) const {
    const int measures = int(wanted.size()), values = int(free_.size());
    BodyMeasures here = measures_of(model_, sex_, shape, navel_share);
    double cost_here = cost(wanted, here, shape);
    const float weight = shape[size_t(model_->parameter("weight"))];
    const auto nearest =
        std::min_element(std::begin(kAnchorWeights), std::end(kAnchorWeights),
                         [&](float a, float b) { return std::abs(a - weight) < std::abs(b - weight); });
    cv::Mat_<double> slopes = slopes_[size_t(nearest - std::begin(kAnchorWeights))].clone();
    double farthest = kFarthestStep;
    bool anew = false;  // slopes have been looked at anew
    for (int step = 0; step < kSteps; ++step) {
        cv::Mat_<double> system = cv::Mat_<double>::zeros(values, values),
                         right = cv::Mat_<double>::zeros(values, 1), least(values, 1), most(values, 1);
        for (int w = 0; w < measures; ++w) {
            const WantedMeasure& one = wanted[size_t(w)];
            const double firmness = 1.0 / (one.tolerance_m * one.tolerance_m);
            const cv::Mat_<double> row = slopes.row(w);
            system += firmness * row.t() * row;
            right += firmness * (one.value_m - here.at(one.key)) * row.t();
        }
        for (int f = 0; f < values; ++f) {
            const FreeShape& one = free_[size_t(f)];
            const auto p = size_t(model_->parameter(one.key));
            const ShapeParameter& range = model_->parameters()[p];
            const double firmness = 1.0 / (one.spread * one.spread), now = double(shape[p]);
            system(f, f) += firmness;
            right(f) += firmness * (one.usual - now);
            least(f) = std::max(double(range.minimum) + kMargin - now, -farthest * one.spread);
            most(f) = std::min(double(range.maximum) - kMargin - now, farthest * one.spread);
        }
        const cv::Mat_<double> change = solve_within(system, right, least, most);
        std::vector<float> moved = shape;
        double longest = 0.0;
        for (int f = 0; f < values; ++f) {
            moved[size_t(model_->parameter(free_[size_t(f)].key))] += float(change(f));
            longest = std::max(longest, std::abs(change(f)) / free_[size_t(f)].spread);
        }
        const BodyMeasures there = measures_of(model_, sex_, moved, navel_share);
        const double cost_there = cost(wanted, there, moved);
        // Broyden's update: the slopes now explain this step.
        const double squared = change.dot(change);
        for (int w = 0; squared > 1e-12 && w < measures; ++w) {
            const std::string& key = wanted[size_t(w)].key;
            const double missed = there.at(key) - here.at(key) - slopes.row(w).dot(change.t());
            slopes.row(w) += missed / squared * change.t();
        }
        const bool better = cost_there < cost_here;
        const bool resting = longest < kStill || (better && cost_there > kGain * cost_here);
        if (better) here = there, shape = moved, cost_here = cost_there;
        if (better && !resting) continue;
        if (!better && farthest > kShortestStep) {
            farthest *= 0.5;
            continue;
        }
        // Slopes about another body lead no farther: those about this one may be worth their time, once.
        if (anew || cost_here < kGood * measures) break;
        slopes = slopes_about(shape, here, navel_share);
        farthest = kFarthestStep, anew = true;
    }
    return here;
}

}  // namespace vfit::tools
