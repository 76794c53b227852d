// A recording folder that was checked: what is in it, and readers for each of its files.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "camera_file.h"
#include "frame_rows.h"
#include "joints_file.h"

namespace recording {

struct Folder {
    std::filesystem::path path;
    CameraFile camera;
    uint32_t frame_count = 0;
    bool has_mask = false, has_color = false;
    std::string measures;                        // one line of JSON; empty: none
    std::unique_ptr<JointsFile> joints;          // null: none
    std::unique_ptr<TimestampsFile> timestamps;  // null: none
    std::unique_ptr<ContactsFile> contacts;      // null: none

    /// "mask", 12 -> PATH/mask/000012.png
    std::filesystem::path picture(const char* kind, uint32_t frame) const;
};

/// Checks everything but the pixels. Fails with VFIT_ERROR_IO, _DATA or _VERSION, naming the file.
Folder open_folder(const std::filesystem::path& path);

}  // namespace recording
