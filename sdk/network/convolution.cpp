#include "network/convolution.h"

#include <algorithm>
#include <cfloat>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "network/convolution.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef VFIT_CONVOLUTION_BLOCK
#define VFIT_CONVOLUTION_BLOCK
namespace vfit {
namespace {

constexpr size_t kBlock = 4;      // outputs at a time
constexpr size_t kMostLanes = 8;  // longer vectors would mostly lie beyond a small picture
constexpr size_t kSlack = 3 * kMostLanes;

/// One block of outputs.
struct BlockJob {
    const float* in;
    size_t channel_stride, channels;
    const int32_t* taps;
    size_t tap_count;
    const float* weights;  // channels x tap_count x kBlock
    const float* bias;     // kBlock
    float least;           // results are at least that
    size_t count;          // places; up to kSlack more are written
    float* out;
    size_t out_stride;
};

}  // namespace
}  // namespace vfit
#endif

HWY_BEFORE_NAMESPACE();
namespace vfit {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Three vectors of places times four outputs: twelve sums, which with an input vector each and a weight fill
// the sixteen registers of AVX2. No arrays of vectors: those of SVE have no size.
void ConvolveBlock(const BlockJob& job) {
    const hn::CappedTag<float, kMostLanes> d;
    const size_t n = hn::Lanes(d);
    const auto least = hn::Set(d, job.least);
    const auto bias0 = hn::Set(d, job.bias[0]), bias1 = hn::Set(d, job.bias[1]);
    const auto bias2 = hn::Set(d, job.bias[2]), bias3 = hn::Set(d, job.bias[3]);
    float* const out0 = job.out;
    float* const out1 = out0 + job.out_stride;
    float* const out2 = out1 + job.out_stride;
    float* const out3 = out2 + job.out_stride;
    size_t at = 0;
    for (; at + 2 * n < job.count; at += 3 * n) {
        auto a0 = bias0, b0 = bias0, c0 = bias0, a1 = bias1, b1 = bias1, c1 = bias1;
        auto a2 = bias2, b2 = bias2, c2 = bias2, a3 = bias3, b3 = bias3, c3 = bias3;
        const float* w = job.weights;
        for (size_t channel = 0; channel < job.channels; ++channel) {
            const float* const plane = job.in + channel * job.channel_stride + at;
            for (size_t t = 0; t < job.tap_count; ++t, w += kBlock) {
                const float* const from = plane + job.taps[t];
                const auto a = hn::LoadU(d, from), b = hn::LoadU(d, from + n), c = hn::LoadU(d, from + 2 * n);
                const auto w0 = hn::Set(d, w[0]);
                a0 = hn::MulAdd(a, w0, a0), b0 = hn::MulAdd(b, w0, b0), c0 = hn::MulAdd(c, w0, c0);
                const auto w1 = hn::Set(d, w[1]);
                a1 = hn::MulAdd(a, w1, a1), b1 = hn::MulAdd(b, w1, b1), c1 = hn::MulAdd(c, w1, c1);
                const auto w2 = hn::Set(d, w[2]);
                a2 = hn::MulAdd(a, w2, a2), b2 = hn::MulAdd(b, w2, b2), c2 = hn::MulAdd(c, w2, c2);
                const auto w3 = hn::Set(d, w[3]);
                a3 = hn::MulAdd(a, w3, a3), b3 = hn::MulAdd(b, w3, b3), c3 = hn::MulAdd(c, w3, c3);
            }
        }
        const auto store = [&](float* to, auto a, auto b, auto c) HWY_ATTR {
            hn::StoreU(hn::Max(a, least), d, to);
            hn::StoreU(hn::Max(b, least), d, to + n);
            hn::StoreU(hn::Max(c, least), d, to + 2 * n);
        };
        store(out0 + at, a0, b0, c0), store(out1 + at, a1, b1, c1);
        store(out2 + at, a2, b2, c2), store(out3 + at, a3, b3, c3);
    }
    for (; at < job.count; at += n) {
        auto a0 = bias0, a1 = bias1, a2 = bias2, a3 = bias3;
        const float* w = job.weights;
        for (size_t channel = 0; channel < job.channels; ++channel) {
            const float* const plane = job.in + channel * job.channel_stride + at;
            for (size_t t = 0; t < job.tap_count; ++t, w += kBlock) {
                const auto a = hn::LoadU(d, plane + job.taps[t]);
                a0 = hn::MulAdd(a, hn::Set(d, w[0]), a0), a1 = hn::MulAdd(a, hn::Set(d, w[1]), a1);
                a2 = hn::MulAdd(a, hn::Set(d, w[2]), a2), a3 = hn::MulAdd(a, hn::Set(d, w[3]), a3);
            }
        }
        hn::StoreU(hn::Max(a0, least), d, out0 + at), hn::StoreU(hn::Max(a1, least), d, out1 + at);
        hn::StoreU(hn::Max(a2, least), d, out2 + at), hn::StoreU(hn::Max(a3, least), d, out3 + at);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace vfit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vfit {

HWY_EXPORT(ConvolveBlock);

namespace {

int floor_of(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

}  // namespace

Convolution::Convolution(const ConvolutionShape& shape, const float* weights, const float* bias)
    : shape_(shape) {
    const size_t inputs = size_t(shape.inputs), outputs = size_t(shape.outputs),
                 area = size_t(shape.kernel) * size_t(shape.kernel);
    const size_t blocks = (outputs + kBlock - 1) / kBlock;
    weights_.assign(blocks * inputs * area * kBlock, 0.0f);
    bias_.assign(blocks * kBlock, 0.0f);
    if (bias) std::copy_n(bias, outputs, bias_.begin());
    for (size_t o = 0; o < outputs; ++o)
        for (size_t i = 0; i < inputs * area; ++i)
            weights_[(o / kBlock * inputs * area + i) * kBlock + o % kBlock] = weights[o * inputs * area + i];
}

void Convolution::prepare(int height, int width) {
    if (height == height_ && width == width_) return;
    height_ = height, width_ = width;
    out_height_ = out_size(height), out_width_ = out_size(width);
    const int s = shape_.stride, k = shape_.kernel;
    before_ = -floor_of(-shape_.pad, s);
    after_ = std::max(0, floor_of(k - 1 - shape_.pad, s));
    row_ = size_t(before_ + out_width_ + after_);
    plane_ = row_ * size_t(before_ + out_height_ + after_);
    padded_.assign(size_t(shape_.inputs) * size_t(s * s) * plane_ + kSlack, 0.0f);
    taps_.clear();
    for (int y = -shape_.pad; y < k - shape_.pad; ++y)
        for (int x = -shape_.pad; x < k - shape_.pad; ++x) {
            const int phase = (y - floor_of(y, s) * s) * s + x - floor_of(x, s) * s;
            taps_.push_back(int32_t(size_t(phase) * plane_ + size_t(before_ + floor_of(y, s)) * row_ +
                                    size_t(before_ + floor_of(x, s))));
        }
    result_stride_ = size_t(out_height_) * row_ + kSlack;
    results_.assign(kBlock * result_stride_, 0.0f);
}

/// The inputs into their phases' planes; the zeros about them stay.
void Convolution::spread(const float* in) {
    const int s = shape_.stride;
    float* plane = padded_.data();
    for (int channel = 0; channel < shape_.inputs; ++channel, in += size_t(height_) * size_t(width_))
        for (int py = 0; py < s; ++py)
            for (int px = 0; px < s; ++px, plane += plane_)
                for (int y = 0; y < out_height_ + after_ && y * s + py < height_; ++y) {
                    const float* const from = in + size_t(y * s + py) * size_t(width_) + px;
                    float* const to = plane + size_t(before_ + y) * row_ + before_;
                    const int count = std::min(out_width_ + after_, (width_ - px + s - 1) / s);
                    if (s == 1)
                        std::memcpy(to, from, size_t(count) * sizeof(float));
                    else
                        for (int x = 0; x < count; ++x) to[x] = from[x * s];
                }
}

void Convolution::run(const float* in, float* out, bool cut) {
    spread(in);
    BlockJob job;
    job.in = padded_.data();
    job.channel_stride = plane_ * size_t(shape_.stride * shape_.stride);
    job.channels = size_t(shape_.inputs);
    job.taps = taps_.data();
    job.tap_count = taps_.size();
    job.least = cut ? 0.0f : -FLT_MAX;
    job.count = size_t(out_height_ - 1) * row_ + size_t(out_width_);
    job.out = results_.data();
    job.out_stride = result_stride_;
    const size_t area = size_t(out_height_) * size_t(out_width_);
    for (size_t first = 0; first < size_t(shape_.outputs); first += kBlock) {
        job.weights = weights_.data() + first * job.channels * job.tap_count;
        job.bias = bias_.data() + first;
        HWY_DYNAMIC_DISPATCH(ConvolveBlock)(job);
        for (size_t o = first; o < std::min(first + kBlock, size_t(shape_.outputs)); ++o)
            for (int y = 0; y < out_height_; ++y)
                std::memcpy(out + o * area + size_t(y) * size_t(out_width_),
                            job.out + (o - first) * job.out_stride + size_t(y) * row_,
                            size_t(out_width_) * sizeof(float));
    }
}

}  // namespace vfit
#endif
