#include "fit/principal_components.h"

#include <cmath>

namespace vfit {

namespace {

constexpr int kPowerSteps =
    60;  // of the subspace iteration; eigenvalues here fall by a third or more a component

double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// Gram-Schmidt; what vanishes is left as zero.
void make_orthonormal(std::vector<std::vector<double>>& vectors) {
    for (size_t i = 0; i < vectors.size(); ++i) {
        for (size_t j = 0; j < i; ++j) {
            const double along = dot(vectors[i], vectors[j]);
            for (size_t k = 0; k < vectors[i].size(); ++k) vectors[i][k] -= along * vectors[j][k];
        }
        const double length = std::sqrt(dot(vectors[i], vectors[i]));
        for (double& x : vectors[i]) x = length > 1e-12 ? x / length : 0.0;
    }
}

}  // namespace

PrincipalComponents principal_components(const std::vector<std::vector<double>>& samples, size_t count) {
    const size_t n = samples.size(), length = samples.front().size();
    PrincipalComponents out;
    std::vector<double> mean(length, 0.0);
    for (const auto& sample : samples)
        for (size_t i = 0; i < length; ++i) mean[i] += sample[i] / double(n);
    std::vector<std::vector<double>> centred = samples;
    for (auto& sample : centred)
        for (size_t i = 0; i < length; ++i) sample[i] -= mean[i];
    std::vector<std::vector<double>> gram(n, std::vector<double>(n));
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j <= i; ++j) gram[i][j] = gram[j][i] = dot(centred[i], centred[j]);

    // Any start that is not square to the wanted directions will do.
    std::vector<std::vector<double>> directions(count, std::vector<double>(n));
    for (size_t c = 0; c < count; ++c)
        for (size_t i = 0; i < n; ++i) directions[c][i] = std::sin(1.0 + double(i * (2 * c + 1)) * 0.7);
    make_orthonormal(directions);
    for (int step = 0; step < kPowerSteps; ++step) {
        for (auto& direction : directions) {
            std::vector<double> next(n);
            for (size_t i = 0; i < n; ++i) next[i] = dot(gram[i], direction);
            direction = std::move(next);
        }
        make_orthonormal(directions);
    }
    const double unit = std::sqrt(double(n));  // directions have length 1, scores variance 1
    out.scores = std::move(directions);
    for (auto& scores : out.scores)
        for (double& score : scores) score *= unit;
    return out;
}

}  // namespace vfit
