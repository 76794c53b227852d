#include "anthropometry/measurement_check.h"

#include <cmath>
#include <span>

#include "anthropometry/measure_keys.h"
#include "core/error.h"

namespace vfit {

namespace {

struct Unit {
    const char* name;
    float worth;  // in metres or kilograms
};

constexpr Unit kLengths[] = {
    {"centimetres", 0.01f}, {"millimetres", 0.001f}, {"inches", 0.0254f}, {"feet", 0.3048f}};
constexpr Unit kMasses[] = {{"grams", 0.001f}};

/// "centimetres or inches": the units in which the value is plausible. Empty: none.
std::string likely_units(float value, const PlausibleRange& range, std::span<const Unit> units) {
    std::string out;
    for (const Unit& unit : units) {
        const float worth = value * unit.worth;
        if (worth >= range.smallest && worth <= range.largest)
            out += text(out.empty() ? "" : " or ", unit.name);
    }
    return out;
}

[[noreturn]] void fail_implausible(const Measurement& m, const PlausibleRange& range, std::string_view what) {
    const bool mass = is_mass(m.key);
    const std::string units =
        likely_units(m.value, range, mass ? std::span<const Unit>(kMasses) : std::span<const Unit>(kLengths));
    const std::string bounds = text(range.smallest, " to ", range.largest, mass ? " kg" : " m");
    if (units.empty())
        fail(VFIT_ERROR_DATA, what, m.key, ": the value ", m.value, " is not plausible: a person has ",
             bounds);
    fail(VFIT_ERROR_DATA, what, m.key, ": the value ", m.value, " is not plausible: a person has ", bounds,
         "; it is probably in ", units, ", and must be in ", mass ? "kilograms" : "metres");
}

}  // namespace

PlausibleRange plausible_range(std::string_view key) {
    constexpr PlausibleRange kAnyPart = {0.001f, 4.0f};  // longer than the largest girth
    const int index = measure_index(key);
    if (index < 0) return kAnyPart;
    const MeasureKey& known = measure_keys()[size_t(index)];
    return {known.smallest, known.largest};
}

void check_measurement(const Measurement& m, std::string_view what) {
    if (!is_measure(m.key))
        fail(VFIT_ERROR_DATA, what, "\"", m.key, "\" is no measure; see vfit_measure_key");
    if (!std::isfinite(m.value))
        fail(VFIT_ERROR_DATA, what, m.key, ": the value ", m.value, " is not finite");
    if (m.value <= 0.0f) fail(VFIT_ERROR_DATA, what, m.key, ": the value ", m.value, " is not above 0");
    if (!std::isfinite(m.sigma) || m.sigma < 0.0f)
        fail(VFIT_ERROR_DATA, what, m.key, ": the sigma ", m.sigma, " is not a standard deviation");
    const PlausibleRange range = plausible_range(m.key);
    if (m.value < range.smallest || m.value > range.largest) fail_implausible(m, range, what);
}

}  // namespace vfit
