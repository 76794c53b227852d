// The body model's shape of a scanned person: the fit's, with the girths that were measured.
#pragma once

#include <vector>

#include "anthropometry/measurement.h"
#include "body/body_model.h"
#include "fit/fit_model.h"
#include "vfit.h"

namespace vfit {

struct ScannedBody {
    std::vector<float> shape;  // of the body model
    Vec2 scale{1.0f};          // Algorithm 3's: width and depth, height
};

/// Up to eight tapes of a whole body: 0.1 to 0.2 s. Meets stature_m and shoulder_breadth_m by scale, girths
/// by the model's sliders as far as they reach. VFIT_ERROR_DATA where the fitted shape itself has not the
/// form of a person.
ScannedBody scanned_body(const std::shared_ptr<const BodyModel>& body, const FitModel& fit,
                         const FitShape& shape, const std::vector<Measurement>& measured, vfit_sex sex);

}  // namespace vfit
