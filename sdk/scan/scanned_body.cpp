#include "scan/scanned_body.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "avatar/avatar_measures.h"
#include "core/error.h"

namespace vfit {

namespace {

struct Girth {
    const char *measure, *slider;
};
constexpr Girth kGirths[] = {{"chest_girth_m", "measure-bust-circ"},      {"waist_girth_m", "measure-waist-circ"},
                             {"hip_girth_m", "measure-hips-circ"},        {"thigh_girth_m", "measure-thigh-circ"},
                             {"neck_girth_m", "measure-neck-circ"},       {"upper_arm_girth_m", "measure-upperarm-circ"}};
constexpr int kSteps = 4;
constexpr float kProbe = 0.15f, kSliderEnd = 0.9f;  // of a slider
constexpr float kLeastSlope_m = 0.02f;             // a slider: girths that it hardly moves are left as they are
constexpr float kLeastScale = 0.8f, kMostScale = 1.25f;

}  // namespace

ScannedBody scanned_body(const std::shared_ptr<const BodyModel>& body, const FitModel& fit, const FitShape& shape,
                         const std::vector<Measurement>& measured, vfit_sex sex) {
    ScannedBody out;
    out.shape.resize(body->parameters().size());
    fit.body_shape(*body, shape, out.shape);
    const auto tape = [&] { return measure_avatar(Avatar(body, {sex}, out.shape, out.scale), sex); };
    const auto value = [](const std::vector<Measurement>& list, const char* key) {
        const Measurement* m = find(list, key);
        return m ? m->value : 0.0f;
    };
    const auto meet_scale = [&](const std::vector<Measurement>& now) {
        const auto meet = [&](float& scale, const char* key) {
            const float wanted = value(measured, key), is = value(now, key);
            if (wanted > 0.0f && is > 0.0f) scale = std::clamp(scale * wanted / is, kLeastScale, kMostScale);
        };
        meet(out.scale.y, "stature_m"), meet(out.scale.x, "shoulder_breadth_m");
    };
    std::vector<Measurement> now = tape();
    meet_scale(now);
    ScannedBody good = out;
    std::array<float, std::size(kGirths)> slope{};
    for (int step = 0; step <= kSteps; ++step) {
        const std::vector<Measurement> before = now;
        std::array<float, std::size(kGirths)> change{};
        for (size_t i = 0; i < change.size(); ++i) {
            const int parameter = body->parameter(kGirths[i].slider);
            const float wanted = value(measured, kGirths[i].measure);
            if (parameter < 0 || wanted <= 0.0f) continue;
            float& slider = out.shape[size_t(parameter)];
            const float off = wanted - value(now, kGirths[i].measure);
            // The first step only shows how girths move.
            const float way = step == 0                         ? (off < 0.0f ? -kProbe : kProbe)
                              : std::abs(slope[i]) < kLeastSlope_m ? 0.0f
                                                                   : off / slope[i];
            const float moved = std::clamp(slider + way, -kSliderEnd, kSliderEnd);
            change[i] = moved - slider;
            slider = moved;
        }
        try {
            now = tape();
        } catch (const Error&) {  // a body that has not the form of a person: the one before it will do
            return good;
        }
        good = out;
        for (size_t i = 0; i < change.size(); ++i)
            if (std::abs(change[i]) > 0.02f)
                slope[i] = (value(now, kGirths[i].measure) - value(before, kGirths[i].measure)) / change[i];
        meet_scale(now);
    }
    return out;
}

}  // namespace vfit
