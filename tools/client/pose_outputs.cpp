#include "client/pose_outputs.h"

#include <filesystem>
#include <fstream>
#include <thread>

#include "client/files.h"

namespace vfit::tools {

namespace {

constexpr uint32_t kPacketBytes = 2048;  // vfit.h: a packet is no larger

/// The file is left as it is until the motion is known.
void check_writable(const std::string& path) {
    std::error_code error;
    const bool was_there = std::filesystem::exists(path, error);
    if (!std::ofstream(path, std::ios::binary | std::ios::app)) throw Failure(path + ": cannot be written");
    if (!was_there) std::filesystem::remove(path, error);
}

}  // namespace

PoseOutputs::PoseOutputs(vfit_context context, const PoseOutputOptions& options)
    : context_(context), options_(options), packet_(kPacketBytes) {
    if (!options.bvh.empty()) check_writable(options.bvh);
    if (!options.vmc.empty()) receivers_.push_back({VFIT_OSC_VMC, std::make_unique<UdpSender>(options.vmc)});
    if (!options.vrchat.empty())
        receivers_.push_back({VFIT_OSC_VRCHAT, std::make_unique<UdpSender>(options.vrchat)});
}

void PoseOutputs::wait_for(int64_t since_first_ns) {
    std::this_thread::sleep_until(start_ + std::chrono::nanoseconds(since_first_ns));
}

void PoseOutputs::take(const vfit_pose& pose, const std::vector<vfit_bone>& bones) {
    if (!begun_) {
        begun_ = true;
        first_ns_ = pose.time_ns;
        start_ = std::chrono::steady_clock::now();
    }
    if (!options_.bvh.empty()) {
        poses_.push_back(pose);
        bones_.insert(bones_.end(), bones.begin(), bones.end());
    }
    if (receivers_.empty()) return;
    // Times count from the first pose: the protocols have floats, which would not tell frames of a camera
    // that has run for days apart.
    vfit_pose sent = pose;
    sent.time_ns = pose.time_ns - first_ns_;
    wait_for(sent.time_ns);
    for (const Receiver& receiver : receivers_) {
        uint32_t size = kPacketBytes;
        check(vfit_pose_osc(context_, &sent, bones.data(), sizeof(vfit_bone), uint32_t(bones.size()),
                            receiver.kind, packet_.data(), &size));
        receiver.to->send({packet_.data(), size});
    }
}

void PoseOutputs::finish() {
    if (options_.bvh.empty()) return;
    if (poses_.empty()) throw Failure(options_.bvh + ": not written, as no person was seen");
    const auto write = [&](char* text, uint32_t* capacity) {
        return vfit_pose_bvh(context_, poses_.data(), sizeof(vfit_pose), uint32_t(poses_.size()),
                             bones_.data(), sizeof(vfit_bone), uint32_t(bones_.size()),
                             1.0f / float(options_.bvh_rate_hz), text, capacity);
    };
    uint32_t capacity = 0;
    check(write(nullptr, &capacity));
    std::string text(capacity, '\0');
    check(write(text.data(), &capacity));
    text.resize(capacity - 1);
    write_text(options_.bvh, text);
}

}  // namespace vfit::tools
