// Cloth on the bones of a character, kept clear of the skin that is seen, however the character stands.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "avatar/character.h"
#include "avatar/character_body.h"
#include "geometry/mesh_query.h"
#include "refit/bound_cloth.h"
#include "refit/stands.h"

namespace vfit {

/// The character's own skin is not the body's, and its bones carry it otherwise. Where a triangle that is
/// seen goes through the cloth, the cloth goes out (below hair and chin, in); where that does not help, it
/// goes with the skin.
class ClearOfSkin {
public:
    /// skin: of the body. hidden: one a triangle of the character. All must outlive this.
    ClearOfSkin(const CharacterBody& body, const MeshQuery& skin, const Character& character,
                std::span<const uint8_t> hidden, std::span<const Stand> stands);

    /// Garments below count as skin.
    void clear(BoundCloth& cloth, std::span<const BoundCloth> below) const;
    /// Triangles of the character's mesh that still cross in some stand.
    std::vector<uint32_t> still_crossing(const BoundCloth& cloth) const;
    /// Pairs of triangles that cross where the garment was simulated.
    uint32_t crossings(const BoundCloth& cloth) const;

private:
    struct Crossing {
        uint32_t triangle;  // of the cloth
        uint32_t vertex;    // of the character; UINT32_MAX: it is a garment below
        uint32_t skin;      // triangle of the character
    };
    struct Seen {
        std::vector<uint32_t> corners;  // of triangles of the character
        std::vector<uint32_t> numbers;  // of these triangles
    };
    /// What the garment hangs beside.
    Seen beside(const BoundCloth& cloth) const;
    std::vector<Crossing> find(const BoundCloth& cloth, const Seen& seen, std::span<const BoundCloth> below,
                               size_t stand) const;
    void push(BoundCloth& cloth, std::span<const Crossing> crossings, std::span<const Vec3> start) const;
    void go_with(BoundCloth& cloth, std::span<const Crossing> crossings) const;

    const CharacterBody& body_;
    const MeshQuery& skin_;
    const Character& character_;
    std::span<const Stand> stands_;
    Seen seen_;
};

}  // namespace vfit
