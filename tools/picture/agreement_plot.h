// Bland and Altman's picture: what two ways to measure differ by, over what they measured.
#pragma once

#include <string>
#include <vector>

#include "client/agreement.h"
#include "picture/canvas.h"

namespace vfit::tools {

struct AgreementPanel {
    std::string title;
    std::vector<Compared> list;
    double limit_m = 0.0;  // of the mean; 0: none is drawn
    bool mass = false;     // kilograms instead of metres
};

/// A panel a measure, two beside each other: a dot a scan, the mean with its 95 % interval, the limits of
/// agreement dashed, and the limit of the mean as a band.
Canvas draw_agreement(const std::vector<AgreementPanel>& panels);

}  // namespace vfit::tools
