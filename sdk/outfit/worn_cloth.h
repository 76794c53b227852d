// The cloth that garments of one body share which are worn over each other: one simulation, of which each
// garment is a piece. A garment that is worn alone has one for itself.
#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "body/collider.h"
#include "cloth/cloth.h"
#include "math/types.h"

namespace vfit {

struct WornCloth {
    WornCloth(std::vector<std::shared_ptr<const Fabric>> of_garments, std::span<const ClothSettings> settings,
              std::span<const Vec3> start, Jobs& jobs)
        : fabrics(std::move(of_garments)), cloth(Cloth::of_pieces(joined(fabrics), settings, start, &jobs)) {}

    static std::shared_ptr<const Fabric> joined(const std::vector<std::shared_ptr<const Fabric>>& fabrics) {
        return fabrics.size() == 1 ? fabrics.front() : std::make_shared<const Fabric>(fabrics);
    }

    std::vector<std::shared_ptr<const Fabric>> fabrics;  // of each piece
    Cloth cloth;
    // What a step takes from all garments; kept, so that it does not allocate.
    std::vector<Vec3> targets, places, speeds;
    std::vector<Mat3> turns;
    std::vector<Collider> colliders;
    std::vector<uint32_t> collider_ends;
};

}  // namespace vfit
