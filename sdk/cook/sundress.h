// Cooks the sundress: a bodice that is skinned and an A-line skirt that is simulated, both drawn from the
// sections of a body and a few design parameters (assets/garments/sundress.json).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "body/body_model.h"
#include "cloth/garment.h"

namespace vfit {

struct SundressSpec {
    std::string name, kind, fabric;
    uint32_t columns = 0;       // vertices around the body, even
    uint32_t bodice_rows = 0, skirt_rows = 0;
    uint32_t strap_columns = 0, strap_rows = 0;
    float neckline = 0.0f;      // top edge at the side: share of the way from the bust up to the shoulder
    float hem = 0.0f;           // share of the way from the knee up (> 0) or down (< 0) to the crotch's height
    float bodice_ease_m = 0.0f;  // between skin and bodice
    float hip_ease_m = 0.0f;     // between skin and skirt where the hips are widest
    float flare = 0.0f;          // growth of the skirt's radius per metre below the hips, m/m
    float back_drop_m = 0.0f;    // how much lower the top edge is at the back
    float neckline_curve_m = 0.0f;  // how much the top edge rises towards the straps in front
    float strap_offset = 0.0f;   // strap's distance from the middle: share of half the shoulder width
    std::vector<GarmentSize> sizes;
};

/// Format "vfit-sundress" version 1; VFIT_ERROR_DATA names the field.
SundressSpec parse_sundress(std::span<const std::byte> json);

Garment cook_sundress(const BodyModel& model, const SundressSpec& spec);

/// The garment file; floats with 5 decimals.
std::string write_garment(const Garment& garment);

}  // namespace vfit
