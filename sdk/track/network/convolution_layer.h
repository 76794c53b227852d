// vfit's convolution as a layer of OpenCV's dnn.
#pragma once

namespace vfit {

/// While one lives, networks that this thread reads or runs for the first time get vfit's convolution where it fits;
/// those of other threads get OpenCV's own as ever.
class UseOwnConvolution {
public:
    UseOwnConvolution();
    ~UseOwnConvolution();
    UseOwnConvolution(const UseOwnConvolution&) = delete;
    UseOwnConvolution& operator=(const UseOwnConvolution&) = delete;
};

}  // namespace vfit
