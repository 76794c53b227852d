// camera.json: what the pictures of a recording are.
#pragma once

#include <filesystem>
#include <string>

#include "vfit.h"

namespace recording {

struct CameraFile {
    std::string sensor;
    vfit_intrinsics intrinsics{};
    vfit_camera camera{};
    double fps = 30.0;
    bool segmented = false;
    bool mirrored = false;  // the images are; intrinsics and camera are those of images turned back
};

/// Fails with VFIT_ERROR_DATA naming the field, with VFIT_ERROR_VERSION for a version of the future.
CameraFile read_camera_file(const std::filesystem::path& path);

/// measures.json as one line, {"stature_m": 1.8}; fails with VFIT_ERROR_DATA where it is not such an object.
std::string read_measures_file(const std::filesystem::path& path);

}  // namespace recording
