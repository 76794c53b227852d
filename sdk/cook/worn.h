// What a garment goes round when it lies at rest.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "cook/body/cook_body.h"

namespace vfit {

/// Of "neck", "chest", "waist", "hips", "left leg", "right leg", "left arm", "right arm" those about which
/// cloth is met in nearly all directions; an open front may leave a gap.
std::vector<std::string> goes_round(std::span<const Vec3> places, std::span<const uint32_t> indices,
                                    const CookBody& body);

/// VFIT_ERROR_DATA where that is nothing, or not what the kind of garment goes round; kind may be empty.
void check_worn(const std::vector<std::string>& round, const std::string& kind);

/// "chest, waist and hips".
std::string listed(const std::vector<std::string>& words);

}  // namespace vfit
