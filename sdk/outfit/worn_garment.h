// A garment worn on an avatar: in a size, over the body and the layers below, put on, stepped, reskinned and
// judged.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/garment/dress.h"
#include "core/jobs.h"
#include "outfit/body_jump.h"
#include "outfit/body_obstacles.h"
#include "outfit/finished_step.h"
#include "outfit/garment_fit.h"
#include "outfit/layers_below.h"
#include "outfit/props_met.h"
#include "outfit/size_choice.h"
#include "outfit/skin_press.h"
#include "outfit/wear_options.h"
#include "outfit/wearable_garment.h"
#include "outfit/wearer.h"

namespace vfit {

/// One thread at a time. While a call lasts, the avatar must not be posed; a step alone, between begin_step
/// and end_step, takes nothing from outside and may run on another thread. Until then, finished(), reskin(),
/// shown_surface() and teleport() may be called beside it, and nothing else.
class WornGarment {
public:
    /// In the avatar's pose, as its bones carry it, at once. VFIT_ERROR_NOT_WEARABLE for a size that is too
    /// small, unless options.any_fit. All three must outlive this.
    WornGarment(const WearableGarment& garment, const Wearer& wearer, const WearOptions& options, Jobs& jobs);
    WornGarment(const WornGarment&) = delete;
    WornGarment& operator=(const WornGarment&) = delete;

    /// From now on this does not cross inner, a garment of the same wearer, which must outlive this. False:
    /// it did so before. VFIT_ERROR_ARGUMENT where inner is this, or is worn over this. Nothing may change
    /// inner and the layers below it meanwhile.
    bool wear_over(const WornGarment& inner);
    /// After wear_over() and see_layer(): out of that layer, which may go through this, in the avatar's pose.
    /// VFIT_ERROR_NOT_WEARABLE where that reaches too far beyond it: then this is carried into the pose, and
    /// not worn over it.
    void come_outside_of_last_layer();
    const LayersBelow& layers() const { return layers_; }
    /// A layer has been stepped to there, one position a vertex: before each step, put_on and change_to.
    void see_layer(size_t layer, std::span<const Vec3> positions) { layers_.see(layer, positions); }

    /// From the next step on this stays outside of a prop, which must outlive that. False: it did so before.
    bool meet(const Prop& prop) { return props_.add(prop, cloth_); }
    /// No longer. False: it did not.
    bool pass(const Prop& prop) { return props_.remove(prop, cloth_); }
    const PropsMet& props() const { return props_; }

    /// Takes the avatar's pose, the props and the layers, dt after those of the last step. 0: nothing moves.
    void begin_step(float dt);
    void step();
    void end_step() { keep_step(); }
    /// The next step of more than 0 s is a jump, however slow it is.
    void teleport() { jumps_ = true; }

    /// On a body that stands straight, outside of the layers, and goes into the avatar's pose. Ends at rest.
    void put_on();

    /// The same garment in another size, not worn yet.
    struct Resized {
        SizeLabel label;
        bool has_own_lengths;
        std::vector<Vec2> cut;
        TakenUp taken_up;
        Cloth cloth;
    };
    /// VFIT_ERROR_ARGUMENT for a label that the garment lacks, VFIT_ERROR_NOT_WEARABLE for a size that does
    /// not close around the body.
    Resized in_size(const SizeLabel& label) const;
    /// From how it hangs now, in the avatar's pose. VFIT_ERROR_NOT_WEARABLE, and nothing changes, where it
    /// is stretched too far there.
    void change_to(Resized resized);

    /// From the next step on.
    void set_wind(const Vec3& wind_m_s);
    void set_quality(uint32_t substeps, float budget_ms) { cloth_.set_quality(substeps, budget_ms); }

    const FinishedStep& finished() const { return finished_; }
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
    const std::vector<Vec3>& positions() const { return cloth_.positions(); }
    ClothStats stats() const { return cloth_.stats(); }
    uint64_t state_hash() const { return cloth_.state_hash(); }
    const TakenUp& taken_up() const { return taken_up_; }
    size_t collider_count() const { return colliders_.size(); }

private:
    WornGarment(const WearableGarment& garment, const Wearer& wearer, const WearOptions& options,
                const SizeChoice& size, Jobs& jobs);
    std::vector<Vec2> closing_cut(const SizeLabel& label, const SizeChoice& size) const;
    std::span<const Mat4> avatar_pose() const { return wearer_.avatar().skinning_matrices(); }
    const std::vector<Vec3>& place_in_pose();
    void place_on_the_way(std::span<const Mat4> matrices, std::vector<Vec3>& targets,
                          std::vector<Collider>& colliders);
    void stand();
    float room_for_cloth_m() const;
    void carry_along(float fraction);
    void jump_to_pose();
    void start_with_legs_apart();
    void come_to_lengths(bool is_new);
    void check_stretch(const std::string& label, std::span<const Vec2> cut);
    void check_reach(std::span<const Vec3> outside);
    void hold_further_off(std::span<const Vec3> outside);
    void move_outside(std::vector<Vec3>& places, std::span<const Mat4> matrices, size_t first);
    void keep_step();
    UnposedGarment unposed(std::span<const Vec3> positions) const;

    const WearableGarment& garment_;
    const Wearer& wearer_;
    Jobs& jobs_;
    const ClothSettings settings_;
    const bool any_fit_;
    SizeLabel size_;
    Dress dress_;
    TakenUp taken_up_;
    std::vector<Vec2> cut_;  // of the size, one place an index

    BodyJump body_;
    BodyObstacles obstacles_;
    LayersBelow layers_;
    std::vector<float> held_off_m_;  // by layers, off the body; one a vertex, empty: there are none
    PropsMet props_;
    Dress::Scratch scratch_;
    std::vector<Vec3> targets_;
    std::vector<Collider> colliders_;
    Cloth cloth_;

    bool jumps_ = false;                              // in the next step, however slow it is
    float speed_m_s_ = 0.0f, limb_speed_m_s_ = 0.0f;  // of the body, and of its fastest limb, in the last
                                                      // step; 0: it jumped
    // Of the step that has begun, or of the last one.
    float dt_ = 0.0f;
    float carried_ = 0.0f;    // fraction of the body's motion that the cloth does not feel
    std::vector<Mat4> pose_;  // skinning matrices
    int64_t time_ns_ = 0;
    FinishedStep finished_;
    std::optional<TriangleGroups> surface_;  // made when first asked for
};

}  // namespace vfit
