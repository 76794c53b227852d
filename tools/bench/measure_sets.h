// Sets of virtual people on whom measuring is judged: what is counted of each, and how it is printed and
// judged.
#pragma once

#include <map>
#include <string>

#include "bench/bench.h"
#include "bench/targets.h"
#include "client/output.h"
#include "population/scan_scene.h"

namespace vfit::tools {

/// 95 % confidence of a fraction k of n (Wilson 1927).
std::pair<double, double> confidence(double k, double n);

/// Errors of one measure over people.
class MeasureTally {
public:
    void add(double error, double sigma) {
        sum_ += error, absolute_ += std::abs(error), squares_ += error * error, ++count_;
        inside_ += std::abs(error) <= 1.645 * sigma;
    }
    double mean() const { return absolute_ / n(); }
    uint32_t count() const { return count_; }
    /// Half of the 95 % confidence interval of mean().
    double mean_confidence() const {
        return 1.96 * std::sqrt(std::max(0.0, squares_ / n() - mean() * mean()) / n());
    }
    double bias() const { return sum_ / n(); }
    double covered() const { return inside_ / n(); }
    std::pair<double, double> covered_confidence() const { return confidence(inside_, count_); }
    Json json() const {
        return {{"mean_absolute", mean()}, {"bias", bias()}, {"covered", covered()}, {"n", count_}};
    }

private:
    double n() const { return std::max(1u, count_); }
    double sum_ = 0.0, absolute_ = 0.0, squares_ = 0.0;
    uint32_t count_ = 0, inside_ = 0;
};

using MeasureTallies = std::map<std::string, MeasureTally>;

/// Letters told against the truth.
struct SizeLetters {
    uint32_t people = 0, exact = 0, within_one = 0, sure = 0, sure_right = 0;
    double log_loss = 0.0;
    std::map<int, uint32_t> chart_off;  // what a chart by true height and weight says: letters off the truth

    /// Of the chart, were each of its answers given with the frequency of that miss: the best that it can be.
    double chart_log_loss() const {
        double sum = 0.0;
        for (const auto& [off, n] : chart_off) sum -= n * std::log(double(n) / people);
        return sum / std::max(1u, people);
    }
    double chart_exact() const { return chart_off.count(0) ? double(chart_off.at(0)) / people : 0.0; }
};

struct MeasureSet {
    std::string name;
    BodySpace space;
    Dress dress;
    const char* view = "side";  // after the front; or "turn" on the spot, "cameras": four around at once
    bool hair = false;          // black: 3 to 12 cm of the crown come without a reading
    bool is_varied() const { return space == BodySpace::kVaried; }
    // Of a scan that is told nothing of clothes, and of one that is told that they are tight; both: of the
    // front and that view.
    MeasureTallies front{}, both{}, front_told{}, both_told{}, paper{};
    // By a population alone, from a typed height and weight; and of both of the scan that knows of the
    // clothes, and those.
    MeasureTallies typed{}, both_and_typed{};
    std::map<std::string, MeasureTallies>
        groups{};  // of real sets: front and that view, told tight where clothes are
    SizeLetters letters{}, letters_told{};
    Samples last_ms{};       // what is left to do when the capture of the front ends
    Samples all_round_ms{};  // of that view
    uint32_t scans = 0, failed = 0;
    bool turn() const { return std::string(view) == "turn"; }
    bool tight() const { return dress == Dress::kTight; }
};

void print(const MeasureSet& set);
/// Counts the targets of the set: its own column of them, or those of people as real ones differ.
void judge(const MeasureSet& set, Targets& targets);

}  // namespace vfit::tools
