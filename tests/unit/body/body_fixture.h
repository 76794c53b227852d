// The baked body of this build, shared by the body tests.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "body/body_model.h"

namespace vfit::test {

inline const std::string kBodyPath = std::string(VFIT_DATA_DIR) + "/body.bin";

inline const BodyModel& body() {
    static const std::shared_ptr<const BodyModel> model = BodyModel::load(kBodyPath);
    return *model;
}

inline EvaluatedBody evaluated(const std::vector<float>& shape) {
    EvaluatedBody out;
    body().evaluate(shape, out);
    return out;
}

inline float stature(const EvaluatedBody& evaluated) {
    float top = 0.0f;
    for (const Vec3& p : evaluated.positions) top = std::max(top, p.y);
    return top;
}

inline std::vector<float> shape_with(vfit_sex sex, const char* key, float value) {
    std::vector<float> shape = body().default_shape(sex);
    shape.at(static_cast<size_t>(body().parameter(key))) = value;
    return shape;
}

}  // namespace vfit::test
