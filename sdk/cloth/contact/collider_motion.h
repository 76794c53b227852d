// The colliders' way from the last step to this one.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "body/collider.h"
#include "cloth/base/interval.h"
#include "cloth/contact/contact.h"

namespace vfit {

class ColliderMotion {
public:
    /// Where they are at the end of this step, in the same order each time, with that much more radius. Those
    /// that were not there before stand still. Does not allocate while their number stays.
    void accept(std::span<const Collider> colliders, float thickness_m);
    /// sweep() means shares of that part of the step; of all of it after accept().
    void look_at(const Interval& interval) { interval_ = interval; }
    /// The step has ended.
    void arrive() { previous_ = current_; }
    /// A fraction of their way in this step lies behind them when it begins; 1: they jump.
    void skip(float fraction);
    void forget() { previous_.clear(); }
    /// How far any of them went in this step, at most; infinite where one appeared, vanished or changed its
    /// kind.
    float greatest_way() const;
    /// Of their centres in this step.
    Bounds ways() const;

    /// Between two shares of the interval; as many as count().
    void sweep(float from, float to, std::vector<SweptCapsule>& out) const;
    size_t count() const { return needed_.size(); }
    /// Of these, those of the colliders before that one.
    size_t count_before(uint32_t collider) const {
        return size_t(std::lower_bound(needed_.begin(), needed_.end(), collider) - needed_.begin());
    }

private:
    bool is_end_of_another(uint32_t ball) const;

    std::vector<Capsule> previous_, current_;
    Interval interval_;
    bool same_ = true;              // as in the last step, but for their places
    std::vector<uint32_t> needed_;  // that are not part of another
};

}  // namespace vfit
