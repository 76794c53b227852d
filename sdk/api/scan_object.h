// The object behind vfit_scan.
#pragma once

#include "api/context.h"
#include "measure/scan.h"

namespace vfit::api {

struct ScanObject : ContextChild {
    static constexpr Kind kKind = Kind::scan;
    ScanObject(Ref<Context> owner, const ScanDesc& desc)
        : ContextChild(std::move(owner)), scan(desc), sex(desc.sex), frames_wanted(desc.frame_count) {}

    Scan scan;
    const vfit_sex sex;
    const uint32_t frames_wanted;
    std::vector<Collider> last_colliders;  // spheres at the joints of the last frame taken, world space
};

}  // namespace vfit::api
