// The height of a standing ankle: one for the whole floor, found in the first second of standing and
// corrected after that more slowly than is seen.
#pragma once

namespace vfit {

class StandingLevel {
public:
    /// `height_m`: mean height of the ankles that stand in a new body, `dt_s` after the one before.
    void update(float height_m, float dt_s);

    /// `otherwise` before any foot stood.
    float value(float otherwise) const { return known_ ? level_m_ : otherwise; }

private:
    bool known_ = false;
    float level_m_ = 0.0f;
    float stood_s_ = 0.0f;      // on this floor
    float elsewhere_s_ = 0.0f;  // on end, on another one
};

}  // namespace vfit
