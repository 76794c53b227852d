#include "outfit/wearable_garment.h"

#include <span>
#include <utility>
#include <vector>

#include "core/error.h"

namespace vfit {

WearableGarment::WearableGarment(Garment garment, const FabricMaterial& material,
                                 std::shared_ptr<const BodyModel> model)
    : garment_(std::move(garment)), material_(material), model_(std::move(model)) {
    try {
        shape_of(*model_, garment_.body_sex, garment_.body_shape);
    } catch (const Error& error) {
        fail(VFIT_ERROR_DATA, "garment: \"body_shape\": ", error.what());
    }
}

const BoundGarment& WearableGarment::bound(uint32_t detail, Jobs& jobs) const {
    std::lock_guard lock(mutex_);
    std::unique_ptr<const BoundGarment>& known = bound_[detail];
    if (known) return *known;
    EvaluatedBody body;
    model_->evaluate(shape_of(*model_, garment_.body_sex, garment_.body_shape), body);
    std::vector<Vec3> positions;
    model_->subdivide(detail, body.positions, positions);
    const BodyTopology& t = model_->topology(detail);
    const size_t count = t.vertex_count;
    known = std::make_unique<const BoundGarment>(
        garment_,
        BoundBody{positions, t.indices, std::span(t.skin_bones).first(count),
                  std::span(t.skin_weights).first(count), std::span(t.parts).first(count)},
        &jobs);
    return *known;
}

}  // namespace vfit
