// The truth about one person's joints as the camera has them: their places in camera space and whether they
// are seen.
#pragma once

#include <span>
#include <vector>

#include "clean_image.h"
#include "depth_camera.h"
#include "vfit.h"

namespace vfit::virtual_person {

struct SeenBody {
    uint32_t id = 1;     // also the person's number in the user map
    uint32_t flags = 0;  // of vfit_body
    std::vector<vfit_joint> joints;
    bool in_view = false;  // at least one joint falls into the image
};

/// `world`: joints in world space. A joint is MEASURED where the image shows the skin of this person before
/// it.
void see_joints(std::span<const vfit_joint> world, const DepthCamera& camera, const CleanImage& image,
                SeenBody& out);

}  // namespace vfit::virtual_person
