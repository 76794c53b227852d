// A reference to a frame of the library, and Frame as Python sees it.
#pragma once

#include "core.h"

namespace vfit_python {

/// One counted reference; the core stays alive with it.
class FrameReference {
public:
    FrameReference(std::shared_ptr<Core> core, vfit_frame frame) : core_(std::move(core)), frame_(frame) {}
    ~FrameReference() { release(); }
    FrameReference(FrameReference&& other) noexcept
        : core_(std::move(other.core_)), frame_(std::exchange(other.frame_, vfit_frame{})) {}
    FrameReference& operator=(FrameReference&&) = delete;

    FrameReference retained() const {
        check(vfit_frame_retain(get()));
        return {core_, frame_};
    }
    void release() {
        if (frame_.id) vfit_frame_release(std::exchange(frame_, vfit_frame{}));
    }
    vfit_frame get() const {
        if (!frame_.id) fail(VFIT_ERROR_HANDLE, "this frame was released");
        return frame_;
    }
    bool released() const { return frame_.id == 0; }
    const std::shared_ptr<Core>& core() const { return core_; }

private:
    std::shared_ptr<Core> core_;
    vfit_frame frame_;
};

class Frame {
public:
    Frame(const std::shared_ptr<Core>& core, vfit_frame frame) : reference(core, frame) {}
    vfit_frame get() const { return reference.get(); }
    FrameReference reference;
};

/// A frame of the host's pixels; None where there is no user map, colour or camera.
std::unique_ptr<Frame> frame_from_numpy(const std::shared_ptr<Core>& core, const py::array& depth,
                                        const py::sequence& intrinsics, const py::object& users,
                                        const py::object& color, const py::object& camera, int64_t time_ns);

int64_t time_ns_of(const Frame& frame);

/// The body to follow where none is named: the active one, who may be out of sight; 0: nobody.
uint32_t body_or_active(const Frame& frame, const std::optional<uint32_t>& body_id);

vfit_camera camera_in(const py::object& camera);

}  // namespace vfit_python
