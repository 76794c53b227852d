#include "api/cloth_set.h"

#include <algorithm>

#include "api/cloth_object.h"

namespace vfit::api {

ClothSet::ClothSet(Ref<Context> context) : context_(std::move(context)) {
    later_.task = [](void* self, uint32_t) {
        ClothSet& set = *static_cast<ClothSet*>(self);
        Profile::Scope time(set.context_->profile, Stage::cloth);
        set.worn_->step();
    };
    later_.data = this;
}

ClothSet::~ClothSet() { wait(); }

void ClothSet::require_no_step() const {
    if (stepping_) fail(VFIT_ERROR_STATE, "a step is running: end it first");
}

void ClothSet::start_step(const WornTogether& worn) {
    worn_.emplace(worn);
    stepping_ = true;
    const std::lock_guard lock(wait_);
    runs_ = true;
    context_->jobs->begin(later_);
}

void ClothSet::finish_step() {
    stepping_ = false;
    wait();
    const std::lock_guard lock(wait_);
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void ClothSet::wait() {
    const std::lock_guard lock(wait_);
    if (!std::exchange(runs_, false)) return;
    try {
        context_->jobs->end(later_);
    } catch (...) {
        error_ = std::current_exception();
    }
}

ClothsOfCall::ReadingProps::ReadingProps(const ClothsOfCall& of) : of_(of) {
    try {
        for (const Ref<ClothObject>& cloth : of_.cloths()) {
            cloth->drop_destroyed_props();
            for (const Ref<PropObject>& prop : cloth->props_)
                cloth->prop_readings_.emplace_back(prop->access, "prop");
        }
    } catch (...) {
        clear();
        throw;
    }
}

void ClothsOfCall::ReadingProps::clear() {
    for (const Ref<ClothObject>& cloth : of_.cloths()) cloth->prop_readings_.clear();
}

ClothsOfCall::ClothsOfCall(const ClothObject& cloth, const ClothObject* other) : of_(cloth) {
    {
        const std::lock_guard lock(cloth.avatar->cloth_sets);
        add(cloth);
        if (other && other->set_ != cloth.set_) add(*other);
    }
    for (; taken_ < count_; ++taken_) {
        if (cloths_[taken_].get() == &of_) continue;
        try {
            cloths_[taken_]->access.begin_exclusive("cloth that is worn with this one");
        } catch (...) {
            let_go();
            throw;
        }
    }
}

ClothsOfCall::~ClothsOfCall() { let_go(); }

/// The cloths of its set. One whose handle has died is worn no longer.
void ClothsOfCall::add(const ClothObject& cloth) {
    if (cloth.is_unnamed_) fail(VFIT_ERROR_HANDLE, "the cloth handle is stale: its object was destroyed");
    const auto add_one = [&](const Ref<ClothObject>& one) {
        if (count_ == cloths_.size())
            fail(VFIT_ERROR_CAPACITY, "more than ", cloths_.size(), " cloths are worn together");
        cloths_[count_++] = one;
    };
    const auto& all = cloth.set_->cloths;
    for (const Ref<ClothObject>& one : all) add_one(one);
    if (all.empty()) add_one(Ref<ClothObject>(const_cast<ClothObject*>(&cloth)));
}

void ClothsOfCall::let_go() {
    for (size_t i = 0; i < taken_; ++i)
        if (cloths_[i].get() != &of_) cloths_[i]->access.end_exclusive();
    taken_ = 0;
}

WornTogether ClothsOfCall::worn() const {
    std::array<WornGarment*, Fabric::kMaxPieces> garments{};
    for (size_t i = 0; i < count_; ++i) garments[i] = &cloths_[i]->worn;
    return WornTogether(std::span(garments).first(count_));
}

void ClothsOfCall::begin_step(float dt) {
    const Reading reading = cloths_[0]->read_avatar();
    const ReadingProps props(*this);
    begin_frames();
    worn().begin_step(dt);
}

void ClothsOfCall::begin_frames() {
    for (const Ref<ClothObject>& cloth : cloths()) {
        cloth->next_ = nullptr;  // of a call that failed
        cloth->next_ = cloth->output.begin();
    }
}

void ClothsOfCall::publish() {
    for (const Ref<ClothObject>& cloth : cloths()) cloth->publish_step();
}

void ClothsOfCall::end_step() {
    for (const Ref<ClothObject>& cloth : cloths()) cloth->worn.end_step();
    publish();
}

void ClothsOfCall::unite() {
    const auto set = std::make_shared<ClothSet>(of_.context);
    set->cloths.reserve(count_);
    const std::lock_guard lock(of_.avatar->cloth_sets);
    for (const Ref<ClothObject>& cloth : cloths()) {
        if (!cloth->is_unnamed_) set->cloths.push_back(cloth);
        cloth->set_->cloths.clear();
        set->begun += cloth->has_begun_;
    }
    for (const Ref<ClothObject>& cloth : cloths()) cloth->set_ = set;
}

}  // namespace vfit::api
