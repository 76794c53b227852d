// A 2-D convolution on one core, written for the small pictures of the skeleton network. OpenCV 4.6 first
// copies the inputs of each output into a row, which takes it as long as a third of the multiplications; here
// shifted vectors of the padded picture are read where they lie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vfit {

struct ConvolutionShape {
    int inputs = 0, outputs = 0;
    int kernel = 1, stride = 1, pad = 0;  // the same along x and y; pads are zeros
};

class Convolution {
public:
    /// `weights`: outputs x inputs x kernel x kernel; `bias`: outputs, or null for none.
    Convolution(const ConvolutionShape& shape, const float* weights, const float* bias);

    int out_size(int in_size) const { return (in_size + 2 * shape_.pad - shape_.kernel) / shape_.stride + 1; }
    /// For pictures of another size than the last. Throws nothing but what memory throws.
    void prepare(int height, int width);
    /// `in`: inputs x height x width; `out`: outputs x out_size(height) x out_size(width). With `cut` results
    /// below zero become zero. Does not allocate.
    void run(const float* in, float* out, bool cut);

private:
    void spread(const float* in);

    const ConvolutionShape shape_;
    std::vector<float> weights_;  // blocks of kBlock outputs: input, tap, output
    std::vector<float> bias_;
    int height_ = 0, width_ = 0;  // of the input
    int out_height_ = 0, out_width_ = 0;
    int before_ = 0, after_ = 0;  // columns and rows of zeros about a plane
    size_t row_ = 0, plane_ = 0;  // floats of a row, and of one phase of one input
    std::vector<int32_t> taps_;   // from an output's place to what each weight multiplies
    // Of each input one plane for each phase of the stride, so that neighbours of outputs lie side by side.
    std::vector<float> padded_;
    std::vector<float> results_;  // of one block, with the padding's columns between the rows
    size_t result_stride_ = 0;
};

}  // namespace vfit
