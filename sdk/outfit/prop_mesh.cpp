#include "outfit/prop_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "cloth/contact/contact.h"
#include "core/error.h"

namespace vfit {

namespace {

constexpr float kHalfTurn = 3.14159265f;
constexpr float kLongest_m = 0.03f,
                kParts = 40.0f;  // edges of a prop; of a large one, that part of its extent
constexpr float kShell_m = 0.004f;
constexpr float kFlat_m = 0.00025f;           // round shapes have edges no deeper below them,
constexpr int kMinParts = 3, kMaxParts = 45;  // in that many parts of a quarter turn

float longest_edge_m(float extent_m) { return std::max(kLongest_m, extent_m / kParts); }

float extent_m(std::span<const Vec3> positions) {
    Bounds box;
    for (const Vec3& p : positions) box.add(p);
    const Vec3 extent = box.high - box.low;
    return std::max({extent.x, extent.y, extent.z});
}

/// Splits each edge longer than that once, in the middle. False: there was none.
bool split_long_edges(float longest_m, std::vector<Vec3>& positions, std::vector<uint32_t>& indices,
                      std::vector<std::array<uint32_t, 2>>* middles) {
    constexpr uint32_t kNone = UINT32_MAX;
    std::unordered_map<uint64_t, uint32_t> middle_of;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const Vec3 way = positions[b] - positions[a];
        if (glm::dot(way, way) <= longest_m * longest_m) return kNone;
        const auto [at, is_new] = middle_of.try_emplace(uint64_t(std::min(a, b)) << 32 | std::max(a, b),
                                                        uint32_t(positions.size()));
        if (is_new) {
            if (positions.size() == PropMesh::kMaxVertices)
                fail(VFIT_ERROR_DATA, "a prop's edges are too long for its size: split, it has more than ",
                     PropMesh::kMaxVertices, " vertices");
            positions.push_back(0.5f * (positions[a] + positions[b]));
            if (middles) middles->push_back({a, b});
        }
        return at->second;
    };
    std::vector<uint32_t> out;
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) { out.insert(out.end(), {a, b, c}); };
    for (size_t t = 0; t < indices.size(); t += 3) {
        // Turned so that the first edge is split where one is, and the third is not where one is not.
        std::array<uint32_t, 3> v{indices[t], indices[t + 1], indices[t + 2]}, m{};
        for (size_t k = 0; k < 3; ++k) m[k] = middle(v[k], v[(k + 1) % 3]);
        for (int turn = 0; turn < 2 && (m[0] == kNone || (m[2] != kNone && m[1] == kNone)); ++turn)
            std::rotate(v.begin(), v.begin() + 1, v.end()), std::rotate(m.begin(), m.begin() + 1, m.end());
        if (m[0] == kNone) {
            add(v[0], v[1], v[2]);
        } else if (m[1] == kNone) {
            add(v[0], m[0], v[2]), add(m[0], v[1], v[2]);
        } else if (m[2] == kNone) {
            add(m[0], v[1], m[1]), add(v[0], m[0], m[1]), add(v[0], m[1], v[2]);
        } else {
            add(v[0], m[0], m[2]), add(m[0], v[1], m[1]), add(m[2], m[1], v[2]), add(m[0], m[1], m[2]);
        }
    }
    indices = std::move(out);
    return !middle_of.empty();
}

/// Edges by how many more triangles run along them from the first vertex to the second than back.
using Edges = std::map<std::pair<uint32_t, uint32_t>, int>;
Edges open_edges(std::span<const uint32_t> indices) {
    Edges sides;
    for (size_t i = 0; i < indices.size(); ++i) {
        const uint32_t a = indices[i], b = indices[i % 3 == 2 ? i - 2 : i + 1];
        sides[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
    Edges out;
    for (const auto& [edge, more] : sides) {
        if (more > 0) out[edge] = more;
        if (more < 0) out[{edge.second, edge.first}] = -more;
    }
    return out;
}

/// Of those with two faces, one: between them is nothing.
std::vector<uint32_t> without_backs(std::span<const uint32_t> indices) {
    std::map<std::array<uint32_t, 3>, int> known;  // the smallest vertex first
    std::vector<uint32_t> out;
    for (size_t t = 0; t < indices.size(); t += 3) {
        std::array<uint32_t, 3> face{indices[t], indices[t + 1], indices[t + 2]};
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
        if (known.contains({face[0], face[2], face[1]})) continue;
        known[face] = 1;
        out.insert(out.end(), face.begin(), face.end());
    }
    return out;
}

/// What hangs together, surface by surface.
std::vector<std::vector<uint32_t>> surfaces_of(size_t vertices, std::span<const uint32_t> indices) {
    std::vector<uint32_t> first(vertices);  // of the surface, once followed to the end
    std::iota(first.begin(), first.end(), 0u);
    const auto surface_of = [&](uint32_t v) {
        while (first[v] != v) v = first[v] = first[first[v]];
        return v;
    };
    for (size_t i = 0; i < indices.size(); ++i)
        first[surface_of(indices[i])] = surface_of(indices[i / 3 * 3]);
    std::vector<std::vector<uint32_t>> out;
    std::map<uint32_t, size_t> number_of;
    for (size_t t = 0; t < indices.size(); t += 3) {
        const auto [at, is_new] = number_of.try_emplace(surface_of(indices[t]), out.size());
        if (is_new) out.emplace_back();
        out[at->second].insert(out[at->second].end(), &indices[t], &indices[t] + 3);
    }
    return out;
}

/// The rims of a surface's holes, as its triangles run along them. (At each vertex as many open edges end as
/// begin, so that each way along them leads back.)
std::vector<std::vector<uint32_t>> rims_of(std::span<const uint32_t> surface) {
    Edges open = open_edges(surface);
    std::vector<std::vector<uint32_t>> out;
    while (!open.empty()) {
        std::vector<uint32_t>& rim = out.emplace_back();
        uint32_t v = open.begin()->first.first;
        for (auto edge = open.begin(); edge != open.end() && edge->first.first == v;
             edge = open.lower_bound({v, 0})) {
            rim.push_back(v);
            v = edge->first.second;
            if (--edge->second == 0) open.erase(edge);
        }
    }
    return out;
}

Vec3 middle_of(std::span<const Vec3> positions, std::span<const uint32_t> vertices) {
    Vec3 sum(0.0f);
    for (const uint32_t v : vertices) sum += positions[v];
    return sum / float(vertices.size());
}

float area(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5f * glm::length(glm::cross(b - a, c - a));
}

double enclosed_volume(std::span<const Vec3> positions, std::span<const uint32_t> indices) {
    double volume = 0.0;
    for (size_t t = 0; t < indices.size(); t += 3) {
        const glm::dvec3 a = positions[indices[t]], b = positions[indices[t + 1]],
                         c = positions[indices[t + 2]];
        volume += glm::dot(a, glm::cross(b, c)) / 6.0;
    }
    return volume;
}

/// Turned about y: rings from the lower pole to the upper one.
Mesh revolve(std::span<const Vec2> rings, int around) {
    Mesh out;
    const auto pole = [&](float y) { out.positions.emplace_back(0.0f, y, 0.0f); };
    pole(rings.front().y);
    for (size_t ring = 1; ring + 1 < rings.size(); ++ring)
        for (int i = 0; i < around; ++i) {
            const float angle = 2.0f * kHalfTurn * float(i) / float(around);
            out.positions.emplace_back(rings[ring].x * std::sin(angle), rings[ring].y,
                                       rings[ring].x * std::cos(angle));
        }
    pole(rings.back().y);
    const auto n = uint32_t(around), last = uint32_t(out.positions.size()) - 1;
    const auto at = [&](uint32_t ring, uint32_t i) {
        return ring == 0 ? 0 : ring + 1 == rings.size() ? last : 1 + (ring - 1) * n + i % n;
    };
    for (uint32_t ring = 0; ring + 1 < rings.size(); ++ring)
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t a = at(ring, i), b = at(ring, i + 1), c = at(ring + 1, i), d = at(ring + 1, i + 1);
            if (a != b) out.indices.insert(out.indices.end(), {a, b, d});
            if (c != d) out.indices.insert(out.indices.end(), {a, d, c});
        }
    return out;
}

}  // namespace

PropMesh::PropMesh(std::span<const Vec3> given, std::span<const uint32_t> indices)
    : given_count_(given.size()) {
    if (given.size() > kMaxVertices)
        fail(VFIT_ERROR_DATA, "a prop has ", given.size(), " vertices, more than ", kMaxVertices);
    std::map<std::tuple<float, float, float>, uint32_t> at;
    std::vector<uint32_t> one_of(given.size());
    std::vector<Vec3> positions;
    for (uint32_t i = 0; i < given.size(); ++i) {
        const auto [known, is_new] =
            at.try_emplace({given[i].x, given[i].y, given[i].z}, uint32_t(kept_.size()));
        if (is_new) kept_.push_back(i), positions.push_back(given[i]);
        one_of[i] = known->second;
    }
    for (size_t t = 0; t + 2 < indices.size(); t += 3) {
        for (size_t k = 0; k < 3; ++k)
            if (indices[t + k] >= given.size())
                fail(VFIT_ERROR_DATA, "a prop's triangle ", t / 3, " names vertex ", indices[t + k], " of ",
                     given.size());
        const uint32_t a = one_of[indices[t]], b = one_of[indices[t + 1]], c = one_of[indices[t + 2]];
        if (a != b && b != c && c != a) indices_.insert(indices_.end(), {a, b, c});
    }
    if (indices_.empty()) fail(VFIT_ERROR_DATA, "a prop has no triangle");
    indices_ = without_backs(indices_);
    fill_holes(positions);
    const float longest_m = longest_edge_m(extent_m(positions));
    while (split_long_edges(longest_m, positions, indices_, &middles_)) {
    }
    back_shells(positions.size());
}

void PropMesh::fill_holes(std::vector<Vec3>& positions) {
    constexpr float kSmall = 0.25f;  // all holes of a surface, beside its area
    constexpr double kNone = 1e-6;   // volume, of a cube
    const double cube = std::pow(double(extent_m(positions)), 3.0);
    double volume = 0.0;
    std::vector<uint32_t> fans;
    for (const std::vector<uint32_t>& surface : surfaces_of(positions.size(), indices_)) {
        float own_area = 0.0f, hole_area = 0.0f;
        for (size_t t = 0; t < surface.size(); t += 3)
            own_area += area(positions[surface[t]], positions[surface[t + 1]], positions[surface[t + 2]]);
        std::vector<uint32_t> filled = surface;
        const std::vector<std::vector<uint32_t>> rims = rims_of(surface);
        for (size_t hole = 0; hole < rims.size(); ++hole) {
            const Vec3 middle = middle_of(positions, rims[hole]);
            for (size_t i = 0; i < rims[hole].size(); ++i) {
                const uint32_t a = rims[hole][i], b = rims[hole][(i + 1) % rims[hole].size()];
                hole_area += area(positions[a], positions[b], middle);
                filled.insert(filled.end(), {b, a, uint32_t(positions.size() + hole)});
            }
        }
        if (hole_area > kSmall * own_area) continue;
        for (const std::vector<uint32_t>& rim : rims) positions.push_back(middle_of(positions, rim));
        rims_.insert(rims_.end(), rims.begin(), rims.end());
        volume += enclosed_volume(positions, filled);
        fans.insert(fans.end(), filled.begin() + std::ptrdiff_t(surface.size()), filled.end());
    }
    if (volume < -kNone * cube) fail(VFIT_ERROR_DATA, "a prop's triangles are clockwise seen from outside");
    indices_.insert(indices_.end(), fans.begin(), fans.end());
}

void PropMesh::back_shells(size_t vertices) {
    for (const std::vector<uint32_t>& surface : surfaces_of(vertices, indices_))
        if (!open_edges(surface).empty()) fronts_.insert(fronts_.end(), surface.begin(), surface.end());
    std::vector<uint32_t> back_of(vertices, 0);
    for (const uint32_t v : fronts_)
        if (back_of[v] == 0) back_of[v] = uint32_t(vertices + backed_.size()), backed_.push_back(v);
    for (size_t t = 0; t < fronts_.size(); t += 3)
        indices_.insert(indices_.end(),
                        {back_of[fronts_[t]], back_of[fronts_[t + 2]], back_of[fronts_[t + 1]]});
    for (const auto& [edge, more] : open_edges(fronts_))
        for (int i = 0; i < more; ++i) {
            const auto [a, b] = edge;
            indices_.insert(indices_.end(), {b, a, back_of[a], b, back_of[a], back_of[b]});
        }
    if (vertex_count() > kMaxVertices)
        fail(VFIT_ERROR_DATA, "a prop that is not closed has ", vertex_count(),
             " vertices with its back, more than ", kMaxVertices);
}

void PropMesh::place(std::span<const Vec3> given, std::vector<Vec3>& out) const {
    out.resize(vertex_count());
    for (size_t i = 0; i < kept_.size(); ++i) out[i] = given[kept_[i]];
    for (size_t i = 0; i < rims_.size(); ++i) out[kept_.size() + i] = middle_of(out, rims_[i]);
    for (size_t i = 0; i < middles_.size(); ++i)
        out[kept_.size() + rims_.size() + i] = 0.5f * (out[middles_[i][0]] + out[middles_[i][1]]);
    if (backed_.empty()) return;
    std::vector<Vec3> normals(front_count(), Vec3(0.0f));
    for (size_t t = 0; t < fronts_.size(); t += 3) {
        const Vec3& a = out[fronts_[t]];
        const Vec3 normal = glm::cross(out[fronts_[t + 1]] - a, out[fronts_[t + 2]] - a);
        for (size_t k = 0; k < 3; ++k) normals[fronts_[t + k]] += normal;
    }
    for (size_t i = 0; i < backed_.size(); ++i) {
        const Vec3& normal = normals[backed_[i]];
        out[normals.size() + i] =
            out[backed_[i]] - normal * (kShell_m / std::max(glm::length(normal), 1e-12f));
    }
}

Mesh sphere_mesh(float radius_m) { return capsule_mesh(radius_m, 0.0f); }

Mesh capsule_mesh(float radius_m, float half_m) {
    const float turn = std::acos(1.0f - std::min(kFlat_m / radius_m, 1.0f));
    const int quarter = std::clamp(int(std::ceil(0.5f * kHalfTurn / (2.0f * turn))), kMinParts, kMaxParts);
    std::vector<Vec2> rings;
    for (const float side : {-1.0f, 1.0f})
        for (int i = 0; i <= quarter; ++i) {
            if (half_m == 0.0f && side > 0.0f && i == 0) continue;
            const float angle = 0.5f * kHalfTurn * float(side < 0.0f ? quarter - i : i) / float(quarter);
            rings.emplace_back(radius_m * std::cos(angle), side * (half_m + radius_m * std::sin(angle)));
            if (side > 0.0f || i < quarter) continue;
            const int parts = int(std::ceil(2.0f * half_m / longest_edge_m(2.0f * (half_m + radius_m))));
            for (int part = 1; part < parts; ++part)
                rings.emplace_back(radius_m, half_m * (2.0f * float(part) / float(parts) - 1.0f));
        }
    return revolve(rings, 4 * quarter);
}

Mesh box_mesh(const Vec3& half_m) {
    Mesh out;
    for (uint32_t i = 0; i < 8; ++i)
        out.positions.push_back(half_m * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    out.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                   2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    return out;
}

}  // namespace vfit
