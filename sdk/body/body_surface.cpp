// Builds each level of detail from the one below it.
#include "body/body_surface.h"

#include <algorithm>
#include <unordered_map>

#include "core/error.h"

namespace vfit {

namespace {

using Bones = std::array<uint16_t, kSkinBones>;
using Weights = std::array<float, kSkinBones>;

std::vector<Vec3> base_positions(const BodyData& body) {
    std::vector<Vec3> positions(body.vertex_count);
    for (uint32_t i = 0; i < body.vertex_count; ++i) {
        const float* x = body.base.data() + size_t(i / kLanes) * kBlockFloats + i % kLanes;
        positions[i] = Vec3(x[0], x[kLanes], x[2 * kLanes]);
    }
    return positions;
}

/// Gives every pair of vertex and UV a render vertex: the first UV of a vertex keeps its index, the others
/// get copies behind all vertices.
std::vector<Quad> split_seams(uint32_t vertex_count, const std::vector<Quad>& quads,
                              const std::vector<Quad>& uv_quads, const std::vector<Vec2>& uvs,
                              BodyTopology& out) {
    constexpr uint32_t kNone = ~0u;
    std::vector<uint32_t> first_uv(vertex_count, kNone);
    std::unordered_map<uint64_t, uint32_t> copies;
    std::vector<Quad> render_quads(quads.size());
    out.uvs.assign(vertex_count, Vec2(0.0f));
    for (size_t f = 0; f < quads.size(); ++f) {
        for (int i = 0; i < 4; ++i) {
            const uint32_t vertex = quads[f][i], uv = uv_quads[f][i];
            if (first_uv[vertex] == kNone) {
                first_uv[vertex] = uv;
                out.uvs[vertex] = uvs[uv];
            }
            if (first_uv[vertex] == uv) {
                render_quads[f][i] = vertex;
                continue;
            }
            const uint32_t next = static_cast<uint32_t>(out.uvs.size());
            const auto [copy, is_new] = copies.try_emplace(uint64_t(vertex) << 32 | uv, next);
            if (is_new) {
                out.uvs.push_back(uvs[uv]);
                out.seam_sources.push_back(vertex);
            }
            render_quads[f][i] = copy->second;
        }
    }
    return render_quads;
}

/// Two triangles a quad, cut along the shorter diagonal of the given positions.
void triangulate(const std::vector<Quad>& quads, const std::vector<Quad>& render_quads,
                 const std::vector<Vec3>& positions, BodyTopology& out) {
    out.indices.reserve(6 * quads.size());
    out.render_indices.reserve(6 * quads.size());
    for (size_t f = 0; f < quads.size(); ++f) {
        const Quad& q = quads[f];
        const float diagonal_02 = glm::distance(positions[q[0]], positions[q[2]]);
        const float diagonal_13 = glm::distance(positions[q[1]], positions[q[3]]);
        const int start = diagonal_02 <= diagonal_13 ? 0 : 1;
        for (int step : {0, 1, 2, 0, 2, 3}) {
            out.indices.push_back(q[(start + step) % 4]);
            out.render_indices.push_back(render_quads[f][(start + step) % 4]);
        }
    }
}

/// The kSkinBones heaviest of the bones that were offered.
class HeaviestBones {
public:
    void offer(uint16_t bone, float weight) {
        for (int i = 0; i < kSkinBones; ++i) {
            if (weight <= weights_[i]) continue;
            std::swap(weight, weights_[i]);
            std::swap(bone, bones_[i]);
        }
    }
    void write(Bones& bones, Weights& weights) const {
        float sum = 0.0f;
        for (float w : weights_) sum += w;
        bones = bones_;
        for (int i = 0; i < kSkinBones; ++i) weights[i] = weights_[i] / sum;
    }

private:
    Bones bones_{};
    Weights weights_{};
};

void read_skin(const BodyData& body, BodyTopology& out) {
    for (uint32_t v = 0; v < body.vertex_count; ++v) {
        HeaviestBones heaviest;
        for (int i = 0; i < kSkinBones; ++i) heaviest.offer(body.skin_bones[v][i], body.skin_weights[v][i]);
        heaviest.write(out.skin_bones[v], out.skin_weights[v]);
    }
}

/// Skin weights are subdivided as positions are, bone by bone, so that they are as smooth.
void refine_skin(const Refinement& refinement, const BodyTopology& coarse, size_t bone_count,
                 BodyTopology& out) {
    std::vector<float> weight(coarse.vertex_count), fine(out.vertex_count);
    std::vector<HeaviestBones> heaviest(out.vertex_count);
    for (size_t bone = 0; bone < bone_count; ++bone) {
        bool used = false;
        for (uint32_t v = 0; v < coarse.vertex_count; ++v) {
            weight[v] = 0.0f;
            for (int i = 0; i < kSkinBones; ++i)
                if (coarse.skin_bones[v][i] == bone) weight[v] += coarse.skin_weights[v][i];
            used = used || weight[v] > 0.0f;
        }
        if (!used) continue;
        refine_smooth(refinement, weight.data(), fine.data());
        for (uint32_t v = 0; v < out.vertex_count; ++v)
            if (fine[v] > 0.0f) heaviest[v].offer(static_cast<uint16_t>(bone), fine[v]);
    }
    for (uint32_t v = 0; v < out.vertex_count; ++v) heaviest[v].write(out.skin_bones[v], out.skin_weights[v]);
}

BodyPart heaviest_part(const BodyData& body, const Bones& bones, const Weights& weights) {
    std::array<float, kBodyPartCount> share{};
    for (int i = 0; i < kSkinBones; ++i) share[static_cast<size_t>(body.bone_parts[bones[i]])] += weights[i];
    return static_cast<BodyPart>(std::max_element(share.begin(), share.end()) - share.begin());
}

/// Copies at seams have the skin of their source.
void finish_skin(const BodyData& body, BodyTopology& out) {
    for (uint32_t v = 0; v < out.vertex_count; ++v)
        out.parts[v] = heaviest_part(body, out.skin_bones[v], out.skin_weights[v]);
    for (uint32_t v = out.vertex_count; v < out.render_vertex_count; ++v) {
        const uint32_t source = out.seam_sources[v - out.vertex_count];
        out.skin_bones[v] = out.skin_bones[source];
        out.skin_weights[v] = out.skin_weights[source];
        out.parts[v] = out.parts[source];
    }
}

}  // namespace

void BodySurface::build(uint32_t index, Level& now) const {
    const Level* below = index > 0 ? &level(index - 1) : nullptr;
    std::vector<Quad> quads = below ? fine_quads(below->to_next) : body_.quads;
    std::vector<Quad> uv_quads = below ? fine_quads(below->uv_to_next) : body_.uv_quads;
    BodyTopology& out = now.topology;
    if (below) {
        out.vertex_count = below->to_next.fine_vertex_count();
        now.positions.resize(out.vertex_count);
        refine_smooth(below->to_next, below->positions.data(), now.positions.data());
        now.uvs.resize(below->uv_to_next.fine_vertex_count());
        refine_linear(below->uv_to_next, below->uvs.data(), now.uvs.data());
    } else {
        out.vertex_count = body_.vertex_count;
        now.positions = base_positions(body_);
        now.uvs = body_.uvs;
    }
    triangulate(quads, split_seams(out.vertex_count, quads, uv_quads, now.uvs, out), now.positions, out);
    out.render_vertex_count = static_cast<uint32_t>(out.uvs.size());
    out.skin_bones.resize(out.render_vertex_count);
    out.skin_weights.resize(out.render_vertex_count);
    out.parts.resize(out.render_vertex_count);
    if (below) {
        refine_skin(below->to_next, below->topology, body_.bones.size(), out);
    } else {
        read_skin(body_, out);
    }
    finish_skin(body_, out);
    if (index + 1 < kBodyLevels) {
        now.to_next = make_refinement(out.vertex_count, std::move(quads));
        now.uv_to_next = make_refinement(static_cast<uint32_t>(now.uvs.size()), std::move(uv_quads));
        for (const Refinement::Edge& edge : now.to_next.edges)
            if (edge.right < 0) fail(VFIT_ERROR_DATA, "the body's surface has a hole at vertex ", edge.a);
        for (uint32_t v = 0; v < out.vertex_count; ++v)
            if (now.to_next.valence[v] == 0) fail(VFIT_ERROR_DATA, "no face of the body has vertex ", v);
    } else {
        now.positions = {};
        now.uvs = {};
    }
}

const BodySurface::Level& BodySurface::level(uint32_t index) const {
    if (index >= kBodyLevels)
        fail(VFIT_ERROR_ARGUMENT, "level of detail ", index, " where 0 to ", kCoarseBody, " exist");
    Level& level = levels_[index];
    std::call_once(level.built, [&] {
        try {
            build(index, level);
        } catch (...) {
            level.topology = {};  // so that the next call starts afresh
            throw;
        }
    });
    return level;
}

const SimplifiedSurface& BodySurface::coarse() const {
    const Level& fine = level(0);
    std::call_once(coarse_.built, [&] {
        coarse_.surface = simplify_surface(fine.topology, fine.positions, kCoarseVertices);
    });
    return coarse_.surface;
}

const BodyTopology& BodySurface::topology(uint32_t index) const {
    return index == kCoarseBody ? coarse().topology : level(index).topology;
}

void BodySurface::subdivide(uint32_t index, const std::vector<Vec3>& base, std::vector<Vec3>& out) const {
    if (base.size() != body_.vertex_count)
        fail(VFIT_ERROR_ARGUMENT, base.size(), " positions where the body has ", body_.vertex_count,
             " vertices");
    const uint32_t count = topology(index).vertex_count;
    if (index == 0) {
        out = base;
        return;
    }
    if (index == kCoarseBody) {
        out.clear();
        for (const uint32_t source : coarse().sources) out.push_back(base[source]);
        return;
    }
    if (index == 1) {
        out.resize(count);
        refine_smooth(levels_[0].to_next, base.data(), out.data());
        return;
    }
    // Level 1 lies for the moment behind level 2 in the same array, whose capacity stays for the next call.
    out.resize(count + levels_[1].topology.vertex_count);
    refine_smooth(levels_[0].to_next, base.data(), out.data() + count);
    refine_smooth(levels_[1].to_next, out.data() + count, out.data());
    out.resize(count);
}

}  // namespace vfit
