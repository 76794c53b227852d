// The blocks that garments are drafted from, each as the person's left half or left piece (cut_line.h), y = 0
// at the waist. VFIT_ERROR_DATA says what cannot be drawn. Edges that are sewn together come out equally
// long, by construction.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cook/draft/cut_line.h"
#include "cook/draft/draft.h"
#include "cook/draft/measures.h"

namespace vfit {

/// Part of a level on a left piece, to read a finished girth off; both sides of all pieces make up the girth.
struct GirthLine {
    std::string key;  // "chest_girth_m"
    float length_m = 0.0f;
};

/// Edges, in this order: "hem", "side skirt" (below the hips), "side hip", or, where it ends at the waist,
/// "waist 1" (, "dart a", "dart b", "waist 2"); then "side waist" (, "bust dart a", "bust dart b" of the
/// front), "side chest", "armhole", "shoulder", "neck". Halves, open along the middle.
struct TorsoBlock {
    CutLine front{Vec2(0.0f)}, back{Vec2(0.0f)};
    Vec2 shoulder_tip{0.0f};  // of the front
    std::vector<GirthLine> girths;
};
/// Widths of a quarter's waist that skirt or trousers ask for.
struct JoinedWaist {
    float front_m = 0.0f, back_m = 0.0f;
};
TorsoBlock draft_torso(const DraftMeasures& body, const TorsoDesign& design,
                       const std::optional<JoinedWaist>& joined);

/// Two pieces, before and behind the left arm, that meet along the top and the underside of the arm. Edges
/// "hem", "top", "cap", "under"; x = 0 along the top, y = 0 where the sleeve is widest.
struct SleeveBlock {
    CutLine front{Vec2(0.0f)}, back{Vec2(0.0f)};
    float cap_height_m = 0.0f, length_m = 0.0f;  // above and below y = 0
    float front_width_m = 0.0f, back_width_m = 0.0f, front_hem_m = 0.0f, back_hem_m = 0.0f;
};
SleeveBlock draft_sleeve(const DraftMeasures& body, const SleeveDesign& design, float front_armhole_m,
                         float back_armhole_m);

/// Edges "hem", "side skirt", "side hip", ("waist 2",) "waist 1". Halves, open along the middle.
struct SkirtBlock {
    CutLine front{Vec2(0.0f)}, back{Vec2(0.0f)};
    std::vector<GirthLine> girths;
};
/// Front and back have waist edges of those lengths, from the middle to the side.
SkirtBlock draft_skirt(const DraftMeasures& body, const SkirtDesign& design,
                       const std::vector<float>& front_waist_m, const std::vector<float>& back_waist_m);

/// The left leg's two pieces, closed. Edges "hem", "side shank", "side thigh", "side hip", ("waist 2", "dart
/// b", "dart a" of the back,) "waist 1", "middle", "crotch", "inseam thigh", "inseam shank".
struct TrousersBlock {
    CutLine front{Vec2(0.0f)}, back{Vec2(0.0f)};
    float top_m = 0.0f;  // the upper edge's height at the side, from the waist
    std::vector<float> front_waist_m,
        back_waist_m;  // lengths of the upper edges, from the middle to the side
    std::vector<GirthLine> girths;
};
/// `joined`: a torso is sewn on at the waist.
TrousersBlock draft_trousers(const DraftMeasures& body, const TrousersDesign& design, bool joined);

/// A strip above waist edges of those lengths: "waist 1" (, "waist 2"), "side", "top". A half, open along the
/// middle, y = 0 at its lower edge.
CutLine draft_band(const std::vector<float>& waist_m, float height_m, float gather);

/// A stand-up collar's half above a neckline of that length, narrower at the top: "neck", "side", "top".
CutLine draft_collar(float neck_m, float height_m);

}  // namespace vfit
