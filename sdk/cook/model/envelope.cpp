#include "cook/model/envelope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "body/mesh.h"
#include "cook/model/outer_side.h"
#include "core/error.h"
#include "geometry/borders.h"
#include "geometry/mesh_query.h"

namespace vfit {

namespace {

using Cell = std::array<int, 3>;
struct CellHash {
    size_t operator()(const Cell& c) const {
        return size_t(c[0]) * 73856093u ^ size_t(c[1]) * 19349663u ^ size_t(c[2]) * 83492791u;
    }
};

/// The winding number of facets about a place: 1 within what they close, 0 outside, smooth through openings
/// (Barill et al. 2018, Fast Winding Numbers for Soups and Clouds).
class WindingNumber {
public:
    WindingNumber(const std::vector<Facet>& facets, float blur_m) : blur2_(blur_m * blur_m) {
        std::map<Cell, Group> groups;
        for (const Facet& facet : facets) {
            const glm::ivec3 cell(glm::floor(facet.at / kGroup_m));
            Group& group = groups[{cell.x, cell.y, cell.z}];
            const float weight = glm::length(facet.area);
            group.sum.area += facet.area;
            group.sum.at += weight * facet.at;
            group.weight += weight;
            group.facets.push_back(facet);
        }
        for (auto& [cell, group] : groups) {
            if (group.weight > 0.0f) group.sum.at /= group.weight;
            groups_.push_back(std::move(group));
        }
    }

    float at(const Vec3& place) const {
        constexpr float kNear_m = 2.5f * kGroup_m;
        double sum = 0.0;
        for (const Group& group : groups_) {
            if (glm::length(group.sum.at - place) > kNear_m) {
                sum += double(of(group.sum, place));
                continue;
            }
            for (const Facet& facet : group.facets) sum += double(of(facet, place));
        }
        return float(sum) / (4.0f * kPi);
    }

private:
    static constexpr float kGroup_m = 0.06f;
    struct Group {
        Facet sum{Vec3(0.0f), Vec3(0.0f)};
        float weight = 0.0f;
        std::vector<Facet> facets;
    };
    float of(const Facet& facet, const Vec3& place) const {
        const Vec3 way = facet.at - place;
        const float r2 = glm::dot(way, way) + blur2_;
        return glm::dot(facet.area, way) / (r2 * std::sqrt(r2));
    }

    float blur2_;
    std::vector<Group> groups_;
};

class EnvelopeMaker {
public:
    EnvelopeMaker(const Soup& soup, float side_m)
        : soup_(soup),
          side_m_(side_m),
          outer_(outer_side(soup, 0.5f * side_m)),
          cloth_(outer_.indices.empty() ? MeshQuery(soup.places, soup.indices())
                                        : MeshQuery(soup.places, outer_.indices)),
          winding_(outer_.facets, 0.5f * side_m) {}

    Model run() {
        find_cells();
        for (const Cell& cell : cells_) add_vertex(cell);
        for (const Cell& cell : cells_) add_squares(cell);
        leave_out_what_is_no_cloth();
        part_sides_of_many();
        leave_out_ears();
        for (int round = 0; round < kRounds; ++round) {
            places_ = smoothed();
            onto_cloth();
        }
        even_out();
        leave_out_slivers();
        return write();
    }

private:
    Vec3 corner(const Cell& c) const { return side_m_ * Vec3(float(c[0]), float(c[1]), float(c[2])); }

    /// Those about the cloth.
    void find_cells() {
        std::set<Cell> found;
        const auto add = [&](const Vec3& at) {
            const glm::ivec3 c(glm::floor(at / side_m_));
            for (int x = -1; x <= 1; ++x)
                for (int y = -1; y <= 1; ++y)
                    for (int z = -1; z <= 1; ++z) found.insert({c.x + x, c.y + y, c.z + z});
        };
        for (size_t i = 0; i + 2 < outer_.indices.size(); i += 3) {
            const Vec3 &a = soup_.places[outer_.indices[i]], &b = soup_.places[outer_.indices[i + 1]],
                       &c = soup_.places[outer_.indices[i + 2]];
            const float size = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
            const int steps = std::max(1, int(std::ceil(size / side_m_)));
            for (int u = 0; u <= steps; ++u)
                for (int v = 0; u + v <= steps; ++v)
                    add(a + (float(u) * (b - a) + float(v) * (c - a)) / float(steps));
        }
        cells_.assign(found.begin(), found.end());
        if (cells_.size() > kMaxCells)
            fail(VFIT_ERROR_DATA, "the garment's surface is too large to be made anew");
    }

    float value(const Cell& c) {
        const auto [it, fresh] = values_.try_emplace(c, 0.0f);
        if (fresh) it->second = winding_.at(corner(c)) - 0.5f;
        return it->second;
    }

    /// Surface nets (Gibson 1998): one vertex a cell that the surface crosses, in the middle of where it
    /// does.
    void add_vertex(const Cell& c) {
        std::array<float, 8> w;
        for (int i = 0; i < 8; ++i)
            w[size_t(i)] = value({c[0] + (i & 1), c[1] + (i >> 1 & 1), c[2] + (i >> 2 & 1)});
        Vec3 sum(0.0f);
        float count = 0.0f;
        for (int i = 0; i < 8; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                const int j = i | 1 << axis;
                if (i == j || (w[size_t(i)] > 0.0f) == (w[size_t(j)] > 0.0f)) continue;
                Vec3 p{float(i & 1), float(i >> 1 & 1), float(i >> 2 & 1)};
                p[axis] += w[size_t(i)] / (w[size_t(i)] - w[size_t(j)]);
                sum += p, count += 1.0f;
            }
        if (count == 0.0f) return;
        vertex_in_[c] = uint32_t(places_.size());
        places_.push_back(corner(c) + side_m_ * sum / count);
    }

    /// About the sides of the grid that leave the cell's first corner.
    void add_squares(const Cell& c) {
        for (int axis = 0; axis < 3; ++axis) {
            Cell end = c;
            ++end[size_t(axis)];
            const float from = value(c), to = value(end);
            if ((from > 0.0f) == (to > 0.0f)) continue;
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            std::array<uint32_t, 4> square;
            bool whole = true;
            for (size_t k = 0; k < 4 && whole; ++k) {
                Cell cell = c;
                cell[size_t(u)] -= k == 1 || k == 2;
                cell[size_t(v)] -= k == 2 || k == 3;
                const auto found = vertex_in_.find(cell);
                whole = found != vertex_in_.end();
                if (whole) square[k] = found->second;
            }
            if (!whole) continue;
            if (from < 0.0f) std::swap(square[1], square[3]);
            const auto length = [&](size_t i, size_t j) {
                return glm::length(places_[square[i]] - places_[square[j]]);
            };
            if (length(0, 2) <= length(1, 3)) {
                triangles_.push_back({square[0], square[1], square[2]});
                triangles_.push_back({square[0], square[2], square[3]});
            } else {
                triangles_.push_back({square[0], square[1], square[3]});
                triangles_.push_back({square[1], square[2], square[3]});
            }
        }
    }

    using Side = std::pair<uint32_t, uint32_t>;
    std::map<Side, std::vector<uint32_t>> triangles_at_sides() const {
        std::map<Side, std::vector<uint32_t>>
            out;  // three times the triangle, and the corner where it begins
        for (uint32_t t = 0; t < triangles_.size(); ++t)
            for (uint32_t k = 0; k < 3; ++k)
                out[std::minmax(triangles_[t][k], triangles_[t][(k + 1) % 3])].push_back(3 * t + k);
        return out;
    }

    /// The winding number goes on across openings: away from the cloth, or across its end. A patch across it
    /// that comes to no end is a fold.
    void leave_out_what_is_no_cloth() {
        constexpr float kOff = 0.9f, kAlong = 0.4f;  // of the side; cosine
        std::vector<uint8_t> no_cloth(triangles_.size(), 0), ends(triangles_.size(), 0);
        for (size_t i = 0; i < triangles_.size(); ++i) {
            const auto& t = triangles_[i];
            const Vec3 &a = places_[t[0]], &b = places_[t[1]], &c = places_[t[2]];
            const Vec3 normal = glm::cross(b - a, c - a);
            const float length = glm::length(normal);
            const MeshQuery::Closest cloth = cloth_.closest((a + b + c) / 3.0f);
            ends[i] = cloth.distance > kOff * side_m_;
            no_cloth[i] = ends[i] || !(glm::dot(normal, cloth.normal) > kAlong * length);
        }
        const auto sides = triangles_at_sides();
        for (const auto& [side, at] : sides)
            if (at.size() == 1) ends[at[0] / 3] = 1;
        std::vector<uint8_t> seen(triangles_.size(), 0), left_out(triangles_.size(), 0);
        for (uint32_t first = 0; first < triangles_.size(); ++first) {
            if (!no_cloth[first] || seen[first]) continue;
            std::vector<uint32_t> patch{first};
            seen[first] = 1;
            bool has_end = false;
            for (size_t i = 0; i < patch.size(); ++i) {
                has_end |= ends[patch[i]] != 0;
                const auto& t = triangles_[patch[i]];
                for (size_t k = 0; k < 3; ++k)
                    for (const uint32_t at : sides.at(std::minmax(t[k], t[(k + 1) % 3])))
                        if (no_cloth[at / 3] && !seen[at / 3]) seen[at / 3] = 1, patch.push_back(at / 3);
            }
            for (const uint32_t t : patch) left_out[t] = has_end;
        }
        std::vector<std::array<uint32_t, 3>> kept;
        for (size_t i = 0; i < triangles_.size(); ++i)
            if (!left_out[i]) kept.push_back(triangles_[i]);
        triangles_ = std::move(kept);
    }

    /// Where two sheets touch, they are parted again: triangles stay together over sides of two.
    void part_sides_of_many() {
        const auto sides = triangles_at_sides();
        std::vector<uint32_t> parent(3 * triangles_.size());  // of corners: those that stay one vertex
        for (uint32_t i = 0; i < parent.size(); ++i) parent[i] = i;
        const auto root = [&](uint32_t i) {
            while (parent[i] != i) i = parent[i] = parent[parent[i]];
            return i;
        };
        for (const auto& [side, at] : sides) {
            const auto begin = [&](uint32_t i) { return triangles_[i / 3][i % 3]; };
            if (at.size() != 2 || begin(at[0]) == begin(at[1])) continue;
            for (const uint32_t vertex : {side.first, side.second}) {
                std::array<uint32_t, 2> corners{};
                for (size_t i = 0; i < 2; ++i)
                    for (uint32_t k = 0; k < 3; ++k)
                        if (triangles_[at[i] / 3][k] == vertex) corners[i] = at[i] / 3 * 3 + k;
                parent[root(corners[0])] = root(corners[1]);
            }
        }
        std::unordered_map<uint32_t, uint32_t> number;
        std::vector<Vec3> places;
        for (uint32_t i = 0; i < parent.size(); ++i) {
            const auto [it, fresh] = number.try_emplace(root(i), uint32_t(places.size()));
            if (fresh) places.push_back(places_[triangles_[i / 3][i % 3]]);
            triangles_[i / 3][i % 3] = it->second;
        }
        places_ = std::move(places);
    }

    /// Those that hang on one side only, and two that lie back to back: their tips would be smoothed flat.
    void leave_out_ears() {
        for (bool any = true; any;) {
            std::vector<uint8_t> free_sides(triangles_.size(), 0);
            std::map<std::array<uint32_t, 3>, size_t> known;
            for (size_t i = 0; i < triangles_.size(); ++i) {
                std::array<uint32_t, 3> sorted = triangles_[i];
                std::sort(sorted.begin(), sorted.end());
                if (const auto [it, fresh] = known.try_emplace(sorted, i); !fresh)
                    free_sides[i] = free_sides[it->second] = 3;
            }
            for (const auto& [side, at] : triangles_at_sides())
                if (at.size() == 1) ++free_sides[at[0] / 3];
            std::vector<std::array<uint32_t, 3>> kept;
            for (size_t i = 0; i < triangles_.size(); ++i)
                if (free_sides[i] < 2) kept.push_back(triangles_[i]);
            any = kept.size() < triangles_.size();
            triangles_ = std::move(kept);
        }
    }

    std::vector<uint32_t> indices() const {
        std::vector<uint32_t> out;
        for (const auto& t : triangles_) out.insert(out.end(), t.begin(), t.end());
        return out;
    }

    /// Each to the middle of those beside it; of a border, along the border, except small holes, which would
    /// shrink to nothing.
    std::vector<Vec3> smoothed() const {
        constexpr size_t kHole = 12;  // vertices
        const auto sides = triangles_at_sides();
        std::vector<uint8_t> border(places_.size(), 0), stays(places_.size(), 0);
        for (const auto& [side, at] : sides)
            if (at.size() == 1) border[side.first] = border[side.second] = 1;
        for (const auto& loop : borders(indices()))
            for (const uint32_t v : loop) stays[v] |= loop.size() < kHole;
        std::vector<Vec3> sum(places_.size(), Vec3(0.0f));
        std::vector<float> beside(places_.size(), 0.0f);
        for (const auto& [side, at] : sides)
            for (const auto& [a, b] : {side, std::pair(side.second, side.first)})
                if (!border[a] || at.size() == 1) sum[a] += places_[b], beside[a] += 1.0f;
        std::vector<Vec3> out = places_;
        for (size_t v = 0; v < out.size(); ++v)
            if (beside[v] > 0.0f && !stays[v]) out[v] = glm::mix(out[v], sum[v] / beside[v], 0.5f);
        return out;
    }

    /// Along their normals, so that triangles stay even.
    void onto_cloth() {
        constexpr float kReach = 1.5f;
        std::vector<Vec3> normals;
        compute_normals(places_, indices(), normals);
        for (size_t v = 0; v < places_.size(); ++v) {
            const MeshQuery::Closest cloth = cloth_.closest(places_[v]);
            if (cloth.distance < kReach * side_m_)
                places_[v] += glm::dot(cloth.point - places_[v], normals[v]) * normals[v];
        }
    }

    /// Slivers that are left in sharp folds.
    void even_out() {
        constexpr int kRounds = 20;
        constexpr float kMinHeight = 0.15f;  // of the side
        for (int round = 0; round < kRounds; ++round) {
            std::vector<uint8_t> moves(places_.size(), 0);
            bool any = false;
            for (const auto& t : triangles_) {
                const Vec3 &a = places_[t[0]], &b = places_[t[1]], &c = places_[t[2]];
                const float longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
                if (glm::length(glm::cross(b - a, c - a)) >= kMinHeight * side_m_ * longest) continue;
                for (const uint32_t v : t) moves[v] = 1;
                any = true;
            }
            if (!any) return;
            const std::vector<Vec3> to = smoothed();
            for (size_t v = 0; v < to.size(); ++v)
                if (moves[v]) places_[v] = to[v];
        }
    }

    void leave_out_slivers() {
        constexpr float kMinHeight = 0.02f;  // of the side
        std::erase_if(triangles_, [&](const std::array<uint32_t, 3>& t) {
            const Vec3 &a = places_[t[0]], &b = places_[t[1]], &c = places_[t[2]];
            const float longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
            return !(glm::length(glm::cross(b - a, c - a)) >= kMinHeight * side_m_ * longest);
        });
    }

    Model write() const {
        if (triangles_.empty()) fail(VFIT_ERROR_DATA, "the mesh has no outer side that could be cloth");
        return model_of(places_, triangles_, soup_.unit_m, "the surface that was made anew: triangle ");
    }

    static constexpr size_t kMaxCells = 400000;
    static constexpr int kRounds = 4;  // after them it lies on the cloth, and triangles are even
    const Soup& soup_;
    float side_m_;
    OuterSide outer_;
    MeshQuery cloth_;
    WindingNumber winding_;
    std::vector<Cell> cells_;
    std::unordered_map<Cell, float, CellHash> values_;
    std::unordered_map<Cell, uint32_t, CellHash> vertex_in_;
    std::vector<Vec3> places_;
    std::vector<std::array<uint32_t, 3>> triangles_;
};

}  // namespace

Model envelope_of(const Soup& soup, float side_m) { return EnvelopeMaker(soup, side_m).run(); }

}  // namespace vfit
