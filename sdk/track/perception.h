// vfit's own tracker, from a depth image to bodies: user map, joints, and which way is up where no sensor
// tells.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "track/people_map.h"
#include "track/tracker.h"

namespace vfit {

/// For people to read.
const char* text_of(Absence why);

class Perception {
public:
    static constexpr size_t kMaxBodies = 8;  // of one image

    using LoadNetwork = std::function<std::shared_ptr<JointNetwork>()>;

    /// load: called when joints are first looked for. steady: joints are filtered over time.
    Perception(LoadNetwork load, bool steady) : load_(std::move(load)), steady_(steady) {}

    /// Bodies of the image, in camera space. `map`: written with the people that are found; null: image.users
    /// is taken. Sets image.users and the floor of image.camera, unless that is VFIT_FLOOR_GIVEN.
    void run(DepthImage& image, int64_t time_ns, uint8_t* map, const Evidence& evidence,
             std::vector<Body>& bodies);
    /// The user map alone, for bodies that another tracker has found.
    std::span<const PersonRegion> map_people(const DepthImage& image, int64_t time_ns, uint8_t* map);
    /// Why the last run found no body. Of a user map that was given, no more than whether it has people.
    Absence why_absent() const;
    /// The people that run() has looked at.
    std::span<const TrackTarget> targets() const { return targets_; }
    void reset();

private:
    bool rejoin_parts(const DepthImage& image);
    void find_people(DepthImage& image, int64_t time_ns, uint8_t* map);
    /// Looks for people who stand as image.camera says.
    bool look(DepthImage& image, int64_t time_ns, uint8_t* map, const Evidence& evidence,
              std::vector<Body>& bodies);
    const Body& surest(std::span<const Body> bodies) const;
    bool stands_upright(const DepthImage& image, const Body& body);

    LoadNetwork load_;
    bool steady_;
    std::unique_ptr<Tracker> tracker_;
    std::unique_ptr<PeopleMap> people_;
    Level level_;
    std::vector<TrackTarget> targets_;
    int64_t floor_ns_ = 0;  // when the floor was seen or a person stood on it
    bool mapped_ = false;   // the last image's people are from people_
};

}  // namespace vfit
