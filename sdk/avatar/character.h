// A character of the host's: a skinned humanoid from a glTF 2.0 or VRM file, made ready to be an avatar.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "avatar/avatar_source.h"

namespace vfit {

class GltfDocument;

enum class CharacterKind { gltf, vrm0, vrm1 };

/// Triangles of one material: indices first_index to first_index + index_count of the rest mesh.
struct CharacterPart {
    std::string mesh, material;
    int material_index = -1;        // of the file
    int node = -1, primitive = -1;  // that show it: a node of the file, and which of its mesh's parts
    uint32_t first_index = 0, index_count = 0;
};

struct Character {
    CharacterKind kind = CharacterKind::gltf;
    std::string name;  // as VRM tells it
    AvatarSource source;
    std::vector<CharacterPart> parts;
    // The avatar faces +Z, its soles on y = 0 over the origin: ours = M * the file's world.
    Mat4 from_file{1.0f};
    std::vector<Mat4> node_worlds;   // of the file's nodes in the posture of `source`, in the file's world
    std::vector<std::string> notes;  // what was left out
};

/// Morph targets and animations are ignored; meshes without a skin hang on the bone that they are attached
/// to. Own map: see find_humanoid. scale: metres in a unit of the file. VFIT_ERROR_DATA or
/// VFIT_ERROR_UNSUPPORTED with the cause.
Character load_character(const GltfDocument& document, const std::string& own_map, float scale = 1.0f);

}  // namespace vfit
