// Named fabrics (assets/fabrics.json): what cloth is made of, in SI units.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace vfit {

struct FabricMaterial {
    float density_kg_m2 = 0.0f;
    float stretch_warp_n_m = 0.0f;  // tension per width and unit strain, along the length of the cloth
    float stretch_weft_n_m = 0.0f;  // across it
    float shear_n_m = 0.0f;
    float bend_n_m = 0.0f;     // bending stiffness B (moment per width and unit curvature), N m
    float friction = 0.0f;     // static, against the body
    float most_strain = 0.1f;  // along a girth, with which a garment of it can still be worn
};

class FabricLibrary {
public:
    /// Format "vfit-fabrics" version 1. Fails with VFIT_ERROR_DATA naming the preset and the field.
    static FabricLibrary parse(std::span<const std::byte> json);

    void add(const std::string& name, const FabricMaterial& material) { materials_[name] = material; }
    std::vector<std::string> names() const;
    bool has(const std::string& name) const { return materials_.count(name) != 0; }
    /// Fails with VFIT_ERROR_DATA, listing the names there are.
    const FabricMaterial& get(const std::string& name) const;

private:
    std::map<std::string, FabricMaterial> materials_;
};

}  // namespace vfit
