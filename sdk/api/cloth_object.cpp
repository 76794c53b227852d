#include "api/cloth_object.h"

#include <algorithm>
#include <cmath>

namespace vfit::api {

ClothObject::ClothObject(Ref<AvatarObject> avatar_object, Ref<GarmentObject> garment_object,
                         const WearOptions& options)
    : ContextChild(avatar_object->context),
      avatar(std::move(avatar_object)),
      garment(std::move(garment_object)),
      worn(garment->wearable, avatar->wearer, options, *context->jobs),
      output(*context),
      set_(std::make_shared<ClothSet>(context)) {
    output.topology().set_indices(worn.garment().drawn_indices(), context->axes);
    output.topology().set_uvs(worn.garment().drawn_uvs(), context->axes);
    next_ = output.begin();
    publish_step();
}

/// No call uses it any more; a step on another thread may.
ClothObject::~ClothObject() {
    set_->wait();
    if (has_begun_) --set_->begun;
}

void ClothObject::handle_died() {
    Ref<ClothObject> self;  // let go of after the lock
    const std::lock_guard lock(avatar->cloth_sets);
    is_unnamed_ = true;
    for (Ref<ClothObject>& cloth : set_->cloths)
        if (cloth.get() == this) std::swap(self, cloth);
    std::erase(set_->cloths, nullptr);
}

namespace {

void check_dt(float dt) {
    if (!std::isfinite(dt) || dt < 0.0f) fail(VFIT_ERROR_ARGUMENT, "dt ", dt, " is no time");
}

}  // namespace

void ClothObject::require_settled() {
    if (set_->is_stepping() && set_->begun == 0) {
        ClothsOfCall all(*this);
        set_->finish_step();
        all.end_step();
    }
    require_no_step();
}

void ClothObject::step(float dt) {
    check_dt(dt);
    if (has_begun_) fail(VFIT_ERROR_STATE, "a step has begun already: end it first");
    require_settled();
    if (std::exchange(is_stepped_, false)) return;
    ClothsOfCall all(*this);
    all.begin_step(dt);
    {
        Profile::Scope time(context->profile, Stage::cloth);
        all.worn().step();
    }
    all.end_step();
    for (const Ref<ClothObject>& cloth : all.cloths())
        cloth->is_stepped_ = dt > 0.0f && cloth.get() != this, cloth->is_put_on_ = false;
}

void ClothObject::start_step(float dt) {
    check_dt(dt);
    if (has_begun_) fail(VFIT_ERROR_STATE, "a step has begun already: end it first");
    if (!std::exchange(is_stepped_, false)) {
        require_settled();
        ClothsOfCall all(*this);
        all.begin_step(dt);
        set_->start_step(all.worn());
        for (const Ref<ClothObject>& cloth : all.cloths())
            cloth->is_stepped_ = cloth.get() != this, cloth->is_put_on_ = false;
    }
    has_begun_ = true;
    ++set_->begun;
}

void ClothObject::finish_step() {
    if (!has_begun_) fail(VFIT_ERROR_STATE, "no step has begun");
    ClothsOfCall all(*this);
    has_begun_ = false;
    --set_->begun;
    if (!set_->is_stepping()) return;  // a call on another cloth ended it
    set_->finish_step();
    all.end_step();
}

void ClothObject::publish_step() {
    const FinishedStep& finished = worn.finished();
    publish({finished.positions(), finished.normals()}, finished.time_ns(), std::move(next_));
}

void ClothObject::put_on() {
    require_settled();
    const Reading reading = read_avatar();
    if (std::exchange(is_put_on_, false) && worn.stands_in_pose()) return;
    ClothsOfCall all(*this);
    const ClothsOfCall::ReadingProps props(all);
    all.begin_frames();
    all.worn().put_on();
    all.publish();
    for (const Ref<ClothObject>& cloth : all.cloths())
        cloth->is_put_on_ = cloth.get() != this, cloth->is_stepped_ = false;
}

void ClothObject::change_size(const char* label) {
    require_settled();
    ClothsOfCall all(*this);
    const ClothsOfCall::ReadingProps props(all);
    WornTogether together = all.worn();
    WornGarment::Resized resized = worn.in_size(label ? SizeLabel(label) : SizeLabel());
    const Reading reading = read_avatar();
    together.change_to(worn, std::move(resized));
    for (const Ref<ClothObject>& cloth : all.cloths()) cloth->is_put_on_ = false;
}

void ClothObject::set_wind(const Vec3& wind_m_s) {
    require_settled();
    const ClothsOfCall all(*this);
    for (const Ref<ClothObject>& cloth : all.cloths()) cloth->worn.set_wind(wind_m_s);
}

void ClothObject::set_quality(uint32_t substeps, float budget_ms) {
    require_settled();
    const ClothsOfCall all(*this);
    for (const Ref<ClothObject>& cloth : all.cloths()) cloth->worn.set_quality(substeps, budget_ms);
}

void ClothObject::wear_over(const Ref<ClothObject>& inner) {
    require_settled();
    if (inner->avatar != avatar) fail(VFIT_ERROR_ARGUMENT, "both cloths must be of the same avatar");
    ClothsOfCall all(*this, inner.get());
    inner->require_no_step();
    const Reading reading = read_avatar();
    const ClothsOfCall::ReadingProps props(all);
    all.begin_frames();
    if (!all.worn().wear_over(worn, inner->worn)) return;
    all.unite();
    all.publish();
    for (const Ref<ClothObject>& cloth : all.cloths()) cloth->is_put_on_ = cloth->is_stepped_ = false;
}

void ClothObject::reskin() {
    const Reading reading = read_avatar();
    Ref<Frame> frame = output.begin();
    const FinishedStep::Reskinned mesh = worn.reskin();
    publish(mesh, worn.finished().shown().time_ns, std::move(frame));
}

void ClothObject::meet(const Ref<PropObject>& prop) {
    constexpr size_t kMaxProps = 64;
    require_settled();
    const ClothsOfCall all(*this);
    drop_destroyed_props();
    if (prop->context != context) fail(VFIT_ERROR_HANDLE, "cloth and prop belong to different contexts");
    if (props_.size() == kMaxProps && std::find(props_.begin(), props_.end(), prop) == props_.end())
        fail(VFIT_ERROR_CAPACITY, "the cloth meets ", kMaxProps, " props already");
    props_.reserve(props_.size() + 1), prop_readings_.reserve(props_.size() + 1);
    if (worn.meet(prop->prop)) props_.push_back(prop);
}

void ClothObject::drop_destroyed_props() {
    std::erase_if(props_,
                  [&](const Ref<PropObject>& prop) { return prop->is_destroyed && worn.pass(prop->prop); });
}

void ClothObject::pass(const Ref<PropObject>& prop) {
    require_settled();
    const ClothsOfCall all(*this);
    if (worn.pass(prop->prop)) std::erase(props_, prop);
}

void ClothObject::write_mesh(const FinishedStep::Reskinned& mesh, const MeshOutput::Vertices& to) const {
    const Garment& clothing = worn.garment();
    const Axes& axes = context->axes;
    Vec3 *position = to.positions, *normal = to.normals;
    const auto add = [&](const Vec3& p, const Vec3& n) {
        *position++ = axes.point_out(p);
        *normal++ = axes.direction_out(n);
    };
    if (const DrawnMesh& drawn = clothing.drawn; !drawn.empty()) {
        const CarryingMesh carrying{clothing.mesh.indices, mesh.positions, mesh.normals};
        for (size_t i = 0; i < drawn.triangles.size(); ++i) {
            const DrawnFrame frame(carrying, drawn.triangles[i], drawn.weights[i]);
            add(frame.origin + frame.axes * drawn.offsets[i], frame.axes * drawn.normals[i]);
        }
        return;
    }
    for (size_t i = 0; i < mesh.positions.size(); ++i) add(mesh.positions[i], mesh.normals[i]);
    for (const uint32_t of : clothing.copies) add(mesh.positions[of], mesh.normals[of]);
}

void ClothObject::write_drawn(const std::vector<float>& values, float* to) const {
    const Garment& of = worn.garment();
    if (of.drawn.empty()) {
        to = std::copy(values.begin(), values.end(), to);
        for (const uint32_t v : of.copies) *to++ = values[v];
        return;
    }
    for (size_t i = 0; i < of.drawn.triangles.size(); ++i) {
        const uint32_t* v = &of.mesh.indices[3 * size_t(of.drawn.triangles[i])];
        const Vec2& w = of.drawn.weights[i];
        *to++ = (1.0f - w.x - w.y) * values[v[0]] + w.x * values[v[1]] + w.y * values[v[2]];
    }
}

void ClothObject::publish(const FinishedStep::Reskinned& mesh, int64_t time_ns, Ref<Frame> frame) {
    const uint32_t count = worn.garment().drawn_count();
    write_mesh(mesh, output.add_vertices(*frame, count, time_ns));
    const auto add = [&](vfit_stream stream, const std::vector<float>& values) {
        write_drawn(values, static_cast<float*>(frame->add_stream(stream, VFIT_FORMAT_F32, count, 1)));
    };
    add(VFIT_STREAM_STRAIN, worn.finished().strain());
    if (!worn.finished().pressure().empty()) add(VFIT_STREAM_PRESSURE, worn.finished().pressure());
    output.publish(std::move(frame));
}

}  // namespace vfit::api
