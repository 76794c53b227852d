// Scenes with known people for vfit-bench user_map: the virtual person, real people cut out of their
// recordings, and those put into virtual rooms and into a real picture by depth test.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "frame/depth_image.h"

namespace vfit::tools {

/// One depth image with the truth beside it; the tracker gets the depth alone.
struct Shot {
    std::vector<uint16_t> depth;
    std::vector<uint8_t> truth;  // number of the person from 1, 0: nobody who is known
    Camera camera;               // with the true floor, where somebody knows it
    int64_t time_ns = 0;
    bool floor_known = false;
};

struct Scene {
    std::string name;
    bool alone = true;  // one person and nobody else in the picture: whatever else is labelled is wrong
    std::function<void(const std::function<void(const Shot&)>&)> play;
};

struct SceneGroup {
    std::string name;
    std::vector<Scene> scenes;
};

/// Motions, distances and cameras of the virtual person, `frames` images each.
SceneGroup virtual_scenes(uint32_t frames);
/// Every recording below the folder, alone, in rooms, and (where the file exists) in the still; and several
/// of them at a time in one room.
std::vector<SceneGroup> real_scenes(const std::string& recordings, const std::string& still);

/// The frames of a sensor or recording as shots; the truth is its user map.
void play_source(const std::string& uri, const std::function<void(const Shot&)>& show);
/// One depth picture in millimetres, without truth, through the recording reader.
Shot load_still(const std::string& path, float focal_px, float cx, float cy);

}  // namespace vfit::tools
