#include "outfit/worn_garment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "outfit/hidden_skin.h"
#include "outfit/sag.h"
#include "outfit/size_check.h"
#include "outfit/worn_together.h"

namespace vfit {

WornGarment::WornGarment(const WearableGarment& garment, const Wearer& wearer, const WearOptions& options,
                         Jobs& jobs)
    : WornGarment(garment, wearer, options, choose_size(garment.garment(), options.size, wearer), jobs) {}

WornGarment::WornGarment(const WearableGarment& garment, const Wearer& wearer, const WearOptions& options,
                         const SizeChoice& size, Jobs& jobs)
    : garment_(garment),
      wearer_(wearer),
      jobs_(jobs),
      settings_(options.settings_of(garment.material())),
      any_fit_(options.any_fit),
      size_(options.size),
      dress_(garment.garment(), garment.bound(wearer.detail(), jobs), garment.material(), wearer.body(),
             size.ratio, settings_.thickness_m, size.own, &jobs),
      taken_up_(dress_.taken_up()),
      cut_(closing_cut(size_, size)),
      body_(dress_.carry(), dress_.rest()),
      obstacles_(wearer, garment.garment(), dress_, options),
      held_off_m_(dress_.rest().size(), 0.0f),
      cloth_(std::make_shared<WornCloth>(std::vector{dress_.fabric()}, std::span(&settings_, 1),
                                         place_in_pose(), jobs)) {
    time_ns_ = wearer.avatar().time_ns();
    stand();
    obstacles_.add_to(piece());
    WornGarment* const alone[] = {this};
    WornTogether together(alone);
    // In a pose with closed legs, the bones carry the fronts of a coat through each other.
    if (size.own || settings_.self_thickness_m > 0.0f) together.start_with_legs_apart();
    if (size.own && !any_fit_) together.check_stretch(*this);
    keep_step();
}

/// The triangles as they are cut in that size, in which the garment closes.
std::vector<Vec2> WornGarment::closing_cut(const SizeLabel& label, const SizeChoice& size) const {
    std::vector<Vec2> cut = dress_.cut(garment(), size.ratio, size.own);
    if (label && !any_fit_) check_closes({garment_, *label, dress_, cut}, wearer_.girth_levels());
    return cut;
}

bool WornGarment::reaches(const WornGarment& below) const {
    return std::any_of(below_.begin(), below_.end(), [&](const WornGarment* garment) {
        return garment == &below || garment->reaches(below);
    });
}

/// All vertices where the bones carry them.
const std::vector<Vec3>& WornGarment::place_in_pose() {
    dress_.place(avatar_pose(), targets_, scratch_, jobs_);
    return targets_;
}

/// The same for a body on its way into a pose, all of whose colliders are in colliders_.
void WornGarment::place_on_the_way(std::span<const Mat4> matrices) {
    obstacles_.select(matrices, colliders_, jobs_);
    obstacles_.move_skin(matrices, piece(), jobs_);
    dress_.place(matrices, targets_, scratch_, jobs_);
}

/// The body is in the avatar's pose, and did not move there.
void WornGarment::stand() {
    pose_.assign(avatar_pose().begin(), avatar_pose().end());
    body_.stand(pose_);
    jumps_ = false;
    speed_m_s_ = limb_speed_m_s_ = 0.0f;
}

/// dt after that of the last step; true: it jumped there.
bool WornGarment::take_pose(float dt) {
    const Avatar& avatar = wearer_.avatar();
    dress_.follow(avatar_pose(), targets_, scratch_, jobs_);
    avatar.colliders(colliders_);
    obstacles_.select(avatar_pose(), colliders_, jobs_);
    obstacles_.move_skin(avatar_pose(), piece(), jobs_);
    time_ns_ = avatar.time_ns();
    dt_ = dt;
    if (dt == 0.0f) return false;  // the cloth stays where the step before left it
    root_before_ = pose_.front();
    pose_.assign(avatar_pose().begin(), avatar_pose().end());
    const float simulated_s = std::clamp(dt, kMinStep_s, kMaxStep_s);
    body_.move_to(pose_, simulated_s);
    // A limb that swings gains its speed from step to step: what is compared is beyond that of the last one.
    BodyWay gained = body_.way();
    gained.whole_m -= speed_m_s_ * simulated_s;
    gained.limb_m -= limb_speed_m_s_ * simulated_s;
    const bool is_jump = jumps_ || settings_.is_jump(gained, simulated_s);
    speed_m_s_ = is_jump ? 0.0f : body_.way().whole_m / simulated_s;
    limb_speed_m_s_ = is_jump ? 0.0f : body_.way().limb_m / simulated_s;
    jumps_ = false;
    return is_jump;
}

void WornGarment::meet_props() {
    if (dt_ == 0.0f || props_.count() == 0) return;
    props_.move({{root_before_, pose_.front(), carried_}, obstacles_.posed(colliders_), room_for_cloth_m()},
                std::clamp(dt_, kMinStep_s, kMaxStep_s), piece(), jobs_);
}

/// Between the body and a prop.
float WornGarment::room_for_cloth_m() const {
    constexpr float kSides = 3.0f;  // thicknesses: one to the body, one to the prop, one to spare
    return (kSides + float(below_.size())) * settings_.thickness_m;
}

/// Those alone that are worn. Where one was destroyed there may be another one, which does not share the
/// cloth.
void WornGarment::keep_below(std::span<WornGarment* const> worn) {
    const size_t gone = std::erase_if(below_, [&](const WornGarment* below) {
        return std::find(worn.begin(), worn.end(), below) == worn.end() || !shares_cloth_with(*below);
    });
    if (gone == 0) return;
    if (below_.empty()) std::fill(held_off_m_.begin(), held_off_m_.end(), 0.0f);
    dress_.lie_on_skin();
    for (const WornGarment* below : below_) dress_.lift_over(below->dress_, settings_.thickness_m);
}

/// By as far as garments below move it off the body.
void WornGarment::hold_further_off(std::span<const Vec3> outside) {
    for (size_t v = 0; v < held_off_m_.size(); ++v)
        held_off_m_[v] += glm::distance(outside[v], positions()[v]);
}

WornGarment::Resized WornGarment::in_size(const SizeLabel& label) const {
    const SizeChoice size = choose_size(garment(), label, wearer_);
    std::vector<Vec2> cut = closing_cut(label, size);
    TakenUp taken_up;
    const auto fabric =
        dress_.fabric_of(garment(), garment_.material(), size.ratio, size.own, &taken_up, &jobs_);
    auto fabrics = cloth_->fabrics;
    fabrics[piece_] = fabric;
    return {label,          size.own != nullptr,
            std::move(cut), taken_up,
            fabric,         cloth_->cloth.with_fabric(WornCloth::joined(fabrics), &jobs_)};
}

void WornGarment::set_wind(const Vec3& wind_m_s) {
    Air air = cloth_->cloth.air();
    settings_.air.wind_m_s = air.wind_m_s = wind_m_s;
    cloth_->cloth.set_air(air);
}

void WornGarment::set_quality(uint32_t substeps, float budget_ms) {
    settings_.substeps = substeps, settings_.budget_ms = budget_ms;
    cloth_->cloth.set_quality(substeps, budget_ms);
}

bool WornGarment::stands_in_pose() const {
    const std::span<const Mat4> now = avatar_pose();
    return std::equal(now.begin(), now.end(), finished_.pose().begin(), finished_.pose().end());
}

FinishedStep::Reskinned WornGarment::reskin() {
    return finished_.reskin(dress_.carry(), avatar_pose(), wearer_.avatar().time_ns(), jobs_);
}

PressingCloth WornGarment::shown_surface() {
    const MeshView mesh{finished_.shown().positions, dress_.indices()};
    if (!surface_) surface_.emplace(mesh.positions, mesh.indices);
    surface_->move(mesh.positions, jobs_);
    return {mesh, &*surface_};
}

void WornGarment::keep_step() {
    finished_.keep(piece(), pose_, time_ns_, settings_.pressure);
    props_.keep_step();
}

UnposedGarment WornGarment::unposed(std::span<const Vec3> positions) const {
    return {positions, dress_.indices(), cut_, garment().on_arm, finished_.pressure()};
}

std::vector<WornGarment::ZoneFit> WornGarment::fit() const {
    const Carry::Unposed worn = finished_.unposed(dress_.carry(), jobs_);
    const float gravity_m_s2 = std::max(0.0f, -settings_.gravity.y);
    const std::vector<Vec3> raised =
        without_sag(unposed(worn.positions), garment().simulated, {gravity_m_s2, cloth_->cloth.substep_s()});
    std::vector<ZoneFit> zones;
    for (const GirthFit& girth : fit_of(unposed(raised), wearer_.girth_levels()))
        zones.push_back({girth, judge_fit(garment(), size_.value_or(""), girth)});
    return zones;
}

std::vector<float> WornGarment::tightness() const {
    const Carry::Unposed worn = finished_.unposed(dress_.carry(), jobs_);
    return tightness_of(unposed(worn.positions), piece().strain(), garment_.material().most_strain,
                        wearer_.skin());
}

std::vector<uint8_t> WornGarment::hidden_skin(float margin_m) const {
    // In a size, the garment may end elsewhere than where it would be made to.
    std::vector<Vec3> worn = size_ ? finished_.unposed(dress_.carry(), jobs_).positions : dress_.rest();
    return hidden_triangles({wearer_.positions(), wearer_.indices(), worn, dress_.indices()}, margin_m,
                            jobs_);
}

}  // namespace vfit
