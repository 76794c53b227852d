#include "cook/drape/grow_body.h"

#include <memory>
#include <utility>

#include "cloth/cloth.h"

namespace vfit {

std::vector<Vec3> grow_body_into(const WholeCloth& cloth, std::vector<Vec3> places, const CookBody& body,
                                 const Stance& from, const Hold& hold, float thickness_m, Jobs& jobs) {
    constexpr int kFrames = 90;
    constexpr float kFrame_s = 1.0f / 60.0f;
    ClothSettings settings;
    settings.gravity = Vec3(0.0f);
    settings.damping = 0.999f;
    settings.friction = 0.0f;
    settings.thickness_m = thickness_m;
    settings.sleeps = false;
    const std::vector<uint8_t> all(places.size(), 1);
    FabricData data = cook_fabric({places, cloth.indices, {}, all, 1.0f, cloth.cut}, *cloth.material);
    hold.limit(data);
    const std::vector<Vec3> targets = hold.targets(places);
    Cloth simulated(std::make_shared<const Fabric>(std::move(data)), settings, places);
    const uint32_t skin = simulated.add_mesh(body.positions().size(), body.indices());
    for (int frame = 0; frame <= kFrames; ++frame) {
        simulated.move_mesh(skin, body.leaving(from, float(frame) / float(kFrames)));
        simulated.step(kFrame_s, targets, {}, jobs);
    }
    return simulated.positions();
}

}  // namespace vfit
