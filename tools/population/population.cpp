#include "population/population.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

#include "core/error.h"

namespace vfit::tools {

namespace {

constexpr double kLeastBmi = 18.0, kMostBmi = 35.0, kLeastStature_mm = 1500.0, kMostStature_mm = 2000.0;
constexpr int kTries = 40;
// A body one of whose sizes came out farther off than this from what was drawn: the space does not hold that
// person.
constexpr double kFarthest_m = 0.03;
constexpr const char* kToBeMet[] = {"stature_m", "inside_leg_m", "chest_girth_m", "navel_girth_m",
                                    "hip_girth_m"};

struct SurveyRow {
    const char *measure, *survey;
    double share, tolerance_m;  // of the survey's value
};
// The survey's upper arm is flexed: hanging it is about a fourteenth thinner, give or take a centimetre.
constexpr SurveyRow kRows[] = {
    {"stature_m", "stature", 1.0, 0.001},
    {"inside_leg_m", "crotchheight", 1.0, 0.003},
    {"biacromial_breadth_m", "biacromialbreadth", 1.0, 0.003},
    {"shoulder_breadth_m", "bideltoidbreadth", 1.0, 0.010},
    {"chest_girth_m", "chestcircumference", 1.0, 0.003},
    {"navel_girth_m", "waistcircumference", 1.0, 0.003},
    {"hip_girth_m", "buttockcircumference", 1.0, 0.003},
    {"neck_girth_m", "neckcircumference", 1.0, 0.008},
    {"thigh_girth_m", "thighcircumference", 1.0, 0.004},
    {"upper_arm_girth_m", "bicepscircumferenceflexed", 0.93, 0.015},
    {"arm_length_m", "sleeveoutseam", 1.0, 0.003},
};
struct DepthRow {
    const char *measure, *survey;
};
constexpr DepthRow kDepths[] = {
    {"chest_depth_m", "chestdepth"}, {"waist_depth_m", "waistdepth"}, {"hip_depth_m", "buttockdepth"}};
constexpr double kDepthTolerance_m = 0.002;
// What depths are expected from.
const std::vector<std::string> kOthers = {
    "stature",          "chestcircumference", "waistcircumference", "buttockcircumference",
    "bideltoidbreadth", "biacromialbreadth",  "neckcircumference",  "thighcircumference"};

std::vector<FreeShape> free_shapes(bool with_depths) {
    std::vector<FreeShape> free = {{"height", 0.5, 0.3}, {"weight", 0.6, 0.4}};
    for (const char* key : {"measure-upperarm-length", "measure-upperarm-circ", "measure-lowerarm-length",
                            "measure-upperleg-height", "measure-lowerleg-height", "measure-thigh-circ",
                            "measure-neck-circ", "measure-underbust-circ", "measure-shoulder-dist",
                            "measure-hips-circ", "measure-waist-circ", "measure-bust-circ"})
        free.push_back({key, 0.0, 0.35});
    if (with_depths)
        for (const char* key : {"torso-scale-depth", "torso-scale-horiz", "hip-scale-depth",
                                "hip-scale-horiz", "stomach-pregnant", "stomach-tone", "buttocks-volume"})
            free.push_back({key, 0.0, 0.25});
    return free;
}

std::vector<std::string> wanted_keys(bool with_depths) {
    std::vector<std::string> keys;
    for (const SurveyRow& row : kRows) keys.push_back(row.measure);
    if (with_depths)
        for (const DepthRow& row : kDepths) keys.push_back(row.measure);
    return keys;
}

// Changes of the surface that the fit's bodies do not make. Limbs come in pairs.
constexpr const char* kLocal[] = {"torso-vshape",
                                  "torso-muscle-pectoral",
                                  "torso-muscle-dorsi",
                                  "torso-trans-backward-forward",
                                  "stomach-navel-in-out",
                                  "pelvis-tone",
                                  "breast-point",
                                  "breast-dist",
                                  "breast-trans-down-up",
                                  "hip-trans-in-out",
                                  "hip-waist-down-up",
                                  "hip-trans-backward-forward",
                                  "neck-scale-depth",
                                  "neck-back-scale-depth",
                                  "neck-trans-backward-forward"};
constexpr const char* kLocalPairs[] = {
    "-upperarm-shoulder-muscle", "-upperarm-muscle",      "-upperarm-fat",    "-upperleg-fat",
    "-upperleg-muscle",          "-upperleg-scale-depth", "-lowerleg-muscle", "-leg-valgus"};
constexpr float kLocalSpread = 0.25f, kSidesDiffer = 0.05f;
// Sliders inside the fit's space of which the survey says nothing.
constexpr const char* kUnmeasured[] = {
    "measure-calf-circ",       "measure-knee-circ",       "measure-neck-height", "measure-napetowaist-dist",
    "measure-waisttohip-dist", "measure-frontchest-dist", "measure-ankle-circ",  "measure-wrist-circ"};

}  // namespace

std::string PersonOfPopulation::options() const {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << "sex=" << (sex == VFIT_SEX_MALE ? "m" : "f") << std::setprecision(7);
    for (const auto& [key, value] : shape) out << "&" << key << "=" << value;
    return out.str();
}

Population::Population(std::shared_ptr<const BodyModel> model, BodySpace space, uint32_t seed)
    : model_(std::move(model)),
      space_(space),
      seed_(seed),
      survey_(VFIT_POPULATION_DIR "/ansur2_moments.json") {}

std::vector<float> Population::random_shape(vfit_sex sex, Random& random) const {
    std::vector<float> shape = model_->default_shape(sex);
    const auto set = [&](const char* key, float value) {
        const auto p = size_t(model_->parameter(key));
        shape[p] = std::clamp(value, model_->parameters()[p].minimum, model_->parameters()[p].maximum);
    };
    set("gender", sex == VFIT_SEX_MALE ? 1.0f - 0.15f * random.unit() : 0.15f * random.unit());
    set("age", random.between(0.45f, 0.75f));
    for (const char* key : {"muscle", "proportions", "cupsize", "firmness"}) {
        const auto p = size_t(model_->parameter(key));
        set(key, shape[p] + 0.15f * random.normal());
    }
    for (const char* key : kUnmeasured) set(key, 0.2f * random.normal());
    return shape;
}

void Population::change_locally(Random& random, std::vector<float>& shape) const {
    const auto set = [&](const std::string& key, float value) {
        const auto p = size_t(model_->parameter(key));
        shape[p] = std::clamp(value, model_->parameters()[p].minimum, model_->parameters()[p].maximum);
    };
    for (const char* key : kLocal) set(key, kLocalSpread * random.normal());
    for (const char* key : kLocalPairs) {
        const float both = kLocalSpread * random.normal();
        for (const char* side : {"l", "r"})
            set(std::string(side) + key, both + kSidesDiffer * random.normal());
    }
}

PersonOfPopulation Population::draw(uint32_t number) {
    Random random(seed_ * 1000003u + number);
    const vfit_sex sex = number % 2 ? VFIT_SEX_MALE : VFIT_SEX_FEMALE;
    const auto solver = [&](bool with_depths) -> const BodyWithMeasures& {
        auto& one = (with_depths ? deep_ : usual_)[sex == VFIT_SEX_MALE ? 1 : 0];
        if (!one) one.emplace(model_, sex, free_shapes(with_depths), wanted_keys(with_depths));
        return *one;
    };
    for (int i = 0; i < kTries; ++i) {
        const SurveyMeasures real = survey_.draw(sex, random);
        std::vector<float> shape = random_shape(sex, random);
        if (real.bmi() < kLeastBmi || real.bmi() > kMostBmi || real["stature"] < kLeastStature_mm ||
            real["stature"] > kMostStature_mm)
            continue;
        shape[size_t(model_->parameter("weight"))] =
            std::clamp(float(0.5 + 0.05 * (real.bmi() - 22.0)), 0.3f, 1.1f);
        const double navel_share = real["waistheightomphalion"] / real["stature"];
        std::vector<WantedMeasure> wanted;
        for (const SurveyRow& row : kRows)
            wanted.push_back({row.measure, row.share * real[row.survey] * 1e-3, row.tolerance_m});
        PersonOfPopulation out;
        try {
            out.measures = solver(false).solve(wanted, navel_share, shape);
            if (space_ == BodySpace::kOutside) {
                change_locally(random, shape);
                for (const DepthRow& row : kDepths) {
                    const double deeper = real[row.survey] / survey_.expected(sex, row.survey, real, kOthers);
                    wanted.push_back({row.measure, out.measures[row.measure] * deeper, kDepthTolerance_m});
                }
                out.measures = solver(true).solve(wanted, navel_share, shape);
            }
        } catch (const Error&) {
            continue;  // legs that never part and the like
        }
        const bool met = std::all_of(wanted.begin(), wanted.end(), [&](const WantedMeasure& w) {
            const bool counts =
                std::find(std::begin(kToBeMet), std::end(kToBeMet), w.key) != std::end(kToBeMet);
            return !counts || std::abs(out.measures[w.key] - w.value_m) <= kFarthest_m;
        });
        if (!met) continue;
        out.sex = sex;
        out.bmi = real.bmi();
        out.measures["body_mass_kg"] = real.bmi() * std::pow(1e-3 * real["stature"], 2.0);
        const std::vector<float> usual = model_->default_shape(sex);
        for (size_t p = 0; p < shape.size(); ++p)
            if (shape[p] != usual[p]) out.shape[model_->parameters()[p].key] = shape[p];
        return out;
    }
    throw Failure("no body of the model has the measures of person " + std::to_string(number));
}

}  // namespace vfit::tools
