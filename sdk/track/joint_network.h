// The network that sees joints in a crop: weights from a file, run by the loadable module beside the library.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/platform.h"
#include "frame/body.h"
#include "network/module.h"
#include "track/crop.h"

namespace vfit {

/// What the network says about one crop.
struct JointMaps {
    static constexpr int kSide = 32;
    static constexpr int kCells = kSide * kSide;
    /// Crop coordinate, -1 to 1, of the middle of a cell's column or row.
    static float place_of(int cell) { return (float(cell) + 0.5f) / (0.5f * kSide) - 1.0f; }
    std::array<float, size_t(kJointCount) * kCells> heat;   // logits, one map a joint
    std::array<float, size_t(kJointCount) * kCells> depth;  // crop z
    float away, person;  // logits: faces away from the sensor; is a person at all
};

class JointNetwork {
public:
    /// VFIT_ERROR_UNSUPPORTED where the module is not there, VFIT_ERROR_DATA where the weights cannot be
    /// used; both name the file.
    JointNetwork(const std::string& module_path, const std::string& weights_path);
    ~JointNetwork();
    JointNetwork(const JointNetwork&) = delete;
    JointNetwork& operator=(const JointNetwork&) = delete;

    /// `crop`: CropView::kPixels squared values.
    void run(const float* crop, JointMaps& out);

private:
    const std::string weights_path_;
    std::unique_ptr<DynamicLibrary> library_;
    const vfit_joint_network_table* table_ = nullptr;
    void* network_ = nullptr;
    std::vector<float> maps_;
};

}  // namespace vfit
