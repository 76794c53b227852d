// A garment on the bones of a character: where its vertices are in the stand in which it was simulated, and
// by which bones they go from there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "avatar/character_body.h"
#include "cloth/garment/bound_garment.h"
#include "cloth/garment/garment.h"
#include "geometry/membrane.h"
#include "refit/stands.h"

namespace vfit {

class BoundCloth {
public:
    /// bound: to the body model; the bones are those of the character that carry the skin below, evened out
    /// over what hangs. The garment and the stands must outlive this.
    BoundCloth(const Garment& garment, const BoundGarment& bound, const CharacterBody& body,
               std::vector<Vec3> positions, std::span<const Stand> stands);

    const Garment& garment() const { return garment_; }
    const std::vector<uint32_t>& indices() const { return garment_.mesh.indices; }
    const Membrane& membrane() const { return membrane_; }
    const std::vector<Vec3>& positions() const { return positions_; }
    std::vector<Vec3>& positions() { return positions_; }
    const std::vector<SkinBones>& bones() const { return bones_; }  // of the character
    const std::vector<SkinWeights>& weights() const { return weights_; }

    /// Of the body below each vertex.
    const std::vector<BodyPart>& parts() const { return parts_; }

    /// As the bones carry it into a stand.
    std::vector<Vec3> in(size_t stand) const;

    /// From now on each of these vertices goes half as it did and half as that skin does; its neighbours a
    /// little.
    struct GoesWith {
        uint32_t vertex;
        const SkinBones* bones;
        const SkinWeights* weights;
    };
    void go_with(std::span<const GoesWith> list);

    /// To try a change.
    struct State {
        std::vector<Vec3> positions;
        std::vector<std::vector<Vec3>> rows;
    };
    State state() const { return {positions_, rows_}; }
    void restore(State state);

private:
    void write_weights();

    const Garment& garment_;
    std::span<const Stand> stands_;
    Membrane membrane_;
    std::vector<BodyPart> parts_;
    std::vector<Vec3> positions_;
    size_t bone_count_ = 0;
    std::vector<std::vector<Vec3>> rows_;  // of three bones each; one a vertex
    std::vector<SkinBones> bones_;
    std::vector<SkinWeights> weights_;
    std::vector<std::vector<Mat4>> to_stand_;  // one a stand and vertex
};

}  // namespace vfit
