// Which triangles meet at each vertex of a mesh, by their numbers.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace vfit {

class TrianglesAbout {
public:
    /// Three indices a triangle, each less than `vertices`.
    TrianglesAbout(size_t vertices, std::span<const uint32_t> indices)
        : first_(vertices + 1, 0), all_(indices.size()) {
        for (const uint32_t v : indices) ++first_[v + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
        for (uint32_t i = 0; i < indices.size(); ++i) all_[next[indices[i]]++] = i / 3;
    }
    std::span<const uint32_t> of(uint32_t vertex) const {
        return {all_.data() + first_[vertex], first_[vertex + 1] - first_[vertex]};
    }

private:
    std::vector<uint32_t> first_, all_;
};

}  // namespace vfit
