#include "bench/bench.h"

#include <algorithm>
#include <cmath>

#if defined(__linux__)
#include <sched.h>
#endif

namespace vfit::tools {

void pin_to_cores(unsigned count) {
#if defined(__linux__)
    // A container may own any cores: core 0 need not be among them.
    cpu_set_t allowed, cores;
    CPU_ZERO(&cores);
    bool pinned = sched_getaffinity(0, sizeof allowed, &allowed) == 0;
    for (unsigned i = 0; pinned && i < CPU_SETSIZE && count > 0; ++i)
        if (CPU_ISSET(i, &allowed)) {
            CPU_SET(i, &cores);
            --count;
        }
    pinned = pinned && sched_setaffinity(0, sizeof cores, &cores) == 0;
    if (!pinned) throw Failure("the thread cannot be pinned to a core");
#else
    (void)count;
#endif
}

double Samples::quantile(double q) const {
    if (values_.empty()) return 0.0;
    std::vector<double> sorted = values_;
    std::sort(sorted.begin(), sorted.end());
    return sorted[static_cast<size_t>(std::lround(q * double(sorted.size() - 1)))];
}

Json Samples::json() const {
    return {{"median", quantile(0.5)}, {"p95", quantile(0.95)}, {"n", values_.size()}};
}

}  // namespace vfit::tools
