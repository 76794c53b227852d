// Time spent in each stage, for vfit_profile_list.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>

#include "core/clock.h"

namespace vfit {

enum class Stage { track, measure, motion, avatar, cloth, count };

struct StageTimes {
    uint64_t calls = 0;
    double last_ms = 0, sum_ms = 0, max_ms = 0;
};

class Profile {
public:
    static constexpr size_t kStages = static_cast<size_t>(Stage::count);
    static const char* name(size_t stage) {
        constexpr const char* names[kStages] = {"track", "measure", "motion", "avatar", "cloth"};
        return names[stage];
    }
    void add(Stage stage, double ms) {
        std::lock_guard lock(mutex_);
        StageTimes& t = times_[static_cast<size_t>(stage)];
        ++t.calls;
        t.last_ms = ms;
        t.sum_ms += ms;
        t.max_ms = ms > t.max_ms ? ms : t.max_ms;
    }
    StageTimes get(size_t stage) const {
        std::lock_guard lock(mutex_);
        return times_[stage];
    }
    void reset() {
        std::lock_guard lock(mutex_);
        times_ = {};
    }

    /// Adds the life of the scope to a stage.
    class Scope {
    public:
        Scope(Profile& profile, Stage stage) : profile_(profile), stage_(stage) {}
        ~Scope() { profile_.add(stage_, watch_.ms()); }
        Scope(const Scope&) = delete;
        Scope& operator=(const Scope&) = delete;

    private:
        Profile& profile_;
        Stage stage_;
        Stopwatch watch_;
    };

private:
    mutable std::mutex mutex_;
    std::array<StageTimes, kStages> times_{};
};

}  // namespace vfit
