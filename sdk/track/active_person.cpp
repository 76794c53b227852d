#include "track/active_person.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"

namespace vfit {

namespace {

/// Middle of the trunk, or of whatever is seen, in camera space.
Vec3 middle_of(const Body& body, const Camera& camera) {
    Vec3 sum(0.0f);
    float count = 0.0f;
    for (const int joint : {VFIT_JOINT_TORSO, VFIT_JOINT_NECK, VFIT_JOINT_LEFT_SHOULDER,
                            VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP})
        if (body.has(joint)) sum += body.at(joint), ++count;
    for (int joint = 0; count == 0.0f && joint < kJointCount; ++joint)
        if (body.has(joint)) sum = body.at(joint), count = 1.0f;
    return transform_point(camera.camera_from_world(), sum / std::max(count, 1.0f));
}

}  // namespace

void ActivePerson::choose(uint32_t id) {
    chosen_ = id;
    just_chosen_ = id != 0;
}

float ActivePerson::cost_of(const Body& body, const Camera& camera) const {
    if (rule_ == VFIT_FOLLOW_NEAREST) return glm::length(middle_of(body, camera));
    if (rule_ == VFIT_FOLLOW_CENTRED) return std::abs(middle_of(body, camera).x);
    return 0.0f;
}

ActivePerson::Person ActivePerson::find(std::span<const Body> bodies, uint32_t id,
                                        const Camera& camera) const {
    for (const Body& body : bodies)
        if (body.id == id) return {id, cost_of(body, camera), true};
    return {};
}

ActivePerson::Person ActivePerson::best(std::span<const Body> bodies, const Camera& camera) const {
    Person best;
    for (const Body& body : bodies) {
        const float cost = cost_of(body, camera);
        const bool earlier = best.there && visits_[body.id].first_ns < visits_[best.id].first_ns;
        const bool better = !best.there || (rule_ == VFIT_FOLLOW_FIRST ? earlier : cost < best.cost_m);
        if (better) best = {body.id, cost, true};
    }
    return best;
}

void ActivePerson::note_arrivals(int64_t time_ns, std::span<const Body> bodies) {
    if (time_ns < now_ns_) {  // played again
        visits_.fill({});
        picked_ns_ = seen_ns_ = time_ns;
        beaten_ns_ = kNever;
    }
    now_ns_ = time_ns;
    for (const Body& body : bodies) {
        Visit& visit = visits_[body.id];
        if (visit.last_ns == kNever || seconds_between(visit.last_ns, time_ns) > kWait_s)
            visit.first_ns = time_ns;
        visit.last_ns = time_ns;
    }
}

bool ActivePerson::waited_long(int64_t time_ns) const { return seconds_between(seen_ns_, time_ns) > kWait_s; }

ActiveBody ActivePerson::chosen(int64_t time_ns, std::span<const Body> bodies, const Camera& camera) {
    if (just_chosen_) {
        seen_ns_ = time_ns;
        just_chosen_ = false;
    }
    active_ = chosen_;
    if (find(bodies, chosen_, camera).there) {
        seen_ns_ = time_ns;
        return {chosen_, VFIT_ACTIVE_CHOSEN};
    }
    if (rule_ == VFIT_FOLLOW_CHOSEN || !waited_long(time_ns)) return {chosen_, VFIT_ACTIVE_LOST};
    active_ = chosen_ = 0;
    return by_rule(time_ns, bodies, camera);
}

ActiveBody ActivePerson::by_rule(int64_t time_ns, std::span<const Body> bodies, const Camera& camera) {
    if (rule_ == VFIT_FOLLOW_CHOSEN) return {};
    const Person now = find(bodies, active_, camera), other = best(bodies, camera);
    if (active_ && !now.there && !waited_long(time_ns)) return {active_, VFIT_ACTIVE_LOST};

    const bool beaten = now.there && rule_ != VFIT_FOLLOW_FIRST && other.cost_m < now.cost_m - kMargin_m;
    if (!beaten)
        beaten_ns_ = kNever;
    else if (beaten_ns_ == kNever)
        beaten_ns_ = time_ns;
    const bool enough = beaten && seconds_between(beaten_ns_, time_ns) >= kPatience_s;
    // Of the people of one moment the first to be told of is not yet the chosen one.
    const bool same_moment = now.there && picked_ns_ == time_ns && other.cost_m < now.cost_m;
    if (!now.there || enough || same_moment) {
        active_ = other.id;
        picked_ns_ = time_ns;
        beaten_ns_ = kNever;
    }
    if (active_ == 0) return {};
    seen_ns_ = time_ns;
    return {active_, VFIT_ACTIVE_BY_RULE};
}

ActiveBody ActivePerson::update(int64_t time_ns, std::span<const Body> bodies, const Camera& camera) {
    note_arrivals(time_ns, bodies);
    return chosen_ ? chosen(time_ns, bodies, camera) : by_rule(time_ns, bodies, camera);
}

}  // namespace vfit
