// Virtual people for judging and training the measuring: bodies whose measures are drawn from a survey of
// real ones.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "population/anthropometry.h"
#include "population/body_measures.h"

namespace vfit::tools {

enum class BodySpace {
    kInside,   // shapes of the phenotypes and measure-* sliders alone, which the body fit's own bodies are
               // made of
    kOutside,  // besides, depths that differ from what girths say as real people's do, and local changes of
               // the surface
    kVaried,   // ages to 80; at every level of the trunk girth, breadth and depth differ from
               // each other as real people's do
};

/// "varied", "in" or "out".
BodySpace body_space(const std::string& name);

struct PersonOfPopulation {
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    double bmi = 0.0;
    std::map<std::string, float> shape;  // shape keys and their values
    BodyMeasures measures;
    /// As options of the virtual person: "sex=f&height=0.61&...".
    std::string options() const;
};

/// People by number: a number gives the same person whatever was drawn before. BMI 18 to 35, stature 1.50 to
/// 2.00 m; of kVaried BMI 16 to 45, stature 1.45 to 2.05 m.
class VirtualPeople {
public:
    VirtualPeople(std::shared_ptr<const BodyModel> model, BodySpace space, uint32_t seed);
    PersonOfPopulation draw(uint32_t number);
    const Anthropometry& survey() const { return survey_; }

private:
    SurveyMeasures draw_measures(vfit_sex sex, Random& random) const;
    BodyWithMeasures& solver(vfit_sex sex, bool with_reaches);
    std::vector<float> random_shape(vfit_sex sex, Random& random) const;
    void change_locally(Random& random, std::vector<float>& shape) const;

    std::shared_ptr<const BodyModel> model_;
    BodySpace space_;
    uint32_t seed_;
    Anthropometry survey_;
    // Women, men, made when needed; reaching_: with depths besides, of varied people with breadths.
    std::array<std::optional<BodyWithMeasures>, 2> usual_, reaching_;
};

}  // namespace vfit::tools
