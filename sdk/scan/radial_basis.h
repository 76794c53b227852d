// How near a scan is to each of some that measures were learnt from: exp(-d^2 / 2), where d is the distance
// of both in a few directions of the features.
#pragma once

#include <span>
#include <vector>

namespace vfit {

class RadialBasis {
public:
    RadialBasis() = default;
    /// `directions`: one after the other, each as long as the features are. `centres`: one after the other,
    /// each a place in those directions.
    RadialBasis(std::vector<float> directions, std::vector<float> centres, size_t features);

    size_t size() const { return dimensions_ ? centres_.size() / dimensions_ : 0; }
    /// Of every centre, 0 to 1.
    std::vector<float> nearness(std::span<const float> features) const;

private:
    std::vector<float> directions_, centres_;
    size_t dimensions_ = 0;
};

}  // namespace vfit
