#include "scan/scanned_body.h"

#include <algorithm>
#include <cmath>

#include "avatar/avatar_measures.h"
#include "core/error.h"

namespace vfit {

namespace {

struct Girth {
    const char *measure, *slider;
    float slope_m;  // of the girth, a whole slider: hardly differs from body to body. Of limbs twice that:
                    // hips move them too
};
constexpr Girth kGirths[] = {
    {"chest_girth_m", "measure-bust-circ", 0.156f}, {"waist_girth_m", "measure-waist-circ", 0.100f},
    {"hip_girth_m", "measure-hips-circ", 0.137f},   {"thigh_girth_m", "measure-thigh-circ", 0.060f},
    {"neck_girth_m", "measure-neck-circ", 0.040f},  {"upper_arm_girth_m", "measure-upperarm-circ", 0.060f}};
constexpr int kSteps = 7;
constexpr float kStill_m = 0.0005f;  // a step that moves no measure farther has met them, or cannot
constexpr float kSliderEnd = 0.9f;
constexpr float kLeastScale = 0.8f, kMostScale = 1.25f;

}  // namespace

ScannedBody scanned_body(const std::shared_ptr<const BodyModel>& body, const FitModel& fit,
                         const FitShape& shape, const std::vector<Measurement>& measured, vfit_sex sex) {
    ScannedBody out;
    out.shape.resize(body->parameters().size());
    fit.body_shape(*body, shape, out.shape);
    const auto tape = [&] { return measure_avatar(Avatar(body, {sex}, out.shape, out.scale), sex); };
    const auto value = [](const std::vector<Measurement>& list, const char* key) {
        const Measurement* m = find(list, key);
        return m ? m->value : 0.0f;
    };
    // How far the farther one was from its measure.
    const auto meet_scale = [&](const std::vector<Measurement>& now) {
        float missed_m = 0.0f;
        const auto meet = [&](float& scale, const char* key) {
            const float wanted = value(measured, key), is = value(now, key);
            if (!(wanted > 0.0f && is > 0.0f)) return;
            const float before = scale;
            scale = std::clamp(scale * wanted / is, kLeastScale, kMostScale);
            missed_m = std::max(missed_m, is * std::abs(scale / before - 1.0f));
        };
        meet(out.scale.y, "stature_m"), meet(out.scale.x, "shoulder_breadth_m");
        return missed_m;
    };
    std::vector<Measurement> now = tape();
    float missed_m = meet_scale(now);
    ScannedBody good = out;
    for (int step = 0; step < kSteps; ++step) {
        for (const Girth& girth : kGirths) {
            const int parameter = body->parameter(girth.slider);
            const float wanted = value(measured, girth.measure);
            if (parameter < 0 || wanted <= 0.0f) continue;
            float& slider = out.shape[size_t(parameter)];
            const float before = slider;
            slider = std::clamp(slider + (wanted - value(now, girth.measure)) / girth.slope_m, -kSliderEnd,
                                kSliderEnd);
            missed_m = std::max(missed_m, girth.slope_m * std::abs(slider - before));
        }
        if (missed_m < kStill_m) return good;
        try {
            now = tape();
        } catch (const Error&) {  // a body that has not the form of a person: the one before it will do
            return good;
        }
        good = out;
        missed_m = meet_scale(now);
    }
    return out;
}

}  // namespace vfit
