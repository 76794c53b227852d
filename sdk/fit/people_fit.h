// The body fit of whoever is to be fitted: bodies that the tracker found get places and rotations of the body
// that was fitted to them.
#pragma once

#include <map>
#include <memory>

#include "fit/body_fit.h"

namespace vfit {

class PeopleFit {
public:
    explicit PeopleFit(std::shared_ptr<const FitModel> model) : model_(std::move(model)) {}

    /// One person of an image with a user map. `body`: camera space, as Tracker::run found it; its id is its
    /// label in the map. A fit that comes or goes moves the joints over a few frames; a body that cannot be
    /// fitted stays as it is. A person unseen for kForget_s starts afresh.
    void run(const DepthImage& image, const PixelBox& box, Body& body);
    /// Forgets everybody.
    void reset() { people_.clear(); }

    static constexpr double kForget_s = 2.0;

private:
    struct Person {
        std::unique_ptr<BodyFit> fit;
        std::array<Vec3, kJointCount> moved{};   // from the tracker's joints, when the fit was good last
        float share = 0.0f;                      // of that which counts
        std::array<Vec3, kJointCount> places{};  // of the last frame, where it told them
        std::array<bool, kJointCount> told{};
        int64_t seen_ns = 0;
    };
    std::shared_ptr<const FitModel> model_;
    std::map<uint32_t, Person> people_;
};

}  // namespace vfit
