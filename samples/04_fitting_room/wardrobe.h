// The garments that can be tried on, and their sizes.
#pragma once

#include <string>
#include <vector>

#include "abi.h"

namespace room {

inline constexpr const char* kMadeToMeasure = "made to measure";

struct Piece {
    std::string name, kind;
    std::vector<std::string> sizes;  // its labels; the last is kMadeToMeasure
    Garment garment;
};

class Wardrobe {
public:
    /// All garments of the data folder, or those named: names of that folder, or files. Throws Failure where
    /// there is none.
    Wardrobe(vfit_context context, const std::string& data_dir, const std::vector<std::string>& named);
    size_t count() const { return pieces_.size(); }
    const Piece& piece(size_t i) const { return pieces_[i]; }

private:
    std::vector<Piece> pieces_;
};

/// The folder that the library takes its data from when it is not told: vfit_data beside it.
std::string usual_data_dir();

}  // namespace room
