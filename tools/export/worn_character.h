// A character's own file with garments in it: skinned meshes on the character's bones, and the triangles that
// they hide left out of its meshes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "export/glb_writer.h"

namespace vfit::tools {

struct WornMesh {
    std::string name;
    std::vector<glm::vec3> positions, normals;    // the file's world
    std::vector<glm::vec2> uvs;                   // empty, or one a vertex; v = 0 at the top
    std::vector<std::array<uint16_t, 4>> joints;  // numbers in WornCharacter::joints
    std::vector<std::array<float, 4>> weights;
    std::vector<uint32_t> indices;
    struct Part {
        std::string name;
        glm::vec3 color{0.8f};  // linear
        std::string picture;    // bytes of a PNG or JPEG file; may be empty
        uint32_t first_index = 0, index_count = 0;
    };
    std::vector<Part> parts;
};

struct WornCharacter {
    struct Joint {
        int node;
        glm::mat4 world;  // of that node, where the meshes' positions are
    };
    std::vector<Joint> joints;
    std::vector<WornMesh> meshes;
    struct Hidden {
        int node, primitive;  // a node of the file that shows a mesh, and which of that mesh's parts
        std::vector<uint8_t> triangles;  // one a triangle: 1, it is left out
    };
    std::vector<Hidden> hidden;
};

/// file: the character's, its data plain. Written as GLB; VRM stays VRM.
void write_worn_character(tinygltf::Model file, const WornCharacter& worn, const std::string& path);

}  // namespace vfit::tools
