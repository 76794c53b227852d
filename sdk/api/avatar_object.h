// The object behind vfit_avatar.
#pragma once

#include "anthropometry/measurement.h"
#include "api/mesh_frame.h"
#include "avatar/avatar.h"
#include "avatar/character.h"
#include "avatar/packed_body.h"
#include "outfit/outfit_skin.h"
#include "outfit/wearer.h"

namespace vfit::api {

struct AvatarObject : ContextChild {
    static constexpr Kind kKind = Kind::avatar;
    /// A body of the model.
    AvatarObject(Ref<Context> owner, const AvatarDesc& desc, std::span<const float> shape, const Vec2& scale);
    /// A character of the host's.
    AvatarObject(Ref<Context> owner, const AvatarDesc& desc, Character character);

    Avatar avatar;
    const vfit_sex sex;
    const uint32_t detail = 0;                 // of a body
    const Wearer wearer{avatar, sex, detail};  // where it is a body
    const PackedBody body;                     // what a body is made of; empty of a character
    const Character character;                 // its mesh moved into `avatar`; without parts of a body
    bool is_body() const { return !body.shape.empty(); }
    MeshOutput posed, rest;
    std::array<float, kPaperJointCount> radii{};  // that set_collider_radii was told
    std::mutex cloth_sets;                        // guards which of its cloths are worn over each other
    float relative_sigma = 0.0f;  // of measures of its body as the person's whom it was made of; 0: unknown

    /// As the avatar's own, and kept for packets.
    void set_collider_radii(std::span<const float, kPaperJointCount> measured);
    /// Triangles by material; a body is one part.
    std::vector<CharacterPart> parts() const;

    /// Poses the avatar and publishes its mesh; nothing changes where it fails.
    void pose(const Pose& pose);
    /// Poses the avatar and writes its skin into the host's memory; the published mesh stays as it was.
    void pose_into(const Pose& pose, const SkinTarget& target);
    struct SkinBelow {
        Ref<Frame> frame;
        uint32_t crossing_pairs;  // of triangles that still cross
    };
    /// The skin below an outfit of this avatar.
    SkinBelow skin_below(std::span<WornGarment* const> outfit);
    /// Tape measures of its own body; taken when first asked for.
    const std::vector<Measurement>& measures() const;

private:
    OutfitSkin outfit_skin_{avatar};
    void make_outputs();
    void add_matrices(Frame& frame, std::span<const Mat4> matrices) const;
};

}  // namespace vfit::api
