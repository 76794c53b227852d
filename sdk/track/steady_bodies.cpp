#include "track/steady_bodies.h"

#include <algorithm>

#include "core/clock.h"

namespace vfit {

namespace {

constexpr double kForget_s = 2.0;
// Where the middleware has states alone: between the two limits.
constexpr float kConfidenceOfInferred = 0.3f;

}  // namespace

void judge_states(Body& body) {
    const bool told = std::any_of(body.joints.begin(), body.joints.end(),
                                  [](const Joint& j) { return j.seen() && j.confidence > 0.0f; });
    for (Joint& j : body.joints) {
        if (!j.seen()) continue;
        if (!told) j.confidence = j.state == VFIT_JOINT_MEASURED ? 1.0f : kConfidenceOfInferred;
        j.confidence = std::clamp(j.confidence, 0.0f, 1.0f);
        j.state = std::min(j.state, joint_state_of(j.confidence));
    }
}

void SteadyBodies::run(Body& body) {
    judge_states(body);
    std::erase_if(people_, [&](const auto& entry) {
        const int64_t seen_ns = entry.second.seen_ns;
        return body.time_ns < seen_ns || seconds_between(seen_ns, body.time_ns) > kForget_s;
    });
    Person& person = people_[body.id];
    person.seen_ns = body.time_ns;
    SeenJoints joints;
    for (size_t j = 0; j < joints.size(); ++j)
        if (body.joints[j].seen()) joints[j] = {body.joints[j].position, body.joints[j].confidence};
    person.steady.run(body.time_ns, joints);
    for (size_t j = 0; j < joints.size(); ++j)
        if (body.joints[j].seen()) body.joints[j].position = joints[j].position;
}

}  // namespace vfit
