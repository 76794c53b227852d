#include "network/convolution_layer.h"

#include <algorithm>

#include <opencv2/dnn/all_layers.hpp>
#include <opencv2/dnn/layer.hpp>

#include "network/convolution.h"

namespace vfit {

namespace {

thread_local int own_wanted = 0;

class ConvolutionLayer final : public cv::dnn::Layer {
public:
    ConvolutionLayer(const cv::dnn::LayerParams& params, const ConvolutionShape& shape)
        : Layer(params),
          shape_(shape),
          convolution_(shape, blobs[0].ptr<float>(), blobs.size() > 1 ? blobs[1].ptr<float>() : nullptr) {
        // OpenCV 4.7 and later cast every layer of type "Convolution" to their own class without a check.
        type = "VfitConvolution";
    }

    bool getMemoryShapes(const std::vector<cv::dnn::MatShape>& inputs, int,
                         std::vector<cv::dnn::MatShape>& outputs,
                         std::vector<cv::dnn::MatShape>&) const override {
        const cv::dnn::MatShape& in = inputs.at(0);
        if (in.size() != 4 || in[1] != shape_.inputs)
            CV_Error(cv::Error::StsBadSize, name + ": its input has another shape");
        if (std::min(in[2], in[3]) + 2 * shape_.pad < shape_.kernel)
            CV_Error(cv::Error::StsBadSize, name + ": its input is smaller than its kernel");
        outputs.assign(1,
                       {in[0], shape_.outputs, convolution_.out_size(in[2]), convolution_.out_size(in[3])});
        return false;  // not in place
    }

    /// A ReLU that follows is done here.
    bool setActivation(const cv::Ptr<cv::dnn::ActivationLayer>& layer) override {
        const auto relu = layer.dynamicCast<cv::dnn::ReLULayer>();
        cut_ = relu && relu->negativeSlope == 0.0f;
        return cut_;
    }

    void finalize(cv::InputArrayOfArrays inputs, cv::OutputArrayOfArrays) override {
        std::vector<cv::Mat> in;
        inputs.getMatVector(in);
        convolution_.prepare(in.at(0).size[2], in.at(0).size[3]);
    }

    void forward(cv::InputArrayOfArrays inputs, cv::OutputArrayOfArrays outputs,
                 cv::OutputArrayOfArrays) override {
        std::vector<cv::Mat> in, out;
        inputs.getMatVector(in);
        outputs.getMatVector(out);
        for (int i = 0; i < in.at(0).size[0]; ++i)
            convolution_.run(in[0].ptr<float>(i), out.at(0).ptr<float>(i), cut_);
    }

private:
    const ConvolutionShape shape_;
    Convolution convolution_;
    bool cut_ = false;
};

bool all(const std::vector<size_t>& values, size_t value) {
    return values.size() == 2 && values[0] == value && values[1] == value;
}

/// OpenCV's own reads the parameters; where they say what vfit's can do, that takes its place.
cv::Ptr<cv::dnn::Layer> make(cv::dnn::LayerParams& params) {
    const cv::Ptr<cv::dnn::BaseConvolutionLayer> theirs = cv::dnn::ConvolutionLayer::create(params);
    if (own_wanted == 0 || theirs->kernel_size.empty() || theirs->strides.empty() ||
        theirs->pads_begin.empty())
        return theirs;
    const size_t kernel = theirs->kernel_size[0], stride = theirs->strides[0], pad = theirs->pads_begin[0];
    const auto& blobs = theirs->blobs;
    const bool fits = all(theirs->kernel_size, kernel) && all(theirs->strides, stride) &&
                      all(theirs->pads_begin, pad) && all(theirs->pads_end, pad) &&
                      all(theirs->dilations, 1) && theirs->padMode.empty() && kernel >= 1 && stride >= 1 &&
                      pad < kernel && params.get<int>("group", 1) == 1 && !blobs.empty() &&
                      blobs[0].dims == 4 && blobs[0].type() == CV_32F && blobs[0].isContinuous() &&
                      (blobs.size() == 1 || (blobs[1].type() == CV_32F && blobs[1].isContinuous() &&
                                             blobs[1].total() == size_t(blobs[0].size[0])));
    if (!fits) return theirs;
    return cv::makePtr<ConvolutionLayer>(
        params, ConvolutionShape{blobs[0].size[1], blobs[0].size[0], int(kernel), int(stride), int(pad)});
}

}  // namespace

cv::dnn::Net read_network(const std::string& path) {
    const UseOwnConvolution use;
    cv::dnn::Net net = cv::dnn::readNetFromONNX(path);
    // Layers are made when they are first asked for.
    for (const cv::String& name : net.getLayerNames()) net.getLayer(net.getLayerId(name));
    return net;
}

// The factory keeps a stack of makers for each kind of layer, and asks the last.
UseOwnConvolution::UseOwnConvolution() {
    cv::dnn::LayerFactory::registerLayer("Convolution", make);
    ++own_wanted;
}

UseOwnConvolution::~UseOwnConvolution() {
    --own_wanted;
    cv::dnn::LayerFactory::unregisterLayer("Convolution");
}

}  // namespace vfit
