// The vocabulary of measures: every key that vfit writes or reads, with its definition.
#pragma once

#include <span>
#include <string_view>

namespace vfit {

struct MeasureKey {
    const char* key;          // "chest_girth_m"
    const char* text;         // one line
    float smallest, largest;  // plausible of a person, from newborns to the largest adults known
};

std::span<const MeasureKey> measure_keys();

/// Kilograms instead of metres.
inline bool is_mass(std::string_view key) { return key.size() > 3 && key.substr(key.size() - 3) == "_kg"; }

/// Whether it may be the key of a measure that a user adds (own_measures.h): "x_calf_girth_m".
bool is_own_measure(std::string_view key);
/// Whether anybody may know it.
inline bool is_measure(std::string_view key);

/// Place of the key in measure_keys(), or -1.
int measure_index(std::string_view key);
/// The order of lists: known ones, then users' own.
int measure_order(std::string_view key);

inline bool is_measure(std::string_view key) { return measure_index(key) >= 0 || is_own_measure(key); }

}  // namespace vfit
