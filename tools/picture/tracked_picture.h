// What the tracker saw in a frame: the room as relief, each person in a colour of their own, the skeleton
// over it.
#pragma once

#include <string>

#include "picture/canvas.h"
#include "vfit.h"

namespace vfit::tools {

/// Every person's pixels in the colour of their id, with the id above the head. A joint is a filled dot where
/// it was measured and an empty ring where it was inferred; a bone with an inferred end is dashed. Of several
/// people the active one has a ring round the id. The caption stands in a line below the image, `scale` times
/// as large as the depth image, beside the meaning of the dots.
Canvas draw_tracked(vfit_frame frame, int scale, const std::string& caption);

}  // namespace vfit::tools
