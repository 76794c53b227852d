#include "cloth/crossings.h"

namespace vfit {

namespace {

TriangleGroups groups_of(const MeshView& mesh) {
    TriangleGroups groups(mesh.positions, mesh.indices);
    groups.move(mesh.positions);
    return groups;
}

}  // namespace

std::vector<TrianglePair> crossed_triangles(std::span<const Vec3> positions, std::span<const uint32_t> indices) {
    std::vector<TrianglePair> pairs;
    groups_of({positions, indices}).find_crossings(false, pairs);
    return pairs;
}

std::vector<TrianglePair> crossed_triangles(const MeshView& a, const MeshView& b) {
    std::vector<TrianglePair> pairs;
    groups_of(a).find_crossings(groups_of(b), pairs);
    return pairs;
}

}  // namespace vfit
