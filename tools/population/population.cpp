#include "population/population.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <locale>
#include <span>
#include <sstream>

#include "core/error.h"

namespace vfit::tools {

namespace {

/// Of the people of a population.
struct Bounds {
    double min_bmi, max_bmi, min_stature_mm, max_stature_mm;
    float max_age;  // of the slider; 0.88: 80 years

    bool hold(const SurveyMeasures& person) const {
        return person.bmi() >= min_bmi && person.bmi() <= max_bmi && person["stature"] >= min_stature_mm &&
               person["stature"] <= max_stature_mm;
    }
};
constexpr Bounds kNarrow = {18.0, 35.0, 1500.0, 2000.0, 0.75f}, kWide = {16.0, 45.0, 1450.0, 2050.0, 0.88f};
constexpr float kYoungest = 0.45f;
// Wider than in any nation, so that there are enough people of each class of BMI. Spread: of the logarithm.
constexpr double kMiddleBmi = 27.0, kBmiSpread = 0.24;

const Bounds& bounds(BodySpace space) { return space == BodySpace::kVaried ? kWide : kNarrow; }

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
    {"thigh_girth_m", "thighcircumference", 1.0, 0.015},  // pursued closer, heavy thighs become balloons
    {"upper_arm_girth_m", "bicepscircumferenceflexed", 0.93, 0.015},
    {"arm_length_m", "sleeveoutseam", 1.0, 0.003},
};
/// A breadth or depth of the trunk. Calipers press flesh, and the survey's chest breadth leaves out the
/// muscles behind the armpits: `more` (women, men) times the survey's value is the body's, so that girth over
/// the perimeter of the ellipse is 1.02 at the navel, 1.05 at the hip and 1.08 at the chest as on the model's
/// bodies (survey: 1.06, 1.09, 1.17 for women and 1.24 for men).
struct Reach {
    const char *measure, *survey;
    std::array<double, 2> more;
};
constexpr Reach kDepths[] = {{"chest_depth_m", "chestdepth", {}},
                             {"waist_depth_m", "waistdepth", {}},
                             {"hip_depth_m", "buttockdepth", {}}};
constexpr Reach kReaches[] = {
    {"chest_depth_m", "chestdepth", {1.01, 1.06}},       {"navel_depth_m", "waistdepth", {1.034, 1.034}},
    {"hip_depth_m", "buttockdepth", {1.04, 1.04}},       {"chest_breadth_m", "chestbreadth", {1.15, 1.19}},
    {"navel_breadth_m", "waistbreadth", {1.034, 1.034}}, {"hip_breadth_m", "hipbreadth", {1.04, 1.04}}};
constexpr double kReachTolerance_m = 0.002;
// Calipers and tapes err too (about 10 mm of a girth's scatter of 15 to 24): how much of what differs from
// the expected is the body's (women, men). Chosen by the scatter that comes out (vfit-bench population).
constexpr std::array<double, 2> kOfTheBody = {1.0, 0.8};
// What depths and breadths are expected from.
const std::vector<std::string> kOthers = {
    "stature",          "chestcircumference", "waistcircumference", "buttockcircumference",
    "bideltoidbreadth", "biacromialbreadth",  "neckcircumference",  "thighcircumference"};

constexpr const char* kLevels[] = {"hip", "belly", "waist", "chest"};
std::string section(const char* level, const char* form) {
    return std::string("section-") + level + "-" + form;
}

std::span<const Reach> reaches(BodySpace space) {
    return space == BodySpace::kVaried ? std::span<const Reach>(kReaches) : std::span<const Reach>(kDepths);
}

std::vector<FreeShape> free_shapes(BodySpace space, bool with_reaches) {
    std::vector<FreeShape> free = {{"height", 0.5, 0.3}};
    // The weight of varied people follows their BMI: what it misses at the trunk, the sections' sliders fill.
    if (space != BodySpace::kVaried) free.push_back({"weight", 0.6, 0.4});
    for (const char* key : {"measure-upperarm-length", "measure-upperarm-circ", "measure-lowerarm-length",
                            "measure-upperleg-height", "measure-lowerleg-height", "measure-thigh-circ",
                            "measure-neck-circ", "measure-underbust-circ", "measure-shoulder-dist",
                            "measure-hips-circ", "measure-waist-circ", "measure-bust-circ"})
        free.push_back({key, 0.0, 0.35});
    if (space == BodySpace::kVaried)
        for (const char* level : kLevels) {
            free.push_back({section(level, "full"), 0.0, 0.15});
            free.push_back({section(level, "front"), 0.0, 0.15});
            free.push_back({section(level, "square"), 0.0, 0.5});
        }
    if (with_reaches)
        for (const char* key : {"torso-scale-depth", "torso-scale-horiz", "hip-scale-depth",
                                "hip-scale-horiz", "stomach-pregnant", "stomach-tone", "buttocks-volume"})
            free.push_back({key, 0.0, 0.25});
    return free;
}

std::vector<std::string> wanted_keys(BodySpace space, bool with_reaches) {
    std::vector<std::string> keys;
    for (const SurveyRow& row : kRows) keys.push_back(row.measure);
    if (with_reaches)
        for (const Reach& reach : reaches(space)) keys.push_back(reach.measure);
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
constexpr float kLocalSpread = 0.25f, kSidesDiffer = 0.05f, kSectionSpread = 0.3f;
// Sliders inside the fit's space of which the survey says nothing.
constexpr const char* kUnmeasured[] = {
    "measure-calf-circ",       "measure-knee-circ",       "measure-neck-height", "measure-napetowaist-dist",
    "measure-waisttohip-dist", "measure-frontchest-dist", "measure-ankle-circ",  "measure-wrist-circ"};

}  // namespace

BodySpace body_space(const std::string& name) {
    return name == "in" ? BodySpace::kInside : name == "out" ? BodySpace::kOutside : BodySpace::kVaried;
}

std::string PersonOfPopulation::options() const {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << "sex=" << (sex == VFIT_SEX_MALE ? "m" : "f") << std::setprecision(7);
    for (const auto& [key, value] : shape) out << "&" << key << "=" << value;
    return out.str();
}

VirtualPeople::VirtualPeople(std::shared_ptr<const BodyModel> model, BodySpace space, uint32_t seed)
    : model_(std::move(model)),
      space_(space),
      seed_(seed),
      survey_(VFIT_POPULATION_DIR "/ansur2_moments.json") {}

std::vector<float> VirtualPeople::random_shape(vfit_sex sex, Random& random) const {
    std::vector<float> shape = model_->default_shape(sex);
    const auto set = [&](const char* key, float value) {
        const auto p = size_t(model_->parameter(key));
        shape[p] = std::clamp(value, model_->parameters()[p].minimum, model_->parameters()[p].maximum);
    };
    set("gender", sex == VFIT_SEX_MALE ? 1.0f - 0.15f * random.unit() : 0.15f * random.unit());
    set("age", random.between(kYoungest, bounds(space_).max_age));
    for (const char* key : {"muscle", "proportions", "cupsize", "firmness"}) {
        const auto p = size_t(model_->parameter(key));
        set(key, shape[p] + 0.15f * random.normal());
    }
    for (const char* key : kUnmeasured) set(key, 0.2f * random.normal());
    return shape;
}

void VirtualPeople::change_locally(Random& random, std::vector<float>& shape) const {
    const auto set = [&](const std::string& key, float value) {
        const auto p = size_t(model_->parameter(key));
        shape[p] = std::clamp(value, model_->parameters()[p].minimum, model_->parameters()[p].maximum);
    };
    for (const char* key : kLocal) set(key, kLocalSpread * random.normal());
    if (space_ == BodySpace::kVaried)
        for (const char* level : kLevels)
            for (const char* form : {"square-front", "square-left", "skew"})
                set(section(level, form), kSectionSpread * random.normal());
    for (const char* key : kLocalPairs) {
        const float both = kLocalSpread * random.normal();
        for (const char* side : {"l", "r"})
            set(std::string(side) + key, both + kSidesDiffer * random.normal());
    }
}

BodyWithMeasures& VirtualPeople::solver(vfit_sex sex, bool with_reaches) {
    constexpr double kNavelShare = 0.601;  // of stature (ANSUR II)
    auto& one = (with_reaches ? reaching_ : usual_)[sex == VFIT_SEX_MALE ? 1 : 0];
    if (!one)
        one.emplace(model_, sex, free_shapes(space_, with_reaches), wanted_keys(space_, with_reaches),
                    [model = model_, sex](const std::vector<float>& shape) {
                        return measures_of(model, sex, shape, kNavelShare);
                    });
    return *one;
}

SurveyMeasures VirtualPeople::draw_measures(vfit_sex sex, Random& random) const {
    const SurveyMeasures soldier = survey_.draw(sex, random);
    if (space_ != BodySpace::kVaried) return soldier;
    const double bmi = kMiddleBmi * std::exp(kBmiSpread * double(random.normal()));
    return survey_.with_mass(sex, soldier, bmi * std::pow(1e-3 * soldier["stature"], 2.0));
}

PersonOfPopulation VirtualPeople::draw(uint32_t number) {
    Random random(seed_ * 1000003u + number);
    const vfit_sex sex = number % 2 ? VFIT_SEX_MALE : VFIT_SEX_FEMALE;
    const bool is_varied = space_ == BodySpace::kVaried;
    for (int i = 0; i < kTries; ++i) {
        const SurveyMeasures real = draw_measures(sex, random);
        std::vector<float> shape = random_shape(sex, random);
        if (!bounds(space_).hold(real)) continue;
        shape[size_t(model_->parameter("weight"))] =
            std::clamp(float(0.5 + 0.05 * (real.bmi() - 22.0)), 0.3f, 1.1f);
        const double navel_share = real["waistheightomphalion"] / real["stature"];
        const auto measure = [&](const std::vector<float>& of) {
            return measures_of(model_, sex, of, navel_share);
        };
        std::vector<WantedMeasure> wanted;
        for (const SurveyRow& row : kRows)
            wanted.push_back({row.measure, row.share * real[row.survey] * 1e-3, row.tolerance_m});
        PersonOfPopulation out;
        try {
            if (!is_varied) out.measures = solver(sex, false).solve(wanted, measure, shape);
            if (space_ != BodySpace::kInside) {
                change_locally(random, shape);
                for (const Reach& reach : reaches(space_)) {
                    const double value = real[reach.survey],
                                 usual = survey_.expected(sex, reach.survey, real, kOthers);
                    const size_t man = sex == VFIT_SEX_MALE ? 1 : 0;
                    wanted.push_back(
                        {reach.measure,
                         is_varied ? 1e-3 * reach.more[man] * (usual + kOfTheBody[man] * (value - usual))
                                   : out.measures[reach.measure] * value / usual,
                         kReachTolerance_m});
                }
                out.measures = solver(sex, true).solve(wanted, measure, shape);
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
