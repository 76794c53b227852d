#include "cook/mesh/triangulation.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <set>

#include "core/error.h"

namespace vfit {

namespace {

using Point = glm::dvec2;
constexpr int kNone = -1;

double turn(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Is d inside the circle through a, b, c (counter-clockwise)?
bool in_circle(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point p = a - d, q = b - d, r = c - d;
    const double det = glm::dot(p, p) * (q.x * r.y - q.y * r.x) - glm::dot(q, q) * (p.x * r.y - p.y * r.x) +
                       glm::dot(r, r) * (p.x * q.y - p.y * q.x);
    constexpr double kSure = 1e-14;  // of coordinates about 1: on the circle is as good as outside
    return det > kSure;
}

class Triangulation {
public:
    Triangulation(std::span<const Vec2> points, uint32_t outline) : outline_(outline) {
        Point low(1e30), high(-1e30);
        for (const Vec2& p : points) low = glm::min(low, Point(p)), high = glm::max(high, Point(p));
        const double size = std::max(high.x - low.x, high.y - low.y);
        if (!(size > 0.0)) fail(VFIT_ERROR_DATA, "the outline has no area");
        // Of size 1 about the origin, as the tests' tolerances expect.
        for (const Vec2& p : points) at_.push_back((Point(p) - 0.5 * (low + high)) / size);
        count_ = uint32_t(at_.size());
        for (const Point& p : {Point(-20, -20), Point(20, -20), Point(0, 30)}) at_.push_back(p);
        cells_.push_back({{count_, count_ + 1, count_ + 2}, {kNone, kNone, kNone}});
        for (uint32_t i = 0; i < count_; ++i) insert(i);
        for (uint32_t i = 0; i < outline_; ++i) recover(i, (i + 1) % outline_);
    }

    Triangles inside() const {
        // The corner triangles about all are outside; each edge of the outline changes the side.
        std::set<std::pair<uint32_t, uint32_t>> line;
        for (uint32_t i = 0; i < outline_; ++i) line.insert(std::minmax(i, (i + 1) % outline_));
        std::vector<int> side(cells_.size(), kNone);
        std::deque<int> open;
        for (int c = 0; c < int(cells_.size()); ++c)
            if (std::any_of(cells_[c].v.begin(), cells_[c].v.end(), [&](uint32_t v) { return v >= count_; }))
                side[c] = 0, open.push_back(c);
        while (!open.empty()) {
            const int c = open.front();
            open.pop_front();
            for (int k = 0; k < 3; ++k) {
                const int n = cells_[c].next[k];
                if (n == kNone || side[n] != kNone) continue;
                side[n] = side[c] ^
                          int(line.count(std::minmax(cells_[c].v[(k + 1) % 3], cells_[c].v[(k + 2) % 3])));
                open.push_back(n);
            }
        }
        Triangles out;
        for (size_t c = 0; c < cells_.size(); ++c)
            if (side[c] == 1) out.push_back(cells_[c].v);
        return out;
    }

private:
    struct Cell {
        std::array<uint32_t, 3> v;  // counter-clockwise
        std::array<int, 3> next;    // over the edge opposite to each
        int corner(uint32_t p) const { return v[0] == p ? 0 : v[1] == p ? 1 : v[2] == p ? 2 : kNone; }
        int edge_to(int cell) const {
            return next[0] == cell ? 0 : next[1] == cell ? 1 : next[2] == cell ? 2 : kNone;
        }
    };

    int locate(const Point& p) const {
        int c = int(cells_.size()) - 1;
        for (size_t step = 0; step <= cells_.size(); ++step) {
            int to = kNone;
            double worst = 0.0;
            for (int k = 0; k < 3; ++k) {
                const double side = turn(at_[cells_[c].v[(k + 1) % 3]], at_[cells_[c].v[(k + 2) % 3]], p);
                if (side < worst && cells_[c].next[k] != kNone) worst = side, to = cells_[c].next[k];
            }
            if (to == kNone) return c;
            c = to;
        }
        return c;  // rounding sent it round in a circle: it is on an edge of this one
    }

    void insert(uint32_t p) {
        const int c = locate(at_[p]);
        const Cell old = cells_[c];
        for (const uint32_t v : old.v)
            if (glm::length(at_[v] - at_[p]) < 1e-9)
                fail(VFIT_ERROR_DATA, "two points of the outline are at the same place");
        const int b = int(cells_.size()), d = b + 1;
        cells_.push_back({{p, old.v[1], old.v[2]}, {old.next[0], d, c}});
        cells_.push_back({{p, old.v[2], old.v[0]}, {old.next[1], c, b}});
        cells_[c] = {{p, old.v[0], old.v[1]}, {old.next[2], b, d}};
        relink(old.next[0], c, b);
        relink(old.next[1], c, d);
        std::vector<int> open{c, b, d};
        where_.resize(at_.size(), 0);
        touch(c), touch(b), touch(d);
        while (!open.empty()) {
            const int t = open.back();
            open.pop_back();
            const int k = cells_[t].corner(p), n = cells_[t].next[k];
            if (n == kNone) continue;
            const uint32_t far = cells_[n].v[cells_[n].edge_to(t)];
            const auto& v = cells_[t].v;
            if (!in_circle(at_[v[0]], at_[v[1]], at_[v[2]], at_[far])) continue;
            flip(t, k);
            open.push_back(t), open.push_back(n);
        }
    }

    void relink(int cell, int from, int to) {
        if (cell != kNone) cells_[cell].next[cells_[cell].edge_to(from)] = to;
    }
    void touch(int cell) {
        for (const uint32_t v : cells_[cell].v) where_[v] = cell;
    }

    /// Exchanges the edge opposite to corner k of t for the other diagonal. Both cells keep their corner off
    /// that edge.
    void flip(int t, int k) {
        const int n = cells_[t].next[k], m = cells_[n].edge_to(t);
        const Cell a = cells_[t], b = cells_[n];
        const uint32_t p = a.v[k], q = a.v[(k + 1) % 3], r = a.v[(k + 2) % 3], s = b.v[m];
        const int pq = a.next[(k + 2) % 3], rp = a.next[(k + 1) % 3];
        const int qs = b.next[b.corner(r)], sr = b.next[b.corner(q)];
        cells_[t] = {{p, q, s}, {qs, n, pq}};
        cells_[n] = {{p, s, r}, {sr, rp, t}};
        relink(qs, n, t);
        relink(rp, t, n);
        touch(t), touch(n);
    }

    /// All cells about a point, as long as `each` says true.
    template <typename Each>
    void around(uint32_t p, Each&& each) const {
        const int first = where_[p];
        int c = first;
        do {
            if (!each(c)) return;
            c = cells_[c].next[(cells_[c].corner(p) + 1) % 3];
        } while (c != kNone && c != first);
    }

    bool joined(uint32_t a, uint32_t b) const {
        bool found = false;
        around(a, [&](int c) { return !(found = cells_[c].corner(b) != kNone); });
        return found;
    }

    bool crosses(uint32_t a, uint32_t b, uint32_t u, uint32_t v) const {
        if (u == a || u == b || v == a || v == b) return false;
        return turn(at_[a], at_[b], at_[u]) * turn(at_[a], at_[b], at_[v]) < 0.0 &&
               turn(at_[u], at_[v], at_[a]) * turn(at_[u], at_[v], at_[b]) < 0.0;
    }

    /// Makes the edge from a to b one of the triangulation's.
    void recover(uint32_t a, uint32_t b) {
        if (joined(a, b)) return;
        std::deque<std::pair<uint32_t, uint32_t>> crossed;
        for (const Cell& cell : cells_)
            for (int k = 0; k < 3; ++k) {
                const uint32_t u = cell.v[(k + 1) % 3], v = cell.v[(k + 2) % 3];
                if (u < v && crosses(a, b, u, v)) crossed.emplace_back(u, v);
            }
        const size_t most = 50 * (crossed.size() + 1) * (crossed.size() + 1);
        for (size_t tries = 0; !crossed.empty(); ++tries) {
            if (tries > most)
                fail(VFIT_ERROR_DATA, "the outline cannot be meshed between its points ", a, " and ", b);
            const auto [u, v] = crossed.front();
            crossed.pop_front();
            int t = kNone, k = kNone;
            around(u, [&](int c) {
                const int at = cells_[c].corner(v);
                if (at == kNone) return true;
                t = c, k = 3 - at - cells_[c].corner(u);
                return false;
            });
            if (t == kNone) continue;
            const int n = cells_[t].next[k];
            const uint32_t p = cells_[t].v[k], s = cells_[n].v[cells_[n].edge_to(t)];
            const uint32_t q = cells_[t].v[(k + 1) % 3], r = cells_[t].v[(k + 2) % 3];
            if (turn(at_[p], at_[q], at_[s]) <= 0.0 ||
                turn(at_[p], at_[s], at_[r]) <= 0.0) {  // not convex: later
                crossed.emplace_back(u, v);
                continue;
            }
            flip(t, k);
            if (crosses(a, b, p, s)) crossed.emplace_back(p, s);
        }
        if (!joined(a, b))
            fail(VFIT_ERROR_DATA, "the outline touches itself between its points ", a, " and ", b);
    }

    uint32_t outline_, count_ = 0;
    std::vector<Point> at_;
    std::vector<Cell> cells_;
    std::vector<int> where_;  // a cell of each point
};

}  // namespace

Triangles triangulate(std::span<const Vec2> points, uint32_t outline) {
    return Triangulation(points, outline).inside();
}

}  // namespace vfit
