#include "bench/measure_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace vfit::tools {

std::pair<double, double> confidence(double k, double n) {
    if (n <= 0.0) return {0.0, 1.0};
    constexpr double z = 1.96;
    const double p = k / n, middle = (p + z * z / (2 * n)) / (1 + z * z / n),
                 half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
    return {middle - half, middle + half};
}

namespace {

std::string between(std::pair<double, double> range) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(2) << " (95 %: " << range.first << " to " << range.second << ")";
    return out.str();
}
constexpr const char* kGirths[] = {"chest_girth_m", "waist_girth_m", "hip_girth_m"};
constexpr uint32_t kGroup = 30;  // people, from which on a group is judged by itself

void print_groups(const MeasureSet& set) {
    std::cout << "  chest, waist, hip by group, front and " << set.view << (set.tight() ? ", told tight" : "")
              << ": absolute error, bias, mm; share within the interval\n";
    for (const auto& [group, tallies] : set.groups) {
        std::cout << "  " << std::left << std::setw(24) << group << std::right << std::fixed << std::setw(4)
                  << tallies.at("stature_m").count() << " people";
        for (const char* key : kGirths) {
            const MeasureTally& t = tallies.at(key);
            std::cout << std::setprecision(1) << std::setw(8) << 1000 * t.mean() << std::setw(7)
                      << 1000 * t.bias() << std::setprecision(0) << std::setw(5) << 100 * t.covered() << " %";
        }
        std::cout << "\n";
    }
}

/// Targets by set: in space, off space, clothed. Where clothes are tight the scan is told so.
void judge_narrow(const MeasureSet& set, size_t column, Targets& targets) {
    const MeasureTallies &front = set.tight() ? set.front_told : set.front,
                         &both = set.tight() ? set.both_told : set.both;
    if (front.count("stature_m") == 0 || both.count("stature_m") == 0) {
        targets.judge(set.name + ": scans that came about", 0.0, Aim::at_least, 1.0, 0);
        return;
    }
    const auto most = [&](const char* what, const MeasureTallies& tallies, const char* key,
                          std::array<double, 3> mm) {
        targets.judge(set.name + ": " + key + ", " + what, 1000 * tallies.at(key).mean(), Aim::at_most,
                      mm[column], 1, " mm");
    };
    const auto bias = [&](const MeasureTallies& tallies, const char* key, double mm) {
        targets.judge(set.name + ": " + key + ", bias", 1000 * std::abs(tallies.at(key).bias()), Aim::at_most,
                      mm, 1, " mm");
    };
    most("front", front, "stature_m", {5, 6, 8});
    bias(front, "stature_m", 4);
    most("front", front, "shoulder_breadth_m", {10, 12, 14});
    most("front", front, "chest_girth_m", {18, 24, 32});
    most("front", front, "waist_girth_m", {18, 22, 32});
    most("front", front, "hip_girth_m", {18, 18, 32});
    for (const char* key : {"chest_girth_m", "waist_girth_m", "hip_girth_m"}) {
        most("front and side", both, key, {10, 12, 22});
        bias(both, key, 9);
    }
    most("front and side", both, "inside_leg_m", {10, 12, 14});
    most("front and side", both, "arm_length_m", {10, 12, 14});
    const MeasureTally *least = nullptr, *largest = nullptr;
    double sum = 0.0;
    for (const auto& [key, t] : both) {
        if (!least || t.covered() < least->covered()) least = &t;
        if (!largest || t.covered() > largest->covered()) largest = &t;
        sum += t.covered();
    }
    targets.judge(set.name + ": 90 % intervals cover, mean of measures", sum / double(both.size()),
                  Aim::at_least, 0.85, 3);
    targets.judge(set.name + ": the same, at most", sum / double(both.size()), Aim::at_most, 0.95, 3);
    targets.judge(
        set.name + ": 90 % intervals cover, least covered measure" + between(least->covered_confidence()),
        least->covered(), Aim::at_least, 0.85, 3);
    targets.judge(
        set.name + ": 90 % intervals cover, most covered measure" + between(largest->covered_confidence()),
        largest->covered(), Aim::at_most, 0.95, 3);
    const SizeLetters& l = set.tight() ? set.letters_told : set.letters;
    const double n = std::max(1u, l.people);
    if (column < 2) {
        targets.judge(set.name + ": size letter exact" + between(confidence(l.exact, n)), l.exact / n,
                      Aim::at_least, column == 0 ? 0.85 : 0.82, 3);
        targets.judge(set.name + ": size letter within one", l.within_one / n, Aim::at_least, 0.995, 3);
    } else if (l.sure > 0) {
        const std::string what =
            set.name + ": letters said with 0.7 to 0.9 are right" + between(confidence(l.sure_right, l.sure));
        targets.judge(what + ", at least", double(l.sure_right) / l.sure, Aim::at_least, 0.7, 3);
        targets.judge(what + ", at most", double(l.sure_right) / l.sure, Aim::at_most, 0.9, 3);
        targets.judge(set.name + ": log loss beside the chart's", l.log_loss / n, Aim::at_most,
                      l.chart_log_loss(), 3);
    }
    targets.judge(set.name + ": beyond the capture of the front view, median", set.last_ms.quantile(0.5),
                  Aim::at_most, 60, 1, " ms");
}

/// Targets of people as real ones differ.
void judge_varied(const MeasureSet& set, Targets& targets) {
    const MeasureTallies &front = set.tight() ? set.front_told : set.front,
                         &both = set.tight() ? set.both_told : set.both;
    if (front.count("stature_m") == 0 || both.count("stature_m") == 0) {
        targets.judge(set.name + ": scans that came about", 0.0, Aim::at_least, 1.0, 0);
        return;
    }
    const auto most = [&](const std::string& what, double value_m, double mm) {
        targets.judge(set.name + ": " + what, 1000 * value_m, Aim::at_most, mm, 1, " mm");
    };
    double covered = 0.0;
    const std::string views = std::string(", front and ") + set.view;
    // Of all, of the heavy ones, and a group's bias.
    struct Most {
        double all, heavy, bias;
    };
    const Most mm = set.tight() ? (set.turn() ? Most{7, 10, 4} : Most{12, 18, 6})
                                : (set.turn() ? Most{20, 32, 10} : Most{24, 32, 10});
    for (const char* key : kGirths) {
        most(std::string(key) + views, both.at(key).mean(), mm.all);
        if (set.tight()) most(std::string(key) + ", front", front.at(key).mean(), 22);
        covered += both.at(key).covered() / std::size(kGirths);
    }
    double camera = 0.0, typed = 0.0;
    for (const char* key : kGirths) camera += both.at(key).mean(), typed += set.typed.at(key).mean();
    targets.judge(set.name + ": girths, error" + views + " over that of typed height and weight",
                  camera / typed, Aim::at_most, set.tight() ? 0.4 : 0.7, 2);
    most(std::string("stature_m") + views, both.at("stature_m").mean(), set.tight() ? 4 : 6);
    double worst_bias = -1.0, min_covered = 1.0;  // of the groups that are large enough
    std::string biased, uncovered;
    for (const auto& [group, tallies] : set.groups)
        for (const char* key : kGirths) {
            const MeasureTally& t = tallies.at(key);
            if (group == "BMI over 30") most(std::string(key) + ", " + group, t.mean(), mm.heavy);
            if (t.count() < kGroup) continue;
            if (std::abs(t.bias()) > worst_bias)
                worst_bias = std::abs(t.bias()), biased = ", " + group + ", " + key;
            if (t.covered() < min_covered) min_covered = t.covered(), uncovered = ", " + group + ", " + key;
        }
    targets.judge(set.name + ": 90 % intervals of girths cover", covered, Aim::at_least, 0.87, 3);
    targets.judge(set.name + ": the same, at most", covered, Aim::at_most, 0.93, 3);
    if (worst_bias >= 0.0) {
        most("largest bias of a group of 30" + biased, worst_bias, mm.bias);
        targets.judge(set.name + ": 90 % intervals, least of a group of 30" + uncovered, min_covered,
                      Aim::at_least, 0.80, 3);
    }
    targets.judge(set.name + ": beyond the capture" + views + ", median", set.all_round_ms.quantile(0.5),
                  Aim::at_most, set.turn() ? 1000.0 : 150.0, 0, " ms");
    const SizeLetters& l = set.tight() ? set.letters_told : set.letters;
    const double n = std::max(1u, l.people);
    targets.judge(set.name + ": size letter exact" + between(confidence(l.exact, n)), l.exact / n,
                  Aim::at_least, set.tight() ? 0.8 : 0.65, 3);
    if (set.tight())
        targets.judge(set.name + ": log loss beside the chart's", l.log_loss / n, Aim::at_most,
                      l.chart_log_loss(), 3);
}

}  // namespace

void print(const MeasureSet& set) {
    std::vector<std::pair<std::string, const MeasureTallies*>> columns = {
        {"front", &set.front}, {"front and " + std::string(set.view), &set.both}};
    if (set.tight())
        columns.insert(columns.end(), {{"front, told tight", &set.front_told},
                                       {"and " + std::string(set.view), &set.both_told}});
    columns.insert(columns.end(), {{"typed height, weight", &set.typed},
                                   {"typed and all views", &set.both_and_typed},
                                   {"the paper's method", &set.paper}});
    std::cout << "\nSYNTHETIC, " << set.name << ": " << set.scans << " scans, " << set.failed
              << " of them failed. Absolute error with 95 % confidence, bias, share within the 90 % "
                 "interval; mm, kg\n"
              << std::left << std::setw(24) << "";
    for (const auto& [title, tallies] : columns) std::cout << std::setw(25) << "  " + title;
    std::cout << std::right << "\n";
    for (const auto& [key, front] : set.front) {
        const double unit = key == "body_mass_kg" ? 1.0 : 1000.0;
        std::cout << "  " << std::left << std::setw(22) << key << std::right << std::fixed;
        for (const auto& [title, tallies] : columns) {
            const auto found = tallies->find(key);
            if (found == tallies->end()) continue;
            const MeasureTally& t = found->second;
            std::cout << std::setprecision(1) << std::setw(6) << unit * t.mean() << " +-" << std::setw(4)
                      << unit * t.mean_confidence() << std::setw(6) << unit * t.bias() << std::setw(4)
                      << std::setprecision(0) << 100 * t.covered() << " %";
        }
        std::cout << "\n";
    }
    const SizeLetters& l = set.tight() ? set.letters_told : set.letters;
    const double n = std::max(1u, l.people);
    std::cout << std::setprecision(3) << "  size letter, front and " << set.view << ": exact " << l.exact / n
              << between(confidence(l.exact, n)) << ", within one " << l.within_one / n
              << between(confidence(l.within_one, n)) << ", log loss " << l.log_loss / n
              << "\n  a chart by true height and weight: exact " << l.chart_exact()
              << ", log loss (at its best) " << l.chart_log_loss() << "\n";
    if (set.is_varied()) print_groups(set);
}

void judge(const MeasureSet& set, Targets& targets) {
    if (set.hair) {
        if (const auto at = set.both_told.find("stature_m"); at != set.both_told.end()) {
            targets.judge(set.name + ": stature_m, front and side", 1000 * at->second.mean(), Aim::at_most, 4,
                          1, " mm");
            targets.judge(set.name + ": stature_m, 90 % intervals cover", at->second.covered(), Aim::at_least,
                          0.9, 3);
        }
        return;
    }
    if (set.is_varied())
        judge_varied(set, targets);
    else
        judge_narrow(set, set.space == BodySpace::kInside ? 0 : set.tight() ? 1 : 2, targets);
}

}  // namespace vfit::tools
