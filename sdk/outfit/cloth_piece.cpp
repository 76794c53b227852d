#include "outfit/cloth_piece.h"

#include <algorithm>

namespace vfit {

std::vector<uint32_t> ClothPiece::indices() const {
    const std::span<const uint32_t> all = of().indices.of(cloth_.fabric().data().indices);
    std::vector<uint32_t> out(all.begin(), all.end());
    for (uint32_t& v : out) v -= of().vertices.begin;
    return out;
}

/// 0 for the vertices of other pieces.
std::vector<uint8_t> ClothPiece::whole_mask(std::span<const uint8_t> own) const {
    std::vector<uint8_t> mask(cloth_.fabric().vertex_count(), 0);
    std::copy(own.begin(), own.end(), mask.begin() + of().vertices.begin);
    return mask;
}

template <typename Add>
auto ClothPiece::with_filter(size_t vertices, const MeshFilter& filter, Add&& add) const {
    if (is_whole()) return add(filter);
    const std::vector<uint8_t> all(std::max<size_t>(vertices, vertex_count()), 1);
    const bool is_filtered = !filter.category.empty();
    const std::vector<uint8_t> mask =
        whole_mask(is_filtered ? filter.mask : std::span(all).first(vertex_count()));
    return add(MeshFilter{is_filtered ? filter.category : std::span(all).first(vertices), mask});
}

uint32_t ClothPiece::add_mesh(size_t vertices, std::span<const uint32_t> indices, MeshOf what,
                              const MeshFilter& filter) {
    return with_filter(vertices, filter, [&](const MeshFilter& whole) {
        return cloth_.add_mesh(vertices, indices, {}, what, whole);
    });
}

void ClothPiece::replace_mesh(uint32_t mesh, size_t vertices, std::span<const uint32_t> indices,
                              MeshOf what) {
    with_filter(vertices, {},
                [&](const MeshFilter& whole) { cloth_.replace_mesh(mesh, vertices, indices, what, whole); });
}

}  // namespace vfit
