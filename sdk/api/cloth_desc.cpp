#include "api/cloth_desc.h"

#include <cmath>

#include "api/structs.h"

namespace vfit::api {

namespace {

void check(const vfit_cloth_desc& d) {
    for (const float x : {d.gravity[0], d.gravity[1], d.gravity[2], d.friction, d.damping, d.thickness_m,
                          d.wind[0], d.wind[1], d.wind[2], d.drag, d.lift, d.inertia, d.self_thickness_m,
                          d.budget_ms, d.cover_m, d.virtual_m, d.carry_speed_m_s, d.carry_way_m})
        if (!std::isfinite(x)) fail(VFIT_ERROR_ARGUMENT, "desc: a number is not finite");
    if (d.substeps > kMaxSubsteps)
        fail(VFIT_ERROR_ARGUMENT, "desc.substeps ", d.substeps, " is more than ", kMaxSubsteps);
    if (d.damping > 1.0f) fail(VFIT_ERROR_ARGUMENT, "desc.damping ", d.damping, " is more than 1");
    if (d.thickness_m < 0.0f || d.thickness_m > 0.1f)
        fail(VFIT_ERROR_ARGUMENT, "desc.thickness_m ", d.thickness_m, " is not in 0..0.1 m");
    if (d.inertia > 1.0f) fail(VFIT_ERROR_ARGUMENT, "desc.inertia ", d.inertia, " is more than 1");
    if (d.drag < 0.0f || d.lift < 0.0f)
        fail(VFIT_ERROR_ARGUMENT, "desc.drag ", d.drag, " and lift ", d.lift, " must not be negative");
    if (d.self_thickness_m < 0.0f || d.self_thickness_m > 0.1f)
        fail(VFIT_ERROR_ARGUMENT, "desc.self_thickness_m ", d.self_thickness_m, " is not in 0..0.1 m");
    if (d.virtual_m != 0.0f && (d.virtual_m < 0.001f || d.virtual_m > 0.1f))
        fail(VFIT_ERROR_ARGUMENT, "desc.virtual_m ", d.virtual_m, " is not in 0.001..0.1 m");
    constexpr float kFinestCover_m = 0.005f;
    if (d.cover_m != 0.0f && (d.cover_m < kFinestCover_m || d.cover_m > 0.1f))
        fail(VFIT_ERROR_ARGUMENT, "desc.cover_m ", d.cover_m, " is not in ", kFinestCover_m, "..0.1 m");
    if (d.budget_ms < 0.0f) fail(VFIT_ERROR_ARGUMENT, "desc.budget_ms ", d.budget_ms, " is negative");
    if ((d.flags & VFIT_CLOTH_SKIN) != 0 && d.cover_m > 0.0f)
        fail(VFIT_ERROR_ARGUMENT, "desc.cover_m is of no use with VFIT_CLOTH_SKIN");
}

/// As setting(), of a limit that a negative number lifts.
float limit(float given, float preset) { return given < 0.0f ? INFINITY : setting(given, preset); }

ClothSettings settings_of(const vfit_cloth_desc& d, const Axes& axes) {
    ClothSettings s;
    if (d.substeps) s.substeps = d.substeps;
    if (d.gravity[0] != 0.0f || d.gravity[1] != 0.0f || d.gravity[2] != 0.0f)
        s.gravity = axes.point_in({d.gravity[0], d.gravity[1], d.gravity[2]});
    s.damping = setting(d.damping, s.damping);
    if (d.thickness_m > 0.0f) s.thickness_m = d.thickness_m;
    s.inertia = setting(d.inertia, 1.0f);
    s.carry_speed_m_s = limit(d.carry_speed_m_s, s.carry_speed_m_s);
    s.carry_way_m = limit(d.carry_way_m, s.carry_way_m);
    s.air = {axes.point_in({d.wind[0], d.wind[1], d.wind[2]}), d.drag, d.lift};
    s.self_thickness_m = d.self_thickness_m;
    s.virtual_m = d.virtual_m;
    s.budget_ms = d.budget_ms;
    s.sleeps = (d.flags & VFIT_CLOTH_AWAKE) == 0;
    s.pressure = (d.flags & VFIT_CLOTH_PRESSURE) != 0;
    return s;
}

}  // namespace

WearOptions wear_options(const vfit_cloth_desc* desc, const Axes& axes) {
    const vfit_cloth_desc d = read_or_default(desc, "desc");
    check_flags(
        d.flags,
        VFIT_CLOTH_NO_HANDS | VFIT_CLOTH_SKIN | VFIT_CLOTH_AWAKE | VFIT_CLOTH_PRESSURE | VFIT_CLOTH_ANY_FIT,
        "desc.flags");
    check(d);
    WearOptions options;
    if (d.size_label) options.size = d.size_label;
    options.any_fit = (d.flags & VFIT_CLOTH_ANY_FIT) != 0;
    options.hands = (d.flags & VFIT_CLOTH_NO_HANDS) == 0;
    options.on_skin = (d.flags & VFIT_CLOTH_SKIN) != 0;
    options.cover_m = d.cover_m;
    if (d.friction != 0.0f) options.friction = setting(d.friction, 0.0f);
    options.cloth = settings_of(d, axes);
    return options;
}

}  // namespace vfit::api
