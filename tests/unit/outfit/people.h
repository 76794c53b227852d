// Avatars of the body model and the garments of this build, for tests of what they wear.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "avatar/avatar.h"
#include "core/files.h"
#include "outfit/wearable_garment.h"
#include "outfit/wearer.h"
#include "outfit/worn_garment.h"
#include "outfit/worn_together.h"

namespace vfit::test {

inline const std::shared_ptr<const BodyModel>& body_model() {
    static const std::shared_ptr<const BodyModel> model = BodyModel::load(VFIT_DATA_DIR "/body.bin");
    return model;
}

/// The default body of a sex, with one value of its shape changed.
struct Person {
    Avatar avatar;
    Wearer wearer;

    explicit Person(vfit_sex sex, const char* key = nullptr, float value = 0.0f)
        : avatar(body_model(), {sex}, shape(sex, key, value), Vec2(1.0f)), wearer(avatar, sex, 0) {
        stand_at({});
    }
    /// In the T-pose.
    void stand_at(const Vec3& place) {
        Pose pose;
        pose.hips_position = avatar.skeleton().offset[VFIT_BONE_HIPS] + place;
        avatar.move(pose);
    }

private:
    static std::vector<float> shape(vfit_sex sex, const char* key, float value) {
        std::vector<float> values = body_model()->default_shape(sex);
        if (key) values.at(size_t(body_model()->parameter(key))) = value;
        return values;
    }
};

inline WearableGarment wearable(const std::string& name) {
    const FabricLibrary fabrics = FabricLibrary::parse(read_file(VFIT_DATA_DIR "/fabrics.json"));
    Garment garment =
        parse_garment(read_file(VFIT_DATA_DIR "/garments/" + name + ".json", 1u << 24), fabrics);
    const FabricMaterial material = fabrics.get(garment.fabric);
    return WearableGarment(std::move(garment), material, body_model());
}

inline void step(WornTogether together, float dt = 1.0f / 60.0f) {
    together.begin_step(dt);
    together.step();
    together.end_step();
}

/// A garment that is worn alone.
inline WornTogether alone(WornGarment& worn) {
    WornGarment* const garments[] = {&worn};
    return WornTogether(garments);
}
inline void step(WornGarment& worn, float dt = 1.0f / 60.0f) { step(alone(worn), dt); }

/// All garments of one outfit.
template <typename... Garments>
WornTogether together(Garments&... worn) {
    WornGarment* const garments[] = {&worn...};
    return WornTogether(garments);
}

}  // namespace vfit::test
