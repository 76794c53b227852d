// The parts of PeopleMap that give people their loose ends: what hangs together with nobody, and the soles.
#include <algorithm>
#include <cmath>

#include "track/people_map.h"

namespace vfit {

namespace {

// From a fragment to the person it is of. A hand before the trunk may hide the forearm, the far arm lies
// behind the trunk.
constexpr float kInFront_m = 0.7f, kBehind_m = 0.4f;
constexpr float kSeenThrough_m = 0.08f;  // behind: may be the scene, seen between the legs
constexpr float kAside_m = 0.9f;         // from the person's middle, on the floor
constexpr float kBeside_m = 0.05f;       // hardly a step in depth
constexpr int kFragmentGap = 4;          // cells

// Parts of one person, the one above the other.
constexpr float kSamePlace_m = 0.25f, kOverlap_m = 0.15f, kMostPart_m2 = 0.35f;

// Soles: cells of the floor cut that are higher than the floor after all, a few cells around the feet.
constexpr float kFeetBelow_m = 0.12f, kSole_m = 0.0045f, kSoleSigmas = 0.3f;
constexpr int kSoleSteps = 4;

}  // namespace

// A patch of wall between the legs: beside the person the same depth goes on.
bool PeopleMap::part_of_scene(const Shape& s) const {
    const int width = int(grid_.width()), height = int(grid_.height());
    const int x = (s.x0 + s.x1) / 2, y = (s.y0 + s.y1) / 2;
    const auto goes_on = [&](int fx, int fy, int dx, int dy) {
        for (; fx >= 0 && fy >= 0 && fx < width && fy < height; fx += dx, fy += dy) {
            const size_t i = size_t(fy * width + fx);
            const float z = grid_.depth()[i];
            if (slots_[i] || z == 0.0f) continue;
            return std::abs(z - s.depth_m) < kBeside_m + same_surface_m(z);
        }
        return false;
    };
    return goes_on(s.x0 - 1, y, -1, 0) || goes_on(s.x1, y, 1, 0) || goes_on(x, s.y0 - 1, 0, -1) ||
           goes_on(x, s.y1, 0, 1);
}

// Head and shoulders over a box that is carried, legs below a table: what stands in the same place, where the
// rest of the person ends.
uint32_t PeopleMap::above_or_below(const Shape& part) const {
    uint32_t best = Identity::kMost;
    float least = kSamePlace_m;
    for (const Piece& p : pieces_) {
        if (p.slot >= Identity::kMost) continue;
        const bool above = part.low_m > p.shape.high_m - kOverlap_m,
                   below = part.high_m < p.shape.low_m + kOverlap_m;
        const float away = floor_distance(part.centre, p.shape.centre);
        if ((!above && !below) || away > least) continue;
        least = away;
        best = p.slot;
    }
    return best;
}

// A hand before the trunk, a head above a dark collar: what lies beside a person in the image and near them
// in space is theirs.
void PeopleMap::attach_fragments() {
    const int width = int(grid_.width()), height = int(grid_.height());
    for (Piece& p : pieces_) {
        p.home = Identity::kMost;
        if (p.slot != kFragment) continue;
        std::array<float, Identity::kMost + 1> votes{};
        float behind_sum = 0.0f, neighbours = 0.0f;
        for (const uint32_t cell : p.cells) {
            const int x = int(cell) % width, y = int(cell) / width;
            const auto visit = [&](int nx, int ny) {
                if (nx < 0 || ny < 0 || nx >= width || ny >= height) return;
                const size_t next = size_t(ny) * size_t(width) + size_t(nx);
                const float behind = grid_.depth()[cell] - grid_.depth()[next];
                // A hand before somebody else's chest is near its own arm.
                if (!slots_[next] || behind > kBehind_m || behind < -kInFront_m) return;
                votes[slots_[next]] += 1.0f / (std::abs(behind) + kBeside_m);
                behind_sum += behind;
                ++neighbours;
            };
            for (int k = 1; k <= kFragmentGap; ++k) {
                visit(x - k, y);
                visit(x + k, y);
                visit(x, y - k);
                visit(x, y + k);
            }
        }
        if (behind_sum > kSeenThrough_m * neighbours && part_of_scene(p.shape)) continue;
        float most = 0.0f;
        for (uint32_t slot = 0; slot < Identity::kMost; ++slot) {
            if (votes[slot + 1] <= most) continue;
            const Vec3 away = p.shape.centre - identity_.track(slot).centre;
            if (std::sqrt(away.x * away.x + away.z * away.z) > kAside_m) continue;
            most = votes[slot + 1];
            p.home = slot;
        }
    }
    for (Piece& p : pieces_) {
        const bool part = p.slot == kThing && p.shape.area_m2 < kMostPart_m2;
        if (!part && !(p.slot == kFragment && p.home == Identity::kMost)) continue;
        p.home = above_or_below(p.shape);
        if (p.home < Identity::kMost) p.slot = kFragment;
    }
    for (const Piece& p : pieces_)
        if (p.slot == kFragment && p.home < Identity::kMost)
            for (const uint32_t cell : p.cells) slots_[cell] = uint8_t(p.home + 1);
}

// The floor cut takes the soles with it. Around feet the mean height of 3 x 3 cells, which is less noisy than
// the single one, tells them from the floor.
void PeopleMap::grow_feet() {
    if (!floor_seen_ && !floor_->found()) return;
    const int width = int(grid_.width()), height = int(grid_.height());
    const Vec3 n = camera_.floor_normal;
    const float d = camera_.floor_distance_m;
    const auto height_of = [&](int x, int y) {
        const float z = grid_.depth()[size_t(y * width + x)];
        return z * (n.x * grid_.ray_x()[size_t(x)] + n.y * grid_.ray_y()[size_t(y)] + n.z) + d;
    };
    const auto floor_like = [&](int x, int y) {
        const size_t i = size_t(y * width + x);
        const float z = grid_.depth()[i];
        return z > 0.0f && !wanted_[i] && std::abs(height_of(x, y)) < 2.0f * floor_cut_m(d, z);
    };
    size_t count = 0;
    int line = 0, row = 0;  // of the last one: they come in order
    for_each_labelled(slots_, [&](size_t i) {
        while (int(i) >= row + width) row += width, ++line;
        if (height_of(int(i) - row, line) < kFeetBelow_m) frontier_[count++] = uint32_t(i);
    });
    size_t first = 0;
    for (int step = 0; step < kSoleSteps; ++step) {
        const size_t last = count;
        for (; first < last; ++first) {
            const int from = int(frontier_[first]), fx = from % width, fy = from / width;
            const float z = grid_.depth()[size_t(from)];
            const auto visit = [&](int x, int y) {
                if (x < 1 || y < 1 || x >= width - 1 || y >= height - 1) return;
                const size_t i = size_t(y * width + x);
                if (slots_[i] || !floor_like(x, y) || std::abs(grid_.depth()[i] - z) > same_surface_m(z))
                    return;
                float sum = 0.0f;
                int cells = 0;
                for (int b = -1; b <= 1; ++b)
                    for (int a = -1; a <= 1; ++a)
                        if (floor_like(x + a, y + b)) {
                            sum += height_of(x + a, y + b);
                            ++cells;
                        }
                if (sum < float(cells) * (kSole_m + kSoleSigmas * kInverseDepthSigma * d * z)) return;
                slots_[i] = slots_[size_t(from)];
                frontier_[count++] = uint32_t(i);
            };
            visit(fx - 1, fy);
            visit(fx + 1, fy);
            visit(fx, fy - 1);
            visit(fx, fy + 1);
        }
    }
}

}  // namespace vfit
