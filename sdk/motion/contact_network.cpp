#include "motion/contact_network.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vfit {

namespace {

#include "motion/contact_weights.inc"

static_assert(std::size(kMean) == kContactFeatureCount && std::size(kScale) == kContactFeatureCount);
static_assert(std::size(kWeights1) == kHidden1 * kContactFeatureCount &&
              std::size(kWeights2) == kHidden2 * kHidden1 && std::size(kWeights3) == kHidden2);

constexpr float kFarthest = 5.0f;  // deviations; training cuts there too

template <size_t kIn, size_t kOut>
std::array<float, kOut> layer(const std::array<float, kIn>& in, const float* weights, const float* bias) {
    std::array<float, kOut> out;
    for (size_t o = 0; o < kOut; ++o) {
        float sum = bias[o];
        for (size_t i = 0; i < kIn; ++i) sum += weights[o * kIn + i] * in[i];
        out[o] = sum;
    }
    return out;
}

template <size_t kCount>
void squash(std::array<float, kCount>& values) {
    for (float& v : values) v = std::tanh(v);
}

}  // namespace

float chance_to_stand(std::span<const float, kContactFeatureCount> features) {
    std::array<float, kContactFeatureCount> in;
    for (size_t i = 0; i < in.size(); ++i)
        in[i] = std::clamp((features[i] - kMean[i]) * kScale[i], -kFarthest, kFarthest);
    auto first = layer<kContactFeatureCount, kHidden1>(in, kWeights1, kBias1);
    squash(first);
    auto second = layer<kHidden1, kHidden2>(first, kWeights2, kBias2);
    squash(second);
    const auto logit = layer<kHidden2, 1>(second, kWeights3, kBias3);
    return 1.0f / (1.0f + std::exp(-logit[0]));
}

}  // namespace vfit
