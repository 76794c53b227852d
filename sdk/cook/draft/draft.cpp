// Puts a garment together from its blocks: pieces of both sides, their places about the body, and the seams.
#include "cook/draft/draft.h"

#include <algorithm>
#include <cmath>

#include "cook/draft/blocks.h"
#include "cook/draft/dress_form.h"
#include "cook/draft/measures.h"
#include "core/error.h"

namespace vfit {

namespace {

// Halves of a trunk are held turned outwards about its middle: flat before it, front and back would meet only
// beyond the arms.
constexpr float kTurned_rad = 0.7f;        // 40 degrees
constexpr float kAboveShoulder_m = 0.01f;  // of the shoulder seam, before it is sewn
constexpr float kGap_m = 0.01f;  // between pieces that are held above each other or beside the middle
constexpr float kHemHeight_m =
    0.13f;  // above the soles: there a leg's hem closes about the ankle and not about the foot
constexpr float kSameLength = 0.005f;  // of two edges that are sewn together, share

const std::string kSides[] = {"left", "right"};

class GarmentDrafter {
public:
    GarmentDrafter(const DraftMeasures& measures, const DressForm& form, const GarmentDesign& design)
        : body_(measures), form_(form), design_(design) {
        if (!design.torso) return;
        for (float* length : {&body_.front_length, &body_.back_length, &body_.bust_length})
            *length += design.torso->length_ease_m;
    }

    Pattern draft() {
        pattern_.name = design_.name;
        PatternMaterial material;
        material.name = design_.name;
        std::copy(design_.color.begin(), design_.color.end(), material.color);
        pattern_.materials.push_back(std::move(material));
        if (design_.trousers) trousers_ = draft_trousers(body_, *design_.trousers, design_.torso.has_value());
        if (design_.torso) draft_trunk();
        if (design_.trousers) draft_legs();
        if (design_.sleeve) draft_sleeves();
        if (design_.skirt) draft_skirts();
        if (design_.trousers) sew_legs();
        return std::move(pattern_);
    }

    std::vector<Measurement> finished() const {
        std::vector<Measurement> out;
        for (const GirthLine& line : girths_) {
            const auto it =
                std::find_if(out.begin(), out.end(), [&](const Measurement& m) { return m.key == line.key; });
            if (it == out.end())
                out.push_back({line.key, line.length_m});
            else
                it->value += line.length_m;
        }
        return out;
    }

private:
    // ---- pieces
    // ------------------------------------------------------------------------------------------------------
    void add(Panel panel) {
        panel.material = design_.name;
        pattern_.panels.push_back(std::move(panel));
    }
    /// "_left" and "_right" of a piece that is drawn for the left.
    void add_both(Panel left) {
        const std::string name = left.name;
        left.name += "_left";
        Panel right = right_of(left, name + "_right");
        add(std::move(left));
        add(std::move(right));
    }
    Panel whole_at_waist(const CutLine& half, const char* name, PieceSide side, float above_waist) const {
        return form_.upright(whole(half), name, side, {0.0f, body_.waist_height + above_waist}, 0.0f, 0.0f);
    }

    /// Above the body's waist, where the waist line of the trunk's pieces is held: lower than it will lie, as
    /// the way over chest and back is longer than the way straight up. So the shoulder seams meet just over
    /// the shoulders, and the underarm points below the arms.
    float trunk_above_waist() const {
        if (!design_.torso) return 0.0f;
        const float over =
            0.5f * (body_.front_length + body_.back_length) -
            (body_.shoulder_half_m - body_.side_of_neck_m()) * std::tan(body_.shoulder_slope_rad);
        return std::min(0.0f, body_.shoulder_above_waist + kAboveShoulder_m - over);
    }
    std::string front(const std::string& side) const {
        return design_.torso->front == TorsoDesign::Front::whole ? "front" : "front_" + side;
    }
    std::string back(const std::string& side) const {
        return design_.torso->back_seam ? "back_" + side : "back";
    }

    void draft_trunk() {
        std::optional<JoinedWaist> joined;
        if (design_.trousers) joined = JoinedWaist{trousers_.front_waist_m[0], trousers_.back_waist_m[0]};
        torso_ = draft_torso(body_, *design_.torso, joined);
        for (const GirthLine& line : torso_.girths) girths_.push_back(line);
        const float above = trunk_above_waist();
        const auto place = [&](const CutLine& half, const char* name, PieceSide side, bool in_one) {
            if (in_one) return add(whole_at_waist(half, name, side, above));
            const Vec2 at(0.5f * kGap_m, body_.waist_height + above);
            add_both(form_.upright(closed_left(half), name, side, at, kTurned_rad, 0.0f));
        };
        place(torso_.front, "front", PieceSide::front, design_.torso->front == TorsoDesign::Front::whole);
        place(torso_.back, "back", PieceSide::back, !design_.torso->back_seam);
        if (design_.torso->front == TorsoDesign::Front::closed)
            sew(front("left"), "left middle", front("right"), "right middle");
        if (design_.torso->back_seam) sew(back("left"), "left middle", back("right"), "right middle");
        if (const float height = design_.torso->collar_height_m; height > 0.0f) {
            const float above_neck = above + kGap_m;
            add(whole_at_waist(draft_collar(torso_.front.length("neck"), height), "collar_front",
                               PieceSide::front, body_.front_length + above_neck));
            add(whole_at_waist(draft_collar(torso_.back.length("neck"), height), "collar_back",
                               PieceSide::back, body_.back_length + above_neck));
        }
        for (const std::string& side : kSides) {
            if (design_.torso->collar_height_m > 0.0f) {
                sew("collar_front", side + " side", "collar_back", side + " side");
                sew("collar_front", side + " neck", front(side), side + " neck");
                sew("collar_back", side + " neck", back(side), side + " neck");
            }
            for (const char* seam : {"side skirt", "side hip", "side waist", "side chest", "shoulder"})
                if (torso_.back.length(seam) > 0.0f)
                    sew(front(side), side + " " + seam, back(side), side + " " + seam);
            if (design_.torso->bust_dart > 0.0f)
                sew(front(side), side + " bust dart a", front(side), side + " bust dart b");
            if (design_.torso->waist_dart > 0.0f)
                for (const std::string& piece : {front(side), back(side)})
                    sew(piece, side + " dart a", piece, side + " dart b");
        }
    }

    void draft_sleeves() {
        const SleeveBlock sleeve = draft_sleeve(body_, *design_.sleeve, torso_.front.length("armhole"),
                                                torso_.back.length("armhole"));
        const auto place = [&](CutLine line, const char* name, PieceSide side, float width, float hem) {
            add_both(form_.along_left_arm(line.prefix("left "), name, side, sleeve.cap_height_m,
                                          sleeve.length_m, width, hem));
        };
        place(sleeve.front, "sleeve_front", PieceSide::front, sleeve.front_width_m, sleeve.front_hem_m);
        place(sleeve.back, "sleeve_back", PieceSide::back, sleeve.back_width_m, sleeve.back_hem_m);
        for (const std::string& side : kSides) {
            const std::string before = "sleeve_front_" + side, behind = "sleeve_back_" + side;
            for (const char* seam : {" top", " under"}) sew(before, side + seam, behind, side + seam);
            const float ease = design_.sleeve->cap_ease;
            sew(before, side + " cap", front(side), side + " armhole", ease);
            sew(behind, side + " cap", back(side), side + " armhole", ease);
        }
    }

    void draft_skirts() {
        const auto lengths = [](const CutLine& line) {
            std::vector<float> out{line.length("waist 1")};
            if (const float second = line.length("waist 2"); second > 0.0f) out.push_back(second);
            return out;
        };
        const std::vector<float> front_waist = lengths(torso_.front), back_waist = lengths(torso_.back);
        const SkirtBlock skirt = draft_skirt(body_, *design_.skirt, front_waist, back_waist);
        for (const GirthLine& line : skirt.girths) girths_.push_back(line);
        const auto place = [&](const CutLine& half, const char* name, PieceSide side) {
            // The waist's arc rises to the sides.
            Panel flat = whole(half).panel(name);
            float highest = 0.0f;
            for (const Vec2& p : flat.corners) highest = std::max(highest, p.y);
            add(whole_at_waist(half, name, side, trunk_above_waist() - highest - kGap_m));
        };
        place(skirt.front, "skirt_front", PieceSide::front);
        place(skirt.back, "skirt_back", PieceSide::back);
        for (const std::string& side : kSides) {
            for (const char* seam : {" side hip", " side skirt"})
                sew("skirt_front", side + seam, "skirt_back", side + seam);
            sew_waist(front(side), "skirt_front", side, front_waist.size());
            sew_waist(back(side), "skirt_back", side, back_waist.size());
        }
    }

    void draft_legs() {
        const TrousersDesign& design = *design_.trousers;
        for (const GirthLine& line : trousers_.girths) {
            if (line.key != "waist_girth_m")
                girths_.push_back(line);
            else if (!design_.torso)
                girths_.push_back({design.rise == 0.0f ? line.key : "x_top_girth_m", line.length_m});
        }
        float rise = 0.0f;
        const Panel back = trousers_.back.panel("back");
        for (const Vec2& p : back.corners) rise = std::max(rise, p.y - trousers_.top_m);
        // Worn level: front and back pull each other even where the back rises to the middle.
        if (!design_.torso)
            pattern_.worn_top_m = body_.waist_height + trousers_.top_m + design.band_height_m + 0.25f * rise;
        // Under a torso, below its edge; but so high that the hems can close above the feet, then before that
        // edge.
        float above = 0.0f;
        if (design_.torso)
            above = std::max(trunk_above_waist() - rise - kGap_m,
                             kHemHeight_m - (body_.waist_height - body_.depth(design.hem)));
        const auto place = [&](CutLine line, const char* name, PieceSide side) {
            Panel panel = form_.along_left_leg(line.prefix("left "), name, side, body_.waist_height + above);
            if (design_.torso) {
                const float away = side == PieceSide::back ? -1.0f : 1.0f;
                float& z = panel.translation.z;
                for (const Panel& trunk : pattern_.panels)
                    if (trunk.name.starts_with(side == PieceSide::back ? "back" : "front"))
                        z = away * std::max(away * z, away * trunk.translation.z + kGap_m);
            }
            add_both(std::move(panel));
        };
        place(trousers_.front, "trousers_front", PieceSide::front);
        place(trousers_.back, "trousers_back", PieceSide::back);
        if (design.band_height_m > 0.0f) {
            const auto band = [&](const std::vector<float>& waist, const char* name, PieceSide side,
                                  float above) {
                add(whole_at_waist(draft_band(waist, design.band_height_m, design.gather), name, side,
                                   above));
            };
            band(trousers_.front_waist_m, "band_front", PieceSide::front, trousers_.top_m + kGap_m);
            band(trousers_.back_waist_m, "band_back", PieceSide::back, trousers_.top_m + rise + kGap_m);
        }
    }

    void sew_legs() {
        const TrousersDesign& design = *design_.trousers;
        for (const char* half : {"front", "back"})
            for (const char* seam : {" middle", " crotch"}) {
                const std::string name = std::string("trousers_") + half;
                sew(name + "_left", std::string("left") + seam, name + "_right", std::string("right") + seam);
            }
        for (const std::string& side : kSides) {
            const std::string before = "trousers_front_" + side, behind = "trousers_back_" + side;
            for (const char* seam :
                 {" side shank", " side thigh", " side hip", " inseam thigh", " inseam shank"})
                sew(before, side + seam, behind, side + seam);
            if (design.dart > 0.0f) sew(behind, side + " dart b", behind, side + " dart a");
            if (design.band_height_m > 0.0f) {
                sew("band_front", side + " side", "band_back", side + " side");
                sew_waist("band_front", before, side, trousers_.front_waist_m.size(), design.gather);
                sew_waist("band_back", behind, side, trousers_.back_waist_m.size(), design.gather);
            }
            if (design_.torso) {
                sew_waist(front(side), before, side, trousers_.front_waist_m.size());
                sew_waist(back(side), behind, side, trousers_.back_waist_m.size());
            }
        }
    }

    // ---- seams
    // -------------------------------------------------------------------------------------------------------
    void sew_waist(const std::string& upper, const std::string& lower, const std::string& side, size_t pieces,
                   float gather = 0.0f) {
        for (size_t i = 1; i <= pieces; ++i) {
            const std::string edge = side + " waist " + std::to_string(i);
            sew(lower, edge, upper, edge, gather);
        }
    }

    EdgeName edge(const std::string& panel, const std::string& label) const {
        for (uint32_t p = 0; p < pattern_.panels.size(); ++p) {
            if (pattern_.panels[p].name != panel) continue;
            const auto& edges = pattern_.panels[p].edges;
            for (uint32_t e = 0; e < edges.size(); ++e)
                if (edges[e].label == label) return {p, e};
        }
        fail(VFIT_ERROR_UNKNOWN, "draft: there is no edge ", label, " of panel ", panel);
    }

    /// The first edge is longer by that share.
    void sew(const std::string& panel_a, const std::string& label_a, const std::string& panel_b,
             const std::string& label_b, float longer = 0.0f) {
        const Stitch stitch{edge(panel_a, label_a), edge(panel_b, label_b)};
        const auto length = [&](const EdgeName& name) {
            const Panel& panel = pattern_.panels[name.panel];
            return edge_length(panel, panel.edges[name.edge]);
        };
        const float a = length(stitch.a), b = length(stitch.b) * (1.0f + longer);
        if (std::abs(a - b) > kSameLength * b)
            fail(VFIT_ERROR_DATA, "draft: ", panel_a, " ", label_a, " is ", a, " m long, ", panel_b, " ",
                 label_b, " wants ", b, " m");
        pattern_.stitches.push_back(stitch);
    }

    DraftMeasures body_;
    const DressForm& form_;
    const GarmentDesign& design_;
    Pattern pattern_;
    TorsoBlock torso_;
    TrousersBlock trousers_;
    std::vector<GirthLine> girths_;
};

/// The girths that the garment is chosen by: what it lies close to.
std::vector<Measurement> nominal_of(const GarmentDesign& design, const DraftMeasures& body) {
    std::vector<Measurement> out;
    if (design.torso) out.push_back({"chest_girth_m", body.chest});
    if (design.skirt || design.trousers) {
        out.push_back({"waist_girth_m", body.waist});
        out.push_back({"hip_girth_m", body.hip});
    }
    return out;
}

}  // namespace

DraftedGarment draft(const BodyModel& model, const GarmentDesign& design) {
    const DraftMeasures body = measure_default_body(model, design.sex);
    const DressForm form(model, design.sex);
    const std::vector<Measurement> own = nominal_of(design, body);
    DraftedGarment out;
    float nearest = INFINITY;
    for (size_t i = 0; i < design.labels.size(); ++i) {
        const DraftMeasures measures = graded(body, design.girths[i]);
        DraftedSize size;
        size.label = design.labels[i];
        size.nominal = nominal_of(design, measures);
        try {
            GarmentDrafter drafter(measures, form, design);
            size.pattern = drafter.draft();
            size.finished = drafter.finished();
        } catch (const Error& e) {
            fail(e.code(), "design ", design.name, ", size ", size.label, ": ", e.what());
        }
        // What hangs on the shoulders goes by the chest alone: a trunk that is too narrow there cannot be
        // sewn around the body.
        const size_t count = design.torso ? 1 : own.size();
        float distance = 0.0f;
        for (size_t k = 0; k < count; ++k) distance += std::pow(size.nominal[k].value - own[k].value, 2.0f);
        if (distance < nearest) nearest = distance, out.base = i;
        out.sizes.push_back(std::move(size));
    }
    return out;
}

}  // namespace vfit
