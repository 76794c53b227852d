// Small cloths whose behaviour is known in closed form, and the garment text that other tests damage.
#pragma once

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/garment/garment.h"
#include "core/error.h"

namespace vfit::test {

inline constexpr float kFrame_s = 1.0f / 60.0f;

inline std::vector<std::byte> bytes_of(const std::string& text) {
    std::vector<std::byte> bytes(text.size());
    if (!text.empty()) std::memcpy(bytes.data(), text.data(), text.size());
    return bytes;
}

/// Message of the vfit::Error that the call throws, its code in front; empty where it throws none.
template <typename Call>
std::string error_of(const Call& call) {
    try {
        call();
    } catch (const Error& e) {
        return std::to_string(e.code()) + " " + e.what();
    }
    return {};
}

/// A grid in the plane z = 0, hanging down from y = 0; row r, column c at (c, -r) steps; alternating
/// diagonals.
struct Sheet {
    uint32_t rows, columns;
    float step_m;
    std::vector<Vec3> positions;
    std::vector<uint32_t> indices;
    std::vector<uint8_t> simulated;

    Sheet(uint32_t row_count, uint32_t column_count, float step)
        : rows(row_count), columns(column_count), step_m(step) {
        for (uint32_t r = 0; r < rows; ++r)
            for (uint32_t c = 0; c < columns; ++c)
                positions.emplace_back(float(c) * step, -float(r) * step, 0.0f);
        for (uint32_t r = 0; r + 1 < rows; ++r)
            for (uint32_t c = 0; c + 1 < columns; ++c) {
                const uint32_t a = at(r, c), b = at(r, c + 1), d = at(r + 1, c), e = at(r + 1, c + 1);
                if ((r + c) % 2)
                    indices.insert(indices.end(), {a, d, e, a, e, b});
                else
                    indices.insert(indices.end(), {a, d, b, b, d, e});
            }
        simulated.assign(positions.size(), 1);
    }
    uint32_t at(uint32_t r, uint32_t c) const { return r * columns + c; }
    void pin_top() {
        for (uint32_t c = 0; c < columns; ++c) simulated[c] = 0;
    }
    FabricData cook(const FabricMaterial& material) const {
        return cook_fabric({positions, indices, {}, simulated}, material);
    }
};

inline FabricMaterial cotton() { return {0.2f, 2000.0f, 2000.0f, 50.0f, 1e-4f, 0.4f}; }

inline std::shared_ptr<const Fabric> fabric(FabricData data) {
    return std::make_shared<const Fabric>(std::move(data));
}

/// One free vertex, without any constraint.
inline std::shared_ptr<const Fabric> lone_vertex() {
    FabricData data;
    data.inverse_mass = {100.0f};
    return fabric(std::move(data));
}

inline Collider sphere(const Vec3& center, float radius) {
    Collider c;
    c.center = center;
    c.radius = radius;
    return c;
}

inline Collider capsule(const Vec3& a, float radius_a, const Vec3& b, float radius_b) {
    Collider c = sphere(a, radius_a);
    c.joint_b = 1;
    c.center_b = b;
    c.radius_b = radius_b;
    return c;
}

inline FabricLibrary library() {
    FabricLibrary fabrics;
    fabrics.add("cotton", cotton());
    return fabrics;
}

}  // namespace vfit::test
