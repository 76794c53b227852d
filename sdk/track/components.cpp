#include "track/components.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vfit {

namespace {
constexpr uint32_t kNone = ~0u;
constexpr float kBend = 6.0f;  // of a second difference, which has sqrt(6) times the spread of a reading
}  // namespace

uint32_t Components::root(uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];  // path halving
    return i;
}

void Components::join(uint32_t a, uint32_t b) {
    const uint32_t ra = root(a), rb = root(b);
    // The earlier cell becomes the root: components come out in the order of their first cells. Both point to
    // it now, so that their neighbours find it at once.
    parent_[a] = parent_[b] = parent_[ra] = parent_[rb] = std::min(ra, rb);
}

void Components::run(const DepthGrid& grid, const uint8_t* wanted, uint32_t fewest_cells) {
    const uint32_t width = grid.width(), cells = grid.cells();
    const float* const z = grid.depth().data();
    parent_.resize(cells);
    count_.resize(cells);
    order_.resize(cells);
    list_.resize(cells);
    size_t listed = 0;
    starts_.reserve(cells / std::max(1u, fewest_cells) + 2);

    for (uint32_t y = 0, i = 0; y < grid.height(); ++y) {
        for (uint32_t x = 0; x < width; ++x, ++i) {
            if (!wanted[i]) {
                uint64_t eight = 1;  // cells at a time, where nothing is wanted
                if (x + 8 <= width) std::memcpy(&eight, wanted + i, sizeof eight);
                if (eight == 0) x += 7, i += 7;
                continue;
            }
            list_[listed++] = i;
            count_[i] = 0;
            const float same = grid.same_surface_m(z[i]);
            const float loose = same_surface_m(z[i]), bend = kBend * grid.sigma_m(z[i]);
            // Or as a slanting wall goes on, evenly over three steps; from a body to what is behind there are
            // no such three. by: from cell to cell; room: of them before i.
            const auto joined = [&](uint32_t j, uint32_t by, uint32_t room) {
                if (!wanted[j]) return false;
                const float step = z[i] - z[j];
                if (std::abs(step) < same) return true;
                if (std::abs(step) >= loose || j != i - by || room < 3) return false;
                const uint32_t b = j - by, a = b - by;
                return wanted[a] && wanted[b] && std::abs(step - (z[j] - z[b])) < bend &&
                       std::abs(step - (z[b] - z[a])) < bend;
            };
            // A cell without a reading is stepped over.
            const uint32_t left = x > 0 && z[i - 1] > 0.0f ? i - 1 : x > 1 ? i - 2 : kNone;
            const uint32_t above = y > 0 && z[i - width] > 0.0f ? i - width : y > 1 ? i - 2 * width : kNone;
            parent_[i] = left != kNone && joined(left, 1, x) ? parent_[left] : i;
            if (above != kNone && joined(above, width, y) && parent_[above] != parent_[i]) join(i, above);
        }
    }

    // A parent comes before its child, so that one step leads to the root.
    const std::span<const uint32_t> list(list_.data(), listed);
    for (const uint32_t i : list) ++count_[parent_[i] = parent_[parent_[i]]];
    starts_.assign(1, 0);
    for (const uint32_t i : list) {
        if (parent_[i] != i) continue;
        if (count_[i] < fewest_cells) {
            count_[i] = kNone;
        } else {
            const uint32_t first = starts_.back();
            starts_.push_back(first + count_[i]);
            count_[i] = first;  // where the next of its cells goes
        }
    }
    for (const uint32_t i : list)
        if (count_[parent_[i]] != kNone) order_[count_[parent_[i]]++] = i;
}

}  // namespace vfit
