// Several pictures on one sheet, with captions.
#pragma once

#include <string>
#include <vector>

#include "picture/canvas.h"

namespace vfit::tools {

struct SheetItem {
    Canvas picture;
    std::string caption;
};

/// `title`, one line or more, over rows of pictures, each as wide as its own shape wants. The widest row is
/// `cell_height` pixels high; the others grow to its width.
Canvas contact_sheet(const std::string& title, const std::vector<std::vector<SheetItem>>& rows,
                     int cell_height);

}  // namespace vfit::tools
