// Algorithm 4: mean and deviation of a quantity over the frames of a scan.
//
// A person who moves gives single frames that are plainly wrong (an arm before the trunk, a bent knee), which
// a plain mean takes in. Values further from the median than three robust deviations are left out: of
// normally scattered values, which the paper's mean is made for, that is one in 370.
#pragma once

#include <cstddef>
#include <vector>

namespace vfit {

struct Averaged {
    float mean = 0.0f;
    float deviation = 0.0f;  // of the kept values, as a sample; 0 for fewer than two
    size_t kept = 0;         // 0: there was no value
};

/// `values` is reordered.
Averaged average(std::vector<float>& values);

}  // namespace vfit
