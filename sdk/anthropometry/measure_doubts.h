// Which measure of a list is probably wrong, and what slip of the hand would explain it.
#pragma once

#include <string>
#include <vector>

#include "anthropometry/population_model.h"

namespace vfit {

struct Doubt {
    vfit_doubt_kind kind = VFIT_DOUBT_UNLIKELY;
    std::string key, other_key;  // other_key: of VFIT_DOUBT_SWAPPED
    float value = 0.0f;          // as it was given
    float suggested = 0.0f;
    float expected = 0.0f, sigma = 0.0f;  // by the others
};

/// Slips are tried one after the other, each time the one after which the list is likeliest, while it makes
/// it likelier than its own rarity takes away. The worst first. Errors as those of PopulationModel::estimate.
std::vector<Doubt> find_doubts(const PopulationModel& population, const Person& person,
                               std::vector<Measurement> known);

}  // namespace vfit
