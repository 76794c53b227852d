#include "outfit/arm_filter.h"

namespace vfit {

namespace {

constexpr uint8_t kBody = 1, kLeft = ArmFilter::category_of(Arm::left),
                  kRight = ArmFilter::category_of(Arm::right);

uint8_t category_of(BodyPart part) {
    if (part == BodyPart::kLeftForearm || part == BodyPart::kLeftHand) return kLeft;
    if (part == BodyPart::kRightForearm || part == BodyPart::kRightHand) return kRight;
    return kBody;
}

}  // namespace

ArmFilter arm_filter(std::span<const BodyPart> skin, const Garment& garment, std::span<const Vec3> rest,
                     bool hands) {
    ArmFilter out;
    for (const BodyPart part : skin) out.category.push_back(category_of(part));
    for (size_t v = 0; v < rest.size(); ++v) {
        uint8_t arms = hands ? kLeft | kRight : 0;
        if (!garment.on_arm.empty() && garment.on_arm[v]) arms = rest[v].x > 0.0f ? kLeft : kRight;
        out.mask.push_back(uint8_t(kBody | arms));
    }
    return out;
}

}  // namespace vfit
