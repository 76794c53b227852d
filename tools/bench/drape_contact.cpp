// A cloth and itself, large cloths, and random scenes.
#include <cmath>
#include <iomanip>
#include <iostream>
#include <random>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include "bench/bench.h"
#include "bench/drape_parts.h"
#include "bench/drape_scenes.h"
#include "cloth/crossings.h"

namespace vfit::tools {

namespace {

constexpr float kFrame_s = 1.0f / 60.0f;

struct SelfScene {
    const char* name;
    bench::Sheets sheets;
    std::vector<Vec3> flat;  // where vertices lie on the cut pieces, each piece far from the others
    std::vector<Collider> colliders;
};

/// Held along its middle, both halves hang down on each other.
SelfScene fold() {
    SelfScene scene{"fold", {}, {}, {}};
    constexpr uint32_t kRows = 51, kColumns = 31;
    scene.sheets.add(kRows, kColumns, {-0.3f, 0.0f, -0.5f}, {0.02f, 0, 0}, {0, 0, 0.02f});
    for (uint32_t c = 0; c < kColumns; ++c) scene.sheets.simulated[kRows / 2 * kColumns + c] = 0;
    scene.flat = scene.sheets.positions;
    return scene;
}

/// Three sheets that fall on a ball, one above the other.
SelfScene layers() {
    SelfScene scene{"three layers", {}, {}, {bench::ball(Vec3(0.0f), 0.15f)}};
    for (int layer = 0; layer < 3; ++layer) {
        scene.sheets.add(31, 31, {-0.3f, 0.17f + 0.012f * float(layer), -0.3f}, {0.02f, 0, 0}, {0, 0, 0.02f});
        while (scene.flat.size() < scene.sheets.positions.size())
            scene.flat.push_back(scene.sheets.positions[scene.flat.size()] +
                                 Vec3(0, 10.0f * float(layer), 0));
    }
    return scene;
}

/// A strip that falls on its narrow side and crumples: layers meet at 2.5 m/s.
SelfScene heap() {
    SelfScene scene{"heap", {}, {}, {bench::ball({0, -20, 0}, 20.0f)}};
    scene.sheets.add(61, 31, {-0.3f, 1.3f, 0.0f}, {0.02f, 0, 0.0002f}, {0, -0.02f, 0.0003f});
    scene.flat = scene.sheets.positions;
    return scene;
}

struct SelfResult {
    double ms;
    size_t crossed;  // in the worst step
    size_t crossed_end;
    double spacing_mm;
};
SelfResult run(const SelfScene& scene, float thickness_m) {
    constexpr int kFrames = 180;
    constexpr float kAlong_m = 0.08f;  // beyond what contact leaves out as neighbours on the flat cloth
    ClothSettings settings;
    settings.self_thickness_m = thickness_m;
    settings.friction = 0.9f;
    settings.sleeps = false;
    const auto jobs = Jobs::own(0);
    vfit::Cloth cloth(scene.sheets.cook(bench::plain_weave()), settings, scene.sheets.positions);
    Samples ms;
    SelfResult out{};
    for (int frame = 1; frame <= kFrames; ++frame) {
        const Timer timer;
        cloth.step(kFrame_s, scene.sheets.positions, scene.colliders, *jobs);
        ms.add(timer.ms());
        out.crossed_end = crossed_triangles(cloth.positions(), scene.sheets.indices).size();
        out.crossed = std::max(out.crossed, out.crossed_end);
    }
    out.ms = ms.quantile(0.5);
    out.spacing_mm =
        1e3 * bench::least_spacing(cloth.positions(), scene.sheets.indices, scene.flat, kAlong_m);
    return out;
}

}  // namespace

Json judge_self(const DrapeJudge& judge) {
    constexpr float kThickness_m = 0.006f;
    if (!judge.quiet)
        std::cout << "\nA cloth and itself, 6 mm apart; one core (vfit-bench cloth DIR walk --self 6 for the "
                     "common scene)\n";
    Json out;
    for (const SelfScene& scene : {fold(), layers(), heap()}) {
        const SelfResult without = run(scene, 0.0f), with = run(scene, kThickness_m);
        const std::string name = scene.name;
        if (!judge.quiet)
            std::cout << "  " << name << ", " << scene.sheets.positions.size() << " vertices: " << std::fixed
                      << std::setprecision(3) << without.ms << " ms without, " << with.ms
                      << " ms with; crossed without " << without.crossed << "\n";
        judge.targets.judge(name + ": crossed pairs of triangles, worst step", double(with.crossed),
                            Aim::exactly, 0.0);
        judge.targets.judge(name + ": least spacing over the thickness",
                            with.spacing_mm / (1e3 * kThickness_m), Aim::at_least, 0.5, 2);
        judge.targets.judge(name + ": time over that without", with.ms / without.ms, Aim::at_most, 2.0, 2);
        out[name] = {{"ms_without", without.ms},           {"ms", with.ms},
                     {"crossed_worst", with.crossed},      {"crossed_end", with.crossed_end},
                     {"crossed_without", without.crossed}, {"spacing_mm", with.spacing_mm}};
    }
    return out;
}

Json judge_scale(const DrapeJudge& judge) {
    pin_to_cores(1);
    if (!judge.quiet)
        std::cout << "\nSheets that fall on a ball, 8 sub-steps, one core\n  vertices        ms  ns a vertex "
                     "and frame\n";
    Json out = Json::array();
    double first = 0.0, last = 0.0;
    for (const uint32_t side : {32u, 55u, 100u, 173u}) {
        const float step = 1.0f / float(side - 1);
        bench::Sheets sheet;
        sheet.add(side, side, {-0.5f, 0.32f, -0.5f}, {step, 0, 0}, {0, 0, step});
        ClothSettings settings;
        settings.sleeps = false;
        const auto jobs = Jobs::own(0);
        vfit::Cloth cloth(sheet.cook(bench::plain_weave()), settings, sheet.positions);
        Samples ms;
        const std::vector<Collider> ball{bench::ball(Vec3(0.0f), 0.3f)};
        for (int frame = 0; frame < 90; ++frame) {
            const Timer timer;
            cloth.step(kFrame_s, sheet.positions, ball, *jobs);
            if (frame >= 10) ms.add(timer.ms());
        }
        const double count = double(side) * side, ns = 1e6 * ms.quantile(0.5) / count;
        if (!judge.quiet)
            std::cout << std::setw(10) << uint32_t(count) << std::fixed << std::setprecision(3)
                      << std::setw(10) << ms.quantile(0.5) << std::setprecision(0) << std::setw(8) << ns
                      << "\n";
        out.push_back({{"vertices", count}, {"ms", ms.quantile(0.5)}, {"ns_a_vertex", ns}});
        if (side == 55) first = ns;
        last = ns;
    }
    judge.targets.judge("30k vertices over 3k, time a vertex", last / first, Aim::at_most, 1.25, 2);
    return out;
}

/// Bytes that the program holds now, 0: not known here.
double held_bytes() {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
    const auto heap = mallinfo2();
    return double(heap.uordblks) + double(heap.hblkhd);
#else
    return 0.0;
#endif
}

/// Sheets of random shape and fabric, balls that fly about and jump, random steps.
Json judge_random(const DrapeJudge& judge) {
    std::mt19937 random(7);
    const auto number = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    const auto jobs = Jobs::own(0);
    double simulated_s = 0.0;
    size_t scenes = 0, lost = 0, crossed = 0, far = 0, tangled = 0, own_layers = 0;
    size_t looks = 0, looks_crossed = 0;
    constexpr size_t kWarm = 20;
    constexpr int kLook = 4;  // steps
    double first_bytes = 0.0;
    while (simulated_s < 60.0 * judge.minutes) {
        if (++scenes == kWarm) first_bytes = held_bytes();
        bench::Sheets sheet;
        const auto rows = uint32_t(number(4, 40)), columns = uint32_t(number(4, 40));
        const Vec3 across(number(0.008f, 0.03f), number(-0.003f, 0.003f), 0),
            down(0, -number(0.008f, 0.03f), number(-0.003f, 0.003f));
        sheet.add(rows, columns, Vec3(0.0f), across, down);
        for (uint32_t c = 0; c < columns; ++c) sheet.simulated[c] = number(0, 1) < 0.2f || c == 0;
        FabricMaterial material = bench::plain_weave();
        material.density_kg_m2 = number(0.05f, 0.6f);
        material.stretch_warp_n_m = number(100.0f, 5000.0f);
        material.stretch_weft_n_m = number(100.0f, 5000.0f);
        material.bend_n_m = std::pow(10.0f, number(-6.5f, -3.5f));
        ClothSettings settings;
        settings.substeps = uint32_t(number(1, 12));
        settings.friction = number(0, 1);
        settings.self_thickness_m = number(0, 1) < 0.5f ? 0.0f : 0.005f;
        settings.inertia = number(0, 1);
        settings.air = {{number(-5, 5), 0, number(-5, 5)}, number(0, 1), number(0, 1)};
        vfit::Cloth cloth(sheet.cook(material), settings, sheet.positions);
        const Vec3 middle = 0.5f * (across * float(columns) + down * float(rows));
        const float size = glm::length(middle);
        std::vector<Vec3> targets = sheet.positions;
        Vec3 body(0.0f);
        Collider ball = bench::ball(middle + Vec3(0, 0, -0.5f), number(0.03f, 0.15f));
        const auto frames = int(number(60, 300));
        for (int frame = 0; frame < frames; ++frame) {
            const float dt = number(0, 1) < 0.02f ? number(0, 1.0f) : kFrame_s;
            const Vec3 way(number(-0.05f, 0.05f), number(-0.05f, 0.05f), number(-0.05f, 0.05f));
            ball.center += way;
            if (glm::length(ball.center - middle) > 2.0f * size + 0.3f) ball.center = middle;
            if (number(0, 1) < 0.005f) body += Vec3(2.0f, 0, 0);  // it jumps
            // What is held trembles, but does not change places with what is held beside it: the cloth could
            // not follow.
            for (size_t i = 0; i < targets.size(); ++i)
                targets[i] = body + sheet.positions[i] + Vec3(number(-0.002f, 0.002f), 0, 0);
            cloth.step(dt, targets, std::span(&ball, 1), *jobs);
            simulated_s += dt;
            if (settings.self_thickness_m > 0.0f && frame % kLook == 0) {
                ++looks;
                looks_crossed += !crossed_triangles(cloth.positions(), sheet.indices).empty();
            }
            for (const Vec3& p : cloth.positions()) {
                lost += !std::isfinite(p.x + p.y + p.z);
                far += glm::length(p - targets[0]) > 10.0f * (size + 1.0f);
            }
            if (lost) break;
        }
        // At rest for half a second, with nothing in the way.
        for (int frame = 0; frame < 30; ++frame) cloth.step(kFrame_s, targets, {}, *jobs);
        if (settings.self_thickness_m == 0.0f) continue;
        const size_t pairs = crossed_triangles(cloth.positions(), sheet.indices).size();
        crossed += pairs, tangled += pairs > 0, ++own_layers;
    }
    // A cloth is some 500 kB. The heap keeps some of what was freed at hand.
    const double grown_kb =
        scenes > kWarm ? (held_bytes() - first_bytes) / 1024.0 / double(scenes - kWarm) : 0.0;
    if (!judge.quiet)
        std::cout << "\nRandom cloths: " << scenes << " of them, " << std::fixed << std::setprecision(1)
                  << simulated_s / 60.0 << " minutes; " << tangled << " of " << own_layers
                  << " with layers of their own cross somewhere\n";
    judge.targets.judge("vertices that are no number", double(lost), Aim::exactly, 0.0);
    judge.targets.judge("vertices far away", double(far), Aim::exactly, 0.0);
    judge.targets.judge("crossed pairs after half a second of rest", double(crossed), Aim::exactly, 0.0);
    judge.targets.judge("looks at every fourth step with a crossed pair, of " + std::to_string(looks),
                        double(looks_crossed), Aim::exactly, 0.0);
    judge.targets.judge("memory that each leaves behind", grown_kb, Aim::at_most, 4.0, 1, " kB");
    return {{"scenes", scenes},
            {"minutes", simulated_s / 60.0},
            {"lost", lost},
            {"far", far},
            {"crossed", crossed},
            {"tangled", tangled},
            {"looks", looks},
            {"looks_crossed", looks_crossed},
            {"own_layers", own_layers},
            {"grown_kb", grown_kb}};
}

}  // namespace vfit::tools
