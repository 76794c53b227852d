// The outline of a pattern piece while it is drafted: a pen that goes round counter-clockwise and names each
// edge.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cook/pattern/pattern.h"

namespace vfit {

/// Drawn as the person's left half (x > 0), seen from the outside with the body facing the viewer: front and
/// back alike. Metres; y = 0 is the waist line, or the sleeve's widest line.
class CutLine {
public:
    explicit CutLine(const Vec2& start) : start_(start) {}

    CutLine& line(const Vec2& to, std::string label);
    CutLine& quadratic(const Vec2& control, const Vec2& to, std::string label);
    CutLine& cubic(const Vec2& first, const Vec2& second, const Vec2& to, std::string label);
    CutLine& arc(float radius_m, bool turns_left, const Vec2& to, std::string label);
    /// Goes on along the other line, which starts where this one ends.
    CutLine& append(const CutLine& other);
    /// Every label with these words before it.
    CutLine& prefix(const std::string& words);

    const Vec2& end() const { return pieces_.empty() ? start_ : pieces_.back().to; }
    /// The person's other side: reflected in x = 0, and gone along backwards so that it stays
    /// counter-clockwise.
    CutLine mirrored() const;
    /// The length of the edges of that label.
    float length(std::string_view label) const;
    /// VFIT_ERROR_DATA where the line does not end where it started.
    Panel panel(std::string name) const;

private:
    struct Piece {
        Vec2 to;
        PatternEdge edge;  // its corners are not known yet
    };
    CutLine& add(const Vec2& to, PatternEdge edge, std::string label);

    Vec2 start_;
    std::vector<Piece> pieces_;
};

/// A whole piece from its left half, which goes from the middle's lower end to its upper end: both halves,
/// with labels "left ..." and "right ...".
CutLine whole(CutLine left_half);
/// The left half closed along the middle by an edge "middle"; labels "left ...".
CutLine closed_left(CutLine left_half);

}  // namespace vfit
