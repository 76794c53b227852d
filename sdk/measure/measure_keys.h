// The vocabulary of measures: every key that vfit writes or reads, with its definition.
#pragma once

#include <span>
#include <string_view>

namespace vfit {

struct MeasureKey {
    const char* key;   // "chest_girth_m"
    const char* text;  // one line
};

std::span<const MeasureKey> measure_keys();

/// Place of the key in measure_keys(), or -1.
int measure_index(std::string_view key);

}  // namespace vfit
