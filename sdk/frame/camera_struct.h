// Cameras as the C structs of vfit.h say them: one reading for what a host, a plug-in and a tracker's
// description give.
#pragma once

#include "frame/camera.h"

namespace vfit {

/// Takes the image's size and the lens. Fails with VFIT_ERROR_ARGUMENT naming the field, and changes nothing
/// then.
void set_intrinsics(Camera& camera, const vfit_intrinsics& in);

/// Takes the depth unit and, unless floor_state is DEFAULT, the floor. Fails as above.
void set_placement(Camera& camera, const vfit_camera& in);

vfit_intrinsics intrinsics_out(const Camera& camera);
vfit_camera placement_out(const Camera& camera);

}  // namespace vfit
