#include "cook/model/even_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "geometry/mesh_query.h"

namespace vfit {

namespace {

using Triangle = std::array<uint32_t, 3>;

/// One piece. Its triangles stay a surface with the same openings: each operation is done only where it does.
class EvenMaker {
public:
    EvenMaker(const std::vector<Vec3>& places, const Piece& piece, float side_m)
        : side_m_(side_m), cloth_(places, piece.indices) {
        std::vector<uint32_t> number(places.size(), UINT32_MAX);
        for (const ModelTriangle& t : piece.triangles) {
            Triangle triangle;
            for (size_t k = 0; k < 3; ++k) {
                uint32_t& n = number[t.vertex[k]];
                if (n == UINT32_MAX) n = add(places[t.vertex[k]]);
                triangle[k] = n;
            }
            add(triangle);
        }
    }

    void run() {
        for (int round = 0; round < kRounds; ++round) {
            while (split_long() > 0) {
            }
            for (int sweep = 0; sweep < kSweeps && collapse_short() > 0; ++sweep) {
            }
            for (int sweep = 0; sweep < kSweeps && flip() > 0; ++sweep) {
            }
            relax();
        }
    }

    /// Appends what is left.
    void write(std::vector<Vec3>& places, std::vector<Triangle>& triangles) const {
        std::vector<uint32_t> number(places_.size(), UINT32_MAX);
        for (const Triangle& t : triangles_) {
            if (is_gone(t)) continue;
            Triangle out;
            for (size_t k = 0; k < 3; ++k) {
                uint32_t& n = number[t[k]];
                if (n == UINT32_MAX) n = uint32_t(places.size()), places.push_back(places_[t[k]]);
                out[k] = n;
            }
            triangles.push_back(out);
        }
    }

private:
    static constexpr int kRounds = 6, kSweeps = 12;
    static constexpr float kLong = 4.0f / 3.0f, kShort = 4.0f / 5.0f;  // of the side, as in the paper
    static constexpr uint32_t kGone = UINT32_MAX;

    uint32_t add(const Vec3& place) {
        places_.push_back(place);
        around_.emplace_back();
        return uint32_t(places_.size() - 1);
    }
    void add(const Triangle& triangle) {
        for (const uint32_t v : triangle) around_[v].push_back(uint32_t(triangles_.size()));
        triangles_.push_back(triangle);
    }
    static bool is_gone(const Triangle& t) { return t[0] == kGone; }
    void remove(uint32_t t) {
        for (const uint32_t v : triangles_[t]) std::erase(around_[v], t);
        triangles_[t][0] = kGone;
    }
    void replace(uint32_t t, uint32_t vertex, uint32_t by) {
        for (uint32_t& v : triangles_[t])
            if (v == vertex) v = by;
        std::erase(around_[vertex], t);
        around_[by].push_back(t);
    }

    float length(uint32_t a, uint32_t b) const { return glm::length(places_[a] - places_[b]); }
    static bool has(const Triangle& t, uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }
    static uint32_t third(const Triangle& t, uint32_t a, uint32_t b) {
        for (const uint32_t v : t)
            if (v != a && v != b) return v;
        return kGone;
    }
    Vec3 across(const Triangle& t) const {
        return glm::cross(places_[t[1]] - places_[t[0]], places_[t[2]] - places_[t[0]]);
    }

    /// One at a border, else two.
    std::vector<uint32_t> beside(uint32_t a, uint32_t b) const {
        std::vector<uint32_t> out;
        for (const uint32_t t : around_[a])
            if (has(triangles_[t], b)) out.push_back(t);
        return out;
    }
    std::vector<uint32_t> neighbours(uint32_t v) const {
        std::vector<uint32_t> out;
        for (const uint32_t t : around_[v])
            for (const uint32_t w : triangles_[t])
                if (w != v) out.push_back(w);
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
        return out;
    }
    /// Of the border through it: the ends of its sides that have one triangle; empty within the sheet.
    std::vector<uint32_t> along_border(uint32_t v) const {
        std::vector<uint32_t> out;
        for (const uint32_t w : neighbours(v))
            if (beside(v, w).size() == 1) out.push_back(w);
        return out;
    }

    using Side = std::array<uint32_t, 2>;
    template <typename Wanted>
    std::vector<Side> sides(const Wanted& wanted) const {
        std::vector<Side> out;
        for (const Triangle& t : triangles_) {
            if (is_gone(t)) continue;
            for (size_t k = 0; k < 3; ++k) {
                const Side side = {std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])};
                if (wanted(side)) out.push_back(side);
            }
        }
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
        return out;
    }

    size_t split_long() {
        std::vector<Side> list = sides([&](const Side& s) { return length(s[0], s[1]) > kLong * side_m_; });
        std::sort(list.begin(), list.end(), [&](const Side& a, const Side& b) {
            const float long_a = length(a[0], a[1]), long_b = length(b[0], b[1]);
            return long_a != long_b ? long_a > long_b : a < b;
        });
        for (const auto& [a, b] : list) {
            const uint32_t middle = add(0.5f * (places_[a] + places_[b]));
            for (const uint32_t t : beside(a, b)) {
                Triangle other = triangles_[t];
                for (uint32_t& v : other)
                    if (v == a) v = middle;
                replace(t, b, middle);
                add(other);
            }
        }
        return list.size();
    }

    size_t collapse_short() {
        size_t done = 0;
        for (const auto& [a, b] : sides([&](const Side& s) { return length(s[0], s[1]) < kShort * side_m_; }))
            if (!around_[a].empty() && !around_[b].empty() && length(a, b) < kShort * side_m_)
                done += collapse(a, b);
        return done;
    }

    bool collapse(uint32_t a, uint32_t b) {
        const std::vector<uint32_t> between = beside(a, b);
        if (between.empty()) return false;  // the side is gone
        const std::vector<uint32_t> of_a = neighbours(a), of_b = neighbours(b);
        std::vector<uint32_t> common;
        std::set_intersection(of_a.begin(), of_a.end(), of_b.begin(), of_b.end(), std::back_inserter(common));
        if (common.size() != between.size()) return false;  // sheets would be pinched
        const bool border_a = !along_border(a).empty(), border_b = !along_border(b).empty();
        if (border_a && border_b && between.size() == 2) return false;  // two borders would meet
        // A border is where it was.
        const Vec3 place = border_a ? places_[a] : border_b ? places_[b] : 0.5f * (places_[a] + places_[b]);
        for (const uint32_t v : {a, b})
            for (const uint32_t t : around_[v])
                if (std::find(between.begin(), between.end(), t) == between.end() && !may_move(t, v, place))
                    return false;
        for (const uint32_t t : between) remove(t);
        for (const uint32_t t : std::vector<uint32_t>(around_[b])) replace(t, b, a);
        places_[a] = place;
        return true;
    }

    /// It does not turn over, and its sides stay short.
    bool may_move(uint32_t t, uint32_t vertex, const Vec3& to) const {
        constexpr float kTurned = 0.5f, kSliver = 1e-3f;  // the sliver's height, of the side
        std::array<Vec3, 3> p;
        float longest = 0.0f;
        for (size_t k = 0; k < 3; ++k) p[k] = triangles_[t][k] == vertex ? to : places_[triangles_[t][k]];
        for (size_t k = 0; k < 3; ++k) longest = std::max(longest, glm::length(p[(k + 1) % 3] - p[k]));
        const Vec3 before = across(triangles_[t]), after = glm::cross(p[1] - p[0], p[2] - p[0]);
        const float was = glm::length(before), is = glm::length(after);
        if (longest > kLong * side_m_ && longest > longest_of(t)) return false;
        if (is < kSliver * side_m_ * longest) return is >= was;
        return was < kSliver * side_m_ * longest || glm::dot(before, after) > kTurned * was * is;
    }
    float longest_of(uint32_t t) const {
        const Triangle& v = triangles_[t];
        return std::max({length(v[0], v[1]), length(v[1], v[2]), length(v[2], v[0])});
    }

    /// Where that makes the smallest of the angles larger (Delaunay's criterion, of the unfolded pair).
    size_t flip() {
        size_t done = 0;
        for (const auto& [a, b] : sides([](const Side&) { return true; })) {
            const std::vector<uint32_t> pair = beside(a, b);
            if (pair.size() != 2) continue;
            const uint32_t c = third(triangles_[pair[0]], a, b), d = third(triangles_[pair[1]], a, b);
            if (c == d || !beside(c, d).empty()) continue;
            if (angle_at(c, a, b) + angle_at(d, a, b) <= kHalfTurn + kSurely) continue;
            // As the first runs along a, b.
            Triangle first = triangles_[pair[0]], second = triangles_[pair[1]];
            const Vec3 before = across(first) + across(second);
            for (uint32_t& v : first)
                if (v == b) v = d;
            for (uint32_t& v : second)
                if (v == a) v = c;
            const Vec3 one = across(first), other = across(second);
            constexpr float kFolded = 0.5f;
            if (glm::dot(one, before) <= kFolded * glm::length(one) * glm::length(before) ||
                glm::dot(other, before) <= kFolded * glm::length(other) * glm::length(before))
                continue;
            replace(pair[0], b, d);
            replace(pair[1], a, c);
            ++done;
        }
        return done;
    }
    static constexpr float kHalfTurn = 3.14159265f, kSurely = 1e-3f;

    float angle_at(uint32_t v, uint32_t a, uint32_t b) const {
        const Vec3 to_a = places_[a] - places_[v], to_b = places_[b] - places_[v];
        return std::atan2(glm::length(glm::cross(to_a, to_b)), glm::dot(to_a, to_b));
    }

    /// Along the sheet to the middle of those around, and back onto the cloth.
    void relax() {
        std::vector<Vec3> to = places_;
        for (uint32_t v = 0; v < places_.size(); ++v) {
            if (around_[v].empty()) continue;
            if (!along_border(v).empty()) continue;
            Vec3 normal(0.0f), middle(0.0f);
            for (const uint32_t t : around_[v]) normal += across(triangles_[t]);
            const std::vector<uint32_t> beside = neighbours(v);
            for (const uint32_t w : beside) middle += places_[w] / float(beside.size());
            const float size = glm::length(normal);
            if (!(size > 0.0f)) continue;
            normal /= size;
            const Vec3 way = middle - places_[v];
            const MeshQuery::Closest on = cloth_.closest(places_[v] + way - glm::dot(way, normal) * normal);
            constexpr float kOtherSheet = 0.5f;
            if (on.distance < kOtherSheet * side_m_ && glm::dot(on.normal, normal) > 0.0f) to[v] = on.point;
        }
        // One after the other: what would turn a triangle over stays.
        for (uint32_t v = 0; v < places_.size(); ++v)
            if (std::all_of(around_[v].begin(), around_[v].end(),
                            [&](uint32_t t) { return may_relax(t, v, to[v]); }))
                places_[v] = to[v];
    }
    bool may_relax(uint32_t t, uint32_t vertex, const Vec3& to) const {
        std::array<Vec3, 3> p;
        for (size_t k = 0; k < 3; ++k) p[k] = triangles_[t][k] == vertex ? to : places_[triangles_[t][k]];
        const Vec3 before = across(triangles_[t]), after = glm::cross(p[1] - p[0], p[2] - p[0]);
        return glm::dot(before, after) > 0.0f;
    }

    const float side_m_;
    const MeshQuery cloth_;
    std::vector<Vec3> places_;
    std::vector<Triangle> triangles_;
    std::vector<std::vector<uint32_t>> around_;  // triangles at each place
};

}  // namespace

Model with_even_triangles(const Pieces& pieces, float side_m) {
    std::vector<Vec3> places;
    std::vector<Triangle> triangles;
    for (const Piece& piece : pieces.list) {
        EvenMaker maker(pieces.places, piece, side_m);
        maker.run();
        maker.write(places, triangles);
    }
    if (triangles.empty())
        fail(VFIT_ERROR_DATA, "nothing is left of the mesh with triangles of ", side_m, " m");
    return model_of(places, triangles, pieces.unit_m, "the sheet with even triangles: triangle ");
}

}  // namespace vfit
