// Lets a garment of one piece, sewn or modelled so, fall to rest on a body.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "cloth/fabric/fabric.h"
#include "cloth/fabric/fabric_library.h"
#include "cook/body/cook_body.h"
#include "core/jobs.h"
#include "math/types.h"

namespace vfit {

/// What a garment hangs on, by which it is moved up or down to a body of another height.
enum class HangsOn { shoulders, waist, nothing };

/// Flags, one a vertex, of what sleeves meet while they are sewn. They are sewn shut before the cap draws
/// them up the arm; fingers in their way would be sewn in.
std::vector<uint8_t> but_fingers(const CookBody& body);

struct DrapeReport {
    HangsOn hangs_on = HangsOn::nothing;
    float raised_m = 0.0f;
    float widest_seam_m = 0.0f;                       // before what it joins became one
    uint32_t skin_crossings = 0, self_crossings = 0;  // pairs of triangles, at rest
    std::string crossed_at;                           // where most of the skin's are: "left forearm"
    uint32_t crossings() const { return skin_crossings + self_crossings; }
    float strain_p99 = 0.0f;
    double seconds = 0.0;
};

struct Draped {
    std::vector<Vec3> positions;  // one a vertex
    std::vector<uint8_t>
        simulated;  // the same: 0 where the garment hangs on shoulders or waist and goes with the skin
    DrapeReport report;
};

struct DrapeSettings {
    float thickness_m = 0.004f;  // from skin to cloth
    std::function<void(const char* stage, const std::vector<Vec3>& panel_vertices)>
        watch;  // for pictures of the way
};

/// Cloth of one piece.
struct WholeCloth {
    std::span<const uint32_t> indices;
    std::span<const Vec2> cut;  // as FabricShape::cut
    const FabricMaterial* material;
};

/// Of its triangles.
float mean_side(const WholeCloth& cloth);
/// Whether it settles with its own layers kept apart: where triangles are small against a layer, contact
/// tangles small folds.
bool keeps_layers_apart(const WholeCloth& cloth, float thickness_m);

/// What a garment is held by until it lies at rest.
struct Hold {
    std::vector<uint8_t> of;  // flags, one a vertex; empty: nothing holds it
    std::vector<Vec3> at;     // where these are held, one a vertex; empty: where they are
    float slack_m = 0.005f;   // how far off that they may move
    float lowered_m = 0.0f;   // from there to where it is worn
    bool worn_by = true;      // it is worn by these, as by a waistband; else by what lies on the shoulders

    bool any() const;
    /// Each of these near its target, and all else no further from one than the way along the cloth:
    /// sub-steps are too few to carry a long skirt, which would hang to below the floor.
    void limit(FabricData& data) const;
    std::vector<Vec3> targets(const std::vector<Vec3>& places) const;
};

/// From those places to rest: first free, held by friction and a belt; then on what it hangs on, which from
/// now on goes with the skin. Fills the report's figures but for those of a placement, seams and time. watch
/// is called with one place a vertex.
Draped settle(const WholeCloth& cloth, std::vector<Vec3> places, const Hold& hold, const CookBody& body,
              const DrapeSettings& settings, Jobs& jobs);

}  // namespace vfit
