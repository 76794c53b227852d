// One training crop: a random person in a random posture before a random sensor, and where the joints are.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "avatar/avatar.h"
#include "outfit.h"
#include "sensor_look.h"
#include "track/crop.h"

namespace vfit::training {

/// As written to the stream, little-endian, without gaps.
struct Sample {
    std::array<int16_t, CropView::kPixels * CropView::kPixels> crop;  // crop z in 1/32767
    std::array<float, 3 * kJointCount> joints;                        // crop coordinates, by joint id
    std::array<float, kJointCount> inside;  // 1: the joint lies inside the sensor's image
    float yaw_rad;                          // of the pelvis; 0: faces the sensor, > 0: turned to their left
    float person;                           // 1, or 0: clutter, without joints
};
static_assert(sizeof(Sample) == 2 * 128 * 128 + 4 * (4 * kJointCount + 2));

/// Bodies are costly to make: one serves kPostures samples in a row.
class Sampler {
public:
    static constexpr uint64_t kPostures = 24;

    Sampler(std::shared_ptr<const BodyModel> model, uint64_t seed) : model_(std::move(model)), seed_(seed) {}

    /// Everything follows from the seed and the index.
    void make(uint64_t index, Sample& out);

private:
    void make_person(uint64_t number);
    bool try_once(Random& random, Sample& out);
    void stand_person(float turn, const Vec3& place, Random& random);
    void label(const Camera& camera, const CropView& view, Sample& out) const;

    std::shared_ptr<const BodyModel> model_;
    const uint64_t seed_;
    uint64_t person_ = ~uint64_t(0);
    std::unique_ptr<Jobs> jobs_ = Jobs::own(0);
    std::unique_ptr<Avatar> avatar_;
    std::unique_ptr<Outfit> outfit_;
    Mesh mesh_;
    Shot shot_;
    RealShot real_;
    Cropper cropper_;
    std::vector<float> values_;
};

}  // namespace vfit::training
