// Algorithm 4: mean and deviation of a quantity over the frames of a scan.
//
// The paper takes the plain mean (kKeep). A person who moves gives single frames that are plainly wrong (an
// arm before the trunk, a bent knee), which a plain mean takes in. kLeaveOut drops values further from the
// median than three robust deviations: of normally scattered values, which the paper's mean is made for, one
// in 370.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vfit {

enum class Outliers : uint8_t { kKeep, kLeaveOut };

struct Averaged {
    float mean = 0.0f;
    float deviation = 0.0f;  // of the kept values, as a sample; 0 for fewer than two
    size_t kept = 0;         // 0: there was no value
};

/// `values` is reordered.
Averaged average(std::vector<float>& values, Outliers outliers = Outliers::kLeaveOut);

}  // namespace vfit
