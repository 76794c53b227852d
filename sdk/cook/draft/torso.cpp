// The torso block: front and back from the shoulder to the waist or to a hem below it.
#include <algorithm>
#include <cmath>

#include "cook/draft/blocks.h"
#include "core/error.h"

namespace vfit {

namespace {

// Proportions of the neckline: its depth in front is a fifth of the neck's girth and 1 cm; the back's lies 2
// cm below the side of the neck.
constexpr float kNeckDepthShare = 0.2f, kNeckDepth_m = 0.01f, kBackNeckDepth_m = 0.02f;
// A dart ends before the point that it makes room for, else it makes a cone there.
constexpr float kBustDartShort_m = 0.025f, kWaistDartShort_m = 0.025f, kBackDartShort_m = 0.03f;
// The narrowest dart that can still be sewn, and that can be meshed in every size.
constexpr float kLeastDart_m = 0.01f;
// A bust dart's place on the side seam, below the underarm point.
constexpr float kBustDartBelow_m = 0.055f;
// Of the underarm point above the chest line, where no dart fixes it.
constexpr float kLeastSideChest_m = 0.03f;
// The hem below the hips where it is to be drawn as a line of its own.
constexpr float kBelowHips_m = 0.03f;

Vec2 turned(const Vec2& p, const Vec2& about, float angle) {
    const Vec2 r = p - about;
    return about +
           Vec2(std::cos(angle) * r.x - std::sin(angle) * r.y, std::sin(angle) * r.x + std::cos(angle) * r.y);
}

class TorsoDrafter {
public:
    TorsoDrafter(const DraftMeasures& body, const TorsoDesign& design,
                 const std::optional<JoinedWaist>& joined)
        : body_(body), design_(design), joined_(joined) {}

    TorsoBlock draft() {
        TorsoBlock block;
        chest_ = 0.25f * (body_.chest + design_.chest_ease_m);
        waist_ = 0.25f * (body_.waist + design_.waist_ease_m);
        underarm_ = body_.armpit_above_waist - design_.armhole_drop_m;
        if (underarm_ < 0.06f)
            fail(VFIT_ERROR_DATA, "the armhole reaches down to the waist: \"torso.armhole_drop_m\"");
        side_chest_ = design_.bust_dart > 0.0f
                          ? kBustDartBelow_m
                          : std::max(kLeastSideChest_m, underarm_ - body_.bust_above_waist);
        side_chest_ = std::min(side_chest_, 0.5f * underarm_);

        // The back is drawn freely; the front's side seam then is as long as the back's.
        const float back_wanted = joined_ ? joined_->back_m : waist_,
                    front_wanted = joined_ ? joined_->front_m : waist_;
        const float back_dart = dart(back_wanted), front_dart = dart(front_wanted);
        const Vec2 back_waist(back_wanted + back_dart, 0.0f), front_waist(front_wanted + front_dart, 0.0f);
        const Vec2 underarm(chest_, underarm_), chest(chest_, underarm_ - side_chest_);
        const float side = glm::distance(chest, back_waist);

        const float back_apex_y = underarm_ - kBackDartShort_m;
        block.back = lower(back_waist, back_dart, 0.5f * back_wanted, back_apex_y);
        const Vec2 way = (chest - back_waist) / side;
        side_upright_ = {way.y, way.x};
        side_waist(block.back, chest);
        block.back.line(underarm, "side chest");
        upper(block.back, underarm, body_.back_length, false);

        const float bust_y = body_.front_length - body_.bust_length;
        block.front = lower(front_waist, front_dart, body_.bust_half_m, bust_y - kWaistDartShort_m);
        const Vec2 front_underarm = front_side(block.front, front_waist, side, bust_y);
        upper(block.front, front_underarm, body_.front_length, true);
        block.shoulder_tip = shoulder_tip(body_.front_length);

        for (const float half : {front_wanted, back_wanted}) {
            block.girths.push_back({"chest_girth_m", 2.0f * chest_});
            block.girths.push_back({"waist_girth_m", 2.0f * half});
            if (design_.hem && reaches_hips()) block.girths.push_back({"hip_girth_m", 2.0f * hip_});
        }
        return block;
    }

private:
    float dart(float waist) const {
        if (design_.waist_dart == 0.0f) return 0.0f;
        return std::max(kLeastDart_m, (chest_ - waist) * design_.waist_dart);
    }

    bool reaches_hips() const { return body_.depth(*design_.hem) > body_.hip_depth() + kBelowHips_m; }

    /// From the middle's lower end to the side of the waist.
    CutLine lower(const Vec2& side, float dart, float dart_place, float apex_y) {
        if (!design_.hem) {
            CutLine line(Vec2(0.0f));
            if (dart == 0.0f) return line.line(side, "waist 1");
            const float place = std::min(dart_place, 0.5f * (side.x + 0.5f * dart));
            const Vec2 a(place - 0.5f * dart, 0.0f), b(place + 0.5f * dart, 0.0f), apex(place, apex_y);
            if (a.x < 0.02f || apex_y < 0.05f)
                fail(VFIT_ERROR_DATA, "the waist is too narrow for its darts: \"torso.waist_dart\"");
            return line.line(a, "waist 1").line(apex, "dart a").line(b, "dart b").line(side, "waist 2");
        }
        const float depth = body_.depth(*design_.hem), hips = body_.hip_depth();
        if (depth < 0.05f) fail(VFIT_ERROR_DATA, "the hem lies at the waist: \"torso.hem\"");
        hip_ = 0.25f * (body_.hip + design_.hip_ease_m);
        // A smooth line over the hip: upright at the waist and at the hips.
        const auto over_hip = [&](CutLine& line, const Vec2& hip) -> CutLine& {
            const float third = (side.y - hip.y) / 3.0f;
            return line.cubic(hip + Vec2(0.0f, third), side - Vec2(0.0f, third), side, "side hip");
        };
        if (!reaches_hips()) {
            // As far of the way to the hips' width as the body is there.
            const float at_hem = 0.25f * (body_.girth_between(depth / hips) - body_.waist);
            const float hip_growth = 0.25f * (body_.hip - body_.waist);
            const Vec2 hip(glm::mix(side.x, hip_, std::clamp(at_hem / hip_growth, 0.0f, 1.0f)), -depth);
            CutLine line(Vec2(0.0f, -depth));
            line.line(hip, "hem");
            return over_hip(line, hip);
        }
        const Vec2 hip(hip_, -hips);
        const float out = design_.flare * (depth - hips);
        // Raised at the side, so that the hem hangs level and meets the side seam squarely.
        const Vec2 corner(hip_ + out, -depth + 0.5f * design_.flare * (hip_ + out));
        if (corner.y > hip.y - 0.02f) fail(VFIT_ERROR_DATA, "the hem rises to the hips: \"torso.flare\"");
        CutLine line(Vec2(0.0f, -depth));
        line.quadratic(Vec2(0.5f * corner.x, -depth), corner, "hem");
        // Below the hips it goes on upright, and flares out bit by bit.
        constexpr float kUpright = 0.3f;
        line.quadratic(Vec2(hip.x, glm::mix(hip.y, corner.y, kUpright)), hip, "side skirt");
        return over_hip(line, hip);
    }

    /// From the waist, where the back of a piece that goes on below it is upright: what hangs a little lower
    /// or higher than it was drawn is as wide there all the same. The front's is the same curve, turned.
    void side_waist(CutLine& line, const Vec2& to) const {
        if (!design_.hem) {
            line.line(to, "side waist");
            return;
        }
        const Vec2 from = line.end(), third = (to - from) / 3.0f,
                   up = side_upright_.x * third + side_upright_.y * Vec2(-third.y, third.x);
        line.cubic(from + up, to - up, to, "side waist");
    }

    /// The front's side seam up to the underarm point, which it returns: "side waist" is that long, the
    /// dart's upper leg is the lower one turned about the dart's point.
    Vec2 front_side(CutLine& line, const Vec2& waist, float side, float bust_y) const {
        const Vec2 point(body_.bust_half_m + kBustDartShort_m, bust_y);
        const bool darted = design_.bust_dart > 0.0f;
        float angle = 0.0f;
        if (darted) {
            if (chest_ - point.x < 0.03f)
                fail(VFIT_ERROR_DATA, "the front is too narrow for its bust dart: \"torso.bust_dart\"");
            const float intake =
                std::max(kLeastDart_m, (body_.front_length - body_.back_length) * design_.bust_dart);
            angle = 2.0f * std::asin(std::min(0.5f, 0.5f * intake / (chest_ - point.x)));
        }
        // The seam's direction from the waist: that at which it ends below the underarm point.
        const auto lower_end = [&](float direction) {
            return waist + side * Vec2(std::cos(direction), std::sin(direction));
        };
        const auto upper_x = [&](float direction) { return turned(lower_end(direction), point, angle).x; };
        float steep = 0.9f * kPi, flat = 0.1f * kPi;
        if (!(upper_x(steep) < chest_ && upper_x(flat) > chest_))
            fail(VFIT_ERROR_DATA, "the waist is too far from the chest's width for its side seams");
        for (int i = 0; i < 60; ++i) {
            const float middle = 0.5f * (steep + flat);
            (upper_x(middle) < chest_ ? steep : flat) = middle;
        }
        const Vec2 low = lower_end(0.5f * (steep + flat)), high = turned(low, point, angle);
        side_waist(line, low);
        if (darted) line.line(point, "bust dart a").line(high, "bust dart b");
        const Vec2 underarm = high + Vec2(0.0f, side_chest_);
        line.line(underarm, "side chest");
        return underarm;
    }

    Vec2 on_shoulder(float x, float length) const {
        return {x, length - (x - body_.side_of_neck_m()) * std::tan(body_.shoulder_slope_rad)};
    }
    Vec2 shoulder_tip(float length) const {
        return on_shoulder(glm::mix(body_.side_of_neck_m(), body_.shoulder_half_m, design_.shoulder), length);
    }

    /// From the underarm point over armhole, shoulder and neckline to the middle.
    void upper(CutLine& line, const Vec2& underarm, float length, bool front) const {
        const float neck = body_.side_of_neck_m() + design_.neck_width_m;
        const Vec2 tip = shoulder_tip(length), side = on_shoulder(neck, length);
        if (tip.x - side.x < 0.02f)
            fail(VFIT_ERROR_DATA,
                 "the shoulder seam is shorter than 2 cm: \"torso.shoulder\", \"torso.neck_width_m\"");
        if (tip.y - underarm.y < 0.06f)
            fail(VFIT_ERROR_DATA, "the armhole is too shallow: \"torso.shoulder\"");
        // Leaves the shoulder squarely and comes to the underarm point level, hollowed where the arm bends
        // forwards.
        const float out = std::max(underarm.x - tip.x, 0.0f), hollow = front ? 0.018f : 0.008f;
        const Vec2 down = -Vec2(std::sin(body_.shoulder_slope_rad), std::cos(body_.shoulder_slope_rad));
        line.cubic(underarm - Vec2(0.75f * out + hollow, 0.0f), tip + 0.55f * (tip.y - underarm.y) * down,
                   tip, "armhole");
        line.line(side, "shoulder");
        const float depth = front ? kNeckDepthShare * body_.neck + kNeckDepth_m + design_.neck_depth_m
                                  : kBackNeckDepth_m + design_.back_neck_depth_m;
        const Vec2 middle(0.0f, length - depth);
        if (middle.y > side.y - 0.004f)
            fail(VFIT_ERROR_DATA, "the neckline rises to the middle: \"torso.neck_depth_m\"");
        if (middle.y < 0.03f)
            fail(VFIT_ERROR_DATA, "the neckline reaches down to the waist: \"torso.neck_depth_m\"");
        const float drop = side.y - middle.y;
        if (front && design_.v_neck)
            line.quadratic(glm::mix(side, middle, 0.5f) + Vec2(-0.01f, -0.01f), middle, "neck");
        else
            line.cubic(side - Vec2(0.1f * neck, 0.6f * drop), middle + Vec2(0.6f * neck, 0.0f), middle,
                       "neck");
    }

    const DraftMeasures& body_;
    const TorsoDesign& design_;
    const std::optional<JoinedWaist> joined_;
    Vec2 side_upright_{0.0f};  // of the back: the upright, along the way up the side seam and to its left
    float chest_ = 0.0f, waist_ = 0.0f, hip_ = 0.0f, underarm_ = 0.0f, side_chest_ = 0.0f;
};

}  // namespace

TorsoBlock draft_torso(const DraftMeasures& body, const TorsoDesign& design,
                       const std::optional<JoinedWaist>& joined) {
    return TorsoDrafter(body, design, joined).draft();
}

CutLine draft_collar(float neck_m, float height_m) {
    // The neck narrows upwards: by this of the collar's height on each quarter, a slope of 14 degrees.
    constexpr float kSlope = 0.25f;
    const float top = neck_m - kSlope * height_m;
    if (top < 0.5f * neck_m)
        fail(VFIT_ERROR_DATA, "the collar is higher than its neckline allows: \"torso.collar_height_m\"");
    CutLine line(Vec2(0.0f));
    return line.line({neck_m, 0.0f}, "neck").line({top, height_m}, "side").line({0.0f, height_m}, "top");
}

}  // namespace vfit
