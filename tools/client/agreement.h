// How well two ways to measure the same people agree, as standards and medicine count it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace vfit::tools {

/// A scan beside the tape, of one measure.
struct Compared {
    std::string person;
    double scanned = 0.0, sigma = 0.0, taped = 0.0;  // metres or kilograms
    double error() const { return scanned - taped; }
};

struct Agreement {
    uint32_t people = 0, scans = 0;
    double bias = 0.0;  // mean over people of their scans' mean errors
    double confidence =
        0.0;          // half of the 95 % interval of bias, by Student's t over people; infinite: of one
    double sd = 0.0;  // of all scans' errors about bias; of one scan 0
    double mean_absolute = 0.0;
    double low = 0.0, high = 0.0;  // limits of agreement: bias -+ 1.96 sd (Bland and Altman 1986)
    uint32_t told = 0;             // scans that told a sigma
    double covered = 0.0;          // fraction of these whose 90 % interval holds the tape
};

/// Of at least one.
Agreement agreement(const std::vector<Compared>& list);

/// What ISO 20685-1 allows the mean error of that measure to be, in metres; 0: the standard has none (a
/// mass).
double iso_20685_limit_m(const std::string& key);

enum class Verdict { kPasses, kFails, kOpen };
/// By the standard the whole 95 % interval of the bias must lie within the limit, of 40 people or more.
/// Fails: the interval lies outside. Open: too few people, or too much scatter, to tell.
Verdict iso_20685_verdict(const Agreement& agreement, double limit_m);
constexpr uint32_t kIsoPeople = 40;

/// The 97.5 % quantile of Student's t with that many degrees of freedom, at least 1.
double student_t_975(uint32_t degrees);

}  // namespace vfit::tools
