// Which nodes of a character's file are its humanoid bones: as VRM 0 or 1 says, else by the names that common
// tools give them, and by their places where names say nothing.
#pragma once

#include <array>
#include <string>

#include "avatar/character.h"
#include "avatar/gltf_document.h"
#include "avatar/humanoid_tree.h"
#include "body/skeleton.h"

namespace vfit {

struct HumanoidMap {
    CharacterKind kind = CharacterKind::gltf;
    std::array<int, kBoneCount> node;  // -1: none
    HumanoidTree tree;                 // each bone hangs on that above it
    HumanoidMap() { node.fill(-1); }
};

/// `own_map` is {"hips": "name of a node", ...} as JSON text, before all others; may be empty.
/// VFIT_ERROR_DATA where a required bone is found nowhere, naming all that miss, with the tree of nodes and a
/// bone map to fill in, or where the map contradicts the tree.
HumanoidMap find_humanoid(const GltfDocument& document, const std::string& own_map);

/// The bone and side that a node's name says, or -1; of the spine VFIT_BONE_SPINE for all.
int bone_of_name(const std::string& name);

}  // namespace vfit
