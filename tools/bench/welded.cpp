#include "bench/welded.h"

#include <map>
#include <tuple>

#include "bench/bench.h"
#include "cloth/crossings.h"

namespace vfit::tools {

namespace {

Welded weld(vfit_frame frame) {
    Welded out;
    std::map<std::tuple<float, float, float>, uint32_t> known;
    std::vector<uint32_t> number;
    for (const Vec3& p : items_of<Vec3>(frame, VFIT_STREAM_POSITION)) {
        const auto [it, fresh] = known.insert({{p.x, p.y, p.z}, uint32_t(out.positions.size())});
        if (fresh) out.positions.push_back(p);
        number.push_back(it->second);
    }
    for (const uint32_t i : items_of<uint32_t>(frame, VFIT_STREAM_INDEX)) out.indices.push_back(number[i]);
    return out;
}

}  // namespace

Welded mesh_of(vfit_avatar avatar) {
    Frame frame;
    check(vfit_avatar_acquire(avatar, frame.out()));
    return weld(frame.get());
}
Welded mesh_of(vfit_cloth cloth) {
    Frame frame;
    check(vfit_cloth_acquire(cloth, frame.out()));
    return weld(frame.get());
}

Welded skin_below(std::span<const vfit_cloth> outfit, float* took_ms) {
    Frame frame;
    const Timer timer;
    check(vfit_outfit_skin(outfit.data(), uint32_t(outfit.size()), frame.out(), nullptr));
    *took_ms = float(timer.ms());
    return weld(frame.get());
}

MeshQuery query_of(const Welded& mesh) { return MeshQuery(mesh.positions, mesh.indices); }

CrossedTriangles crossings(const Welded& mesh) { return crossed_triangles(mesh.positions, mesh.indices); }
CrossedTriangles crossings(const Welded& a, const Welded& b) {
    return crossed_triangles({a.positions, a.indices}, {b.positions, b.indices});
}

}  // namespace vfit::tools
