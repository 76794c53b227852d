// Props about a person: a scabbard, a backpack, and a ball that circles.
#pragma once

#include <span>
#include <vector>

#include "client/client.h"

namespace vfit::tools {

class CarriedProps {
public:
    explicit CarriedProps(vfit_context context);

    /// To where they are on the avatar's pose of that time; before a step.
    void move(vfit_avatar avatar, double time_s);
    void add_to(std::span<const vfit_cloth> cloths) const;

private:
    using Prop = Handle<vfit_prop, vfit_prop_destroy>;
    Prop scabbard_, backpack_, ball_;
};

/// Which of these cloths cross props after their last step: pairs of triangles.
size_t prop_crossings(std::span<const vfit_cloth> cloths);

}  // namespace vfit::tools
