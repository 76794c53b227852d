// A bundle of Open Sound Control 1.0 messages in the caller's bytes: big-endian numbers, texts ended by 0,
// all padded to four bytes (opensoundcontrol.stanford.edu/spec-1_0.html).
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "core/error.h"

namespace vfit {

class OscWriter {
public:
    /// The bundle's time tag is 1, which means "at once".
    explicit OscWriter(std::span<uint8_t> bytes) : bytes_(bytes) {
        text("#bundle");
        number(0);
        number(1);
    }

    /// Starts a message; types: one letter an argument, i, f or s. The arguments follow in that order.
    void begin(std::string_view address, std::string_view types) {
        end();
        length_at_ = at_;
        number(0);
        text(address);
        text(types, ",");
    }
    void put(int32_t value) { number(static_cast<uint32_t>(value)); }
    void put(float value) { number(std::bit_cast<uint32_t>(value)); }
    void put(std::string_view value) { text(value); }

    /// The size of the whole bundle, in bytes.
    size_t finish() {
        end();
        return at_;
    }

private:
    void end() {
        if (length_at_ == 0) return;
        const size_t end = at_;
        at_ = length_at_;
        number(static_cast<uint32_t>(end - length_at_ - 4));
        at_ = end;
        length_at_ = 0;
    }
    void number(uint32_t value) {
        for (int shift = 24; shift >= 0; shift -= 8) byte(static_cast<uint8_t>(value >> shift));
    }
    void text(std::string_view value, std::string_view before = "") {
        for (const char c : before) byte(static_cast<uint8_t>(c));
        for (const char c : value) byte(static_cast<uint8_t>(c));
        do byte(0);
        while (at_ % 4 != 0);
    }
    void byte(uint8_t value) {
        if (at_ == bytes_.size()) fail(VFIT_ERROR_CAPACITY, "an OSC bundle of more than ", at_, " bytes");
        bytes_[at_++] = value;
    }

    std::span<uint8_t> bytes_;
    size_t at_ = 0, length_at_ = 0;  // of the open message's length; 0: none is open
};

}  // namespace vfit
