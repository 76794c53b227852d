// Scan: tracked frames in, measures of the person out.
#pragma once

#include "core.h"

namespace vfit_python {

class Scan : public Owned<vfit_scan, vfit_scan_destroy> {
public:
    using Owned::Owned;
};

}  // namespace vfit_python
