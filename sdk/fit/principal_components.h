// Principal components of a few long vectors, by the Gram matrix of the vectors (Sirovich 1987).
#pragma once

#include <cstddef>
#include <vector>

namespace vfit {

/// A component's field is the mean over the samples of score times sample.
struct PrincipalComponents {
    std::vector<std::vector<double>>
        scores;  // by component, strongest first, of every sample: mean 0, variance 1
};

/// `samples`: vectors of one length. Components that do not vary are zero.
PrincipalComponents principal_components(const std::vector<std::vector<double>>& samples, size_t count);

}  // namespace vfit
