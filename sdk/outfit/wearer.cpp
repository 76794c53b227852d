#include "outfit/wearer.h"

#include "avatar/avatar_measures.h"

namespace vfit {

std::span<const Vec3> Wearer::positions() const {
    return std::span(avatar_.rest().positions).first(avatar_.topology().vertex_count);
}

const MeshQuery& Wearer::skin() const {
    std::call_once(has_skin_, [&] { skin_.emplace(positions(), indices()); });
    return *skin_;
}

const ContactSkin& Wearer::contact_skin() const {
    std::call_once(has_contact_skin_, [&] { contact_skin_ = vfit::contact_skin(body()); });
    return contact_skin_;
}

std::vector<Vec3> Wearer::posed(std::span<const Mat4> pose, Jobs& jobs) const {
    std::call_once(has_skinning_, [&] {
        const size_t count = positions().size();
        skinning_.emplace(avatar_.skin_bones().first(count), avatar_.skin_weights().first(count), positions(),
                          std::span<const Vec3>());
    });
    std::vector<Vec3> out;
    Skin::Scratch scratch;
    skinning_->carry(pose, out, scratch, jobs);
    return out;
}

DressBody Wearer::body() const {
    const size_t count = positions().size();
    return {{positions(), indices(), avatar_.skin_bones().first(count), avatar_.skin_weights().first(count),
             avatar_.parts().first(count)},
            avatar_.limbs(),
            skin()};
}

const std::vector<Measurement>& Wearer::measures() const {
    std::lock_guard lock(measures_mutex_);
    if (measures_.empty()) measures_ = measure_avatar(avatar_, sex_);
    return measures_;
}

const std::vector<GirthLevel>& Wearer::girth_levels() const {
    const std::vector<Measurement>& own = measures();
    std::lock_guard lock(measures_mutex_);
    if (girth_levels_.empty())
        for (const TrunkLevel& level : trunk_levels(avatar_, sex_))
            if (const Measurement* girth = find(own, level.key))
                girth_levels_.push_back({level.key, level.height_m, girth->value, level.axis_z_m});
    return girth_levels_;
}

}  // namespace vfit
