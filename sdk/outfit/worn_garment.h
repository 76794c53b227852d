// A garment worn on an avatar: in a size, over the body, stepped with all that it is worn over and under,
// reskinned and judged.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/garment/dress.h"
#include "core/jobs.h"
#include "outfit/body_jump.h"
#include "outfit/body_obstacles.h"
#include "outfit/cloth_piece.h"
#include "outfit/finished_step.h"
#include "outfit/garment_fit.h"
#include "outfit/props_met.h"
#include "outfit/size_choice.h"
#include "outfit/skin_press.h"
#include "outfit/wear_options.h"
#include "outfit/wearable_garment.h"
#include "outfit/wearer.h"
#include "outfit/worn_cloth.h"

namespace vfit {

/// One thread at a time for all garments that share a cloth. What moves it is in WornTogether. While a step
/// of that runs, finished(), reskin(), shown_surface() and teleport() may be called beside it, and nothing
/// else.
class WornGarment {
public:
    /// In the avatar's pose, as its bones carry it, at once. VFIT_ERROR_NOT_WEARABLE for a size that is too
    /// small, unless options.any_fit. All three must outlive this.
    WornGarment(const WearableGarment& garment, const Wearer& wearer, const WearOptions& options, Jobs& jobs);
    WornGarment(const WornGarment&) = delete;
    WornGarment& operator=(const WornGarment&) = delete;

    /// It is worn over that one, or over one that is.
    bool reaches(const WornGarment& below) const;
    /// That it is worn over.
    std::span<const WornGarment* const> below() const { return below_; }
    bool shares_cloth_with(const WornGarment& other) const { return cloth_ == other.cloth_; }

    /// From the next step on this stays outside of a prop, which must outlive that. False: it did so before.
    bool meet(const Prop& prop) { return props_.add(prop, piece()); }
    /// No longer. False: it did not.
    bool pass(const Prop& prop) { return props_.remove(prop, piece()); }
    const PropsMet& props() const { return props_; }

    /// Keeps what a step of WornTogether left.
    void end_step() { keep_step(); }

    /// The next step of more than 0 s is a jump, however slow it is, of all that share the cloth.
    void teleport() { jumps_ = true; }

    /// The same garment in another size, not worn yet.
    struct Resized {
        SizeLabel label;
        bool has_own_lengths;
        std::vector<Vec2> cut;
        TakenUp taken_up;
        std::shared_ptr<const Fabric> fabric;
        Cloth cloth;  // that is shared
    };
    /// VFIT_ERROR_ARGUMENT for a label that the garment lacks, VFIT_ERROR_NOT_WEARABLE for a size that does
    /// not close around the body.
    Resized in_size(const SizeLabel& label) const;

    /// From the next step on. Both are of the cloth: to be said of all garments that share it.
    void set_wind(const Vec3& wind_m_s);
    void set_quality(uint32_t substeps, float budget_ms);

    const FinishedStep& finished() const { return finished_; }
    /// The avatar has still the pose of the last finished step.
    bool stands_in_pose() const;
    /// The last finished step, in the avatar's pose.
    FinishedStep::Reskinned reskin();
    /// The mesh as it is shown, to press skin below it. Valid until the next step or reskin().
    PressingCloth shown_surface();

    /// How the last finished step sits at a girth of the trunk, less what it sags by.
    struct ZoneFit {
        GirthFit girth;
        Fit verdict;
    };
    std::vector<ZoneFit> fit() const;
    /// The same vertex by vertex (tightness_of).
    std::vector<float> tightness() const;
    /// One a triangle of the body: hidden by this garment, and all skin nearer than margin_m.
    std::vector<uint8_t> hidden_skin(float margin_m) const;

    const Wearer& wearer() const { return wearer_; }
    const Garment& garment() const { return garment_.garment(); }
    const Dress& dress() const { return dress_; }
    ClothPiece piece() const { return {cloth_->cloth, piece_}; }
    std::span<const Vec3> positions() const { return piece().positions(); }
    ClothStats stats() const { return piece().stats(); }
    uint64_t state_hash() const { return piece().state_hash(); }
    const TakenUp& taken_up() const { return taken_up_; }
    size_t collider_count() const { return colliders_.size(); }

private:
    friend class WornTogether;

    WornGarment(const WearableGarment& garment, const Wearer& wearer, const WearOptions& options,
                const SizeChoice& size, Jobs& jobs);
    std::vector<Vec2> closing_cut(const SizeLabel& label, const SizeChoice& size) const;
    std::span<const Mat4> avatar_pose() const { return wearer_.avatar().skinning_matrices(); }
    const std::vector<Vec3>& place_in_pose();
    void place_on_the_way(std::span<const Mat4> matrices);
    void stand();
    bool take_pose(float dt);
    void meet_props();
    float room_for_cloth_m() const;
    void keep_below(std::span<WornGarment* const> worn);
    void hold_further_off(std::span<const Vec3> outside);
    void keep_step();
    UnposedGarment unposed(std::span<const Vec3> positions) const;

    const WearableGarment& garment_;
    const Wearer& wearer_;
    Jobs& jobs_;
    ClothSettings settings_;
    const bool any_fit_;
    SizeLabel size_;
    Dress dress_;
    TakenUp taken_up_;
    std::vector<Vec2> cut_;  // of the size, one place an index

    BodyJump body_;
    BodyObstacles obstacles_;
    std::vector<const WornGarment*> below_;
    std::vector<float> held_off_m_;  // by garments below, off the body; one a vertex
    PropsMet props_;
    Dress::Scratch scratch_;
    std::vector<Vec3> targets_;
    std::vector<Collider> colliders_;  // that it meets
    std::shared_ptr<WornCloth> cloth_;
    size_t piece_ = 0;  // of that

    bool jumps_ = false;                              // in the next step, however slow it is
    float speed_m_s_ = 0.0f, limb_speed_m_s_ = 0.0f;  // of the body, and of its fastest limb, in the last
                                                      // step; 0: it jumped
    // Of the step that has begun, or of the last one.
    float dt_ = 0.0f;
    float carried_ = 0.0f;  // fraction of the body's motion that the cloth does not feel
    Mat4 root_before_{1.0f};
    std::vector<Mat4> pose_;  // skinning matrices
    int64_t time_ns_ = 0;
    FinishedStep finished_;
    std::optional<TriangleGroups> surface_;  // made when first asked for
};

}  // namespace vfit
