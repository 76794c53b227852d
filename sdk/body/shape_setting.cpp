#include "body/shape_setting.h"

#include "core/error.h"

namespace vfit {

std::vector<float> shape_of(const BodyModel& model, vfit_sex sex, std::span<const ShapeSetting> settings) {
    std::vector<float> shape = model.default_shape(sex);
    for (const ShapeSetting& setting : settings) {
        const int parameter = model.parameter(setting.key);
        if (parameter < 0)
            fail(VFIT_ERROR_ARGUMENT, "\"", setting.key, "\" is no shape value; see vfit_shape_list");
        const ShapeParameter& p = model.parameters()[size_t(parameter)];
        if (!(setting.value >= p.minimum && setting.value <= p.maximum))
            fail(VFIT_ERROR_ARGUMENT, setting.key, ": ", setting.value, " is not in ", p.minimum, "..",
                 p.maximum);
        shape[size_t(parameter)] = setting.value;
    }
    return shape;
}

std::vector<ShapeSetting> settings_of(const BodyModel& model, vfit_sex sex, std::span<const float> shape) {
    const std::vector<float> usual = model.default_shape(sex);
    std::vector<ShapeSetting> out;
    for (size_t p = 0; p < usual.size(); ++p)
        if (shape[p] != usual[p]) out.push_back({model.parameters()[p].key, shape[p]});
    return out;
}

}  // namespace vfit
