// The body as one signed distance per bone: the skin around the bone's line, by height and by angle.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "avatar/rig.h"
#include "body/body_model.h"

namespace vfit {

/// The bones that carry the parts of the body whose skin meets cloth, or presses into skin that does.
inline constexpr size_t kMaxFieldBones = 16;

/// The skin that belongs to one bone, as a radius around the bone's line.
struct BoneField {
    static constexpr size_t kAngles = 24, kMaxLevels = 24;

    BodyPart part = BodyPart::kTorso;
    int rig_bone = -1;                  // carries it; of a limb with twist bones the middle one
    Vec3 start{0.0f};                   // rest
    Vec3 x{0.0f}, axis{0.0f}, z{0.0f};  // unit vectors, rest
    float length_m = 0.0f;              // along the axis
    float cap_m[2] = {};                // how far the skin reaches beyond start and end
    float reach_m = 0.0f;               // of the skin from the line, at most
    size_t levels = 2;
    float levels_per_m = 0.0f;
    std::array<float, kMaxLevels * kAngles> radius{};
};

/// A bone field in a pose.
struct PosedField {
    using Radii = std::array<float, BoneField::kMaxLevels * BoneField::kAngles>;

    const BoneField* field = nullptr;
    const Radii* radius = nullptr;                   // the field's own, or those of the posed skin
    Vec3 start{0.0f}, x{0.0f}, axis{0.0f}, z{0.0f};  // world

    struct Sample {
        float distance_m;  // from the skin, negative inside
        float radius_m;
        Vec3 outward;  // gradient of the distance with the radius taken as constant, unit length
    };
    Sample sample(const Vec3& p) const;
    /// Is the distance less than that?
    bool is_within(const Vec3& p, float distance_m) const;
    Vec3 end() const { return start + field->length_m * axis; }
    /// From the line through the bone.
    float radius_of(const Vec3& p) const;
};

/// Where the cell of a field lies in the rest mesh.
Vec3 place_of_cell(const BoneField& field, size_t cell);

/// One field a bone of trunk, arms, hands, legs and feet. Bones of one part follow each other.
std::vector<BoneField> learn_bone_fields(const AvatarRig& rig, std::span<const Vec3> rest,
                                         std::span<const BodyPart> parts);

}  // namespace vfit
