// The table of scripted motions, and the small movements of a living body that are laid over each of them.
#include "motion.h"

#include <cmath>

#include "error.h"
#include "keys.h"
#include "random.h"

namespace vfit::virtual_person {

namespace {

struct NamedScript {
    const char* name;
    Script (*make)(uint64_t seed);
};
/// A script that is the same for every seed.
template <Script (*make)()>
Script same(uint64_t) {
    return make();
}
constexpr NamedScript kScripts[] = {{"scan", [](uint64_t) { return scan_script(); }},
                                    {"side", [](uint64_t) { return side_script(); }},
                                    {"sway", same<sway_script>},
                                    {"turn", same<turn_script>},
                                    {"walk", same<walk_script>},
                                    {"wave", same<wave_script>},
                                    {"reach", same<reach_script>},
                                    {"squat", same<squat_script>},
                                    {"demo", same<demo_script>},
                                    {"cross", same<cross_script>},
                                    {"clap", same<clap_script>},
                                    {"forward", same<forward_script>},
                                    {"sit", same<sit_script>},
                                    {"spin", same<spin_script>},
                                    {"round", [](uint64_t) { return round_script(); }},
                                    {"jog", same<jog_script>},
                                    {"visit", same<visit_script>},
                                    {"jump", same<jump_script>},
                                    {"step", same<step_script>},
                                    {"balance", same<balance_script>},
                                    {"stride", stride_script},
                                    {"shuffle", shuffle_script}};

// All frequencies below are multiples of 0.01 Hz: after this time they are where they began. Without it a
// float of seconds is too coarse for a frame after some days.
constexpr double kIdlePeriod_s = 100.0;

// Quiet standing: the centre of mass wanders a few millimetres at some tenths of a hertz (posturography), and
// 15 breaths a minute lift the chest.
class Idle {
public:
    explicit Idle(uint64_t seed) {
        for (uint64_t i = 0; i < phase_s_.size(); ++i)
            phase_s_[i] = 20.0f * uniform(random_bits(0x69646C65, seed), i);
    }
    void add_to(Figure& figure, float t) const {
        figure.root.x += 0.004f * wave(0.21f, t + phase_s_[0]) + 0.002f * wave(0.47f, t + phase_s_[1]);
        figure.root.y += 0.005f * wave(0.17f, t + phase_s_[2]) + 0.002f * wave(0.39f, t + phase_s_[3]);
        const float breath = wave(0.25f, t + phase_s_[4]);
        auto& chest = figure.rotation[VFIT_BONE_CHEST];
        auto& neck = figure.rotation[VFIT_BONE_NECK];
        chest = chest * rotate_x(-0.6f * breath);
        neck = neck * rotate_x(0.6f * breath);
    }

private:
    std::array<float, 5> phase_s_{};
};

class ScriptedMotion : public Motion {
public:
    ScriptedMotion(Script script, const Proportions& proportions, uint64_t seed)
        : script_(std::move(script)), proportions_(proportions), idle_(seed) {}

    BonePose at(double t) const override {
        Figure figure = script_.figure(static_cast<float>(std::fmod(t, double{script_.period_s})));
        idle_.add_to(figure, static_cast<float>(std::fmod(t, kIdlePeriod_s)));
        return solve(proportions_, figure);
    }

private:
    Script script_;
    Proportions proportions_;
    Idle idle_;
};

}  // namespace

std::string motion_names() {
    std::string names;
    for (const NamedScript& s : kScripts) names += (names.empty() ? "" : ", ") + std::string(s.name);
    return names;
}

bool is_motion(const std::string& name) {
    for (const NamedScript& s : kScripts)
        if (name == s.name) return true;
    return false;
}

std::unique_ptr<Motion> make_scripted_motion(const std::string& name, const Proportions& proportions,
                                             uint64_t seed, float arms_deg) {
    if (arms_deg >= 0.0f)
        for (const auto& [of_arms, make] :
             {std::pair("scan", &scan_script), {"side", &side_script}, {"round", &round_script}})
            if (name == of_arms) return std::make_unique<ScriptedMotion>(make(arms_deg), proportions, seed);
    for (const NamedScript& s : kScripts)
        if (name == s.name) return std::make_unique<ScriptedMotion>(s.make(seed), proportions, seed);
    fail(VFIT_ERROR_ARGUMENT, "virtual: unknown motion '", name, "'; known are ", motion_names());
}

}  // namespace vfit::virtual_person
