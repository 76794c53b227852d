// Hems of sleeves and trouser legs: where a limb ends in a hand or a foot, cloth that is too long for it stays behind.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/body_model.h"
#include "cloth/fabric/fabric.h"
#include "math/types.h"

namespace vfit {

/// The borders of the garment, each the vertices of a closed line, that go around a forearm or a shank, a hand or a foot.
/// part_below: of each vertex, the body's part that it lies on.
std::vector<std::vector<uint32_t>> limb_hems(std::span<const uint32_t> indices, std::span<const BodyPart> part_below);

void take_up(const std::vector<std::vector<uint32_t>>& hems, std::span<const uint32_t> indices, std::span<const uint8_t> simulated, std::span<const Vec3> carried, std::vector<Vec2>& cut);

/// A cuff does not slide over the hand and a hem does not slide under the foot, where a person's sleeves and trousers are too long:
/// they lie in folds above. Each vertex of those hems to which the way from what is fixed is longer in the cloth (`fabric`) than
/// on the body, where its vertices are carried to, stays near that place.
void keep_hems(const std::vector<std::vector<uint32_t>>& hems, std::span<const Vec3> carried, FabricData& fabric);

}  // namespace vfit
