#include "fit/fit_raster.h"

#include <algorithm>
#include <cmath>

#include "core/wipe.h"

namespace vfit {

namespace {

constexpr float kNearest_m = 0.25f;   // of what is drawn
constexpr float kLeastCosine = 0.1f;  // of a visible vertex's normal to the line of sight
constexpr float kBefore_m = 0.06f;    // what lies this far before a vertex is another part of the body
constexpr float kBehind_m = 0.04f;    // a vertex this far behind the drawn surface is hidden
constexpr float kHiding_m = 0.05f;    // a reading this far before the model hides it
constexpr float kWorst_m = 0.10f;
constexpr size_t kBins = 256;  // of a millimetre

}  // namespace

void FitRaster::draw(const FitBody& body, const FitView& view) {
    const auto& positions = body.positions();
    projected_.resize(positions.size());
    for (size_t v = 0; v < positions.size(); ++v)
        if (positions[v].z >= kNearest_m) projected_[v] = view.project(positions[v]);
    const size_t cells = size_t(view.width()) * size_t(view.height());
    depths_.reserve(view.most_cells());
    depths_.assign(cells, 0.0f);
    const auto& triangles = body.model().triangles();
    for (size_t t = 0; t < triangles.size(); t += 3) {
        const uint32_t ia = triangles[t], ib = triangles[t + 1], ic = triangles[t + 2];
        const float za = positions[ia].z, zb = positions[ib].z, zc = positions[ic].z;
        if (za < kNearest_m || zb < kNearest_m || zc < kNearest_m) continue;
        const Vec2 a = projected_[ia], b = projected_[ib], c = projected_[ic];
        const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (area >= -1e-6f) continue;  // seen from behind (y points down), or edge-on
        const int x0 = std::max(0, int(std::ceil(std::min({a.x, b.x, c.x}))));
        const int y0 = std::max(0, int(std::ceil(std::min({a.y, b.y, c.y}))));
        const int x1 = std::min(view.width() - 1, int(std::floor(std::max({a.x, b.x, c.x}))));
        const int y1 = std::min(view.height() - 1, int(std::floor(std::max({a.y, b.y, c.y}))));
        const float scale = 1.0f / area;
        const float dbx = (b.y - c.y) * scale,
                    dcx = (c.y - a.y) * scale;  // of the weights of a and b along x
        for (int y = y0; y <= y1; ++y) {
            const float fy = float(y), fx = float(x0);
            float wa = ((b.x - fx) * (c.y - fy) - (b.y - fy) * (c.x - fx)) * scale;
            float wb = ((c.x - fx) * (a.y - fy) - (c.y - fy) * (a.x - fx)) * scale;
            float* row = depths_.data() + view.index(0, y);
            for (int x = x0; x <= x1; ++x, wa += dbx, wb += dcx) {
                const float wc = 1.0f - wa - wb;
                if (wa < 0.0f || wb < 0.0f || wc < 0.0f) continue;
                const float z = wa * za + wb * zb + wc * zc;
                if (row[x] == 0.0f || z < row[x]) row[x] = z;
            }
        }
    }
}

void FitRaster::wipe() {
    vfit::wipe(std::span(projected_));
    vfit::wipe(std::span(depths_));
}

FitScore FitRaster::score(const FitView& view) const {
    std::array<uint32_t, kBins + 1> histogram{};
    uint32_t both = 0, either = 0;
    float cost = 0.0f;
    for (int y = 0; y < view.height(); ++y)
        for (int x = 0; x < view.width(); ++x) {
            const float z = depths_[view.index(x, y)];
            const FitCell cell = view.cell(x, y);
            if (cell == FitCell::kPerson) {
                ++either;
                if (z == 0.0f) {
                    cost += 1.0f;
                    continue;
                }
                ++both;
                const float difference = std::abs(z - view.depth(x, y));
                cost += std::min(1.0f, difference / kWorst_m);
                ++histogram[std::min(kBins, size_t(difference * 1000.0f))];
            } else if (z > 0.0f && (cell == FitCell::kFree || view.depth(x, y) > z - kHiding_m)) {
                ++either;
                cost += 1.0f;
            }
        }
    FitScore out;
    if (either == 0) return out;
    out.cost = cost / float(either);
    out.iou = float(both) / float(either);
    out.cells = both;
    size_t bin = 0;
    for (uint32_t sum = histogram[0]; 2 * sum < both && bin < kBins; sum += histogram[bin]) ++bin;
    out.median_m = (float(bin) + 0.5f) * 0.001f;
    return out;
}

bool FitRaster::visible(const FitBody& body, const FitView& view, uint32_t vertex) const {
    const Vec3& p = body.positions()[vertex];
    if (p.z < kNearest_m) return false;
    const Vec3& n = body.normals()[vertex];
    if (glm::dot(n, p) > -kLeastCosine * glm::length(p)) return false;
    const Vec2 at = projected_[vertex];
    if (!(std::abs(at.x) < 1e6f && std::abs(at.y) < 1e6f)) return false;
    const int x = int(std::lround(at.x)), y = int(std::lround(at.y));
    if (!view.inside(x, y)) return false;
    const float z = depths_[view.index(x, y)];
    return z == 0.0f || p.z <= z + kBehind_m;
}

bool FitRaster::hidden(const FitBody& body, const FitView& view, uint32_t vertex) const {
    const Vec2 at = projected_[vertex];
    if (!(std::abs(at.x) < 1e6f && std::abs(at.y) < 1e6f)) return true;
    const int x = int(std::lround(at.x)), y = int(std::lround(at.y));
    for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u) {
            if (!view.inside(u, v)) continue;
            const float z = depths_[view.index(u, v)];
            if (z > 0.0f && z < body.positions()[vertex].z - kBefore_m) return true;
        }
    return false;
}

}  // namespace vfit
