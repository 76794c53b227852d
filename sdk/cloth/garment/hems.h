// Hems of sleeves and trouser legs that are too long for the limb: as a tailor would, they are taken up, and
// end at wrist and ankle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/body_model.h"
#include "cloth/fabric/fabric.h"
#include "cloth/garment/bound_garment.h"
#include "math/types.h"

namespace vfit {

struct LimbHem {
    std::vector<uint32_t> vertices;
    bool of_arm = false;
    float way_m = 0.0f;  // mean way along the cloth to them, or to the wrist, from what is fixed, where the
                         // garment lies on the body; 0: there is none
    float past_wrist_m = 0.0f;  // so far they lie beyond it
    /// One a vertex: the garment's vertex that lies up the limb from it, and how far.
    struct UpTheLimb {
        uint32_t vertex;
        float distance_m;
    };
    std::vector<UpTheLimb> up;
};

/// The borders of the garment that go around a forearm or a shank, a hand or a foot. part_below: of each
/// vertex, the body's part that it lies on; simulated: flags; carried: the garment on the body.
std::vector<LimbHem> limb_hems(std::span<const uint32_t> indices, std::span<const BodyPart> part_below,
                               std::span<const uint8_t> simulated, std::span<const Vec3> carried);

/// Sleeves that are carried further than the wrist, onto the hand, end at the wrist.
void end_at_wrists(std::span<LimbHem> hems, const BoundBody& body, std::span<const Vec3> carried);

/// What hems went up by, at most.
struct TakenUp {
    float sleeves_m = 0.0f, legs_m = 0.0f;
};

/// Shortens the triangles (cut: one place an index) of sleeves and legs, along the limb, by what they are
/// longer than on the body, but a little that folds may take: heaped above the wrist, their cloth would have
/// to lie in folds finer than its triangles. Girths stay as they are cut.
TakenUp take_up(std::span<const LimbHem> hems, std::span<const uint32_t> indices,
                std::span<const uint8_t> simulated, std::vector<Vec2>& cut);

/// A cuff does not slide over the hand and a hem does not slide under the foot: each vertex of hems to which
/// the way from what is fixed (tethers) is longer in the cloth than on the body stays within reach of a place
/// up the limb. So it may ride up, as it does where an arm is raised or a knee is bent.
void keep_hems(std::span<const LimbHem> hems, std::span<const Tether> tethers, FabricData& fabric);

}  // namespace vfit
