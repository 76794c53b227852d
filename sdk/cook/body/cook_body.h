// The body that a garment is made on.
#pragma once

#include <array>
#include <vector>

#include "body/shape_setting.h"
#include "cook/body/body_outline.h"
#include "geometry/mesh_query.h"

namespace vfit {

/// How a body stands while a garment is put on.
struct Stance {
    float thickness = 1.0f;  // share about its bones; 0.2 at least: thinner, the skin would fold into itself
    bool legs_together = false;  // for skirts
    bool arms_level = false;     // for what has no sleeves
    bool is_rest() const { return thickness == 1.0f && !legs_together && !arms_level; }
};

class CookBody {
public:
    /// settings: empty: the default body of the sex. model must outlive this.
    CookBody(const BodyModel& model, vfit_sex sex, std::vector<ShapeSetting> settings);
    CookBody(const CookBody&) = delete;
    CookBody& operator=(const CookBody&) = delete;

    vfit_sex sex() const { return sex_; }
    const std::vector<ShapeSetting>& settings() const { return settings_; }
    const std::vector<Vec3>& positions() const { return evaluated_.positions; }
    const std::vector<uint32_t>& indices() const { return topology_.indices; }
    const std::vector<BodyPart>& parts() const { return topology_.parts; }  // one a vertex, or more
    const MeshQuery& skin() const { return skin_; }
    const BodyOutline& outline() const { return outline_; }
    Vec3 joint(int humanoid_bone) const;
    /// Its vertices on its way from a stance (0) to its own thickness and posture (1).
    std::vector<Vec3> leaving(const Stance& stance, float share) const;

private:
    const BodyModel& model_;
    vfit_sex sex_;
    std::vector<ShapeSetting> settings_;
    EvaluatedBody evaluated_;
    const BodyTopology& topology_;
    MeshQuery skin_;
    BodyOutline outline_;
    std::vector<Vec3> bones_;  // of each vertex, its place among the bones that carry it
    struct Limb {
        Vec3 root;       // joint
        float turn_rad;  // about Z, for legs together or arms level
        bool is_leg;
        std::vector<float> share;  // of it in each vertex
    };
    std::array<Limb, 4> limbs_;
};

}  // namespace vfit
