// The object behind vfit_scan.
#pragma once

#include <vector>

#include "api/context.h"
#include "body/collider.h"
#include "scan/person_scan.h"

namespace vfit::api {

struct ScanObject : ContextChild {
    static constexpr Kind kKind = Kind::scan;
    ScanObject(Ref<Context> owner, const PersonScanDesc& desc)
        : ContextChild(std::move(owner)), scan(desc), sex(desc.paper.sex) {
        last_colliders.reserve(
            kPaperJointCount);  // never moved: what was moved from would not be overwritten
    }

    PersonScan scan;
    const vfit_sex sex;
    std::vector<Collider> last_colliders;  // spheres at the joints of the last frame taken, world space

    ~ScanObject() override { forget(); }
    /// Overwrites all body data.
    void forget() {
        scan.reset();
        // volatile: the stores must survive although the memory may be freed next.
        for (Collider& c : last_colliders)
            for (int axis = 0; axis < 3; ++axis) static_cast<volatile float&>(c.center[axis]) = 0.0f;
        last_colliders.clear();
    }
};

}  // namespace vfit::api
