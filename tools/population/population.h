// Virtual people for judging and training the measuring: bodies whose measures are drawn from a survey of
// real ones.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "population/anthropometry.h"
#include "population/body_with_measures.h"

namespace vfit::tools {

enum class BodySpace {
    kInside,   // shapes of the phenotypes and measure-* sliders alone, which the body fit's own bodies are
               // made of
    kOutside,  // besides, depths that differ from what girths say as real people's do, and local changes of
               // the surface
};

struct PersonOfPopulation {
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    double bmi = 0.0;
    std::map<std::string, float> shape;  // shape keys and their values
    BodyMeasures measures;
    /// As options of the virtual person: "sex=f&height=0.61&...".
    std::string options() const;
};

/// People by number, each the same whoever else is drawn. BMI 18 to 35, stature 1.50 to 2.00 m.
class Population {
public:
    Population(std::shared_ptr<const BodyModel> model, BodySpace space, uint32_t seed);
    PersonOfPopulation draw(uint32_t number);

private:
    std::vector<float> random_shape(vfit_sex sex, Random& random) const;
    void change_locally(Random& random, std::vector<float>& shape) const;

    std::shared_ptr<const BodyModel> model_;
    BodySpace space_;
    uint32_t seed_;
    Anthropometry survey_;
    std::array<std::optional<BodyWithMeasures>, 2> usual_,
        deep_;  // women, men, made when needed; deep_: with depths besides
};

}  // namespace vfit::tools
