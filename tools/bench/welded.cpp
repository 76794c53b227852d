#include "bench/welded.h"

#include <algorithm>
#include <cmath>
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

double ways_mm(std::span<const Vec3> from, std::span<const Vec3> to) {
    std::vector<float> ways_m;
    for (size_t i = 0; i < std::min(from.size(), to.size()); ++i)
        ways_m.push_back(glm::distance(from[i], to[i]));
    if (ways_m.empty()) return 0.0;
    const auto last = ways_m.begin() + std::lround(0.99 * double(ways_m.size() - 1));
    std::nth_element(ways_m.begin(), last, ways_m.end());
    return 1e3 * double(*last);
}

}  // namespace vfit::tools
