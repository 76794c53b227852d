#include "folder.h"

#include <cstdio>
#include <vector>

#include "support/failure.h"

namespace recording {

using plugin::fail;

namespace fs = std::filesystem;

namespace {

constexpr uint32_t kMaxFrames = 1'000'000;  // six digits of a file's name

std::string picture_name(uint32_t frame) {
    char name[32];
    std::snprintf(name, sizeof name, "%06u.png", frame);
    return name;
}

/// 12 for "000012.png", -1 for other names.
int frame_of(const std::string& name) {
    if (name.size() != 10 || name.compare(6, 4, ".png") != 0) return -1;
    int frame = 0;
    for (size_t i = 0; i < 6; ++i) {
        if (name[i] < '0' || name[i] > '9') return -1;
        frame = frame * 10 + (name[i] - '0');
    }
    return frame;
}

/// Number of pictures 0, 1, 2, ... in a folder (0: no such folder); fails where one is skipped.
uint32_t count_pictures(const fs::path& folder) {
    std::error_code error;
    if (!fs::exists(folder, error)) return 0;
    std::vector<bool> there;
    for (fs::directory_iterator file(folder, error), end; !error && file != end; file.increment(error)) {
        const int frame = frame_of(file->path().filename().string());
        if (frame < 0 || frame >= static_cast<int>(kMaxFrames)) continue;
        if (there.size() <= static_cast<size_t>(frame)) there.resize(static_cast<size_t>(frame) + 1);
        there[static_cast<size_t>(frame)] = true;
    }
    if (error) fail(VFIT_ERROR_IO, folder.string(), ": cannot be read: ", error.message());
    for (uint32_t i = 0; i < there.size(); ++i)
        if (!there[i])
            fail(VFIT_ERROR_DATA, (folder / picture_name(i)).string(), ": is missing, but pictures up to ",
                 picture_name(static_cast<uint32_t>(there.size() - 1)), " are there");
    return static_cast<uint32_t>(there.size());
}

/// Pictures that may accompany the depth images: none, or one for each.
bool has_pictures(const fs::path& folder, uint32_t frame_count) {
    const uint32_t count = count_pictures(folder);
    if (count > 0 && count < frame_count)
        fail(VFIT_ERROR_DATA, (folder / picture_name(count)).string(), ": is missing, there are ",
             frame_count, " depth images");
    return count > 0;
}

template <typename File>
std::unique_ptr<File> open_rows(const fs::path& path) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return nullptr;
    auto file = std::make_unique<File>(path);
    file->check();
    return file;
}

std::string find_measures(const fs::path& folder) {
    std::error_code ignored;
    const fs::path whole = fs::weakly_canonical(folder, ignored);
    for (const fs::path& place : {whole, whole.parent_path()})
        if (fs::is_regular_file(place / "measures.json", ignored))
            return read_measures_file(place / "measures.json");
    return {};
}

}  // namespace

fs::path Folder::picture(const char* kind, uint32_t frame) const { return path / kind / picture_name(frame); }

Folder open_folder(const fs::path& path) {
    std::error_code ignored;
    if (!fs::exists(path, ignored)) fail(VFIT_ERROR_IO, path.string(), ": there is no such folder");
    if (!fs::is_directory(path, ignored)) fail(VFIT_ERROR_DATA, path.string(), ": is not a folder");
    if (!fs::exists(path / "camera.json", ignored))
        fail(VFIT_ERROR_DATA, path.string(), ": is no recording, camera.json is missing");
    Folder folder;
    folder.path = path;
    folder.camera = read_camera_file(path / "camera.json");
    folder.frame_count = count_pictures(path / "depth");
    if (folder.frame_count == 0)
        fail(VFIT_ERROR_DATA, (path / "depth").string(),
             ": holds no depth images (000000.png, 000001.png, ...)");
    folder.has_mask = has_pictures(path / "mask", folder.frame_count);
    folder.has_color = has_pictures(path / "color", folder.frame_count);
    folder.joints = open_rows<JointsFile>(path / "joints.csv");
    folder.timestamps = open_rows<TimestampsFile>(path / "timestamps.csv");
    folder.contacts = open_rows<ContactsFile>(path / "contacts.csv");
    folder.measures = find_measures(path);
    return folder;
}

}  // namespace recording
