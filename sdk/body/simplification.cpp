#include "body/simplification.h"

#include <meshoptimizer.h>

#include "core/error.h"

namespace vfit {

namespace {

constexpr uint32_t kUnused = ~uint32_t(0);

uint32_t source_of(const BodyTopology& fine, uint32_t render_vertex) {
    return render_vertex < fine.vertex_count ? render_vertex
                                             : fine.seam_sources[render_vertex - fine.vertex_count];
}

/// Triangles of render vertices of the fine surface.
std::vector<uint32_t> fewer_triangles(const BodyTopology& fine, std::span<const Vec3> positions,
                                      size_t index_count) {
    std::vector<Vec3> render(positions.begin(), positions.begin() + fine.vertex_count);
    for (const uint32_t source : fine.seam_sources) render.push_back(positions[source]);
    std::vector<uint32_t> out(fine.render_indices.size());
    constexpr float kAnyError = 1.0f;  // of the body's size: the count alone decides
    out.resize(meshopt_simplify(out.data(), fine.render_indices.data(), fine.render_indices.size(),
                                &render[0].x, render.size(), sizeof(Vec3), index_count, kAnyError,
#if MESHOPTIMIZER_VERSION >= 180
                                0,
#endif
                                nullptr));
    return out;
}

}  // namespace

SimplifiedSurface simplify_surface(const BodyTopology& fine, std::span<const Vec3> positions,
                                   uint32_t vertex_count) {
    // A closed surface of v vertices has 2v triangles, but for its handles.
    const std::vector<uint32_t> triangles = fewer_triangles(fine, positions, 6 * size_t(vertex_count));
    if (triangles.empty()) fail(VFIT_ERROR_DATA, "the body's surface cannot be simplified");

    SimplifiedSurface out;
    BodyTopology& t = out.topology;
    // Geometric vertices first, each under the first render vertex that names it; then the copies at seams.
    std::vector<uint32_t> place(fine.vertex_count, kUnused), render_place(fine.render_vertex_count, kUnused);
    std::vector<uint32_t> render_sources;
    for (const uint32_t corner : triangles) {
        const uint32_t source = source_of(fine, corner);
        if (place[source] != kUnused) continue;
        place[source] = render_place[corner] = static_cast<uint32_t>(out.sources.size());
        out.sources.push_back(source);
        render_sources.push_back(corner);
    }
    t.vertex_count = static_cast<uint32_t>(out.sources.size());
    for (const uint32_t corner : triangles) {
        const uint32_t geometric = place[source_of(fine, corner)];
        if (render_place[corner] == kUnused) {
            render_place[corner] = static_cast<uint32_t>(render_sources.size());
            render_sources.push_back(corner);
            t.seam_sources.push_back(geometric);
        }
        t.indices.push_back(geometric);
        t.render_indices.push_back(render_place[corner]);
    }
    t.render_vertex_count = static_cast<uint32_t>(render_sources.size());
    for (const uint32_t source : render_sources) {
        t.uvs.push_back(fine.uvs[source]);
        t.skin_bones.push_back(fine.skin_bones[source]);
        t.skin_weights.push_back(fine.skin_weights[source]);
        t.parts.push_back(fine.parts[source]);
    }
    return out;
}

}  // namespace vfit
