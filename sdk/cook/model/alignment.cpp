#include "cook/model/alignment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "cook/drape/upper_edge.h"
#include "core/error.h"
#include "geometry/borders.h"
#include "geometry/section.h"
#include "math/quaternion.h"

namespace vfit {

namespace {

struct Unit {
    const char* name;
    const char* option;
    float metres;
};
constexpr std::array<Unit, 6> kUnits = {{{"metres", "m", 1.0f},
                                         {"centimetres", "cm", 0.01f},
                                         {"millimetres", "mm", 0.001f},
                                         {"decimetres", "dm", 0.1f},
                                         {"inches", "in", 0.0254f},
                                         {"feet", "ft", 0.3048f}}};
constexpr float kSmallest_m = 0.1f, kLargest_m = 3.0f;  // garments, from a baby's sock to a train
// A garment's girth over the body's where it is closest: of stretch fabrics it is less than one.
constexpr float kTight = 0.72f, kLoose = 2.0f, kUsual = 1.15f;

float largest_extent(const Model& model) {
    Vec3 low(INFINITY), high(-INFINITY);
    for (const ModelCorner& corner : model.corners) {
        low = glm::min(low, model.positions[corner.position]);
        high = glm::max(high, model.positions[corner.position]);
    }
    const Vec3 size = high - low;
    return std::max({size.x, size.y, size.z});
}
bool is_garments(float size_m) { return size_m >= kSmallest_m && size_m <= kLargest_m; }

struct Box {
    Vec3 low{INFINITY}, high{-INFINITY};
    void add(const Vec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
    Vec3 middle() const { return 0.5f * (low + high); }
};

/// Arms first: what they leave by is no leg's.
struct WholeLimb {
    Limb limb, lower;
    bool is_arm;
};
constexpr std::array<WholeLimb, 4> kWholeLimbs = {{{Limb::left_arm, Limb::left_forearm, true},
                                                   {Limb::right_arm, Limb::right_forearm, true},
                                                   {Limb::left_leg, Limb::left_shank, false},
                                                   {Limb::right_leg, Limb::right_shank, false}}};

/// Garments stand about the same place; a small offset is their own.
float only_if_far(float metres) {
    constexpr float kFar_m = 0.03f;
    return std::abs(metres) > kFar_m ? metres : 0.0f;
}

float middle_of(std::vector<float>& list) {
    const size_t at = list.size() / 2;
    std::nth_element(list.begin(), list.begin() + std::ptrdiff_t(at), list.end());
    return list[at];
}

constexpr float kNoLimb_m = 0.08f;  // around an opening: none leaves by less

/// The cloth turned and scaled, before it is moved to the body.
class Candidate {
public:
    Candidate(const Pieces& pieces, const CookBody& body, float scale, const Mat3& turn)
        : body_(body), places_(pieces.places) {
        for (Vec3& p : places_) p = turn * (scale * p);
        for (const Piece& piece : pieces.list) {
            indices_.insert(indices_.end(), piece.indices.begin(), piece.indices.end());
            for (const auto& opening : piece.openings) {
                const float length = length_around(places_, opening);
                if (length <= kNoLimb_m) continue;
                openings_.push_back(opening);
                Box box;
                for (const uint32_t v : opening) box.add(places_[v]);
                ends_.push_back({centre(opening), length, box.low.x, box.high.x});
            }
            for (const uint32_t v : piece.indices) box_.add(places_[v]);
        }
        cloth_.emplace(places_, indices_);
        double flux = 0.0;
        for (size_t i = 0; i + 2 < indices_.size(); i += 3) {
            const Vec3 &a = places_[indices_[i]], &b = places_[indices_[i + 1]],
                       &c = places_[indices_[i + 2]];
            flux += double(glm::dot(glm::cross(b - a, c - a), (a + b + c) / 3.0f - box_.middle()));
        }
        if (flux < 0.0) outwards_ = -1.0f;
        const float x = box_.middle().x;
        x_ = only_if_far(x);
    }

    const MeshQuery& cloth() const { return *cloth_; }
    const std::vector<Vec3>& places() const { return places_; }
    const std::vector<std::vector<uint32_t>>& openings() const { return openings_; }

    /// What brings the cloth over the shoulders onto the body's, from a fraction of the way to the joint:
    /// further in there may be a hood. None where there is no such cloth on both sides.
    std::optional<Vec3> by_shoulders(float inner, float thickness_m) const {
        constexpr float kSlope_m = 0.08f, kAnywhere_m = 0.3f, kStep_m = 0.01f, kSame_m = 0.03f;
        const BodyOutline& outline = body_.outline();
        const Vec3 joint = outline.left_shoulder();
        const float lowest = 0.5f * (outline.levels().waist + outline.levels().shoulder);
        Box top;
        constexpr float kTop = 0.3f;
        for (const uint32_t v : indices_)
            if (places_[v].y >= glm::mix(box_.high.y, box_.low.y, kTop)) top.add(places_[v]);
        std::vector<float> raise;
        float forward = 0.0f;
        for (const float side : {-1.0f, 1.0f}) {
            std::vector<std::pair<Vec3, Vec3>> ridges;  // of cloth and body
            float highest = -INFINITY;
            for (float x = inner * joint.x; x < joint.x; x += kStep_m) {
                const Vec3 above(x_ + side * x, box_.high.y + kStep_m, top.middle().z);
                const auto cloth = ridge(*cloth_, above, kAnywhere_m),
                           body = outline.shoulder_ridge(side * x);
                if (!cloth || !body || body->y < lowest) continue;
                ridges.emplace_back(*cloth, *body);
                highest = std::max(highest, cloth->y);
            }
            if (ridges.empty()) return std::nullopt;
            // Beyond the shoulder's end the highest is the chest, or a sleeve.
            for (const auto& [cloth, body] : ridges) {
                if (cloth.y < highest - kSlope_m) continue;
                raise.push_back(body.y + thickness_m - cloth.y);
                forward += body.z - cloth.z;
            }
        }
        forward /= float(raise.size());
        // The median: shoulders slope as they like, and beside a strap there is a neckline.
        const float raised = middle_of(raise);
        const auto same = std::count_if(raise.begin(), raise.end(),
                                        [&](float r) { return std::abs(r - raised) < kSame_m; });
        if (2 * size_t(same) < raise.size()) return std::nullopt;
        return Vec3(-x_, raised, only_if_far(forward));
    }

    /// By its crotch, and by its upper edge: to where the body about fills it.
    std::optional<Vec3> by_waist(bool may_stay) const {
        const BodyOutline& outline = body_.outline();
        const TailorLevels& levels = outline.levels();
        Box top;
        constexpr float kTop = 0.3f;
        for (const uint32_t v : indices_)
            if (places_[v].y >= glm::mix(box_.high.y, box_.low.y, kTop)) top.add(places_[v]);
        Vec3 moved(-x_, 0.0f, only_if_far(outline.axis_z() - top.middle().z));
        for (int round = 0; round < 2; ++round) {
            std::vector<Vec3> there = places_;
            for (Vec3& p : there) p += moved;
            const std::vector<uint32_t> edge = upper_edge(there, openings_, outline.axis_z());
            if (edge.empty()) return std::nullopt;
            const float own = mean_height(places_, edge);
            constexpr float kAboveWaist_m = 0.12f;
            const bool stands_there =
                may_stay && moved.x == 0.0f && own > levels.hip && own < levels.shoulder;
            if (stands_there && own > levels.waist + kAboveWaist_m) return Vec3(0.0f, 0.0f, moved.z);
            const auto crotch = crotch_raise(moved);
            // Without a place of its own it is one that its crotch tells, or its narrowest girth.
            float from = own;
            if (crotch)
                from = own + *crotch;
            else if (!stands_there)
                from = own + levels.waist - narrowest(own);
            const bool is_high = !crotch && !stands_there && from > levels.waist + kAboveWaist_m;
            moved.y = (is_high ? from : sits_at(edge, from)) - own;
            if (crotch) moved.y = std::min(moved.y, *crotch);
            moved.z += only_if_far(behind_by(moved));
        }
        return moved;
    }

    /// Limbs follow sleeves and legs, each as it crosses the least cloth.
    Stance stance(const SkeletonProbe& probe, const Vec3& moved, bool has_sleeves) const {
        Stance out;
        const std::vector<uint32_t>* taken[2] = {nullptr, nullptr};
        for (const auto& [limb, lower, is_arm] : kWholeLimbs) {
            if (is_arm && !has_sleeves) continue;
            const auto* opening = end_of(limb, moved);
            if (!opening || opening == taken[0] || opening == taken[1]) continue;
            if (is_arm) taken[limb == Limb::right_arm] = opening;
            // Legs stand as ours do, where that will do.
            Stance best = out;
            size_t least = is_arm ? SIZE_MAX : probe.crossed(*cloth_, moved, out, limb);
            for (const Bend bend : {Bend::by_sleeve, Bend::straight, Bend::as_ours}) {
                Stance tried = out;
                follow(limb, lower, *opening, bend, moved, tried);
                const size_t crossed = probe.crossed(*cloth_, moved, tried, limb);
                if (crossed < least) least = crossed, best = tried;
            }
            out = best;
        }
        return out;
    }

    /// Whether sleeves or legs end far beyond hands and feet.
    bool is_too_long(const Vec3& moved, bool has_sleeves) const {
        constexpr float kMost = 1.4f;  // of the way to wrist and ankle
        for (const auto& [limb, lower, is_arm] : kWholeLimbs) {
            if (is_arm && !has_sleeves) continue;
            const auto* opening = end_of(limb, moved);
            if (!opening) continue;
            const float whole = glm::length(body_.end(limb) - body_.root(limb)) +
                                glm::length(body_.end(lower) - body_.root(lower));
            if (glm::length(centre(*opening) + moved - body_.root(limb)) > kMost * whole) return true;
        }
        return false;
    }

    /// Share of the cloth across which lies no body but other cloth, as in a sleeve without an arm.
    float empty_share(const Vec3& moved, const Stance& stance) const {
        constexpr size_t kSamples = 800;
        constexpr float kTube_m = 0.25f, kLining_m = 0.03f;
        const MeshQuery skin(body_.leaving(stance, 0.0f), body_.indices());
        const size_t count = indices_.size() / 3, step = std::max<size_t>(1, count / kSamples);
        double empty = 0.0, all = 0.0;
        for (size_t t = 0; t < count; t += step) {
            const Vec3 &a = places_[indices_[3 * t]], &b = places_[indices_[3 * t + 1]],
                       &c = places_[indices_[3 * t + 2]];
            const Vec3 across = glm::cross(b - a, c - a);
            const float length = glm::length(across);
            if (!(length > 0.0f)) continue;
            const Vec3 inwards = -outwards_ * across / length,
                       from = (a + b + c) / 3.0f + inwards * kLining_m;
            all += double(length);
            const auto cloth = cloth_->cast(from, inwards, kTube_m);
            if (!cloth || glm::dot(cloth->normal, inwards) * outwards_ < 0.0f) continue;
            const auto body = skin.cast(from + moved, inwards, cloth->distance);
            if (!body && !skin.inside(from + moved)) empty += double(length);
        }
        return all > 0.0 ? float(empty / all) : 0.0f;
    }

private:
    /// The nearest height to `own`, between hips and waist, at which the body about fills the opening. One
    /// that is wider than the hips is worn at the waist, with a belt.
    float sits_at(const std::vector<uint32_t>& edge, float own) const {
        const TailorLevels& levels = body_.outline().levels();
        const float around = length_around(places_, edge);
        constexpr float kStep_m = 0.005f, kStretched_m = 0.02f,
                        kFilled = 0.85f;  // around, that it stretches; fraction, that is filled
        float best = levels.waist, least = INFINITY;
        for (float y = levels.waist; y > levels.hip; y -= kStep_m) {
            const float girth = body_.outline().at(y).perimeter();
            if (girth > around + kStretched_m || girth < kFilled * around || std::abs(y - own) >= least)
                continue;
            least = std::abs(y - own);
            best = y;
        }
        // Between two steps it stays where it is.
        return least < kStep_m ? own : best;
    }

    /// By how much the cloth lies too far back where hips are, or at its upper end below them.
    float behind_by(const Vec3& moved) const {
        constexpr float kBelowEdge_m = 0.06f;
        const float y = std::min(body_.outline().levels().hip, box_.high.y + moved.y - kBelowEdge_m);
        const Section cloth = cut(places_, indices_, Vec3(0, y - moved.y, 0), Vec3(0, 1, 0)),
                      skin = cut(body_.positions(), body_.indices(), Vec3(0, y, 0), Vec3(0, 1, 0));
        Box of_cloth, of_skin;
        for (const Vec2& p : cloth.points()) of_cloth.add(cloth.lift(p));
        const float breadth = of_cloth.high.x - of_cloth.low.x;
        for (const Vec2& p : skin.points())
            if (const Vec3 at = skin.lift(p); std::abs(at.x) < 0.5f * breadth) of_skin.add(at);
        return breadth > 0.0f ? of_skin.middle().z - of_cloth.middle().z - moved.z : 0.0f;
    }

    /// Height at which the cloth is narrowest, at its upper edge or in the trunk's length below.
    float narrowest(float top) const {
        constexpr float kTrunk_m = 0.35f, kStep_m = 0.02f, kBelowEdge_m = 0.03f, kWaisted = 0.95f;
        float best = top, least = INFINITY;
        for (float y = top - kBelowEdge_m; y > std::max(top - kTrunk_m, box_.low.y); y -= kStep_m) {
            const Section section = cut(places_, indices_, Vec3(0, y, 0), Vec3(0, 1, 0));
            const float girth = hull_perimeter(section.points());
            if (girth <= 0.0f) continue;
            if (least == INFINITY)
                least = kWaisted * girth;
            else if (girth < least)
                least = girth, best = y;
        }
        return best;
    }

    /// What brings its crotch below the body's; none where there are no legs.
    std::optional<float> crotch_raise(const Vec3& moved) const {
        if (!has_legs()) return std::nullopt;
        constexpr float kBelow_m = 0.02f, kAside_m = 0.06f, kStep_m = 0.01f, kFar_m = 8.0f;
        const auto lowest = [&](const MeshQuery& mesh, const Vec3& from) {
            std::optional<float> out;
            for (float z = -kAside_m; z <= kAside_m; z += kStep_m)
                if (const auto hit = mesh.cast(from + Vec3(0, 0, z), {0, 1, 0}, kFar_m))
                    out = std::min(out.value_or(INFINITY), from.y + hit->distance);
            return out;
        };
        const float axis_z = body_.outline().axis_z();
        const auto cloth = lowest(*cloth_, {x_, box_.low.y - kStep_m, axis_z - moved.z}),
                   body = lowest(body_.skin(), {0.0f, -kStep_m, axis_z});
        if (!cloth || !body) return std::nullopt;
        return *body - kBelow_m - *cloth;
    }

    /// Openings on either side of its middle, in its lower half.
    bool has_legs() const {
        constexpr float kLeast_m = 0.2f, kMiddle_m = 0.01f;
        const auto has = [&](float side) {
            return std::any_of(openings_.begin(), openings_.end(), [&](const auto& opening) {
                return length_around(places_, opening) > kLeast_m && centre(opening).y < box_.middle().y &&
                       std::all_of(
                           opening.begin(), opening.end(),
                           [&](uint32_t v) { return side * (places_[v].x - x_) > -kMiddle_m; });
            });
        };
        return has(-1.0f) && has(1.0f);
    }

    /// The opening by which a limb leaves the cloth: of those that lie on its side of the body alone, that
    /// which is furthest out, or down.
    const std::vector<uint32_t>* end_of(Limb limb, const Vec3& moved) const {
        constexpr float kLeast_m = 0.12f, kMiddle_m = -0.03f, kHand_m = 0.25f;
        const bool is_arm = limb == Limb::left_arm || limb == Limb::right_arm;
        const float side = body_.root(limb).x < 0.0f ? -1.0f : 1.0f;
        const TailorLevels& levels = body_.outline().levels();
        const std::vector<uint32_t>* best = nullptr;
        float furthest = -INFINITY;
        for (size_t i = 0; i < openings_.size(); ++i) {
            const End& end = ends_[i];
            const float innermost = side < 0.0f ? -end.high_x - moved.x : end.low_x + moved.x;
            if (end.length_m < kLeast_m || innermost < kMiddle_m) continue;
            const Vec3 at = end.centre + moved;
            if (is_arm ? at.y < levels.hip - kHand_m : at.y > levels.hip) continue;
            const float far_out = is_arm ? side * at.x : -at.y;
            if (far_out > furthest) furthest = far_out, best = &openings_[i];
        }
        return best;
    }
    Vec3 centre(const std::vector<uint32_t>& opening) const {
        Vec3 sum(0.0f);
        float length = 0.0f;
        for (size_t i = 0; i < opening.size(); ++i) {
            const Vec3 &a = places_[opening[i]], &b = places_[opening[(i + 1) % opening.size()]];
            sum += glm::length(b - a) * 0.5f * (a + b), length += glm::length(b - a);
        }
        return length > 0.0f ? sum / length : sum;
    }

    /// The middle of the sleeve about that place, square to its length.
    std::optional<Vec3> middle_at(const Vec3& place, const Vec3& along) const {
        constexpr float kReach_m = 0.2f;
        // From within it is seen all around, which is much faster than to cut all of the cloth.
        constexpr int kRays = 12;
        constexpr float kSleeve_m = 0.1f;
        const Vec3 a = glm::normalize(
                       glm::cross(along, std::abs(along.x) < 0.8f ? Vec3(1, 0, 0) : Vec3(0, 0, 1))),
                   b = glm::cross(along, a);
        Vec3 seen(0.0f);
        int hits = 0;
        for (int i = 0; i < kRays; ++i) {
            const float angle = 2.0f * kPi * float(i) / float(kRays);
            const Vec3 direction = std::cos(angle) * a + std::sin(angle) * b;
            const auto hit = cloth_->cast(place, direction, kSleeve_m);
            if (!hit) break;
            seen += place + hit->distance * direction;
            ++hits;
        }
        if (hits == kRays) return seen / float(kRays);
        const Section section = cut(places_, indices_, place, along);
        const std::vector<Vec2>* best = nullptr;
        float nearest = kReach_m;
        for (const auto& loop : section.loops) {
            Vec2 middle(0.0f);
            for (const Vec2& p : loop) middle += p / float(loop.size());
            if (const float off = glm::length(middle); off < nearest) nearest = off, best = &loop;
        }
        if (!best) return std::nullopt;
        const Extent box = extent(*best);
        return section.lift(0.5f * (box.minimum + box.maximum));
    }

    enum class Bend { by_sleeve, straight, as_ours };
    void follow(Limb limb, Limb lower, const std::vector<uint32_t>& opening, Bend bend, const Vec3& moved,
                Stance& stance) const {
        constexpr float kAtRoot_m = 0.1f, kBeyond = 0.2f, kAsOurs_rad = 0.05f, kElbow = 0.6f;
        const Vec3 root = body_.root(limb), joint = body_.end(limb), wrist = body_.end(lower),
                   end = centre(opening) + moved;
        const float out = glm::length(end - root), upper = glm::length(joint - root),
                    whole = upper + glm::length(wrist - joint);
        if (out < kAtRoot_m) return;  // without sleeves
        const Vec3 along = (end - root) / out;
        const bool is_long = out > upper + kBeyond * (whole - upper);
        Vec3 elbow = root + along * std::min(upper, kElbow * out);
        if (bend == Bend::by_sleeve && is_long)
            if (const auto middle = middle_at(elbow - moved, along)) elbow = *middle + moved;
        const Vec3 from = bend == Bend::as_ours ? wrist - root : joint - root;
        const Quat turn = shortest_arc(from, bend == Bend::by_sleeve && is_long ? elbow - root : along);
        if (angle_of(turn) > kAsOurs_rad) stance.of(limb) = turn;
        if (!is_long || bend == Bend::as_ours) return;
        const Vec3 now = body_.carried(stance, limb, joint);
        const Quat bent = shortest_arc(wrist - joint, glm::conjugate(stance.of(limb)) * (end - now));
        if (angle_of(bent) > kAsOurs_rad) stance.of(lower) = bent;
    }

    const CookBody& body_;
    std::vector<Vec3> places_;
    std::vector<uint32_t> indices_;
    std::vector<std::vector<uint32_t>> openings_;
    struct End {
        Vec3 centre;
        float length_m, low_x, high_x;
    };
    std::vector<End> ends_;  // of these
    std::optional<MeshQuery> cloth_;
    Box box_;
    float outwards_ = 1.0f;  // its triangles' normals look out, or in (-1)
    float x_ = 0.0f;         // its middle, where that is not the body's
};

struct Turn {
    const char* note;
    Mat3 matrix;
};
/// As written first, then as other programs write; which way odd ones face is not known.
std::vector<Turn> turns() {
    const auto columns = [](const Vec3& x, const Vec3& y, const Vec3& z) { return Mat3(x, y, z); };
    return {{"", Mat3(1.0f)},
            {"it was written with Z up", columns({1, 0, 0}, {0, 0, -1}, {0, 1, 0})},
            {"it was written upside down", columns({-1, 0, 0}, {0, -1, 0}, {0, 0, 1})},
            {"it was written with Z down", columns({1, 0, 0}, {0, 0, 1}, {0, -1, 0})},
            {"it was written with X up", columns({0, 1, 0}, {0, 0, 1}, {1, 0, 0})},
            {"it was written with X down", columns({0, -1, 0}, {0, 0, 1}, {-1, 0, 0})}};
}

/// Garments are broader than deep: the way about the vertical in which one that stands obliquely is so.
std::optional<Turn> from_oblique(const Pieces& pieces) {
    constexpr float kOblique_rad = 0.35f, kBroader = 1.3f;  // of deviations
    Vec2 middle(0.0f);
    float area = 0.0f;
    const auto for_all = [&](const auto& add) {
        for (const Piece& piece : pieces.list)
            for (const ModelTriangle& t : piece.triangles) {
                const Vec3 p =
                    (pieces.places[t.vertex[0]] + pieces.places[t.vertex[1]] + pieces.places[t.vertex[2]]) /
                    3.0f;
                add(area_of(pieces.places, t), Vec2(p.x, p.z));
            }
    };
    for_all([&](float a, const Vec2& p) { middle += a * p, area += a; });
    if (!(area > 0.0f)) return std::nullopt;
    middle /= area;
    float xx = 0.0f, xz = 0.0f, zz = 0.0f;
    for_all([&](float a, const Vec2& p) {
        const Vec2 off = p - middle;
        xx += a * off.x * off.x, xz += a * off.x * off.y, zz += a * off.y * off.y;
    });
    const float angle = 0.5f * std::atan2(2.0f * xz, xx - zz);  // of the longer axis, from X to Z
    const float mean = 0.5f * (xx + zz), half = std::hypot(0.5f * (xx - zz), xz);
    if (std::abs(angle) < kOblique_rad || mean + half < kBroader * kBroader * (mean - half))
        return std::nullopt;
    const float c = std::cos(angle), s = std::sin(angle);
    return Turn{"it stood obliquely", Mat3(Vec3(c, 0, -s), Vec3(0, 1, 0), Vec3(s, 0, c))};
}

class Aligner {
public:
    Aligner(const Pieces& pieces, const CookBody& body, const AlignmentOptions& options)
        : pieces_(pieces), body_(body), options_(options), probe_(body), turns_(turns()) {
        if (const auto about_vertical = from_oblique(pieces))
            turns_.insert(turns_.begin() + 1, *about_vertical);
    }

    Alignment run() {
        for (const Turn& turn : turns_) {
            tried_.clear();
            if (options_.size_known || units().empty()) try_out(1.0f, turn, nullptr);
            for (const Unit& unit : units()) try_out(unit.metres / pieces_.unit_m, turn, &unit);
            if (best_ && best_->cost < kGood) break;
            try_other_sizes(turn);
            if (best_ && best_->cost < kGood) break;
        }
        if (!best_) fail(VFIT_ERROR_DATA, "it has no edge by which it could hang on a body");
        if (options_.stands_by != StandsBy::as_modelled) check();
        return best_->alignment;
    }

private:
    // Costs.
    static constexpr float kGood = 0.8f, kOtherScale = 0.3f, kOutOfPlace = 0.8f, kMost = 2.0f,
                           kNotItsKind = 10.0f;
    struct Way {
        Alignment alignment;
        SkeletonProbe::Found found;
        Parted parted;
        size_t turn;
        float cost, out_of_place = 0.0f, empty = 0.0f;  // the cost is with that
    };

    /// Children and drawn figures: as large as makes the closest girth a usual one.
    void try_other_sizes(const Turn& turn) {
        if (options_.scale != 0.0f || options_.size_known) return;
        constexpr size_t kFew = 3;  // bones that may cross it
        constexpr float kSmallest = 0.3f, kLargest = 3.0f;
        const std::vector<std::pair<float, SkeletonProbe::Found>> tried = tried_;
        for (const auto& [scale, found] : tried) {
            const float by = kUsual / std::max(found.girth_ratio, 0.01f);
            if (by < kSmallest || by > kLargest) continue;
            if (found.girth_ratio > 0.0f && found.pierced.size() <= kFew &&
                (found.girth_ratio < kTight || found.girth_ratio > kLoose || !found.pierced.empty()))
                try_out(scale * by, turn, nullptr, false);
        }
    }

    std::vector<Unit> units() const {
        std::vector<Unit> out;
        if (options_.size_known) return out;
        const float size = largest_extent(*pieces_.model);
        for (const Unit& unit : kUnits)
            if (options_.unit_told ? unit.metres == options_.unit_m : is_garments(size * unit.metres))
                out.push_back(unit);
        return out;
    }

    bool is_stated(const Unit* unit) const { return unit && unit->metres == options_.unit_m; }

    void try_out(float scale, const Turn& turn, const Unit* unit, bool is_first = true) {
        if (options_.scale != 0.0f && !options_.size_known) scale *= options_.scale;
        const Candidate candidate(pieces_, body_, scale, turn.matrix);
        const bool as_written =
            turn.note[0] == 0 && (options_.size_known ? pieces_.unit_m == options_.unit_m
                                                      : options_.scale == 0.0f && is_stated(unit));
        const StandsBy by = options_.stands_by;
        std::vector<Vec3> ways;
        if (by == StandsBy::as_modelled) ways.emplace_back(0.0f);
        constexpr float kNeck = 0.25f, kOuter = 0.7f;
        if (by == StandsBy::any || by == StandsBy::shoulders)
            for (const float inner : {kNeck, kOuter})
                if (const auto way = candidate.by_shoulders(inner, options_.thickness_m))
                    ways.push_back(*way);
        const size_t shoulder_ways = ways.size();
        if (by == StandsBy::any || by == StandsBy::waist)
            if (const auto way = candidate.by_waist(as_written)) ways.push_back(*way);
        for (size_t w = 0; w < ways.size(); ++w) {
            Way way;
            const bool by_waist = by != StandsBy::as_modelled && w >= shoulder_ways;
            way.alignment = {scale, turn.matrix, ways[w], candidate.stance(probe_, ways[w], !by_waist), {}};
            way.found = probe_.find(candidate.cloth(), ways[w], way.alignment.stance);
            if (by != StandsBy::as_modelled) look_beside(candidate, by_waist, way);
            way.parted = probe_.parted(candidate.places(), candidate.openings(), way.alignment.moved,
                                       way.alignment.stance);
            if (is_first) tried_.emplace_back(scale, way.found);
            way.turn = 0;
            for (const Turn& known : turns_) {
                if (known.matrix == turn.matrix) break;
                ++way.turn;
            }
            way.cost = cost(way, !is_first || (!unit && !options_.size_known)) + 0.1f * float(w);
            if (candidate.is_too_long(way.alignment.moved, !by_waist)) way.cost += kNotItsKind;
            if (!options_.size_known && !is_stated(unit)) way.cost += kOtherScale;
            if (!options_.size_known && !is_in_place(way.alignment.moved)) way.out_of_place = kOutOfPlace;
            way.cost += way.out_of_place;
            if (way.cost < kNotItsKind && (!best_ || way.cost < best_->cost)) {
                constexpr float kEmpty = 0.2f;
                way.empty = candidate.empty_share(way.alignment.moved, way.alignment.stance);
                constexpr int kAllLimbs = 4;
                if (way.empty > kEmpty && way.parted.count() < kAllLimbs) way.cost += kNotItsKind;
            }
            if (best_ && best_->cost <= way.cost) continue;
            note(way.alignment, turn, unit);
            best_ = std::move(way);
        }
    }

    /// Where few bones cross it, the nearest place where fewer do: bodies stoop and carry their shoulders as
    /// they like.
    void look_beside(const Candidate& candidate, bool by_waist, Way& way) const {
        constexpr size_t kFew = 5;
        constexpr int kSteps = 4;
        constexpr float kStep_m = 0.015f;
        if (way.found.pierced.empty() || way.found.pierced.size() > kFew) return;
        std::vector<Vec2> offsets;
        for (int y = -kSteps; y <= kSteps; ++y)
            for (int z = -kSteps; z <= kSteps; ++z) offsets.push_back(kStep_m * Vec2(float(y), float(z)));
        std::stable_sort(offsets.begin(), offsets.end(),
                         [](const Vec2& a, const Vec2& b) { return glm::dot(a, a) < glm::dot(b, b); });
        const Vec3 from = way.alignment.moved;
        for (const Vec2& offset : offsets) {
            if (way.found.pierced.empty()) return;
            const Vec3 moved = from + Vec3(0.0f, offset.x, offset.y);
            const Stance stance = candidate.stance(probe_, moved, !by_waist);
            SkeletonProbe::Found found = probe_.find(candidate.cloth(), moved, stance);
            if (found.pierced.size() >= way.found.pierced.size()) continue;
            way.found = std::move(found);
            way.alignment.moved = moved, way.alignment.stance = stance;
        }
    }

    /// What has sleeves or legs shows how large it is; a tube may be a skirt, a hat or a sock.
    float cost(const Way& way, bool is_of_other_size) const {
        constexpr int kLimbs = 3;
        constexpr float kPierced = 5.0f, kRoundNothing = 30.0f, kOtherTurn = 0.5f, kOffSize = 4.0f;
        float sum = kPierced * float(way.found.pierced.size());
        if (way.parted.round_nothing()) sum += kRoundNothing;
        if (!is_of_kind(way.parted)) sum += kNotItsKind;
        if (is_of_other_size && way.parted.count() < kLimbs) sum += kNotItsKind;
        if (way.turn > 0) sum += kOtherTurn;
        const float ratio = way.found.girth_ratio;
        // An open jacket goes round nothing, but its sleeves tell how large it is.
        if (ratio <= 0.0f) return way.parted.count() > kLimbs - 1 ? sum : sum + kOffSize;
        if (ratio < kTight) sum += kOffSize * std::log(kTight / ratio) + 1.0f;
        if (ratio > kLoose) sum += kOffSize * std::log(ratio / kLoose) + 1.0f;
        return sum + 0.2f * std::abs(std::log(ratio / kUsual));
    }

    /// Most are modelled about a figure that stands on the origin. Few come there by chance when they are
    /// turned the wrong way.
    static bool is_in_place(const Vec3& moved) {
        constexpr float kBeside_m = 0.15f, kAbove_m = 0.25f;
        return std::abs(moved.x) < kBeside_m && std::abs(moved.z) < kBeside_m && std::abs(moved.y) < kAbove_m;
    }

    bool is_of_kind(const Parted& parted) const {
        const std::string& kind = options_.kind;
        if (kind == "trousers") return parted.legs_from_each_other();
        if (kind == "overall") return parted.legs_from_each_other() && parted.over_shoulder();
        if (kind == "skirt") return parted.legs_from_head();
        if (kind == "shirt" || kind == "jacket" || kind == "short_sleeves" || kind == "long_sleeves")
            return parted.over_shoulder();
        return true;
    }

    void note(Alignment& alignment, const Turn& turn, const Unit* unit) const {
        std::vector<std::string>& notes = alignment.notes;
        if (turn.note[0]) notes.push_back(std::string(turn.note) + ", and was turned");
        if (!options_.size_known && !is_stated(unit))
            notes.push_back(unit ? text("its numbers count in ", unit->name, " (--unit ", unit->option, ")")
                                 : text("it was modelled on a body of another size, and was scaled by ",
                                        std::round(alignment.scale * 1000.0f) / 1000.0f));
    }

    void check() const {
        if (best_->parted.round_nothing())
            fail(VFIT_ERROR_DATA,
                 "the garment goes round nothing: neither head, arms nor legs leave it by openings of their "
                 "own, wherever it is held on the body");
        if (!is_of_kind(best_->parted))
            fail(VFIT_ERROR_DATA, "it has not the openings of its kind (", options_.kind, ")");
        if (!best_->found.pierced.empty())
            fail(VFIT_ERROR_DATA, "no place was found where the garment is worn: cloth at ",
                 shown(best_->found.pierced_at), " m closes the way of the ", best_->found.pierced[0],
                 best_->found.pierced.size() > 1 ? " (and others)" : "",
                 "; is it closed there, or is it no garment for a whole body?");
        if (best_->empty > 0.0f && best_->cost >= kNotItsKind)
            fail(VFIT_ERROR_DATA, "no place was found where the garment is worn: wherever it is held, ",
                 std::lround(100.0f * best_->empty), " % of its cloth stays empty, as sleeves without arms");
        const bool is_told = options_.unit_told || options_.scale != 0.0f || options_.size_known;
        if (best_->cost - best_->out_of_place >= (is_told ? kNotItsKind : kMost))
            fail(VFIT_ERROR_DATA, "its size can't be told: no unit makes it fit (--unit or --scale says it)");
    }

    const Pieces& pieces_;
    const CookBody& body_;
    const AlignmentOptions options_;
    SkeletonProbe probe_;
    std::vector<Turn> turns_;
    std::vector<std::pair<float, SkeletonProbe::Found>> tried_;  // of a turn, with their scales
    std::optional<Way> best_;
};

}  // namespace

float plausible_unit(const Model& model, float stated_m, bool told) {
    const float size = largest_extent(model);
    constexpr float kPoint = 1e-9f;
    if (!(size > kPoint)) fail(VFIT_ERROR_DATA, "all of the mesh lies at one place");
    if (is_garments(size * stated_m)) return stated_m;
    float best = 0.0f;
    for (const Unit& unit : kUnits)
        if (is_garments(size * unit.metres) &&
            (best == 0.0f || std::abs(std::log(size * unit.metres)) < std::abs(std::log(size * best))))
            best = unit.metres;
    if (!told) return best > 0.0f ? best : 1.0f / size;
    std::string fitting;
    for (const Unit& unit : kUnits)
        if (is_garments(size * unit.metres))
            fitting += text(fitting.empty() ? "" : ", ", unit.name, " (--unit ", unit.option, ")");
    fail(VFIT_ERROR_DATA, "the mesh is ", size * stated_m, " m large, and garments are ", kSmallest_m, " to ",
         kLargest_m,
         " m: ", fitting.empty() ? std::string("the numbers fit no unit") : "the numbers may be " + fitting);
}

Alignment align(const Pieces& pieces, const CookBody& body, const AlignmentOptions& options) {
    return Aligner(pieces, body, options).run();
}

}  // namespace vfit
