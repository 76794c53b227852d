// The body's motion since the last step, as it moves the cloth without a step: each vertex with the bones
// that it is skinned to. Of a jump, a motion that the solver cannot follow, it moves the cloth the whole way.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "body/body_way.h"
#include "cloth/garment/carry.h"
#include "math/types.h"

namespace vfit {

class BodyJump {
public:
    /// carry must outlive this. rest: where the garment's vertices are at rest.
    BodyJump(const Carry& carry, std::span<const Vec3> rest);

    /// The body stands in that pose and has not moved before. Skinning matrices, one a rig bone.
    void stand(std::span<const Mat4> pose);
    /// It goes from its last pose to that one in a step of dt.
    void move_to(std::span<const Mat4> pose, float dt);

    /// Of vertices of the skinned garment in that step.
    const BodyWay& way() const { return way_; }
    /// All bones move as one.
    bool is_rigid() const;
    bool moves() const { return now_ != before_; }

    /// The step before was a jump, so the cloth lacks the body's velocity.
    bool follows_jump() const { return earlier_felt_ == 0.0f; }

    /// Moves cloth at these positions by a fraction of the motion; 1: a jump. Fills places(), turns() and
    /// speeds(), one per vertex. At most once after each move_to. Does not allocate after the first call.
    void carry(std::span<const Vec3> positions, float fraction, Jobs& jobs);
    std::span<const Vec3> places() const { return places_; }
    /// Linear map of directions.
    std::span<const Mat3> turns() const { return turns_; }
    /// To be added to the turned velocities, m/s. In a jump: less the body's velocity that the cloth felt in
    /// the step before, which leaves the velocity relative to the body. After a jump: the body's velocity
    /// now.
    std::span<const Vec3> speeds() const { return speeds_; }

private:
    void find_outermost(std::span<const Vec3> rest);

    const Carry* carry_;
    struct Sample {
        uint32_t vertex;
        Vec3 rest;
    };
    std::vector<Sample> outermost_;        // extreme vertices along each axis, for each heaviest bone
    std::vector<uint32_t> all_outermost_;  // their numbers
    std::vector<Vec3> from_, to_;          // where they go in the step
    std::vector<Mat4> earlier_, before_, now_;
    float earlier_dt_ = 0.0f, dt_ = 0.0f;      // from earlier to before, from before to now
    BodyWay way_;                              // in dt_
    float felt_ = 1.0f, earlier_felt_ = 1.0f;  // fractions of these motions that the cloth felt
    std::vector<Vec3> places_, speeds_;
    std::vector<Mat3> turns_;
};

}  // namespace vfit
