// The character's skin that garments hide, which is left out of its file.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "avatar/character.h"
#include "avatar/character_body.h"
#include "core/jobs.h"
#include "refit/bound_cloth.h"

namespace vfit {

/// One a triangle of the character: below a garment, or left out before. Skin within margin_m of what is seen
/// stays, save where it pokes through the cloth.
std::vector<uint8_t> hidden_below(std::span<const BoundCloth> garments, const Character& character,
                                  const CharacterBody& body, std::span<const uint8_t> left_out,
                                  float margin_m, Jobs& jobs);

}  // namespace vfit
