// The garments that can be tried on, and their sizes.
#pragma once

#include <string>
#include <vector>

#include "abi.h"

namespace room {

inline constexpr const char* kMadeToMeasure = "made to measure";

struct Piece {
    std::string name, kind;
    std::string chart;               // that its labels follow; empty: the file states none
    std::vector<std::string> sizes;  // its labels; the last is kMadeToMeasure
    Garment garment;
};

class Wardrobe {
public:
    /// All garments of the data folder, or the named ones: names in that folder, or files. Throws Failure if
    /// there is none.
    Wardrobe(vfit_context context, const std::vector<std::string>& named);
    size_t count() const { return pieces_.size(); }
    const Piece& piece(size_t i) const { return pieces_[i]; }

private:
    std::vector<Piece> pieces_;
};

}  // namespace room
