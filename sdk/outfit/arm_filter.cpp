#include "outfit/arm_filter.h"

namespace vfit {

namespace {

enum Category : uint8_t { kBody = 1, kLeftForearm = 2, kRightForearm = 4, kLeftHand = 8, kRightHand = 16 };
constexpr uint8_t kLeftArm = kLeftForearm | kLeftHand, kRightArm = kRightForearm | kRightHand;

uint8_t category_of(BodyPart part) {
    switch (part) {
        case BodyPart::kLeftForearm: return kLeftForearm;
        case BodyPart::kRightForearm: return kRightForearm;
        case BodyPart::kLeftHand: return kLeftHand;
        case BodyPart::kRightHand: return kRightHand;
        default: return kBody;
    }
}

}  // namespace

ArmFilter arm_filter(std::span<const BodyPart> skin, const Garment& garment, std::span<const Vec3> rest,
                     bool hands) {
    ArmFilter out;
    for (const BodyPart part : skin) out.category.push_back(category_of(part));
    for (size_t v = 0; v < rest.size(); ++v) {
        uint8_t arms = hands ? kLeftArm | kRightArm : 0;
        if (garment.on_arm[v]) arms = rest[v].x > 0.0f ? kLeftArm : kRightArm;
        out.mask.push_back(uint8_t(kBody | arms));
    }
    return out;
}

}  // namespace vfit
