// A leg hidden behind the other one: trackers put its ankle where the one in front is, often for a third of a
// second. A foot that stood elsewhere still stands there.
#pragma once

#include <array>

#include "frame/body.h"

namespace vfit {

class HiddenFeet {
public:
    void reset() { *this = HiddenFeet(); }

    /// The body with ankles that are but the other one's put back to where their foot stands, as inferred
    /// ones. `planted`: the feet that stood until now.
    Body put_back(const Body& body, const bool planted[2]);

private:
    struct Foot {
        bool stands = false;
        Vec3 place{0.0f};  // where its ankle was seen while it stood
        float hidden_s = 0;
    };
    std::array<Foot, 2> feet_;
    int64_t time_ns_ = 0;
};

}  // namespace vfit
