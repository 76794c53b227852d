#include "cook/draft/cut_line.h"

#include "core/error.h"

namespace vfit {

namespace {

constexpr float kSamePlace_m = 1e-5f;  // a hundredth of what a cutter's knife can follow

Vec2 reflected(const Vec2& p) { return {-p.x, p.y}; }

}  // namespace

CutLine& CutLine::add(const Vec2& to, PatternEdge edge, std::string label) {
    edge.label = std::move(label);
    pieces_.push_back({to, std::move(edge)});
    return *this;
}

CutLine& CutLine::line(const Vec2& to, std::string label) { return add(to, {}, std::move(label)); }

CutLine& CutLine::quadratic(const Vec2& control, const Vec2& to, std::string label) {
    PatternEdge edge;
    edge.curve = PatternEdge::Curve::quadratic;
    edge.control[0] = control;
    return add(to, std::move(edge), std::move(label));
}

CutLine& CutLine::cubic(const Vec2& first, const Vec2& second, const Vec2& to, std::string label) {
    PatternEdge edge;
    edge.curve = PatternEdge::Curve::cubic;
    edge.control[0] = first;
    edge.control[1] = second;
    return add(to, std::move(edge), std::move(label));
}

CutLine& CutLine::arc(float radius_m, bool turns_left, const Vec2& to, std::string label) {
    PatternEdge edge;
    edge.curve = PatternEdge::Curve::arc;
    edge.radius_m = radius_m;
    edge.turns_left = turns_left;
    return add(to, std::move(edge), std::move(label));
}

CutLine& CutLine::append(const CutLine& other) {
    pieces_.insert(pieces_.end(), other.pieces_.begin(), other.pieces_.end());
    return *this;
}

CutLine& CutLine::prefix(const std::string& words) {
    for (Piece& piece : pieces_) piece.edge.label = words + piece.edge.label;
    return *this;
}

CutLine CutLine::mirrored() const {
    CutLine out(reflected(end()));
    for (size_t i = pieces_.size(); i-- > 0;) {
        PatternEdge edge = pieces_[i].edge;
        // An arc is turned about twice, by the mirror and by going backwards: it keeps its sense.
        if (edge.curve == PatternEdge::Curve::cubic) std::swap(edge.control[0], edge.control[1]);
        for (Vec2& control : edge.control) control = reflected(control);
        out.pieces_.push_back({reflected(i == 0 ? start_ : pieces_[i - 1].to), std::move(edge)});
    }
    return out;
}

float CutLine::length(std::string_view label) const {
    Panel probe;
    float sum = 0.0f;
    Vec2 from = start_;
    for (const Piece& piece : pieces_) {
        if (piece.edge.label == label) {
            probe.corners = {from, piece.to};
            PatternEdge edge = piece.edge;
            edge.from = 0, edge.to = 1;
            sum += edge_length(probe, edge);
        }
        from = piece.to;
    }
    return sum;
}

Panel CutLine::panel(std::string name) const {
    Panel panel;
    panel.name = std::move(name);
    if (glm::distance(start_, end()) > kSamePlace_m)
        fail(VFIT_ERROR_DATA, "draft: panel ", panel.name, " is not closed");
    Vec2 from = start_;
    for (uint32_t i = 0; i < pieces_.size(); ++i) {
        PatternEdge edge = pieces_[i].edge;
        edge.from = i;
        edge.to = (i + 1) % uint32_t(pieces_.size());
        panel.corners.push_back(from);
        panel.edges.push_back(std::move(edge));
        from = pieces_[i].to;
    }
    return panel;
}

CutLine whole(CutLine left_half) {
    CutLine right = left_half.mirrored();
    return left_half.prefix("left ").append(right.prefix("right "));
}

CutLine closed_left(CutLine left_half) {
    const Vec2 start = left_half.mirrored().end();
    return left_half.line({-start.x, start.y}, "middle").prefix("left ");
}

}  // namespace vfit
