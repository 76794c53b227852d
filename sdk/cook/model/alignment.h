// How a modelled garment comes to a body: in which unit it counts, which way is up, where it hangs, and how
// the body has to hold its limbs to be inside.
#pragma once

#include <string>
#include <vector>

#include "cook/body/cook_body.h"
#include "cook/model/pieces.h"
#include "cook/model/skeleton_probe.h"

namespace vfit {

enum class StandsBy { any, as_modelled, shoulders, waist };

struct AlignmentOptions {
    float unit_m = 1.0f;      // in which the file's numbers should count
    bool unit_told = false;   // else it may be another one
    float scale = 0.0f;       // told by hand; 0: not
    bool size_known = false;  // the pieces are as large as they will be
    StandsBy stands_by = StandsBy::any;
    std::string kind;  // told by hand; may be empty
    float thickness_m = 0.004f;
};

struct Alignment {
    float scale = 1.0f;  // of the pieces' metres
    Mat3 turn{1.0f};
    Vec3 moved{0.0f};  // after it
    Stance stance;     // of the limbs: of full thickness
    std::vector<std::string> notes;

    Vec3 place(const Vec3& p) const { return turn * (scale * p) + moved; }
};

/// A unit in which the numbers of a model are as large as a garment: the stated one if it may be;
/// where none is, that in which the model is a metre large. VFIT_ERROR_DATA where a told one makes it none.
float plausible_unit(const Model& model, float stated_m, bool told);

/// All pieces were modelled about one body. The way is taken in which its bones cross no cloth, and leave it
/// by openings; of several the one in which it lies closest to the body's own size, as it was written.
/// VFIT_ERROR_DATA says what is in the way where there is none.
Alignment align(const Pieces& pieces, const CookBody& body, const AlignmentOptions& options);

}  // namespace vfit
