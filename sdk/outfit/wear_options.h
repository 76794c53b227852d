// How a garment is worn: in which size, on which surface of the body, and how its cloth is simulated.
#pragma once

#include <optional>
#include <string>

#include "cloth/cloth.h"
#include "cloth/fabric/fabric_library.h"

namespace vfit {

/// Null: made to measure, with the ease that the garment was made with.
using SizeLabel = std::optional<std::string>;

struct WearOptions {
    SizeLabel size;
    bool any_fit = false;  // worn even where it would not close
    bool hands = true;     // false: hands pass through the cloth, and forearms too unless it has sleeves
    bool on_skin = false;  // kept out of the skin itself, not of spheres and capsules
    float cover_m = 0.0f;  // further spheres and capsules until no skin is further outside of them; 0: none
    std::optional<float> friction;  // null: the fabric's
    ClothSettings cloth;            // except friction and follows_fixed

    /// Of a cloth of that material.
    ClothSettings settings_of(const FabricMaterial& material) const {
        ClothSettings settings = cloth;
        settings.friction = friction.value_or(material.friction);
        settings.follows_fixed = false;  // a worn garment states the motion of the body
        return settings;
    }
};

}  // namespace vfit
