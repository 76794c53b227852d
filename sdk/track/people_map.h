// The user map: which pixels are people, and which of them is who, from depth alone and without calibration.
//
// Floor and background are taken away, what remains falls into connected components, shapes that people
// cannot have are left out, people who touch are taken apart by where they were, and numbers are kept from
// frame to frame. Each step is a file of its own; this one strings them together.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "track/background.h"
#include "track/components.h"
#include "track/depth_filter.h"
#include "track/floor_finder.h"
#include "track/identity.h"
#include "track/life_signs.h"
#include "track/person_shape.h"
#include "track/splitter.h"

namespace vfit {

/// visit(i) for every i with labels[i] != 0, in order; most cells are nobody's, and are left out eight at a
/// time.
template <typename Visit>
void for_each_labelled(const std::vector<uint8_t>& labels, const Visit& visit) {
    for (size_t i = 0; i < labels.size(); ++i) {
        uint64_t eight = 1;
        if (i + 8 <= labels.size()) std::memcpy(&eight, labels.data() + i, sizeof eight);
        if (eight == 0)
            i += 7;
        else if (labels[i] != 0)
            visit(i);
    }
}

struct PersonRegion {
    uint32_t id = 0;        // 1..254
    PixelBox box;           // in pixels of the image
    Vec3 centre{0.0f};      // world, mean of what is seen
    float height_m = 0.0f;  // of the topmost point above the floor; from end to end where no floor is known
    float width_m = 0.0f;   // 5th to 95th percentile across the view
    uint32_t pixels = 0;    // of the cells that are theirs
    uint32_t out_of_view = 0;  // OutOfView
    uint32_t part_of = 0;      // id of the person whom they were split from, until confirm() or rejoin()
    float lifeless_s = 0.0f;   // for how long it has rested without a sign of life
};

/// Why an image shows no person.
enum class Absence {
    kNoReadings,      // the sensor saw nothing
    kTooFar,          // nothing within PeopleMapOptions::farthest_m
    kBackgroundOnly,  // nothing but the floor and what does not move
    kNoShape,         // what is there is no person by its measures
    kNoPerson,        // or the network says so
};

struct PeopleMapOptions {
    float farthest_m = 6.0f;  // people beyond are not looked for
    bool learn_background = true;
};

class PeopleMap {
public:
    explicit PeopleMap(const PeopleMapOptions& options = {}) : options_(options) {}

    /// Labels people, who stand as image.camera.floor_normal says: one byte a pixel of `users` (0: none,
    /// else the person's id). The regions stay valid until the next run. Does not allocate while images are
    /// no larger than the largest before.
    std::span<const PersonRegion> run(const DepthImage& image, int64_t time_ns, uint8_t* users);

    /// The image's camera with the floor, given or found (floor_state); the space of the regions' centres.
    const Camera& camera() const { return camera_; }
    /// Why the last run has found no person.
    Absence why_absent() const;
    /// The floor was seen in the last frame.
    bool floor_seen() const { return floor_seen_; }
    /// It was found, and may be out of sight.
    bool floor_found() const { return floor_->found(); }

    /// Forgets people, but not what does not move.
    void forget_people();
    /// The floor that was found is no floor: it is looked for anew.
    void doubt_floor();
    /// Nobody is in view.
    void learn_background(const DepthImage& image);
    /// That region of the last run was no person: it becomes background. Numbers that nobody has are ignored.
    void reject(uint32_t id);
    /// That region of the last run is a person of their own.
    void confirm(uint32_t id);
    /// It is a part of the person whom it was split from: from the next run on. That person is not split
    /// again for a while.
    void rejoin(uint32_t id);
    /// Forgets people, floor and background.
    void reset();

private:
    /// A component, or a part of one that was split.
    struct Piece {
        std::span<const uint32_t> cells;
        Shape shape;
        uint32_t slot = 0;   // of Identity; kNew, kFragment or kThing
        uint32_t home = 0;   // slot that a fragment goes to
        uint32_t split = 0;  // pieces with one number were split by heads; 0: was not
    };
    static constexpr uint32_t kNew = 1000, kFragment = 1001, kThing = 1002;

    void look(const DepthImage& image);
    void find_view();
    void cut_floor_and_background();
    void sort_components();
    void sort_component(std::span<const uint32_t> cells);
    void split_by_tracks(std::span<const uint32_t> cells, std::span<const uint32_t> slots, float farthest_m);
    bool disputed(uint32_t cell, uint32_t column, uint32_t row) const;
    bool split_by_heads(std::span<const uint32_t> cells, uint8_t fewest, uint32_t slot = kNew);
    /// The same without level surfaces that are large; they are background from then on.
    std::span<const uint32_t> without_tables(std::span<const uint32_t> cells);
    void add_person(std::span<const uint32_t> cells, uint32_t slot);
    std::span<const uint32_t> keep(std::span<const uint32_t> cells);
    void classify_new(std::span<const uint32_t> cells, const Shape& shape);
    void add_piece(std::span<const uint32_t> cells, const Shape& shape, uint32_t slot);
    void name_people(int64_t time_ns);
    void name_wholes(int64_t time_ns);
    uint32_t slot_of(uint32_t id) const;
    void look_for_life(float dt_s);
    uint32_t owner_of_part(const Piece& piece, const std::array<const Piece*, Identity::kMost>& largest,
                           int64_t time_ns);
    void attach_fragments();
    void drop_scene();
    bool behind_person(const Piece& part, uint32_t slot) const;
    bool beside_scene(const Shape& shape) const;
    bool part_of_scene(const Piece& piece);
    uint32_t above_or_below(const Shape& shape) const;
    void grow_feet();
    void report(const DepthImage& image, int64_t time_ns, uint8_t* users);
    Shape measure(std::span<const uint32_t> cells) const;
    bool person_like(std::span<const uint32_t> cells, const Shape& shape) const;
    /// Cells whose neighbours need no step in depth: of the piece itself, and of people it may touch.
    enum Mark : uint8_t { kOwn = 1, kTracked = 2, kBelowHead = 4 };
    void mark(std::span<const uint32_t> cells, Mark m);
    void unmark(std::span<const uint32_t> cells, Mark m);
    bool surface_goes_on(std::span<const uint32_t> cells);
    bool feet_hidden(std::span<const uint32_t> cells, const Shape& shape) const;

    PeopleMapOptions options_;
    Camera camera_;
    bool floor_seen_ = false;
    int64_t time_ns_ = 0;
    uint32_t frames_ = 0;
    uint32_t columns_ = 0;                  // of the last grid
    std::array<int, 4> filled_{}, view_{};  // cells: ever filled by the sensor, taken for its view
    DepthGrid grid_;
    std::array<FloorFinder, 4> floors_;  // by the image side that is up
    FloorFinder* floor_ = &floors_[0];
    BackgroundModel background_;
    Components components_;
    Splitter splitter_;
    Identity identity_;
    LifeSigns life_;
    std::vector<uint8_t> wanted_, slots_, last_slots_;  // by cell; slots count from 1
    std::vector<uint8_t> labels_;                       // ids by cell, in the end; until then Marks
    std::vector<float> last_depth_;
    std::vector<uint32_t> frontier_;  // of growing feet
    std::vector<uint32_t> pool_;      // cells of split components
    size_t pool_used_ = 0;
    std::vector<Piece> pieces_;
    uint32_t splits_ = 0, split_ = 0;  // of this image; that is under way
    std::vector<PersonRegion> regions_;
};

}  // namespace vfit
