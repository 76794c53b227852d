#include "anthropometry/own_measures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "anthropometry/measure_keys.h"
#include "anthropometry/tape_landmarks.h"
#include "body/joint_bones.h"
#include "core/error.h"
#include "core/json.h"
#include "geometry/mesh_query.h"

namespace vfit {

namespace {

constexpr int kOwnVersion = 1;
constexpr int kMostMeasures = 256, kMostPoints = 32, kDeepest = 8;
constexpr float kDeepestSkin_m = 1.0f;  // from a point inside the body to its skin

/// A body that is being measured, with what only some measures need made when first asked for.
class Ground {
public:
    explicit Ground(const TapeBody& body) : tape(body) {}
    const TapeMesh tape;
    const MeshQuery& skin() const {
        if (!skin_) skin_.emplace(tape.body().positions, tape.body().indices);
        return *skin_;
    }
    float armpit() const {
        return lazily(armpit_, [&] { return armpit_height(tape); });
    }
    float waist() const {
        return lazily(waist_, [&] { return waist_height(tape); });
    }
    float crotch() const {
        return lazily(crotch_, [&] { return crotch_height(tape); });
    }

private:
    template <typename Make>
    static float lazily(std::optional<float>& value, const Make& make) {
        if (!value) value = make();
        return *value;
    }
    mutable std::optional<MeshQuery> skin_;
    mutable std::optional<float> armpit_, waist_, crotch_;
};

using Point = std::function<Vec3(const Ground&)>;

struct Landmark {
    const char* name;
    Vec3 (*place)(const Ground&);
};

/// In the middle of the trunk at that height.
Vec3 inside(const Ground& g, float y) {
    const Section section = g.tape.trunk(y);
    const std::vector<Vec2> points = section.points();
    const Extent size = extent(points);
    return section.lift(0.5f * (size.minimum + size.maximum));
}

constexpr Landmark kLandmarks[] = {
    {"crown",
     [](const Ground& g) {
         return Vec3(g.tape.joint(VFIT_JOINT_HEAD).x, g.tape.crown(), g.tape.joint(VFIT_JOINT_HEAD).z);
     }},
    {"floor",
     [](const Ground& g) {
         return Vec3(g.tape.joint(VFIT_JOINT_PELVIS).x, g.tape.floor(), g.tape.joint(VFIT_JOINT_PELVIS).z);
     }},
    {"crotch", [](const Ground& g) { return inside(g, g.crotch()); }},
    {"hips", [](const Ground& g) { return inside(g, hip_height(g.tape, g.crotch(), g.waist())); }},
    {"waist", [](const Ground& g) { return inside(g, g.waist()); }},
    {"chest", [](const Ground& g) { return inside(g, chest_height(g.tape, g.armpit())); }},
    {"armpits", [](const Ground& g) { return inside(g, g.armpit()); }},
    {"left acromion", [](const Ground& g) { return acromion(g.tape.body(), Side::kLeft); }},
    {"right acromion", [](const Ground& g) { return acromion(g.tape.body(), Side::kRight); }},
    {"left bust point", [](const Ground& g) { return bust_point(g.tape, Side::kLeft, g.armpit()); }},
    {"right bust point", [](const Ground& g) { return bust_point(g.tape, Side::kRight, g.armpit()); }},
    {"left fingertip", [](const Ground& g) { return fingertip(g.tape, Side::kLeft); }},
    {"right fingertip", [](const Ground& g) { return fingertip(g.tape, Side::kRight); }},
};

struct Way {
    const char* name;
    Vec3 direction;
};
const Way kWays[] = {{"front", {0, 0, 1}},  {"back", {0, 0, -1}}, {"left", {1, 0, 0}},
                     {"right", {-1, 0, 0}}, {"up", {0, 1, 0}},    {"down", {0, -1, 0}}};

const Json& field(const Json& object, const char* name, std::string_view where) {
    const auto it = object.is_object() ? object.find(name) : object.end();
    if (it == object.end()) fail(VFIT_ERROR_DATA, "own measures: ", where, " has no \"", name, "\"");
    return *it;
}

Point named_point(const std::string& name, const std::string& where) {
    for (int j = 0; j < kJointCount; ++j)
        if (name == joint_name(j))
            return [j, where](const Ground& g) {
                if (!g.tape.body().joints.has(j))
                    fail(VFIT_ERROR_DATA, "own measures: ", where, ": the body has no joint ", joint_name(j));
                return g.tape.joint(j);
            };
    std::string known;
    for (const Landmark& l : kLandmarks) {
        if (name == l.name) return [place = l.place](const Ground& g) { return place(g); };
        known += text(known.empty() ? "" : ", ", l.name);
    }
    fail(VFIT_ERROR_DATA, "own measures: ", where, ": \"", name, "\" is neither a joint nor one of ", known);
}

Point parse_point(const Json& json, const std::string& where, int depth = 0) {
    if (depth > kDeepest) fail(VFIT_ERROR_DATA, "own measures: ", where, ": points are nested too deeply");
    if (json.is_string()) return named_point(json.get<std::string>(), where);
    if (json.is_array()) {
        if (json.size() != 3 || !json[2].is_number())
            fail(VFIT_ERROR_DATA, "own measures: ", where,
                 ": a point between two others is [one, other, share of the way]");
        const float share = json[2].get<float>();
        if (!(std::abs(share) <= 10.0f))
            fail(VFIT_ERROR_DATA, "own measures: ", where, ": share ", share, " is out of range");
        return [a = parse_point(json[0], where, depth + 1), b = parse_point(json[1], where, depth + 1),
                share](const Ground& g) { return glm::mix(a(g), b(g), share); };
    }
    if (json.is_object() && json.contains("skin")) {
        const Point from = parse_point(json["skin"], where, depth + 1);
        const Json& way = field(json, "way", where);
        for (const Way& w : kWays)
            if (way == w.name)
                return [from, direction = w.direction, where](const Ground& g) {
                    const Vec3 start = from(g);
                    const auto hit = g.skin().cast(start, direction, kDeepestSkin_m);
                    if (!hit) fail(VFIT_ERROR_DATA, "own measures: ", where, ": there is no skin that way");
                    return start + hit->distance * direction;
                };
        fail(VFIT_ERROR_DATA, "own measures: ", where,
             ": \"way\" is none of front, back, left, right, up, down");
    }
    fail(VFIT_ERROR_DATA, "own measures: ", where,
         ": a point is a name, [one, other, share] or {\"skin\", \"way\"}");
}

struct Plane {
    Point at;
    std::optional<std::pair<Point, Point>> square_to;  // level without
    bool trunk = false;
};

Plane parse_plane(const Json& json, const std::string& where) {
    Plane plane;
    plane.at = parse_point(field(json, "at", where), where + ", at");
    if (json.contains("square_to")) {
        const Json& axis = json["square_to"];
        if (!axis.is_array() || axis.size() != 2)
            fail(VFIT_ERROR_DATA, "own measures: ", where, ": \"square_to\" is not a list of two points");
        plane.square_to = {parse_point(axis[0], where + ", square_to"),
                           parse_point(axis[1], where + ", square_to")};
    }
    if (json.contains("of")) {
        if (json["of"] != "trunk" && json["of"] != "limb")
            fail(VFIT_ERROR_DATA, "own measures: ", where, ": \"of\" is neither trunk nor limb");
        plane.trunk = json["of"] == "trunk";
        if (plane.trunk && plane.square_to)
            fail(VFIT_ERROR_DATA, "own measures: ", where,
                 ": the trunk is cut level: leave \"square_to\" out");
    }
    return plane;
}

/// The outline that the plane cuts: of the trunk without arms, or the loop about the point.
std::vector<Vec2> outline(const Ground& g, const Plane& plane, const std::string& where) {
    const Vec3 at = plane.at(g);
    if (plane.trunk) {
        std::vector<Vec2> points = g.tape.trunk(at.y).points();
        if (points.size() < 3)
            fail(VFIT_ERROR_DATA, "own measures: ", where, ": the plane does not meet the trunk");
        return points;
    }
    Vec3 axis(0, 1, 0);
    if (plane.square_to) axis = plane.square_to->second(g) - plane.square_to->first(g);
    if (!(glm::length(axis) > 1e-4f))
        fail(VFIT_ERROR_DATA, "own measures: ", where, ": the points of \"square_to\" are one place");
    const Section section = cut(g.tape.body().positions, g.tape.body().indices, at, axis);
    const std::vector<Vec2>* loop = loop_about(section, at);
    if (!loop) fail(VFIT_ERROR_DATA, "own measures: ", where, ": no outline lies about its point");
    return *loop;
}

/// A taut tape over the skin from a to b: the convex hull of the outline's shorter way in the plane through
/// both that stands on the skin.
float over_skin(const Ground& g, const Vec3& a, const Vec3& b, const std::string& where) {
    const MeshQuery::Closest skin_a = g.skin().closest(a), skin_b = g.skin().closest(b);
    const Vec3 from = skin_a.point, to = skin_b.point, way = to - from;
    const float straight = glm::length(way);
    if (straight < 1e-4f) return 0.0f;
    Vec3 out = skin_a.normal + skin_b.normal;
    out -= glm::dot(out, way) / (straight * straight) * way;
    if (!(glm::length(out) > 1e-3f))
        fail(VFIT_ERROR_DATA, "own measures: ", where,
             ": the skin's way between two points is not clear; put a point between");
    const Section section = cut(g.tape.body().positions, g.tape.body().indices, from, glm::cross(way, out));
    const auto place = [&](const Vec3& p) {
        return Vec2(glm::dot(p - section.origin, section.u), glm::dot(p - section.origin, section.v));
    };
    const Vec2 start = place(from), end = place(to);
    float best = 0.0f, off = 1e9f;
    for (const auto& loop : section.loops) {
        const auto nearest = [&](const Vec2& p) {
            return size_t(std::min_element(loop.begin(), loop.end(),
                                           [&](const Vec2& x, const Vec2& y) {
                                               return glm::distance(x, p) < glm::distance(y, p);
                                           }) -
                          loop.begin());
        };
        const size_t i = nearest(start), j = nearest(end);
        const float apart = glm::distance(loop[i], start) + glm::distance(loop[j], end);
        if (apart >= off) continue;
        off = apart;
        float shortest = 1e9f;
        for (const bool forwards : {true, false}) {
            std::vector<Vec2> part = {start, end};
            float length = 0.0f;
            for (size_t k = i; k != j; k = (k + (forwards ? 1 : loop.size() - 1)) % loop.size()) {
                part.push_back(loop[k]);
                length += glm::distance(loop[k], loop[(k + (forwards ? 1 : loop.size() - 1)) % loop.size()]);
            }
            if (length < shortest)
                shortest = length, best = std::max(straight, hull_perimeter(part) - straight);
        }
    }
    constexpr float kNear_m = 0.05f;
    if (off > kNear_m)
        fail(VFIT_ERROR_DATA, "own measures: ", where, ": no skin leads from one point to the next");
    return best;
}

}  // namespace

struct OwnMeasures::Definition {
    std::string key;
    std::function<float(const Ground&)> value;
};

OwnMeasures::OwnMeasures() = default;
OwnMeasures::~OwnMeasures() = default;
OwnMeasures::OwnMeasures(OwnMeasures&&) noexcept = default;

OwnMeasures OwnMeasures::parse(std::string_view json) {
    const Json file = parse_json(json, "own measures");
    if (field(file, "format", "the file") != "vfit-own-measures")
        fail(VFIT_ERROR_DATA, "own measures: the file's \"format\" is not vfit-own-measures");
    if (field(file, "version", "the file") != kOwnVersion)
        fail(VFIT_ERROR_VERSION, "own measures: this library reads version ", kOwnVersion);
    const Json& measures = field(file, "measures", "the file");
    if (!measures.is_array() || measures.empty() || measures.size() > kMostMeasures)
        fail(VFIT_ERROR_DATA, "own measures: \"measures\" is not a list of 1 to ", kMostMeasures);
    OwnMeasures out;
    for (const Json& item : measures) {
        const Json& name = field(item, "key", "a measure");
        if (!name.is_string() || !is_own_measure(name.get<std::string>()))
            fail(VFIT_ERROR_DATA,
                 "own measures: a key is x_, small letters, digits and _, and _m at the end, of less than 48 "
                 "bytes, as in x_calf_girth_m: ",
                 json_text(name));
        auto one = std::make_unique<Definition>();
        const std::string key = one->key = name.get<std::string>();
        for (const auto& other : out.list_)
            if (other->key == key) fail(VFIT_ERROR_DATA, "own measures: ", key, " stands twice");
        const auto kind = [&](const char* what) { return item.contains(what); };
        if (kind("girth") + kind("breadth") + kind("depth") + kind("height") + kind("path") != 1)
            fail(VFIT_ERROR_DATA, "own measures: ", key,
                 " has not exactly one of girth, breadth, depth, height and path");
        if (kind("girth")) {
            one->value = [plane = parse_plane(item["girth"], key), key](const Ground& g) {
                return hull_perimeter(outline(g, plane, key));
            };
        } else if (kind("breadth")) {
            one->value = [plane = parse_plane(item["breadth"], key), key](const Ground& g) {
                return extent(outline(g, plane, key)).breadth();
            };
        } else if (kind("depth")) {
            one->value = [plane = parse_plane(item["depth"], key), key](const Ground& g) {
                return extent(outline(g, plane, key)).depth();
            };
        } else if (kind("height")) {
            one->value = [of = parse_point(item["height"], key)](const Ground& g) {
                return of(g).y - g.tape.floor();
            };
        } else {
            const Json& path = item["path"];
            const Json& points = field(path, "points", key);
            if (!points.is_array() || points.size() < 2 || points.size() > kMostPoints)
                fail(VFIT_ERROR_DATA, "own measures: ", key, ": \"points\" is not a list of 2 to ",
                     kMostPoints);
            bool skin = false;
            if (path.contains("over")) {
                if (path["over"] != "skin" && path["over"] != "air")
                    fail(VFIT_ERROR_DATA, "own measures: ", key, ": \"over\" is neither skin nor air");
                skin = path["over"] == "skin";
            }
            std::vector<Point> places;
            for (const Json& p : points) places.push_back(parse_point(p, key));
            one->value = [places, skin, key](const Ground& g) {
                float sum = 0.0f;
                for (size_t i = 0; i + 1 < places.size(); ++i) {
                    const Vec3 a = places[i](g), b = places[i + 1](g);
                    sum += skin ? over_skin(g, a, b, key) : glm::distance(a, b);
                }
                return sum;
            };
        }
        out.list_.push_back(std::move(one));
    }
    return out;
}

std::vector<Measurement> OwnMeasures::measure(const TapeBody& body) const {
    const Ground ground(body);
    std::vector<Measurement> out;
    for (const auto& one : list_) {
        const float value = one->value(ground);
        if (!std::isfinite(value) || value <= 0.0f)
            fail(VFIT_ERROR_DATA, "own measures: ", one->key, " comes to nothing on this body");
        out.push_back({one->key, value, 0.0f, false});
    }
    return out;
}

}  // namespace vfit
