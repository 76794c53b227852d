// Cuts a mesh with a plane: one segment a crossed triangle, linked through the edges that triangles share.
#include "geometry/section.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.h"
#include "math/finite.h"

namespace vfit {

namespace {

constexpr uint32_t kNone = ~0u;

/// One end of a segment. Segment s runs from end 2 s to end 2 s + 1.
struct End {
    uint64_t edge;  // the crossed edge: lower vertex in the high half
    uint32_t id;
};

uint64_t edge_key(uint32_t a, uint32_t b) { return uint64_t(std::min(a, b)) << 32 | std::max(a, b); }

void set_axes(Section& section, const Vec3& point, const Vec3& normal) {
    // Beyond 0.9 (26 degrees from X) +X leaves too little in the plane to be a stable direction.
    const Vec3 wanted = std::abs(normal.x) < 0.9f ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
    section.origin = point;
    section.u = glm::normalize(wanted - normal * glm::dot(normal, wanted));
    section.v = glm::cross(normal, section.u);
}

/// Ends of the segments of all crossed triangles. Each triangle is crossed from the edge where its boundary
/// goes down through the plane to the one where it comes up: with counter-clockwise triangles that leads
/// round the body counter-clockwise.
std::vector<End> crossings(std::span<const uint32_t> indices, const float* height) {
    std::vector<End> ends;
    for (size_t t = 0; t < indices.size() / 3; ++t) {
        const uint32_t* v = &indices[3 * t];
        const bool above[3] = {height[v[0]] >= 0.0f, height[v[1]] >= 0.0f, height[v[2]] >= 0.0f};
        if (above[0] == above[1] && above[1] == above[2]) continue;
        uint64_t down = 0, up = 0;
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3;
            if (above[k] && !above[next]) down = edge_key(v[k], v[next]);
            if (!above[k] && above[next]) up = edge_key(v[k], v[next]);
        }
        ends.push_back({down, static_cast<uint32_t>(ends.size())});
        ends.push_back({up, static_cast<uint32_t>(ends.size())});
    }
    return ends;
}

/// For each end the end of another segment on the same edge, kNone at a border. Where more than two meet (a
/// mesh that is no surface) they are paired as they come.
std::vector<uint32_t> link(const std::vector<End>& ends) {
    std::vector<End> sorted = ends;
    std::sort(sorted.begin(), sorted.end(),
              [](const End& a, const End& b) { return a.edge != b.edge ? a.edge < b.edge : a.id < b.id; });
    std::vector<uint32_t> partner(ends.size(), kNone);
    for (size_t i = 0; i + 1 < sorted.size();) {
        if (sorted[i].edge != sorted[i + 1].edge) {
            ++i;
            continue;
        }
        partner[sorted[i].id] = sorted[i + 1].id;
        partner[sorted[i + 1].id] = sorted[i].id;
        i += 2;
    }
    return partner;
}

/// Follows linked segments from one end on, marking them as used. Appends the point of every end it leaves
/// from and, where the line ends at a border, of the last one.
template <typename Place>
void follow(uint32_t from, const std::vector<uint32_t>& partner, std::vector<uint8_t>& used,
            const Place& place, std::vector<Vec2>& line) {
    const auto add = [&](uint32_t end) {
        const Vec2 p = place(end);
        if (line.empty() || line.back() != p)
            line.push_back(p);  // several edges meet in a vertex on the plane
    };
    uint32_t at = from;
    while (at != kNone && !used[at / 2]) {
        used[at / 2] = 1;
        add(at);
        const uint32_t other = at ^ 1u;
        at = partner[other];
        if (at == kNone) add(other);
    }
}

}  // namespace

Section cut(std::span<const Vec3> positions, std::span<const uint32_t> indices, const Vec3& point,
            const Vec3& normal) {
    const float length = glm::length(normal);
    if (!finite(point) || !std::isfinite(length) || !(length > 0.0f))
        fail(VFIT_ERROR_ARGUMENT, "the cutting plane has no place or no direction");
    if (indices.size() % 3 != 0)
        fail(VFIT_ERROR_DATA, "the mesh has ", indices.size(), " indices, not three a triangle");
    const Vec3 unit = normal / length;
    Section section;
    set_axes(section, point, unit);

    // Of the named vertices only: a cut of a few triangles of a large mesh is as fast as of a small mesh.
    const auto height = std::make_unique_for_overwrite<float[]>(positions.size());
    for (const uint32_t i : indices) {
        if (i >= positions.size())
            fail(VFIT_ERROR_DATA, "a triangle names vertex ", i, " of ", positions.size());
        height[i] = glm::dot(unit, positions[i] - point);
    }
    const std::vector<End> ends = crossings(indices, height.get());
    const std::vector<uint32_t> partner = link(ends);

    const auto place = [&](uint32_t end) {
        const uint32_t a = static_cast<uint32_t>(ends[end].edge >> 32),
                       b = static_cast<uint32_t>(ends[end].edge);
        const Vec3 p = glm::mix(positions[a], positions[b], height[a] / (height[a] - height[b])) - point;
        return Vec2(glm::dot(p, section.u), glm::dot(p, section.v));
    };
    std::vector<uint8_t> used(ends.size() / 2, 0);
    // Chains first, each from its free start; what is left closes.
    const auto collect = [&](bool chains) {
        for (uint32_t end = 0; end < ends.size(); ++end) {
            if (used[end / 2] || (chains && partner[end] != kNone)) continue;
            std::vector<Vec2> line;
            follow(end, partner, used, place, line);
            if (!chains)
                while (line.size() > 1 && line.front() == line.back()) line.pop_back();
            // A line that is but a point only touches the plane; two points enclose nothing.
            if (line.size() >= (chains ? 2u : 3u))
                (chains ? section.chains : section.loops).push_back(std::move(line));
        }
    };
    collect(true);
    collect(false);
    return section;
}

}  // namespace vfit
