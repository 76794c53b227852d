// Numbers of any width in bits, one behind the other, lowest bit first: what a packet is made of.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "core/error.h"

namespace vfit {

class BitWriter {
public:
    explicit BitWriter(std::span<uint8_t> bytes) : bytes_(bytes) {
        for (uint8_t& b : bytes_) b = 0;
    }
    void put(uint64_t value, int bits) {
        for (int i = 0; i < bits; ++i, ++at_)
            if ((value >> i) & 1u)
                bytes_[at_ / 8] = static_cast<uint8_t>(bytes_[at_ / 8] | (1u << (at_ % 8)));
    }
    /// The nearest of 2^bits - 1 equal steps from `least` to `most`, both exact.
    void put_in_range(float value, float least, float most, int bits) {
        const double steps = double((uint64_t(1) << bits) - 1);
        const double share = (double(value) - double(least)) / (double(most) - double(least));
        put(static_cast<uint64_t>(std::lround(std::fmin(std::fmax(share, 0.0), 1.0) * steps)), bits);
    }

private:
    std::span<uint8_t> bytes_;
    size_t at_ = 0;
};

class BitReader {
public:
    explicit BitReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}
    /// VFIT_ERROR_DATA past the end.
    uint64_t get(int bits) {
        if (at_ + static_cast<size_t>(bits) > 8 * bytes_.size())
            fail(VFIT_ERROR_DATA, bytes_.size(), " bytes are too few: the packet was cut");
        uint64_t value = 0;
        for (int i = 0; i < bits; ++i, ++at_) value |= uint64_t((bytes_[at_ / 8] >> (at_ % 8)) & 1u) << i;
        return value;
    }
    float get_in_range(float least, float most, int bits) {
        const double steps = double((uint64_t(1) << bits) - 1);
        return static_cast<float>(double(least) +
                                  (double(most) - double(least)) * (double(get(bits)) / steps));
    }

private:
    std::span<const uint8_t> bytes_;
    size_t at_ = 0;
};

}  // namespace vfit
