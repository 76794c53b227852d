// Where poses go beside standard output: a BVH file, and programs that take them by UDP.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "client/client.h"
#include "client/udp_sender.h"

namespace vfit::tools {

struct PoseOutputOptions {
    std::string bvh;          // a path
    std::string vmc, vrchat;  // HOST:PORT
    int bvh_rate_hz = 30;
};

class PoseOutputs {
public:
    /// Throws Failure for a path that cannot be written and a host that is not found, before the work begins.
    PoseOutputs(vfit_context context, const PoseOutputOptions& options);

    /// Packets leave at the pace of pose.time_ns: this waits where poses come faster, as from a file.
    void take(const vfit_pose& pose, const std::vector<vfit_bone>& bones);

    /// Writes the file.
    void finish();

private:
    struct Receiver {
        vfit_osc kind;
        std::unique_ptr<UdpSender> to;
    };
    void wait_for(int64_t since_first_ns);

    vfit_context context_;
    PoseOutputOptions options_;
    std::vector<Receiver> receivers_;
    std::vector<uint8_t> packet_;
    std::vector<vfit_pose> poses_;  // for the file
    std::vector<vfit_bone> bones_;
    bool begun_ = false;
    int64_t first_ns_ = 0;
    std::chrono::steady_clock::time_point start_;
};

}  // namespace vfit::tools
