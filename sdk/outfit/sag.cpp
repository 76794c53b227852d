#include "outfit/sag.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

/// A symmetric matrix of one row a vertex, by the pairs that are not zero.
class Laplacian {
public:
    explicit Laplacian(size_t rows) : diagonal_(rows, 0.0f) {}
    void add(uint32_t i, uint32_t j, float value) {
        if (i == j)
            diagonal_[i] += value;
        else
            pairs_.push_back({i, j, value});
    }
    const std::vector<float>& diagonal() const { return diagonal_; }
    void times(const std::vector<float>& x, std::vector<float>& out) const {
        for (size_t i = 0; i < x.size(); ++i) out[i] = diagonal_[i] * x[i];
        for (const Pair& p : pairs_) out[p.i] += p.value * x[p.j], out[p.j] += p.value * x[p.i];
    }

private:
    struct Pair {
        uint32_t i, j;
        float value;
    };
    std::vector<float> diagonal_;
    std::vector<Pair> pairs_;
};

double dot(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i) sum += double(a[i]) * double(b[i]);
    return sum;
}

/// By conjugate gradients, preconditioned with the diagonal; unknown: those that may differ from 0.
std::vector<float> solve(const Laplacian& matrix, std::vector<float> right,
                         std::span<const uint8_t> unknown) {
    constexpr int kRounds = 400;
    constexpr double kClose = 1e-8;  // of the square of what is left
    const size_t n = right.size();
    std::vector<float> x(n, 0.0f), scaled(n), way(n, 0.0f), product(n);
    const auto mask = [&](std::vector<float>& v) {
        for (size_t i = 0; i < n; ++i)
            if (!unknown[i]) v[i] = 0.0f;
    };
    mask(right);
    double before = 0.0, first = 0.0;
    for (int round = 0; round < kRounds; ++round) {
        for (size_t i = 0; i < n; ++i)
            scaled[i] = matrix.diagonal()[i] > 0.0f ? right[i] / matrix.diagonal()[i] : 0.0f;
        const double left = dot(right, scaled);
        if (round == 0) first = left;
        if (left <= kClose * first) break;
        const auto keep = float(round == 0 ? 0.0 : left / before);
        for (size_t i = 0; i < n; ++i) way[i] = scaled[i] + keep * way[i];
        matrix.times(way, product);
        mask(product);
        const double curved = dot(way, product);
        if (curved <= 0.0) break;
        const auto step = float(left / curved);
        for (size_t i = 0; i < n; ++i) x[i] += step * way[i], right[i] -= step * product[i];
        before = left;
    }
    return x;
}

/// A triangle laid flat: by how much a value at each corner changes the gradient of what lies between them.
struct FlatTriangle {
    float area_m2;
    Vec2 gradient[3];

    explicit FlatTriangle(const Vec2* corner) {
        const float twice = (corner[1].x - corner[0].x) * (corner[2].y - corner[0].y) -
                            (corner[1].y - corner[0].y) * (corner[2].x - corner[0].x);
        area_m2 = 0.5f * std::abs(twice);
        for (size_t k = 0; k < 3; ++k) {
            const Vec2 side = corner[(k + 2) % 3] - corner[(k + 1) % 3];
            gradient[k] = Vec2(-side.y, side.x) / twice;
        }
    }
};

/// The most that its own weight stretches a garment by, at any height. In a sub-step h, gravity moves what
/// hangs on an edge by g h^2 and the edge gives back as much, shared by inverse masses: with the area A
/// below, the width W there and edges of the length a, the strain is 2 g h^2 A / (W a^2); the threads' own
/// compliance (XPBD) is far less.
class WeightStrain {
public:
    WeightStrain(const UnposedGarment& g, const Sagging& sagging) {
        lowest_m_ = INFINITY;
        for (const Vec3& p : g.positions) lowest_m_ = std::min(lowest_m_, p.y);
        std::vector<float> areas(kBands, 0.0f);
        float whole = 0.0f;
        for (size_t i = 0; i + 2 < g.indices.size(); i += 3) {
            const float area = FlatTriangle(&g.cut[i]).area_m2;
            areas[band_of((g.positions[g.indices[i]].y + g.positions[g.indices[i + 1]].y +
                           g.positions[g.indices[i + 2]].y) /
                          3.0f)] += area;
            whole += area;
        }
        const float side2 = whole / float(std::max<size_t>(g.indices.size() / 3, 1)) * 4.0f / std::sqrt(3.0f);
        float below = 0.0f;
        for (const float area : areas) {
            below += area;
            strains_.push_back(area > 0.0f ? 2.0f * sagging.gravity_m_s2 * sagging.substep_s *
                                                 sagging.substep_s * below * kBand_m / (area * side2)
                                           : 0.0f);
        }
    }
    float at(float height_m) const { return strains_[band_of(height_m)]; }

private:
    static constexpr float kBand_m = 0.03f;
    static constexpr size_t kBands = 100;  // 3 m: the last goes on
    size_t band_of(float height_m) const {
        const float band = (height_m - lowest_m_) / kBand_m;
        return band > 0.0f ? size_t(std::min(band, float(kBands - 1))) : 0;
    }

    float lowest_m_;
    std::vector<float> strains_;
};

}  // namespace

std::vector<Vec3> without_sag(const UnposedGarment& g, std::span<const uint8_t> simulated,
                              const Sagging& sagging) {
    // The slope of the height in flat cloth, without the stretch along it; then the heights with that slope
    // (Poisson's equation).
    const size_t n = g.positions.size();
    std::vector<Vec3> out(g.positions.begin(), g.positions.end());
    if (std::all_of(simulated.begin(), simulated.end(), [](uint8_t s) { return s != 0; }))
        return out;  // it hangs on nothing
    const WeightStrain weight(g, sagging);
    Laplacian matrix(n);
    std::vector<float> right(n, 0.0f);
    for (size_t i = 0; i + 2 < g.indices.size(); i += 3) {
        const FlatTriangle flat(&g.cut[i]);
        if (flat.area_m2 <= 0.0f) continue;
        const uint32_t* v = &g.indices[i];
        Vec2 slope(0.0f);
        for (size_t k = 0; k < 3; ++k) slope += g.positions[v[k]].y * flat.gradient[k];
        const float steep = glm::length(slope);
        if (steep <= 0.0f) continue;
        const Vec2 down = slope / steep;
        Vec3 along(0.0f);  // that direction in the worn cloth: as long as it is stretched
        for (size_t k = 0; k < 3; ++k) along += g.positions[v[k]] * glm::dot(flat.gradient[k], down);
        const float stretch = glm::length(along), most = weight.at(g.positions[v[0]].y);
        const Vec2 missing = slope * (-std::clamp(stretch - 1.0f, -most, most) / stretch);
        for (size_t k = 0; k < 3; ++k) {
            right[v[k]] += flat.area_m2 * glm::dot(flat.gradient[k], missing);
            for (size_t j = k; j < 3; ++j)
                matrix.add(v[k], v[j], flat.area_m2 * glm::dot(flat.gradient[k], flat.gradient[j]));
        }
    }
    const std::vector<float> raise = solve(matrix, std::move(right), simulated);
    for (size_t i = 0; i < n; ++i) out[i].y += raise[i];
    return out;
}

}  // namespace vfit
