// The trouser block: the left leg's front and back, from the waist or below it to the hem; and the waistband.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "cook/draft/blocks.h"
#include "core/error.h"

namespace vfit {

namespace {

// Of the fork, what the two pieces reach beyond the middle to pass between the legs: the front's part; the
// seat takes the rest.
constexpr float kFrontForkShare = 0.3f;
// What the back is wider than the front at the hips, for the seat. In overalls nothing: the bodice has its
// side seam in the middle.
constexpr float kSeatWider_m = 0.02f;
// What it is wider at knee and hem: so much of what its fork is longer, else its inseam would slant far more
// than the front's.
constexpr float kLegWider = 0.45f;
// How the shaping from hips to waist that no dart takes is shared out: middle of the front, middle of the
// back (the seat angle), each side seam.
constexpr float kFrontShaping = 0.1f, kBackShaping = 0.32f, kSideShaping = 0.29f;
static_assert(kFrontShaping + kBackShaping + 2.0f * kSideShaping > 0.999f);
constexpr float kLeastSeatDart_m = 0.01f, kDartLength_m = 0.1f;
// What the middle of the back rises above the side, to reach over the seat of a person who sits.
constexpr float kBackRise_m = 0.025f;

struct Leg {
    float hip_x;        // of the side seam at the hips
    Vec2 side, middle;  // ends of the upper edge
    float fork_x, fork_y;
    Vec2 knee_out, hem_out;
    float knee_width, hem_width;
    float dart;
};

class TrousersDrafter {
public:
    TrousersDrafter(const DraftMeasures& body, const TrousersDesign& design, bool joined)
        : body_(body), design_(design), joined_(joined) {}

    TrousersBlock draft() {
        hips_ = -(body_.waist_height - body_.hip_height);
        const float top = design_.rise * hips_, crotch = -(body_.crotch_below_waist + design_.crotch_ease_m);
        knee_ = body_.knee_height - body_.waist_height;
        hem_ = -body_.depth(design_.hem);
        if (crotch > hips_ - 0.02f)
            fail(VFIT_ERROR_DATA, "the crotch lies at the hips: \"trousers.crotch_ease_m\"");
        if (hem_ > knee_ - 0.03f) fail(VFIT_ERROR_DATA, "the trousers end at the knee: \"trousers.hem\"");
        const float hip = 0.5f * (body_.hip + design_.hip_ease_m), seat = joined_ ? 0.0f : kSeatWider_m;
        const float waist =
            0.5f * (body_.girth_between(design_.rise) + design_.waist_ease_m) * (1.0f + design_.gather);
        const float shaping = hip - waist;
        const float dart = design_.dart > 0.0f ? std::max(kLeastSeatDart_m, shaping * design_.dart) : 0.0f;
        const float rest = shaping - dart;

        Leg front{}, back{};
        front.hip_x = 0.5f * (hip - seat);
        back.hip_x = 0.5f * (hip + seat);
        front.dart = 0.0f, back.dart = dart;
        front.side = {front.hip_x - kSideShaping * rest, top};
        back.side = {back.hip_x - kSideShaping * rest, top};
        front.middle = {kFrontShaping * rest, top};
        // The slanted edge is as long as the level one would be.
        const float back_edge = back.side.x - kBackShaping * rest;
        if (front.side.x - front.middle.x < 0.08f || back_edge - dart < 0.08f)
            fail(VFIT_ERROR_DATA, "the trousers' waist is too narrow: \"trousers.waist_ease_m\"");
        back.middle = {back.side.x - std::sqrt(back_edge * back_edge - kBackRise_m * kBackRise_m),
                       top + kBackRise_m};

        const float fork = design_.fork * (body_.hip + design_.hip_ease_m);
        front.fork_x = -kFrontForkShare * fork;
        back.fork_x = -(1.0f - kFrontForkShare) * fork;
        front.fork_y = crotch;
        const float wider = kLegWider * (front.fork_x - back.fork_x);
        front.knee_width = 0.5f * (body_.knee + design_.knee_ease_m - wider);
        front.hem_width = 0.5f * (body_.ankle + design_.hem_ease_m - wider);
        back.knee_width = front.knee_width + wider;
        back.hem_width = front.hem_width + wider;
        if (front.hem_width < 0.05f)
            fail(VFIT_ERROR_DATA, "the leg's hem is too narrow: \"trousers.hem_ease_m\"");
        // The front's crease runs down the middle of its thigh; the back's side seam is the front's, moved
        // aside.
        const float crease = 0.5f * (front.hip_x + front.fork_x);
        front.knee_out = {crease + 0.5f * front.knee_width, knee_};
        front.hem_out = {crease + 0.5f * front.hem_width, hem_};
        const Vec2 aside(back.hip_x - front.hip_x, 0.0f);
        back.knee_out = front.knee_out + aside;
        back.hem_out = front.hem_out + aside;
        back.fork_y = fork_of_same_inseam(front, back);

        TrousersBlock block;
        block.front = piece(front);
        block.back = piece(back);
        block.top_m = top;
        block.front_waist_m = {block.front.length("waist 1")};
        block.back_waist_m = {block.back.length("waist 1")};
        if (dart > 0.0f) block.back_waist_m.push_back(block.back.length("waist 2"));
        for (const Leg* leg : {&front, &back}) {
            const float edge = glm::distance(leg->side, leg->middle) - leg->dart;
            block.girths.push_back({"waist_girth_m", 2.0f * edge / (1.0f + design_.gather)});
            block.girths.push_back({"hip_girth_m", 2.0f * leg->hip_x});
        }
        return block;
    }

private:
    Vec2 knee_in(const Leg& leg) const { return leg.knee_out - Vec2(leg.knee_width, 0.0f); }

    /// From the fork down to the knee, hollow, upright at the knee.
    CutLine inseam(const Leg& leg, float fork_y) const {
        const Vec2 fork(leg.fork_x, fork_y), knee = knee_in(leg);
        CutLine line(fork);
        return line.quadratic(Vec2(glm::mix(knee.x, fork.x, 0.15f), glm::mix(fork.y, knee.y, 0.45f)), knee,
                              "inseam thigh");
    }

    /// The back's fork is lowered until its longer way to the knee is as long as the front's.
    float fork_of_same_inseam(const Leg& front, const Leg& back) const {
        const float wanted = inseam(front, front.fork_y).length("inseam thigh");
        float low = knee_ + 0.02f, high = front.fork_y + 0.1f;
        for (int i = 0; i < 40; ++i) {
            const float middle = 0.5f * (low + high);
            (inseam(back, middle).length("inseam thigh") < wanted ? low : high) = middle;
        }
        if (std::abs(low - front.fork_y) > 0.05f)
            fail(VFIT_ERROR_DATA,
                 "the back's inseam cannot be made as long as the front's: \"trousers.knee_ease_m\"");
        return low;
    }

    CutLine piece(const Leg& leg) const {
        const Vec2 hip(leg.hip_x, hips_), seat(0.0f, hips_), fork(leg.fork_x, leg.fork_y);
        CutLine line(leg.hem_out - Vec2(leg.hem_width, 0.0f));
        line.line(leg.hem_out, "hem").line(leg.knee_out, "side shank");
        const float thigh = (hips_ - knee_) * 0.35f;
        line.cubic(leg.knee_out + Vec2(0.0f, thigh), hip - Vec2(0.0f, thigh), hip, "side thigh");
        const float third = (leg.side.y - hips_) / 3.0f;
        line.cubic(hip + Vec2(0.0f, third), glm::mix(leg.side, hip, 0.3f), leg.side, "side hip");
        if (leg.dart > 0.0f) {
            // In the middle of the upper edge and square to it.
            const Vec2 along = glm::normalize(leg.middle - leg.side), into(-along.y, along.x);
            const Vec2 centre = 0.5f * (leg.middle + leg.side);
            const float length = std::min(kDartLength_m, 0.6f * (leg.side.y - hips_));
            line.line(centre - 0.5f * leg.dart * along, "waist 2").line(centre + length * into, "dart b");
            line.line(centre + 0.5f * leg.dart * along, "dart a");
        }
        line.line(leg.middle, "waist 1").line(seat, "middle");
        const Vec2 down = glm::normalize(seat - leg.middle);
        line.cubic(seat + 0.7f * (seat.y - fork.y) * down, fork - Vec2(0.65f * leg.fork_x, 0.0f), fork,
                   "crotch");
        line.append(inseam(leg, leg.fork_y));
        return line.line(leg.hem_out - Vec2(leg.hem_width, 0.0f), "inseam shank");
    }

    const DraftMeasures& body_;
    const TrousersDesign& design_;
    bool joined_;
    float hips_ = 0.0f, knee_ = 0.0f, hem_ = 0.0f;
};

}  // namespace

TrousersBlock draft_trousers(const DraftMeasures& body, const TrousersDesign& design, bool joined) {
    return TrousersDrafter(body, design, joined).draft();
}

CutLine draft_band(const std::vector<float>& waist_m, float height_m, float gather) {
    CutLine line(Vec2(0.0f));
    float x = 0.0f;
    for (size_t i = 0; i < waist_m.size(); ++i) {
        x += waist_m[i] / (1.0f + gather);
        line.line(Vec2(x, 0.0f), "waist " + std::to_string(i + 1));
    }
    return line.line(Vec2(x, height_m), "side").line(Vec2(0.0f, height_m), "top");
}

}  // namespace vfit
