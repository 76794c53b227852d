#include "client/refused_frames.h"

#include <algorithm>
#include <vector>

#include "client/people.h"

namespace vfit::tools {

std::string RefusedFrames::text() const {
    std::vector<std::pair<vfit_guidance, uint32_t>> reasons(counts_.begin(), counts_.end());
    std::stable_sort(reasons.begin(), reasons.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    uint32_t all = 0;
    for (const auto& [guidance, count] : reasons) all += count;
    std::string out;
    for (const auto& [guidance, count] : reasons) {
        out += out.empty() ? std::to_string(count) + " of " + std::to_string(all) + " frames: "
                           : "; " + std::to_string(count) + ": ";
        out += guidance_text(guidance);
    }
    return out;
}

}  // namespace vfit::tools
