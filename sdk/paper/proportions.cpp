#include "paper/proportions.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace vfit {

namespace {

struct Row {
    Line line;
    const char* key;
    bool width;
    float canon;         // heads, Table 1
    Ratio female, male;  // of real people
};

// Head height over stature (Drillis and Contini 1966): turns shares of stature into heads.
constexpr float kHead = 0.130f;

// Shares of stature: hip joint 0.530, forearm with hand 0.254, hand 0.108 by Drillis and Contini, whose
// lengths start at joint centres as a tracker's do (ANSUR II takes the trochanter, 0.513, and the tip of the
// elbow, 0.273). Shoulder width over head width is bideltoid over head breadth, ANSUR II. Deviations are
// those of the nearest ratio of ANSUR II (4082 men, 1986 women); that of the head's height is the one of
// menton to sellion.
constexpr Row kTable1[kLineCount] = {
    {Line::kHeadWidth, "head_width_m", true, 1.0f, {1.0f, 0.0f}, {1.0f, 0.0f}},
    {Line::kHeadHeight, "head_height_m", false, 1.0f, {1.0f, 0.06f}, {1.0f, 0.06f}},
    {Line::kBodyHeight, "stature_m", false, 7.0f, {1.0f / kHead, 0.0f}, {1.0f / kHead, 0.0f}},
    {Line::kHipHeight, "hip_height_m", false, 4.0f, {0.530f / kHead, 0.029f}, {0.530f / kHead, 0.029f}},
    {Line::kElbowFingertip,
     "elbow_fingertip_m",
     false,
     2.0f,
     {0.254f / kHead, 0.035f},
     {0.254f / kHead, 0.030f}},
    {Line::kWristFingertip, "hand_length_m", false, 1.0f, {0.108f / kHead, 0.042f}, {0.108f / kHead, 0.038f}},
    {Line::kShoulderWidth, "shoulder_breadth_m", true, 3.0f, {3.05f, 0.066f}, {3.31f, 0.060f}},
    {Line::kHipWidth, "hip_breadth_m", true, 0.0f, {}, {}},
    {Line::kTorsoHeight, "torso_height_m", false, 0.0f, {}, {}},
};

const Row& row(Line line) { return kTable1[static_cast<size_t>(line)]; }

// Table 2, and as nominal size that of the default body halfway between the sexes, measured on the body
// model: stature, hip joint above the floor, neck to hips, bideltoid breadth with the arms at 5 degrees, hip
// breadth, elbow joint to fingertip.
constexpr GarmentKind kTable2[] = {
    {"trousers", Line::kHipHeight, {Line::kHipWidth, Line::kHipWidth}, 1, 0.886f, {0.367f, 0.0f}},
    {"long_sleeves",
     Line::kBodyHeight,
     {Line::kShoulderWidth, Line::kElbowFingertip},
     2,
     1.691f,
     {0.450f, 0.428f}},
    {"short_sleeves",
     Line::kTorsoHeight,
     {Line::kShoulderWidth, Line::kShoulderWidth},
     1,
     0.558f,
     {0.450f, 0.0f}},
};

Estimate mean(const Estimate* estimates, size_t count, Combination combination) {
    if (count == 0) return {};
    double value = 0.0, weight = 0.0, variance = 0.0;
    for (size_t i = 0; i < count; ++i) {
        const double s2 = double(estimates[i].sigma_m) * estimates[i].sigma_m;
        const double w = combination == Combination::kInverseVariance ? 1.0 / s2 : 1.0;
        value += w * estimates[i].value_m;
        variance += w * w * s2;
        weight += w;
    }
    return {float(value / weight), float(std::sqrt(variance) / weight), true};
}

}  // namespace

const char* line_key(Line line) { return row(line).key; }

bool is_width(Line line) { return row(line).width; }

Ratio ratio(RatioTable table, vfit_sex sex, Line line) {
    const Row& r = row(line);
    const Ratio halfway{0.5f * (r.female.heads + r.male.heads),
                        0.5f * (r.female.relative_sd + r.male.relative_sd)};
    const Ratio& people = sex == VFIT_SEX_FEMALE ? r.female : sex == VFIT_SEX_MALE ? r.male : halfway;
    return table == RatioTable::kCanon ? Ratio{r.canon, people.relative_sd} : people;
}

Estimate estimate_primary(const Lines& measured, Line primary, RatioTable table, vfit_sex sex,
                          Combination combination) {
    std::array<Estimate, kLineCount> estimates;
    size_t count = 0;
    const Ratio to = ratio(table, sex, primary);
    const Estimate& direct = at(measured, primary);
    // An estimate cannot be surer than this: keeps a weight finite where a caller gives no sigma.
    constexpr float kSurest_m = 0.001f;

    for (const Row& r : kTable1) {
        const Estimate& line = at(measured, r.line);
        if (!line.known) continue;
        if (r.line == primary) {
            estimates[count++] = {line.value_m, std::max(line.sigma_m, kSurest_m), true};
            continue;
        }
        const Ratio from = ratio(table, sex, r.line);
        if (r.width != is_width(primary) || from.heads == 0.0f || to.heads == 0.0f) continue;
        const float factor = to.heads / from.heads;  // R of Eq. 6
        const float value = line.value_m * factor;
        const float spread = value * std::hypot(from.relative_sd, to.relative_sd);
        const float sigma = std::max(std::hypot(line.sigma_m * factor, spread), kSurest_m);
        // A line that contradicts the direct measure was mismeasured.
        constexpr float kContradiction_sigma = 3.0f;
        if (combination == Combination::kInverseVariance && direct.known &&
            std::abs(value - direct.value_m) > kContradiction_sigma * std::hypot(sigma, direct.sigma_m))
            continue;
        estimates[count++] = {value, sigma, true};
    }
    return mean(estimates.data(), count, combination);
}

const GarmentKind& garment_kind(std::string_view name) {
    for (const GarmentKind& kind : kTable2)
        if (name == kind.name) return kind;
    std::string known;
    for (const GarmentKind& kind : kTable2) known += text(known.empty() ? "" : ", ", kind.name);
    fail(VFIT_ERROR_ARGUMENT, "garment kind \"", name, "\" has no scale; known kinds: ", known);
}

}  // namespace vfit
