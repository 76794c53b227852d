// One measured quantity of a body, by its shared key ("stature_m"), in metres.
#pragma once

#include <string>
#include <vector>

namespace vfit {

struct Measurement {
    std::string key;
    float value = 0.0f;
    float sigma = 0.0f;    // one standard deviation; 0: unknown
    bool observed = true;  // false: inferred from other measures
};

/// The measurement of that key, or null.
inline const Measurement* find(const std::vector<Measurement>& list, const std::string& key) {
    for (const Measurement& m : list)
        if (m.key == key) return &m;
    return nullptr;
}
const Measurement* find(std::vector<Measurement>&&, const std::string&) = delete;  // of a list that dies

}  // namespace vfit
