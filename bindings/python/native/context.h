// Context as Python sees it: the way to new objects, and what can be asked of it.
#pragma once

#include "core.h"

namespace vfit_python {

class Context {
public:
    explicit Context(std::shared_ptr<Core> core) : core_(std::move(core)) {}
    const std::shared_ptr<Core>& core() const { return core_; }
    vfit_context handle() const { return core_->open_handle(); }

private:
    const std::shared_ptr<Core> core_;
};

}  // namespace vfit_python
