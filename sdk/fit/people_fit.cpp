#include "fit/people_fit.h"

#include <algorithm>

#include "core/clock.h"
#include "frame/in_view.h"

namespace vfit {

namespace {

constexpr float kShareStep = 0.25f;  // a frame
// A joint that was wrong comes back at this pace instead of in a leap; hands are seldom faster outside of
// sports.
constexpr float kFastest_m_s = 5.5f;
constexpr double kGap_s = 0.2;  // after a longer one, or after a cut, places are taken as they are

}  // namespace

void PeopleFit::run(const DepthImage& image, const PixelBox& box, Body& body) {
    std::erase_if(people_, [&](const auto& entry) {
        return body.time_ns < entry.second.seen_ns ||
               seconds_between(entry.second.seen_ns, body.time_ns) > kForget_s;
    });
    const bool is_new = !people_.contains(body.id);
    Person& person = people_[body.id];
    if (is_new) person.fit = std::make_unique<BodyFit>(model_);
    const double passed_s = is_new ? 2.0 * kGap_s : seconds_between(person.seen_ns, body.time_ns);
    person.seen_ns = body.time_ns;
    BodyFitInput input;
    input.image = image;
    input.user = uint8_t(body.id);
    input.time_ns = body.time_ns;
    input.box = box;
    for (int j = 0; j < kJointCount; ++j)
        if (body.has(j)) input.joints[size_t(j)] = {body.at(j), body.joints[size_t(j)].confidence};
    const BodyFitOutput& fit = person.fit->run(input);
    const bool good = fit.state == BodyFitState::kGood;
    const float farthest_m = passed_s < kGap_s && !fit.cut ? kFastest_m_s * float(passed_s) : 1e9f;
    person.share =
        is_new && good ? 1.0f : std::clamp(person.share + (good ? kShareStep : -kShareStep), 0.0f, 1.0f);
    for (size_t j = 0; j < size_t(kJointCount); ++j) {
        Joint& joint = body.joints[j];
        if (!joint.seen()) continue;
        if (good) {
            person.moved[j] = fit.joints[j] - joint.position;
            joint.rotation = fit.rotations[j];
            joint.has_rotation = true;
        }
        joint.position += person.share * person.moved[j];
        const Vec3 way = joint.position - person.places[j];
        if (const float length = glm::length(way); person.told[j] && length > farthest_m)
            joint.position = person.places[j] + way * (farthest_m / length);
        person.places[j] = joint.position;
    }
    limit_states(body, image.camera);
    for (size_t j = 0; j < size_t(kJointCount); ++j) person.told[j] = body.joints[j].seen();
}

}  // namespace vfit
