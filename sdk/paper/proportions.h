// Tables 1 and 2 of the paper and Algorithm 3: a primary dimension as the mean of its direct measure and of
// what the other lines of the body predict through their proportions (Eq. 6 and 7).
//
// The first column of the printed Table 1 is lost in the text that this follows; it is reconstructed from the
// ratios, the figure's numbers and the names of Table 2.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "vfit.h"

namespace vfit {

/// The lines of Fig. 4, in the order of Table 1.
enum class Line : uint8_t {
    kHeadWidth,       // (1)
    kHeadHeight,      // (2)
    kBodyHeight,      // (3)
    kHipHeight,       // (4)
    kElbowFingertip,  // (5)
    kWristFingertip,  // (6)
    kShoulderWidth,   // (7)
    kHipWidth,        // (8)
    kTorsoHeight,     // (9)
};
inline constexpr size_t kLineCount = 9;

/// The key under which a line is reported ("hip_height_m").
const char* line_key(Line line);

enum class RatioTable : uint8_t {
    kCanon,          // Table 1: the seven-head canon of figure drawing
    kAnthropometric  // ratios of real people: breadths by ANSUR II, lengths by Drillis and Contini 1966
};
enum class Combination : uint8_t {
    kMean,            // Eq. 7
    kInverseVariance  // Eq. 7 with each estimate weighted by 1 / sigma^2
};

/// A line's length in units of the head (Table 1), and the relative deviation of that ratio over people.
struct Ratio {
    float heads = 0.0f;  // 0: no standard ratio; the line affects no other (section 3.2.2)
    float relative_sd = 0.0f;
};
Ratio ratio(RatioTable table, vfit_sex sex, Line line);

/// Width lines are in head widths, height lines in head heights: the two never mix.
bool is_width(Line line);

struct Estimate {
    float value_m = 0.0f;
    float sigma_m = 0.0f;
    bool known = false;
};
using Lines = std::array<Estimate, kLineCount>;

inline Estimate& at(Lines& lines, Line line) { return lines[static_cast<size_t>(line)]; }
inline const Estimate& at(const Lines& lines, Line line) { return lines[static_cast<size_t>(line)]; }

/// Eq. 6 and 7 for one primary dimension; not known where no line says anything about it.
Estimate estimate_primary(const Lines& measured, Line primary, RatioTable table, vfit_sex sex,
                          Combination combination);

/// Table 2 and the size at which a garment of that kind is drawn.
struct GarmentKind {
    const char* name;
    Line height;
    std::array<Line, 2> widths;  // the first is the garment's width; x_s is the mean over all of them
    size_t width_count;
    float nominal_height_m;
    std::array<float, 2> nominal_widths_m;
};
/// VFIT_ERROR_ARGUMENT naming the known kinds.
const GarmentKind& garment_kind(std::string_view name);

}  // namespace vfit
