#include "cloth/crossings.h"

#include "core/jobs.h"

namespace vfit {

namespace {

TriangleGroups groups_of(const MeshView& mesh, Jobs& jobs) {
    TriangleGroups groups(mesh.positions, mesh.indices);
    groups.move(mesh.positions, jobs);
    return groups;
}

}  // namespace

std::vector<TrianglePair> crossed_triangles(std::span<const Vec3> positions,
                                            std::span<const uint32_t> indices) {
    const auto alone = Jobs::own(0);
    std::vector<TrianglePair> pairs;
    groups_of({positions, indices}, *alone).find_crossings(false, pairs, *alone);
    return pairs;
}

std::vector<TrianglePair> crossed_triangles(const MeshView& a, const MeshView& b) {
    const auto alone = Jobs::own(0);
    std::vector<TrianglePair> pairs;
    groups_of(a, *alone).find_crossings(groups_of(b, *alone), pairs, *alone);
    return pairs;
}

}  // namespace vfit
