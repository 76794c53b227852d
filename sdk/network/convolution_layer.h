// vfit's convolution as a layer of OpenCV's dnn.
#pragma once

#include <string>

#include <opencv2/dnn.hpp>

namespace vfit {

/// An ONNX network whose convolutions are vfit's where they fit. Throws what OpenCV throws.
cv::dnn::Net read_network(const std::string& path);

/// While one lives, layers that this thread makes are vfit's convolution where it fits; those of other
/// threads are OpenCV's own as ever.
class UseOwnConvolution {
public:
    UseOwnConvolution();
    ~UseOwnConvolution();
    UseOwnConvolution(const UseOwnConvolution&) = delete;
    UseOwnConvolution& operator=(const UseOwnConvolution&) = delete;
};

}  // namespace vfit
