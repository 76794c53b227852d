// A strip that swings and strips that hang, against theory.
#include <cmath>
#include <iomanip>
#include <iostream>

#include "bench/bench.h"
#include "bench/drape_parts.h"
#include "bench/drape_scenes.h"
#include "cloth/fabric/fabric_library.h"
#include "core/files.h"

namespace vfit::tools {

namespace {

constexpr float kFrame_s = 1.0f / 60.0f, kGravity = 9.81f;

/// J0, by its series (Abramowitz and Stegun 9.1.10).
double bessel0(double x) {
    double term = 1.0, sum = 1.0;
    for (int k = 1; k < 40; ++k) sum += term *= -x * x / (4.0 * k * k);
    return sum;
}

/// A strip that hangs from its first row, bent into the first mode of a hanging chain, x = A J0(2.4048 sqrt(z
/// / L)).
struct Swing {
    double period_s, kept;  // of the amplitude, a period
};
Swing swing(float damping) {
    constexpr uint32_t kRows = 41, kColumns = 5;
    constexpr float kStep_m = 0.02f, kLength_m = kStep_m * float(kRows - 1), kAmplitude_m = 0.03f;
    bench::Sheets strip;
    strip.add(kRows, kColumns, Vec3(0.0f), {kStep_m, 0, 0}, {0, -kStep_m, 0});
    for (uint32_t c = 0; c < kColumns; ++c) strip.simulated[c] = 0;
    FabricMaterial material = bench::plain_weave();
    material.bend_n_m = 1e-9f;  // a chain
    ClothSettings settings;
    settings.damping = damping;
    settings.sleeps = false;
    std::vector<Vec3> start = strip.positions;
    for (Vec3& p : start)
        p.z = kAmplitude_m * float(bessel0(2.404826 * std::sqrt((kLength_m + p.y) / kLength_m)));
    const auto jobs = Jobs::own(0);
    vfit::Cloth cloth(strip.cook(material), settings, start);
    std::vector<double> crossings, peaks;
    double last = kAmplitude_m, peak = 0.0;
    for (int frame = 1; crossings.size() < 21; ++frame) {
        cloth.step(kFrame_s, strip.positions, {}, *jobs);
        const double z = cloth.positions()[strip.positions.size() - 3].z;
        if ((z > 0) != (last > 0)) {
            crossings.push_back((frame - 1 + last / (last - z)) * kFrame_s);
            peaks.push_back(peak);
            peak = 0.0;
        }
        peak = std::max(peak, std::abs(z));
        last = z;
        if (frame > 3600) return {NAN, NAN};
    }
    const double period = (crossings.back() - crossings.front()) / 10.0;
    return {period, std::pow(peaks.back() / peaks[1], 1.0 / (0.5 * double(peaks.size() - 2)))};
}

FabricLibrary fabrics() { return FabricLibrary::parse(read_file(library_file("vfit_data/fabrics.json"))); }

/// Modulus (N/m) along the strip, by what a load that should stretch it by 4 % does.
double modulus(const FabricMaterial& given, bool along_warp) {
    constexpr uint32_t kRows = 17, kColumns = 6;
    constexpr float kStep_m = 0.02f, kWidth_m = kStep_m * float(kColumns - 1),
                    kLength_m = kStep_m * float(kRows - 1);
    const float expected = along_warp ? given.stretch_warp_n_m : given.stretch_weft_n_m;
    bench::Sheets strip;
    strip.add(kRows, kColumns, Vec3(0.0f), {kStep_m, 0, 0}, {0, -kStep_m, 0});
    for (Vec2& uv : strip.uvs)
        if (!along_warp) uv = Vec2(uv.y, uv.x);
    for (uint32_t c = 0; c < kColumns; ++c) strip.simulated[c] = 0;
    FabricMaterial material = given;
    material.bend_n_m = 1e-9f;      // bends are springs too and would share the load
    material.density_kg_m2 = 4.0f;  // heavy, so that a pass carries the load
    FabricData data = cook_fabric({strip.positions, strip.indices, strip.uvs, strip.simulated}, material);
    data.tethers.clear();
    const float force = 0.04f * expected * kWidth_m,
                own = 0.5f * kGravity * material.density_kg_m2 * kWidth_m * kLength_m;
    for (uint32_t c = 0; c < kColumns; ++c) {
        const float share = (c == 0 || c + 1 == kColumns ? 0.5f : 1.0f) / float(kColumns - 1);
        float& w = data.inverse_mass[(kRows - 1) * kColumns + c];
        w = 1.0f / (1.0f / w + std::max(force - own, 0.01f) / kGravity * share);
    }
    ClothSettings settings;
    settings.damping = 0.97f;
    settings.substeps = 128;
    const auto jobs = Jobs::own(0);
    vfit::Cloth cloth(std::make_shared<const Fabric>(std::move(data)), settings, strip.positions);
    for (int frame = 0; frame < 300; ++frame) cloth.step(kFrame_s, strip.positions, {}, *jobs);
    double lowest = 0.0;
    for (uint32_t c = 0; c < kColumns; ++c)
        lowest += cloth.positions()[(kRows - 1) * kColumns + c].y / double(kColumns);
    return (std::max(force - own, 0.01f) + own) / kWidth_m / ((-lowest - kLength_m) / kLength_m);
}

/// Bending stiffness (N m) by Peirce's cantilever (1930): a strip held level droops by an angle that tells
/// its bending length.
double stiffness(const FabricMaterial& material) {
    const float bending_length = std::cbrt(material.bend_n_m / (material.density_kg_m2 * kGravity));
    constexpr uint32_t kRows = 17, kColumns = 5, kHeld = 2;
    // The fold at the edge bends half of the row that is held: cloth is free from the middle of that on.
    const float overhang = 1.8f * bending_length, step = overhang / (float(kRows - kHeld) + 0.5f);
    bench::Sheets strip;
    strip.add(kRows, kColumns, Vec3(0.0f), {step, 0, 0}, {0, 0, step});
    for (uint32_t i = 0; i < kHeld * kColumns; ++i) strip.simulated[i] = 0;
    FabricData data = cook_fabric({strip.positions, strip.indices, strip.uvs, strip.simulated}, material);
    data.tethers.clear();
    ClothSettings settings;
    settings.damping = 0.97f;
    settings.substeps = 512;
    settings.sleeps = false;
    const auto jobs = Jobs::own(0);
    vfit::Cloth cloth(std::make_shared<const Fabric>(std::move(data)), settings, strip.positions);
    for (int frame = 0; frame < 300; ++frame) cloth.step(kFrame_s, strip.positions, {}, *jobs);
    const Vec3 tip = cloth.positions()[strip.positions.size() - 3],
               edge = strip.positions[(kHeld - 1) * kColumns + 2] - Vec3(0, 0, 0.5f * step);
    const double angle = std::atan2(edge.y - tip.y, tip.z - edge.z);
    const double length = overhang * std::cbrt(std::cos(0.5 * angle) / (8.0 * std::tan(angle)));
    return material.density_kg_m2 * kGravity * length * length * length;
}

}  // namespace

Json judge_strip(const DrapeJudge& judge) {
    constexpr double kLength_m = 0.8;
    const double theory_s = 2.0 * kPi / (0.5 * 2.404826 * std::sqrt(kGravity / kLength_m));
    const Swing free = swing(0.0f), damped = swing(0.5f);
    // v' = -c v with exp(-c) = 0.5 takes exp(-c t / 2) of a swing's amplitude.
    const double kept = std::pow(0.5, 0.5 * theory_s);
    if (!judge.quiet) std::cout << "\nA strip of 0.8 m that swings, against the hanging chain\n";
    judge.targets.judge("period over theory", free.period_s / theory_s, Aim::at_most, 1.1, 3);
    judge.targets.judge("amplitude kept in a period without damping", free.kept, Aim::at_least, 0.9, 3);
    judge.targets.judge("the same with damping 0.5, over theory", damped.kept / kept, Aim::at_least, 0.9, 3);
    judge.targets.judge("the same with damping 0.5, over theory", damped.kept / kept, Aim::at_most, 1.1, 3);
    return {{"period_s", free.period_s},
            {"theory_s", theory_s},
            {"kept", free.kept},
            {"kept_damped", damped.kept}};
}

Json judge_fabrics(const DrapeJudge& judge) {
    if (!judge.quiet)
        std::cout << "\nModuli of strips under a load, and stiffness of a cantilever, over what the fabric "
                     "says\n  fabric              warp    weft    bending\n";
    Json out;
    double worst = 0.0, worst_bend = 0.0;
    const FabricLibrary library = fabrics();
    for (const std::string& name : library.names()) {
        const FabricMaterial& m = library.get(name);
        const double warp = modulus(m, true) / m.stretch_warp_n_m,
                     weft = modulus(m, false) / m.stretch_weft_n_m;
        const double bend = stiffness(m) / m.bend_n_m;
        worst = std::max({worst, std::abs(warp - 1.0), std::abs(weft - 1.0)});
        worst_bend = std::max(worst_bend, std::abs(bend - 1.0));
        if (!judge.quiet)
            std::cout << "  " << std::left << std::setw(18) << name << std::right << std::fixed
                      << std::setprecision(3) << std::setw(7) << warp << std::setw(8) << weft << std::setw(10)
                      << bend << "\n";
        out[name] = {{"warp", warp}, {"weft", weft}, {"bending", bend}};
    }
    judge.targets.judge("worst modulus off", 100.0 * worst, Aim::at_most, 10.0, 1, " %");
    judge.targets.judge("worst bending stiffness off", 100.0 * worst_bend, Aim::at_most, 30.0, 1, " %");
    return out;
}

}  // namespace vfit::tools
