// The fitted body's surface in patches: each part of the body by level along it and by the way that the
// surface faces. Left and right are one: measures do not tell them apart, and so every patch is seen by twice
// as much.
#pragma once

#include <cstdint>
#include <vector>

#include "fit/fit_model.h"

namespace vfit {

class BodyZones {
public:
    static constexpr int kCount = 171;
    explicit BodyZones(const FitModel& model);
    /// -1: hands, which no measure but their length looks at.
    int of(uint32_t vertex) const { return of_vertex_[vertex]; }

private:
    std::vector<int16_t> of_vertex_;
};

}  // namespace vfit
