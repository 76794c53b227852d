#include "track/background.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// A person who stands and waits is not that still for so long; what is put down becomes background after it.
constexpr float kReplaced_s = 3.0f;
constexpr float kAverage = 0.05f;  // share of a new reading: the mean of about the last 20
constexpr float kLongest_s = 60.0f;

}  // namespace

void BackgroundModel::reset() {
    std::fill(settled_s_.begin(), settled_s_.end(), 0.0f);
    std::fill(steady_s_.begin(), steady_s_.end(), 0.0f);
    std::fill(known_.begin(), known_.end(), kNothing);
}

void BackgroundModel::fit(const DepthGrid& grid) {
    if (grid.width() == width_ && grid.height() == height_) return;
    width_ = grid.width();
    height_ = grid.height();
    for (auto* v : {&depth_, &settled_s_, &candidate_, &steady_s_}) v->assign(grid.cells(), 0.0f);
    known_.assign(grid.cells(), kNothing);
}

void BackgroundModel::set(size_t cell, float depth, float settled_s) {
    depth_[cell] = depth;
    settled_s_[cell] = settled_s;
    known_[cell] = settled_s >= kSettled_s ? depth : kNothing;
}

void BackgroundModel::add(const DepthGrid& grid, size_t cell) { set(cell, grid.depth()[cell], kSettled_s); }

void BackgroundModel::learn_empty(const DepthGrid& grid) {
    fit(grid);
    for (size_t i = 0; i < grid.cells(); ++i) {
        const float z = grid.depth()[i];
        if (z <= 0.0f) continue;
        const bool same = settled_s_[i] > 0.0f && std::abs(z - depth_[i]) < same_surface_m(z);
        set(i, same ? depth_[i] + kAverage * (z - depth_[i]) : z, kLongest_s);
    }
}

void BackgroundModel::learn(const DepthGrid& grid, const uint8_t* people, float dt_s) {
    fit(grid);
    // A quarter of the rows takes its turn: seconds are counted here, not frames.
    waiting_s_ += dt_s;
    if (turn_ == 0) {
        passed_s_ = waiting_s_;
        waiting_s_ = 0.0f;
    }
    const size_t first = size_t(height_) * turn_ / kTurns * width_;
    const size_t last = size_t(height_) * (turn_ + 1) / kTurns * width_;
    turn_ = (turn_ + 1) % kTurns;
    dt_s = passed_s_;
    for (size_t i = first; i < last; ++i) {
        const float z = grid.depth()[i];
        if (z <= 0.0f || people[i] != 0) continue;
        const float same = same_surface_m(z);
        if (std::abs(z - depth_[i]) < same) {
            set(i, depth_[i] + kAverage * (z - depth_[i]), std::min(settled_s_[i] + dt_s, kLongest_s));
            steady_s_[i] = 0.0f;
        } else if (std::abs(z - candidate_[i]) < same) {
            candidate_[i] += kAverage * (z - candidate_[i]);
            steady_s_[i] += dt_s;
            // The first thing ever seen there need not wait: nobody has been known to stand before it.
            if (steady_s_[i] > (settled_s_[i] > 0.0f ? kReplaced_s : kSettled_s))
                set(i, candidate_[i], kSettled_s);
        } else {
            // What comes out from behind something nearer may be a person who was hidden by it: it waits as
            // long as what takes a known background's place.
            const bool revealed =
                settled_s_[i] == 0.0f && candidate_[i] > 0.0f && z > candidate_[i] + kGone_m;
            steady_s_[i] = revealed ? kSettled_s - kReplaced_s : 0.0f;
            candidate_[i] = z;
        }
    }
}

}  // namespace vfit
