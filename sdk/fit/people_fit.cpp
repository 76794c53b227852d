#include "fit/people_fit.h"

#include <algorithm>

#include "core/clock.h"

namespace vfit {

void PeopleFit::run(const DepthImage& image, int64_t time_ns, std::span<const TrackTarget> targets, bool places,
                    std::vector<Body>& bodies) {
    std::erase_if(people_, [&](const auto& entry) {
        return time_ns < entry.second.seen_ns || seconds_between(entry.second.seen_ns, time_ns) > Tracker::kForget_s;
    });
    for (Body& body : bodies) {
        Person& person = people_[body.id];
        if (!person.fit) person.fit = std::make_unique<BodyFit>(model_);
        person.seen_ns = time_ns;
        BodyFitInput input;
        input.image = image;
        input.user = uint8_t(body.id);
        input.time_ns = time_ns;
        for (const TrackTarget& target : targets)
            if (target.id == body.id) input.box = target.box;
        for (int j = 0; j < kJointCount; ++j)
            if (body.has(j)) input.joints[size_t(j)] = {body.at(j), body.joints[size_t(j)].confidence};
        const BodyFitOutput& fit = person.fit->run(input);
        if (fit.state != BodyFitState::kGood) continue;
        for (int j = 0; j < kJointCount; ++j) {
            Joint& joint = body.joints[size_t(j)];
            joint.rotation = fit.rotations[size_t(j)];
            joint.has_rotation = true;
            if (places) joint.position = fit.joints[size_t(j)];
        }
    }
}

}  // namespace vfit
