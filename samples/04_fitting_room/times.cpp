#include "times.h"

#include <algorithm>

namespace room {

Spread spread_of(std::vector<float> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        return double(values[std::min(values.size() - 1, size_t(share * double(values.size())))]);
    };
    return {at(0.5), at(0.95)};
}

void Times::add(const StageMs& stages, float frame_ms) {
    stages_[frames_ % kKept] = stages;
    frame_ms_[frames_ % kKept] = frame_ms;
    sum_ms_ += frame_ms;
    ++frames_;
}

void Times::add_cloth_step(float step_ms, float interval_ms) {
    step_ms_[steps_ % kKept] = step_ms;
    interval_ms_[steps_ % kKept] = interval_ms;
    ++steps_;
}

StageMs Times::ago(size_t i) const {
    return i < frames_ && i < kKept ? stages_[(frames_ - 1 - i) % kKept] : StageMs{};
}

double Times::fps() const { return sum_ms_ > 0.0 ? 1e3 * double(frames_) / sum_ms_ : 0.0; }

double Times::recent_fps() const {
    constexpr float kWindow_ms = 1000.0f;
    float sum = 0.0f;
    size_t count = 0;
    for (; count < frames_ && count < kKept && sum < kWindow_ms; ++count)
        sum += frame_ms_[(frames_ - 1 - count) % kKept];
    return sum > 0.0f ? 1e3 * double(count) / double(sum) : 0.0;
}

std::vector<float> Times::kept(const std::vector<float>& ring, uint64_t count) {
    return {ring.begin(), ring.begin() + std::ptrdiff_t(std::min<uint64_t>(count, kKept))};
}

Spread Times::stage(Stage stage) const {
    std::vector<float> values;
    for (size_t i = 0; i < std::min<uint64_t>(frames_, kKept); ++i)
        values.push_back(stages_[i][size_t(stage)]);
    return spread_of(std::move(values));
}

}  // namespace room
