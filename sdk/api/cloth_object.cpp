#include "api/cloth_object.h"

#include <algorithm>
#include <cmath>

namespace vfit::api {

/// A step's access to the props.
class ClothObject::ReadingProps {
public:
    explicit ReadingProps(ClothObject& cloth) : readings_(cloth.prop_readings_) {
        cloth.drop_destroyed_props();
        try {
            for (const Ref<PropObject>& prop : cloth.props_) readings_.emplace_back(prop->access, "prop");
        } catch (...) {
            readings_.clear();
            throw;
        }
    }
    ~ReadingProps() { readings_.clear(); }
    ReadingProps(const ReadingProps&) = delete;
    ReadingProps& operator=(const ReadingProps&) = delete;

private:
    std::vector<Reading>& readings_;
};

ClothObject::ClothObject(Ref<AvatarObject> avatar_object, Ref<GarmentObject> garment_object,
                         const WearOptions& options)
    : ContextChild(avatar_object->context),
      avatar(std::move(avatar_object)),
      garment(std::move(garment_object)),
      worn(garment->wearable, avatar->wearer, options, *context->jobs),
      output(*context) {
    output.topology().set_indices(worn.garment().drawn_indices(), context->axes);
    output.topology().set_uvs(worn.garment().mesh.uvs, context->axes);
    next_ = output.begin();
    publish_step();
    later_.task = [](void* self, uint32_t) { static_cast<ClothObject*>(self)->step(); };
    later_.data = this;
}

ClothObject::~ClothObject() {
    try {
        if (stepping_) finish_step();
    } catch (...) {
        // The step failed, and no call of the host is left to report it.
    }
}

void ClothObject::begin_step(float dt) {
    if (stepping_) fail(VFIT_ERROR_STATE, "a step has begun already: end it first");
    if (!std::isfinite(dt) || dt < 0.0f) fail(VFIT_ERROR_ARGUMENT, "dt ", dt, " is no time");
    const Reading reading = read_avatar();
    const ReadingProps props(*this);
    next_ = output.begin();
    see_layers();
    worn.begin_step(dt);
}

void ClothObject::step() {
    Profile::Scope time(context->profile, Stage::cloth);
    worn.step();
}

void ClothObject::end_step() {
    worn.end_step();
    publish_step();
}

void ClothObject::publish_step() {
    const FinishedStep& finished = worn.finished();
    publish({finished.positions(), finished.normals()}, finished.time_ns(), std::move(next_));
}

void ClothObject::start_step(float dt) {
    begin_step(dt);
    stepping_ = true;
    context->jobs->begin(later_);
}

void ClothObject::finish_step() {
    if (!stepping_) fail(VFIT_ERROR_STATE, "no step has begun");
    stepping_ = false;
    context->jobs->end(later_);
}

void ClothObject::require_no_step() const {
    if (stepping_) fail(VFIT_ERROR_STATE, "a step is running: end it first");
}

void ClothObject::put_on() {
    require_no_step();
    const Reading reading = read_avatar();
    next_ = output.begin();
    see_layers();
    worn.put_on();
    publish_step();
}

void ClothObject::change_size(const char* label) {
    require_no_step();
    WornGarment::Resized resized = worn.in_size(label ? SizeLabel(label) : SizeLabel());
    const Reading reading = read_avatar();
    see_layers();
    worn.change_to(std::move(resized));
}

void ClothObject::reskin() {
    const Reading reading = read_avatar();
    Ref<Frame> frame = output.begin();
    const FinishedStep::Reskinned mesh = worn.reskin();
    publish(mesh, worn.finished().shown().time_ns, std::move(frame));
}

void ClothObject::meet(const Ref<PropObject>& prop) {
    constexpr size_t kMaxProps = 64;
    require_no_step();
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
    require_no_step();
    if (worn.pass(prop->prop)) std::erase(props_, prop);
}

/// Where the last step of each layer left it.
void ClothObject::see_layers() {
    for (size_t i = 0; i < below_.size(); ++i) {
        const Reading reading(below_[i]->access, "cloth below");
        worn.see_layer(i, below_[i]->stepped());
    }
}

/// The vertices of a cloth below another one.
const std::vector<Vec3>& ClothObject::stepped() const {
    if (stepping_) fail(VFIT_ERROR_STATE, "a step of the cloth below has begun: end it first");
    return worn.positions();
}

void ClothObject::wear_over(const Ref<ClothObject>& inner) {
    require_no_step();
    std::vector<Reading> readings;
    inner->read_below(*this, readings);
    const Reading reading = read_avatar();
    see_layers();
    const std::vector<Vec3>& lies = inner->stepped();
    below_.reserve(below_.size() + 1);
    Ref<Frame> next = output.begin();
    if (!worn.wear_over(inner->worn)) return;
    worn.see_layer(below_.size(), lies);
    worn.come_outside_of_last_layer();
    below_.push_back(inner);
    next_ = std::move(next);
    publish_step();
}

/// Of all layers down to `end`, which the caller has for itself: other threads may dress them.
void ClothObject::read_below(const ClothObject& end, std::vector<Reading>& readings) const {
    for (const Ref<ClothObject>& layer : below_) {
        if (layer.get() == &end) continue;
        readings.emplace_back(layer->access, "cloth below");
        layer->read_below(end, readings);
    }
}

void ClothObject::publish(const FinishedStep::Reskinned& mesh, int64_t time_ns, Ref<Frame> frame) {
    const Garment& drawn = worn.garment();
    const MeshOutput::Vertices vertices = output.add_vertices(*frame, drawn.drawn_count(), time_ns);
    const Axes& axes = context->axes;
    write_drawn(mesh.positions, vertices.positions, [&](const Vec3& p) { return axes.point_out(p); });
    write_drawn(mesh.normals, vertices.normals, [&](const Vec3& n) { return axes.direction_out(n); });
    const auto add = [&](vfit_stream stream, const std::vector<float>& values) {
        write_drawn(values,
                    static_cast<float*>(frame->add_stream(stream, VFIT_FORMAT_F32, drawn.drawn_count(), 1)),
                    [](float x) { return x; });
    };
    add(VFIT_STREAM_STRAIN, worn.finished().strain());
    if (!worn.finished().pressure().empty()) add(VFIT_STREAM_PRESSURE, worn.finished().pressure());
    output.publish(std::move(frame));
}

}  // namespace vfit::api
