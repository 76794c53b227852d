// Avatar: a body of a shape or size, posed and skinned.
#pragma once

#include "core.h"

namespace vfit_python {

class Avatar : public Owned<vfit_avatar, vfit_avatar_destroy> {
public:
    using Owned::Owned;
};

/// vfit.Pose and the pose and bones of the C ABI.
py::object pose_out(const vfit_pose& pose, const std::vector<vfit_bone>& bones);
std::vector<vfit_bone> pose_in(const py::object& given, vfit_pose& pose);

}  // namespace vfit_python
