// Random values as careless or hostile callers have them: mostly sane, at times at an edge, at times
// nonsense.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

namespace storm {

class Draw {
public:
    explicit Draw(uint64_t seed) : engine_(seed) {}

    uint64_t bits() { return engine_(); }
    uint32_t below(uint32_t n) { return uint32_t(bits() % n); }
    bool one_in(uint32_t n) { return below(n) == 0; }
    template <typename T, size_t N>
    T pick(const T (&list)[N]) {
        return list[below(uint32_t(N))];
    }

    float number() {
        constexpr float kInf = std::numeric_limits<float>::infinity();
        static const float kEdges[] = {0.0f, -0.0f, 1.0f,   -1.0f, 0.5f,  1e-38f, 1e-6f,
                                       1e6f, 3e38f, -3e38f, kInf,  -kInf, NAN};
        return one_in(2) ? pick(kEdges) : float(below(2001)) * 1e-3f - 1.0f;
    }
    uint64_t whole() {
        static const uint64_t kEdges[] = {
            0, 1, 2, 3, 7, 64, 255, 65535, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 1ull << 40, ~0ull >> 1, ~0ull};
        return one_in(4) ? bits() : pick(kEdges);
    }

    /// A text of the field or parameter of that name.
    std::string text(const std::string& name) {
        switch (below(12)) {
            case 0: return "";
            case 1: return "%s%n%x";
            case 2: return "\xC0\xAF\xFF\xFE";
            case 3: return std::string(5000, 'a');
            case 4: return "{\"a\": [1, 2, {\"b\": null}]}";
            default: break;
        }
        if (name == "path" && !one_in(4)) return "recording" + std::to_string(below(10000));
        struct Known {
            const char* name;
            std::vector<const char*> values;
        };
        static const std::vector<Known> kKnown = {
            {"uri",
             {"recording:recording", "recording:recording", "recording:recording", "recording",
              "virtual:sensor=kinect_v1_320", "virtual:", "virtual:height_m=9", "recording:/dev/null",
              "nothing:"}},
            {"key", {"pace", "mode", "measures", "contacts", "index", "bodies", "sensor"}},
            {"value", {"none", "realtime", "0", "1", "kinect_v1_320"}},
            {"path", {"/dev/null/x", "/"}},
            {"name", {"paper", "shirts_men", "en13402_women", "sundress", "sundress", "../charts/paper"}},
            {"garment_kind", {"short_sleeves", "long_sleeves", "trousers", "dress", "shirt"}},
            {"label", {"S", "M", "L", "XL"}},
            {"size_label", {"S", "M", "L"}},
            {"bone_map", {"{\"hips\": \"hips\"}", "{\"hips\": 1}"}},
            {"range_of_motion", {"{\"knee\": {\"flexion\": 60}}", "{\"knee\": 1}", "["}},
            {"sensor_name", {"a camera"}},
        };
        for (const Known& known : kKnown)
            if (name == known.name) return known.values[below(uint32_t(known.values.size()))];
        return "x";
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace storm
