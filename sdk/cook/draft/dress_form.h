// The default body at rest as a dress form: where a flat piece is held about it, clear of it, before it is
// sewn.
#pragma once

#include "body/body_model.h"
#include "cook/draft/cut_line.h"
#include "cook/draft/measures.h"
#include "cook/pattern/pattern.h"

namespace vfit {

enum class PieceSide { front, back };

class DressForm {
public:
    DressForm(const BodyModel& model, vfit_sex sex);

    /// A piece of the trunk, or of a leg: `at` is where its y = 0 and its middle are held, z chosen clear of
    /// the body. `turned_rad` turns a left piece outwards about the upright line through `at`; `leaning_rad`
    /// moves its lower end to the person's left.
    Panel upright(const CutLine& line, std::string name, PieceSide side, const Vec2& at, float turned_rad,
                  float leaning_rad) const;
    /// A piece of the left sleeve, along the arm.
    Panel along_left_arm(const CutLine& line, std::string name, PieceSide side, float cap_height_m,
                         float length_m, float width_m, float hem_m) const;

    /// A piece of the left leg, its y = 0 at that height: the fork beside the middle, the hem's middle before
    /// the leg's.
    Panel along_left_leg(const CutLine& line, std::string name, PieceSide side, float height) const;

private:
    /// Moves the panel along `direction` until the body behind it is clear of it.
    void clear_of_body(Panel& panel, const Vec3& direction) const;

    EvaluatedBody body_;
    Vec3 shoulder_, wrist_, hip_, ankle_;
};

/// The right side's panel from the left one's, and its place.
Panel right_of(const Panel& left, std::string name);

}  // namespace vfit
