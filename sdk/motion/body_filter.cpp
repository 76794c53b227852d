#include "motion/body_filter.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"

namespace vfit {

namespace {

// Two bodies within a millisecond are one moment read twice: a speed taken from them would throw the joint
// out of the room.
constexpr float kLeastIntervalS = 0.001f;

float since_s(int64_t earlier_ns, int64_t later_ns) {
    return std::max(0.0f, static_cast<float>(seconds_between(earlier_ns, later_ns)));
}

}  // namespace

void BodyFilter::reset() { *this = BodyFilter(); }

Vec3 BodyFilter::shown(const Track& track, int64_t time_ns) {
    // The trend is damped exponentially, so that its sum is bounded: the joint holds without a kink.
    const float age = since_s(track.seen_ns, time_ns);
    const float reach = kTrendTimeS * (1.0f - std::exp(-age / kTrendTimeS));
    const float fade = std::exp(-since_s(track.return_ns, time_ns) / kReturnTimeS);
    return track.joint.position + track.velocity * reach + track.return_offset * fade;
}

float BodyFilter::confidence(const Track& track, int64_t time_ns) {
    if (!track.lost && track.return_doubt == 0.0f) return track.joint.confidence;
    const float fade = std::exp(-since_s(track.return_ns, time_ns) / kReturnTimeS);
    const float seen = track.joint.confidence - track.return_doubt * fade;
    if (!track.lost) return seen;
    return seen * std::exp(-since_s(track.seen_ns, time_ns) / kForgetTimeS);
}

void BodyFilter::update(const Body& body, const PositionFilterSettings* settings) {
    for (size_t i = 0; i < tracks_.size(); ++i) {
        Track& track = tracks_[i];
        const Joint& reading = body.joints[i];
        if (!reading.seen()) {
            track.lost = track.seen;
            continue;
        }
        if (!settings) {
            track.joint = reading;
            track.seen_ns = body.time_ns;
            track.seen = true;
            track.lost = false;
            continue;
        }
        const float gap = since_s(track.seen_ns, body.time_ns);
        const bool returns = track.seen && (track.lost || gap > kBridgeTimeS);
        const Vec3 before = returns ? shown(track, body.time_ns) : Vec3(0.0f);
        const float trusted = returns ? confidence(track, body.time_ns) : 0.0f;
        if (gap > kBridgeTimeS) track.filter.reset();
        const bool inferred = reading.state == VFIT_JOINT_INFERRED;
        const Vec3 position = track.filter.update(*settings, reading.position, inferred, reading.confidence,
                                                  std::max(gap, kLeastIntervalS));
        track.joint = reading;
        track.joint.position = position;
        track.velocity = track.filter.velocity();
        track.seen_ns = body.time_ns;
        track.seen = true;
        track.lost = false;
        if (returns) {
            track.return_offset = before - position;
            track.return_doubt = std::max(0.0f, reading.confidence - trusted);
            track.return_ns = body.time_ns;
        }
    }
    last_.id = body.id;
    last_.flags = body.flags;
}

void BodyFilter::sample(int64_t time_ns, Body& out) const {
    out.id = last_.id;
    out.flags = last_.flags;
    out.time_ns = time_ns;
    for (size_t i = 0; i < tracks_.size(); ++i) {
        const Track& track = tracks_[i];
        if (!track.seen) {
            out.joints[i] = Joint();
            continue;
        }
        out.joints[i] = track.joint;
        out.joints[i].position = shown(track, time_ns);
        out.joints[i].confidence = confidence(track, time_ns);
        if (track.lost) {
            out.joints[i].state = VFIT_JOINT_INFERRED;
            out.joints[i].has_rotation = false;
        }
    }
}

}  // namespace vfit
