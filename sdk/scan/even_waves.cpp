#include "scan/even_waves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "math/types.h"

namespace vfit {

namespace {

constexpr size_t kTerms = 5;
// Of a wave's square, by a sample's: the first is hardly held.
constexpr std::array<double, kTerms> kHold{0.0, 0.1, 0.1, 1.0, 1.0};
constexpr int kRounds = 4;
constexpr double kApart = 3.0, kMinApart_m = 0.01;  // of the samples' median distance: no part of them
using Terms = std::array<double, kTerms>;

Terms terms_at(double angle) {
    return {1.0, std::cos(2 * angle), std::sin(2 * angle), std::cos(4 * angle), std::sin(4 * angle)};
}

double at(const Terms& waves, double angle) {
    const Terms terms = terms_at(angle);
    double sum = 0.0;
    for (size_t i = 0; i < kTerms; ++i) sum += waves[i] * terms[i];
    return sum;
}

/// Gauss's elimination; the matrix is positive definite.
Terms solve(std::array<Terms, kTerms> matrix, Terms right) {
    for (size_t k = 0; k < kTerms; ++k)
        for (size_t i = k + 1; i < kTerms; ++i) {
            const double f = matrix[i][k] / matrix[k][k];
            for (size_t j = k; j < kTerms; ++j) matrix[i][j] -= f * matrix[k][j];
            right[i] -= f * right[k];
        }
    for (size_t k = kTerms; k-- > 0;) {
        for (size_t j = k + 1; j < kTerms; ++j) right[k] -= matrix[k][j] * right[j];
        right[k] /= matrix[k][k];
    }
    return right;
}

struct Sample {
    double angle, value;
};

Terms fit(const std::vector<Sample>& samples) {
    std::array<Terms, kTerms> matrix{};
    Terms right{};
    for (size_t i = 0; i < kTerms; ++i) matrix[i][i] = kHold[i];
    for (const Sample& s : samples) {
        const Terms terms = terms_at(s.angle);
        for (size_t i = 0; i < kTerms; ++i) {
            right[i] += terms[i] * s.value;
            for (size_t j = 0; j < kTerms; ++j) matrix[i][j] += terms[i] * terms[j];
        }
    }
    return solve(matrix, right);
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

EvenWaves fit_even_waves(std::span<const float> samples) {
    std::vector<Sample> known;
    size_t gap = 0, widest = 0;
    for (size_t i = 0; i < 2 * samples.size(); ++i) {  // gaps go on past the end
        gap = std::isnan(samples[i % samples.size()]) ? gap + 1 : 0;
        widest = std::max(widest, gap);
        if (i < samples.size() && gap == 0)
            known.push_back({double(kPi) * double(i) / double(samples.size()), double(samples[i])});
    }
    const float none = std::nanf("");
    if (3 * known.size() < samples.size() || 2 * widest > samples.size())
        return {none, none, none, none, none};
    const size_t fewest = std::max(kTerms, known.size() / 2);
    Terms waves = fit(known);
    for (int round = 1; round < kRounds; ++round) {
        std::vector<double> off;
        for (const Sample& s : known) off.push_back(std::abs(s.value - at(waves, s.angle)));
        const double apart = std::max(kMinApart_m, kApart * median(off));
        std::vector<Sample> kept;
        for (size_t i = 0; i < known.size(); ++i)
            if (off[i] <= apart) kept.push_back(known[i]);
        if (kept.size() == known.size() || kept.size() < fewest) break;
        known = std::move(kept);
        waves = fit(known);
    }
    return {float(waves[0]), float(waves[1]), float(waves[2]), float(waves[3]), float(waves[4])};
}

}  // namespace vfit
