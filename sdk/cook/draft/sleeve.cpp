// The sleeve block: two pieces whose caps fit the armhole.
#include <algorithm>
#include <cmath>

#include "cook/draft/blocks.h"
#include "core/error.h"

namespace vfit {

namespace {

constexpr float kLeastSeam_m = 0.03f;  // of the seam below the arm

/// The cap from the top (0, height) to the underarm point (-width, 0): an S that is level at both.
CutLine cap(float width, float height) {
    CutLine line(Vec2(0.0f, height));
    line.cubic(Vec2(-0.45f * width, height), Vec2(-0.55f * width, 0.0f), Vec2(-width, 0.0f), "cap");
    return line;
}

/// The value between low and high at which the growing function is as wanted.
template <typename Function>
float solve(float low, float high, float wanted, const Function& value) {
    for (int i = 0; i < 40; ++i) {
        const float middle = 0.5f * (low + high);
        (value(middle) < wanted ? low : high) = middle;
    }
    return 0.5f * (low + high);
}

float width_of_cap(float length, float height) {
    return solve(0.0f, length, length, [&](float width) { return cap(width, height).length("cap"); });
}

CutLine piece(float width, float hem, float height, float length) {
    CutLine line(Vec2(-hem, -length));
    line.line(Vec2(0.0f, -length), "hem").line(Vec2(0.0f, height), "top").append(cap(width, height));
    return line.line(Vec2(-hem, -length), "under");
}

}  // namespace

SleeveBlock draft_sleeve(const DraftMeasures& body, const SleeveDesign& design, float front_armhole_m,
                         float back_armhole_m) {
    const float front = front_armhole_m * (1.0f + design.cap_ease),
                back = back_armhole_m * (1.0f + design.cap_ease);
    const float wanted = body.upper_arm + design.width_ease_m;
    const auto width = [&](float height) { return width_of_cap(front, height) + width_of_cap(back, height); };
    // The flattest cap is the widest: the sleeve's width is given, the cap's height follows from the armhole.
    constexpr float kFlattest_m = 0.01f;
    const float highest = 0.95f * std::min(front, back);
    if (width(kFlattest_m) < wanted)
        fail(VFIT_ERROR_DATA,
             "the armhole is too small for the sleeve's width: \"torso.armhole_drop_m\", "
             "\"sleeve.width_ease_m\"");
    SleeveBlock block;
    block.cap_height_m = solve(kFlattest_m, highest, -wanted, [&](float height) { return -width(height); });
    block.front_width_m = width_of_cap(front, block.cap_height_m);
    block.back_width_m = width_of_cap(back, block.cap_height_m);
    block.length_m = body.arm_length * design.length - block.cap_height_m;
    if (block.length_m < kLeastSeam_m)
        fail(VFIT_ERROR_DATA,
             "the sleeve ends within its cap: \"sleeve.length\" or a smaller \"torso.armhole_drop_m\"");

    // Where the hem is: the arm narrows from its widest place over the elbow, halfway down, to the wrist.
    const float share = std::clamp(design.length, 0.2f, 1.0f);
    const float arm = share < 0.55f ? glm::mix(body.upper_arm, body.elbow, (share - 0.2f) / 0.35f)
                                    : glm::mix(body.elbow, body.wrist, (share - 0.55f) / 0.45f);
    // Both pieces narrow alike, so that their seams are equally long.
    const float narrowing = 0.5f * (wanted - (arm + design.hem_ease_m));
    block.front_hem_m = block.front_width_m - narrowing;
    block.back_hem_m = block.back_width_m - narrowing;
    if (std::min(block.front_hem_m, block.back_hem_m) < 0.03f)
        fail(VFIT_ERROR_DATA, "the sleeve's hem is too narrow: \"sleeve.hem_ease_m\"");
    block.front = piece(block.front_width_m, block.front_hem_m, block.cap_height_m, block.length_m);
    block.back = piece(block.back_width_m, block.back_hem_m, block.cap_height_m, block.length_m);
    return block;
}

}  // namespace vfit
