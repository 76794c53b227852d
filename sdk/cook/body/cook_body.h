// The body that a garment is made on.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "body/shape_setting.h"
#include "cook/body/body_outline.h"
#include "geometry/mesh_query.h"

namespace vfit {

/// "left forearm".
const char* part_name(BodyPart part);

/// What turns about a joint; those that hang on another one stand before it.
enum class Limb : uint8_t {
    left_shank,
    right_shank,
    left_forearm,
    right_forearm,
    left_leg,
    right_leg,
    left_arm,
    right_arm,
};
inline constexpr size_t kLimbs = 8;

/// How a body stands while a garment is put on.
struct Stance {
    float thickness;  // share about its bones; 0.2 at least: thinner, the skin would fold into itself
    // Of each limb about its root, from the body's own posture; a limb that hangs on another turns first.
    std::array<Quat, kLimbs> turned;
    explicit Stance(float thick = 1.0f) : thickness(thick) { turned.fill(Quat(1, 0, 0, 0)); }
    Quat& of(Limb limb) { return turned[size_t(limb)]; }
    const Quat& of(Limb limb) const { return turned[size_t(limb)]; }
    bool is_rest() const;
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
    /// The joint where that limb begins, and its elbow, wrist, knee or ankle where it ends.
    const Vec3& root(Limb limb) const { return limbs_[size_t(limb)].root; }
    const Vec3& end(Limb limb) const { return limbs_[size_t(limb)].end; }
    /// The limb that it hangs on: of forearms and shanks.
    static std::optional<Limb> parent(Limb limb) {
        return limb < Limb::left_leg ? std::optional(Limb(uint8_t(limb) + 4)) : std::nullopt;
    }
    /// Its vertices on its way from a stance (0) to its own thickness and posture (1).
    std::vector<Vec3> leaving(const Stance& stance, float share) const;
    /// Where a place of the body's own posture is in a stance, carried by that limb.
    Vec3 carried(const Stance& stance, Limb limb, const Vec3& place) const;
    void put_legs_together(Stance& stance) const;  // for skirts
    void hold_arms_level(Stance& stance) const;    // for what has no sleeves

private:
    const BodyModel& model_;
    vfit_sex sex_;
    std::vector<ShapeSetting> settings_;
    EvaluatedBody evaluated_;
    const BodyTopology& topology_;
    MeshQuery skin_;
    BodyOutline outline_;
    std::vector<Vec3> bones_;  // of each vertex, its place among the bones that carry it
    struct LimbSkin {
        Vec3 root, end;
        std::vector<float> share;  // of it in each vertex
    };
    std::array<LimbSkin, kLimbs> limbs_;
};

}  // namespace vfit
