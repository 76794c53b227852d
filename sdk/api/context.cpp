#include "api/context.h"

#include "avatar/avatar_measures.h"
#include "core/platform.h"

namespace vfit::api {

namespace {

// Frames that a host may hold at a time before tracking gets VFIT_ERROR_BUSY.
constexpr uint32_t kHostFrames = 32;

std::unique_ptr<Jobs> make_jobs(const vfit_context_desc& desc) {
    const uint32_t workers = desc.worker_count ? desc.worker_count : physical_cores() - 1;
    if (desc.submit) return Jobs::host(desc.submit, desc.wait, desc.user, workers);
    return Jobs::own(workers);
}

std::string folder_or_default(const char* given, const char* beside_library) {
    return given ? std::string(given) : library_folder() + "/" + beside_library;
}

}  // namespace

ContextChild::ContextChild(Ref<Context> owner) : context(std::move(owner)) {}
ContextChild::~ContextChild() = default;

void Inside::enter(Context& context) {
    std::lock_guard lock(context.mutex_);
    ++context.inside_;
}

Inside::Inside(Ref<Context> entered) : context_(std::move(entered)) {}

Inside::~Inside() {
    std::lock_guard lock(context_->mutex_);
    if (--context_->inside_ == 0) context_->idle_.notify_all();
}

Context::Context(const vfit_context_desc& desc)
    : flags(desc.flags),
      axes(desc.axes, (desc.flags & VFIT_CONTEXT_MIRROR) != 0),
      log(desc.log, desc.user),
      jobs(make_jobs(desc)),
      data_dir(folder_or_default(desc.data_dir, "vfit_data")),
      plugin_dir(folder_or_default(desc.plugin_dir, "vfit_plugins")),
      frame_bytes(make<FrameBytes>()),
      frames(make<FramePool>(kHostFrames, frame_bytes)),
      plugins_(std::make_unique<PluginHost>(log, [this] { return id; }, frame_bytes)) {
    plugins_->load_folder(plugin_dir);
}

std::string Context::module_path(const std::string& name) const {
    return library_folder() + "/vfit_modules/" + name + library_suffix();
}

std::shared_ptr<const BodyModel> Context::body_model() {
    std::lock_guard lock(model_mutex_);
    if (!model_) model_ = BodyModel::load(data_dir + "/body.bin");
    return model_;
}

std::shared_future<std::shared_ptr<const FitModel>> Context::fit_model() {
    std::lock_guard lock(model_mutex_);
    if (!fit_model_.valid())
        fit_model_ = std::async(std::launch::async, [model = model_, file = data_dir + "/body.bin"] {
            return std::shared_ptr<const FitModel>(
                std::make_shared<FitModel>(model ? *model : *BodyModel::load(file)));
        });
    return fit_model_;
}

std::shared_ptr<const MeasureModel> Context::measure_model() {
    std::lock_guard lock(model_mutex_);
    if (!measure_model_) measure_model_ = MeasureModel::load(data_dir + "/measures.json");
    return measure_model_;
}

const std::vector<Measurement>& Context::default_measures(vfit_sex sex) {
    const auto model = body_model();
    std::lock_guard lock(model_mutex_);
    auto& measures = default_measures_[static_cast<size_t>(sex)];
    if (measures.empty()) {
        AvatarDesc desc;
        desc.sex = sex;
        measures = measure_avatar(Avatar(model, desc, {}, Vec2(1.0f)), sex);
    }
    return measures;
}

uint64_t Context::publish(Kind kind, Ref<Object> object, uint64_t parent) {
    return Handles::instance().add(kind, std::move(object), parent ? parent : id);
}

Ref<Frame> Context::take_frame(FramePool& pool) {
    Ref<Frame> frame = pool.take();
    if (!frame) fail(VFIT_ERROR_BUSY, "all ", pool.out(), " frames of the pool are held; release some");
    return frame;
}

void Context::close() {
    {
        std::lock_guard lock(mutex_);
        if (closing_) fail(VFIT_ERROR_BUSY, "the context is being destroyed on another thread");
        closing_ = true;
    }
    // Wakes the calls that wait for a frame. First, so that no plug-in works on frames whose handles are
    // dead.
    end_streams();
    // From here on no new call enters.
    Handles::instance().destroy(id, Kind::context);
    std::unique_ptr<Jobs> last;
    std::unique_lock lock(mutex_);
    idle_.wait(lock, [this] { return inside_ == 0; });
    last = std::move(jobs);
}

}  // namespace vfit::api
