// Who is who from frame to frame: people keep their number while they are seen, through a crossing, and when
// they come back within two seconds.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "track/person_shape.h"

namespace vfit {

struct PersonTrack {
    uint32_t id = 0;                    // 1..254; 0: the slot is free
    Vec3 centre{0.0f}, velocity{0.0f};  // world, m and m/s
    float height_m = 0.0f, area_m2 = 0.0f;
    float usual_area_m2 = 0.0f;  // of what is seen of them where nothing hides them
    uint32_t cells = 0;          // when last seen
    int64_t first_ns = 0, seen_ns = 0;
    bool seen = false;     // in the last frame
    uint32_t part_of = 0;  // id of the person whose part they may be after all; 0: of none
    int64_t alone_ns = 0;  // when what was split from them turned out to be a part of them
};

/// Between two points of the world, on the floor.
inline float floor_distance(const Vec3& a, const Vec3& b) {
    return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.z - b.z) * (a.z - b.z));
}

class Identity {
public:
    /// More people than a room before one camera holds.
    static constexpr uint32_t kMost = 24;

    const PersonTrack& track(uint32_t slot) const { return tracks_[slot]; }
    /// That point may be a part of the person where they were last seen.
    bool within_reach(uint32_t slot, const Vec3& p) const;
    bool taken(uint32_t slot) const { return tracks_[slot].id != 0; }

    /// Frees the slots of people who have been away for too long, and marks all as not seen.
    void begin(int64_t time_ns);
    /// The slot of somebody who is away, or hidden but for a little, and may have come back as this shape;
    /// else a new one. kMost: no slot is free.
    uint32_t adopt(const Shape& shape, int64_t time_ns);
    /// The slot of somebody who was hidden a moment ago nearer to that shape than so far; kMost: nobody was.
    uint32_t hidden_near(const Shape& shape, float nearer_than_m, int64_t time_ns) const;
    /// The person in that slot is seen there.
    void see(uint32_t slot, const Shape& shape, int64_t time_ns);
    void forget(uint32_t slot) { tracks_[slot] = {}; }
    PersonTrack& change(uint32_t slot) { return tracks_[slot]; }
    void reset();

private:
    Vec3 foreseen(const PersonTrack& t, int64_t time_ns) const;
    std::array<PersonTrack, kMost> tracks_;
    uint32_t last_id_ = 0;
};

}  // namespace vfit
