// Which instruction set the SIMD code paths run on, chosen when the program starts (Highway).
#pragma once

namespace vfit {

/// "AVX2", "SSE4", "EMU128" (scalar), ...
const char* simd_level();

}  // namespace vfit
