// vfit.h, part "avatar and cloth": outfits.
#include <list>
#include <span>
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

/// The cloths of a call.
template <Mode kMode>
class Outfit {
public:
    Outfit(const vfit_cloth* cloths, uint32_t count) {
        check_pointer(cloths, "cloths");
        if (count == 0 || count > kMaxCloths)
            fail(VFIT_ERROR_ARGUMENT, "cloth_count ", count, " is not in 1..", kMaxCloths);
        for (uint32_t i = 0; i < count; ++i) {
            for (uint32_t k = 0; k < i; ++k)
                if (cloths[k].id == cloths[i].id)
                    fail(VFIT_ERROR_ARGUMENT, "cloths ", k, " and ", i, " are the same");
            worn_.push_back(&used_.emplace_back(cloths[i].id)->worn);
            if (&avatar() != used_.back()->avatar.get())
                fail(VFIT_ERROR_ARGUMENT, "cloth ", i, " is of another avatar than cloth 0");
        }
    }

    AvatarObject& avatar() const { return *used_.front()->avatar; }
    std::span<WornGarment* const> worn() const { return worn_; }

private:
    std::list<Use<ClothObject, kMode>> used_;
    std::vector<WornGarment*> worn_;
};

}  // namespace

vfit_result vfit_outfit_check(const vfit_cloth* cloths, uint32_t cloth_count, vfit_crossing* items,
                              uint32_t stride, uint32_t* count) {
    return guard([&] {
        check_pointer(count, "count");
        const Outfit<Mode::read> outfit(cloths, cloth_count);
        const std::vector<const WornGarment*> worn(outfit.worn().begin(), outfit.worn().end());
        const auto crossings = find_crossings(worn, *outfit.avatar().context->jobs);
        return write_list(items, stride, count, crossings.size(),
                          [&](size_t i) { return crossing_of(crossings[i]); });
    });
}

vfit_result vfit_outfit_skin(const vfit_cloth* cloths, uint32_t cloth_count, vfit_frame* out,
                             uint32_t* crossing_pairs) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        const Outfit<Mode::exclusive> outfit(cloths, cloth_count);
        const Alone alone(outfit.avatar().access, "avatar");
        const AvatarObject::SkinBelow skin = outfit.avatar().skin_below(outfit.worn());
        out->id = outfit.avatar().context->publish(Kind::frame, skin.frame);
        if (crossing_pairs) *crossing_pairs = skin.crossing_pairs;
        return VFIT_OK;
    });
}
