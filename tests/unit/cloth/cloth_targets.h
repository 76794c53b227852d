// Runs a test on each instruction set of the machine.
#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <random>

#include "math/types.h"

namespace vfit::test {

template <typename Test>
void on_each_target(const Test& test) {
    const int64_t all = hwy::SupportedTargets();
    for (int64_t left = all; left; left &= left - 1) {
        const int64_t target = left & -left;
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        SCOPED_TRACE(hwy::TargetName(target));
        test();
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

inline Vec3 random_point(std::mt19937& random, float size) {
    std::uniform_real_distribution<float> u(-size, size);
    return {u(random), u(random), u(random)};
}

}  // namespace vfit::test
