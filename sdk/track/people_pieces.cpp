// The part of PeopleMap that makes pieces of components: whose each is, what looks like a new person, and
// what has to be taken apart first.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/clock.h"
#include "track/people_map.h"

namespace vfit {

namespace {

constexpr float kLowerEnd_m = 0.15f;   // where it is looked what is below
constexpr int kBelowCells = 3;         // and how far: beyond an outline without readings
constexpr float kFloorBelow_m = 0.3f;  // feet do not stand on what is higher
constexpr float kFragment_m2 = 0.12f;  // a forearm and hand, or a shank, seen by themselves
constexpr float kSamePlace_m = 0.2f;   // along the view, from frame to frame: 6 m/s at 30 Hz
constexpr uint32_t kFewestVotes = 10;  // cells in the same place
constexpr float kVoteShare = 0.1f;     // of the person's cells
// Of the seen area from frame to frame; more is somebody else's.
constexpr float kGrowth = 1.4f, kGrowth_m2 = 0.15f;
constexpr float kBorder_m = 0.08f;     // a forearm
constexpr float kGrowthPath_m = 0.3f;  // a hand's way in a frame: 9 m/s at 30 Hz
// More than one person: looked at now and then only; more than two: nobody's limbs reach everywhere; more
// than a crowd: a wall.
constexpr float kWall_m2 = 1.5f, kCrowd_m2 = 2.5f, kOnlyWall_m2 = 6.0f;
constexpr uint32_t kWallTurn = 30;     // frames
constexpr float kTwo_m2 = 0.7f;        // seen of two people who were taken for one
constexpr uint32_t kTwoTurn = 5;       // frames
constexpr float kTwoWide_m = 0.55f;    // of two side by side; one with hanging arms is 0.45 to 0.6 m wide
constexpr uint32_t kFewestRim = 12;    // cells
constexpr float kYoung_s = 1.0f;       // until then who has been found is still doubted
constexpr float kAlone_s = 2.0f;       // until a person is split anew who turned out to be one
constexpr float kSplitArea_m2 = 0.3f;  // below, nobody stands in front of anything
constexpr float kHeadReach_m = 1.1f;   // along the surface from the axis to the hands or feet

}  // namespace

// Below the lower end something stands that is nearer, or nothing sends back light (black trousers), or the
// person is at a piece of furniture that is known. Where the scene is seen there are no feet.
bool PeopleMap::feet_hidden(std::span<const uint32_t> cells, const Shape& shape) const {
    const ShapeMeter meter(grid_, camera_, {});
    const int down = meter.down();
    const int width = int(grid_.width());
    uint32_t nearer = 0, farther = 0, dark = 0;
    grid_.for_each(cells, [&](uint32_t cell, uint32_t x, uint32_t y) {
        if (meter.world(x, y).y > shape.low_m + kLowerEnd_m) return;
        const float z = grid_.depth()[cell], same = grid_.same_surface_m(z);
        for (int k = 1; k <= kBelowCells; ++k) {
            const int next = int(cell) + k * down;
            if (next < 0 || next >= int(grid_.cells())) break;
            if (std::abs(down) == 1 && next / width != int(y)) break;
            const float other = grid_.depth()[size_t(next)];
            if (other == 0.0f) {
                dark += k == kBelowCells;
                continue;
            }
            nearer += other < z - same ||
                      (!wanted_[size_t(next)] && other < z + same && shape.low_m > kFloorBelow_m);
            farther += other > z + same;
            break;
        }
    });
    return nearer + dark > farther && nearer + dark >= 6;
}

bool PeopleMap::person_like(std::span<const uint32_t> cells, const Shape& shape) const {
    const bool floor = camera_.floor_state != VFIT_FLOOR_DEFAULT;
    if (looks_like_person(shape, floor, false)) return true;
    return looks_like_person(shape, floor, true) && feet_hidden(cells, shape);
}

void PeopleMap::add_piece(std::span<const uint32_t> cells, const Shape& shape, uint32_t slot) {
    if (!cells.empty() && pieces_.size() < pieces_.capacity())
        pieces_.push_back({cells, shape, slot, 0, split_});
}

void PeopleMap::mark(std::span<const uint32_t> cells, Mark m) {
    for (const uint32_t cell : cells) labels_[cell] |= m;
}

void PeopleMap::unmark(std::span<const uint32_t> cells, Mark m) {
    for (const uint32_t cell : cells) labels_[cell] &= uint8_t(~m);
}

// A patch of wall or floor, that somebody has hidden until now or that was cut out of more of it: the same
// surface goes on beside it. Around a person the scene lies farther away. What is nearer says nothing: it
// hides whatever there is.
bool PeopleMap::surface_goes_on(std::span<const uint32_t> cells) {
    const uint32_t width = grid_.width(), height = grid_.height();
    const float* const depth = grid_.depth().data();
    const ShapeMeter meter(grid_, camera_, {});
    const bool floor = camera_.floor_state != VFIT_FLOOR_DEFAULT;
    mark(cells, kOwn);
    uint32_t joined = 0, farther = 0;
    grid_.for_each(cells, [&](uint32_t cell, uint32_t x, uint32_t y) {
        if (floor && meter.world(x, y).y < kLowerEnd_m) return;  // feet join the floor
        const float z = depth[cell], same = grid_.same_surface_m(z);
        const auto look = [&](uint32_t next) {
            if (labels_[next] || depth[next] == 0.0f) return;
            joined += std::abs(depth[next] - z) < same;
            farther += depth[next] - z >= same;
        };
        if (x > 0) look(cell - 1);
        if (x + 1 < width) look(cell + 1);
        if (y > 0) look(cell - width);
        if (y + 1 < height) look(cell + width);
    });
    unmark(cells, kOwn);
    return joined > farther && joined >= kFewestRim;
}

void PeopleMap::classify_new(std::span<const uint32_t> cells, const Shape& shape) {
    if (cells.empty()) return;
    if (person_like(cells, shape) && !surface_goes_on(cells))
        add_piece(cells, shape, kNew);
    else
        add_piece(cells, shape, shape.area_m2 < kFragment_m2 ? kFragment : kThing);
}

// Where two people are one surface, the border of the last frame is no more than a guess: it is drawn afresh.
bool PeopleMap::disputed(uint32_t cell, uint32_t column, uint32_t row) const {
    const int width = int(grid_.width()), height = int(grid_.height());
    const int x = int(column), y = int(row);
    const float z = grid_.depth()[cell], same = grid_.same_surface_m(z);
    const int reach = std::max(1, int(kBorder_m / grid_.cell_m(z)));
    const auto other = [&](int nx, int ny) {
        if (nx < 0 || ny < 0 || nx >= width || ny >= height) return false;
        const size_t i = size_t(ny * width + nx);
        return last_slots_[i] != 0 && last_slots_[i] != last_slots_[cell] &&
               std::abs(grid_.depth()[i] - z) < same;
    };
    for (const int r : {reach, (reach + 1) / 2})
        if (other(x - r, y) || other(x + r, y) || other(x, y - r) || other(x, y + r)) return true;
    return false;
}

// Every cell goes to the person whose last place is nearest along the surface.
void PeopleMap::split_by_tracks(std::span<const uint32_t> cells, std::span<const uint32_t> slots,
                                float farthest_m) {
    splitter_.begin(grid_, cells);
    const ShapeMeter meter(grid_, camera_, view_);
    std::array<bool, Splitter::kMostSeeds> sure{};
    const auto seed = [&](bool again) {
        grid_.for_each(cells, [&](uint32_t cell, uint32_t x, uint32_t y) {
            const uint8_t last = last_slots_[cell];
            if (last == 0 || std::abs(grid_.depth()[cell] - last_depth_[cell]) > kSamePlace_m) return;
            const auto k = size_t(std::find(slots.begin(), slots.end(), last - 1u) - slots.begin());
            if (k == slots.size() || (again && sure[k]) ||
                !identity_.within_reach(slots[k], meter.world(x, y)))
                return;
            if (!again && slots.size() > 1 && disputed(cell, x, y)) return;
            if (!again) sure[k] = true;
            splitter_.seed(cell, uint8_t(k + 1));
        });
    };
    seed(false);
    // Of somebody who shows no more than a strip beside others, all is disputed.
    if (std::find(sure.begin(), sure.begin() + std::ptrdiff_t(slots.size()), false) != sure.end()) seed(true);
    splitter_.grow(farthest_m);
    std::array<std::span<const uint32_t>, Splitter::kMostSeeds + 1> kept;
    for (size_t k = 0; k <= slots.size(); ++k) kept[k] = keep(splitter_.piece(uint8_t(k)));
    for (size_t k = 1; k <= slots.size(); ++k) mark(kept[k], kTracked);
    if (!kept[0].empty()) classify_new(kept[0], measure(kept[0]));
    for (size_t k = 1; k <= slots.size(); ++k)
        if (!kept[k].empty()) add_person(kept[k], slots[k - 1]);
    for (size_t k = 1; k <= slots.size(); ++k) unmark(kept[k], kTracked);
}

// The splitter's pieces live until it splits the next component.
std::span<const uint32_t> PeopleMap::keep(std::span<const uint32_t> cells) {
    const std::span<uint32_t> room(pool_.data() + pool_used_, cells.size());
    std::copy(cells.begin(), cells.end(), room.begin());
    pool_used_ += cells.size();
    return room;
}

// Somebody known, who may have been two all the time.
void PeopleMap::add_person(std::span<const uint32_t> cells, uint32_t slot) {
    const Shape shape = measure(cells);
    // A wedge of wall between arm and trunk can pass for a person, until the arm moves and more of the wall
    // is seen.
    const PersonTrack& person = identity_.track(slot);
    const bool young = seconds_between(person.first_ns, person.seen_ns) < kYoung_s;
    if (young && (is_flat(shape) || surface_goes_on(cells))) {
        add_piece(cells, shape, kThing);
        return;
    }
    const bool alone =
        person.alone_ns && seconds_between(person.alone_ns, person.seen_ns) < kAlone_s;  // was looked at
    const bool two =
        shape.width_m > kTwoWide_m && shape.area_m2 > kTwo_m2 && frames_ % kTwoTurn == 1 && !alone;
    if (!two || !split_by_heads(cells, 2, slot)) add_piece(cells, shape, slot);
}

// slot: whose component it was until now; the largest share of their last place keeps their number.
bool PeopleMap::split_by_heads(std::span<const uint32_t> cells, uint8_t fewest, uint32_t slot) {
    splitter_.begin(grid_, cells);
    const uint8_t heads = splitter_.seed_heads(ShapeMeter(grid_, camera_, {}), fewest == 1);
    if (heads < fewest) return false;
    splitter_.grow(kHeadReach_m);
    uint8_t keeper = 0;
    size_t most = 0;
    for (uint8_t k = 1; k <= heads && slot != kNew; ++k) {
        const auto piece = splitter_.piece(k);
        const auto votes = size_t(std::count_if(
            piece.begin(), piece.end(), [&](uint32_t cell) { return last_slots_[cell] == slot + 1; }));
        if (votes > most) {
            most = votes;
            keeper = k;
        }
    }
    std::array<std::span<const uint32_t>, Splitter::kMostSeeds + 1> kept;
    for (uint8_t k = 1; k <= heads; ++k) mark(kept[k] = keep(splitter_.piece(k)), kBelowHead);
    split_ = ++splits_;
    for (uint8_t k = 1; k <= heads; ++k) {
        if (kept[k].empty()) continue;
        if (k == keeper)
            add_piece(kept[k], measure(kept[k]), slot);
        else
            classify_new(kept[k], measure(kept[k]));
    }
    split_ = 0;
    for (uint8_t k = 1; k <= heads; ++k) unmark(kept[k], kBelowHead);
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
    if (count >= 2) {
        const float farthest_m = area_m2 > kCrowd_m2 ? kGrowthPath_m : std::numeric_limits<float>::max();
        split_by_tracks(cells, {slots.data(), count}, farthest_m);
        return;
    }
    if (count == 1 && area_m2 > kGrowth * identity_.track(slots[0]).area_m2 + kGrowth_m2) {
        split_by_tracks(cells, {slots.data(), 1}, kGrowthPath_m);
        return;
    }
    if (count == 0 && area_m2 > kWall_m2 && (area_m2 > kOnlyWall_m2 || frames_ % kWallTurn != 1)) return;
    if (count == 1) {
        add_person(cells, slots[0]);
        return;
    }
    // Two who stand close can pass for one broad person, and one at a table for none.
    const Shape shape = measure(cells);
    const bool whole = shape.area_m2 < kSplitArea_m2 || person_like(cells, shape);
    const bool one = whole && shape.width_m < kTwoWide_m;
    if (!one && !is_flat(shape) && frames_ % kTwoTurn == 1) {
        const auto standing = without_tables(cells);
        const bool two = whole && standing.size() == cells.size();
        if (split_by_heads(standing, two ? 2 : 1)) return;
    }
    classify_new(cells, shape);
}

void PeopleMap::sort_components() {
    pieces_.clear();
    splits_ = 0;
    pool_used_ = 0;
    for (size_t i = 0; i < components_.size(); ++i) sort_component(components_.cells(i));
}

}  // namespace vfit
