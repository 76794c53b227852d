// vfit.h, part "avatar and cloth": outfits.
#include <list>
#include <vector>

#include "api/cloth_object.h"
#include "api/guard.h"
#include "api/structs.h"
#include "outfit/outfit_check.h"

using namespace vfit;
using namespace vfit::api;

namespace {

constexpr uint32_t kMaxCloths = 64;

vfit_crossing crossing_of(const SurfaceCrossing& found) {
    using With = SurfaceCrossing::With;
    vfit_crossing out{};
    out.kind = found.with == With::itself ? VFIT_CROSSING_SELF
               : found.with == With::skin ? VFIT_CROSSING_SKIN
               : found.with == With::prop ? VFIT_CROSSING_PROP
                                          : VFIT_CROSSING_CLOTH;
    out.cloth = found.garment;
    out.other = found.other;
    out.pair_count = found.pair_count;
    out.triangle = found.first.first;
    out.other_triangle = found.with == With::prop ? 0 : found.first.second;  // which the host did not give
    return out;
}

}  // namespace

vfit_result vfit_outfit_check(const vfit_cloth* cloths, uint32_t cloth_count, vfit_crossing* items,
                              uint32_t stride, uint32_t* count) {
    return guard([&] {
        check_pointer(cloths, "cloths");
        check_pointer(count, "count");
        if (cloth_count == 0 || cloth_count > kMaxCloths)
            fail(VFIT_ERROR_ARGUMENT, "cloth_count ", cloth_count, " is not in 1..", kMaxCloths);
        std::list<Use<ClothObject, Mode::read>> used;
        std::vector<const WornGarment*> outfit;
        for (uint32_t i = 0; i < cloth_count; ++i) outfit.push_back(&used.emplace_back(cloths[i].id)->worn);
        const auto crossings = find_crossings(outfit, *used.front()->context->jobs);
        return write_list(items, stride, count, crossings.size(),
                          [&](size_t i) { return crossing_of(crossings[i]); });
    });
}
