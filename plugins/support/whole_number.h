// The value of an option that takes whole numbers.
#pragma once

#include <charconv>
#include <cstdint>
#include <string>

#include "support/failure.h"

namespace plugin {

/// Fails with VFIT_ERROR_ARGUMENT, naming the key, the value and the range, unless `value` is one of
/// 0..maximum.
inline uint32_t whole_number(const std::string& key, const std::string& value, uint32_t maximum) {
    uint32_t number = 0;
    const char* const end = value.data() + value.size();
    const auto [stopped, error] = std::from_chars(value.data(), end, number);
    if (error != std::errc() || stopped != end || number > maximum)
        fail(VFIT_ERROR_ARGUMENT, "option ", key, ": '", value, "' is not a whole number in 0..", maximum);
    return number;
}

}  // namespace plugin
