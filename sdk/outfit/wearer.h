// The body of an avatar as its garments need it: skin, measures and girth levels, each found when first asked
// for.
#pragma once

#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "anthropometry/measurement.h"
#include "avatar/avatar.h"
#include "avatar/skin.h"
#include "cloth/garment/dress.h"
#include "geometry/mesh_query.h"
#include "outfit/contact_skin.h"
#include "outfit/garment_fit.h"

namespace vfit {

/// Any thread may ask, while another poses the avatar too: all is of the body at rest.
class Wearer {
public:
    /// avatar: of a body of the model, of that sex and level of detail; must outlive this.
    Wearer(const Avatar& avatar, vfit_sex sex, uint32_t detail)
        : avatar_(avatar), sex_(sex), detail_(detail) {}
    Wearer(const Wearer&) = delete;
    Wearer& operator=(const Wearer&) = delete;

    const Avatar& avatar() const { return avatar_; }
    uint32_t detail() const { return detail_; }

    /// Vertices of the closed surface.
    std::span<const Vec3> positions() const;
    const std::vector<uint32_t>& indices() const { return avatar_.topology().indices; }
    const MeshQuery& skin() const;
    const ContactSkin& contact_skin() const;
    /// The skin in a pose (skinning matrices, one a rig bone), linearly blended, world space.
    std::vector<Vec3> posed(std::span<const Mat4> pose, Jobs& jobs) const;
    /// The same body as a garment is bound to it. Refers to this and to the avatar.
    DressBody body() const;

    /// Tape measures.
    const std::vector<Measurement>& measures() const;
    /// Levels at which the girths of the trunk are taken.
    const std::vector<GirthLevel>& girth_levels() const;

private:
    const Avatar& avatar_;
    const vfit_sex sex_;
    const uint32_t detail_;
    mutable std::once_flag has_skin_, has_contact_skin_, has_skinning_;
    mutable std::optional<MeshQuery> skin_;
    mutable ContactSkin contact_skin_;
    mutable std::optional<Skin> skinning_;
    mutable std::mutex measures_mutex_;
    mutable std::vector<Measurement> measures_;
    mutable std::vector<GirthLevel> girth_levels_;
};

}  // namespace vfit
