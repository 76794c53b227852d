// A garment taken in and let out at its seams, as a tailor does: a further size of its file.
#pragma once

#include <string>
#include <vector>

#include "client/client.h"

namespace vfit::tools {

/// By how much the cloth around the trunk becomes wider at a height of the body that the garment was made on;
/// between two heights as between them.
struct Widening {
    float height_m, factor;
};

/// The garment file (docs/garments.md) with one size more, called `as` (it replaces one that is called so):
/// that of `label` with each panel wider about its own middle. Sleeves stay. Throws Failure where the garment
/// has no flat panels or no such size.
Json altered(const Json& garment, const std::string& label, const std::string& as,
             const std::vector<Widening>& widenings);

}  // namespace vfit::tools
