// Arms that go through a garment for a while (held_cloth.h). A hand hooks behind a hem or pinches cloth
// against a thigh; so the whole arm passes until it is free of the cloth again.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "cloth/contact/triangle_groups.h"
#include "core/jobs.h"
#include "outfit/arm_filter.h"
#include "outfit/cloth_piece.h"

namespace vfit {

class PassingArms {
public:
    /// indices: triangles of the skin that has that filter.
    PassingArms(ArmFilter filter, std::span<const uint32_t> indices);

    /// As it is now.
    MeshFilter filter() const { return {filter_.category, mask_}; }
    /// On its way in a step, of which that fraction is over.
    struct MovingSkin {
        std::span<const Vec3> from, to;
        float share;
        Vec3 at(uint32_t v) const { return glm::mix(from[v], to[v], share); }
    };
    /// dt after the last time. True: another mask is to be met from now on.
    bool look(const ClothPiece& cloth, const MovingSkin& skin, float dt, Jobs& jobs);
    /// Both arms are met from now on: the cloth was put on anew.
    void meet_again();
    /// One a vertex of the cloth. A sleeve always meets the arm in it.
    std::span<const uint8_t> mask() const { return mask_; }
    bool passes(Arm arm) const { return of_[size_t(arm)].passes; }

private:
    struct OfArm {
        std::vector<uint32_t> points, indices;  // of the skin
        std::optional<TriangleGroups> triangles;
        bool passes = false;
        float for_s = 0.0f;
    };
    bool meets(uint32_t vertex, Arm arm) const;
    bool is_sleeve(uint32_t vertex) const;
    bool holds(const ClothPiece& cloth, const MovingSkin& skin, Arm arm) const;
    bool is_free(const ClothPiece& cloth, std::span<const Vec3> skin, Arm arm, Jobs& jobs);

    ArmFilter filter_;
    std::vector<uint8_t> mask_;
    std::array<OfArm, kArms.size()> of_;
    std::vector<uint32_t> cloth_indices_;
    std::optional<TriangleGroups> cloth_;
    std::vector<TrianglePair> crossed_;
};

}  // namespace vfit
