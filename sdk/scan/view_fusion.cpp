#include "scan/view_fusion.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/wipe.h"
#include "math/types.h"

namespace vfit {

namespace {

constexpr int kRounds = 12;
constexpr int kStill = 3;  // of them; the views stay where body fitting puts them
constexpr float kStart_m = 0.14f;
// What a reading and an outline are off by; a reading's error lies along its line of sight.
constexpr float kReading_m = 0.006f, kAcross_m = 0.003f, kOutline_m = 0.004f;
constexpr float kGrazing = 0.35f;   // cosine to the line of sight: readings of steeper surfaces do not count
constexpr float kStray_m = 0.015f;  // residuals from there on count ever less (Cauchy)
// How far body fitting may place a view off the others: across and towards the camera, turned, and leaning
// (metres from hips to neck).
constexpr float kShift_m = 0.02f, kTurn_rad = 0.06f, kLean_m = 0.02f;
constexpr float kMiddle = 0.3f;  // of the spine: leaning is about there
// A radius apart from the middle between its neighbours: far less than what readings say, but an outline
// alone does not make a spike where the views are few.
constexpr float kApart_m = 0.01f;
constexpr float kApartWeight = 1.0f / (kApart_m * kApart_m);
constexpr float kThinnest_m = 0.03f, kWidest_m = 0.40f;  // radii
constexpr float kOutlineWeight = 3.0f;
constexpr int kUnknowns = 5;

struct Reading {
    float across, towards;
    int level;
};

/// Of a view, beside what body fitting says: across, towards the camera, turned, leaning in both.
using Pose = std::array<float, kUnknowns>;

/// A view with its pose.
class Seen {
public:
    explicit Seen(const TrunkView& of) : view(&of) {
        for (int l = 0; l < TrunkView::kLevels; ++l)
            for (int c = 0; c < TrunkView::kColumns; ++c)
                if (const float towards = view->towards_m[size_t(l)][size_t(c)]; !std::isnan(towards))
                    readings.push_back({TrunkView::across_m(c), towards, l});
    }
    float facing() const { return view->facing_rad + pose[2]; }
    Vec2 place(int level, float across, float towards) const {
        const float lean = TrunkProfile::along(level) - kMiddle;
        return {across + pose[0] + pose[3] * lean, towards + pose[1] + pose[4] * lean};
    }

    const TrunkView* view;
    std::vector<Reading> readings;
    Pose pose{};
};

/// Where a direction lies between those of the sections.
struct Between {
    explicit Between(float direction) {
        float turned = direction / TrunkSection::kStep_rad;
        turned -= std::floor(turned / float(TrunkSection::kDirections)) * float(TrunkSection::kDirections);
        a = size_t(turned) % TrunkSection::kDirections, b = (a + 1) % TrunkSection::kDirections;
        part = turned - std::floor(turned);
    }
    size_t a, b;
    float part;
};

/// Unit, outwards, in the person's axes.
std::array<Vec2, TrunkSection::kDirections> normals_of(const TrunkSection& section) {
    constexpr size_t kAll = TrunkSection::kDirections;
    std::array<Vec2, kAll> out;
    for (size_t d = 0; d < kAll; ++d) {
        const Vec2 way = section.point((d + 1) % kAll) - section.point((d + kAll - 1) % kAll);
        out[d] = glm::normalize(Vec2(-way.y, way.x));
    }
    return out;
}

/// Of the hull in a direction: how far it reaches, how far aside of there it is touched, and where.
struct Touch {
    Touch(const std::array<Vec2, TrunkSection::kDirections>& points, float direction) {
        const Vec2 way(std::sin(direction), std::cos(direction));
        for (size_t d = 0; d < points.size(); ++d) {
            const Vec2& p = points[d];
            if (const float reach = glm::dot(p, way); reach > support)
                support = reach, aside = p.x * way.y - p.y * way.x, point = p, at = d;
        }
    }
    float support = -1.0f, aside = 0.0f;
    Vec2 point{0.0f};
    size_t at = 0;
};

/// The radius of the straight line from one radius to another, so many directions before and after it.
float straight(float a, float b, size_t before, size_t after) {
    const float from = float(before) * TrunkSection::kStep_rad, to = float(after) * TrunkSection::kStep_rad;
    return a * b * std::sin(from + to) / (a * std::sin(from) + b * std::sin(to));
}

/// What no view shows lies on the straight line between what is seen to both sides: a curve would carry
/// outlines that touch nothing.
void bridge(TrunkSection& section, const std::array<bool, TrunkSection::kDirections>& seen) {
    constexpr size_t kAll = TrunkSection::kDirections;
    for (size_t d = 0; d < kAll; ++d) {
        if (seen[d]) continue;
        size_t before = 1, after = 1;
        while (before < kAll && !seen[(d + kAll - before) % kAll]) ++before;
        while (after < kAll && !seen[(d + after) % kAll]) ++after;
        if (before == kAll) return;
        const float a = section.radii_m[(d + kAll - before) % kAll], b = section.radii_m[(d + after) % kAll];
        section.radii_m[d] = before + after < kAll / 2
                                 ? straight(a, b, before, after)
                                 : std::lerp(a, b, float(before) / float(before + after));
    }
}

/// Solves a x = b in place of b by Cholesky's decomposition; a is positive definite, n rows of which the
/// lower triangle counts.
void solve(std::vector<double>& a, std::vector<double>& b) {
    constexpr double kSmallestPivot = 1.0;  // of rounding: what holds the poses is 270 and more
    const size_t n = b.size();
    for (size_t i = 0; i < n; ++i) {
        double* row = &a[i * n];
        for (size_t j = 0; j <= i; ++j) {
            const double* other = &a[j * n];
            double sum = row[j];
            for (size_t k = 0; k < j; ++k) sum -= row[k] * other[k];
            row[j] = i == j ? std::sqrt(std::max(sum, kSmallestPivot)) : sum / other[j];
        }
    }
    for (size_t i = 0; i < n; ++i) {
        for (size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
        b[i] /= a[i * n + i];
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
        b[i] /= a[i * n + i];
    }
}

/// Poses of all views and radii of all sections together, by Gauss and Newton's method. The radii are
/// eliminated from the normal equations (Schur's complement; Triggs, McLauchlan, Hartley and Fitzgibbon 2000,
/// section 6.1): each one hangs on the poses alone.
class Fusion {
public:
    Fusion(const std::vector<TrunkView>& views, TrunkSections& sections) : sections_(sections) {
        for (const TrunkView& view : views) seen_.emplace_back(view);
        cells_.resize(seen_.size() * kCells);
        for (TrunkSection& section : sections_) section.radii_m.fill(kStart_m);
    }

    /// Overwrites what it knows of the body.
    ~Fusion() {
        for (Seen& s : seen_) wipe(std::span(s.readings));
        wipe(std::span(cells_)), wipe(points_), wipe(apart_);
    }
    Fusion(const Fusion&) = delete;
    Fusion& operator=(const Fusion&) = delete;

    void run() {
        for (int round = 0; round < kRounds; ++round) {
            const bool shaped = round > 0;
            for (size_t l = 0; l < sections_.size(); ++l) {
                normals_[l] = normals_of(sections_[l]);
                for (size_t d = 0; d < points_[l].size(); ++d) points_[l][d] = sections_[l].point(d);
            }
            std::fill(cells_.begin(), cells_.end(), Cell{});
            equations_.assign(seen_.size(), {});
            for (size_t i = 0; i < seen_.size(); ++i) {
                see_surface(i, shaped);
                if (shaped) see_outline(i);
            }
            look_at_neighbours(shaped);
            if (round >= kStill) move();
            for (size_t l = 0; l < sections_.size(); ++l) shape(l, round + 1 == kRounds);
        }
    }

private:
    static constexpr size_t kCells = size_t(TrunkView::kLevels) * TrunkSection::kDirections;

    /// What a view says of a radius: sums over its readings there.
    struct Cell {
        float weight = 0.0f, off = 0.0f;
        Pose slope{};  // of off, by the view's pose
    };
    /// What a view says of its own pose.
    struct Equations {
        std::array<std::array<double, kUnknowns>, kUnknowns> a{};
        std::array<double, kUnknowns> b{};
    };

    static float trust(float off) { return 1.0f / (1.0f + off * off / (kStray_m * kStray_m)); }

    void add(size_t view, size_t cell, const Pose& slope, float off, float weight) {
        Equations& equations = equations_[view];
        Cell& c = cells_[view * kCells + cell];
        c.weight += weight, c.off += weight * off;
        for (size_t i = 0; i < kUnknowns; ++i) {
            c.slope[i] += weight * slope[i];
            for (size_t j = 0; j <= i; ++j) equations.a[i][j] += double(weight * slope[i] * slope[j]);
            equations.b[i] += double(weight * slope[i] * off);
        }
    }

    void see_surface(size_t view, bool shaped) {
        const Seen& s = seen_[view];
        const float facing = s.facing(), c = std::cos(facing), si = std::sin(facing);
        for (const Reading& reading : s.readings) {
            const size_t l = size_t(reading.level);
            const Vec2 p = s.place(reading.level, reading.across, reading.towards);
            const float r = glm::length(p);
            const Between at(std::atan2(p.x, p.y) - facing);
            const Vec2 out = Vec2(p.x * c - p.y * si, p.y * c + p.x * si) / r;  // in the person's axes
            const Vec2 n =
                shaped ? glm::normalize(glm::mix(normals_[l][at.a], normals_[l][at.b], at.part)) : out;
            const float across = n.x * c + n.y * si, towards = n.y * c - n.x * si, upright = glm::dot(n, out);
            if (!(towards >= kGrazing && upright >= kGrazing)) continue;
            // Along the radius; what it is off by along the normal is less.
            const auto& radii = sections_[l].radii_m;
            const float off = r - std::lerp(radii[at.a], radii[at.b], at.part);
            const float weight =
                (shaped ? trust(off * upright) : 1.0f) * upright * upright /
                (kReading_m * kReading_m * towards * towards + kAcross_m * kAcross_m * across * across);
            // Turning the view further carries the reading the other way round the person.
            const float turning = r * (n.y * out.x - n.x * out.y),
                        lean = TrunkProfile::along(reading.level) - kMiddle;
            const Pose slope = {across / upright, towards / upright, turning / upright,
                                across * lean / upright, towards * lean / upright};
            add(view, l * TrunkSection::kDirections + (at.part < 0.5f ? at.a : at.b), slope, off, weight);
        }
    }

    void see_outline(size_t view) {
        const Seen& s = seen_[view];
        for (int l = 0; l < TrunkView::kLevels; ++l) {
            const Vec2 shift = s.place(l, 0.0f, 0.0f);
            const float lean = TrunkProfile::along(l) - kMiddle;
            for (int side = 0; side < TrunkView::kSides; ++side) {
                const float reach = s.view->reach_m[size_t(l)][size_t(side)];
                if (std::isnan(reach)) continue;
                // Square to the line of sight, from the direction of the camera.
                const float square = (0.5f * kPi - s.view->aside_rad[size_t(l)][size_t(side)]) *
                                     (side == TrunkView::kRightOfPicture ? 1.0f : -1.0f);
                const Touch touch(points_[size_t(l)], square - s.facing());
                const Vec2 way(std::sin(square), std::cos(square));
                const float off = reach + s.view->outline_loss_m + glm::dot(shift, way) - touch.support;
                // Along the radius, as the surface's.
                const float upright = std::max(kGrazing, touch.support / glm::length(touch.point));
                const float weight =
                    kOutlineWeight * trust(off) * upright * upright / (kOutline_m * kOutline_m);
                add(view, size_t(l) * TrunkSection::kDirections + touch.at,
                    {way.x / upright, way.y / upright, touch.aside / upright, way.x * lean / upright,
                     way.y * lean / upright},
                    off / upright, weight);
            }
        }
    }

    /// All views, each section where they then say.
    void move() {
        const size_t n = seen_.size() * kUnknowns;
        matrix_.assign(n * n, 0.0), change_.assign(n, 0.0);
        constexpr Pose kHolds = {kShift_m, kShift_m, kTurn_rad, kLean_m, kLean_m};
        for (size_t v = 0; v < seen_.size(); ++v)
            for (size_t i = 0; i < kUnknowns; ++i) {
                const size_t row = v * kUnknowns + i;
                for (size_t j = 0; j <= i; ++j) matrix_[row * n + v * kUnknowns + j] = equations_[v].a[i][j];
                const double hold = 1.0 / double(kHolds[i] * kHolds[i]);
                matrix_[row * n + row] += hold;
                change_[row] = -equations_[v].b[i] - hold * double(seen_[v].pose[i]);
            }
        std::vector<size_t> of_cell;
        for (size_t cell = 0; cell < kCells; ++cell) {
            of_cell.clear();
            double weight = double(kApartWeight), off = double(kApartWeight * apart_[cell]);
            for (size_t v = 0; v < seen_.size(); ++v)
                if (const Cell& c = cells_[v * kCells + cell]; c.weight > 0.0f)
                    of_cell.push_back(v), weight += double(c.weight), off += double(c.off);
            for (const size_t v : of_cell) {
                const Pose& slope = cells_[v * kCells + cell].slope;
                for (size_t i = 0; i < kUnknowns; ++i) {
                    const double part = double(slope[i]) / weight;
                    double* row = &matrix_[(v * kUnknowns + i) * n];
                    change_[v * kUnknowns + i] += part * off;
                    for (const size_t other : of_cell) {
                        if (other > v) break;
                        const Pose& across = cells_[other * kCells + cell].slope;
                        for (size_t j = 0; j < kUnknowns; ++j)
                            row[other * kUnknowns + j] -= part * double(across[j]);
                    }
                }
            }
        }
        solve(matrix_, change_);
        for (size_t v = 0; v < seen_.size(); ++v)
            for (size_t i = 0; i < kUnknowns; ++i) {
                const float moved = float(change_[v * kUnknowns + i]);
                seen_[v].pose[i] += moved;
                for (size_t cell = 0; cell < kCells; ++cell) {
                    Cell& c = cells_[v * kCells + cell];
                    c.off += c.slope[i] * moved;
                }
            }
    }

    /// How far each radius lies below the middle between its neighbours.
    void look_at_neighbours(bool shaped) {
        constexpr size_t kAll = TrunkSection::kDirections;
        for (size_t l = 0; l < sections_.size(); ++l) {
            const auto& radii = sections_[l].radii_m;
            for (size_t d = 0; d < kAll; ++d)
                apart_[l * kAll + d] =
                    shaped ? 0.5f * (radii[(d + 1) % kAll] + radii[(d + kAll - 1) % kAll]) - radii[d] : 0.0f;
        }
    }

    void shape(size_t level, bool last) {
        auto& radii = sections_[level].radii_m;
        std::array<bool, TrunkSection::kDirections> shown{};
        for (size_t d = 0; d < radii.size(); ++d) {
            const size_t cell = level * TrunkSection::kDirections + d;
            float weight = kApartWeight, off = kApartWeight * apart_[cell];
            for (size_t v = 0; v < seen_.size(); ++v) {
                const Cell& c = cells_[v * kCells + cell];
                shown[d] = shown[d] || c.weight > 0.0f;
                weight += c.weight, off += c.off;
            }
            if (shown[d])
                radii[d] = std::clamp(radii[d] + off / weight, kThinnest_m, kWidest_m);
            else if (last)
                radii[d] = std::nanf("");
        }
        if (!last) bridge(sections_[level], shown);
    }

    TrunkSections& sections_;
    std::array<std::array<Vec2, TrunkSection::kDirections>, size_t(TrunkView::kLevels)> normals_{}, points_{};
    std::vector<Seen> seen_;
    std::vector<Cell> cells_;  // of each view all
    std::array<float, kCells> apart_{};
    std::vector<Equations> equations_;
    std::vector<double> matrix_, change_;
};

}  // namespace

void fuse_views(const std::vector<TrunkView>& views, TrunkSections& sections) {
    Fusion(views, sections).run();
}

}  // namespace vfit
