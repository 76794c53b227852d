#include "track/people_map.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"
#include "track/user_map.h"

namespace vfit {

namespace {

constexpr uint32_t kFewestCells = 6;    // a finger at 3 m
constexpr float kLeastSeen_m2 = 0.05f;  // of somebody known: head and a shoulder
// Seen of two people in two places who were taken for one.
constexpr float kWhole_m2 = 0.2f, kTwoApart_m = 0.35f;
constexpr double kFewShare = 0.002;   // of the image: less than a head at 5 m
constexpr float kMostBorder = 0.08f;  // of the image, that a sensor leaves without readings

}  // namespace

void PeopleMap::reset() {
    for (FloorFinder& floor : floors_) floor.reset();
    background_.reset();
    life_.reset();
    forget_people();
    filled_ = {};
    time_ns_ = 0;
}

void PeopleMap::forget_people() {
    identity_.reset();
    std::fill(last_slots_.begin(), last_slots_.end(), uint8_t(0));
    frames_ = 0;  // those who touch are told apart at once, as in the first image
}

void PeopleMap::doubt_floor() {
    floor_->reset();
    background_.reset();
}

void PeopleMap::look(const DepthImage& image) {
    grid_.run(image);
    camera_ = image.camera;
    const Vec3 up = camera_.side_up();
    floor_ = &floors_[up.y < 0 ? 0 : up.y > 0 ? 2 : up.x < 0 ? 1 : 3];
    floor_seen_ = floor_->run(grid_, camera_);
    if (columns_ == grid_.width() && wanted_.size() == grid_.cells()) return;
    columns_ = grid_.width();
    for (auto* v : {&wanted_, &slots_, &last_slots_, &labels_}) v->assign(grid_.cells(), 0);
    last_depth_.assign(grid_.cells(), 0.0f);
    // A component may be rid of tables or split by tracks, and its parts be split by heads.
    pool_.resize(3 * size_t(grid_.cells()));
    frontier_.resize(grid_.cells());
    splitter_.fit(grid_);
    life_.fit(grid_);
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
    background_.fit(grid_);
    const bool floor = floor_seen_ || floor_->found();
    const Vec3 n = camera_.floor_normal;
    const float d = camera_.floor_distance_m;
    // Above the floor cut, which is linear in z: z slope + d > floor_cut_m(d, z). Without a floor all is
    // above it.
    const float cut = floor_cut_m(d, 0.0f), rise = floor_cut_m(d, 1.0f) - cut;
    const float least = floor ? cut - d : -1e9f, farthest = options_.farthest_m;
    const uint32_t width = grid_.width();
    for (uint32_t y = 0; y < grid_.height(); ++y) {
        const float row = n.y * grid_.ray_y()[y] + n.z - rise, across = n.x;
        const float* const depth = grid_.depth().data() + size_t(y) * width;
        const float* const known = background_.known().data() + size_t(y) * width;
        const float* const ray = grid_.ray_x().data();
        uint8_t* const wanted = wanted_.data() + size_t(y) * width;
        for (uint32_t x = 0; x < width; ++x) {  // without branches, for vectors
            const float z = depth[x], b = known[x], slope = across * ray[x] + row;
            const float news = b - same_surface_m(z) - z;  // > 0: before the background
            // The floor itself is known better than as background: a learned one must not take the toes.
            const float on_floor = floor ? least - b * slope : -1.0f;
            wanted[x] =
                uint8_t(int(z > 0.0f) & int(z < farthest) & int(z * slope > least) &
                        (int(news >= 0.0f) | int(z > b + BackgroundModel::kGone_m) | int(on_floor > 0.0f)));
        }
    }
}

Shape PeopleMap::measure(std::span<const uint32_t> cells) const {
    ShapeMeter meter(grid_, camera_, view_);
    meter.add(cells);
    return meter.finish();
}

// A part of somebody that does not hang together with the rest: it may be somebody else, who comes out from
// behind.
uint32_t PeopleMap::owner_of_part(const Piece& p, const std::array<const Piece*, Identity::kMost>& largest,
                                  int64_t time_ns) {
    const float away = floor_distance(p.shape.centre, largest[p.slot]->shape.centre);
    const uint32_t hidden = identity_.hidden_near(p.shape, away, time_ns);
    if (hidden != Identity::kMost && p.shape.area_m2 > kLeastSeen_m2) return hidden;
    if (p.shape.area_m2 > kWhole_m2 && away > kTwoApart_m && person_like(p.cells, p.shape)) return kNew;
    // What they have left behind is theirs no more.
    return identity_.within_reach(p.slot, p.shape.centre) ? p.slot : kThing;
}

// People keep their slots; newcomers get one, or that of somebody who has come back.
void PeopleMap::name_people(int64_t time_ns) {
    std::array<float, Identity::kMost> area{};
    for (const Piece& p : pieces_)
        if (p.slot < Identity::kMost) area[p.slot] += p.shape.area_m2;
    for (Piece& p : pieces_)
        if (p.slot < Identity::kMost && area[p.slot] < kLeastSeen_m2) p.slot = kFragment;
    // The largest piece of each stands for them.
    std::array<const Piece*, Identity::kMost> largest{};
    for (const Piece& p : pieces_)
        if (p.slot < Identity::kMost &&
            (!largest[p.slot] || p.shape.area_m2 > largest[p.slot]->shape.area_m2))
            largest[p.slot] = &p;
    for (uint32_t slot = 0; slot < Identity::kMost; ++slot)
        if (largest[slot]) identity_.see(slot, largest[slot]->shape, time_ns);
    for (Piece& p : pieces_)
        if (p.slot < Identity::kMost && &p != largest[p.slot]) p.slot = owner_of_part(p, largest, time_ns);
    for (const Piece& p : pieces_)
        if (p.slot < Identity::kMost && !largest[p.slot] && !identity_.track(p.slot).seen)
            identity_.see(p.slot, p.shape, time_ns);
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
    name_wholes(time_ns);
    std::fill(slots_.begin(), slots_.end(), uint8_t(0));
    for (const Piece& p : pieces_)
        if (p.slot < Identity::kMost)
            for (const uint32_t cell : p.cells) slots_[cell] = uint8_t(p.slot + 1);
}

// Heads were found by their outlines alone: newcomers who were split from a larger piece may be a part of it.
void PeopleMap::name_wholes(int64_t time_ns) {
    for (const Piece& p : pieces_) {
        if (!p.split || p.slot >= Identity::kMost || identity_.track(p.slot).first_ns != time_ns) continue;
        const Piece* whole = nullptr;
        for (const Piece& q : pieces_)
            if (q.split == p.split && q.slot < Identity::kMost && q.shape.area_m2 > p.shape.area_m2 &&
                (!whole || q.shape.area_m2 > whole->shape.area_m2))
                whole = &q;
        if (whole) identity_.change(p.slot).part_of = identity_.track(whole->slot).id;
    }
}

uint32_t PeopleMap::slot_of(uint32_t id) const {
    for (uint32_t slot = 0; slot < Identity::kMost; ++slot)
        if (id && identity_.track(slot).id == id) return slot;
    return Identity::kMost;
}

void PeopleMap::confirm(uint32_t id) {
    if (const uint32_t slot = slot_of(id); slot < Identity::kMost) identity_.change(slot).part_of = 0;
}

void PeopleMap::rejoin(uint32_t id) {
    const uint32_t slot = slot_of(id);
    if (slot == Identity::kMost) return;
    const uint32_t whole = slot_of(identity_.track(slot).part_of);
    if (whole == Identity::kMost) return;
    std::replace(last_slots_.begin(), last_slots_.end(), uint8_t(slot + 1), uint8_t(whole + 1));
    identity_.change(whole).alone_ns = identity_.track(whole).seen_ns;
    identity_.forget(slot);
}

void PeopleMap::look_for_life(float dt_s) {
    std::array<uint32_t, LifeSigns::kSlots> ids{};
    for (uint32_t slot = 0; slot < Identity::kMost; ++slot) ids[slot] = identity_.track(slot).id;
    life_.see(grid_, slots_, ids, dt_s);
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
        r.part_of = identity_.track(slot).part_of;
        r.lifeless_s = life_.lifeless_s(slot);
        regions_.push_back(r);
    }
    for_each_labelled(slots_, [&](size_t i) { labels_[i] = ids[slots_[i]]; });
    write_user_map(image, grid_, labels_.data(), users);
    std::fill(labels_.begin(), labels_.end(), uint8_t(0));
}

std::span<const PersonRegion> PeopleMap::run(const DepthImage& image, int64_t time_ns, uint8_t* users) {
    look(image);
    frames_ += time_ns != time_ns_ || frames_ == 0;
    find_view();
    cut_floor_and_background();
    components_.run(grid_, wanted_.data(), kFewestCells);
    identity_.begin(time_ns);
    sort_components();
    name_people(time_ns);
    attach_fragments();
    grow_feet();
    const float passed_s = time_ns_ == 0 ? 0.0f : std::max(0.0f, float(seconds_between(time_ns_, time_ns)));
    look_for_life(passed_s);
    report(image, time_ns, users);
    if (options_.learn_background) background_.learn(grid_, slots_.data(), std::min(passed_s, 0.1f));
    // A fragment is anybody's again in the next image: it may be the first that is seen of somebody else.
    for (const Piece& p : pieces_)
        if (p.slot == kFragment)
            for (const uint32_t cell : p.cells) slots_[cell] = 0;
    std::swap(slots_, last_slots_);
    std::copy(grid_.depth().begin(), grid_.depth().begin() + std::ptrdiff_t(grid_.cells()),
              last_depth_.begin());
    time_ns_ = time_ns;
    return regions_;
}

Absence PeopleMap::why_absent() const {
    size_t readings = 0, close = 0, wanted = 0;
    for (size_t i = 0; i < grid_.cells(); ++i) {
        const float z = grid_.depth()[i];
        readings += z > 0.0f, close += z > 0.0f && z < options_.farthest_m, wanted += wanted_[i] != 0;
    }
    const auto few = [&](size_t cells) { return double(cells) < kFewShare * double(grid_.cells()); };
    return few(readings)      ? Absence::kNoReadings
           : few(close)       ? Absence::kTooFar
           : few(wanted)      ? Absence::kBackgroundOnly
           : regions_.empty() ? Absence::kNoShape
                              : Absence::kNoPerson;
}

void PeopleMap::learn_background(const DepthImage& image) {
    look(image);
    background_.learn_empty(grid_);
}

void PeopleMap::reject(uint32_t id) {
    const uint32_t slot = slot_of(id);
    if (slot == Identity::kMost) return;
    for (size_t i = 0; i < last_slots_.size(); ++i) {
        if (last_slots_[i] != slot + 1) continue;
        background_.add(grid_, i);
        last_slots_[i] = 0;
    }
    identity_.forget(slot);
}

}  // namespace vfit
