#include "api/measurements.h"

#include "anthropometry/measurement_check.h"

namespace vfit::api {

std::vector<Measurement> measurements_in(const vfit_measurement* items, uint32_t stride, uint32_t count) {
    std::vector<Measurement> out;
    const Items<vfit_measurement> list(items, stride, count, "items");
    for (uint32_t i = 0; i < list.size(); ++i) {
        const vfit_measurement m = list[i];
        out.push_back({get_text(m.key), m.value, m.sigma, m.observed != 0});
        check_measurement(out.back());
    }
    return out;
}

vfit_result write_measurements(const std::vector<Measurement>& list, vfit_measurement* items, uint32_t stride,
                               uint32_t* count) {
    return write_list(items, stride, count, list.size(), [&](size_t i) {
        vfit_measurement m{};
        m.observed = list[i].observed;
        m.value = list[i].value;
        m.sigma = list[i].sigma;
        set_text(m.key, list[i].key);
        return m;
    });
}

}  // namespace vfit::api
