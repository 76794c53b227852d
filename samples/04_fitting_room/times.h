// Where the time goes: of each picture, by stage, for the plot and for the report.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace room {

enum class Stage { sense, move, cloth, draw };
inline constexpr size_t kStages = 4;
inline constexpr std::array<const char*, kStages> kStageNames = {"sensor_track", "motion_skin", "cloth",
                                                                 "draw"};

using StageMs = std::array<float, kStages>;

class Watch {
public:
    /// Milliseconds since it was made or last asked.
    float lap_ms() {
        const auto now = std::chrono::steady_clock::now();
        const float ms = std::chrono::duration<float, std::milli>(now - last_).count();
        last_ = now;
        return ms;
    }

private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

struct Spread {
    double median = 0.0, p95 = 0.0;
};
Spread spread_of(std::vector<float> values);

/// The newest values, in memory that never grows: a mirror runs for weeks.
class Times {
public:
    static constexpr size_t kPlotted = 240;
    void add(const StageMs& stages, float frame_ms);
    void add_cloth_step(float step_ms, float interval_ms);

    /// i pictures ago; zeros where there was none.
    StageMs ago(size_t i) const;
    uint64_t frames() const { return frames_; }
    double fps() const;         // over all
    double recent_fps() const;  // over the last second or so
    Spread stage(Stage stage) const;
    Spread frame() const { return spread_of(kept(frame_ms_, frames_)); }
    Spread cloth_step() const { return spread_of(kept(step_ms_, steps_)); }
    Spread cloth_interval() const { return spread_of(kept(interval_ms_, steps_)); }
    uint64_t cloth_steps() const { return steps_; }

private:
    static constexpr size_t kKept = 1u << 15;
    static std::vector<float> kept(const std::vector<float>& ring, uint64_t count);
    std::vector<StageMs> stages_ = std::vector<StageMs>(kKept);
    std::vector<float> frame_ms_ = std::vector<float>(kKept), step_ms_ = std::vector<float>(kKept),
                       interval_ms_ = std::vector<float>(kKept);
    uint64_t frames_ = 0, steps_ = 0;
    double sum_ms_ = 0.0;
};

}  // namespace room
