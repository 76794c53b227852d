#include "client/joint_checks.h"

#include <algorithm>
#include <cmath>

#include "client/client.h"

namespace vfit::tools {

namespace {

// Between the outermost joints of a person: less is no person in metres, more than the span of raised arms is
// none either.
constexpr double kMinSpan_m = 0.1, kMaxSpan_m = 3.0;
// A span of more than this is one in millimetres rather than in centimetres.
constexpr double kMillimetreSpan = 300.0;
// Joints that lie deeper are not on a floor at 0: no foot would stand.
constexpr double kDeepest_m = -0.3;
// Cameras give 1 to 1000 rows a second.
constexpr double kMinStep_s = 1e-3, kMaxStep_s = 1.0;

double middle_of(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Of the box around the joints.
double span_of(const JointRow& row) {
    double diagonal = 0;
    for (int axis = 0; axis < 3; ++axis) {
        double low = INFINITY, high = -INFINITY;
        for (const vfit_joint& j : row.joints) {
            low = std::min(low, double(j.position[axis]));
            high = std::max(high, double(j.position[axis]));
        }
        diagonal += (high - low) * (high - low);
    }
    return std::sqrt(diagonal);
}

std::string short_number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

}  // namespace

void check_lengths(const std::vector<JointRow>& rows, const std::string& source) {
    std::vector<double> spans;
    for (const JointRow& row : rows)
        if (row.joints.size() > 1) spans.push_back(span_of(row));
    if (spans.empty()) throw Failure(source + ": no row has two joints that are seen");
    const double span = middle_of(spans);
    if (span >= kMinSpan_m && span <= kMaxSpan_m) return;
    throw Failure(source + ": the joints of a row lie " + short_number(span) +
                  " apart (median), which is no person in metres" +
                  (span > kMillimetreSpan ? ": are these millimetres?"
                   : span > kMaxSpan_m    ? ": are these centimetres?"
                                          : ""));
}

void check_floor(const std::vector<JointRow>& rows, const std::string& source) {
    std::vector<double> lowest;
    for (const JointRow& row : rows) {
        double low = INFINITY;
        for (const vfit_joint& j : row.joints) low = std::min(low, double(j.position[1]));
        if (!row.joints.empty()) lowest.push_back(low);
    }
    const double low = middle_of(lowest);
    if (low >= kDeepest_m) return;
    throw Failure(source + ": the lowest joint of a row is at y = " + short_number(low) +
                  " m (median): y points up, and the floor is at 0");
}

void check_times(const std::vector<JointRow>& rows, const std::string& source) {
    std::vector<double> steps;
    for (size_t i = 1; i < rows.size(); ++i)
        steps.push_back(1e-9 * double(rows[i].time_ns - rows[i - 1].time_ns));
    if (steps.empty()) return;
    const double step = middle_of(steps);
    if (step >= kMinStep_s && step <= kMaxStep_s) return;
    throw Failure(source + ": rows are " + short_number(step) + " s apart (median); known are " +
                  short_number(kMinStep_s) + " to " + short_number(kMaxStep_s) +
                  " s: is the time in another unit?");
}

}  // namespace vfit::tools
