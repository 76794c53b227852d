#include "outfit/worn_together.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.h"
#include "outfit/size_check.h"

namespace vfit {

WornTogether::WornTogether(std::span<WornGarment* const> garments) : count_(garments.size()) {
    if (garments.empty() || garments.size() > garments_.size())
        fail(VFIT_ERROR_ARGUMENT, garments.size(), " garments are worn together; there may be 1 to ",
             garments_.size());
    std::copy(garments.begin(), garments.end(), garments_.begin());
    for (const WornGarment* garment : garments)
        if (&garment->wearer_ != &garments[0]->wearer_)
            fail(VFIT_ERROR_ARGUMENT, "both cloths must be of the same avatar");
    for (WornGarment* garment : garments) garment->keep_below(garments);
    const bool share = std::all_of(garments.begin(), garments.end(), [&](const WornGarment* garment) {
        return garment->shares_cloth_with(*garments_[0]);
    });
    if (share)
        std::sort(garments_.begin(), garments_.begin() + std::ptrdiff_t(count_),
                  [](const WornGarment* a, const WornGarment* b) { return a->piece_ < b->piece_; });
    sort_outwards();
    if (share && !is_sorted_cloth()) share_cloth();
}

/// They share one, and come in the order of its pieces.
bool WornTogether::is_sorted_cloth() const {
    for (size_t i = 0; i < count_; ++i)
        if (!garments_[i]->shares_cloth_with(*garments_[0]) || garments_[i]->piece_ != i) return false;
    return garments_[0]->cloth_->fabrics.size() == count_;
}

/// Those below a garment come before it; else as they were given.
void WornTogether::sort_outwards() {
    for (size_t sorted = 0; sorted < count_; ++sorted) {
        const auto first = garments_.begin() + std::ptrdiff_t(sorted),
                   end = garments_.begin() + std::ptrdiff_t(count_);
        const auto next = std::find_if(first, end, [&](const WornGarment* garment) {
            return std::none_of(first, end,
                                [&](const WornGarment* other) { return garment->reaches(*other); });
        });
        std::rotate(first, next, next + 1);
    }
}

/// A new one, at these positions and velocities.
void WornTogether::share_cloth() {
    std::vector<std::shared_ptr<const Fabric>> fabrics;
    std::vector<ClothSettings> settings;
    std::vector<Vec3> places, velocities;
    for (const WornGarment* garment : garments()) {
        fabrics.push_back(garment->cloth_->fabrics[garment->piece_]);
        settings.push_back(garment->settings_);
        const Fabric::Range vertices = garment->cloth_->cloth.fabric().pieces()[garment->piece_].vertices;
        const auto at = vertices.of(garment->cloth_->cloth.positions());
        const std::vector<Vec3> all = garment->cloth_->cloth.velocities();
        const auto of = vertices.of(all);
        places.insert(places.end(), at.begin(), at.end());
        velocities.insert(velocities.end(), of.begin(), of.end());
    }
    const auto shared = std::make_shared<WornCloth>(std::move(fabrics), settings, places, jobs());
    shared->cloth.set_velocities(velocities);
    for (size_t i = 0; i < count_; ++i) {
        WornGarment& garment = *garments_[i];
        garment.cloth_ = shared, garment.piece_ = i;
        garment.obstacles_.add_to(garment.piece());
        garment.props_.add_to(garment.piece());
    }
    meet_layers();
    widen_limits();
    find_shapes();
}

/// What is found when it is asked for, which several threads may do.
void WornTogether::find_shapes() const { cloth().normals(), cloth().strain(); }

/// Those that are not worn over each other pass through each other.
void WornTogether::meet_layers() {
    for (size_t i = 0; i < count_; ++i)
        for (size_t below = 0; below < i; ++below)
            cloth().set_passing(below, i, !garments_[i]->reaches(*garments_[below]));
}

void WornTogether::widen_limits() {
    std::vector<float> by_m;
    for (const WornGarment* garment : garments())
        by_m.insert(by_m.end(), garment->held_off_m_.begin(), garment->held_off_m_.end());
    cloth().widen_limits(by_m);
}

/// Targets and colliders of all garments, for their cloth.
void WornTogether::gather() {
    WornCloth& to = *garments_[0]->cloth_;
    to.targets.resize(to.cloth.fabric().target_count());
    to.colliders.clear(), to.collider_ends.clear();
    for (size_t i = 0; i < count_; ++i) {
        const WornGarment& garment = *garments_[i];
        const Fabric::Piece& piece = to.cloth.fabric().pieces()[i];
        const auto centres = garment.targets_.begin() + piece.vertices.count();
        std::copy(garment.targets_.begin(), centres, to.targets.begin() + piece.vertices.begin);
        std::copy(centres, garment.targets_.end(),
                  to.targets.begin() + to.cloth.fabric().vertex_count() + piece.backstops.begin);
        to.colliders.insert(to.colliders.end(), garment.colliders_.begin(), garment.colliders_.end());
        to.collider_ends.push_back(uint32_t(to.colliders.size()));
    }
    to.cloth.set_collider_ends(to.collider_ends);
}

void WornTogether::begin_step(float dt) {
    float carried = 0.0f;
    for (WornGarment* garment : garments()) {
        const bool jumps = garment->take_pose(dt);
        carried = std::max(carried, jumps ? 1.0f : 1.0f - garment->settings_.inertia);
    }
    for (WornGarment* garment : garments()) garment->carried_ = carried, garment->meet_props();
    gather();
}

void WornTogether::step() {
    const float dt = garments_[0]->dt_;
    if (dt > 0.0f) carry_along(garments_[0]->carried_);
    const WornCloth& from = *garments_[0]->cloth_;
    cloth().step(dt, from.targets, from.colliders, jobs(), [this](float share, float passed_s) {
        for (WornGarment* garment : garments()) {
            garment->obstacles_.let_arms_pass(garment->piece(), share, passed_s, jobs());
            garment->props_.let_pass(garment->piece(), share, passed_s);
        }
    });
}

void WornTogether::end_step() {
    for (WornGarment* garment : garments()) garment->end_step();
}

void WornTogether::carry_along(float fraction) {
    const auto any = [&](const auto& holds) {
        return std::any_of(garments().begin(), garments().end(),
                           [&](const WornGarment* garment) { return holds(garment->body_); });
    };
    if (!any([](const BodyJump& body) { return body.moves(); })) return;
    if (fraction == 0.0f && !any([](const BodyJump& body) { return body.follows_jump(); })) return;
    WornCloth& to = *garments_[0]->cloth_;
    to.places.clear(), to.turns.clear(), to.speeds.clear();
    for (WornGarment* garment : garments()) {
        BodyJump& body = garment->body_;
        body.carry(garment->positions(), fraction, jobs());
        to.places.insert(to.places.end(), body.places().begin(), body.places().end());
        to.turns.insert(to.turns.end(), body.turns().begin(), body.turns().end());
        to.speeds.insert(to.speeds.end(), body.speeds().begin(), body.speeds().end());
    }
    const bool is_rigid = !any([](const BodyJump& body) { return !body.is_rigid(); });
    to.cloth.carry_along({fraction, to.places, to.turns, to.speeds, is_rigid});
}

/// From the pose of the last step.
void WornTogether::jump_to_pose() {
    for (WornGarment* garment : garments()) garment->body_.move_to(avatar_pose(), kMaxStep_s);
    carry_along(1.0f);
    for (WornGarment* garment : garments()) garment->body_.stand(avatar_pose());
}

void WornTogether::stand() {
    for (WornGarment* garment : garments()) {
        garment->time_ns_ = avatar().time_ns();
        garment->stand();
    }
}

/// pose(share, matrices): skinning matrices of the body on its way; the colliders to garment 0.
Cloth::BodyOnItsWay WornTogether::body_on_its_way(
    const std::function<void(float, std::vector<Mat4>&)>& pose) {
    return [this, pose, matrices = std::vector<Mat4>(avatar_pose().size())](
               float share, std::vector<Vec3>& targets, std::vector<Collider>& colliders) mutable {
        pose(share, matrices);
        for (size_t i = 1; i < count_; ++i) garments_[i]->colliders_ = garments_[0]->colliders_;
        for (WornGarment* garment : garments()) garment->place_on_the_way(matrices);
        gather();
        targets = garments_[0]->cloth_->targets;
        colliders = garments_[0]->cloth_->colliders;
    };
}

void WornTogether::start_with_legs_apart() {
    WornGarment& alone = *garments_[0];
    std::vector<Mat4> matrices(avatar_pose().size());
    avatar().while_closing_legs(0.0f, matrices, alone.colliders_);
    alone.dress_.place(matrices, alone.targets_, alone.scratch_, jobs());
    cloth().reset(alone.targets_);
    come_to_lengths(true);
}

/// From how the bones carried it, or from another size, in the avatar's pose. A cloth that is new starts
/// around legs that stand apart.
void WornTogether::come_to_lengths(bool is_new) {
    cloth().come_to_lengths(body_on_its_way([&](float share, std::vector<Mat4>& matrices) {
                                avatar().while_closing_legs(is_new ? share : 1.0f, matrices,
                                                            garments_[0]->colliders_);
                            }),
                            jobs());
}

/// Cloth is slow to slide to where it has room. It is too small only where it hardly slides any further.
void WornTogether::check_stretch(WornGarment& garment) {
    constexpr float kSlides = 0.9f;
    constexpr int kPasses = 8;
    const SizedGarment sized{garment.garment_, *garment.size_, garment.dress_, garment.cut_};
    float before = INFINITY;
    for (int pass = 0; const auto small = too_small(sized, garment.piece()); ++pass) {
        if (small->beyond > kSlides * before || pass == kPasses) fail(VFIT_ERROR_NOT_WEARABLE, small->why);
        before = small->beyond;
        come_to_lengths(false);
    }
}

bool WornTogether::wear_over(WornGarment& outer, WornGarment& inner) {
    if (&inner == &outer) fail(VFIT_ERROR_ARGUMENT, "a cloth cannot be worn over itself");
    if (inner.reaches(outer)) fail(VFIT_ERROR_ARGUMENT, "inner is worn over cloth already");
    if (std::find(outer.below_.begin(), outer.below_.end(), &inner) != outer.below_.end()) return false;
    const std::vector<std::vector<WornGarment*>> before = by_cloth();
    outer.below_.push_back(&inner);
    sort_outwards();
    if (is_sorted_cloth())
        meet_layers();
    else
        share_cloth();
    jump_to_pose();
    stand();
    try {
        go_outside(outer, inner);
    } catch (...) {
        std::erase(outer.below_, &inner);
        meet_layers();
        for (const std::vector<WornGarment*>& garments : before) WornTogether(garments).end_step();
        throw;
    }
    outer.dress_.lift_over(inner.dress_, outer.settings_.thickness_m);
    come_to_lengths(false);
    end_step();
    return true;
}

std::vector<std::vector<WornGarment*>> WornTogether::by_cloth() const {
    std::vector<std::vector<WornGarment*>> out;
    for (WornGarment* garment : garments()) {
        const auto own = std::find_if(out.begin(), out.end(), [&](const std::vector<WornGarment*>& of) {
            return of[0]->shares_cloth_with(*garment);
        });
        if (own == out.end())
            out.push_back({garment});
        else
            own->push_back(garment);
    }
    return out;
}

/// Of `inner`, in the avatar's pose, with what is worn over it.
void WornTogether::go_outside(const WornGarment& outer, const WornGarment& inner) {
    std::vector<std::vector<Vec3>> places_of(count_);
    std::vector<bool> is_moved(count_, false);
    std::vector<Vec3> places;
    for (size_t i = 0; i < count_; ++i) {
        WornGarment& garment = *garments_[i];
        garment.place_in_pose();
        const std::span<const Vec3> at = garment.positions();
        places_of[i].assign(at.begin(), at.end());
        is_moved[i] = &garment == &outer ||
                      std::any_of(garment.below_.begin(), garment.below_.end(),
                                  [&](const WornGarment* below) { return is_moved[below->piece_]; });
        if (is_moved[i]) {
            places_of[i] = outside(garment, avatar_pose(), [&](const WornGarment& of) {
                return std::span<const Vec3>(places_of[of.piece_]);
            });
            if (&garment == &outer) check_reach(outer, inner, places_of[i]);
            garment.hold_further_off(places_of[i]);
        }
        places.insert(places.end(), places_of[i].begin(), places_of[i].end());
    }
    widen_limits();
    cloth().go_to(places, jobs());
}

/// Its positions in places(), past those of the garments below.
std::vector<Vec3> WornTogether::outside(
    const WornGarment& garment, std::span<const Mat4> matrices,
    const std::function<std::span<const Vec3>(const WornGarment&)>& places) const {
    constexpr float kClear = 2.0f;  // thicknesses
    const std::vector<BoneAxis> axes = avatar().bone_axes(matrices);
    std::vector<std::vector<Vec3>> on_bones;
    on_bones.reserve(garment.below_.size() + 1);
    const auto about_bones = [&](const WornGarment& of) -> AboutBones {
        on_bones.push_back(of.dress_.carry().on_axes(axes, places(of)));
        return {places(of), of.dress_.indices(), on_bones.back()};
    };
    std::vector<AboutBones> below;
    for (const WornGarment* of : garment.below_) below.push_back(about_bones(*of));
    return outside_of(below, about_bones(garment), kClear * garment.settings_.thickness_m);
}

/// What reaches far beyond a garment would have to be pressed together below it.
void WornTogether::check_reach(const WornGarment& outer, const WornGarment& inner,
                               std::span<const Vec3> outside) {
    constexpr float kFar_m = 0.08f;
    std::vector<float> ways_m;
    for (size_t v = 0; v < outside.size(); ++v)
        ways_m.push_back(glm::distance(outside[v], outer.positions()[v]));
    const auto tenth = ways_m.begin() + std::ptrdiff_t(ways_m.size() * 9 / 10);
    std::nth_element(ways_m.begin(), tenth, ways_m.end());
    if (*tenth > kFar_m)
        fail(VFIT_ERROR_NOT_WEARABLE, "garment ", outer.garment().name, " does not fit over ",
             inner.garment().name, ", which reaches beyond a tenth of it by more than ",
             std::lround(*tenth * 100.0f), " cm");
}

void WornTogether::put_on() {
    stand();
    std::vector<Mat4> matrices(avatar_pose().size());
    avatar().while_dressing(0.0f, matrices, garments_[0]->colliders_);
    bool has_layers = false;
    for (WornGarment* garment : garments()) {
        garment->props_.hide(garment->piece());
        garment->obstacles_.meet_arms(garment->piece());
        garment->dress_.place(matrices, garment->targets_, garment->scratch_, jobs());
        has_layers = has_layers || !garment->below_.empty();
    }
    gather();
    const auto body = body_on_its_way([&](float share, std::vector<Mat4>& to) {
        avatar().while_dressing(share, to, garments_[0]->colliders_);
    });
    std::vector<Vec3> start = garments_[0]->cloth_->targets;
    if (has_layers) {
        cloth().reset(start);
        for (WornGarment* garment : garments()) {
            if (garment->below_.empty()) continue;
            const std::vector<Vec3> places = outside(*garment, matrices, [](const WornGarment& of) {
                return std::span<const Vec3>(of.targets_).first(of.dress_.carry().vertex_count());
            });
            std::copy(places.begin(), places.end(), garment->targets_.begin());
        }
        gather();
        cloth().go_to(garments_[0]->cloth_->targets, jobs());
        cloth().come_to_lengths([&](float, std::vector<Vec3>& targets,
                                    std::vector<Collider>& colliders) { body(0.0f, targets, colliders); },
                                jobs());
        start.assign(cloth().positions().begin(), cloth().positions().end());
    }
    cloth().put_on(start, body, jobs());
    end_step();
}

void WornTogether::change_to(WornGarment& garment, WornGarment::Resized resized) {
    std::vector<BodyJump> bodies;
    for (const WornGarment* of : garments()) bodies.push_back(of->body_);
    std::shared_ptr<const Fabric>& fabric = garment.cloth_->fabrics[garment.piece_];
    const auto swap = [&] {
        std::swap(cloth(), resized.cloth);
        std::swap(fabric, resized.fabric);
        std::swap(garment.cut_, resized.cut);
        std::swap(garment.size_, resized.label);
    };
    swap();
    try {
        jump_to_pose();
        come_to_lengths(false);
        if (resized.has_own_lengths && !garment.any_fit_) check_stretch(garment);
    } catch (...) {
        swap();
        for (size_t i = 0; i < count_; ++i) garments_[i]->body_ = bodies[i];
        throw;
    }
    garment.taken_up_ = resized.taken_up;
    find_shapes();
}

}  // namespace vfit
