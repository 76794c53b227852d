#include "anthropometry/measure_doubts.h"

#include <algorithm>
#include <cmath>

#include "anthropometry/measure_keys.h"
#include "anthropometry/measurement_check.h"
#include "core/error.h"

namespace vfit {

namespace {

constexpr float kInch_m = 0.0254f, kPound_kg = 0.45359237f;
// How often a slip of that kind is made with one measure; there are about thirty ways to mistype a digit.
const double kLogUnits = std::log(1.0 / 200.0), kLogDigit = std::log(1.0 / 500.0 / 30.0),
             kLogSwapped = std::log(1.0 / 500.0);
// Of a value that nothing explains, and of what a slip leaves: in standard deviations.
constexpr double kUnlikely = 4.0;
constexpr int kMaxSlips = 5;  // of a list; with more there is little left to trust

/// Of a list that could be as it is.
double log_likelihood(const PopulationModel& population, vfit_sex sex, const Person& person,
                      const std::vector<Measurement>& known) {
    PopulationModel::Belief belief = population.prior(sex, person.age_years);
    double jacobian = 0.0;  // from the density of the logarithm to that of the value
    for (const Measurement& m : known)
        if (const auto at = population.place(sex, m.key)) {
            const double log_value = std::log(double(m.value)), error = log_error(m);
            belief.observe(*at, log_value, error * error);
            jacobian -= log_value;
        }
    return belief.log_likelihood + jacobian;
}

/// What the other measures expect of that one: mean and deviation of its logarithm as it would be measured.
struct Expected {
    double mean, sd;
};
Expected expected(const PopulationModel& population, vfit_sex sex, const Person& person,
                  const std::vector<Measurement>& known, size_t of) {
    PopulationModel::Belief belief = population.prior(sex, person.age_years);
    for (size_t i = 0; i < known.size(); ++i)
        if (const auto at = population.place(sex, known[i].key); at && i != of) {
            const double error = log_error(known[i]);
            belief.observe(*at, std::log(double(known[i].value)), error * error);
        }
    const size_t at = *population.place(sex, known[of].key);
    const double error = log_error(known[of]);
    return {belief.mean[at], std::sqrt(belief.variance(at) + error * error)};
}

/// One slip of the hand, or of the mind: what was meant in the place of what was given.
struct Slip {
    struct Change {
        size_t item;
        float meant;
    };
    vfit_doubt_kind kind;
    std::vector<Change> changes;
    double log_prior;
};

/// Numbers that were meant, if one digit of this one is wrong or two neighbours changed places. In
/// centimetres, or kilograms, to the millimetre or the hundred grams.
std::vector<float> meant_numbers(float value, bool mass) {
    const int digits = int(std::lround(value * (mass ? 10.0f : 1000.0f)));
    std::vector<float> out;
    const auto add = [&](int number) {
        if (number > 0 && number != digits) out.push_back(float(number) / (mass ? 10.0f : 1000.0f));
    };
    for (int place = 10; place <= 1000 && place <= digits; place *= 10) {
        const int digit = digits / place % 10;
        for (int other = 0; other < 10; ++other) add(digits + (other - digit) * place);
        const int next = digits / (place * 10) % 10;
        if (digits >= place * 10) add(digits + (digit - next) * 9 * place);
    }
    return out;
}

float in_inches(float value_m) { return value_m * kInch_m * 100.0f; }

bool is_girth(std::string_view key) { return key.find("_girth_") != std::string_view::npos; }

/// Of the list as it is known now; items that are doubted already are left alone.
std::vector<Slip> slips(const std::vector<Measurement>& known, const std::vector<bool>& doubted) {
    std::vector<Slip> out;
    Slip all_girths{VFIT_DOUBT_INCHES, {}, kLogUnits}, all_lengths = all_girths;
    for (size_t i = 0; i < known.size(); ++i) {
        if (doubted[i]) continue;
        const Measurement& m = known[i];
        const bool mass = is_mass(m.key);
        if (mass) {
            out.push_back({VFIT_DOUBT_POUNDS, {{i, m.value * kPound_kg}}, kLogUnits});
        } else {
            out.push_back({VFIT_DOUBT_INCHES, {{i, in_inches(m.value)}}, kLogUnits});
            all_lengths.changes.push_back({i, in_inches(m.value)});
            if (is_girth(m.key)) all_girths.changes.push_back({i, in_inches(m.value)});
        }
        for (const float meant : meant_numbers(m.value, mass))
            out.push_back({VFIT_DOUBT_DIGIT, {{i, meant}}, kLogDigit});
        for (size_t k = i + 1; k < known.size(); ++k)
            if (!doubted[k] && is_mass(known[k].key) == mass)
                out.push_back({VFIT_DOUBT_SWAPPED, {{i, known[k].value}, {k, m.value}}, kLogSwapped});
    }
    // A tape in inches gives all girths in inches.
    for (Slip* all : {&all_girths, &all_lengths})
        if (all->changes.size() > 1) out.push_back(std::move(*all));
    return out;
}

/// The list as it was meant.
std::vector<Measurement> mended(std::vector<Measurement> known, const Slip& slip) {
    for (const Slip::Change& change : slip.changes) {
        Measurement& m = known[change.item];
        m.sigma *= change.meant / m.value;
        m.value = change.meant;
    }
    return known;
}

/// The density of the given values, not of what they became in another unit.
double unit_jacobian(const std::vector<Measurement>& known, const Slip& slip) {
    double sum = 0.0;
    if (slip.kind == VFIT_DOUBT_INCHES || slip.kind == VFIT_DOUBT_POUNDS)
        for (const Slip::Change& change : slip.changes)
            sum += std::log(double(change.meant) / double(known[change.item].value));
    return sum;
}

bool plausible(const Measurement& m) {
    const PlausibleRange range = plausible_range(m.key);
    return m.value >= range.smallest && m.value <= range.largest;
}

}  // namespace

std::vector<Doubt> find_doubts(const PopulationModel& population, const Person& person,
                               std::vector<Measurement> known) {
    for (size_t i = 0; i < known.size(); ++i)
        for (size_t k = 0; k < i; ++k)
            if (known[i].key == known[k].key)
                fail(VFIT_ERROR_DATA, "population: ", known[i].key, " is known twice");
    const vfit_sex sex =
        population.probability_female(person, known) >= 0.5 ? VFIT_SEX_FEMALE : VFIT_SEX_MALE;
    std::erase_if(known, [&](const Measurement& m) { return !population.place(sex, m.key); });
    std::vector<Doubt> out;
    std::vector<bool> doubted(known.size(), false);
    // `others`: the list by which it is expected.
    const auto doubt = [&](vfit_doubt_kind kind, size_t item, float suggested,
                           const std::vector<Measurement>& others) {
        const Expected e = expected(population, sex, person, others, item);
        const double value = std::exp(e.mean);
        out.push_back(
            {kind, known[item].key, "", known[item].value, suggested, float(value), float(value * e.sd)});
        doubted[item] = true;
    };
    for (int round = 0; round < kMaxSlips; ++round) {
        double best = log_likelihood(population, sex, person, known);
        std::optional<Slip> found;
        for (const Slip& slip : slips(known, doubted)) {
            const auto list = mended(known, slip);
            if (std::any_of(slip.changes.begin(), slip.changes.end(),
                            [&](const Slip::Change& c) { return !plausible(list[c.item]); }))
                continue;
            const double likely =
                log_likelihood(population, sex, person, list) + slip.log_prior + unit_jacobian(known, slip);
            if (likely > best) best = likely, found = slip;
        }
        if (!found) break;
        const auto list = mended(known, *found);
        if (found->kind == VFIT_DOUBT_SWAPPED) {
            const auto [item, other] = std::pair(found->changes[0].item, found->changes[1].item);
            doubt(found->kind, item, list[item].value, list);
            out.back().other_key = known[other].key;
            doubted[other] = true;
        } else {
            for (const Slip::Change& change : found->changes)
                doubt(found->kind, change.item, change.meant, list);
        }
        known = list;
    }
    // What nothing explains: the worst is set aside before the next one is looked for.
    while (known.size() > 1) {
        size_t worst = 0;
        double apart = 0.0;
        for (size_t i = 0; i < known.size(); ++i) {
            const Expected e = expected(population, sex, person, known, i);
            const double z = std::abs(std::log(double(known[i].value)) - e.mean) / e.sd;
            if (z > apart) apart = z, worst = i;
        }
        if (apart < kUnlikely) break;
        if (!doubted[worst])
            doubt(VFIT_DOUBT_UNLIKELY, worst,
                  float(std::exp(expected(population, sex, person, known, worst).mean)), known);
        known.erase(known.begin() + std::ptrdiff_t(worst));
        doubted.erase(doubted.begin() + std::ptrdiff_t(worst));
    }
    return out;
}

}  // namespace vfit
