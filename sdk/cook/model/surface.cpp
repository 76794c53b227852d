#include "cook/model/surface.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <unordered_map>

#include "cook/mesh/triangulation.h"
#include "core/error.h"
#include "geometry/borders.h"
#include "geometry/mesh_query.h"
#include "math/finite.h"

namespace vfit {

namespace {

constexpr float kSmallest_m = 0.1f, kLargest_m = 3.0f;  // garments, from a baby's sock to a train
constexpr float kOnePlace_m = 1e-4f;                    // closer than that, vertices are one
constexpr size_t kMostVertices = 60000, kFewestTriangles = 50;
constexpr float kLeastArea_m2 = 1e-8f,
                kLeastHeight_m = 5e-5f;  // of a triangle: lengths are written to a hundredth of a millimetre
constexpr float kButtonShare =
    0.05f;                        // of the garment's area: a piece smaller than that is no cloth of its own
constexpr float kHole_m = 0.03f;  // around: smaller ones are buttonholes, eyelets and slips of the modeller
constexpr float kLeastOpening_m = 0.25f;  // around: no head, arm or foot goes through less
constexpr float kThick_m = 0.015f, kShellsApart_m = 0.025f;

std::string shown(const Vec3& p) {
    const auto rounded = [](float x) { return std::round(x * 1000.0f) / 1000.0f; };
    return text("(", rounded(p.x), ", ", rounded(p.y), ", ", rounded(p.z), ")");
}
int whole_mm(float metres) { return int(std::lround(metres * 1000.0f)); }
std::string shown_cm(float metres) { return text(std::round(metres * 1000.0f) / 10.0f, " cm"); }

void check_size(const Model& model, float unit_m) {
    Vec3 low(INFINITY), high(-INFINITY);
    for (const ModelCorner& corner : model.corners)
        low = glm::min(low, model.positions[corner.position]),
        high = glm::max(high, model.positions[corner.position]);
    const Vec3 size = high - low;
    const float largest = std::max({size.x, size.y, size.z});
    const auto fits = [&](float unit) {
        return largest * unit >= kSmallest_m && largest * unit <= kLargest_m;
    };
    if (!fits(unit_m)) {
        const std::string is = text("the mesh is ", largest * unit_m, " m large, and garments are ",
                                    kSmallest_m, " to ", kLargest_m, " m: ");
        for (const auto& [unit, name, option] :
             {std::tuple(1.0f, "metres", "m"), std::tuple(0.01f, "centimetres", "cm"),
              std::tuple(0.001f, "millimetres", "mm")})
            if (fits(unit))
                fail(VFIT_ERROR_DATA, is, "the numbers look like ", name, " (of an OBJ file: --unit ", option,
                     "; glTF counts in metres)");
        fail(VFIT_ERROR_DATA, is, "the numbers fit neither metres nor centimetres nor millimetres");
    }
    low *= unit_m, high *= unit_m;
    // Generous: bodies are of many heights, and the garment is moved up or down to ours.
    constexpr float kAside_m = 0.5f, kTrain_m = 0.8f, kBelow_m = -1.0f, kAbove_m = 3.0f, kLying_m = 0.4f;
    const Vec3 middle = 0.5f * (low + high);
    if (middle.z > kLying_m && std::abs(middle.y) < kLying_m && std::abs(middle.x) < kAside_m)
        fail(VFIT_ERROR_DATA, "the mesh lies before the body, from ", low.z, " to ", high.z,
             " m along Z: it was written with Z up, and Y has to be");
    if (std::abs(middle.x) > kAside_m || std::abs(middle.z) > kTrain_m || high.y < kBelow_m ||
        low.y > kAbove_m)
        fail(VFIT_ERROR_DATA, "the mesh is about ", shown(middle),
             " m: it has to stand around a body whose soles are at (0, 0, 0), Y up, facing +Z");
}

/// Vertices at one place by a grid of cells as large as the tolerance.
class Weld {
public:
    uint32_t add(const Vec3& p, std::vector<Vec3>& places) {
        const std::array<int64_t, 3> cell = {int64_t(std::floor(p.x / kOnePlace_m)),
                                             int64_t(std::floor(p.y / kOnePlace_m)),
                                             int64_t(std::floor(p.z / kOnePlace_m))};
        for (int64_t x = -1; x <= 1; ++x)
            for (int64_t y = -1; y <= 1; ++y)
                for (int64_t z = -1; z <= 1; ++z) {
                    const auto found = cells_.find(key(cell[0] + x, cell[1] + y, cell[2] + z));
                    if (found == cells_.end()) continue;
                    for (const uint32_t v : found->second)
                        if (glm::length(places[v] - p) <= kOnePlace_m) return v;
                }
        const auto v = uint32_t(places.size());
        places.push_back(p);
        cells_[key(cell[0], cell[1], cell[2])].push_back(v);
        return v;
    }

private:
    static uint64_t key(int64_t x, int64_t y, int64_t z) {
        constexpr uint64_t kMask = (1u << 21) - 1;  // places are within 100 m
        return (uint64_t(x) & kMask) << 42 | (uint64_t(y) & kMask) << 21 | (uint64_t(z) & kMask);
    }
    std::unordered_map<uint64_t, std::vector<uint32_t>> cells_;
};

struct ModelTriangle {
    std::array<uint32_t, 3> vertex, uv;
    uint32_t face;
};

using Side = std::pair<uint32_t, uint32_t>;

class SurfaceMaker {
public:
    SurfaceMaker(const Model& model, float unit_m) : model_(model), unit_m_(unit_m), uvs_(model.uvs) {}

    Surface run() {
        check_size(model_, unit_m_);
        weld();
        cut_polygons();
        leave_out_copies();
        turn_alike();
        leave_out_pieces();
        check_triangles();
        check_shells();
        close_holes();
        return write();
    }

private:
    std::string name_of(const ModelTriangle& t) const { return model_.name_of(t.face); }

    void weld() {
        // A tenth of a millimetre decides: where a model is a grain of dust, all of it is one place.
        Weld weld;
        vertex_of_.assign(model_.positions.size(), UINT32_MAX);
        for (const ModelCorner& corner : model_.corners) {
            uint32_t& v = vertex_of_[corner.position];
            if (v == UINT32_MAX) v = weld.add(model_.positions[corner.position] * unit_m_, places_);
            if (places_.size() > kMostVertices) {
                std::set<uint32_t> used;
                for (const ModelCorner& c : model_.corners) used.insert(c.position);
                fail(VFIT_ERROR_DATA, "the mesh has ", used.size(), " vertices, a garment at most ",
                     kMostVertices, " at places of their own: make it coarser");
            }
        }
    }

    void cut_polygons() {
        for (uint32_t f = 0; f < model_.faces.size(); ++f) {
            const ModelFace& face = model_.faces[f];
            std::vector<ModelCorner> corners;
            for (uint32_t i = 0; i < face.corner_count; ++i) {
                const ModelCorner& corner = model_.corners[face.first_corner + i];
                const uint32_t v = vertex_of_[corner.position];
                if (corners.empty() || corners.back().position != v) corners.push_back({v, corner.uv});
            }
            while (corners.size() > 1 && corners.front().position == corners.back().position)
                corners.pop_back();
            if (corners.size() < 3) {
                if (collapsed_++ == 0) first_collapsed_ = f;
                continue;
            }
            for (const auto& t : corners.size() == 3 ? Triangles{{0, 1, 2}} : cut_polygon(corners, f))
                triangles_.push_back(
                    {{corners[t[0]].position, corners[t[1]].position, corners[t[2]].position},
                     {corners[t[0]].uv, corners[t[1]].uv, corners[t[2]].uv},
                     f});
        }
        if (collapsed_ > 0)
            notes_.push_back(text(
                collapsed_, " faces are left out whose corners lie at one place or two, the first of them ",
                model_.name_of(first_collapsed_)));
    }

    Triangles cut_polygon(const std::vector<ModelCorner>& corners, uint32_t face) const {
        Vec3 normal(0.0f), middle(0.0f);  // Newell's normal: of any polygon
        const size_t count = corners.size();
        for (size_t i = 0; i < count; ++i) {
            const Vec3 &a = places_[corners[i].position], &b = places_[corners[(i + 1) % count].position];
            normal += glm::cross(a - places_[corners[0].position], b - places_[corners[0].position]);
            middle += a / float(count);
        }
        const float area2 = glm::length(normal);
        if (!(area2 > kLeastArea_m2))
            fail(VFIT_ERROR_DATA, model_.name_of(face),
                 " has no area: its corners lie on a line, or it crosses itself");
        normal /= area2;
        const Vec3 across = glm::normalize(std::abs(normal.x) < 0.8f ? glm::cross(normal, Vec3(1, 0, 0))
                                                                     : glm::cross(normal, Vec3(0, 1, 0)));
        const Vec3 up = glm::cross(normal, across);
        std::vector<Vec2> flat;
        float off = 0.0f, size = 0.0f;
        for (const ModelCorner& corner : corners) {
            const Vec3 p = places_[corner.position] - middle;
            flat.emplace_back(glm::dot(p, across), glm::dot(p, up));
            off = std::max(off, std::abs(glm::dot(p, normal)));
            size = std::max(size, glm::length(p));
        }
        // A square may be bent; where a polygon of many corners is, how it is cut would be up to us.
        constexpr float kOffPlane = 0.25f;
        if (count > 4 && off > kOffPlane * size)
            fail(VFIT_ERROR_DATA, model_.name_of(face), " has ", count,
                 " corners that are not in a plane: cut it into triangles");
        const auto refuse = [&] {
            fail(VFIT_ERROR_DATA, model_.name_of(face),
                 " crosses itself or comes to one corner twice (around a hole?): cut it into triangles");
        };
        Triangles triangles;
        try {
            triangles = triangulate(flat, uint32_t(count));
        } catch (const Error&) {
            refuse();
        }
        // Of a line that crosses itself some parts count against others.
        float sum2 = 0.0f;
        for (const auto& t : triangles) {
            const Vec2 a = flat[t[1]] - flat[t[0]], b = flat[t[2]] - flat[t[0]];
            sum2 += a.x * b.y - a.y * b.x;
        }
        constexpr float kSame = 1e-3f;
        if (triangles.size() != count - 2 || std::abs(sum2 - area2) > kSame * area2) refuse();
        return triangles;
    }

    /// Models with two sides have each triangle twice.
    void leave_out_copies() {
        std::set<std::array<uint32_t, 3>> known;
        size_t copies = 0;
        std::vector<ModelTriangle> kept;
        for (const ModelTriangle& t : triangles_) {
            std::array<uint32_t, 3> sorted = t.vertex;
            std::sort(sorted.begin(), sorted.end());
            if (sorted[0] == sorted[1] || sorted[1] == sorted[2])
                fail(VFIT_ERROR_DATA, name_of(t), " comes to one corner twice: cut it into triangles");
            if (known.insert(sorted).second)
                kept.push_back(t);
            else
                ++copies;
        }
        triangles_ = std::move(kept);
        if (triangles_.size() > 3 * kMostVertices)
            fail(VFIT_ERROR_DATA, "the mesh has ", triangles_.size(), " triangles, a garment at most ",
                 3 * kMostVertices, ": make it coarser");
        if (copies > 0) notes_.push_back(text(copies, " triangles are left out that are there twice"));
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

    /// Neighbours run along their common side in opposite directions; pieces_ becomes the piece of each
    /// triangle.
    void turn_alike() {
        std::map<Side, std::vector<uint32_t>> beside;  // by its lower and higher end; triangles
        for (uint32_t t = 0; t < triangles_.size(); ++t)
            for (uint32_t k = 0; k < 3; ++k)
                beside[std::minmax(triangles_[t].vertex[k], triangles_[t].vertex[(k + 1) % 3])].push_back(t);
        for (const auto& [side, list] : beside) {
            if (list.size() < 3) continue;
            std::string names;
            for (size_t i = 0; i < std::min<size_t>(list.size(), 4); ++i)
                names += (i > 0 ? ", " : "") + name_of(triangles_[list[i]]);
            fail(VFIT_ERROR_DATA, "the side from ", shown(places_[side.first]), " to ",
                 shown(places_[side.second]), " is of ", list.size(), " triangles (", names,
                 "): cloth has two beside a side; part what is joined there");
        }
        const auto runs = [&](uint32_t t, const Side& side) {
            for (size_t k = 0; k < 3; ++k)
                if (triangles_[t].vertex[k] == side.first && triangles_[t].vertex[(k + 1) % 3] == side.second)
                    return true;
            return false;
        };
        pieces_.assign(triangles_.size(), UINT32_MAX);
        std::vector<uint8_t> turned(triangles_.size(), 0);
        size_t mended = 0;
        for (uint32_t first = 0; first < triangles_.size(); ++first) {
            if (pieces_[first] != UINT32_MAX) continue;
            std::vector<uint32_t> piece{first};
            pieces_[first] = piece_count_;
            size_t turned_over = 0;
            for (size_t i = 0; i < piece.size(); ++i) {
                const uint32_t t = piece[i];
                for (size_t k = 0; k < 3; ++k) {
                    const Side side = std::minmax(triangles_[t].vertex[k], triangles_[t].vertex[(k + 1) % 3]);
                    for (const uint32_t other : beside[side]) {
                        if (other == t) continue;
                        const bool wanted = turned[t] != uint8_t(runs(t, side) == runs(other, side));
                        if (pieces_[other] == UINT32_MAX) {
                            pieces_[other] = piece_count_;
                            turned[other] = wanted;
                            turned_over += wanted;
                            piece.push_back(other);
                        } else if (bool(turned[other]) != wanted) {
                            fail(VFIT_ERROR_DATA, "the cloth has no outside: around the side from ",
                                 shown(places_[side.first]), " to ", shown(places_[side.second]), " (",
                                 name_of(triangles_[t]), " and ", name_of(triangles_[other]),
                                 ") its outside becomes its inside");
                        }
                    }
                }
            }
            // As most of them were.
            const bool other_way = 2 * turned_over > piece.size();
            for (const uint32_t t : piece) turned[t] = uint8_t(bool(turned[t]) != other_way);
            mended += other_way ? piece.size() - turned_over : turned_over;
            ++piece_count_;
        }
        for (uint32_t t = 0; t < triangles_.size(); ++t) {
            if (!turned[t]) continue;
            std::swap(triangles_[t].vertex[1], triangles_[t].vertex[2]);
            std::swap(triangles_[t].uv[1], triangles_[t].uv[2]);
        }
        if (mended > 0)
            notes_.push_back(
                text(mended, " triangles were turned the other way round, as those beside them are"));
    }

    std::vector<Vec3> middles_of(uint32_t piece) const {
        std::vector<Vec3> out;
        for (size_t t = 0; t < triangles_.size(); ++t)
            if (pieces_[t] == piece)
                out.push_back((places_[triangles_[t].vertex[0]] + places_[triangles_[t].vertex[1]] +
                               places_[triangles_[t].vertex[2]]) /
                              3.0f);
        return out;
    }
    std::vector<uint32_t> indices_of(uint32_t piece) const {
        std::vector<uint32_t> out;
        for (size_t t = 0; t < triangles_.size(); ++t)
            if (pieces_[t] == piece)
                out.insert(out.end(), triangles_[t].vertex.begin(), triangles_[t].vertex.end());
        return out;
    }
    float area_of(size_t t) const {
        const auto& v = triangles_[t].vertex;
        return 0.5f * glm::length(glm::cross(places_[v[1]] - places_[v[0]], places_[v[2]] - places_[v[0]]));
    }

    /// The largest stays.
    void leave_out_pieces() {
        if (piece_count_ == 0) return;
        std::vector<float> areas(piece_count_, 0.0f);
        std::vector<size_t> counts(piece_count_, 0), example(piece_count_, 0);
        for (size_t t = 0; t < triangles_.size(); ++t)
            areas[pieces_[t]] += area_of(t), ++counts[pieces_[t]], example[pieces_[t]] = t;
        const auto main = uint32_t(std::max_element(areas.begin(), areas.end()) - areas.begin());
        std::optional<MeshQuery> cloth;
        size_t left_out = 0, left_out_triangles = 0;
        std::set<std::string> materials;
        for (uint32_t piece = 0; piece < piece_count_; ++piece) {
            if (piece == main) continue;
            if (areas[piece] < kButtonShare * areas[main]) {
                ++left_out, left_out_triangles += counts[piece];
                materials.insert(model_.material_of(triangles_[example[piece]].face));
                continue;
            }
            if (!cloth) cloth.emplace(places_, indices_of(main));
            refuse_piece(*cloth, piece, counts[piece]);
        }
        if (left_out == 0) return;
        std::string names;
        for (const std::string& name : materials)
            if (!name.empty()) names += (names.empty() ? " of material \"" : ", \"") + name + "\"";
        notes_.push_back(text(left_out, " pieces (", left_out_triangles, " triangles", names,
                              ") are left out: they are not joined to the garment, and each is smaller than ",
                              int(kButtonShare * 100), " % of it"));
        std::vector<ModelTriangle> kept;
        for (size_t t = 0; t < triangles_.size(); ++t)
            if (pieces_[t] == main) kept.push_back(triangles_[t]);
        triangles_ = std::move(kept);
    }

    [[noreturn]] void refuse_piece(const MeshQuery& cloth, uint32_t piece, size_t count) const {
        size_t near = 0, all = 0;
        double sum = 0.0;
        float nearest = INFINITY;
        for (const Vec3& p : middles_of(piece)) {
            const float distance = cloth.closest(p).distance;
            near += distance < kShellsApart_m, ++all, sum += distance;
        }
        const std::vector<uint32_t> corners = indices_of(piece);
        for (const uint32_t v : corners) nearest = std::min(nearest, cloth.closest(places_[v]).distance);
        if (10 * near > 8 * all)
            fail(VFIT_ERROR_DATA, "the garment is modelled with thickness: there are two shells, ",
                 whole_mm(float(sum / double(all))), " mm apart; give the outer shell alone");
        const uint32_t face =
            triangles_[size_t(std::find(pieces_.begin(), pieces_.end(), piece) - pieces_.begin())].face;
        const std::string material = model_.material_of(face);
        fail(VFIT_ERROR_DATA, "the garment is in pieces: ", count, " triangles",
             material.empty() ? "" : " of material \"" + material + "\"", " (", model_.name_of(face),
             ") are not joined to the others, ", std::round(nearest * 10000.0f) / 10.0f,
             " mm away; join them by common vertices, or give each piece as a garment");
    }
    std::vector<uint32_t> indices() const {
        std::vector<uint32_t> out;
        for (const ModelTriangle& t : triangles_) out.insert(out.end(), t.vertex.begin(), t.vertex.end());
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
            const float area = area_of(t);
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
            if (length >= kHole_m) continue;
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
            notes_.push_back(text(closed, " holes of less than ", whole_mm(kHole_m),
                                  " mm around were closed (", lengths, " mm)"));
        if (left > 0)
            notes_.push_back(text(left, " slits of less than ", whole_mm(kHole_m), " mm around stay open"));
        if (longest < kLeastOpening_m)
            fail(VFIT_ERROR_DATA, "the mesh has no opening for a body: of its ", loops.size(),
                 " holes the largest is ", shown_cm(longest), " around, and ", shown_cm(kLeastOpening_m),
                 " are the least");
    }

    /// By a fan about its middle. False where that would have triangles without an area.
    bool close_hole(const std::vector<uint32_t>& loop, const std::map<Side, uint32_t>& sides) {
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
        if (!model_.materials.empty()) write_parts(out);
        out.openings = borders(out.indices);
        std::stable_sort(out.openings.begin(), out.openings.end(),
                         [&](const auto& a, const auto& b) { return out.length_of(a) > out.length_of(b); });
        out.notes = std::move(notes_);
        return out;
    }

    void write_parts(Surface& out) const {
        for (uint32_t t = 0; t < triangles_.size(); ++t) {
            const uint32_t m = model_.faces[triangles_[t].face].material;
            if (t == 0 || m != model_.faces[triangles_[t - 1].face].material) {
                const ModelMaterial material = m < model_.materials.size()
                                                   ? model_.materials[m]
                                                   : ModelMaterial{"cloth", "", Vec3(0.8f)};
                out.parts.push_back({material.name, material.texture, material.color, t, 0});
            }
            ++out.parts.back().triangle_count;
        }
    }

    const Model& model_;
    float unit_m_;
    std::vector<Vec2> uvs_;
    std::vector<Vec3> places_;
    std::vector<uint32_t> vertex_of_;  // of each of the model's positions
    std::vector<ModelTriangle> triangles_;
    std::vector<uint32_t> pieces_;
    uint32_t piece_count_ = 0;
    size_t collapsed_ = 0, first_collapsed_ = 0;
    std::vector<std::string> notes_;
};

}  // namespace

float Surface::length_of(const std::vector<uint32_t>& opening) const {
    return length_around(positions, opening);
}

Surface make_surface(const Model& model, float unit_m) { return SurfaceMaker(model, unit_m).run(); }

}  // namespace vfit
