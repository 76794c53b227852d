// The chance that a foot stands, from its features: a small network of three layers, learnt from virtual
// people who step, turn and jump (training/contacts).
#pragma once

#include <span>

#include "motion/contact_features.h"

namespace vfit {

/// 0..1
float chance_to_stand(std::span<const float, kContactFeatureCount> features);

}  // namespace vfit
