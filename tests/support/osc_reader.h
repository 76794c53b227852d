// A strict reader of Open Sound Control 1.0, written from its specification: what other programs make of a
// packet.
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace vfit::test {

struct OscMessage {
    std::string address, types;
    std::vector<int32_t> ints;
    std::vector<float> floats;
    std::vector<std::string> texts;
};

class OscReader {
public:
    explicit OscReader(std::span<const uint8_t> bytes) : bytes_(bytes) {}

    /// The messages of a bundle whose time tag says "at once".
    std::vector<OscMessage> bundle() {
        if (text() != "#bundle") throw std::runtime_error("no bundle");
        if (number() != 0 || number() != 1) throw std::runtime_error("the time tag is not 'at once'");
        std::vector<OscMessage> messages;
        while (at_ < bytes_.size()) {
            const uint32_t size = number();
            if (size % 4 != 0 || at_ + size > bytes_.size()) throw std::runtime_error("a wrong element size");
            OscReader element(bytes_.subspan(at_, size));
            messages.push_back(element.message());
            at_ += size;
        }
        return messages;
    }

private:
    OscMessage message() {
        OscMessage out;
        out.address = text();
        if (out.address.empty() || out.address[0] != '/') throw std::runtime_error("no address");
        out.types = text();
        if (out.types.empty() || out.types[0] != ',') throw std::runtime_error("no type tags");
        for (const char type : out.types.substr(1)) {
            if (type == 's') {
                out.texts.push_back(text());
                continue;
            }
            const uint32_t bits = number();
            float value = 0;
            std::memcpy(&value, &bits, sizeof value);
            if (type == 'f')
                out.floats.push_back(value);
            else if (type == 'i')
                out.ints.push_back(static_cast<int32_t>(bits));
            else
                throw std::runtime_error("an unknown type");
        }
        if (at_ != bytes_.size())
            throw std::runtime_error("bytes behind the last argument of " + out.address);
        return out;
    }
    uint32_t number() {
        if (at_ + 4 > bytes_.size()) throw std::runtime_error("a number is cut");
        uint32_t value = 0;
        for (int i = 0; i < 4; ++i) value = value << 8 | bytes_[at_++];
        return value;
    }
    std::string text() {
        std::string out;
        while (at_ < bytes_.size() && bytes_[at_] != 0) out += static_cast<char>(bytes_[at_++]);
        do
            if (at_ >= bytes_.size() || bytes_[at_] != 0) throw std::runtime_error("a text without its end");
        while (++at_ % 4 != 0);
        return out;
    }

    std::span<const uint8_t> bytes_;
    size_t at_ = 0;
};

}  // namespace vfit::test
