#include "cloth/garment/bound_garment.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cloth/garment/borders.h"
#include "core/error.h"

namespace vfit {

namespace {

void check(const Garment& garment, const BoundBody& body) {
    const size_t n = body.positions.size();
    if (n == 0 || body.skin_bones.size() < n || body.skin_weights.size() < n ||
        (!body.parts.empty() && body.parts.size() < n))
        fail(VFIT_ERROR_ARGUMENT, "garment ", garment.name, ": the body's skin has too few vertices");
    for (uint32_t i : body.indices)
        if (i >= n)
            fail(VFIT_ERROR_ARGUMENT, "garment ", garment.name, ": the body's triangles name no such vertex");
}

/// Weights of all bones, one row a vertex.
struct Table {
    size_t width;
    std::vector<float> values;

    Table(size_t rows, size_t columns) : width(columns), values(rows * columns, 0.0f) {}
    std::span<float> row(size_t i) { return {values.data() + i * width, width}; }
    size_t rows() const { return values.size() / width; }

    std::vector<size_t> columns_in_use() {
        std::vector<size_t> used;
        for (size_t k = 0; k < width; ++k) {
            bool any = false;
            for (size_t i = k; i < values.size() && !any; i += width) any = values[i] != 0.0f;
            if (any) used.push_back(k);
        }
        return used;
    }
};

void smooth(const HangingSmoother& smoother, Table& table, Jobs* jobs) {
    constexpr size_t kColumns = 8;                               // at a time: a register
    const std::vector<size_t> columns = table.columns_in_use();  // of the body's bones a dress has a fourth
    parallel_for(jobs, uint32_t((columns.size() + kColumns - 1) / kColumns), [&](uint32_t at) {
        const std::span<const size_t> some =
            std::span(columns).subspan(at * kColumns, std::min(kColumns, columns.size() - at * kColumns));
        std::vector<std::array<float, kColumns>> rows(table.rows(), std::array<float, kColumns>{});
        for (size_t i = 0; i < rows.size(); ++i)
            for (size_t k = 0; k < some.size(); ++k) rows[i][k] = table.row(i)[some[k]];
        smoother.smooth(rows);
        for (size_t i = 0; i < rows.size(); ++i)
            for (size_t k = 0; k < some.size(); ++k) table.row(i)[some[k]] = rows[i][k];
    });
}

}  // namespace

size_t BoundBody::bone_count() const {
    size_t count = 0;
    for (const SkinBones& list : skin_bones)
        for (const uint16_t bone : list) count = std::max(count, size_t(bone) + 1);
    return count;
}

std::vector<uint32_t> BoundBody::bindable_triangles(bool with_arms) const {
    if (parts.empty()) return {indices.begin(), indices.end()};
    const auto is_kept = [&](uint32_t v) {
        const BodyPart part = parts[v];
        return with_arms ? part != BodyPart::kLeftHand && part != BodyPart::kRightHand : !is_arm(part);
    };
    std::vector<uint32_t> kept;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        const uint32_t* v = &indices[i];
        if (is_kept(v[0]) && is_kept(v[1]) && is_kept(v[2])) kept.insert(kept.end(), v, v + 3);
    }
    return kept;
}

Binding Binding::of(const MeshQuery::Closest& closest, std::span<const uint32_t> triangles) {
    const uint32_t* v = &triangles[closest.triangle * 3];
    return {{v[0], v[1], v[2]}, {1.0f - closest.uv.x - closest.uv.y, closest.uv.x, closest.uv.y}};
}

void Binding::add_bones(const BoundBody& body, std::span<float> bones) const {
    for (int k = 0; k < 3; ++k)
        for (size_t j = 0; j < kSkinBones; ++j)
            bones[body.skin_bones[corner[k]][j]] += body.skin_weights[corner[k]][j] * weight[k];
}

HangingSmoother::HangingSmoother(const Garment& garment, std::span<const float> skin_distances) {
    constexpr float kCloseToSkin_m =
        0.02f;  // a common ease: closer than that, cloth goes where its skin goes
    std::vector<std::vector<uint32_t>> neighbours(garment.vertex_count());
    const std::vector<uint32_t>& indices = garment.mesh.indices;
    for (uint32_t corner = 0; corner < indices.size() / 3 * 3; ++corner) {
        const uint32_t a = indices[corner], b = indices[next_corner(corner)];
        neighbours[a].push_back(b), neighbours[b].push_back(a);
    }
    for (uint32_t v = 0; v < neighbours.size(); ++v) {
        std::vector<uint32_t>& list = neighbours[v];
        if (!garment.simulated[v] || list.empty()) continue;
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        const float kept = std::exp(-skin_distances[v] / kCloseToSkin_m);
        const auto first = uint32_t(neighbours_.size());
        neighbours_.insert(neighbours_.end(), list.begin(), list.end());
        hanging_.push_back(
            {v, first, uint32_t(neighbours_.size()), kept, (1.0f - kept) / float(list.size())});
    }
}

BoundGarment::BoundGarment(const Garment& garment, const BoundBody& body, Jobs* jobs) {
    check(garment, body);
    const uint32_t n = garment.vertex_count();
    const std::vector<uint32_t> triangles = body.bindable_triangles(false),
                                with_arms = body.bindable_triangles(true);
    const bool sleeves = garment.has_sleeves();
    const MeshQuery skin(body.positions, triangles);
    std::optional<MeshQuery> skin_of_arms;
    if (sleeves) skin_of_arms.emplace(body.positions, with_arms);

    Table bones(n, body.bone_count());
    std::vector<float> skin_distances(n);
    body_vertices = body.positions.size();
    bindings.resize(n);
    parts_below.assign(n, BodyPart::kTorso);
    parallel_for_vertices(jobs, n, [&](uint32_t i) {
        const bool arm = sleeves && garment.on_arm[i];
        const MeshQuery::Closest closest = (arm ? *skin_of_arms : skin).closest(garment.mesh.positions[i]);
        skin_distances[i] = closest.distance;
        bindings[i] = Binding::of(closest, arm ? with_arms : triangles);
        if (!body.parts.empty()) parts_below[i] = body.parts[bindings[i].corner[0]];
        bindings[i].add_bones(body, bones.row(i));
    });
    smoother.emplace(garment, skin_distances);
    smooth(*smoother, bones, jobs);
    for (uint32_t i = 0; i < n; ++i) skin_below.add(bindings[i].on(body.positions), bones.row(i));
}

}  // namespace vfit
