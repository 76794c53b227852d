#include "math/simd.h"

#include <hwy/targets.h>

namespace vfit {

const char* simd_level() {
    // Better targets have lower bits.
    const int64_t supported = hwy::SupportedTargets();
    return hwy::TargetName(supported & -supported);
}

}  // namespace vfit
