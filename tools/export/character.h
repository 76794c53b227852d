// vfit's own body as a character file, with the rigs that characters commonly have: for games that have none
// yet, and as test characters.
#pragma once

#include <string>
#include <vector>

#include "client/client.h"

namespace vfit::tools {

enum class RigStyle {
    vrm0,    // VRM 0: faces -Z, all of VRM's body bones
    vrm1,    // VRM 1: only the bones that VRM requires
    mixamo,  // Mixamo's names, centimetres under a scaled root, bones along their own +Y
    bones31  // Unreal's names, 31 bones with a twist bone beside each limb, arms hanging at 45 degrees
};

/// "vrm0", "vrm1", "mixamo", "bones31".
RigStyle rig_style_from(const std::string& name);
std::vector<std::string> rig_style_names();

/// Writes the avatar's body as a GLB or VRM file with one material and a small texture. Bones that the style
/// lacks hand their skin to the next one towards the hips.
void export_character(vfit_context context, const vfit_avatar_desc& body,
                      const std::vector<vfit_shape_value>& shape, RigStyle style, const std::string& path);

}  // namespace vfit::tools
