// The object behind vfit_prop.
#pragma once

#include <atomic>
#include <utility>
#include <vector>

#include "api/context.h"
#include "outfit/prop.h"

namespace vfit::api {

struct PropObject : ContextChild {
    static constexpr Kind kKind = Kind::prop;
    PropObject(Ref<Context> owner, const Mesh& mesh) : ContextChild(std::move(owner)), prop(mesh) {}

    Prop prop;
    std::vector<Vec3> given;  // room for what the host gives
    std::atomic<bool> is_destroyed{false};
    void handle_died() override { is_destroyed = true; }
};

}  // namespace vfit::api
