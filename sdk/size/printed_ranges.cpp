#include "size/printed_ranges.h"

#include <cmath>

#include "anthropometry/measure_keys.h"
#include "core/error.h"

namespace vfit {

namespace {

constexpr float kLongest_m = 10.0f;  // no body measure is longer: the unit is wrong
constexpr float kHeaviest_kg = 700.0f;
constexpr double kRounding = 1e-5;  // m or kg: 94 cm is not exact in binary

/// What the ends of one measure's ranges are compared with, in the chart's unit.
struct Tolerance {
    double rounding;

    bool is_single(const PrintedRange& r) const {
        return !r.open_low && !r.open_high && r.high - r.low <= rounding;
    }
    bool ascends(double before, double after) const { return after > before + rounding; }
    bool descends(double before, double after) const { return after < before - rounding; }
};

void check_open_ends(const std::vector<PrintedRange>& printed) {
    for (const PrintedRange& r : printed) {
        if (r.open_low && &r != &printed.front())
            fail(VFIT_ERROR_DATA, "size chart: the range of ", r.place,
                 " is open at its low end, which only that of the first label may be");
        if (r.open_high && &r != &printed.back())
            fail(VFIT_ERROR_DATA, "size chart: the range of ", r.place,
                 " is open at its high end, which only that of the last label may be");
    }
}

/// An end that is open in either range says nothing. Two ranges that are open away from each other must not
/// overlap: neither has a middle that could divide the overlap.
bool follows(const PrintedRange& before, const PrintedRange& after, const Tolerance& than) {
    const bool lows = !before.open_low, highs = !after.open_high;
    if (!lows && !highs) return !than.descends(before.high, after.low);
    if ((lows && than.descends(before.low, after.low)) || (highs && than.descends(before.high, after.high)))
        return false;
    return (lows && than.ascends(before.low, after.low)) || (highs && than.ascends(before.high, after.high));
}

/// A size about that value. The neighbours' ends are the printed ones: a neighbouring value reaches the same
/// half.
void reach_halfway(const std::vector<PrintedRange>& printed, size_t i, const Tolerance& than,
                   PrintedRange& out) {
    const double value = 0.5 * (printed[i].low + printed[i].high);
    if (printed.size() == 1)
        fail(VFIT_ERROR_DATA, "size chart: the range of ", out.place,
             " is a single value without a neighbour to reach halfway to: [low, high] is needed");
    const bool first = i == 0, last = i + 1 == printed.size();
    double below = first ? 0.0 : 0.5 * (value - printed[i - 1].high);
    double above = last ? 0.0 : 0.5 * (printed[i + 1].low - value);
    if (first) below = above;
    if (last) above = below;
    out.low = std::max(0.0, value - below);
    out.high = value + above;
    if (than.is_single(out))
        fail(VFIT_ERROR_DATA, "size chart: the range of ", out.place,
             " is a single value at the end of its neighbour's range, which leaves it no room");
}

double width_of(const PrintedRange& range) { return range.high - range.low; }

}  // namespace

PrintedRange read_printed_range(const Json& json, const std::string& key, double unit,
                                const std::string& label, const std::string& place) {
    PrintedRange out{label, place};
    const auto is_end = [](const Json& end) { return end.is_number() || end.is_null(); };
    if (json.is_number()) {
        out.low = out.high = json.get<double>();
    } else if (json.is_array() && json.size() == 2 && is_end(json[0]) && is_end(json[1])) {
        out.open_low = json[0].is_null(), out.open_high = json[1].is_null();
        if (out.open_low && out.open_high)
            fail(VFIT_ERROR_DATA, "size chart: the range of ", place, " is open at both ends");
        out.low = json[out.open_low ? 1 : 0].get<double>();
        out.high = json[out.open_high ? 0 : 1].get<double>();
    } else {
        fail(VFIT_ERROR_DATA, "size chart: the range of ", place, " is neither a number nor [low, high]");
    }
    const double low = out.low * unit, high = out.high * unit,
                 most = is_mass(key) ? kHeaviest_kg : kLongest_m;
    if (!std::isfinite(low) || !std::isfinite(high) || low < 0.0 || high > most)
        fail(VFIT_ERROR_DATA, "size chart: the range of ", place, " is not within 0 and ", most,
             is_mass(key) ? " kg" : " m");
    if (low > high) fail(VFIT_ERROR_DATA, "size chart: the range of ", place, " is empty: low is above high");
    return out;
}

std::vector<MeasureRange> ranges_of(const std::vector<PrintedRange>& printed, const std::string& key,
                                    double unit) {
    const Tolerance than{kRounding / unit};
    check_open_ends(printed);
    for (size_t i = 1; i < printed.size(); ++i)
        if (!follows(printed[i - 1], printed[i], than))
            fail(VFIT_ERROR_DATA, "size chart: the range of ", printed[i].place,
                 " is not above that of label ", printed[i - 1].label,
                 ": sizes must stand in ascending order");
    std::vector<PrintedRange> whole = printed;
    for (size_t i = 0; i < whole.size(); ++i)
        if (than.is_single(printed[i])) reach_halfway(printed, i, than, whole[i]);
    if (whole.size() > 1) {
        PrintedRange &first = whole.front(), &last = whole.back();
        if (first.open_low) first.low = std::max(0.0, first.high - width_of(whole[1]));
        if (last.open_high) last.high = last.low + width_of(whole[whole.size() - 2]);
    }
    std::vector<MeasureRange> out;
    for (const PrintedRange& r : whole)
        out.push_back({key, float(r.low * unit), float(r.high * unit), r.open_low, r.open_high});
    return out;
}

}  // namespace vfit
