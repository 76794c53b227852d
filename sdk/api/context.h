// The object behind vfit_context: settings of the host and what all stages share.
#pragma once

#include <array>
#include <future>
#include <memory>
#include <string>

#include "anthropometry/measurement.h"
#include "api/access.h"
#include "body/body_model.h"
#include "core/jobs.h"
#include "core/log.h"
#include "core/profile.h"
#include "fit/fit_model.h"
#include "frame/axes.h"
#include "frame/frame.h"
#include "scan/measure_model.h"
#include "sensor/plugin_host.h"
#include "vfit.h"

namespace vfit::api {

class Context : public Object {
public:
    static constexpr Kind kKind = Kind::context;

    explicit Context(const vfit_context_desc& desc);

    uint64_t id = 0;  // of its own handle
    const uint32_t flags;
    const Axes axes;
    Log log;
    Profile profile;
    std::unique_ptr<Jobs> jobs;  // until close()
    const std::string data_dir, plugin_dir;
    /// File of a loadable module beside the library.
    std::string module_path(const std::string& name) const;
    const Ref<FrameBytes> frame_bytes;  // of all pools
    const Ref<FramePool> frames;        // of the host's own and of tracked frames
    Access access;

    /// The baked body, loaded when first asked for.
    std::shared_ptr<const BodyModel> body_model();
    /// The reduced body that is fitted to people: asked for first, it is made beside the caller's thread.
    std::shared_future<std::shared_ptr<const FitModel>> fit_model();
    /// What scans by the fitted body estimate measures with, loaded when first asked for.
    std::shared_ptr<const MeasureModel> measure_model();
    /// Tape measures of the default body of that sex, taken when first asked for.
    const std::vector<Measurement>& default_measures(vfit_sex sex);
    PluginHost& plugins() { return *plugins_; }

    /// A new handle below this context.
    uint64_t publish(Kind kind, Ref<Object> object, uint64_t parent = 0);
    /// A frame from a pool, or VFIT_ERROR_BUSY.
    static Ref<Frame> take_frame(FramePool& pool);

    /// Closes the sensors: no plug-in of this context works afterwards.
    void end_streams() { plugins_->shutdown(); }
    /// Ends the streams, kills the handles, waits until no call is inside and joins the workers. Nothing of
    /// the host's is called afterwards. A second thread that asks gets VFIT_ERROR_BUSY.
    void close();

private:
    friend class Inside;
    std::mutex mutex_;
    std::condition_variable idle_;
    uint32_t inside_ = 0;
    bool closing_ = false;
    std::mutex model_mutex_;
    std::shared_ptr<const BodyModel> model_;
    std::shared_future<std::shared_ptr<const FitModel>> fit_model_;
    std::shared_ptr<const MeasureModel> measure_model_;
    std::array<std::vector<Measurement>, VFIT_SEX_MALE + 1> default_measures_;
    std::unique_ptr<PluginHost> plugins_;
};

/// The context of a handle.
template <Mode kMode>
class UseContext {
public:
    explicit UseContext(vfit_context handle) : UseContext(entered(handle)) {}
    ~UseContext() {
        if constexpr (kMode == Mode::exclusive) context_->access.end_exclusive();
    }
    UseContext(const UseContext&) = delete;
    UseContext& operator=(const UseContext&) = delete;

    Context* operator->() const { return context_.get(); }
    Context& operator*() const { return *context_; }
    const Ref<Context>& ref() const { return context_; }

private:
    static Ref<Context> entered(vfit_context handle) {
        const auto enter = [](const Handles::Entry& entry) {
            Inside::enter(static_cast<Context&>(*entry.object));
        };
        return Ref<Context>(
            static_cast<Context*>(Handles::instance().find(handle.id, Kind::context, enter).object.get()));
    }
    explicit UseContext(Ref<Context>&& context) : context_(std::move(context)), inside_(context_) {
        if constexpr (kMode == Mode::exclusive) context_->access.begin_exclusive("context");
    }

    const Ref<Context> context_;
    const Inside inside_;
};

/// A frame and the context it belongs to.
class UseFrame {
public:
    explicit UseFrame(vfit_frame handle)
        : UseFrame(Handles::instance().find(handle.id, Kind::frame, enter)) {}

    Frame* operator->() const { return frame_.get(); }
    Frame& operator*() const { return *frame_; }
    const Ref<Frame>& ref() const { return frame_; }
    Context& context() const { return *context_; }

private:
    static void enter(const Handles::Entry& entry) { Inside::enter(static_cast<Context&>(*entry.parent)); }
    explicit UseFrame(Handles::Entry&& entry)
        : context_(static_cast<Context*>(entry.parent.get())),
          inside_(context_),
          frame_(static_cast<Frame*>(entry.object.get())) {
        entry.object = nullptr;
    }

    const Ref<Context> context_;
    const Inside inside_;
    const Ref<Frame> frame_;  // let go of inside the context: the host's release may be called then
};

}  // namespace vfit::api
