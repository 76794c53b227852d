// Cloth that closes sleeves, legs or the neck of a garment: figures of games are modelled so, to hide that
// there is no body inside.
#pragma once

#include "cook/model/pieces.h"

namespace vfit {

/// Cuts it out: discs with a sharp edge all around, across the cloth that ends there. Returns how many.
size_t cut_caps(Soup& soup);

}  // namespace vfit
