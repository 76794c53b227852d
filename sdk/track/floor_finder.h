// The floor plane from depth alone, without calibration.
//
// A plane n . p + d = 0 is linear in what the sensor measures: with the ray r = (x/z, y/z, 1) of a pixel,
// 1 / z = a r, where a = -n / d. Noise of 1 / z hardly depends on distance (structured light measures it
// directly), so planes are fitted there by plain least squares, and a plane is kept from frame to frame as
// the decayed sums of its normal equations.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "track/depth_grid.h"

namespace vfit {

/// Spread of 1 / z in 1/m: depth_sigma_m(z) / z^2 is 1.5e-3 to 1.9e-3 from 1 to 4 m.
inline constexpr float kInverseDepthSigma = 1.6e-3f;

/// Height below which a single reading at depth z is taken for the floor: a centimetre for the unevenness of
/// floor and plane, and two sigma of the reading. h = d z (1/z - a . r), see above.
inline float floor_cut_m(float floor_distance_m, float z) {
    return 0.010f + 2.0f * kInverseDepthSigma * floor_distance_m * z;
}

class FloorFinder {
public:
    /// Looks for the floor in this frame, where camera.floor_normal says which side is up, give or take 40
    /// degrees of roll. Once found, sets the camera's floor (VFIT_FLOOR_ESTIMATED) in every call and refines
    /// it over the frames; a camera whose floor is VFIT_FLOOR_GIVEN is left alone. True where the floor was
    /// seen in this frame. Does not allocate after its first run.
    bool run(const DepthGrid& grid, Camera& camera);

    /// A floor is known, though perhaps out of sight now.
    bool found() const { return found_; }
    void reset();

private:
    using Plane = Vec3;  // a: 1 / z = a . (x/z, y/z, 1)

    struct Sample {
        float x, y, inverse;  // ray, 1 / z
    };
    struct Fit {
        Plane plane{0.0f};
        float score = 0.0f;
        bool valid() const { return score > 0.0f; }
    };
    struct Sums {                         // normal equations of the fit in a
        std::array<double, 6> product{};  // xx xy x yy y 1
        std::array<double, 3> side{};     // x/z y/z 1/z
        void add(const Sample& s, double weight = 1.0);
        void decay(double share);
        bool solve(Plane& plane) const;
    };

    void take_samples(const DepthGrid& grid, uint32_t turn);
    void fit_whole(const DepthGrid& grid, const Vec3& up);
    Sample sample(size_t i) const { return {x_[i], y_[i], inverse_[i]}; }
    Fit search(const Vec3& up, uint32_t tries);
    bool worth_a_search(const Vec3& up, bool seen);
    float score(const Plane& plane) const;
    float extent_m(const Plane& plane) const;
    int32_t below_beside(const Plane& plane) const;
    size_t gather(const Plane& plane, float slack_m, Sums& sums) const;
    uint32_t random(uint32_t below);

    std::vector<float> x_, y_, inverse_;  // of the samples
    Sums sums_;
    Plane plane_{0.0f};
    bool found_ = false;
    uint32_t frames_ = 0, next_search_ = 0, rest_ = 1;
    uint32_t columns_ = 0, rows_ = 0;  // of the samples
    uint64_t seed_ = 0;
};

}  // namespace vfit
