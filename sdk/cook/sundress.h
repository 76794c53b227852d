// Cooks the sundress: a bodice that is skinned and an A-line skirt that is simulated, both drawn from the
// sections of a body and a few design parameters (assets/garments/sundress.json).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "body/body_model.h"
#include "cloth/garment/garment.h"

namespace vfit {

struct SundressSpec {
    std::string name, fabric;
    std::string kind, size_chart;  // of the size charts; size_chart may be empty
    // Vertices. Around the body (even, so that front and back have a middle), down, and across and along a
    // strap.
    uint32_t columns = 0, bodice_rows = 0, skirt_rows = 0, strap_columns = 0, strap_rows = 0;
    // Height of the bodice's top edge: share of the way from the bust up to the shoulder joint.
    float top_center = 0.0f, top_strap = 0.0f, top_side = 0.0f, top_back = 0.0f;
    float strap_place =
        0.0f;          // of the strap's middle: share of the way from the body's middle to the shoulder joint
    float hem = 0.0f;  // share of the way from the knee down to the ankle
    float bodice_ease_m = 0.0f;  // between skin and bodice
    float skirt_ease_m = 0.0f;   // between the widest section above and the skirt, reached at the hips
    float flare = 0.0f;          // what the skirt's radius grows by below the hips, metres a metre
    std::vector<GarmentSize> sizes;
};

/// Format "vfit-sundress" version 1; VFIT_ERROR_DATA names the field.
SundressSpec parse_sundress(std::span<const std::byte> json);

/// On the model's default female body. VFIT_ERROR_DATA where the design does not go onto it.
Garment cook_sundress(const BodyModel& model, const SundressSpec& spec);

}  // namespace vfit
