// One range of a size chart, and how far a body is from it.
#pragma once

#include <algorithm>
#include <string>

namespace vfit {

/// Of one measure, in its unit (metres, or kilograms for body_mass_kg). Both ends are finite: an open range
/// is as wide as its neighbour, or has no width where it has no neighbour, and goes on beyond its open end.
struct MeasureRange {
    std::string key;  // "chest_girth_m"
    float low = 0.0f, high = 0.0f;
    bool open_low = false, open_high = false;

    double width() const { return double(high) - double(low); }
    double middle() const { return 0.5 * (double(low) + double(high)); }

    /// Distance from the range: 0 within it.
    double missed(double value) const {
        return std::max({0.0, open_low ? 0.0 : double(low) - value, open_high ? 0.0 : value - double(high)});
    }
    /// The range's middle minus the value; an open side has no middle to be beyond of: 0.
    double ease(double value) const {
        const double out = middle() - value;
        return (open_high && out < 0.0) || (open_low && out > 0.0) ? 0.0 : out;
    }
};

}  // namespace vfit
