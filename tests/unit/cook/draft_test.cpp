// Drafted garments: pieces that can be cut and sewn, of the intended girths, alike in every size, clear of
// the body.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "cook/draft/blocks.h"
#include "cook/draft/draft.h"
#include "core/error.h"
#include "geometry/section.h"
#include "pattern_support.h"

namespace vfit {
namespace {

constexpr float kSameGirth_m = 0.005f;

struct Drafted {
    GarmentDesign design;
    DraftedGarment garment;
};

std::vector<Vec2> outline_of(const Panel& panel, uint32_t an_edge = 8) {
    std::vector<Vec2> out;
    for (const PatternEdge& edge : panel.edges) {
        const std::vector<Vec2> points = sample_edge(panel, edge, an_edge);
        out.insert(out.end(), points.begin(), points.end() - 1);
    }
    return out;
}

/// How much cloth of the panel lies at that height.
float width_at(const Panel& panel, float y) {
    const std::vector<Vec2> outline = outline_of(panel, 64);
    std::vector<float> crossings;
    for (size_t i = 0; i < outline.size(); ++i) {
        const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
        if ((a.y > y) != (b.y > y)) crossings.push_back(glm::mix(a.x, b.x, (y - a.y) / (b.y - a.y)));
    }
    std::sort(crossings.begin(), crossings.end());
    float width = 0.0f;
    for (size_t i = 0; i + 1 < crossings.size(); i += 2) width += crossings[i + 1] - crossings[i];
    return width;
}

const PatternEdge* edge_of(const Panel& panel, const std::string& label) {
    for (const PatternEdge& edge : panel.edges)
        if (edge.label == label) return &edge;
    return nullptr;
}

float labelled_length(const Panel& panel, const std::string& words) {
    float sum = 0.0f;
    for (const PatternEdge& edge : panel.edges)
        if (edge.label.find(words) != std::string::npos) sum += edge_length(panel, edge);
    return sum;
}

bool torso_piece(const Panel& panel) {
    return panel.name.starts_with("front") || panel.name.starts_with("back");
}
bool leg_piece(const Panel& panel) { return panel.name.starts_with("trousers"); }

Vec3 held(const Panel& panel, const Vec2& p) { return panel.rotation * Vec3(p, 0.0f) + panel.translation; }

class Draft : public testing::Test {
protected:
    static void SetUpTestSuite() {
        model = BodyModel::load(VFIT_DATA_DIR "/body.bin");
        for (const vfit_sex sex : {VFIT_SEX_FEMALE, VFIT_SEX_MALE})
            measures[sex] = measure_default_body(*model, sex);
        for (const std::string& name : shipped_designs()) {
            const std::string text = design_text(name);
            if (text.find("\"vfit-sundress\"") != std::string::npos) continue;  // has no panels
            Drafted d;
            d.design = parse_design(bytes_of_text(text));
            d.garment = draft(*model, d.design);
            all[name] = std::move(d);
        }
    }
    static void TearDownTestSuite() { all.clear(); }

    template <typename Function>
    static void for_each_pattern(const Function& check) {
        for (const auto& [name, drafted] : all)
            for (const DraftedSize& size : drafted.garment.sizes) {
                SCOPED_TRACE(name + " " + size.label);
                check(drafted.design, size);
            }
    }

    static inline std::shared_ptr<const BodyModel> model;
    static inline std::map<std::string, Drafted> all;
    static inline std::map<vfit_sex, DraftMeasures> measures;
};

TEST_F(Draft, HasTheSizesOfItsDesignAndABaseNearestToTheDefaultBody) {
    ASSERT_FALSE(all.empty());
    for (const auto& [name, drafted] : all) {
        SCOPED_TRACE(name);
        const std::vector<DraftedSize>& sizes = drafted.garment.sizes;
        ASSERT_GE(sizes.size(), 1u);
        ASSERT_EQ(sizes.size(), drafted.design.labels.size());
        const DraftMeasures& body = measures[drafted.design.sex];
        const auto off = [&](const DraftedSize& size) {
            const Measurement& m = size.nominal.front();
            return std::abs(m.value - (m.key == "chest_girth_m" ? body.chest : body.waist));
        };
        for (size_t i = 0; i < sizes.size(); ++i) {
            EXPECT_EQ(sizes[i].label, drafted.design.labels[i]);
            EXPECT_LE(off(sizes[drafted.garment.base]), off(sizes[i])) << sizes[i].label;
        }
    }
}

TEST_F(Draft, PanelsAreClosedAndCounterClockwise) {
    for_each_pattern([](const GarmentDesign&, const DraftedSize& size) {
        for (const Panel& panel : size.pattern.panels) {
            SCOPED_TRACE(panel.name);
            ASSERT_EQ(panel.corners.size(), panel.edges.size());
            for (size_t e = 0; e < panel.edges.size(); ++e) {
                EXPECT_EQ(panel.edges[e].to, panel.edges[(e + 1) % panel.edges.size()].from);
                EXPECT_GT(edge_length(panel, panel.edges[e]), 0.01f) << panel.edges[e].label;
            }
            EXPECT_GT(area(outline_of(panel)), 0.005f);
        }
    });
}

TEST_F(Draft, OutlinesDoNotCrossThemselves) {
    const auto side = [](const Vec2& a, const Vec2& b, const Vec2& p) {
        return double(b.x - a.x) * double(p.y - a.y) - double(b.y - a.y) * double(p.x - a.x);
    };
    for_each_pattern([&](const GarmentDesign&, const DraftedSize& size) {
        for (const Panel& panel : size.pattern.panels) {
            const std::vector<Vec2> line = outline_of(panel);
            const size_t n = line.size();
            for (size_t i = 0; i < n; ++i)
                for (size_t k = i + 2; k < n; ++k) {
                    if (i == 0 && k == n - 1) continue;
                    const Vec2 &a = line[i], &b = line[(i + 1) % n], &c = line[k], &d = line[(k + 1) % n];
                    // Edges on one line, as those beside a dart, differ from it by rounding.
                    constexpr double kRounding = -1e-14;
                    const bool cross = side(a, b, c) * side(a, b, d) < kRounding &&
                                       side(c, d, a) * side(c, d, b) < kRounding;
                    ASSERT_FALSE(cross) << panel.name << " at " << a.x << " " << a.y;
                }
        }
    });
}

TEST_F(Draft, SewnEdgesAreEquallyLongAndSewnOnce) {
    for_each_pattern([](const GarmentDesign& design, const DraftedSize& size) {
        const Pattern& pattern = size.pattern;
        std::map<std::pair<uint32_t, uint32_t>, int> sewn;
        for (const Stitch& stitch : pattern.stitches) {
            const Panel &a = pattern.panels[stitch.a.panel], &b = pattern.panels[stitch.b.panel];
            const PatternEdge &ea = a.edges[stitch.a.edge], &eb = b.edges[stitch.b.edge];
            float longer = 1.0f;
            if (ea.label.ends_with(" cap")) longer += design.sleeve->cap_ease;
            if (b.name.starts_with("band") && ea.label.find(" waist ") != std::string::npos)
                longer += design.trousers->gather;
            EXPECT_NEAR(edge_length(a, ea) / (edge_length(b, eb) * longer), 1.0f, 0.005f)
                << a.name << " " << ea.label;
            EXPECT_EQ(++sewn[std::make_pair(stitch.a.panel, stitch.a.edge)], 1) << a.name << " " << ea.label;
            EXPECT_EQ(++sewn[std::make_pair(stitch.b.panel, stitch.b.edge)], 1) << b.name << " " << eb.label;
        }
    });
}

TEST_F(Draft, OnlyHemsAndOpeningsStayOpen) {
    for_each_pattern([](const GarmentDesign& design, const DraftedSize& size) {
        std::map<std::pair<uint32_t, uint32_t>, int> sewn;
        for (const Stitch& stitch : size.pattern.stitches)
            for (const EdgeName& name : {stitch.a, stitch.b}) sewn[std::make_pair(name.panel, name.edge)] = 1;
        for (uint32_t p = 0; p < size.pattern.panels.size(); ++p) {
            const Panel& panel = size.pattern.panels[p];
            for (uint32_t e = 0; e < panel.edges.size(); ++e) {
                if (sewn.contains(std::make_pair(p, e))) continue;
                const std::string label = panel.edges[e].label.substr(panel.edges[e].label.find(' ') + 1);
                const bool open_front =
                    design.torso && design.torso->front == TorsoDesign::Front::open && label == "middle";
                const bool sleeveless = !design.sleeve && label == "armhole";
                EXPECT_TRUE(label == "hem" || label == "neck" || label == "top" || open_front || sleeveless)
                    << panel.name << " " << label;
            }
        }
    });
}

TEST_F(Draft, IsBuiltAlikeInEverySize) {
    for (const auto& [name, drafted] : all) {
        const Pattern& first = drafted.garment.sizes.front().pattern;
        for (const DraftedSize& size : drafted.garment.sizes) {
            SCOPED_TRACE(name + " " + size.label);
            ASSERT_EQ(size.pattern.panels.size(), first.panels.size());
            ASSERT_EQ(size.pattern.stitches.size(), first.stitches.size());
            for (size_t p = 0; p < first.panels.size(); ++p) {
                const Panel &a = size.pattern.panels[p], &b = first.panels[p];
                EXPECT_EQ(a.name, b.name);
                ASSERT_EQ(a.edges.size(), b.edges.size());
                for (size_t e = 0; e < a.edges.size(); ++e) {
                    EXPECT_EQ(a.edges[e].label, b.edges[e].label);
                    EXPECT_EQ(a.edges[e].curve, b.edges[e].curve);
                    EXPECT_EQ(a.edges[e].from, b.edges[e].from);
                }
            }
            for (size_t s = 0; s < first.stitches.size(); ++s) {
                EXPECT_EQ(size.pattern.stitches[s].a, first.stitches[s].a);
                EXPECT_EQ(size.pattern.stitches[s].b, first.stitches[s].b);
            }
        }
    }
}

TEST_F(Draft, ChestIsTheBodysAndItsEase) {
    for_each_pattern([](const GarmentDesign& design, const DraftedSize& size) {
        if (!design.torso) return;
        // Just below the underarm point, above any dart.
        float girth = 0.0f;
        for (const Panel& panel : size.pattern.panels) {
            if (!torso_piece(panel)) continue;
            float underarm = -INFINITY;
            for (const PatternEdge& edge : panel.edges)
                if (edge.label.ends_with(" side chest"))
                    underarm = std::max({underarm, panel.corners[edge.from].y, panel.corners[edge.to].y});
            girth += width_at(panel, underarm - 0.001f);
        }
        EXPECT_NEAR(girth, find(size.nominal, "chest_girth_m")->value + design.torso->chest_ease_m,
                    kSameGirth_m);
        EXPECT_NEAR(girth, find(size.finished, "chest_girth_m")->value, kSameGirth_m);
    });
}

TEST_F(Draft, WaistIsTheBodysAndItsEase) {
    for_each_pattern([](const GarmentDesign& design, const DraftedSize& size) {
        const size_t i =
            size_t(std::find(design.labels.begin(), design.labels.end(), size.label) - design.labels.begin());
        const DraftMeasures body = graded(measures[design.sex], design.girths[i]);
        float girth = 0.0f, wanted = body.waist;
        for (const Panel& panel : size.pattern.panels) {
            if (design.torso && torso_piece(panel))
                girth += design.torso->hem ? width_at(panel, 0.0f) : labelled_length(panel, " waist ");
            else if (!design.torso && panel.name.starts_with("band"))
                girth += labelled_length(panel, " waist ");
        }
        if (design.torso)
            wanted += design.trousers ? design.trousers->waist_ease_m : design.torso->waist_ease_m;
        else
            wanted = body.girth_between(design.trousers->rise) + design.trousers->waist_ease_m;
        EXPECT_NEAR(girth, wanted, kSameGirth_m);
        EXPECT_NEAR(girth, find(size.finished, design.torso ? "waist_girth_m" : "x_top_girth_m")->value,
                    kSameGirth_m);
    });
}

TEST_F(Draft, WhatHangsALittleHigherOrLowerIsAsWideAtTheWaist) {
    for_each_pattern([](const GarmentDesign& design, const DraftedSize& size) {
        if (!design.torso || !design.torso->hem) return;
        const auto girth = [&](float y) {
            float sum = 0.0f;
            for (const Panel& panel : size.pattern.panels)
                if (torso_piece(panel)) sum += width_at(panel, y);
            return sum;
        };
        EXPECT_NEAR(girth(0.01f), girth(0.0f), 0.003f);
        EXPECT_NEAR(girth(-0.01f), girth(0.0f), 0.003f);
    });
}

TEST_F(Draft, HipsAreTheBodysAndTheirEase) {
    for_each_pattern([](const GarmentDesign& design, const DraftedSize& size) {
        const Measurement* finished = find(size.finished, "hip_girth_m");
        if (!finished) return;
        const size_t i =
            size_t(std::find(design.labels.begin(), design.labels.end(), size.label) - design.labels.begin());
        const DraftMeasures body = graded(measures[design.sex], design.girths[i]);
        const float depth = body.waist_height - body.hip_height;
        float girth = 0.0f, wanted = body.hip;
        for (const Panel& panel : size.pattern.panels) {
            if (panel.name.starts_with("skirt")) {
                // The cone unrolled: an arc about the centre of the waist's.
                const float radius = edge_of(panel, "left waist 1")->radius_m;
                girth += labelled_length(panel, " waist ") * (radius + depth) / radius;
            } else if (leg_piece(panel) || (torso_piece(panel) && design.torso->hem)) {
                // The crotch begins at this level: just above it.
                girth += width_at(panel, -depth + 0.0005f);
            }
        }
        if (design.skirt)
            wanted += design.skirt->hip_ease_m;
        else
            wanted += design.trousers ? design.trousers->hip_ease_m : design.torso->hip_ease_m;
        EXPECT_NEAR(girth, wanted, kSameGirth_m);
        EXPECT_NEAR(girth, finished->value, kSameGirth_m);
    });
}

TEST_F(Draft, LeftAndRightAreMirrorImages) {
    for_each_pattern([](const GarmentDesign&, const DraftedSize& size) {
        for (const Panel& panel : size.pattern.panels) {
            std::string partner = panel.name;
            if (const size_t at = partner.find("_left"); at != std::string::npos)
                partner.replace(at, 5, "_right");
            std::vector<Vec3> left, right;
            for (const Panel& other : size.pattern.panels)
                for (const Vec2& p : outline_of(other)) {
                    const Vec3 q = held(other, p);
                    if (other.name == panel.name) left.push_back(q);
                    if (other.name == partner) right.push_back({-q.x, q.y, q.z});
                }
            if (panel.name.find("_right") != std::string::npos) continue;
            for (const Vec3& p : left) {
                float nearest = INFINITY;
                for (const Vec3& q : right) nearest = std::min(nearest, glm::distance(p, q));
                ASSERT_LT(nearest, 2e-4f) << panel.name;
            }
        }
    });
}

TEST_F(Draft, IsHeldClearOfTheBodyWithItsOutsideAway) {
    for (const auto& [name, drafted] : all) {
        EvaluatedBody body;
        model->evaluate(model->default_shape(drafted.design.sex), body);
        for (const DraftedSize& size : drafted.garment.sizes)
            for (const Panel& panel : size.pattern.panels) {
                SCOPED_TRACE(name + " " + size.label + " " + panel.name);
                const std::vector<Vec2> outline = outline_of(panel);
                const Quat back = glm::conjugate(panel.rotation);
                int covered = 0;
                for (const Vec3& p : body.positions) {
                    const Vec3 q = back * (p - panel.translation);
                    if (!encloses(outline, Vec2(q))) continue;
                    ++covered;
                    ASSERT_LT(q.z, -0.015f);
                }
                EXPECT_GT(covered, 10);
                const bool behind = panel.name.find("back") != std::string::npos;
                EXPECT_GT((panel.rotation * Vec3(0, 0, 1)).z * (behind ? -1.0f : 1.0f), 0.7f);
            }
    }
}

TEST_F(Draft, StitchesJoinBeginToEnd) {
    for_each_pattern([](const GarmentDesign&, const DraftedSize& size) {
        for (const Stitch& stitch : size.pattern.stitches) {
            const Panel &a = size.pattern.panels[stitch.a.panel], &b = size.pattern.panels[stitch.b.panel];
            const PatternEdge &ea = a.edges[stitch.a.edge], &eb = b.edges[stitch.b.edge];
            const Vec3 a0 = held(a, a.corners[ea.from]), a1 = held(a, a.corners[ea.to]);
            const Vec3 b0 = held(b, b.corners[eb.from]), b1 = held(b, b.corners[eb.to]);
            // Laid together they run the same way, but for the crotch's: its two edges stand away from each
            // other.
            if (ea.label.ends_with("crotch")) continue;
            EXPECT_GT(glm::dot(a1 - a0, b0 - b1), 0.0f)
                << a.name << " " << ea.label << " to " << b.name << " " << eb.label;
        }
    });
}

TEST_F(Draft, WhatHangsOnTheWaistSaysWhereItsEdgeIsWorn) {
    for_each_pattern([](const GarmentDesign& design, const DraftedSize& size) {
        const bool hangs = design.trousers && !design.torso;
        ASSERT_EQ(size.pattern.worn_top_m.has_value(), hangs);
        if (!hangs) return;
        // The band is held a little higher, that it can be sewn on.
        float top = -INFINITY;
        for (const Panel& panel : size.pattern.panels)
            for (const Vec2& p : panel.corners) top = std::max(top, p.y + panel.translation.y);
        EXPECT_LT(*size.pattern.worn_top_m, top);
        EXPECT_GT(*size.pattern.worn_top_m, top - 0.05f);
    });
}

TEST_F(Draft, ACoatIsLongerFromShoulderToWaistByItsLengthEase) {
    GarmentDesign design = all.at("duster").design;
    const auto neck_of = [&](float ease) {
        design.torso->length_ease_m = ease;
        const DraftedGarment garment = draft(*model, design);
        float top = -INFINITY;
        for (const Panel& panel : garment.sizes[garment.base].pattern.panels)
            if (panel.name == "back_left")
                for (const Vec2& p : panel.corners) top = std::max(top, p.y);
        return top;
    };
    EXPECT_NEAR(neck_of(0.02f) - neck_of(0.0f), 0.02f, 1e-4f);
}

TEST_F(Draft, SleevesReachTheWristAndTrousersTheAnkle) {
    const Drafted& shirt = all["shirt_men"];
    const DraftMeasures& body = measures[VFIT_SEX_MALE];
    for (const Panel& panel : shirt.garment.sizes[shirt.garment.base].pattern.panels) {
        if (!panel.name.starts_with("sleeve")) continue;
        EXPECT_NEAR(labelled_length(panel, " top"), 1.02f * body.arm_length, 0.01f);
    }
    const Drafted& pants = all["pants_men"];
    float lowest = INFINITY;
    for (const Panel& panel : pants.garment.sizes[pants.garment.base].pattern.panels)
        for (const Vec2& p : panel.corners) lowest = std::min(lowest, held(panel, p).y);
    EXPECT_NEAR(lowest, body.ankle_height, 0.03f);
}

TEST(DraftMeasures, GrowWithTheGirths) {
    DraftMeasures body;
    body.chest = 0.96f, body.waist = 0.76f, body.hip = 0.93f, body.neck = 0.4f;
    const DraftMeasures same = graded(body, {{"chest_girth_m", 0.96f}, {"waist_girth_m", 0.76f}});
    EXPECT_FLOAT_EQ(same.hip, body.hip);
    EXPECT_FLOAT_EQ(same.neck, body.neck);
    const DraftMeasures larger = graded(body, {{"chest_girth_m", 1.0f}, {"waist_girth_m", 0.8f}});
    EXPECT_NEAR(larger.hip, 0.966f, 1e-4f);
    EXPECT_NEAR(larger.neck, 0.41f, 1e-4f);
    EXPECT_FLOAT_EQ(graded(body, {{"hip_girth_m", 1.1f}}).hip, 1.1f);
}

TEST(DraftMeasures, AreThoseOfAPerson) {
    const auto model = BodyModel::load(VFIT_DATA_DIR "/body.bin");
    for (const vfit_sex sex : {VFIT_SEX_FEMALE, VFIT_SEX_MALE}) {
        const DraftMeasures m = measure_default_body(*model, sex);
        EXPECT_GT(m.front_length, 0.38f);
        EXPECT_LT(m.front_length, 0.52f);
        EXPECT_NEAR(m.front_length, m.back_length, 0.05f);
        EXPECT_NEAR(m.shoulder_slope_rad, 0.38f, 0.12f);
        EXPECT_GT(m.side_of_neck_m(), 0.05f);
        EXPECT_LT(m.side_of_neck_m(), 0.09f);
        EXPECT_LT(m.ankle_height, m.knee_height);
        EXPECT_LT(m.knee_height, m.hip_height);
        EXPECT_LT(m.hip_height, m.waist_height);
        EXPECT_GT(m.crotch_below_waist, m.waist_height - m.hip_height);
        EXPECT_NEAR(m.girth_between(0.0f), m.waist, 0.002f);
        EXPECT_NEAR(m.girth_between(1.0f), m.hip, 0.002f);
    }
}

TEST(CutLine, MirroredRunsTheOtherSideBackwards) {
    CutLine half(Vec2(0.0f, 0.0f));
    half.line({0.2f, 0.0f}, "hem")
        .cubic({0.25f, 0.1f}, {0.15f, 0.2f}, {0.2f, 0.3f}, "side")
        .arc(0.5f, false, {0.0f, 0.28f}, "top");
    const Panel panel = whole(half).panel("piece");
    ASSERT_EQ(panel.edges.size(), 6u);
    EXPECT_EQ(panel.edges[1].label, "left side");
    EXPECT_EQ(panel.edges[4].label, "right side");
    EXPECT_FALSE(panel.edges[3].turns_left);
    EXPECT_FLOAT_EQ(panel.edges[4].control[0].x, -0.15f);
    EXPECT_FLOAT_EQ(edge_length(panel, panel.edges[1]), edge_length(panel, panel.edges[4]));
    EXPECT_GT(area(outline_of(panel)), 0.1f);
    EXPECT_THROW(half.panel("open"), Error);
}

TEST(SleeveBlock, CapFitsTheArmholeAndWidthTheArm) {
    DraftMeasures body;
    body.upper_arm = 0.3f, body.elbow = 0.26f, body.wrist = 0.16f, body.arm_length = 0.55f;
    SleeveDesign design;
    design.length = 1.0f, design.width_ease_m = 0.06f, design.hem_ease_m = 0.06f, design.cap_ease = 0.03f;
    const SleeveBlock sleeve = draft_sleeve(body, design, 0.22f, 0.24f);
    EXPECT_NEAR(sleeve.front.length("cap"), 1.03f * 0.22f, 1e-4f);
    EXPECT_NEAR(sleeve.back.length("cap"), 1.03f * 0.24f, 1e-4f);
    EXPECT_NEAR(sleeve.front_width_m + sleeve.back_width_m, 0.36f, 1e-4f);
    EXPECT_NEAR(sleeve.front.length("hem") + sleeve.back.length("hem"), 0.22f, 1e-4f);
    EXPECT_NEAR(sleeve.front.length("under"), sleeve.back.length("under"), 1e-4f);
    EXPECT_NEAR(sleeve.front.length("top"), 0.55f, 1e-4f);
    EXPECT_THROW(draft_sleeve(body, design, 0.1f, 0.1f), Error);
}

std::string refusal(const std::string& design, const std::string& from, const std::string& to) {
    std::string text = design_text(design);
    const size_t at = text.find(from);
    if (at == std::string::npos) return "the design has no " + from;
    text.replace(at, from.size(), to);
    try {
        draft(*BodyModel::load(VFIT_DATA_DIR "/body.bin"), parse_design(bytes_of_text(text)));
    } catch (const Error& e) {
        return e.what();
    }
    return {};
}

TEST(GarmentDesign, RefusesBadParametersByName) {
    EXPECT_EQ(refusal("shirt_men", "\"format\": \"vfit-design\"", "\"format\": \"vfit\""),
              "design: format is not \"vfit-design\"");
    EXPECT_EQ(refusal("shirt_men", "\"version\": 1", "\"version\": 2"), "design: version is not 1");
    EXPECT_EQ(refusal("shirt_men", "\"body_sex\": \"m\"", "\"body_sex\": \"x\""),
              "design: \"body_sex\" must be one of f, m, is x");
    EXPECT_EQ(refusal("shirt_men", "\"chest_ease_m\": 0.12", "\"chest_ease_m\": 12"),
              "design: \"torso.chest_ease_m\" must be -0.15 to 0.6, is 12");
    EXPECT_EQ(refusal("shirt_men", "\"chest_ease_m\": 0.12, ", ""),
              "design: \"torso.chest_ease_m\" is missing");
    EXPECT_EQ(refusal("shirt_men", "\"chest_ease_m\": 0.12", "\"chest_ease_m\": \"wide\""),
              "design: \"torso.chest_ease_m\" is not a number");
    EXPECT_EQ(refusal("shirt_men", "\"neck_depth_m\"", "\"neck_deep_m\""),
              "design: \"torso.neck_deep_m\" is no field of a design");
    EXPECT_EQ(refusal("shirt_men", "[\"waist\", \"hip\", 0.97]", "[\"hip\", \"waist\", 0.97]"),
              "design: \"torso.hem\" must go from a level down to a lower one");
    EXPECT_EQ(refusal("shirt_men", "[\"waist\", \"hip\", 0.97]", "0.4"),
              "design: \"torso.hem\" is not of the form [\"hip\", \"knee\", 0.5]");
    EXPECT_EQ(refusal("shirt_men", "\"sleeve\"", "\"sleeves\""),
              "design: \"sleeves\" is no field of a design");
    EXPECT_EQ(refusal("shirt_men", "\"torso\"", "\"trunk\""),
              "design: it has neither \"torso\" nor \"trousers\"");
    EXPECT_EQ(refusal("shirt_men", "\"label\": \"S\"", "\"label\": \"XS\""), "design: size XS occurs twice");
    EXPECT_EQ(refusal("sundress_pattern", "\"front\": \"whole\"", "\"front\": \"open\""),
              "design: \"torso.front\" must not be open above \"skirt\" or \"trousers\"");
    EXPECT_EQ(refusal("martial_pants", "\"band_height_m\": 0.04", "\"band_height_m\": 0"),
              "design: \"trousers.gather\" wants a waistband, \"trousers.band_height_m\"");
}

TEST(GarmentDesign, TellsWhatCannotBeDrawnAndInWhichSize) {
    EXPECT_EQ(refusal("shirt_men", "\"width_ease_m\": 0.08", "\"width_ease_m\": 0.5"),
              "design shirt_men, size XS: the armhole is too small for the sleeve's width: "
              "\"torso.armhole_drop_m\", "
              "\"sleeve.width_ease_m\"");
    EXPECT_NE(
        refusal("sundress_pattern", "\"neck_width_m\": 0.04", "\"neck_width_m\": 0.15").find("shoulder seam"),
        std::string::npos);
    EXPECT_EQ(refusal("sundress_pattern", "\"waist_ease_m\": 0.05", "\"waist_ease_m\": 0.5"),
              "design sundress_pattern, size XS: the skirt's hips are no wider than its waist: "
              "\"skirt.hip_ease_m\"");
}

}  // namespace
}  // namespace vfit
