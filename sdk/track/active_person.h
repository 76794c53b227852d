// Which of the people in view is the one that the room serves: a rule, or somebody chosen. Whoever is served
// stays so while somebody else is only a little better or only passes by, and is waited for when they are out
// of sight.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "frame/body.h"
#include "frame/camera.h"

namespace vfit {

class ActivePerson {
public:
    static constexpr float kMargin_m = 0.3f;    // nearer, or nearer to the middle, by less: no change
    static constexpr double kPatience_s = 1.0;  // that somebody else has to be better without a break
    static constexpr double kWait_s = 2.0;  // for somebody out of sight, as long as their id is kept for them

    explicit ActivePerson(vfit_follow rule = VFIT_FOLLOW_NEAREST) : rule_(rule) {}

    /// From the next update on; 0: by the rule again.
    void choose(uint32_t id);
    /// Who it is at that time. Bodies are in world space, `camera` that of their frame. May be called again
    /// with more bodies of the same time.
    ActiveBody update(int64_t time_ns, std::span<const Body> bodies, const Camera& camera);
    /// Forgets everybody, and who was chosen.
    void reset() { *this = ActivePerson(rule_); }

private:
    struct Person {
        uint32_t id = 0;
        float cost_m = 0.0f;  // the lowest is best
        bool there = false;
    };
    Person find(std::span<const Body> bodies, uint32_t id, const Camera& camera) const;
    Person best(std::span<const Body> bodies, const Camera& camera) const;
    float cost_of(const Body& body, const Camera& camera) const;
    void note_arrivals(int64_t time_ns, std::span<const Body> bodies);
    ActiveBody chosen(int64_t time_ns, std::span<const Body> bodies, const Camera& camera);
    ActiveBody by_rule(int64_t time_ns, std::span<const Body> bodies, const Camera& camera);
    bool waited_long(int64_t time_ns) const;

    static constexpr int64_t kNever = INT64_MIN;
    struct Visit {
        int64_t first_ns = kNever, last_ns = kNever;
    };

    vfit_follow rule_;
    uint32_t active_ = 0, chosen_ = 0;
    bool just_chosen_ = false;
    int64_t now_ns_ = kNever;
    int64_t picked_ns_ = kNever;       // when the active one became so
    int64_t seen_ns_ = kNever;         // and was last in view
    int64_t beaten_ns_ = kNever;       // since when somebody else has been better
    std::array<Visit, 256> visits_{};  // by id
};

}  // namespace vfit
