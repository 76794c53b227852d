// The whole tracker after the user map: each labelled person to joints, with state, confidence and a steady
// side.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "track/joint_hints.h"
#include "track/joint_network.h"
#include "track/joint_steady.h"
#include "track/level.h"
#include "track/skeleton.h"

namespace vfit {

/// One person of the user map.
struct TrackTarget {
    uint32_t id = 0;
    PixelBox box;             // empty: anywhere in the image
    uint32_t flags = 0;       // VFIT_BODY_*
    uint32_t part_of = 0;     // id of the person whose part they may be
    float lifeless_s = 0.0f;  // for how long it has rested without a sign of life; above 0 it has no body
};

/// The people of a user map with enough pixels to be tracked, largest first, at most `most`.
void find_targets(const DepthImage& image, size_t most, std::vector<TrackTarget>& out);

/// What others see of the people of an image.
struct Evidence {
    std::span<const JointHint> hints;
    std::span<const Body> elsewhere;  // by other cameras, in this one's camera space
};

class Tracker {
public:
    /// steady: joints are filtered over time.
    explicit Tracker(std::shared_ptr<JointNetwork> network, bool steady = true)
        : network_(std::move(network)), steady_(steady) {}

    /// Joints of every target that the network takes for a person, in camera space. A person unseen for
    /// kForget_s is forgotten: whoever gets that id then starts afresh.
    void run(const DepthImage& image, int64_t time_ns, std::span<const TrackTarget> targets,
             std::vector<Body>& out, const Evidence& evidence = {});
    /// What the network says to the target as it is seen with `up`, and with it turned further.
    bool turn(const DepthImage& image, const TrackTarget& target, const Vec3& up, Level::Answers& person);
    /// The network's answer (logit: it is a person) to the target alone; surely not where too little is seen.
    float answer(const DepthImage& image, const TrackTarget& target, const Vec3& up);
    /// The network's answer that this target is a person, a mean of the last images; a logit.
    float belief(uint32_t id) const;
    /// The network has said for a while that this target is something else.
    bool surely_no_person(uint32_t id) const;
    /// Forgets everybody.
    void reset() { people_.clear(); }

    static constexpr double kForget_s = 2.0;

private:
    struct Person {
        Facing facing;
        JointSteady steady;
        float belief = 0.0f;  // that it is a person: the network's logits, smoothed
        int64_t seen_ns = 0;
        uint32_t frames = 0;
        uint32_t doubts = 0;  // frames in a row in which it was surely none
    };
    void give_hints(const DepthImage& image, std::span<const TrackTarget> targets,
                    std::span<const JointHint> hints);
    bool see(const DepthImage& image, int64_t time_ns, const TrackTarget& target, const Vec2& up,
             std::span<const Body> elsewhere, Person& person, Body& out);

    std::shared_ptr<JointNetwork> network_;
    bool steady_;
    std::map<uint32_t, Person> people_;
    std::vector<JointHint> hints_, hints_of_one_;  // of this image, with the person that each is of
    Cropper cropper_;
    std::vector<float> crop_;
    JointMaps maps_;
};

}  // namespace vfit
