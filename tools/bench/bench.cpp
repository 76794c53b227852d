#include "bench/bench.h"

#include <algorithm>
#include <cmath>

#if defined(__linux__)
#include <sched.h>
#endif

namespace vfit::tools {

void pin_to_cores(unsigned count) {
#if defined(__linux__)
    cpu_set_t cores;
    CPU_ZERO(&cores);
    for (unsigned i = 0; i < count; ++i) CPU_SET(i, &cores);
    if (sched_setaffinity(0, sizeof cores, &cores) != 0) throw Failure("the thread cannot be pinned to a core");
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

Json Samples::json() const { return {{"median", quantile(0.5)}, {"p95", quantile(0.95)}, {"n", values_.size()}}; }

}  // namespace vfit::tools
