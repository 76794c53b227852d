// A garment ready to be worn: with the material of its fabric, and bound to bodies of each level of detail.
#pragma once

#include <array>
#include <memory>
#include <mutex>

#include "body/body_model.h"
#include "cloth/fabric/fabric_library.h"
#include "cloth/garment/bound_garment.h"
#include "cloth/garment/garment.h"
#include "core/jobs.h"

namespace vfit {

/// Any thread may ask.
class WearableGarment {
public:
    /// model: of the body that the garment was authored on.
    WearableGarment(Garment garment, const FabricMaterial& material, std::shared_ptr<const BodyModel> model);

    const Garment& garment() const { return garment_; }
    const FabricMaterial& material() const { return material_; }
    /// To bodies of that level of detail; bound when first asked for.
    const BoundGarment& bound(uint32_t detail, Jobs& jobs) const;

private:
    const Garment garment_;
    const FabricMaterial material_;
    const std::shared_ptr<const BodyModel> model_;
    mutable std::mutex mutex_;
    mutable std::array<std::unique_ptr<const BoundGarment>, kCoarseBody + 1> bound_;
};

}  // namespace vfit
