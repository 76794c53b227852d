// vfit's convolution gives what the sum in its definition and OpenCV's own give, alone and inside OpenCV's
// dnn.
#include "network/convolution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <opencv2/dnn.hpp>
#include <opencv2/dnn/all_layers.hpp>
#include <random>
#include <thread>
#include <vector>

#include "network/convolution_layer.h"

namespace vfit {
namespace {

std::vector<float> noise(size_t count, uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<float> out(count);
    for (float& x : out) x = float(random() % 2001) * 1e-3f - 1.0f;
    return out;
}

/// The definition, in double.
std::vector<float> by_definition(const ConvolutionShape& s, const std::vector<float>& weights,
                                 const std::vector<float>& bias, const std::vector<float>& in, int height,
                                 int width, bool cut) {
    const int h = (height + 2 * s.pad - s.kernel) / s.stride + 1,
              w = (width + 2 * s.pad - s.kernel) / s.stride + 1;
    std::vector<float> out;
    for (int o = 0; o < s.outputs; ++o)
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                double sum = bias.empty() ? 0.0 : double(bias[size_t(o)]);
                for (int c = 0; c < s.inputs; ++c)
                    for (int i = 0; i < s.kernel; ++i)
                        for (int j = 0; j < s.kernel; ++j) {
                            const int v = y * s.stride + i - s.pad, u = x * s.stride + j - s.pad;
                            if (v < 0 || u < 0 || v >= height || u >= width) continue;
                            sum +=
                                double(weights[size_t(((o * s.inputs + c) * s.kernel + i) * s.kernel + j)]) *
                                double(in[size_t((c * height + v) * width + u)]);
                        }
                out.push_back(float(cut ? std::max(0.0, sum) : sum));
            }
    return out;
}

const char* const kWeights = VFIT_SOURCE_DIR "/assets/networks/joints.onnx";

/// How many of a network's convolutions are OpenCV's own.
int count_theirs(cv::dnn::Net net) {
    int count = 0;
    for (const cv::String& name : net.getLayerNames())
        count += !net.getLayer(net.getLayerId(name)).dynamicCast<cv::dnn::BaseConvolutionLayer>().empty();
    return count;
}

TEST(Convolution, IsTheSumOfItsDefinition) {
    uint32_t seed = 0;
    for (const ConvolutionShape& shape : {ConvolutionShape{1, 16, 5, 2, 2},
                                          {3, 4, 3, 1, 1},
                                          {5, 7, 3, 2, 1},
                                          {8, 46, 1, 1, 0},
                                          {2, 1, 3, 1, 0},
                                          {3, 5, 3, 3, 1},
                                          {2, 6, 4, 2, 1},
                                          {1, 3, 1, 2, 0},
                                          {2, 3, 7, 1, 3},
                                          {2, 2, 5, 2, 4}})
        for (const auto& [height, width] : {std::pair(32, 32), {4, 4}, {8, 8}, {7, 13}, {9, 64}, {65, 5}}) {
            if (height + 2 * shape.pad < shape.kernel || width + 2 * shape.pad < shape.kernel) continue;
            const auto weights =
                noise(size_t(shape.outputs * shape.inputs * shape.kernel * shape.kernel), ++seed);
            const auto bias = seed % 3 == 0 ? std::vector<float>() : noise(size_t(shape.outputs), ++seed);
            Convolution convolution(shape, weights.data(), bias.empty() ? nullptr : bias.data());
            for (const bool cut : {false, true, false}) {  // again: nothing of the last picture stays
                const auto in = noise(size_t(shape.inputs * height * width), ++seed);
                const auto expected = by_definition(shape, weights, bias, in, height, width, cut);
                convolution.prepare(height, width);
                std::vector<float> out(expected.size() + 1, 77.0f);
                convolution.run(in.data(), out.data(), cut);
                for (size_t i = 0; i < expected.size(); ++i)
                    ASSERT_NEAR(out[i], expected[i], 1e-5f)
                        << "kernel " << shape.kernel << " stride " << shape.stride << " pad " << shape.pad
                        << " at " << height << " x " << width << ", value " << i;
                EXPECT_EQ(out.back(), 77.0f) << "nothing is written past the end";
            }
        }
}

TEST(Convolution, TakesPicturesOfAnotherSize) {
    const ConvolutionShape shape{2, 4, 3, 2, 1};
    const auto weights = noise(72, 1), bias = noise(4, 2);
    Convolution convolution(shape, weights.data(), bias.data());
    for (const int side : {16, 5, 40, 16}) {
        const auto in = noise(size_t(2 * side * side), uint32_t(side));
        const auto expected = by_definition(shape, weights, bias, in, side, side, true);
        convolution.prepare(side, side);
        std::vector<float> out(expected.size());
        convolution.run(in.data(), out.data(), true);
        for (size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(out[i], expected[i], 1e-5f) << side;
    }
}

TEST(ConvolutionLayer, GivesTheSkeletonNetworkTheSameAnswers) {
    cv::dnn::Net own = read_network(kWeights), theirs = cv::dnn::readNetFromONNX(kWeights);
    EXPECT_EQ(count_theirs(own), 0);
    EXPECT_GT(count_theirs(theirs), 10);
    const std::vector<cv::String> outputs = {"maps", "answers"};
    for (int i = 0; i < 3; ++i) {
        const int shape[] = {1, 1, 128, 128};
        auto crop = noise(128 * 128, uint32_t(i));
        std::vector<cv::Mat> a, b;
        own.setInput(cv::Mat(4, shape, CV_32F, crop.data()), "crop");
        own.forward(a, outputs);
        theirs.setInput(cv::Mat(4, shape, CV_32F, crop.data()), "crop");
        theirs.forward(b, outputs);
        for (size_t k = 0; k < outputs.size(); ++k) {
            ASSERT_EQ(a[k].total(), b[k].total());
            for (size_t n = 0; n < a[k].total(); ++n)
                ASSERT_NEAR(a[k].ptr<float>()[n], b[k].ptr<float>()[n], 1e-3f);
        }
    }
}

// OpenCV 4.7 and later cast layers of that type to their own class without a check, and crash on another one.
TEST(ConvolutionLayer, IsNotOfTheTypeThatOpenCvCasts) {
    cv::dnn::Net own = read_network(kWeights);
    for (const cv::String& name : own.getLayerNames())
        EXPECT_NE(own.getLayer(own.getLayerId(name))->type, "Convolution") << name;
}

TEST(ConvolutionLayer, LeavesTheNetworksOfOthersAlone) {
    {
        const UseOwnConvolution use;
        int theirs = 0;
        std::thread([&] { theirs = count_theirs(cv::dnn::readNetFromONNX(kWeights)); }).join();
        EXPECT_GT(theirs, 10) << "another thread's, meanwhile";
    }
    EXPECT_GT(count_theirs(cv::dnn::readNetFromONNX(kWeights)), 10) << "afterwards";
}

TEST(ConvolutionLayer, RefusesPicturesSmallerThanItsKernel) {
    cv::dnn::LayerParams params;
    params.name = "convolution";
    params.set("num_output", 1);
    params.set("kernel_size", 5);
    params.set("bias_term", false);
    const int kernel[] = {1, 1, 5, 5};
    params.blobs.push_back(cv::Mat(4, kernel, CV_32F, 0.5f));
    const UseOwnConvolution use;
    const auto layer = cv::dnn::LayerFactory::createLayerInstance("Convolution", params);
    std::vector<cv::dnn::MatShape> outputs, internals;
    EXPECT_THROW(layer->getMemoryShapes({{1, 1, 4, 9}}, 1, outputs, internals), cv::Exception);
    EXPECT_THROW(layer->getMemoryShapes({{1, 2, 9, 9}}, 1, outputs, internals), cv::Exception);
    layer->getMemoryShapes({{1, 1, 5, 9}}, 1, outputs, internals);
    EXPECT_EQ(outputs.at(0), (cv::dnn::MatShape{1, 1, 1, 5}));
}

TEST(ConvolutionLayer, LeavesWhatItCannotDoToOpenCv) {
    const auto layer_of = [](const std::function<void(cv::dnn::LayerParams&)>& change) {
        cv::dnn::LayerParams params;
        params.type = "Convolution";
        params.name = "convolution";
        params.set("num_output", 4);
        params.set("kernel_size", 3);
        params.set("pad", 1);
        params.set("bias_term", false);
        const int shape[] = {4, 4, 3, 3};
        params.blobs.push_back(cv::Mat(4, shape, CV_32F, 0.5f));
        change(params);
        const UseOwnConvolution use;
        return cv::dnn::LayerFactory::createLayerInstance("Convolution", params);
    };
    const auto theirs = [](const cv::Ptr<cv::dnn::Layer>& layer) {
        return !layer.dynamicCast<cv::dnn::BaseConvolutionLayer>().empty();
    };
    EXPECT_FALSE(theirs(layer_of([](auto&) {})));
    EXPECT_TRUE(theirs(layer_of([](auto& p) { p.set("dilation", 2); })));
    EXPECT_TRUE(theirs(layer_of([](auto& p) {
        p.set("group", 4);
        const int shape[] = {4, 1, 3, 3};
        p.blobs[0] = cv::Mat(4, shape, CV_32F, 0.5f);
    })));
    EXPECT_TRUE(theirs(layer_of([](auto& p) {
        p.set("stride_h", 1);
        p.set("stride_w", 2);
    })));
}

}  // namespace
}  // namespace vfit
