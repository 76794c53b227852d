// Fig. 11 of the paper: how far the foot stage moves the planted foot, over time.
#pragma once

#include "client/client.h"
#include "picture/line_plot.h"

namespace vfit::tools {

/// Of the first `frames` frames (0: 300) of a source, seconds and millimetres.
Curve foot_correction(vfit_context context, const std::string& uri, uint32_t frames);

}  // namespace vfit::tools
