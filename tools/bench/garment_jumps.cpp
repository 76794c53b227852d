#include "bench/garment_jumps.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <optional>

#include "bench/limb_cover.h"
#include "bench/targets.h"
#include "bench/welded.h"
#include "client/assets.h"
#include "client/outfit.h"
#include "client/output.h"

namespace vfit::tools {

namespace {

constexpr float kFrame_s = 1.0f / 60.0f;
constexpr int kFramesToRest = 90, kFramesAfter = 60;
constexpr int kFramesOfSlowWay = 90;  // in which the same limb goes there without a leap
constexpr float kAllowed = 1.2f;      // of strain_max at rest
constexpr float kFloor = 0.02f;       // of strain, added to it: half of the solver's noise at 8 sub-steps
constexpr float kRadians = kPi / 180.0f;

/// Where the body stands, beside how it stands at first.
struct Stance {
    float aside_m = 0.0f, turned_rad = 0.0f, arm_rad = 0.0f;
};
struct Case {
    std::string name;
    Stance to;
};

std::vector<Case> jumps() {
    std::vector<Case> out;
    char name[32];
    for (const float way : {0.05f, 0.1f, 0.2f, 0.35f, 0.5f, 0.8f, 2.0f}) {
        std::snprintf(name, sizeof name, "jump %.2f m", double(way));
        out.push_back({name, {way, 0.0f, 0.0f}});
    }
    for (const float angle : {5.0f, 15.0f, 30.0f, 45.0f, 60.0f, 90.0f, 180.0f}) {
        std::snprintf(name, sizeof name, "turn %.0f deg", double(angle));
        out.push_back({name, {0.0f, angle * kRadians, 0.0f}});
    }
    return out;
}
const Case kLeap{"arm leaps 60 deg", {0.0f, 0.0f, 60.0f * kRadians}};

/// Upright, the arms 45 degrees down, the legs a little apart; then moved, turned, the left arm raised.
void stand_at(vfit_avatar avatar, const Stance& stance) {
    constexpr float kArm_rad = 45.0f * kRadians, kLeg_rad = 0.1f;
    const auto about_z = [&](vfit_bone_id bone) {
        switch (bone) {
            case VFIT_BONE_LEFT_UPPER_ARM: return -kArm_rad + stance.arm_rad;
            case VFIT_BONE_RIGHT_UPPER_ARM: return kArm_rad;
            case VFIT_BONE_LEFT_UPPER_LEG: return kLeg_rad;
            case VFIT_BONE_RIGHT_UPPER_LEG: return -kLeg_rad;
            default: return 0.0f;
        }
    };
    std::vector<vfit_bone> bones;
    for (const vfit_rig_bone& rig : rig_of(avatar)) {
        const bool is_root = rig.bone == VFIT_BONE_HIPS;
        if (!is_root && about_z(rig.bone) == 0.0f) continue;
        vfit_bone bone = vfit_bone_init();
        bone.bone = rig.bone;
        std::copy(rig.rest_position, rig.rest_position + 3, bone.position);
        if (is_root) bone.position[0] += stance.aside_m;
        const float half = 0.5f * (is_root ? stance.turned_rad : about_z(rig.bone));
        bone.rotation[is_root ? 1 : 2] = std::sin(half), bone.rotation[3] = std::cos(half);
        bones.push_back(bone);
    }
    set_pose(avatar, vfit_pose_init(), bones);
}

struct Look {
    float strain_max = 0.0f;                       // of all layers
    std::vector<std::vector<LimbCover>> covers{};  // of each limb, by each layer
};

/// What a case left, a second after it.
struct Outcome {
    std::string name;
    float strain_max = 0.0f, allowed = 0.0f;
    int off_limbs = 0;
    float excess() const { return strain_max / allowed; }
};

class JumpJudge {
public:
    JumpJudge(vfit_context context, const std::string& names, const JumpsOptions& options)
        : avatar_(default_wearer(context, names)) {
        stand_at(avatar_.get(), {});
        vfit_cloth_desc desc = vfit_cloth_desc_init();
        desc.flags = options.spheres ? 0 : VFIT_CLOTH_SKIN;
        desc.inertia = options.inertia;
        desc.carry_speed_m_s = options.carry_speed_m_s;
        desc.carry_way_m = options.carry_way_m;
        outfit_.emplace(context, avatar_.get(), names, desc);
    }

    Outcome of(const Case& change) {
        const Look rest = settled();
        stand_at(avatar_.get(), change.to);
        step(kFramesAfter);
        return outcome(change.name, rest, look(), rest.strain_max);
    }
    /// As `of`, against what the same way leaves that is not leapt.
    Outcome of_limb(const Case& change) {
        settled();
        for (int i = 1; i <= kFramesOfSlowWay; ++i) {
            stand_at(avatar_.get(), {0.0f, 0.0f, change.to.arm_rad * float(i) / float(kFramesOfSlowWay)});
            step(1);
        }
        step(kFramesAfter);
        const float slow = look().strain_max;
        Outcome out = of(change);
        out.allowed = std::max(out.allowed, kAllowed * slow + kFloor);
        return out;
    }

private:
    Look settled() {
        stand_at(avatar_.get(), {});
        outfit_->reset();
        step(kFramesToRest);
        return look();
    }
    void step(int frames) {
        for (int i = 0; i < frames; ++i) outfit_->step(kFrame_s);
    }
    Look look() const {
        Look out;
        for (const vfit_cloth cloth : outfit_->cloths()) {
            vfit_cloth_stats stats = vfit_cloth_stats_init();
            check(vfit_cloth_describe(cloth, &stats));
            out.strain_max = std::max(out.strain_max, stats.strain_max);
            out.covers.push_back(cover_of_limbs(avatar_.get(), mesh_of(cloth)));
        }
        return out;
    }
    static Outcome outcome(const std::string& name, const Look& rest, const Look& after, float reference) {
        Outcome out{name, after.strain_max, kAllowed * reference + kFloor, 0};
        for (size_t layer = 0; layer < rest.covers.size(); ++layer)
            for (size_t limb = 0; limb < rest.covers[layer].size(); ++limb)
                out.off_limbs += is_off_limb(rest.covers[layer][limb], after.covers[layer][limb]);
        return out;
    }

    Avatar avatar_;
    std::optional<WornOutfit> outfit_;
};

Json json_of(const std::string& garment, const Outcome& o) {
    return {{"garment", garment},
            {"case", o.name},
            {"strain_max", o.strain_max},
            {"allowed", o.allowed},
            {"off_limbs", o.off_limbs}};
}

class JumpReport {
public:
    explicit JumpReport(const JumpsOptions& options) : options_(options), targets_(options.json) {}

    void add(const std::string& garment, const std::vector<Outcome>& outcomes) {
        const auto worst = std::max_element(outcomes.begin(), outcomes.end(),
                                            [](auto& a, auto& b) { return a.excess() < b.excess(); });
        int off = 0;
        for (const Outcome& o : outcomes) {
            rows_.push_back(json_of(garment, o));
            if (options_.all) targets_.judge("    " + o.name, o.strain_max, Aim::at_most, o.allowed, 3);
            off += o.off_limbs;
        }
        targets_.judge(garment + ": strain_max, worst: " + worst->name, worst->strain_max, Aim::at_most,
                       worst->allowed, 3);
        targets_.judge(garment + ": sleeves and legs off their limb, all cases", off, Aim::exactly, 0);
    }
    void finish() const {
        if (options_.json) print_document({{"rows", rows_}, {"targets", targets_.json()}});
    }

private:
    const JumpsOptions& options_;
    Targets targets_;
    Json rows_ = Json::array();
};

}  // namespace

void judge_jumps(const JumpsOptions& options) {
    const Context context = open_context();
    std::vector<std::string> garments = {options.garment};
    if (options.garment.empty()) {
        garments = garment_names(context.get());
        garments.insert(garments.end(), {"pants_men+shirt_men", "jeans_women+duster"});
    }
    if (!options.json)
        std::cout
            << "The body jumps or turns within one step of 1/60 s: strain_max one second after, at most "
            << kAllowed << " times that at rest + " << kFloor << "\n";
    JumpReport report(options);
    for (const std::string& garment : garments) {
        JumpJudge judge(context.get(), garment, options);
        std::vector<Outcome> outcomes;
        for (const Case& change : jumps()) outcomes.push_back(judge.of(change));
        report.add(garment, outcomes);
        report.add(garment, {judge.of_limb(kLeap)});
    }
    report.finish();
}

}  // namespace vfit::tools
