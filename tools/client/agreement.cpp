#include "client/agreement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace vfit::tools {

double student_t_975(uint32_t degrees) {
    // Exact for one and two; then the expansion of Cornish and Fisher, right to 0.004 at three and better
    // from four on.
    if (degrees == 1) return 12.706;
    if (degrees == 2) return 4.303;
    const double z = 1.959964, v = double(degrees);
    const double z3 = z * z * z, z5 = z3 * z * z, z7 = z5 * z * z, z9 = z7 * z * z;
    return z + (z3 + z) / (4 * v) + (5 * z5 + 16 * z3 + 3 * z) / (96 * v * v) +
           (3 * z7 + 19 * z5 + 17 * z3 - 15 * z) / (384 * v * v * v) +
           (79 * z9 + 776 * z7 + 1482 * z5 - 1920 * z3 - 945 * z) / (92160 * v * v * v * v);
}

Agreement agreement(const std::vector<Compared>& list) {
    struct Sum {
        double errors = 0.0;
        uint32_t scans = 0;
        double mean() const { return errors / scans; }
    };
    std::map<std::string, Sum> people;
    Agreement out;
    for (const Compared& c : list) {
        people[c.person].errors += c.error();
        ++people[c.person].scans;
        out.mean_absolute += std::abs(c.error());
        out.told += c.sigma > 0.0;
        out.covered += c.sigma > 0.0 && std::abs(c.error()) <= 1.645 * c.sigma;
    }
    out.scans = uint32_t(list.size());
    out.people = uint32_t(people.size());
    out.mean_absolute /= out.scans;
    out.covered /= std::max(1u, out.told);
    for (const auto& [name, person] : people) out.bias += person.mean() / out.people;
    double spread = 0.0;
    for (const auto& [name, person] : people) spread += std::pow(person.mean() - out.bias, 2.0);
    out.confidence = out.people < 2
                         ? std::numeric_limits<double>::infinity()
                         : student_t_975(out.people - 1) * std::sqrt(spread / (out.people - 1) / out.people);
    for (const Compared& c : list)
        if (out.scans > 1) out.sd += std::pow(c.error() - out.bias, 2.0) / (out.scans - 1);
    out.sd = std::sqrt(out.sd);
    out.low = out.bias - 1.96 * out.sd;
    out.high = out.bias + 1.96 * out.sd;
    return out;
}

double iso_20685_limit_m(const std::string& key) {
    const auto has = [&](const char* part) { return key.find(part) != std::string::npos; };
    if (has("_kg")) return 0.0;
    if (has("head_")) return 0.002;  // the scan sees hair
    if (has("hand_")) return 0.001;
    if (has("neck_girth") || has("arm_girth")) return 0.004;
    if (has("_girth")) return 0.009;
    if (has("_breadth")) return 0.004;
    if (has("_depth")) return 0.005;
    if (has("stature") || has("hip_height") || has("inside_leg")) return 0.004;
    return 0.005;  // lengths of segments
}

Verdict iso_20685_verdict(const Agreement& a, double limit_m) {
    if (std::abs(a.bias) - a.confidence > limit_m) return Verdict::kFails;
    return a.people >= kIsoPeople && std::abs(a.bias) + a.confidence < limit_m ? Verdict::kPasses
                                                                               : Verdict::kOpen;
}

}  // namespace vfit::tools
