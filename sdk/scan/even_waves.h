// A function of direction that is the same half a turn on, as breadths are, from samples with gaps.
#pragma once

#include <span>

namespace vfit {

/// mean + first_cos cos 2a + first_sin sin 2a + second_cos cos 4a + second_sin sin 4a.
struct EvenWaves {
    float mean = 0.0f, first_cos = 0.0f, first_sin = 0.0f, second_cos = 0.0f, second_sin = 0.0f;
};

/// Of samples at equal steps over half a turn, NaN where there is none. The second wave is held low, as gaps
/// leave it open; samples that lie far from what the others say are left out. All NaN where fewer than a
/// third of the directions are known, or none within a quarter of a turn.
EvenWaves fit_even_waves(std::span<const float> samples);

}  // namespace vfit
