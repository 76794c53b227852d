#include "scan/radial_basis.h"

#include <cmath>
#include <numeric>

namespace vfit {

RadialBasis::RadialBasis(std::vector<float> directions, std::vector<float> centres, size_t features)
    : directions_(std::move(directions)),
      centres_(std::move(centres)),
      dimensions_(directions_.size() / features) {}

std::vector<float> RadialBasis::nearness(std::span<const float> features) const {
    std::vector<float> place(dimensions_), out(size());
    for (size_t d = 0; d < dimensions_; ++d)
        place[d] = std::inner_product(features.begin(), features.end(),
                                      directions_.begin() + std::ptrdiff_t(d * features.size()), 0.0f);
    for (size_t c = 0; c < out.size(); ++c) {
        float squared = 0.0f;
        for (size_t d = 0; d < dimensions_; ++d) {
            const float apart = place[d] - centres_[c * dimensions_ + d];
            squared += apart * apart;
        }
        out[c] = std::exp(-0.5f * squared);
    }
    return out;
}

}  // namespace vfit
