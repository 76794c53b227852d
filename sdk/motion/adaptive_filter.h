// vfit's own filter of one joint position: an interacting multiple model (Blom and Bar-Shalom 1988) of a
// joint that rests, one that coasts and one that turns, each a Kalman filter, weighed by how well it
// foretells the readings. At rest it averages over seconds, in motion it follows within a frame. It learns
// how noisy its joint is along each axis, and holds a reading that leaps until the next one bears it out.
#pragma once

#include <array>

#include "math/types.h"

namespace vfit {

class AdaptiveFilter {
public:
    void reset() { *this = AdaptiveFilter(); }
    bool empty() const { return count_ == 0; }

    /// Takes one reading, `dt_s` > 0 after the one before. `noise_scale`: how many times noisier than this
    /// joint's readings usually are (1; more for an inferred or unsure one).
    void update(const Vec3& reading, float noise_scale, float dt_s);

    const Vec3& position() const { return position_; }
    const Vec3& velocity() const { return velocity_; }  // m/s
    /// Standard deviation of the readings along each axis, as learnt so far.
    Vec3 noise_m() const;

    static constexpr int kModes = 3;  // rests, coasts, turns

private:
    /// Of one mode; the covariance of place and velocity along each axis.
    struct Mode {
        float probability = 0.0f;
        Vec3 place{0.0f}, velocity{0.0f};
        Vec3 pp{0.0f}, pv{0.0f}, vv{0.0f};
    };
    void start(const Vec3& reading, const Vec3& velocity, float noise_scale);
    void learn_noise(const Vec3& reading, float dt_s);
    void mix();
    void predict(float dt_s);
    void correct(const Vec3& reading, const Vec3& variance);
    void combine();
    bool leaps(const Vec3& reading, const Vec3& variance) const;
    bool is_evidence(const Vec3& before) const;

    std::array<Mode, kModes> modes_{};
    Vec3 position_{0.0f}, velocity_{0.0f};
    Vec3 white_{0.0f};                // noise of readings as their third differences show it
    std::array<Vec3, 3> readings_{};  // the last ones, newest first
    float last_dt_s_ = 0.0f;
    int count_ = 0;       // readings since the start, as far as it matters
    int even_count_ = 0;  // readings in a row at even times
    int noise_count_ = 0;
    Vec3 beside_{0.0f};  // from where the joint was shown to the last reading
};

}  // namespace vfit
