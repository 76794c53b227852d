#include "outfit/worn_garment.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "outfit/hidden_skin.h"
#include "outfit/sag.h"
#include "outfit/size_check.h"

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
      cloth_(dress_.fabric(), settings_, place_in_pose(), &jobs) {
    time_ns_ = wearer.avatar().time_ns();
    stand();
    obstacles_.add_to(cloth_);
    // In a pose with closed legs, the bones carry the fronts of a coat through each other.
    if (size.own || settings_.self_thickness_m > 0.0f) {
        start_with_legs_apart();
        come_to_lengths(true);
    }
    if (size.own && !any_fit_) check_stretch(*size_, cut_);
    keep_step();
}

/// The triangles as they are cut in that size, in which the garment closes.
std::vector<Vec2> WornGarment::closing_cut(const SizeLabel& label, const SizeChoice& size) const {
    std::vector<Vec2> cut = dress_.cut(garment(), size.ratio, size.own);
    if (label && !any_fit_) check_closes({garment_, *label, dress_, cut}, wearer_.girth_levels());
    return cut;
}

bool WornGarment::wear_over(const WornGarment& inner) {
    if (&inner == this) fail(VFIT_ERROR_ARGUMENT, "a cloth cannot be worn over itself");
    if (&inner.wearer_ != &wearer_) fail(VFIT_ERROR_ARGUMENT, "both cloths must be of the same avatar");
    if (inner.layers_.reach(*this)) fail(VFIT_ERROR_ARGUMENT, "inner is worn over cloth already");
    if (layers_.has(inner)) return false;
    dress_.lift_over(inner.dress_, settings_.thickness_m);
    layers_.add(inner, cloth_);
    return true;
}

/// All vertices where the bones carry them.
const std::vector<Vec3>& WornGarment::place_in_pose() {
    dress_.place(avatar_pose(), targets_, scratch_, jobs_);
    return targets_;
}

/// The same for a body on its way into a pose, whose colliders are given.
void WornGarment::place_on_the_way(std::span<const Mat4> matrices, std::vector<Vec3>& targets,
                                   std::vector<Collider>& colliders) {
    obstacles_.select(matrices, colliders, jobs_);
    obstacles_.move_skin(matrices, cloth_, jobs_);
    dress_.place(matrices, targets, scratch_, jobs_);
}

/// The body is in the avatar's pose, and did not move there.
void WornGarment::stand() {
    pose_.assign(avatar_pose().begin(), avatar_pose().end());
    body_.stand(pose_);
    jumps_ = false;
    speed_m_s_ = limb_speed_m_s_ = 0.0f;
}

void WornGarment::begin_step(float dt) {
    const Avatar& avatar = wearer_.avatar();
    dress_.follow(avatar_pose(), targets_, scratch_, jobs_);
    avatar.colliders(colliders_);
    obstacles_.select(avatar_pose(), colliders_, jobs_);
    obstacles_.move_skin(avatar_pose(), cloth_, jobs_);
    layers_.move(cloth_);
    time_ns_ = avatar.time_ns();
    dt_ = dt;
    if (dt == 0.0f) return;  // the cloth stays where the step before left it
    const Mat4 root_before = pose_.front();
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
    carried_ = is_jump ? 1.0f : 1.0f - settings_.inertia;
    jumps_ = false;
    if (props_.count() > 0)
        props_.move(
            {{root_before, pose_.front(), carried_}, obstacles_.posed(colliders_), room_for_cloth_m()},
            simulated_s, cloth_, jobs_);
}

/// Between the body and a prop.
float WornGarment::room_for_cloth_m() const {
    constexpr float kSides = 3.0f;  // thicknesses: one to the body, one to the prop, one to spare
    return (kSides + float(layers_.count())) * settings_.thickness_m;
}

void WornGarment::step() {
    if (dt_ > 0.0f) carry_along(carried_);
    cloth_.step(dt_, targets_, colliders_, jobs_, [this](float share, float dt) {
        obstacles_.let_arms_pass(cloth_, share, dt, jobs_);
        props_.let_pass(cloth_, share, dt);
    });
}

void WornGarment::carry_along(float fraction) {
    if (!body_.moves() || (fraction == 0.0f && !body_.follows_jump())) return;
    body_.carry(cloth_.positions(), fraction, jobs_);
    cloth_.carry_along({fraction, body_.places(), body_.turns(), body_.speeds(), body_.is_rigid()});
}

/// From the pose of the last step.
void WornGarment::jump_to_pose() {
    body_.move_to(avatar_pose(), kMaxStep_s);
    carry_along(1.0f);
    body_.stand(avatar_pose());
}

/// Layers are carried by the bones from the pose, in which they hang, to the start and back.
void WornGarment::put_on() {
    time_ns_ = wearer_.avatar().time_ns();
    stand();
    std::vector<Mat4> matrices(avatar_pose().size());
    props_.hide(cloth_);
    obstacles_.meet_arms(cloth_);
    layers_.take_out(avatar_pose(), jobs_);
    wearer_.avatar().while_dressing(0.0f, matrices, colliders_);
    dress_.place(matrices, targets_, scratch_, jobs_);
    layers_.put_in(matrices, cloth_, jobs_);
    const auto body = [&](float share, std::vector<Vec3>& targets, std::vector<Collider>& colliders) {
        wearer_.avatar().while_dressing(share, matrices, colliders);
        place_on_the_way(matrices, targets, colliders);
        layers_.put_in(matrices, cloth_, jobs_);
    };
    if (layers_.count() > 0) {
        cloth_.reset(targets_);
        held_off_m_.assign(cloth_.positions().size(), 0.0f);
        move_outside(targets_, matrices, 0);
        hold_further_off(targets_);
        cloth_.go_to(targets_, jobs_);
        cloth_.come_to_lengths([&](float, auto& targets, auto& colliders) { body(0.0f, targets, colliders); },
                               jobs_);
        std::copy(cloth_.positions().begin(), cloth_.positions().end(), targets_.begin());
    }
    cloth_.put_on(targets_, body, jobs_);
    keep_step();
}

/// Past the layers from the `first` on, as the meshes were moved last.
void WornGarment::move_outside(std::vector<Vec3>& places, std::span<const Mat4> matrices, size_t first) {
    constexpr float kClear = 2.0f;  // thicknesses
    if (first == layers_.count()) return;
    const std::span<const Vec3> vertices = std::span(places).first(dress_.carry().vertex_count());
    const std::vector<BoneAxis> axes = wearer_.avatar().bone_axes(matrices);
    const std::vector<Vec3> on_bones = dress_.carry().on_axes(axes, vertices);
    const std::vector<Vec3> outside =
        layers_.outside(first, axes, {vertices, dress_.indices(), on_bones}, kClear * settings_.thickness_m);
    std::copy(outside.begin(), outside.end(), places.begin());
}

/// A layer that reaches far beyond it would have to be pressed together, which a layer below never is.
void WornGarment::check_reach(std::span<const Vec3> outside) {
    constexpr float kFar_m = 0.08f;
    std::vector<float> ways_m;
    for (size_t v = 0; v < cloth_.positions().size(); ++v)
        ways_m.push_back(glm::distance(outside[v], cloth_.positions()[v]));
    const auto tenth = ways_m.begin() + std::ptrdiff_t(ways_m.size() * 9 / 10);
    std::nth_element(ways_m.begin(), tenth, ways_m.end());
    if (*tenth <= kFar_m) return;
    const std::string below = layers_.last().garment().name;
    layers_.remove_last(cloth_);
    fail(VFIT_ERROR_NOT_WEARABLE, "garment ", garment().name, " does not fit over ", below,
         ", which reaches beyond a tenth of it by more than ", std::lround(*tenth * 100.0f), " cm");
}

/// By as far as layers move it off the body.
void WornGarment::hold_further_off(std::span<const Vec3> outside) {
    held_off_m_.resize(cloth_.positions().size());
    for (size_t v = 0; v < held_off_m_.size(); ++v)
        held_off_m_[v] += glm::distance(outside[v], cloth_.positions()[v]);
    cloth_.widen_limits(held_off_m_);
}

/// It may go through that layer: past it at once, and from there to its own lengths.
void WornGarment::come_outside_of_last_layer() {
    jump_to_pose();
    time_ns_ = wearer_.avatar().time_ns();
    stand();
    place_in_pose();
    layers_.move(cloth_);
    std::copy(cloth_.positions().begin(), cloth_.positions().end(), targets_.begin());
    move_outside(targets_, avatar_pose(), layers_.count() - 1);
    check_reach(targets_);
    hold_further_off(targets_);
    cloth_.go_to(targets_, jobs_);
    come_to_lengths(false);
    keep_step();
}

void WornGarment::start_with_legs_apart() {
    std::vector<Mat4> matrices(avatar_pose().size());
    wearer_.avatar().while_closing_legs(0.0f, matrices, colliders_);
    dress_.place(matrices, targets_, scratch_, jobs_);
    cloth_.reset(targets_);
}

/// From how the bones carried it, or from another size, in the avatar's pose. A cloth that is new starts
/// around legs that stand apart.
void WornGarment::come_to_lengths(bool is_new) {
    layers_.move(cloth_);
    std::vector<Mat4> matrices(avatar_pose().size());
    cloth_.come_to_lengths(
        [&](float share, std::vector<Vec3>& targets, std::vector<Collider>& colliders) {
            wearer_.avatar().while_closing_legs(is_new ? share : 1.0f, matrices, colliders);
            place_on_the_way(matrices, targets, colliders);
        },
        jobs_);
}

/// Cloth is slow to slide to where it has room. It is too small only where it hardly slides any further.
void WornGarment::check_stretch(const std::string& label, std::span<const Vec2> cut) {
    constexpr float kSlides = 0.9f;
    constexpr int kPasses = 8;
    float before = INFINITY;
    for (int pass = 0; const auto small = too_small({garment_, label, dress_, cut}, cloth_); ++pass) {
        if (small->beyond > kSlides * before || pass == kPasses) fail(VFIT_ERROR_NOT_WEARABLE, small->why);
        before = small->beyond;
        come_to_lengths(false);
    }
}

WornGarment::Resized WornGarment::in_size(const SizeLabel& label) const {
    const SizeChoice size = choose_size(garment(), label, wearer_);
    std::vector<Vec2> cut = closing_cut(label, size);
    TakenUp taken_up;
    const auto fabric =
        dress_.fabric_of(garment(), garment_.material(), size.ratio, size.own, &taken_up, &jobs_);
    return {label, size.own != nullptr, std::move(cut), taken_up, cloth_.with_fabric(fabric, &jobs_)};
}

void WornGarment::change_to(Resized resized) {
    const BodyJump body = body_;
    std::swap(cloth_, resized.cloth);
    std::swap(cut_, resized.cut);
    try {
        jump_to_pose();
        come_to_lengths(false);
        if (resized.has_own_lengths && !any_fit_) check_stretch(*resized.label, cut_);
    } catch (...) {
        cloth_ = std::move(resized.cloth);
        cut_ = std::move(resized.cut);
        body_ = body;
        throw;
    }
    taken_up_ = resized.taken_up;
    size_ = std::move(resized.label);
}

void WornGarment::set_wind(const Vec3& wind_m_s) {
    cloth_.set_air({wind_m_s, settings_.air.drag, settings_.air.lift});
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
    finished_.keep(cloth_, pose_, time_ns_, settings_.pressure);
    props_.keep_step();
}

UnposedGarment WornGarment::unposed(std::span<const Vec3> positions) const {
    return {positions, dress_.indices(), cut_, garment().on_arm, finished_.pressure()};
}

std::vector<WornGarment::ZoneFit> WornGarment::fit() const {
    const Carry::Unposed worn = finished_.unposed(dress_.carry(), jobs_);
    const float gravity_m_s2 = std::max(0.0f, -settings_.gravity.y);
    const std::vector<Vec3> raised =
        without_sag(unposed(worn.positions), garment().simulated, {gravity_m_s2, cloth_.substep_s()});
    std::vector<ZoneFit> zones;
    for (const GirthFit& girth : fit_of(unposed(raised), wearer_.girth_levels()))
        zones.push_back({girth, judge_fit(garment(), size_.value_or(""), girth)});
    return zones;
}

std::vector<float> WornGarment::tightness() const {
    const Carry::Unposed worn = finished_.unposed(dress_.carry(), jobs_);
    return tightness_of(unposed(worn.positions), cloth_.strain(), garment_.material().most_strain,
                        wearer_.skin());
}

std::vector<uint8_t> WornGarment::hidden_skin(float margin_m) const {
    // In a size, the garment may end elsewhere than where it would be made to.
    std::vector<Vec3> worn = size_ ? finished_.unposed(dress_.carry(), jobs_).positions : dress_.rest();
    return hidden_triangles({wearer_.positions(), wearer_.indices(), worn, dress_.indices()}, margin_m,
                            jobs_);
}

}  // namespace vfit
