#include "outfit/garment_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "cloth/garment/borders.h"

namespace vfit {

namespace {

/// Where a plane crosses two sides of a triangle: the corners of each, and the share of the way from the
/// first to the second.
struct CrossedSides {
    uint32_t from[2], to[2];  // of indices
    float share[2];
};

/// calls(sides) for each triangle that the plane crosses. above(vertex): how far it is beyond the plane.
template <typename Above, typename Call>
void for_crossed(std::span<const uint32_t> indices, Above&& above, Call&& call) {
    for (uint32_t i = 0; i + 2 < indices.size(); i += 3) {
        CrossedSides sides;
        int count = 0;
        for (uint32_t corner = i; corner < i + 3 && count < 2; ++corner) {
            const uint32_t next = next_corner(corner);
            const float a = above(indices[corner]), b = above(indices[next]);
            if ((a < 0.0f) == (b < 0.0f)) continue;
            sides.from[count] = corner, sides.to[count] = next, sides.share[count] = a / (a - b);
            ++count;
        }
        if (count == 2) call(sides);
    }
}

/// The line that the crossed sides make in a triangle, with one place an index.
template <typename Place>
auto across(const CrossedSides& sides, Place&& place) {
    const auto at = [&](int end) {
        return glm::mix(place(sides.from[end]), place(sides.to[end]), sides.share[end]);
    };
    return std::pair(at(0), at(1));
}

using Edge = std::pair<uint32_t, uint32_t>;

/// What a level cuts of one triangle: from side to side.
struct CutPiece {
    Edge edge[2];
    Vec2 flat[2];
    bool taken = false;
};

/// What a level's plane cuts of the garment.
struct Cut {
    std::vector<CutPiece> pieces;
    float cut_m = 0.0f, worn_m = 0.0f;  // along all its folds, in flat cloth and as it is worn
    float around_rad = 0.0f;
    // Ends of the line at the garment's borders.
    std::vector<Vec3> ends;
};

/// The pieces in a row, as a line in flat cloth. A seam, where two panels meet, ends it.
class FlatLines {
public:
    explicit FlatLines(std::vector<CutPiece>& pieces) : pieces_(pieces) {
        for (uint32_t i = 0; i < pieces.size(); ++i)
            for (const Edge& edge : pieces[i].edge) at_[edge].push_back(i);
    }
    /// Calls with each line's places.
    template <typename Call>
    void each(Call&& call) {
        std::vector<Vec2> line;
        for (CutPiece& piece : pieces_) {
            if (piece.taken) continue;
            piece.taken = true;
            line.assign({piece.flat[1], piece.flat[0]});
            follow(piece.edge[0], line);
            std::reverse(line.begin(), line.end());
            follow(piece.edge[1], line);
            call(line);
        }
    }

private:
    void follow(Edge edge, std::vector<Vec2>& line) {
        constexpr float kSame_m = 1e-4f;
        for (bool goes_on = true; goes_on;) {
            goes_on = false;
            for (const uint32_t i : at_[edge]) {
                CutPiece& next = pieces_[i];
                if (next.taken) continue;
                const int from = next.edge[0] == edge ? 0 : 1;
                if (glm::length(next.flat[from] - line.back()) > kSame_m) continue;  // another panel
                next.taken = goes_on = true;
                line.push_back(next.flat[1 - from]);
                edge = next.edge[1 - from];
                break;
            }
        }
    }

    std::vector<CutPiece>& pieces_;
    std::map<Edge, std::vector<uint32_t>> at_;
};

/// As a tape would lie on the flat garment: where the cloth hangs in folds, a level runs up and down in it,
/// on ways of some centimetres; those are evened out. A piece that is cut round stays round.
float taped_length(const std::vector<Vec2>& line) {
    constexpr float kStep_m = 0.01f;
    constexpr int kRounds = 60;  // half way to the mean of the two beside: of a wave of 10 cm nothing stays,
                                 // of 20 cm a fourth, of 50 cm four fifths
    float length = 0.0f;
    for (size_t i = 1; i < line.size(); ++i) length += glm::length(line[i] - line[i - 1]);
    const auto steps = size_t(std::ceil(length / kStep_m));
    std::vector<Vec2> even{line.front()};
    float left = length / float(std::max<size_t>(steps, 1));
    const float step = left;
    for (size_t i = 1; i < line.size(); ++i) {
        Vec2 from = line[i - 1];
        for (float way = glm::length(line[i] - from); way >= left; way = glm::length(line[i] - from)) {
            from += (line[i] - from) * (left / way);
            if (even.size() < steps) even.push_back(from);
            left = step;
        }
        left -= glm::length(line[i] - from);
    }
    even.push_back(line.back());
    std::vector<Vec2> next = even;
    for (int round = 0; round < kRounds; ++round) {
        for (size_t i = 1; i + 1 < even.size(); ++i)
            next[i] = 0.5f * even[i] + 0.25f * (even[i - 1] + even[i + 1]);
        std::swap(even, next);
    }
    float taped = 0.0f;
    for (size_t i = 1; i < even.size(); ++i) taped += glm::length(even[i] - even[i - 1]);
    return taped;
}

Cut cut_at(const UnposedGarment& g, const GirthLevel& level) {
    Cut out;
    std::vector<std::pair<Edge, Vec3>> crossed;  // once for each of its triangles, and where
    for_crossed(
        g.indices, [&](uint32_t v) { return g.positions[v].y - level.height_m; },
        [&](const CrossedSides& sides) {
            const uint32_t* v = &g.indices[sides.from[0] - sides.from[0] % 3];
            if (!g.on_arm.empty() && (g.on_arm[v[0]] || g.on_arm[v[1]] || g.on_arm[v[2]]))
                return;  // of a sleeve
            const auto flat = across(sides, [&](uint32_t corner) { return g.cut[corner]; });
            const auto worn = across(sides, [&](uint32_t corner) { return g.positions[g.indices[corner]]; });
            CutPiece piece{{}, {flat.first, flat.second}};
            for (int end = 0; end < 2; ++end) {
                piece.edge[end] = std::minmax(g.indices[sides.from[end]], g.indices[sides.to[end]]);
                crossed.emplace_back(piece.edge[end], end == 0 ? worn.first : worn.second);
            }
            out.pieces.push_back(piece);
            out.cut_m += glm::length(flat.second - flat.first);
            out.worn_m += glm::length(worn.second - worn.first);
            const Vec2 p(worn.first.x, worn.first.z - level.axis_z_m),
                q(worn.second.x, worn.second.z - level.axis_z_m);
            out.around_rad += std::abs(std::atan2(p.x * q.y - p.y * q.x, glm::dot(p, q)));
        });
    std::sort(crossed.begin(), crossed.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    for (size_t i = 0; i < crossed.size(); ++i) {
        const bool alone = (i == 0 || crossed[i - 1].first != crossed[i].first) &&
                           (i + 1 == crossed.size() || crossed[i + 1].first != crossed[i].first);
        if (alone) out.ends.push_back(crossed[i].second);
    }
    return out;
}

/// In flat cloth, as a tape lies.
float taped_length(Cut& cut) {
    float taped = 0.0f;
    FlatLines(cut.pieces).each([&](const std::vector<Vec2>& line) { taped += taped_length(line); });
    return taped;
}

/// Across the opening of a coat: between its two ends, where there are just two.
float opening_of(const Cut& cut) {
    return cut.ends.size() == 2 ? glm::length(cut.ends[0] - cut.ends[1]) : 0.0f;
}

/// Armholes open it at a side, a coat's fronts in the middle.
bool is_through_armhole(const Cut& cut, float axis_z_m) {
    if (cut.ends.size() != 2) return !cut.ends.empty();
    const Vec3 middle = 0.5f * (cut.ends[0] + cut.ends[1]);
    return std::abs(middle.x) > std::abs(middle.z - axis_z_m);
}

}  // namespace

std::vector<GirthFit> fit_of(const UnposedGarment& garment, std::span<const GirthLevel> levels) {
    constexpr float kMostOfTheWay_rad = 1.5f * kPi, kNear_m = 0.02f;
    std::vector<GirthFit> out;
    for (GirthLevel level : levels) {
        // Where an armhole reaches below the body's level, the garment's own is below the armhole.
        constexpr float kStep_m = 0.01f, kLowest_m = 0.09f;
        Cut cut = cut_at(garment, level);
        for (float down = kStep_m; is_through_armhole(cut, level.axis_z_m) && down <= kLowest_m;
             down += kStep_m) {
            level.height_m -= kStep_m;
            cut = cut_at(garment, level);
        }
        if (cut.around_rad < kMostOfTheWay_rad || is_through_armhole(cut, level.axis_z_m)) continue;
        // Cloth below, too: else the gap is no open front but a hem that swings about that level.
        constexpr float kBelow_m = 0.03f;
        if (!cut.ends.empty() &&
            cut_at(garment, {level.key, level.height_m - kBelow_m, level.body_m, level.axis_z_m}).around_rad <
                kMostOfTheWay_rad)
            continue;
        GirthFit fit;
        fit.key = level.key;
        fit.body_m = level.body_m;
        fit.opening_m = opening_of(cut);
        fit.garment_m = taped_length(cut);
        fit.ease_m = fit.garment_m - fit.body_m;
        fit.strain = cut.worn_m / cut.cut_m - 1.0f;
        if (!garment.pressure_pa.empty()) {
            float sum = 0.0f;
            int count = 0;
            for (size_t v = 0; v < garment.positions.size(); ++v) {
                if (std::abs(garment.positions[v].y - level.height_m) > kNear_m ||
                    (!garment.on_arm.empty() && garment.on_arm[v]))
                    continue;
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
    constexpr float kPresses_pa = 2000.0f;  // where tightness is 1 (tightness_of)
    if (fit.pressure_pa > kPresses_pa) return Fit::tight;
    if (own <= 0.0f) {
        constexpr float kTight = 0.03f, kLoose_m = 0.12f;
        if (fit.opening_m == 0.0f && (fit.strain > kTight || fit.ease_m < -kTight * fit.body_m))
            return Fit::tight;
        return fit.ease_m > kLoose_m ? Fit::loose : Fit::right;
    }
    // A half of the step to the next size; at the ends of the table, and of a single size, of the step on the
    // other side.
    float smaller = 0.0f, larger = 0.0f;
    for (const float g : girths) {
        if (g > 0.0f && g < own) smaller = std::max(smaller, g);
        if (g > own && (larger == 0.0f || g < larger)) larger = g;
    }
    constexpr float kStep_m = 0.08f;  // from letter to letter (EN 13402-3)
    const float down = smaller > 0.0f ? own - smaller : larger > 0.0f ? larger - own : kStep_m;
    const float up = larger > 0.0f ? larger - own : down;
    // A coat of the next smaller size that leaves 20 cm is not tight, and leggings of the next larger one
    // that are stretched are not loose.
    constexpr float kWearing_m = 0.05f;  // of a girth, which breathing and sitting take
    if (fit.body_m > own + 0.5f * up && fit.ease_m < kWearing_m) return Fit::tight;
    return fit.body_m < own - 0.5f * down && fit.ease_m > kWearing_m ? Fit::loose : Fit::right;
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

Opening tightest_opening(const UnposedGarment& garment, std::span<const uint8_t> counts) {
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

CrotchLine crotch_line(const UnposedGarment& garment, std::span<const Vec3> now) {
    CrotchLine out;
    float worn_m = 0.0f;
    std::map<Edge, int> crossed;
    for_crossed(
        garment.indices, [&](uint32_t v) { return garment.positions[v].x; },
        [&](const CrossedSides& sides) {
            for (int end = 0; end < 2; ++end)
                ++crossed[std::minmax(garment.indices[sides.from[end]], garment.indices[sides.to[end]])];
            const auto flat = across(sides, [&](uint32_t corner) { return garment.cut[corner]; });
            const auto worn = across(sides, [&](uint32_t corner) { return now[garment.indices[corner]]; });
            out.garment_m += glm::length(flat.second - flat.first);
            worn_m += glm::length(worn.second - worn.first);
        });
    // One line that goes down and up again. Of what ends in a hem there are two; of a coat one, behind, which
    // ends at its lowest.
    constexpr float kDeep_m = 0.1f;
    float low = INFINITY, end = INFINITY;
    int ends = 0;
    for (const auto& [edge, triangles] : crossed) {
        const float y = garment.positions[edge.first].y;
        low = std::min(low, y);
        if (triangles == 1) ++ends, end = std::min(end, y);
    }
    if (ends != 2 || end < low + kDeep_m) return {};
    out.strain = worn_m / out.garment_m - 1.0f;
    return out;
}

float most_strained(std::span<const float> strain) {
    std::vector<float> sorted(strain.begin(), strain.end());
    if (sorted.empty()) return 0.0f;
    const auto at = sorted.begin() + std::ptrdiff_t(sorted.size() * 9 / 10);
    std::nth_element(sorted.begin(), at, sorted.end());
    return *at;
}

std::vector<float> tightness_of(const UnposedGarment& garment, std::span<const float> strain,
                                float most_strain, const MeshQuery& skin) {
    constexpr float kFirm_pa = 2000.0f, kLoose_m = 0.06f, kTouches_m = 0.008f;
    std::vector<float> out;
    for (size_t v = 0; v < garment.positions.size(); ++v) {
        const float gap = skin.closest(garment.positions[v]).distance;
        float tight = strain[v] / most_strain;
        if (!garment.pressure_pa.empty()) tight = std::max(tight, garment.pressure_pa[v] / kFirm_pa);
        // Cloth that hangs is stretched by its own weight, which presses on nobody.
        out.push_back(gap > kTouches_m ? -std::min(1.0f, (gap - kTouches_m) / kLoose_m)
                                       : std::clamp(tight, 0.0f, 1.0f));
    }
    return out;
}

}  // namespace vfit
