// A sewing pattern: flat panels, where each is held about the body before it is sewn, and which of their
// edges are sewn together.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "math/types.h"

namespace vfit {

/// From one corner of a panel to another. Controls are places in the panel, as the corners are.
struct PatternEdge {
    enum class Curve : uint8_t { line, quadratic, cubic, arc };

    uint32_t from = 0, to = 0;  // corners
    Curve curve = Curve::line;
    Vec2 control[2]{};        // of a quadratic Bezier curve the first, of a cubic one both
    float radius_m = 0.0f;    // of an arc
    bool large_arc = false;   // the longer way round
    bool turns_left = false;  // an arc that goes counter-clockwise about its centre
    std::string label;
};

/// Edges in the order in which they go round, each beginning at the corner at which the one before ends. The
/// side of the panel from which they run counter-clockwise is the garment's outside.
struct Panel {
    std::string name;
    std::vector<Vec2> corners;  // metres; x along the weft, y up along the warp
    std::vector<PatternEdge> edges;
    // Place in world space: rotation * (x, y, 0) + translation; metres, Y up, the body faces +Z, its left is
    // +X.
    Quat rotation{1, 0, 0, 0};
    Vec3 translation{0.0f};
    std::string material;  // name of a material of the pattern's; empty: the first
};

struct EdgeName {
    uint32_t panel = 0, edge = 0;
    bool operator==(const EdgeName&) const = default;
};

/// Two edges that are sewn together, each over its whole length: the begin of one to the end of the other, so
/// that both panels show their outside to the same side.
struct Stitch {
    EdgeName a, b;
    bool turned = false;  // begin to begin: one panel shows its inside
};

/// How a part of the garment looks; passed through to whoever draws it.
struct PatternMaterial {
    std::string name,
        texture;  // texture: path of a picture, relative to the file that names it; may be empty
    float color[3] = {0.8f, 0.8f, 0.8f};
};

struct Pattern {
    std::string name;
    // Mean height above the soles at which the upper border of a garment that hangs on the waist is worn;
    // none: the waist's.
    std::optional<float> worn_top_m;
    bool worn_as_placed = false;  // its panels stand where they are worn, on the body that it is made on
    std::vector<Panel> panels;
    std::vector<Stitch> stitches;
    std::vector<PatternMaterial> materials;

    /// "panel front, edge 3", for messages.
    std::string text(const EdgeName& edge) const;
};

/// Length along the edge, metres.
float edge_length(const Panel& panel, const PatternEdge& edge);
/// `count` + 1 places along the edge at even lengths, its two corners included.
std::vector<Vec2> sample_edge(const Panel& panel, const PatternEdge& edge, uint32_t count);

/// Finds what cannot be cut or sewn; VFIT_ERROR_DATA names the panel, edge or stitch: edges that make no
/// closed line, that cross each other, a panel of no area or larger than 8 m, numbers that are not finite,
/// stitches of edges that are not there or of one edge with itself, an edge that is sewn twice, lengths that
/// differ by more than fourfold.
void check_pattern(const Pattern& pattern);

}  // namespace vfit
