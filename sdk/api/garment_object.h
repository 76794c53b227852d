// The object behind vfit_garment.
#pragma once

#include "api/context.h"
#include "outfit/wearable_garment.h"

namespace vfit::api {

struct GarmentObject : ContextChild {
    static constexpr Kind kKind = Kind::garment;
    GarmentObject(Ref<Context> owner, Garment garment, const FabricMaterial& material)
        : ContextChild(std::move(owner)), wearable(std::move(garment), material, context->body_model()) {}
    const WearableGarment wearable;
};

}  // namespace vfit::api
