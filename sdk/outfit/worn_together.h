// Garments that one body wears over each other: what moves all of them, as one cloth.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "outfit/outside_layers.h"
#include "outfit/worn_garment.h"

namespace vfit {

/// A view for one call. Garments that share a cloth meet each other as the layers of one garment do: they
/// push each other by their mass, and do not cross.
class WornTogether {
public:
    /// All garments that share a cloth with one of them, in any order; one that is missing is worn no longer.
    /// They are of one wearer, VFIT_ERROR_ARGUMENT.
    explicit WornTogether(std::span<WornGarment* const> garments);

    /// From now on `outer` is worn over `inner`, both of these, and shares a cloth with it: in the avatar's
    /// pose it goes outside of inner, with all that is worn over it, and comes from there to its own lengths.
    /// False: it did so before. VFIT_ERROR_ARGUMENT where inner is the same, or is worn over outer.
    /// VFIT_ERROR_NOT_WEARABLE where inner reaches too far beyond it: then both are carried into the pose,
    /// and outer is not worn over inner.
    bool wear_over(WornGarment& outer, WornGarment& inner);

    /// Takes the avatar's pose and the props, dt after those of the last step. 0: nothing moves. Then step()
    /// takes nothing from outside, and may run on another thread.
    void begin_step(float dt);
    void step();
    void end_step();

    /// On a body that stands straight and goes into the avatar's pose, each outside of those below it. Ends
    /// at rest.
    void put_on();

    /// From how it hangs now, in the avatar's pose. VFIT_ERROR_NOT_WEARABLE, and nothing changes, where it
    /// is stretched too far there.
    void change_to(WornGarment& garment, WornGarment::Resized resized);

private:
    friend class WornGarment;  // which starts alone

    std::span<WornGarment* const> garments() const { return std::span(garments_).first(count_); }
    Cloth& cloth() const { return garments_[0]->cloth_->cloth; }
    Jobs& jobs() const { return garments_[0]->jobs_; }
    std::span<const Mat4> avatar_pose() const { return garments_[0]->avatar_pose(); }
    const Avatar& avatar() const { return garments_[0]->wearer_.avatar(); }
    void sort_outwards();
    bool is_sorted_cloth() const;
    void share_cloth();
    void meet_layers();
    std::vector<std::vector<WornGarment*>> by_cloth() const;
    void go_outside(const WornGarment& outer, const WornGarment& inner);
    void gather();
    Cloth::BodyOnItsWay body_on_its_way(const std::function<void(float, std::vector<Mat4>&)>& pose);
    void stand();
    void carry_along(float fraction);
    void jump_to_pose();
    void start_with_legs_apart();
    void come_to_lengths(bool is_new);
    void check_stretch(WornGarment& garment);
    std::vector<Vec3> outside(const WornGarment& garment, std::span<const Mat4> matrices,
                              const std::function<std::span<const Vec3>(const WornGarment&)>& places) const;
    static void check_reach(const WornGarment& outer, const WornGarment& inner,
                            std::span<const Vec3> outside);
    void widen_limits();
    void find_shapes() const;

    std::array<WornGarment*, Fabric::kMaxPieces> garments_{};  // from the inside outwards
    size_t count_ = 0;
};

}  // namespace vfit
