// The body fit of everybody in view: bodies that the tracker found get rotations and, where wanted, places of the
// body that was fitted to them.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "fit/body_fit.h"
#include "track/tracker.h"

namespace vfit {

class PeopleFit {
public:
    explicit PeopleFit(std::shared_ptr<const FitModel> model) : model_(std::move(model)) {}

    /// `bodies`: camera space, as Tracker::run found them for `targets`; `places`: their joints move to the fitted
    /// body's. Those that cannot be fitted stay as they are.
    void run(const DepthImage& image, int64_t time_ns, std::span<const TrackTarget> targets, bool places,
             std::vector<Body>& bodies);
    /// Forgets everybody.
    void reset() { people_.clear(); }

private:
    struct Person {
        std::unique_ptr<BodyFit> fit;
        int64_t seen_ns = 0;
    };
    std::shared_ptr<const FitModel> model_;
    std::map<uint32_t, Person> people_;
};

}  // namespace vfit
