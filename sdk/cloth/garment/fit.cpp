#include "cloth/garment/fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "cloth/garment/borders.h"

namespace vfit {

namespace {

/// What a level's plane cuts of the garment.
struct Cut {
    float flat_m = 0.0f, worn_m = 0.0f, around_rad = 0.0f;
    // Ends of the line at the garment's borders.
    std::vector<Vec3> ends;
};

/// The place on an edge at that height: share from its first end.
float share_at(const Vec3& a, const Vec3& b, float height) { return (height - a.y) / (b.y - a.y); }

Cut cut_at(const WornGarment& g, const GirthLevel& level) {
    Cut out;
    std::map<std::pair<uint32_t, uint32_t>, std::pair<int, Vec3>> crossed;  // edges: by how many triangles, and where
    for (size_t i = 0; i + 2 < g.indices.size(); i += 3) {
        const uint32_t* v = &g.indices[i];
        if (!g.on_arm.empty() && (g.on_arm[v[0]] || g.on_arm[v[1]] || g.on_arm[v[2]])) continue;  // of a sleeve
        Vec3 worn[2];
        Vec2 flat[2];
        int count = 0;
        for (size_t k = 0; k < 3 && count < 2; ++k) {
            const size_t n = (k + 1) % 3;
            const Vec3 &a = g.positions[v[k]], &b = g.positions[v[n]];
            if ((a.y < level.height_m) == (b.y < level.height_m)) continue;
            const float share = share_at(a, b, level.height_m);
            worn[count] = glm::mix(a, b, share);
            flat[count] = glm::mix(g.cut[i + k], g.cut[i + n], share);
            auto& edge = crossed[std::minmax(v[k], v[n])];
            ++edge.first;
            edge.second = worn[count++];
        }
        if (count < 2) continue;
        out.flat_m += glm::length(flat[1] - flat[0]);
        out.worn_m += glm::length(worn[1] - worn[0]);
        const Vec2 p(worn[0].x, worn[0].z - level.axis_z_m), q(worn[1].x, worn[1].z - level.axis_z_m);
        out.around_rad += std::abs(std::atan2(p.x * q.y - p.y * q.x, glm::dot(p, q)));
    }
    for (const auto& [edge, seen] : crossed)
        if (seen.first == 1) out.ends.push_back(seen.second);
    return out;
}

/// Across the opening of a coat: between its two ends, where there are just two.
float opening_of(const Cut& cut) { return cut.ends.size() == 2 ? glm::length(cut.ends[0] - cut.ends[1]) : 0.0f; }

/// Armholes open it at a side, a coat's fronts in the middle.
bool is_through_armhole(const Cut& cut, float axis_z_m) {
    if (cut.ends.size() != 2) return !cut.ends.empty();
    const Vec3 middle = 0.5f * (cut.ends[0] + cut.ends[1]);
    return std::abs(middle.x) > std::abs(middle.z - axis_z_m);
}

}  // namespace

std::vector<GirthFit> fit_of(const WornGarment& garment, std::span<const GirthLevel> levels) {
    constexpr float kMostOfTheWay_rad = 1.5f * kPi, kNear_m = 0.02f;
    std::vector<GirthFit> out;
    for (GirthLevel level : levels) {
        // Where an armhole reaches below the body's level, the garment's own is below the armhole.
        constexpr float kStep_m = 0.01f, kLowest_m = 0.09f;
        Cut cut = cut_at(garment, level);
        for (float down = kStep_m; is_through_armhole(cut, level.axis_z_m) && down <= kLowest_m; down += kStep_m) {
            level.height_m -= kStep_m;
            cut = cut_at(garment, level);
        }
        if (cut.around_rad < kMostOfTheWay_rad || is_through_armhole(cut, level.axis_z_m)) continue;
        // Cloth below, too: else the gap is no open front but a hem that swings about that level.
        constexpr float kBelow_m = 0.03f;
        if (!cut.ends.empty() && cut_at(garment, {level.key, level.height_m - kBelow_m, level.body_m, level.axis_z_m}).around_rad < kMostOfTheWay_rad) continue;
        GirthFit fit;
        fit.key = level.key;
        fit.body_m = level.body_m;
        fit.opening_m = opening_of(cut);
        fit.garment_m = cut.flat_m;
        fit.ease_m = fit.garment_m - fit.body_m;
        fit.strain = cut.worn_m / cut.flat_m - 1.0f;
        if (!garment.pressure_pa.empty()) {
            float sum = 0.0f;
            int count = 0;
            for (size_t v = 0; v < garment.positions.size(); ++v) {
                if (std::abs(garment.positions[v].y - level.height_m) > kNear_m || (!garment.on_arm.empty() && garment.on_arm[v])) continue;
                sum += garment.pressure_pa[v];
                ++count;
            }
            if (count > 0) fit.pressure_pa = sum / float(count);
        }
        out.push_back(fit);
    }
    return out;
}

Fit judge_fit(const Garment& garment, const std::string& label, const GirthFit& fit) {
    const auto girth_of = [&](const GarmentSize& size) {
        const Measurement* m = find(size.nominal, fit.key);
        return m ? m->value : 0.0f;
    };
    float own = 0.0f;
    std::vector<float> girths;
    for (const GarmentSize& size : garment.sizes) {
        girths.push_back(girth_of(size));
        if (size.label == label) own = girths.back();
    }
    if (own <= 0.0f) {
        constexpr float kTight = 0.03f, kLoose_m = 0.12f;
        if (fit.opening_m == 0.0f && (fit.strain > kTight || fit.ease_m < -kTight * fit.body_m)) return Fit::tight;
        return fit.ease_m > kLoose_m ? Fit::loose : Fit::right;
    }
    // A half of the step to the next size; at the ends of the table, and of a single size, of the step on the other side.
    float smaller = 0.0f, larger = 0.0f;
    for (const float g : girths) {
        if (g > 0.0f && g < own) smaller = std::max(smaller, g);
        if (g > own && (larger == 0.0f || g < larger)) larger = g;
    }
    constexpr float kStep_m = 0.08f;  // from letter to letter (EN 13402-3)
    const float down = smaller > 0.0f ? own - smaller : larger > 0.0f ? larger - own : kStep_m;
    const float up = larger > 0.0f ? larger - own : down;
    if (fit.body_m > own + 0.5f * up) return Fit::tight;
    return fit.body_m < own - 0.5f * down ? Fit::loose : Fit::right;
}

float needed_strain(std::span<const GirthFit> fits, const GirthFit** at) {
    float most = 0.0f;
    if (at) *at = nullptr;
    for (const GirthFit& fit : fits) {
        const float strain = fit.body_m / fit.garment_m - 1.0f;
        if (fit.opening_m > 0.0f || strain <= most) continue;
        most = strain;
        if (at) *at = &fit;
    }
    return most;
}

Opening tightest_opening(const WornGarment& garment, std::span<const uint8_t> counts) {
    Opening tightest;
    for (const std::vector<uint32_t>& line : border_lines(garment.indices)) {
        Opening opening;
        float worn_m = 0.0f;
        for (const uint32_t corner : line) {
            const uint32_t a = garment.indices[corner], b = garment.indices[next_corner(corner)];
            opening.middle += garment.positions[a] / float(line.size());
            if (!counts[a] && !counts[b]) continue;
            opening.garment_m += glm::length(garment.cut[next_corner(corner)] - garment.cut[corner]);
            worn_m += glm::length(garment.positions[b] - garment.positions[a]);
        }
        if (opening.garment_m > 0.0f) opening.strain = worn_m / opening.garment_m - 1.0f;
        if (opening.strain > tightest.strain) tightest = opening;
    }
    return tightest;
}

float most_strained(std::span<const float> strain) {
    std::vector<float> sorted(strain.begin(), strain.end());
    if (sorted.empty()) return 0.0f;
    const auto at = sorted.begin() + std::ptrdiff_t(sorted.size() * 9 / 10);
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
}

std::vector<float> tightness_of(const WornGarment& garment, std::span<const float> strain, float most_strain, const MeshQuery& skin) {
    constexpr float kFirm_pa = 2000.0f, kLoose_m = 0.06f, kTouches_m = 0.008f;
    std::vector<float> out;
    for (size_t v = 0; v < garment.positions.size(); ++v) {
        const float gap = skin.closest(garment.positions[v]).distance;
        float tight = strain[v] / most_strain;
        if (!garment.pressure_pa.empty()) tight = std::max(tight, garment.pressure_pa[v] / kFirm_pa);
        // Cloth that hangs is stretched by its own weight, which presses on nobody.
        out.push_back(gap > kTouches_m ? -std::min(1.0f, (gap - kTouches_m) / kLoose_m) : std::clamp(tight, 0.0f, 1.0f));
    }
    return out;
}

}  // namespace vfit
