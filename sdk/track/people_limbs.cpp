// The parts of PeopleMap that give people their loose ends: what hangs together with nobody, and the soles.
#include <algorithm>
#include <cmath>

#include "track/people_map.h"
#include "track/scene_plane.h"

namespace vfit {

namespace {

// From a fragment to the person it is of. A hand before the trunk may hide the forearm, the far arm lies
// behind the trunk.
constexpr float kInFront_m = 0.7f, kBehind_m = 0.4f;
constexpr float kSeenThrough_m = 0.08f;  // behind: may be the scene, seen between the legs
constexpr float kAside_m = 0.9f;         // from the person's middle, on the floor
constexpr float kBeside_m = 0.05f;       // hardly a step in depth
// A patch of the scene: how far around it the plane is looked for, what a wall is uneven by, and how much of
// what is seen there lies on the plane.
constexpr uint32_t kFewestPlane = 12;  // cells
constexpr float kAround_m = 0.3f, kUneven_m = 0.01f, kPlaneSigmas = 3.0f, kOnPlane = 0.5f;
constexpr float kLowPart_m = 0.15f;  // feet lie on the plane of the floor
constexpr int kFragmentGap = 4;      // cells

// Parts of one person, the one above the other.
constexpr float kSamePlace_m = 0.25f, kOverlap_m = 0.15f, kMostPart_m2 = 0.35f;

// Soles: cells of the floor cut that are higher than the floor after all, a few cells around the feet.
constexpr float kFeetBelow_m = 0.12f, kSole_m = 0.0045f, kSoleSigmas = 0.3f;
constexpr int kSoleSteps = 4;

}  // namespace

// A patch of wall between the legs: beside the person the same depth goes on. The floor is as deep as any
// leg.
bool PeopleMap::beside_scene(const Shape& s) const {
    const int width = int(grid_.width()), height = int(grid_.height());
    const int x = (s.x0 + s.x1) / 2, y = (s.y0 + s.y1) / 2;
    const bool floor = camera_.floor_state != VFIT_FLOOR_DEFAULT;
    const ShapeMeter meter(grid_, camera_, {});
    const auto goes_on = [&](int fx, int fy, int dx, int dy) {
        for (; fx >= 0 && fy >= 0 && fx < width && fy < height; fx += dx, fy += dy) {
            const size_t i = size_t(fy * width + fx);
            const float z = grid_.depth()[i];
            if (slots_[i] || z == 0.0f) continue;
            if (floor && meter.world(uint32_t(fx), uint32_t(fy)).y < kLowPart_m) return false;
            return std::abs(z - s.depth_m) < kBeside_m + same_surface_m(z);
        }
        return false;
    };
    return goes_on(s.x0 - 1, y, -1, 0) || goes_on(s.x1, y, 1, 0) || goes_on(x, s.y0 - 1, 0, -1) ||
           goes_on(x, s.y1, 0, 1);
}

// A patch of wall that is seen between limbs: the plane through it goes on around it. Edges have readings
// that are mixed from person and wall, so that the cells next to it need not be of either.
bool PeopleMap::part_of_scene(const Piece& piece) {
    const int width = int(grid_.width()), height = int(grid_.height());
    const Shape& s = piece.shape;
    if (s.cells < kFewestPlane || s.high_m < kLowPart_m) return false;
    mark(piece.cells, kOwn);
    ScenePlane plane;
    grid_.for_each(piece.cells, [&](uint32_t cell, uint32_t x, uint32_t y) {
        plane.add(float(x), float(y), grid_.depth()[cell]);
    });
    const float tolerance = kPlaneSigmas * std::hypot(kUneven_m, grid_.sigma_m(s.depth_m));
    const int reach = int(kAround_m / grid_.cell_m(s.depth_m));
    bool goes_on = plane.fit();
    // A small patch tells its plane badly: the cells around it that fit are taken too.
    for (int turn = 0; turn < 2 && goes_on; ++turn) {
        ScenePlane wider = plane;
        uint32_t on = 0, beyond = 0;
        for (int y = std::max(0, s.y0 - reach); y < std::min(height, s.y1 + reach); ++y)
            for (int x = std::max(0, s.x0 - reach); x < std::min(width, s.x1 + reach); ++x) {
                const size_t i = size_t(y * width + x);
                const float z = grid_.depth()[i];
                if (labels_[i] || z == 0.0f) continue;
                const float behind = z - plane.depth(float(x), float(y));
                if (std::abs(behind) < tolerance) ++on, wider.add(float(x), float(y), z);
                beyond += behind >= tolerance;
            }
        goes_on = on >= kFewestPlane && float(on) > kOnPlane * float(on + beyond) && wider.fit();
        plane = wider;
    }
    unmark(piece.cells, kOwn);
    return goes_on;
}

// What is taken for parts of people because it is seen where they were, and is a patch of the scene behind
// them.
void PeopleMap::drop_scene() {
    for (Piece& p : pieces_) {
        if (p.slot >= Identity::kMost || !behind_person(p, p.slot) || !part_of_scene(p)) continue;
        for (const uint32_t cell : p.cells) slots_[cell] = 0;
        p.slot = kThing;
    }
}

bool PeopleMap::behind_person(const Piece& part, uint32_t slot) const {
    const Piece* largest = nullptr;
    for (const Piece& p : pieces_)
        if (p.slot == slot && (!largest || p.shape.area_m2 > largest->shape.area_m2)) largest = &p;
    return largest && &part != largest && part.shape.depth_m > largest->shape.depth_m + kSeenThrough_m;
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
    for (const Piece& p : pieces_)
        if (p.slot < Identity::kMost || p.slot == kFragment) mark(p.cells, kTracked);
    drop_scene();
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
        if (behind_sum > kSeenThrough_m * neighbours && (beside_scene(p.shape) || part_of_scene(p))) continue;
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
        if (p.home < Identity::kMost && behind_person(p, p.home) && part_of_scene(p))
            p.home = Identity::kMost;
        if (p.home < Identity::kMost) p.slot = kFragment;
    }
    for (const Piece& p : pieces_) unmark(p.cells, kTracked);
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
