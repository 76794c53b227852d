#include "track/joint_network.h"

#include <algorithm>

#include "core/error.h"

namespace vfit {

JointNetwork::JointNetwork(const std::string& module_path, const std::string& weights_path)
    : weights_path_(weights_path), maps_(2 * size_t(kJointCount) * JointMaps::kCells) {
    library_ = std::make_unique<DynamicLibrary>(module_path);
    const auto get = reinterpret_cast<vfit_joint_network_fn>(library_->symbol("vfit_joint_network"));
    if (!get) fail(VFIT_ERROR_PLUGIN, module_path, ": exports no vfit_joint_network");
    table_ = get();
    if (!table_ || table_->version != VFIT_JOINT_NETWORK_VERSION)
        fail(VFIT_ERROR_VERSION, module_path, ": is of another version of vfit");
    char why[512] = "";
    network_ = table_->open(weights_path.c_str(), why, sizeof why);
    if (!network_) fail(VFIT_ERROR_DATA, weights_path, ": ", why);
}

JointNetwork::~JointNetwork() {
    if (network_) table_->close(network_);
}

void JointNetwork::run(const float* crop, JointMaps& out) {
    char why[512] = "";
    float answers[2];
    if (!table_->run(network_, crop, CropView::kPixels, maps_.data(), uint32_t(maps_.size()), answers, 2, why,
                     sizeof why))
        fail(VFIT_ERROR_DATA, weights_path_, ": ", why);
    std::copy_n(maps_.begin(), out.heat.size(), out.heat.begin());
    std::copy_n(maps_.begin() + std::ptrdiff_t(out.heat.size()), out.depth.size(), out.depth.begin());
    out.away = answers[0], out.person = answers[1];
}

}  // namespace vfit
