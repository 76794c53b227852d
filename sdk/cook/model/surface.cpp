#include "cook/model/surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "core/error.h"
#include "geometry/borders.h"
#include "geometry/mesh_query.h"

namespace vfit {

namespace {

constexpr size_t kFewestTriangles = 50;
constexpr float kLeastArea_m2 = 1e-8f,
                kLeastHeight_m = 5e-5f;   // of a triangle: lengths are written to a hundredth of a millimetre
constexpr float kLeastOpening_m = 0.25f;  // around: no head, arm or foot goes through less
constexpr float kThick_m = 0.015f;

int whole_mm(float metres) { return int(std::lround(metres * 1000.0f)); }
std::string shown_cm(float metres) { return text(std::round(metres * 1000.0f) / 10.0f, " cm"); }

using Side = std::pair<uint32_t, uint32_t>;

class SurfaceMaker {
public:
    SurfaceMaker(const Pieces& pieces, const Piece& piece, float hole_m)
        : model_(*pieces.model),
          uvs_(pieces.uvs),
          places_(pieces.places),
          triangles_(piece.triangles),
          hole_m_(hole_m) {}

    Surface run() {
        check_triangles();
        check_shells();
        close_holes();
        return write();
    }

private:
    std::string name_of(const ModelTriangle& t) const { return model_.name_of(t.face); }
    std::vector<uint32_t> indices() const {
        std::vector<uint32_t> out;
        for (const ModelTriangle& t : triangles_) out.insert(out.end(), t.vertex.begin(), t.vertex.end());
        return out;
    }

    void check_triangles() const {
        if (triangles_.size() < kFewestTriangles)
            fail(VFIT_ERROR_DATA, "the mesh has ", triangles_.size(), " triangles, cloth at least ",
                 kFewestTriangles, ": it is too coarse to fold");
        for (const ModelTriangle& t : triangles_) {
            const Vec3 &a = places_[t.vertex[0]], &b = places_[t.vertex[1]], &c = places_[t.vertex[2]];
            const float area = 0.5f * glm::length(glm::cross(b - a, c - a)),
                        longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
            if (!(area >= kLeastArea_m2) || 2.0f * area / longest < kLeastHeight_m)
                fail(VFIT_ERROR_DATA, name_of(t), " at ", shown(a),
                     " is degenerate: its corners lie on a line of ", whole_mm(longest), " mm");
        }
    }

    /// Of each side, in both directions, the triangle beside it and where in it the side begins.
    std::map<Side, uint32_t> sides() const {
        std::map<Side, uint32_t> out;
        for (uint32_t t = 0; t < triangles_.size(); ++t)
            for (uint32_t k = 0; k < 3; ++k)
                out[{triangles_[t].vertex[k], triangles_[t].vertex[(k + 1) % 3]}] = 3 * t + k;
        return out;
    }

    /// Two sheets of one surface that face away from each other, closer than any cloth hangs.
    void check_shells() const {
        const std::vector<uint32_t> all_indices = indices();
        const bool closed = borders(all_indices).empty();
        const MeshQuery cloth(places_, all_indices);
        double doubled = 0.0, all = 0.0, thickness = 0.0;
        for (size_t t = 0; t < triangles_.size(); ++t) {
            const auto& v = triangles_[t].vertex;
            const Vec3 middle = (places_[v[0]] + places_[v[1]] + places_[v[2]]) / 3.0f;
            const Vec3 normal =
                glm::normalize(glm::cross(places_[v[1]] - places_[v[0]], places_[v[2]] - places_[v[0]]));
            const float area = area_of(places_, triangles_[t]);
            all += area;
            constexpr float kOff_m = 1e-4f, kOpposite = -0.7f;
            for (const float way : {-1.0f, 1.0f}) {
                const auto hit = cloth.cast(middle + normal * (way * kOff_m), normal * way, kThick_m);
                if (!hit || glm::dot(hit->normal, normal) > kOpposite) continue;
                doubled += area, thickness += area * hit->distance;
                break;
            }
        }
        const double share = closed ? 0.6 : 0.9;
        if (doubled > share * all)
            fail(VFIT_ERROR_DATA,
                 "the garment is modelled with thickness: its cloth is two layers that face away from each "
                 "other, ",
                 whole_mm(float(thickness / doubled)), " mm apart; give the outer shell alone");
        if (closed)
            fail(VFIT_ERROR_DATA,
                 "the mesh has no opening: it is closed all around, and no body gets in (of cloth that is "
                 "modelled with thickness, give the outer shell alone)");
    }

    void close_holes() {
        const auto loops = borders(indices());
        size_t closed = 0, left = 0;
        float longest = 0.0f;
        std::string lengths;
        const auto sides_of = sides();
        for (const auto& loop : loops) {
            const float length = length_around(places_, loop);
            longest = std::max(longest, length);
            if (length >= hole_m_) continue;
            if (!close_hole(loop, sides_of)) {
                ++left;
                continue;
            }
            ++closed;
            constexpr size_t kMostNamed = 8;
            if (closed <= kMostNamed)
                lengths += (closed > 1 ? ", " : "") + std::to_string(whole_mm(length));
            else if (closed == kMostNamed + 1)
                lengths += ", ...";
        }
        if (closed > 0)
            notes_.push_back(text(closed, " holes of less than ", whole_mm(hole_m_),
                                  " mm around were closed (", lengths, " mm)"));
        if (left > 0)
            notes_.push_back(text(left, " slits of less than ", whole_mm(hole_m_), " mm around stay open"));
        if (longest < kLeastOpening_m)
            fail(VFIT_ERROR_DATA, "the mesh has no opening for a body: of its ", loops.size(),
                 " holes the largest is ", shown_cm(longest), " around, and ", shown_cm(kLeastOpening_m),
                 " are the least");
    }

    /// By a fan about its middle. False where that would have triangles without an area.
    bool close_hole(const std::vector<uint32_t>& loop, const std::map<Side, uint32_t>& sides) {
        if (std::set<uint32_t>(loop.begin(), loop.end()).size() < loop.size()) return false;  // of two holes
        Vec3 middle(0.0f);
        for (const uint32_t v : loop) middle += places_[v] / float(loop.size());
        Vec2 uv(0.0f);
        bool has_uv = true;
        std::vector<ModelTriangle> fan;
        const auto center = uint32_t(places_.size()), center_uv = uint32_t(uvs_.size());
        for (size_t i = 0; i < loop.size(); ++i) {
            const uint32_t a = loop[i], b = loop[(i + 1) % loop.size()], at = sides.at({a, b});
            const ModelTriangle& t = triangles_[at / 3];
            const uint32_t uv_a = t.uv[at % 3], uv_b = t.uv[(at % 3 + 1) % 3];
            if (uv_a == kNoUv || uv_b == kNoUv)
                has_uv = false;
            else
                uv += uvs_[uv_a] / float(loop.size());
            const Vec3 normal = glm::cross(places_[a] - places_[b], middle - places_[b]);
            if (0.5f * glm::length(normal) < kLeastArea_m2 ||
                glm::length(normal) < kLeastHeight_m * std::max({glm::length(places_[a] - places_[b]),
                                                                 glm::length(middle - places_[a]),
                                                                 glm::length(middle - places_[b])}))
                return false;
            fan.push_back({{b, a, center}, {uv_b, uv_a, center_uv}, t.face});
        }
        places_.push_back(middle);
        uvs_.push_back(has_uv ? uv : Vec2(0.0f));
        triangles_.insert(triangles_.end(), fan.begin(), fan.end());
        return true;
    }

    Surface write() {
        std::stable_sort(triangles_.begin(), triangles_.end(),
                         [&](const ModelTriangle& a, const ModelTriangle& b) {
                             return model_.faces[a.face].material < model_.faces[b.face].material;
                         });
        Surface out;
        std::vector<uint32_t> number(places_.size(), UINT32_MAX);
        for (const ModelTriangle& t : triangles_)
            for (const uint32_t v : t.vertex) {
                if (number[v] == UINT32_MAX)
                    number[v] = uint32_t(out.positions.size()), out.positions.push_back(places_[v]);
                out.indices.push_back(number[v]);
            }
        const auto count = uint32_t(out.positions.size());
        out.uvs.assign(count, Vec2(0.0f));
        std::vector<uint8_t> known(count, 0);
        std::map<std::tuple<uint32_t, uint32_t, uint32_t>, uint32_t> drawn;  // by vertex and uv
        for (size_t i = 0; i < out.indices.size(); ++i) {
            const uint32_t v = out.indices[i], t = triangles_[i / 3].uv[i % 3];
            const Vec2 uv = t == kNoUv ? Vec2(0.0f) : uvs_[t];
            const auto [it, fresh] =
                drawn.try_emplace({v, std::bit_cast<uint32_t>(uv.x), std::bit_cast<uint32_t>(uv.y)}, v);
            if (fresh && known[v]) {
                it->second = count + uint32_t(out.copies.size());
                out.copies.push_back(v);
                out.uvs.push_back(uv);
            } else if (fresh) {
                known[v] = 1;
                out.uvs[v] = uv;
            }
            out.corners.push_back(it->second);
        }
        out.parts = parts_of(model_, triangles_);
        out.openings = borders(out.indices);
        std::stable_sort(out.openings.begin(), out.openings.end(),
                         [&](const auto& a, const auto& b) { return out.length_of(a) > out.length_of(b); });
        out.notes = std::move(notes_);
        return out;
    }

    const Model& model_;
    std::vector<Vec2> uvs_;
    std::vector<Vec3> places_;
    std::vector<ModelTriangle> triangles_;
    float hole_m_;
    std::vector<std::string> notes_;
};

}  // namespace

std::vector<GarmentPart> parts_of(const Model& model, const std::vector<ModelTriangle>& triangles) {
    std::vector<GarmentPart> out;
    if (model.materials.empty()) return out;
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        const uint32_t m = model.faces[triangles[t].face].material;
        if (t == 0 || m != model.faces[triangles[t - 1].face].material) {
            const ModelMaterial material =
                m < model.materials.size() ? model.materials[m] : ModelMaterial{"cloth", "", Vec3(0.8f)};
            out.push_back({material.name, material.texture, material.color, t, 0});
        }
        ++out.back().triangle_count;
    }
    return out;
}

float Surface::length_of(const std::vector<uint32_t>& opening) const {
    return length_around(positions, opening);
}

Surface make_surface(const Pieces& pieces, const Piece& piece, float hole_m) {
    return SurfaceMaker(pieces, piece, hole_m).run();
}

}  // namespace vfit
