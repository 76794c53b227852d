#include "track/people_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "track/user_map.h"

namespace vfit {

namespace {

// The cut above the floor: unevenness of floor and plane, and two sigma of a reading's noise as height.
constexpr float kFloorSlack_m = 0.010f, kFloorSigmas = 2.0f;
constexpr float kInverseSigma = 1.6e-3f;      // of 1 / z in 1/m, as in floor_finder.cpp

constexpr uint32_t kFewestCells = 6;          // a finger at 3 m
constexpr float kFragment_m2 = 0.12f;         // a forearm and hand, or a shank, seen by themselves
constexpr float kSamePlace_m = 0.2f;          // along the view, from frame to frame: 6 m/s at 30 Hz
constexpr uint32_t kFewestVotes = 10;
constexpr float kVoteShare = 0.1f;
constexpr float kGrowth = 1.4f, kGrowth_m2 = 0.15f;  // of the seen area from frame to frame; more is somebody else's
constexpr float kGrowthPath_m = 0.3f;         // a hand's way in a frame: 9 m/s at 30 Hz
constexpr float kReach_m = 1.2f;              // from the trunk to the fingertips, and a step
constexpr float kWall_m2 = 2.5f;              // more than two people: looked at now and then only
constexpr float kOnlyWall_m2 = 6.0f;
constexpr uint32_t kWallTurn = 10;            // frames
constexpr float kTwo_m2 = 0.7f;               // seen of two people who were taken for one
constexpr uint32_t kTwoTurn = 5;              // frames
constexpr float kSplitArea_m2 = 0.3f;         // below, nobody stands in front of anything
constexpr float kTwoWide_m = 0.55f;           // of two side by side; one with hanging arms is 0.45 to 0.6 m wide
constexpr float kHeadReach_m = 1.1f;          // along the surface from the axis to the hands or feet
constexpr float kLeastSeen_m2 = 0.05f;        // of somebody known: head and a shoulder
// From a fragment to the person it is of: a hand before the trunk hides the forearm; what is behind is wall.
constexpr float kInFront_m = 0.7f, kBehind_m = 0.4f, kSeenThrough_m = 0.08f, kAside_m = 0.9f, kBeside_m = 0.05f;
// Soles: cells of the floor cut that are higher than the floor after all, a few cells around the feet.
constexpr float kFeetBelow_m = 0.12f, kSole_m = 0.0045f, kSoleSigmas = 0.3f;
constexpr int kSoleSteps = 4;
constexpr int kFragmentGap = 4;               // cells
constexpr float kMostBorder = 0.08f;          // of the image, that a sensor leaves without readings

bool within_reach(const Vec3& p, const PersonTrack& track) {
    const Vec3 away = p - track.centre;
    return away.x * away.x + away.z * away.z < kReach_m * kReach_m;
}

float seconds(int64_t ns) { return float(double(ns) * 1e-9); }

}  // namespace

void PeopleMap::reset() {
    floor_.reset();
    background_.reset();
    identity_.reset();
    std::fill(last_slots_.begin(), last_slots_.end(), uint8_t(0));
    filled_ = {};
    time_ns_ = 0;
}

void PeopleMap::look(const DepthImage& image) {
    grid_.run(image);
    camera_ = image.camera;
    floor_seen_ = floor_.run(grid_, camera_);
    if (wanted_.size() == grid_.cells()) return;
    for (auto* v : {&wanted_, &slots_, &last_slots_, &labels_}) v->assign(grid_.cells(), 0);
    last_depth_.assign(grid_.cells(), 0.0f);
    pool_.resize(grid_.cells());
    frontier_.resize(grid_.cells());
    splitter_.fit(grid_);
    pieces_.reserve(grid_.cells() / kFewestCells + 1);
    regions_.reserve(Identity::kMost);
    filled_ = {};
}

// The part of the image that the sensor fills: aligned depth images leave a border empty.
void PeopleMap::find_view() {
    const int width = int(grid_.width()), height = int(grid_.height());
    if (filled_[2] == 0) filled_ = {width, height, 0, 0};
    const float* z = grid_.depth().data();
    for (int y = 0; y < height; ++y, z += width) {
        int first = 0, last = width;
        while (first < width && z[first] == 0.0f) ++first;
        if (first == width) continue;
        while (z[last - 1] == 0.0f) --last;
        filled_[0] = std::min(filled_[0], first);
        filled_[2] = std::max(filled_[2], last);
        filled_[1] = std::min(filled_[1], y);
        filled_[3] = std::max(filled_[3], y + 1);
    }
    // A wider border is no sensor's: the scene ends there, or somebody else has cut the person out.
    const int dx = int(kMostBorder * float(width)), dy = int(kMostBorder * float(height));
    view_ = {filled_[0] <= dx ? filled_[0] : 0, filled_[1] <= dy ? filled_[1] : 0,
             filled_[2] >= width - dx ? filled_[2] : width, filled_[3] >= height - dy ? filled_[3] : height};
}

void PeopleMap::cut_floor_and_background() {
    const bool floor = floor_seen_ || floor_.found();
    const Vec3 n = camera_.floor_normal;
    const float d = camera_.floor_distance_m, noise = kFloorSigmas * kInverseSigma * d;
    background_.fit(grid_);
    const float farthest = options_.farthest_m;
    for (uint32_t y = 0; y < grid_.height(); ++y) {
        const float row = n.y * grid_.ray_y()[y] + n.z;
        const size_t first = size_t(y) * grid_.width();
        const float* const depth = grid_.depth().data() + first;
        const float* const ray = grid_.ray_x().data();
        uint8_t* const wanted = wanted_.data() + first;
        for (uint32_t x = 0; x < grid_.width(); ++x) {  // without branches, for vectors
            const float z = depth[x], slope = n.x * ray[x] + row, b = background_.depth(first + x);
            const int known = background_.covers(first + x, z);
            const int above = z * slope + d > kFloorSlack_m + noise * z;
            // The floor itself is known better than as background: a learned one must not take the toes.
            const int on_floor = b * slope + d < kFloorSlack_m + noise * b;
            wanted[x] = uint8_t(int(z > 0.0f) & int(z < farthest) & (above | int(!floor)) &
                                ((known ^ 1) | (int(floor) & on_floor)));
        }
    }
}

Shape PeopleMap::measure(std::span<const uint32_t> cells) const {
    ShapeMeter meter(grid_, camera_, view_);
    meter.add(cells);
    return meter.finish();
}

bool PeopleMap::feet_hidden(std::span<const uint32_t> cells) const {
    const ShapeMeter meter(grid_, camera_, {});
    const int down = meter.down();
    const int width = int(grid_.width());
    uint32_t nearer = 0, farther = 0;
    for (const uint32_t cell : cells) {
        const float z = grid_.depth()[cell], same = same_surface_m(z);
        for (int k = 1; k <= 3; ++k) {
            const int next = int(cell) + k * down;
            if (next < 0 || next >= int(grid_.cells())) break;
            if (std::abs(down) == 1 && next / width != int(cell) / width) break;
            const float other = grid_.depth()[size_t(next)];
            if (other == 0.0f) continue;
            nearer += other < z - same;
            farther += other > z + same;
            break;
        }
    }
    return nearer > farther && nearer >= 6;
}

bool PeopleMap::person_like(std::span<const uint32_t> cells, const Shape& shape) const {
    const bool floor = camera_.floor_state != VFIT_FLOOR_DEFAULT;
    if (looks_like_person(shape, floor, false)) return true;
    return looks_like_person(shape, floor, true) && feet_hidden(cells);
}

void PeopleMap::add_piece(std::span<const uint32_t> cells, const Shape& shape, uint32_t slot) {
    if (!cells.empty() && pieces_.size() < pieces_.capacity()) pieces_.push_back({cells, shape, slot, 0});
}

void PeopleMap::classify_new(std::span<const uint32_t> cells, const Shape& shape) {
    if (cells.empty()) return;
    if (person_like(cells, shape))
        add_piece(cells, shape, kNew);
    else
        add_piece(cells, shape, shape.area_m2 < kFragment_m2 ? kFragment : kThing);
}

// Every cell goes to the person whose last place is nearest along the surface.
void PeopleMap::split_by_tracks(std::span<const uint32_t> cells, std::span<const uint32_t> slots, float farthest_m) {
    splitter_.begin(grid_, cells);
    const ShapeMeter meter(grid_, camera_, view_);
    for (const uint32_t cell : cells) {
        const uint8_t last = last_slots_[cell];
        if (last == 0 || std::abs(grid_.depth()[cell] - last_depth_[cell]) > kSamePlace_m) continue;
        for (size_t k = 0; k < slots.size(); ++k)
            if (slots[k] + 1 == last && within_reach(meter.world(cell), identity_.track(slots[k])))
                splitter_.seed(cell, uint8_t(k + 1));
    }
    splitter_.grow(farthest_m);
    for (size_t k = 0; k <= slots.size(); ++k) {
        const auto piece = splitter_.piece(uint8_t(k));
        const auto begin = pool_.begin() + std::ptrdiff_t(pool_used_);
        std::copy(piece.begin(), piece.end(), begin);
        const std::span<const uint32_t> kept(pool_.data() + pool_used_, piece.size());
        pool_used_ += piece.size();
        if (kept.empty()) continue;
        const Shape shape = measure(kept);
        if (k == 0)
            classify_new(kept, shape);
        else
            add_piece(kept, shape, slots[k - 1]);
    }
}

// slot: whose component it was until now; the largest share of their last place keeps their number.
bool PeopleMap::split_by_heads(std::span<const uint32_t> cells, uint8_t fewest, uint32_t slot) {
    splitter_.begin(grid_, cells);
    const uint8_t heads = splitter_.seed_heads(ShapeMeter(grid_, camera_, {}));
    if (heads < fewest) return false;
    splitter_.grow(kHeadReach_m);
    uint8_t keeper = 0;
    size_t most = 0;
    for (uint8_t k = 1; k <= heads && slot != kNew; ++k) {
        const auto piece = splitter_.piece(k);
        const auto votes = size_t(std::count_if(piece.begin(), piece.end(),
                                                [&](uint32_t cell) { return last_slots_[cell] == slot + 1; }));
        if (votes > most) {
            most = votes;
            keeper = k;
        }
    }
    for (uint8_t k = 1; k <= heads; ++k) {
        const auto piece = splitter_.piece(k);
        if (piece.empty()) continue;
        std::copy(piece.begin(), piece.end(), pool_.begin() + std::ptrdiff_t(pool_used_));
        const std::span<const uint32_t> kept(pool_.data() + pool_used_, piece.size());
        pool_used_ += piece.size();
        if (k == keeper)
            add_piece(kept, measure(kept), slot);
        else
            classify_new(kept, measure(kept));
    }
    return true;
}

void PeopleMap::sort_component(std::span<const uint32_t> cells) {
    std::array<uint32_t, Identity::kMost + 1> votes{};
    float area_m2 = 0.0f;
    for (const uint32_t cell : cells) {
        const uint8_t last = last_slots_[cell];
        const float z = grid_.depth()[cell];
        area_m2 += grid_.area_m2(z);
        if (last != 0 && std::abs(z - last_depth_[cell]) < kSamePlace_m) ++votes[last];
    }
    std::array<uint32_t, Splitter::kMostSeeds> slots;
    size_t count = 0;
    for (uint32_t slot = 0; slot < Identity::kMost && count < slots.size(); ++slot) {
        const uint32_t most = std::min(identity_.track(slot).cells, uint32_t(cells.size()));
        if (identity_.taken(slot) && votes[slot + 1] >= kFewestVotes &&
            float(votes[slot + 1]) >= kVoteShare * float(most))
            slots[count++] = slot;
    }
    const bool wall = area_m2 > kWall_m2;
    if (count >= 2) {
        split_by_tracks(cells, {slots.data(), count}, wall ? kGrowthPath_m : std::numeric_limits<float>::max());
        return;
    }
    if (count == 1 && area_m2 > kGrowth * identity_.track(slots[0]).area_m2 + kGrowth_m2) {
        split_by_tracks(cells, {slots.data(), 1}, kGrowthPath_m);
        return;
    }
    if (count == 0 && wall && (area_m2 > kOnlyWall_m2 || frames_ % kWallTurn != 1)) return;
    const Shape shape = measure(cells);
    if (count == 1) {
        const bool two = shape.width_m > kTwoWide_m && shape.area_m2 > kTwo_m2 && frames_ % kTwoTurn == 1;
        if (!two || !split_by_heads(cells, 2, slots[0])) add_piece(cells, shape, slots[0]);
    } else {
        // Two who stand close can pass for one broad person, and one at a table for none.
        const bool whole = shape.area_m2 < kSplitArea_m2 || person_like(cells, shape);
        if ((whole && shape.width_m < kTwoWide_m) || !split_by_heads(cells, whole ? 2 : 1))
            classify_new(cells, shape);
    }
}

void PeopleMap::sort_components() {
    pieces_.clear();
    pool_used_ = 0;
    for (size_t i = 0; i < components_.size(); ++i) sort_component(components_.cells(i));
}

// People keep their slots; newcomers get one, or that of somebody who has come back.
void PeopleMap::name_people(int64_t time_ns) {
    std::array<float, Identity::kMost> area{};
    for (const Piece& p : pieces_)
        if (p.slot < Identity::kMost) area[p.slot] += p.shape.area_m2;
    for (Piece& p : pieces_)
        if (p.slot < Identity::kMost && area[p.slot] < kLeastSeen_m2) p.slot = kFragment;
    // The largest piece of each stands for them; what they have left behind is theirs no more.
    for (uint32_t slot = 0; slot < Identity::kMost; ++slot) {
        const Piece* largest = nullptr;
        for (const Piece& p : pieces_)
            if (p.slot == slot && (!largest || p.shape.area_m2 > largest->shape.area_m2)) largest = &p;
        if (!largest) continue;
        identity_.see(slot, largest->shape, time_ns);
        for (Piece& p : pieces_)
            if (p.slot == slot && !within_reach(p.shape.centre, identity_.track(slot))) p.slot = kThing;
    }
    for (Piece& p : pieces_) {
        if (p.slot != kNew) continue;
        const uint32_t slot = identity_.adopt(p.shape, time_ns);
        if (slot == Identity::kMost) {
            p.slot = kThing;
            continue;
        }
        p.slot = slot;
        identity_.see(slot, p.shape, time_ns);
    }
    std::fill(slots_.begin(), slots_.end(), uint8_t(0));
    for (const Piece& p : pieces_)
        if (p.slot < Identity::kMost)
            for (const uint32_t cell : p.cells) slots_[cell] = uint8_t(p.slot + 1);
}

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

// A hand before the trunk, a head above a dark collar: what lies beside a person in the image and near them in
// space is theirs.
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
    for (const Piece& p : pieces_)
        if (p.slot == kFragment && p.home < Identity::kMost)
            for (const uint32_t cell : p.cells) slots_[cell] = uint8_t(p.home + 1);
}

// The floor cut takes the soles with it. Around feet the mean height of 3 x 3 cells, which is less noisy than the
// single one, tells them from the floor.
void PeopleMap::grow_feet() {
    if (!floor_seen_ && !floor_.found()) return;
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
        return z > 0.0f && !wanted_[i] &&
               std::abs(height_of(x, y)) < 2.0f * (kFloorSlack_m + kFloorSigmas * kInverseSigma * d * z);
    };
    size_t count = 0;
    for (int y = 0, i = 0; y < height; ++y)
        for (int x = 0; x < width; ++x, ++i)
            if (slots_[size_t(i)] && height_of(x, y) < kFeetBelow_m) frontier_[count++] = uint32_t(i);
    size_t first = 0;
    for (int step = 0; step < kSoleSteps; ++step) {
        const size_t last = count;
        for (; first < last; ++first) {
            const int from = int(frontier_[first]), fx = from % width, fy = from / width;
            const float z = grid_.depth()[size_t(from)];
            const auto visit = [&](int x, int y) {
                if (x < 1 || y < 1 || x >= width - 1 || y >= height - 1) return;
                const size_t i = size_t(y * width + x);
                if (slots_[i] || !floor_like(x, y) || std::abs(grid_.depth()[i] - z) > same_surface_m(z)) return;
                float sum = 0.0f;
                int cells = 0;
                for (int b = -1; b <= 1; ++b)
                    for (int a = -1; a <= 1; ++a)
                        if (floor_like(x + a, y + b)) {
                            sum += height_of(x + a, y + b);
                            ++cells;
                        }
                if (sum < float(cells) * (kSole_m + kSoleSigmas * kInverseSigma * d * z)) return;
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

void PeopleMap::report(const DepthImage& image, int64_t time_ns, uint8_t* users) {
    const bool floor = camera_.floor_state != VFIT_FLOOR_DEFAULT;
    regions_.clear();
    const int stride = int(grid_.stride());
    std::array<uint8_t, Identity::kMost + 1> ids{};
    for (uint32_t slot = 0; slot < Identity::kMost; ++slot) {
        if (!identity_.track(slot).seen) continue;
        ids[slot + 1] = uint8_t(identity_.track(slot).id);
        ShapeMeter meter(grid_, camera_, view_);
        const Piece* only = nullptr;
        size_t parts = 0;
        for (const Piece& p : pieces_)
            if (p.slot == slot || (p.slot == kFragment && p.home == slot)) {
                only = &p;
                ++parts;
            }
        if (parts > 1)
            for (const Piece& p : pieces_)
                if (p.slot == slot || (p.slot == kFragment && p.home == slot)) meter.add(p.cells);
        if (parts == 0) continue;
        const Shape shape = parts == 1 ? only->shape : meter.finish();
        identity_.see(slot, shape, time_ns);
        PersonRegion r;
        r.id = identity_.track(slot).id;
        r.box = {shape.x0 * stride, shape.y0 * stride, shape.x1 * stride, shape.y1 * stride};
        r.centre = shape.centre;
        r.height_m = floor ? shape.high_m : shape.height_m();
        r.width_m = shape.width_m;
        r.pixels = shape.cells * uint32_t(stride * stride);
        r.out_of_view = shape.out_of_view;
        regions_.push_back(r);
    }
    for (size_t i = 0; i < slots_.size(); ++i) labels_[i] = ids[slots_[i]];
    write_user_map(image, grid_, labels_.data(), users);
}

std::span<const PersonRegion> PeopleMap::run(const DepthImage& image, int64_t time_ns, uint8_t* users) {
    look(image);
    ++frames_;
    find_view();
    cut_floor_and_background();
    components_.run(grid_, wanted_.data(), kFewestCells);
    identity_.begin(time_ns);
    sort_components();
    name_people(time_ns);
    attach_fragments();
    grow_feet();
    report(image, time_ns, users);
    if (options_.learn_background) {
        const float dt_s = std::clamp(seconds(time_ns - time_ns_), 0.0f, 0.1f);
        background_.learn(grid_, slots_.data(), time_ns_ == 0 ? 0.0f : dt_s);
    }
    std::swap(slots_, last_slots_);
    std::copy(grid_.depth().begin(), grid_.depth().begin() + std::ptrdiff_t(grid_.cells()), last_depth_.begin());
    time_ns_ = time_ns;
    return regions_;
}

void PeopleMap::learn_background(const DepthImage& image) {
    look(image);
    background_.learn_empty(grid_);
}

void PeopleMap::reject(uint32_t id) {
    for (uint32_t slot = 0; slot < Identity::kMost; ++slot) {
        if (identity_.track(slot).id != id) continue;
        for (size_t i = 0; i < last_slots_.size(); ++i) {
            if (last_slots_[i] != slot + 1) continue;
            background_.add(grid_, i);
            last_slots_[i] = 0;
        }
        identity_.forget(slot);
    }
}

}  // namespace vfit
