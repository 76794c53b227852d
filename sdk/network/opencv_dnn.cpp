// The network module by OpenCV's dnn.
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <vector>

#include <opencv2/dnn.hpp>

#include "network/convolution_layer.h"
#include "network/module.h"

namespace {

struct Network {
    cv::dnn::Net net;
    const std::vector<cv::String> outputs{"maps", "answers"};
    std::vector<cv::Mat> results;
};

void say(char* error, uint32_t capacity, const char* what) {
    // OpenCV's sentences end in a new line.
    if (error && capacity > 0) std::snprintf(error, capacity, "%.*s", int(std::strcspn(what, "\n")), what);
}

void* open_network(const char* path, char* error, uint32_t capacity) {
    try {
        auto network = std::make_unique<Network>();
        network->net = vfit::read_network(path);
        network->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
        network->net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
        return network.release();
    } catch (const std::exception& e) {
        say(error, capacity, e.what());
        return nullptr;
    }
}

void close_network(void* network) { delete static_cast<Network*>(network); }

bool copy(const cv::Mat& from, float* to, uint32_t count) {
    if (from.total() != count || from.type() != CV_32F || !from.isContinuous()) return false;
    std::memcpy(to, from.data, count * sizeof(float));
    return true;
}

int run_network(void* handle, const float* crop, uint32_t side, float* maps, uint32_t map_count,
                float* answers, uint32_t answer_count, char* error, uint32_t capacity) {
    try {
        auto& network = *static_cast<Network*>(handle);
        const int shape[] = {1, 1, int(side), int(side)};
        network.net.setInput(cv::Mat(4, shape, CV_32F, const_cast<float*>(crop)), "crop");
        network.net.forward(network.results, network.outputs);
        if (network.results.size() == 2 && copy(network.results[0], maps, map_count) &&
            copy(network.results[1], answers, answer_count))
            return 1;
        say(error, capacity, "its outputs have another shape than this version reads");
    } catch (const std::exception& e) {
        say(error, capacity, e.what());
    }
    return 0;
}

constexpr vfit_joint_network_table kTable = {VFIT_JOINT_NETWORK_VERSION, open_network, close_network,
                                             run_network};

}  // namespace

extern "C"
#if defined(_WIN32)
    __declspec(dllexport)
#else
    __attribute__((visibility("default")))
#endif
    const vfit_joint_network_table*
    vfit_joint_network(void) {
    return &kTable;
}
