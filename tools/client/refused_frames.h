// Why a scan took no frame: the reasons, counted.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "client/client.h"

namespace vfit::tools {

class RefusedFrames {
public:
    void add(vfit_guidance guidance) { ++counts_[guidance]; }

    /// The commonest first: "41 of 60 frames: the person is too far away; 19: no person is in view".
    std::string text() const;

private:
    std::map<vfit_guidance, uint32_t> counts_;
};

}  // namespace vfit::tools
