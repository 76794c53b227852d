#include "outfit/grown_below.h"

#include <cmath>

#include "cloth/garment/borders.h"

namespace vfit {

namespace {
constexpr float kRow_m = 0.03f;  // from one row of a curtain to the next
constexpr float kDown = 0.5f;    // cosine
// Front and back must not meet in the middle: there the nearest of the two may be the one on the far side.
constexpr float kSmallest = 0.3f;  // of its way off the bones
}  // namespace

GrownBelow::GrownBelow(size_t vertices, std::span<const uint32_t> indices)
    : vertices_(vertices), indices_(indices.begin(), indices.end()) {
    for (const std::vector<uint32_t>& line : border_lines(indices)) {
        const size_t first = drops_.size(), count = line.size();
        for (const uint32_t corner : line)
            drops_.push_back({indices[corner], indices[next_corner(next_corner(corner))], lines_});
        ++lines_;
        const auto at = [&](size_t row, size_t i) {
            return row == 0 ? drops_[first + i].vertex : uint32_t(vertices_ + (first + i) * kRows + row - 1);
        };
        for (size_t i = 0; i < count; ++i)
            for (size_t row = 0; row < kRows; ++row) {
                const uint32_t a = at(row, i), b = at(row, (i + 1) % count), c = at(row + 1, i),
                               d = at(row + 1, (i + 1) % count);
                indices_.insert(indices_.end(), {b, a, c, b, c, d});
            }
    }
}

void GrownBelow::place(std::span<const Vec3> hangs, std::span<const Vec3> within, float share,
                       std::vector<Vec3>& places) const {
    places.clear();
    for (size_t v = 0; v < vertices_; ++v)
        places.push_back(glm::mix(within[v], hangs[v], kSmallest + (1.0f - kSmallest) * share));
    // The cloth goes on below as it ends, but neither outwards nor inwards.
    std::vector<Vec3> ways;
    std::vector<float> down(lines_, 0.0f), counts(lines_, 0.0f);
    for (const Drop& drop : drops_) {
        const Vec3 off = hangs[drop.vertex] - within[drop.vertex],
                   outward = off / std::max(glm::length(off), 1e-6f);
        Vec3 way = hangs[drop.vertex] - hangs[drop.inner];
        way -= glm::dot(way, outward) * outward;
        way /= std::max(glm::length(way), 1e-6f);
        ways.push_back(way);
        down[drop.line] -= way.y, counts[drop.line] += 1.0f;
    }
    for (size_t i = 0; i < drops_.size(); ++i) {
        const bool hangs_down = down[drops_[i].line] > kDown * counts[drops_[i].line];
        for (size_t row = 1; row <= kRows; ++row)
            places.push_back(hangs_down ? places[drops_[i].vertex] + Vec3(0.0f, -kRow_m * float(row), 0.0f)
                                        : Vec3(NAN));
    }
}

}  // namespace vfit
