#include "cook/model/pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "cook/mesh/triangulation.h"
#include "core/error.h"
#include "geometry/borders.h"

namespace vfit {

namespace {

constexpr float kOnePlace_m = 1e-4f;      // closer than that, vertices are one
constexpr float kFarFromOrigin_m = 1e6f;  // no garment lies there, and cells could not be counted
constexpr size_t kMaxTriangles = 500000;
constexpr float kLeastArea_m2 = 1e-8f;

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

using Side = std::pair<uint32_t, uint32_t>;

class SoupMaker {
public:
    SoupMaker(const Model& model, float unit_m) : model_(model), unit_m_(unit_m) {}

    Soup run() {
        weld();
        cut_polygons();
        leave_out_copies();
        if (collapsed_ > 0)
            notes_.push_back(text(
                collapsed_, " faces are left out whose corners lie at one place or two, the first of them ",
                model_.name_of(first_collapsed_)));
        if (triangles_.empty()) fail(VFIT_ERROR_DATA, "the mesh has no triangle with an area");
        return {&model_, unit_m_, std::move(places_), std::move(triangles_), std::move(notes_)};
    }

private:
    void weld() {
        // A tenth of a millimetre decides: where a model is a grain of dust, all of it is one place.
        Weld weld;
        vertex_of_.assign(model_.positions.size(), UINT32_MAX);
        for (const ModelCorner& corner : model_.corners) {
            uint32_t& v = vertex_of_[corner.position];
            if (v != UINT32_MAX) continue;
            const Vec3 p = model_.positions[corner.position] * unit_m_;
            if (!(glm::length(p) < kFarFromOrigin_m))
                fail(VFIT_ERROR_DATA, "vertex ", corner.position + 1, " lies ", glm::length(p) / 1000.0f,
                     " km from the origin");
            v = weld.add(p, places_);
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
            for (const auto& t : cut_up(corners, f))
                triangles_.push_back(
                    {{corners[t[0]].position, corners[t[1]].position, corners[t[2]].position},
                     {corners[t[0]].uv, corners[t[1]].uv, corners[t[2]].uv},
                     f});
        }
    }

    Triangles cut_up(const std::vector<ModelCorner>& corners, uint32_t face) const {
        if (corners.size() == 3) return {{0, 1, 2}};
        if (corners.size() > 4) return cut_polygon(corners, face);
        // Squares are bent in all ways: along the diagonal that leaves both halves turned alike, or the
        // shorter.
        const auto at = [&](size_t i) { return places_[corners[i % 4].position]; };
        const auto alike = [&](size_t i) {
            return glm::dot(glm::cross(at(i + 1) - at(i), at(i + 2) - at(i)),
                            glm::cross(at(i + 2) - at(i), at(i + 3) - at(i))) > 0.0f;
        };
        const bool even = alike(0), odd = alike(1);
        const bool first = even != odd ? even : glm::length(at(2) - at(0)) <= glm::length(at(3) - at(1));
        return first ? Triangles{{0, 1, 2}, {0, 2, 3}} : Triangles{{0, 1, 3}, {1, 2, 3}};
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
            if (sorted[0] == sorted[1] || sorted[1] == sorted[2]) {
                if (collapsed_++ == 0) first_collapsed_ = t.face;
                continue;
            }
            if (known.insert(sorted).second)
                kept.push_back(t);
            else
                ++copies;
        }
        triangles_ = std::move(kept);
        if (triangles_.size() > kMaxTriangles)
            fail(VFIT_ERROR_DATA, "the mesh has ", triangles_.size(), " triangles, a garment at most ",
                 kMaxTriangles, ": make it coarser");
        if (copies > 0) notes_.push_back(text(copies, " triangles are left out that are there twice"));
    }

    const Model& model_;
    float unit_m_;
    std::vector<Vec3> places_;
    std::vector<uint32_t> vertex_of_;  // of each of the model's positions
    std::vector<ModelTriangle> triangles_;
    size_t collapsed_ = 0, first_collapsed_ = 0;
    std::vector<std::string> notes_;
};

class PiecesMaker {
public:
    explicit PiecesMaker(const Soup& soup) : soup_(soup), places_(soup.places), triangles_(soup.triangles) {}

    Pieces run() {
        part_sides();
        GoesOn torn = turn_alike();
        if (!torn.empty()) {
            // Where its outside would become its inside, as at a lining that is joined to the cloth.
            check_has_outside(torn);
            part(torn);
            notes_.push_back(text(torn.size(), " sides were parted where its outside became its inside"));
            turn_alike();
        }
        Pieces out{soup_.model, soup_.unit_m, places_, soup_.model->uvs, std::vector<Piece>(piece_count_),
                   soup_.notes};
        out.notes.insert(out.notes.end(), notes_.begin(), notes_.end());
        for (size_t t = 0; t < triangles_.size(); ++t) {
            Piece& piece = out.list[pieces_[t]];
            piece.triangles.push_back(triangles_[t]);
            piece.indices.insert(piece.indices.end(), triangles_[t].vertex.begin(),
                                 triangles_[t].vertex.end());
            piece.area_m2 += area_of(places_, triangles_[t]);
        }
        for (Piece& piece : out.list) piece.openings = borders(piece.indices);
        std::stable_sort(out.list.begin(), out.list.end(),
                         [](const Piece& a, const Piece& b) { return a.area_m2 > b.area_m2; });
        return out;
    }

private:
    std::string name_of(const ModelTriangle& t) const { return soup_.name_of(t); }

    using Beside = std::map<Side, std::vector<uint32_t>>;  // by its lower and higher end; triangles
    Beside beside_sides() const {
        Beside out;
        for (uint32_t t = 0; t < triangles_.size(); ++t)
            for (uint32_t k = 0; k < 3; ++k)
                out[std::minmax(triangles_[t].vertex[k], triangles_[t].vertex[(k + 1) % 3])].push_back(t);
        return out;
    }

    /// Cloth has two triangles beside a side. Where there are more, as where a flap or a lining is joined to
    /// it, the two go on that lie flattest to each other, and the others have a side of their own.
    void part_sides() {
        GoesOn goes_on;
        for (const auto& [side, list] : beside_sides())
            if (list.size() > 2) goes_on[side] = flattest(side, list);
        if (goes_on.empty()) return;
        part(goes_on);
        notes_.push_back(text(goes_on.size(), " sides of more than two triangles were parted"));
    }

    /// Of a side, the two triangles over which cloth goes on, or twice the same: it ends there.
    using GoesOn = std::map<Side, std::array<uint32_t, 2>>;

    /// Triangles that hang together no more get vertices of their own.
    void part(const GoesOn& goes_on) {
        std::set<uint32_t> ends;
        for (const auto& [side, pair] : goes_on) ends.insert({side.first, side.second});
        std::vector<std::vector<uint32_t>> around(places_.size());
        for (uint32_t t = 0; t < triangles_.size(); ++t)
            for (const uint32_t v : triangles_[t].vertex) around[v].push_back(t);
        std::vector<std::pair<std::array<uint32_t, 2>, uint32_t>> renamed;  // of a triangle a vertex
        for (const uint32_t v : ends) {
            std::vector<uint32_t> left = around[v];
            for (bool is_first = true; !left.empty(); is_first = false) {
                std::vector<uint32_t> fan{left.back()};  // those that hang together about the vertex
                left.pop_back();
                for (size_t i = 0; i < fan.size(); ++i)
                    for (size_t k = left.size(); k-- > 0;)
                        if (go_on(fan[i], left[k], v, goes_on))
                            fan.push_back(left[k]), left.erase(left.begin() + long(k));
                if (is_first) continue;
                for (const uint32_t t : fan) renamed.push_back({{t, v}, uint32_t(places_.size())});
                places_.push_back(places_[v]);
            }
        }
        for (const auto& [of, by] : renamed)
            for (uint32_t& v : triangles_[of[0]].vertex)
                if (v == of[1]) v = by;
    }

    std::array<uint32_t, 2> flattest(const Side& side, const std::vector<uint32_t>& list) const {
        const Vec3 along = glm::normalize(places_[side.second] - places_[side.first]);
        const auto wing = [&](uint32_t t) {
            for (const uint32_t v : triangles_[t].vertex)
                if (v != side.first && v != side.second) {
                    const Vec3 off = places_[v] - places_[side.first];
                    return glm::normalize(off - glm::dot(off, along) * along);
                }
            return Vec3(0.0f);
        };
        std::array<uint32_t, 2> best{list[0], list[1]};
        float least = INFINITY;
        for (size_t i = 0; i < list.size(); ++i)
            for (size_t k = 0; k < i; ++k)
                if (const float bent = glm::dot(wing(list[i]), wing(list[k])); bent < least)
                    least = bent, best = {list[k], list[i]};
        return best;
    }

    /// Whether they share a side at that vertex over which cloth goes on.
    bool go_on(uint32_t a, uint32_t b, uint32_t at, const GoesOn& goes_on) const {
        for (const uint32_t v : triangles_[a].vertex) {
            const auto& of_b = triangles_[b].vertex;
            if (v == at || std::find(of_b.begin(), of_b.end(), v) == of_b.end()) continue;
            const auto many = goes_on.find(std::minmax(at, v));
            if (many == goes_on.end()) return true;
            const auto& pair = many->second;
            if ((pair[0] == a && pair[1] == b) || (pair[0] == b && pair[1] == a)) return true;
        }
        return false;
    }

    void check_has_outside(const GoesOn& torn) const {
        constexpr float kMax = 0.02f;  // of all sides
        if (float(torn.size()) <= kMax * 1.5f * float(triangles_.size())) return;
        const auto& [side, pair] = *torn.begin();
        fail(VFIT_ERROR_DATA, "the cloth has no outside: around the side from ", shown(places_[side.first]),
             " to ", shown(places_[side.second]), " (", name_of(triangles_[pair[0]]), ") and ",
             torn.size() - 1, " others its outside becomes its inside");
    }

    /// Neighbours run along their common side in opposite directions; pieces_ becomes the piece of each
    /// triangle. Returns the sides at which they can't.
    GoesOn turn_alike() {
        const Beside beside = beside_sides();
        GoesOn torn;
        piece_count_ = 0;
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
                    for (const uint32_t other : beside.at(side)) {
                        if (other == t) continue;
                        const bool wanted = turned[t] != uint8_t(runs(t, side) == runs(other, side));
                        if (pieces_[other] == UINT32_MAX) {
                            pieces_[other] = piece_count_;
                            turned[other] = wanted;
                            turned_over += wanted;
                            piece.push_back(other);
                        } else if (bool(turned[other]) != wanted) {
                            torn[side] = {t, t};
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
        if (!torn.empty()) return torn;
        for (uint32_t t = 0; t < triangles_.size(); ++t) {
            if (!turned[t]) continue;
            std::swap(triangles_[t].vertex[1], triangles_[t].vertex[2]);
            std::swap(triangles_[t].uv[1], triangles_[t].uv[2]);
        }
        if (mended > 0)
            notes_.push_back(
                text(mended, " triangles were turned the other way round, as those beside them are"));
        return torn;
    }

    const Soup& soup_;
    std::vector<Vec3> places_;
    std::vector<ModelTriangle> triangles_;
    std::vector<uint32_t> pieces_;  // of each triangle
    uint32_t piece_count_ = 0;
    std::vector<std::string> notes_;
};

}  // namespace

float area_of(const std::vector<Vec3>& places, const ModelTriangle& triangle) {
    const auto& v = triangle.vertex;
    return 0.5f * glm::length(glm::cross(places[v[1]] - places[v[0]], places[v[2]] - places[v[0]]));
}

std::string shown(const Vec3& place) {
    const auto rounded = [](float x) { return std::round(x * 1000.0f) / 1000.0f; };
    return text("(", rounded(place.x), ", ", rounded(place.y), ", ", rounded(place.z), ")");
}

std::vector<uint32_t> Soup::indices() const {
    std::vector<uint32_t> out;
    for (const ModelTriangle& t : triangles) out.insert(out.end(), t.vertex.begin(), t.vertex.end());
    return out;
}

void check_no_strays(const Model& model) {
    constexpr float kStray = 100.0f;  // times as far from the middle as half of them are
    std::vector<Vec3> corners;
    for (const ModelCorner& corner : model.corners) corners.push_back(model.positions[corner.position]);
    if (corners.empty()) return;
    const auto median = [](std::vector<float> of) {
        std::nth_element(of.begin(), of.begin() + long(of.size() / 2), of.end());
        return of[of.size() / 2];
    };
    Vec3 middle;
    std::vector<float> numbers(corners.size());
    for (int k = 0; k < 3; ++k) {
        for (size_t i = 0; i < corners.size(); ++i) numbers[i] = corners[i][k];
        middle[k] = median(numbers);
    }
    for (size_t i = 0; i < corners.size(); ++i) numbers[i] = glm::length(corners[i] - middle);
    const float usual = median(numbers);
    for (size_t f = 0; f < model.faces.size(); ++f)
        for (uint32_t i = 0; i < model.faces[f].corner_count; ++i) {
            const uint32_t corner = model.faces[f].first_corner + i;
            if (usual > 0.0f && numbers[corner] > kStray * usual)
                fail(VFIT_ERROR_DATA, model.name_of(f), " has a corner at ", shown(corners[corner]),
                     ", over ", kStray, " times as far out as half of the others");
        }
}

Soup make_soup(const Model& model, float unit_m) { return SoupMaker(model, unit_m).run(); }

Model model_of(const std::vector<Vec3>& places, const std::vector<std::array<uint32_t, 3>>& triangles,
               float unit_m, const char* name) {
    Model out;
    for (const Vec3& p : places) out.positions.push_back(p / unit_m);
    out.groups = {name};
    for (const auto& t : triangles) {
        out.faces.push_back({uint32_t(out.corners.size()), 3, 0, 0, uint32_t(out.faces.size())});
        for (const uint32_t v : t) out.corners.push_back({v, kNoUv});
    }
    return out;
}

Soup soup_of_joined(const Model& model, float unit_m) {
    Soup out{&model, unit_m, model.positions, {}, {}};
    for (Vec3& p : out.places) p *= unit_m;
    for (uint32_t f = 0; f < model.faces.size(); ++f) {
        const ModelCorner* c = &model.corners[model.faces[f].first_corner];
        out.triangles.push_back(
            {{c[0].position, c[1].position, c[2].position}, {c[0].uv, c[1].uv, c[2].uv}, f});
    }
    return out;
}

Pieces make_pieces(const Soup& soup) { return PiecesMaker(soup).run(); }

}  // namespace vfit
