#include "core.h"

namespace vfit_python {

namespace {

// Contexts of this process that are not closed; guarded by the GIL.
std::vector<Core*>& open_cores() {
    static std::vector<Core*> cores;
    return cores;
}

}  // namespace

void fail(vfit_result result, const std::string& message) { throw Failure(result, message); }

vfit_result check(vfit_result result) {
    if (result >= 0) return result;
    const std::string message =
        text([](char* buffer, uint32_t capacity) { return vfit_last_error(buffer, capacity); });
    fail(result, message.empty() ? vfit_result_name(result) : message);
}

float setting(const std::optional<float>& given) {
    if (!given) return 0.0f;
    return *given == 0.0f ? -1.0f : *given;
}

Core::Core(const vfit_context_desc& desc) {
    run([&] { return vfit_context_create(&desc, &handle_); });
    open_cores().push_back(this);
}

Core::~Core() {
    std::erase(open_cores(), this);
    vfit_context_destroy(handle_);
}

vfit_context Core::open_handle() const {
    if (closed_) fail(VFIT_ERROR_HANDLE, "the context was closed");
    return handle_;
}

void Core::close() {
    const auto self = shared_from_this();
    closed_ = true;
    std::erase(open_cores(), this);
    // Closing releases the GIL, so objects may come to their end on other threads meanwhile.
    std::vector<std::weak_ptr<Closable>> objects;
    for (const auto& [pointer, object] : objects_) objects.push_back(object);
    std::optional<Failure> first;
    for (const auto& weak : objects) {
        try {
            if (const auto object = weak.lock()) object->close();
        } catch (const Failure& failure) {
            if (!first) first = failure;
        }
    }
    if (first) throw *first;
}

void Core::close_all() {
    while (!open_cores().empty()) {
        Core* core = open_cores().back();
        try {
            core->close();
        } catch (const Failure&) {
            // The process ends: there is nobody left to tell, and the other contexts are to be closed too.
        }
    }
}

}  // namespace vfit_python
