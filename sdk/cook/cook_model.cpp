#include "cook/cook_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <functional>
#include <set>

#include "cloth/garment/cut.h"
#include "cook/body/cook_body.h"
#include "cook/drape/grow_body.h"
#include "cook/drape/upper_edge.h"
#include "cook/model/caps.h"
#include "cook/model/draw.h"
#include "cook/model/envelope.h"
#include "cook/model/even_triangles.h"
#include "cook/model/pieces.h"
#include "cook/model/skeleton_probe.h"
#include "cook/model/surface.h"
#include "cook/worn.h"
#include "core/clock.h"
#include "core/error.h"

namespace vfit {

namespace {

/// Sleeves: what is nearer to an arm than to the trunk, in patches that reach along the upper arm; others
/// only hang beside a hand.
std::vector<uint8_t> sleeves(const Surface& surface, const std::vector<Vec3>& places, const CookBody& body) {
    constexpr float kAlong_m = 0.08f;  // from the shoulder joint
    const size_t count = places.size();
    std::vector<uint8_t> near_arm(count, 0), seed(count, 0);
    for (size_t v = 0; v < count; ++v) {
        const MeshQuery::Closest skin = body.skin().closest(places[v]);
        const BodyPart part = body.parts()[body.indices()[3 * skin.triangle]];
        near_arm[v] = is_arm(part);
        Vec3 joint = body.outline().left_shoulder();
        if (places[v].x < 0.0f) joint.x = -joint.x;
        seed[v] = (part == BodyPart::kLeftUpperArm || part == BodyPart::kRightUpperArm) &&
                  glm::length(skin.point - joint) > kAlong_m;
    }
    std::vector<std::vector<uint32_t>> beside(count);
    for (size_t i = 0; i < surface.indices.size(); ++i)
        beside[surface.indices[i]].push_back(surface.indices[i - i % 3 + (i + 1) % 3]);
    std::vector<uint8_t> out(count, 0);
    std::vector<uint32_t> open;
    for (uint32_t v = 0; v < count; ++v)
        if (seed[v]) out[v] = 1, open.push_back(v);
    while (!open.empty()) {
        const uint32_t v = open.back();
        open.pop_back();
        for (const uint32_t other : beside[v])
            if (near_arm[other] && !out[other]) out[other] = 1, open.push_back(other);
    }
    return out;
}

constexpr float kTrimShare = 0.05f;  // of the whole area: a piece smaller than that is no garment of its own
constexpr float kShellsApart_m = 0.025f;

/// How one of a model's pieces is worn.
struct WornPiece {
    const Piece* piece;
    Parted parted;
    float off_skin_m;  // mean
};

/// "trousers", by what it goes round.
std::string kind_of(const WornPiece& worn, const Surface& surface, const Alignment& alignment,
                    const CookBody& body) {
    const Parted& p = worn.parted;
    if (p.legs_from_each_other()) return p.over_shoulder() ? "overall" : "trousers";
    const TailorLevels& levels = body.outline().levels();
    float low = INFINITY, high = -INFINITY, sleeve_m = 0.0f;
    for (const Vec3& at : surface.positions) {
        const float y = alignment.place(at).y;
        low = std::min(low, y), high = std::max(high, y);
    }
    if (!p.over_shoulder()) return high > levels.bust - 0.05f ? "dress" : "skirt";
    if (!p.legs_from_head()) return "jacket";
    constexpr float kDress = 0.3f;  // of the way from hip to knee
    if (low < glm::mix(levels.hip, levels.knee, kDress)) return "dress";
    for (const auto& opening : surface.openings) {
        Vec3 middle(0.0f);
        for (const uint32_t v : opening)
            middle += alignment.place(surface.positions[v]) / float(opening.size());
        for (const Limb arm : {Limb::left_arm, Limb::right_arm})
            if (middle.x * body.root(arm).x > 0.0f && std::abs(middle.x) > std::abs(body.root(arm).x))
                sleeve_m = std::max(sleeve_m, glm::length(middle - body.root(arm)));
    }
    const float upper_arm_m = glm::length(body.end(Limb::left_arm) - body.root(Limb::left_arm));
    constexpr float kSleeve_m = 0.1f;
    return sleeve_m < kSleeve_m ? "vest" : sleeve_m < 1.2f * upper_arm_m ? "short_sleeves" : "long_sleeves";
}

/// What is simulated: the mesh, the same sheets with even triangles, or a sheet along its outer side. What is
/// not the mesh itself carries it, and it is drawn.
enum class Way { as_modelled, even, anew };

class ModelCook {
public:
    ModelCook(const BodyModel& body_model, const Model& model, const FabricLibrary& fabrics,
              const ModelOptions& options, Jobs& jobs)
        : model_(model),
          fabrics_(fabrics),
          options_(options),
          jobs_(jobs),
          body_(body_model, options.cook.sex, options.cook.shape),
          soup_(make_soup(model,
                          plausible_unit(model, options.alignment.unit_m, options.alignment.unit_told))) {}

    /// anew: what is simulated is a sheet along its outer side. opened: ends that are closed by cloth are cut
    /// open. Where it crosses, or its triangles are too small or too thin to be simulated well, even ones are
    /// tried; where little is left that crosses, even ones of other sizes.
    std::vector<CookedGarment> run(bool anew, bool opened) {
        if (anew) way_ = Way::anew;
        bring_to_body(opened);
        stage_ = 2;
        std::vector<CookedGarment> best;
        std::exception_ptr fault;
        const Pieces as_they_are = pieces_;
        for (const float size : {0.0f, 1.0f, 0.9f, 1.1f}) {
            constexpr uint32_t kFew = 30;
            const bool is_other_size = size > 0.0f && (size != 1.0f || anew);
            if (is_other_size && (best.empty() || crossings_of(best) > kFew)) continue;
            try {
                if (size > 0.0f) even_out(as_they_are, size * kSide_m);
                std::vector<CookedGarment> cooked = cook_pieces();
                if (best.empty() || crossings_of(cooked) < crossings_of(best)) best = std::move(cooked);
            } catch (const Error&) {
                if (stage_ < 3) throw;
                if (!fault) fault = std::current_exception();
            }
            if (options_.remake == Remake::never || (!best.empty() && crossings_of(best) == 0)) break;
        }
        if (best.empty()) std::rethrow_exception(fault);
        return best;
    }
    /// How far it came: to a surface (1), to the body (2), to a garment on it (3).
    int stage() const { return stage_; }

private:
    static constexpr float kSide_m = 0.02f;

    Pieces pieces_of(const Soup& soup) {
        if (way_ == Way::as_modelled) return make_pieces(soup);
        // In a unit that is too large there would be millions of triangles: coarser ones tell the size.
        constexpr float kMostArea_m2 = 6.0f;
        float area_m2 = 0.0f;
        for (const ModelTriangle& t : soup.triangles) area_m2 += area_of(soup.places, t);
        envelope_ = envelope_of(soup, kSide_m * std::max(1.0f, std::sqrt(area_m2 / kMostArea_m2)));
        return make_pieces(soup_of_joined(envelope_, soup.unit_m));
    }

    void even_out(const Pieces& pieces, float side_m) {
        if (way_ == Way::as_modelled) way_ = Way::even;
        even_ = with_even_triangles(pieces, side_m);
        pieces_ = make_pieces(soup_of_joined(even_, pieces.unit_m));
        pieces_.notes = pieces.notes;
    }

    /// With all ends open that may be closed by cloth; then without what was in the way alone, and in the
    /// size that was found.
    void bring_to_body(bool opened) {
        std::vector<std::vector<uint32_t>> caps;
        if (opened && (caps = find_caps(soup_)).empty()) fail(VFIT_ERROR_DATA, "no end is closed by cloth");
        pieces_ = pieces_of(without(soup_, caps));
        stage_ = 1;
        const float scale = align_pieces(false);
        const SkeletonProbe probe(body_);
        const std::vector<uint32_t> all = soup_.indices();
        std::vector<std::vector<uint32_t>> in_the_way;
        for (const auto& cap : caps) {
            std::vector<uint32_t> indices;
            for (const uint32_t t : cap) indices.insert(indices.end(), &all[3 * t], &all[3 * t] + 3);
            if (probe.is_in_the_way(MeshQuery(soup_.places, indices), alignment_.moved, alignment_.stance))
                in_the_way.push_back(cap);
        }
        if (opened && in_the_way.empty() && way_ == Way::as_modelled)
            fail(VFIT_ERROR_DATA, "no end that is closed by cloth is in the way");
        // Triangles made anew are as large as they should be in the unit that was taken at first.
        constexpr float kSame = 1.2f;
        const bool is_same = scale < kSame && scale > 1.0f / kSame;
        const Soup open = without(soup_, caps);
        soup_ = without(soup_, in_the_way);
        if (in_the_way.size() < caps.size() || (way_ == Way::anew && !is_same)) {
            const size_t noted = notes_.size();
            Model envelope = envelope_;
            Pieces pieces = pieces_;
            const Alignment alignment = alignment_;
            const Vec3 moved = moved_;
            try {
                pieces_ = pieces_of(soup_);
                align_pieces(true);
            } catch (const Error&) {
                notes_.resize(noted);
                if (caps.empty()) {
                    // With finer triangles more of it is in the way: it stays as it came there.
                    envelope_ = std::move(envelope), pieces_ = std::move(pieces);
                    alignment_ = alignment, moved_ = moved;
                } else {
                    // What looks like an end closes it all the same; it is drawn.
                    pieces_ = pieces_of(open);
                    align_pieces(true);
                    has_trims_ = true;
                }
            }
        }
        ends_cut_ = in_the_way.size();
        if (ends_cut_ > 0)
            notes_.push_back(text(in_the_way.size(), " ends that were closed by cloth were cut open"));
    }

    /// Places all in metres as the body has them, except for being moved. Returns by how much they were
    /// scaled.
    float align_pieces(bool size_known) {
        AlignmentOptions how = options_.alignment;
        if (options_.cook.kind_told) how.kind = options_.cook.kind;
        how.thickness_m = options_.cook.drape.thickness_m;
        how.size_known = size_known;
        alignment_ = align(pieces_, body_, how);
        notes_.insert(notes_.end(), alignment_.notes.begin(), alignment_.notes.end());
        const float scale = alignment_.scale;
        moved_ += alignment_.moved;
        for (std::vector<Vec3>* places : {&pieces_.places, &soup_.places})
            for (Vec3& p : *places) p = alignment_.place(p);
        soup_.unit_m *= scale;
        alignment_.turn = Mat3(1.0f), alignment_.scale = 1.0f, alignment_.moved = Vec3(0.0f);
        return scale;
    }

    std::vector<CookedGarment> cook_pieces() {
        const std::vector<WornPiece> worn = worn_pieces();
        if (worn.empty()) fail(VFIT_ERROR_DATA, "the garment goes round nothing");
        for (const WornPiece& piece : worn) check_no_bag(piece.parted);
        stage_ = 3;
        std::vector<CookedGarment> out;
        std::set<std::string> names;
        for (const WornPiece& piece : worn) {
            CookedGarment cooked = cook(piece);
            if (worn.size() > 1) {
                const std::string kind = cooked.garment.kind;
                for (int i = 2; cooked.of_set.empty(); ++i)
                    if (const std::string name = i == 2 ? kind : text(kind, i - 1); names.insert(name).second)
                        cooked.of_set = name;
                cooked.garment.name += "_" + cooked.of_set;
            }
            out.push_back(std::move(cooked));
        }
        if (way_ != Way::as_modelled || has_trims_) draw_as_modelled(out);
        std::vector<std::string>& notes = out.front().notes;
        const std::vector<std::string>& read = way_ == Way::anew ? soup_.notes : pieces_.notes;
        const std::array<const std::vector<std::string>*, 3> before = {&notes_, &read, &model_.notes};
        for (const auto* list : before) notes.insert(notes.begin(), list->begin(), list->end());
        return out;
    }

    /// A tube without sleeves and legs that was closed at one end is a hat, a bag or a sock, unless it was
    /// where a figure wears its skirt.
    void check_no_bag(const Parted& parted) const {
        constexpr int kLimbs = 3;
        constexpr float kPlace_m = 0.25f;
        const bool is_in_place = glm::length(moved_) < kPlace_m;
        if (ends_cut_ == 1 && !is_in_place && !options_.cook.kind_told && parted.count() < kLimbs)
            fail(VFIT_ERROR_DATA,
                 "it is closed by cloth at one end and has neither sleeves nor legs, as a hat, a bag or a "
                 "sock "
                 "(a garment is told by --kind)");
    }

    /// Each triangle goes with the garment that is closest to it.
    void draw_as_modelled(std::vector<CookedGarment>& garments) const {
        std::vector<MeshQuery> cloths;
        for (const CookedGarment& cooked : garments)
            cloths.emplace_back(cooked.garment.cut_shape, cooked.garment.mesh.indices);
        constexpr float kBeside_m = 0.08f, kMaxBeside = 0.05f;
        std::vector<std::vector<uint32_t>> triangles(garments.size());
        float beside_m2 = 0.0f, all_m2 = 0.0f;
        for (uint32_t t = 0; t < soup_.triangles.size(); ++t) {
            const auto& v = soup_.triangles[t].vertex;
            const Vec3 middle = (soup_.places[v[0]] + soup_.places[v[1]] + soup_.places[v[2]]) / 3.0f;
            size_t best = 0;
            float least = INFINITY;
            for (size_t g = 0; g < garments.size(); ++g)
                if (const float off = cloths[g].closest(middle).distance; off < least) least = off, best = g;
            triangles[best].push_back(t);
            all_m2 += area_of(soup_.places, soup_.triangles[t]);
            if (least > kBeside_m) beside_m2 += area_of(soup_.places, soup_.triangles[t]);
        }
        if (beside_m2 > kMaxBeside * all_m2)
            fail(VFIT_ERROR_DATA, "the garment is in pieces: ", std::lround(100.0f * beside_m2 / all_m2),
                 " % of it are not joined to what goes round the body");
        for (size_t g = 0; g < garments.size(); ++g)
            if (!triangles[g].empty()) draw(soup_, triangles[g], cloths[g], garments[g].garment);
    }

private:
    /// The garments among them, the innermost first.
    std::vector<WornPiece> worn_pieces() {
        const SkeletonProbe probe(body_);
        float area = 0.0f;
        for (const Piece& piece : pieces_.list) area += piece.area_m2;
        std::vector<WornPiece> out;
        for (const Piece& piece : pieces_.list) {
            const Parted parted =
                probe.parted(pieces_.places, piece.openings, alignment_.moved, alignment_.stance);
            if (piece.area_m2 < kTrimShare * area) {
                has_trims_ = true;
                continue;
            }
            if (const WornPiece* other = shell_of(piece, parted, out)) refuse_shell(piece, *other->piece);
            if (way_ == Way::anew && parted.round_nothing()) continue;  // a part of it that stands off
            for (const WornPiece& other : out)
                if (way_ != Way::anew && goes_on_in(piece, *other.piece)) refuse_part(piece, *other.piece);
            if (parted.round_nothing() && !out.empty()) refuse_part(piece, *out.front().piece);
            out.push_back({&piece, parted, off_skin(piece)});
        }
        std::stable_sort(out.begin(), out.end(),
                         [](const WornPiece& a, const WornPiece& b) { return a.off_skin_m < b.off_skin_m; });
        return out;
    }

    float off_skin(const Piece& piece) const {
        double sum = 0.0;
        for (const uint32_t v : piece.indices)
            sum += double(body_.skin().signed_distance(pieces_.places[v] + alignment_.moved));
        return float(sum / double(piece.indices.size()));
    }

    /// Another piece close beside it that goes round the same, and is as large.
    const WornPiece* shell_of(const Piece& piece, const Parted& parted,
                              const std::vector<WornPiece>& others) const {
        constexpr float kAsLarge = 0.8f, kBeside = 0.8f;
        for (const WornPiece& other : others) {
            if (other.parted.group != parted.group || piece.area_m2 < kAsLarge * other.piece->area_m2)
                continue;
            const MeshQuery cloth(pieces_.places, other.piece->indices);
            size_t beside = 0;
            for (const uint32_t v : piece.indices)
                beside += cloth.closest(pieces_.places[v]).distance < kShellsApart_m;
            if (float(beside) > kBeside * float(piece.indices.size())) return &other;
        }
        return nullptr;
    }

    /// An edge of one lies along an edge of the other, as where they should be sewn together.
    bool goes_on_in(const Piece& piece, const Piece& other) const {
        constexpr float kAlong_m = 0.006f;
        for (const auto& edge : piece.openings)
            for (const auto& beside : other.openings) {
                const auto lies_along = [&](uint32_t v) {
                    return std::any_of(beside.begin(), beside.end(), [&](uint32_t w) {
                        return glm::length(pieces_.places[v] - pieces_.places[w]) < kAlong_m;
                    });
                };
                if (std::all_of(edge.begin(), edge.end(), lies_along)) return true;
            }
        return false;
    }

    [[noreturn]] void refuse_shell(const Piece& piece, const Piece& other) const {
        const MeshQuery cloth(pieces_.places, other.indices);
        double sum = 0.0;
        for (const uint32_t v : piece.indices) sum += double(cloth.closest(pieces_.places[v]).distance);
        fail(VFIT_ERROR_DATA, "the garment is modelled with thickness: there are two shells, ",
             std::lround(1000.0 * sum / double(piece.indices.size())),
             " mm apart; give the outer shell alone");
    }

    [[noreturn]] void refuse_part(const Piece& piece, const Piece& other) const {
        const MeshQuery cloth(pieces_.places, other.indices);
        float nearest = INFINITY;
        for (const uint32_t v : piece.indices)
            nearest = std::min(nearest, cloth.closest(pieces_.places[v]).distance);
        const std::string material = pieces_.material_of(piece);
        fail(VFIT_ERROR_DATA, "the garment is in pieces: ", piece.triangles.size(), " triangles",
             material.empty() ? "" : " of material \"" + material + "\"", " (", pieces_.name_of(piece),
             ") are not joined to the others, ", std::round(nearest * 10000.0f) / 10.0f,
             " mm away; join them by common vertices");
    }

    CookedGarment cook(const WornPiece& worn) {
        const Stopwatch watch;
        Surface surface = make_surface(pieces_, *worn.piece, way_ == Way::anew ? kAnewHole_m : kHole_m);
        const FabricMaterial material = fabrics_.get(options_.cook.fabric);
        const MeshQuery& skin = body_.skin();
        const float thickness = options_.cook.drape.thickness_m;
        CookedGarment out;
        Garment& g = out.garment;
        g.name = options_.name;
        g.kind = options_.cook.kind_told ? options_.cook.kind : kind_of(worn, surface, alignment_, body_);
        g.size_chart = options_.cook.size_chart;
        g.fabric = options_.cook.fabric;
        g.body_sex = body_.sex();
        g.body_shape = body_.settings();
        g.mesh.indices = surface.indices;
        g.mesh.uvs = surface.uvs;
        g.copies = surface.copies;
        g.corners = surface.corners;
        g.cut_shape = surface.positions;
        const std::vector<Vec2> cut = cut_corners(g);
        const WholeCloth cloth{surface.indices, cut, &material};
        const bool as_they_are = way_ != Way::as_modelled || options_.remake == Remake::never;
        if (!as_they_are && (!keeps_layers_apart(cloth, thickness) || is_of_needles(cloth)))
            fail(VFIT_ERROR_DATA, "its triangles are too small for its own layers to be kept apart");
        std::vector<Vec3> places = surface.positions;
        for (Vec3& p : places) p += alignment_.moved;
        out.report.hangs_on = worn.parted.over_shoulder() ? HangsOn::shoulders : HangsOn::waist;
        Hold hold;
        if (out.report.hangs_on == HangsOn::waist) {
            hold.of.assign(places.size(), 0);
            for (const uint32_t v : upper_edge(places, surface.openings, body_.outline().axis_z()))
                hold.of[v] = 1;
        }
        if (options_.cook.drape.watch) options_.cook.drape.watch("placed", places);
        const Inside inside = inside_of(places);
        constexpr float kOtherBody = 0.005f;  // of its vertices that lie well within ours
        if (inside.share > kOtherBody || !alignment_.stance.is_rest()) {
            Stance thinnest = alignment_.stance;
            thinnest.thickness = 0.2f;
            places = grow_body_into(cloth, std::move(places), body_, thinnest, {}, thickness, jobs_);
            if (options_.cook.drape.watch) options_.cook.drape.watch("grown", places);
        }
        push_out(skin, thickness, places);
        if (out.report.hangs_on == HangsOn::shoulders) hold = on_shoulders(places);
        const Draped draped = settle(cloth, std::move(places), hold, body_, options_.cook.drape, jobs_);
        const DrapeReport placed = out.report;
        out.report = draped.report;
        out.report.hangs_on = placed.hangs_on;
        out.report.raised_m = moved_.y;
        g.mesh.positions = draped.positions;
        g.simulated = draped.simulated;
        g.backstop.assign(g.vertex_count(), 0);
        g.on_arm = sleeves(surface, draped.positions, body_);
        g.parts = std::move(surface.parts);
        if (!options_.size_label.empty()) g.sizes.push_back({options_.size_label, {}, {}});
        check_near(draped.positions);
        turn_outside_out(g, skin);
        validate_garment(g, fabrics_);
        out.round = goes_round(g.mesh.positions, g.mesh.indices, body_);
        // What parts the head from the legs goes round the trunk, as a bra does whose band lies aslant.
        const auto is_round = [&](const char* name) {
            return std::find(out.round.begin(), out.round.end(), name) != out.round.end();
        };
        if (worn.parted.legs_from_head() && !is_round("chest") && !is_round("waist") && !is_round("hips"))
            out.round.emplace_back(worn.parted.over_shoulder() ? "chest" : "hips");
        check_still_on(worn, g, surface);
        if (out.report.hangs_on == HangsOn::shoulders) check_on_shoulders(hold, g);
        check_shape(out.report, g.mesh.positions);
        check_free(out.report, surface.indices.size() / 3);
        check_worn(out.round, options_.cook.kind_told ? options_.cook.kind : "");
        if (worn.parted.over_shoulder()) out.round.push_back("shoulders");
        out.notes = surface.notes;
        if (way_ != Way::as_modelled)
            out.notes.push_back(text(way_ == Way::anew
                                         ? "what is simulated was made anew along its outer side, with "
                                         : "it is simulated with even triangles, ",
                                     g.mesh.indices.size() / 3, way_ == Way::anew ? " triangles" : " of them",
                                     "; what was modelled is drawn and goes with it"));
        add_notes(cloth, thickness, inside, draped, out.notes);
        for (const auto& opening : surface.openings) out.openings_m.push_back(surface.length_of(opening));
        out.report.seconds = watch.ms() / 1000.0;
        return out;
    }

    /// Each limb leaves it by the openings by which it did when it was put on.
    void check_still_on(const WornPiece& worn, const Garment& g, const Surface& surface) const {
        const SkeletonProbe probe(body_);
        const MeshQuery cloth(g.mesh.positions, g.mesh.indices);
        const Parted now = probe.parted(g.mesh.positions, surface.openings, Vec3(0.0f), Stance());
        constexpr std::array<const char*, 5> kEnds = {"head", "left arm", "right arm", "left leg",
                                                      "right leg"};
        for (size_t a = 0; a < kEnds.size(); ++a)
            for (size_t b = 0; b < a; ++b) {
                if ((now.group[a] == now.group[b]) == (worn.parted.group[a] == worn.parted.group[b]))
                    continue;
                // The end of a sleeve may hang before a hand.
                if (probe.is_beyond(Parted::End(a), cloth) || probe.is_beyond(Parted::End(b), cloth))
                    continue;
                fail(VFIT_ERROR_DATA, "the garment comes off: when it had fallen, the ", kEnds[a],
                     " was no longer in it as when it was put on");
            }
    }

    /// Where it lay on both shoulders it still does.
    static void check_on_shoulders(const Hold& hold, const Garment& g) {
        constexpr float kStill = 0.15f;  // of what lay there
        std::array<size_t, 2> lay{}, lies{};
        for (size_t v = 0; v < g.simulated.size(); ++v) {
            const size_t side = g.mesh.positions[v].x > 0.0f;
            lay[side] += hold.of[v], lies[side] += !g.simulated[v];
        }
        for (size_t side = 0; side < 2; ++side)
            if (float(lies[side]) < kStill * float(lay[side]) || lies[0] + lies[1] == 0)
                fail(VFIT_ERROR_DATA, "the garment slides off the ", side ? "left" : "right",
                     " shoulder of this body: nearly nothing of it lies there when it has fallen");
    }

    /// What can't be where it was put on is thrown off.
    static void check_near(const std::vector<Vec3>& places) {
        constexpr float kThrown_m = 5.0f;
        for (const Vec3& p : places)
            if (!(glm::length(p) < kThrown_m))
                fail(VFIT_ERROR_DATA,
                     "the garment comes off: as it fell it was thrown off the body, for which it is too "
                     "small");
    }

    /// What is stretched to rags, or lies about the feet, was not made for a body as it was put on.
    static void check_shape(const DrapeReport& report, const std::vector<Vec3>& places) {
        constexpr float kRags = 0.8f, kBelowSoles_m = -0.3f;
        if (report.strain_p99 > kRags)
            fail(VFIT_ERROR_DATA, "the garment is not worn: a hundredth of its sides are stretched by ",
                 std::lround(100.0f * report.strain_p99), " % or more");
        for (const Vec3& p : places)
            if (p.y < kBelowSoles_m)
                fail(VFIT_ERROR_DATA, "the garment is not worn: it reaches ", std::lround(-100.0f * p.y),
                     " cm below the soles: is it larger than its body (--unit, --scale)?");
    }

    /// A few places at an armpit or a collar are told; more is a garment that is not on.
    static void check_free(const DrapeReport& report, size_t triangles) {
        constexpr float kMost = 0.05f;
        if (float(report.skin_crossings) > kMost * float(triangles))
            fail(VFIT_ERROR_DATA, "the garment is not worn: where it came to rest, the skin goes through ",
                 report.skin_crossings, " of its ", triangles, " triangles, most of them at the ",
                 report.crossed_at);
    }

    /// The cloth on the shoulders stays there while the rest falls.
    Hold on_shoulders(const std::vector<Vec3>& places) const {
        constexpr float kNeck_m = 0.03f, kBelowJoint_m = 0.03f, kOver_m = 0.04f, kUpwards = 0.6f;
        const Vec3 joint = body_.outline().left_shoulder();
        Hold hold;
        hold.worn_by = false;
        hold.slack_m = 0.02f;
        for (const Vec3& p : places) {
            const bool is_there =
                std::abs(p.x) > kNeck_m && std::abs(p.x) < joint.x && p.y > joint.y - kBelowJoint_m;
            const auto closest = body_.skin().closest(p);
            hold.of.push_back(is_there && closest.distance < kOver_m && closest.normal.y > kUpwards);
        }
        return hold;
    }

    /// Where many long triangles meet in a point, all of them are in contact there.
    static bool is_of_needles(const WholeCloth& cloth) {
        constexpr float kMinHeight = 0.2f;  // of the mean side
        double height = 0.0;
        for (size_t i = 0; i + 2 < cloth.cut.size(); i += 3) {
            const Vec2 a = cloth.cut[i + 1] - cloth.cut[i], b = cloth.cut[i + 2] - cloth.cut[i];
            const float longest = std::max({glm::length(a), glm::length(b), glm::length(b - a)});
            if (longest > 0.0f) height += double(std::abs(a.x * b.y - a.y * b.x) / longest);
        }
        return height < double(kMinHeight * mean_side(cloth)) * double(cloth.cut.size() / 3);
    }

    struct Inside {
        float share = 0.0f;      // of the vertices that lie in the body by more than a centimetre
        float deepest_m = 0.0f;  // of any
    };
    Inside inside_of(const std::vector<Vec3>& places) const {
        constexpr float kDeep_m = 0.01f;
        const MeshQuery posed(body_.leaving(alignment_.stance, 0.0f), body_.indices());
        Inside out;
        size_t inside = 0;
        for (const Vec3& p : places) {
            const float distance = posed.signed_distance(p);
            inside += distance < -kDeep_m;
            out.deepest_m = std::max(out.deepest_m, -distance);
        }
        out.share = float(inside) / float(places.size());
        return out;
    }

    void add_notes(const WholeCloth& cloth, float thickness_m, const Inside& inside, const Draped& draped,
                   std::vector<std::string>& notes) const {
        const auto percent = [](float share) { return int(share * 100.0f + 0.5f); };
        constexpr float kMuch = 0.05f;
        if (moved_.z != 0.0f)
            notes.push_back(text("it stood ", percent(std::abs(moved_.z)), " cm too far ",
                                 moved_.z < 0.0f ? "forward" : "back", " and was moved"));
        if (inside.share > kMuch)
            notes.push_back(text(percent(inside.share), " % of the vertices lay in the body, up to ",
                                 percent(inside.deepest_m), " cm deep: it was modelled on a slimmer one"));
        constexpr float kCoarse_m = 0.04f;
        const int side_mm = int(mean_side(cloth) * 1000.0f + 0.5f);
        if (mean_side(cloth) > kCoarse_m)
            notes.push_back(
                text("its triangles are ", side_mm, " mm large: it will fold coarsely (20 mm do well)"));
        if (!keeps_layers_apart(cloth, thickness_m))
            notes.push_back(
                text("its triangles are ", side_mm,
                     " mm large: too small for its own layers to be kept apart while it settled (20 mm do "
                     "well)"));
        add_drape_notes(draped.report, notes);
    }

    // Around: smaller ones are buttonholes, eyelets and slips of the modeller; of a surface that was made
    // anew no sleeve is as narrow.
    static constexpr float kHole_m = 0.03f, kAnewHole_m = 0.12f;
    const Model& model_;
    const FabricLibrary& fabrics_;
    const ModelOptions& options_;
    Jobs& jobs_;
    const CookBody body_;
    Soup soup_;
    Model envelope_, even_;  // where what is simulated is not the mesh itself
    Way way_ = Way::as_modelled;
    bool has_trims_ = false;
    size_t ends_cut_ = 0;
    int stage_ = 0;
    Pieces pieces_;
    Alignment alignment_;
    Vec3 moved_{0.0f};  // in all
    std::vector<std::string> notes_;
};

}  // namespace

std::vector<CookedGarment> cook_model(const BodyModel& body_model, const Model& model,
                                      const FabricLibrary& fabrics, const ModelOptions& options, Jobs& jobs) {
    check_no_strays(model);
    // Each way as it was modelled, then with its ends opened: the first that is worn without a crossing, else
    // the one with the fewest.
    std::vector<CookedGarment> best;
    std::exception_ptr fault;
    int stage = -1;  // of the fault: what is told is of the way that came furthest
    const auto try_out = [&](bool anew, bool opened) {
        if (!best.empty() && crossings_of(best) == 0) return;
        ModelCook cook(body_model, model, fabrics, options, jobs);
        try {
            std::vector<CookedGarment> cooked = cook.run(anew, opened);
            if (best.empty() || crossings_of(cooked) < crossings_of(best)) best = std::move(cooked);
        } catch (const Error&) {
            if (cook.stage() <= stage) return;
            fault = std::current_exception();
            stage = cook.stage();
        }
    };
    if (options.remake != Remake::always)
        for (const bool opened : {false, true}) try_out(false, opened);
    if (options.remake != Remake::never)
        for (const bool opened : {false, true}) try_out(true, opened);
    if (best.empty()) std::rethrow_exception(fault);
    return best;
}

}  // namespace vfit
