#include "avatar/character.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <tuple>

#include "avatar/humanoid_map.h"
#include "avatar/rest_posture.h"
#include "core/error.h"

namespace vfit {

namespace {

constexpr size_t kMostVertices = size_t(4) << 20, kMostIndices = 6 * kMostVertices;
constexpr float kLeastStature_m = 0.3f, kMostStature_m = 4.0f;
constexpr float kLeastWeight = 1e-4f;
constexpr float kSamePlace_m = 1e-3f;

/// The file's nodes as rig bones: those that a skin names, and the humanoid ones.
struct CharacterRig {
    std::vector<AvatarBone> bones;
    std::vector<int> of_node;  // -1: no bone
};

/// Whether a name has one of the words in it, whatever its case.
bool speaks_of(const std::string& name, std::initializer_list<const char*> words) {
    std::string low;
    for (const char c : name) low += char(std::tolower(static_cast<unsigned char>(c)));
    return std::any_of(words.begin(), words.end(),
                       [&](const char* word) { return low.find(word) != std::string::npos; });
}

/// Of a bone's axes, which may have any length, and may be sheared by scales above it.
Quat rotation_of(Mat3 axes, const std::string& name) {
    for (int c = 0; c < 3; ++c) {
        const float length = glm::length(axes[c]);
        if (length < 1e-12f) fail(VFIT_ERROR_DATA, "the bone \"", name, "\" is scaled to nothing");
        axes[c] /= length;
    }
    if (glm::determinant(axes) < 0.0f)
        fail(VFIT_ERROR_UNSUPPORTED, "the bone \"", name, "\" is mirrored by a negative scale");
    // Right angles again: the first axis stays, the second one stays in its plane with the first.
    axes[1] -= glm::dot(axes[0], axes[1]) * axes[0];
    const float length = glm::length(axes[1]);
    if (length < 1e-3f) fail(VFIT_ERROR_DATA, "the bone \"", name, "\" is scaled to a plane");
    axes[1] /= length;
    axes[2] = glm::cross(axes[0], axes[1]);
    return glm::normalize(glm::quat_cast(axes));
}

/// The first bone that turns below a scale with another share along each axis; -1: there is none.
int sheared_bone(const GltfDocument& document, const CharacterRig& rig) {
    constexpr float kRounding = 1e-3f;  // of files that were written with single precision
    for (size_t i = 0; i < rig.bones.size(); ++i) {
        const int above = document.parent(rig.bones[i].node);
        if (above < 0) continue;
        const Mat3 axes(document.node_worlds()[size_t(above)]);
        const Vec3 lengths(glm::length(axes[0]), glm::length(axes[1]), glm::length(axes[2]));
        const float longest = std::max({lengths.x, lengths.y, lengths.z});
        if (std::min({lengths.x, lengths.y, lengths.z}) < (1.0f - kRounding) * longest) return int(i);
    }
    return -1;
}

CharacterRig make_character_rig(const GltfDocument& document, const HumanoidMap& map,
                                const std::vector<Mat4>& worlds, const Mat4& from_file) {
    std::vector<bool> used(document.model().nodes.size(), false);
    for (const tinygltf::Skin& skin : document.model().skins)
        for (const int joint : skin.joints) used[size_t(joint)] = true;
    std::vector<int> humanoid(used.size(), -1);
    for (int b = 0; b < kBoneCount; ++b)
        if (const int node = map.node[size_t(b)]; node >= 0) {
            if (humanoid[size_t(node)] >= 0)
                fail(VFIT_ERROR_DATA, "node \"", document.node_name(node),
                     "\" is two bones: ", bone_name(humanoid[size_t(node)]), " and ", bone_name(b));
            humanoid[size_t(node)] = b;
            used[size_t(node)] = true;
        }
    CharacterRig rig;
    rig.of_node.assign(used.size(), -1);
    for (const int node : map.tree.nodes()) {
        if (!used[size_t(node)]) continue;
        int parent = map.tree.parent(node);
        while (parent >= 0 && rig.of_node[size_t(parent)] < 0) parent = map.tree.parent(parent);
        const Mat4 world = from_file * worlds[size_t(node)];
        AvatarBone bone;
        bone.name = document.node_name(node);
        bone.parent = parent < 0 ? -1 : rig.of_node[size_t(parent)];
        bone.bone = humanoid[size_t(node)];
        bone.rest_head = bone.rest_tail = Vec3(world[3]);
        bone.rest_rotation = rotation_of(Mat3(world), bone.name);
        bone.node = node;
        bone.is_twist = bone.bone < 0 && speaks_of(bone.name, {"twist", "roll"});
        rig.of_node[size_t(node)] = int(rig.bones.size());
        rig.bones.push_back(bone);
    }
    return rig;
}

/// Upright along +Y, to be turned about Y so that its left is on +X.
Mat4 upright_from_file(const std::vector<Mat4>& worlds, const HumanoidMap& map) {
    const auto place = [&](int bone) { return Vec3(worlds[size_t(map.node[size_t(bone)])][3]); };
    const Vec3 up = place(VFIT_BONE_HEAD) - place(VFIT_BONE_HIPS);
    const Vec3 left = place(VFIT_BONE_LEFT_UPPER_LEG) - place(VFIT_BONE_RIGHT_UPPER_LEG);
    if (glm::length(up) < 1e-3f || up.y < 0.7f * glm::length(up))
        fail(VFIT_ERROR_DATA, "the character does not stand upright along +Y, as glTF wants it");
    if (std::hypot(left.x, left.z) < 1e-3f)
        fail(VFIT_ERROR_DATA, "the character's legs start at one place: left and right cannot be told");
    const float quarter = 0.5f * kPi;
    const float turn = quarter * std::round(std::atan2(left.z, left.x) / quarter);
    return glm::mat4_cast(glm::angleAxis(turn, Vec3(0, 1, 0)));
}

/// One row of bones and weights, before it is cut to the eight that count.
class VertexBones {
public:
    void add(int bone, float weight) {
        for (auto& [b, w] : shares_)
            if (b == bone) {
                w += weight;
                return;
            }
        shares_.emplace_back(bone, weight);
    }
    /// False where nobody carries it.
    bool write(SkinBones& bones, SkinWeights& weights) {
        std::stable_sort(shares_.begin(), shares_.end(),
                         [](const auto& a, const auto& b) { return a.second > b.second; });
        if (shares_.size() > size_t(kSkinBones)) shares_.resize(size_t(kSkinBones));
        float sum = 0.0f;
        for (const auto& share : shares_) sum += share.second;
        if (!(sum > kLeastWeight)) return false;
        bones.fill(0);
        weights.fill(0.0f);
        for (size_t k = 0; k < shares_.size(); ++k) {
            bones[k] = uint16_t(shares_[k].first);
            weights[k] = shares_[k].second / sum;
        }
        return true;
    }

private:
    std::vector<std::pair<int, float>> shares_;
};

/// Gathers the meshes of all nodes into one.
class Gatherer {
public:
    Gatherer(const GltfDocument& document, const CharacterRig& rig, const std::vector<Mat4>& worlds,
             const Mat4& from_file, Character& out)
        : document_(document), rig_(rig), worlds_(worlds), from_file_(from_file), out_(out) {}

    void run() {
        for (const int node : document_.nodes_in_order())
            if (document_.model().nodes[size_t(node)].mesh >= 0) add_node(node);
        Mesh& rest = out_.source.rest;
        if (rest.indices.empty()) fail(VFIT_ERROR_DATA, "the file has no triangles that a bone carries");
        if (missing_normals_) {
            std::vector<Vec3> made;
            compute_normals(rest.positions, rest.indices, made);
            for (size_t v = 0; v < made.size(); ++v)
                if (rest.normals[v] == Vec3(0.0f)) rest.normals[v] = made[v];
        }
        if (unweighted_ > 0)
            out_.notes.push_back(text(unweighted_, " vertices have no weights: they follow the hips"));
        if (!any_uv_) rest.uvs.clear();
    }

private:
    void add_node(int node) {
        const tinygltf::Model& model = document_.model();
        const tinygltf::Node& n = model.nodes[size_t(node)];
        if (size_t(n.mesh) >= model.meshes.size())
            fail(VFIT_ERROR_DATA, "node \"", document_.node_name(node), "\" names a mesh that is not there");
        int carrier = -1;
        if (n.skin >= 0) {
            if (size_t(n.skin) >= model.skins.size())
                fail(VFIT_ERROR_DATA, "node \"", document_.node_name(node),
                     "\" names a skin that is not there");
            read_skin(n.skin);
        } else {
            for (int at = node; at >= 0 && carrier < 0; at = document_.parent(at))
                carrier = rig_.of_node[size_t(at)];
            if (carrier < 0) {
                out_.notes.push_back(
                    text("the mesh of node \"", document_.node_name(node), "\" hangs on no bone: left out"));
                return;
            }
        }
        const tinygltf::Mesh& mesh = model.meshes[size_t(n.mesh)];
        for (size_t p = 0; p < mesh.primitives.size(); ++p) {
            const std::string what = text("mesh \"", mesh.name, "\", part ", p);
            const tinygltf::Primitive& primitive = mesh.primitives[p];
            if (!primitive.targets.empty()) morphs_ = true;
            add_primitive(primitive, int(p), mesh.name, what, node, n.skin, carrier);
        }
        if (morphs_ && !morphs_said_) {
            out_.notes.push_back("morph targets are ignored");
            morphs_said_ = true;
        }
    }

    void read_skin(int index) {
        const tinygltf::Skin& skin = document_.model().skins[size_t(index)];
        std::vector<Mat4> binds(skin.joints.size(), Mat4(1.0f));
        if (skin.inverseBindMatrices >= 0) {
            const auto m = document_.numbers(skin.inverseBindMatrices, 16, "inverse bind matrix");
            if (m.size() < 16 * binds.size())
                fail(VFIT_ERROR_DATA, "skin ", skin.name, " has fewer inverse bind matrices than joints");
            for (size_t j = 0; j < binds.size(); ++j) binds[j] = glm::make_mat4(&m[16 * j]);
        }
        joints_.clear();
        for (size_t j = 0; j < binds.size(); ++j)
            joints_.push_back({rig_.of_node[size_t(skin.joints[j])],
                               from_file_ * worlds_[size_t(skin.joints[j])] * binds[j]});
    }

    void add_primitive(const tinygltf::Primitive& p, int number, const std::string& mesh,
                       const std::string& what, int node, int skin, int carrier) {
        const int mode = p.mode < 0 ? TINYGLTF_MODE_TRIANGLES : p.mode;
        if (mode == TINYGLTF_MODE_POINTS || mode == TINYGLTF_MODE_LINE || mode == TINYGLTF_MODE_LINE_LOOP ||
            mode == TINYGLTF_MODE_LINE_STRIP)
            return;
        if (mode != TINYGLTF_MODE_TRIANGLES)
            fail(VFIT_ERROR_UNSUPPORTED, what, ": triangle strips and fans are not supported");
        const auto attribute = [&](const char* name) {
            const auto it = p.attributes.find(name);
            return it == p.attributes.end() ? -1 : it->second;
        };
        const int position = attribute("POSITION");
        if (position < 0) fail(VFIT_ERROR_DATA, what, " has no positions");
        // Parts of one mesh may share their vertices.
        const auto key = std::make_tuple(position, attribute("JOINTS_0"), skin < 0 ? node : -1 - skin);
        const auto [known, is_new] = first_of_.try_emplace(key, uint32_t(out_.source.rest.positions.size()));
        if (is_new) add_vertices(p, what, node, skin, carrier);
        const uint32_t first = known->second;
        const auto count = uint32_t(document_.model().accessors[size_t(position)].count);

        CharacterPart part;
        part.mesh = mesh;
        part.node = node, part.primitive = number;
        part.material_index = p.material;
        if (p.material >= 0 && size_t(p.material) < document_.model().materials.size())
            part.material = document_.model().materials[size_t(p.material)].name;
        auto& indices = out_.source.rest.indices;
        part.first_index = uint32_t(indices.size());
        if (p.indices >= 0) {
            for (const uint32_t i : document_.integers(p.indices, 1, what + ": indices")) {
                if (i >= count) fail(VFIT_ERROR_DATA, what, ": index ", i, " of ", count, " vertices");
                indices.push_back(first + i);
            }
        } else {
            for (uint32_t i = 0; i < count; ++i) indices.push_back(first + i);
        }
        // Nodes may share a mesh: a small file can ask for any number of copies.
        if (indices.size() > kMostIndices)
            fail(VFIT_ERROR_DATA, "the character has more than ", kMostIndices / 3, " triangles");
        part.index_count = uint32_t(indices.size()) - part.first_index;
        if (part.index_count % 3 != 0)
            fail(VFIT_ERROR_DATA, what, ": ", part.index_count, " indices are no whole triangles");
        out_.parts.push_back(part);
    }

    void add_vertices(const tinygltf::Primitive& p, const std::string& what, int node, int skin,
                      int carrier) {
        const auto attribute = [&](const std::string& name) {
            const auto it = p.attributes.find(name);
            return it == p.attributes.end() ? -1 : it->second;
        };
        const auto positions = document_.numbers(attribute("POSITION"), 3, what + ": position");
        const size_t count = positions.size() / 3;
        if (out_.source.rest.positions.size() + count > kMostVertices)
            fail(VFIT_ERROR_DATA, "the character has more than ", kMostVertices, " vertices");
        const auto rows = [&](const char* name, int components) {
            std::vector<float> list;
            if (attribute(name) >= 0)
                list = document_.numbers(attribute(name), components, what + ": " + name);
            if (!list.empty() && list.size() != count * size_t(components))
                fail(VFIT_ERROR_DATA, what, ": ", name, " has another count than POSITION");
            return list;
        };
        const auto normals = rows("NORMAL", 3), uvs = rows("TEXCOORD_0", 2);
        std::vector<std::vector<uint32_t>> bones;
        std::vector<std::vector<float>> weights;
        for (int set = 0; skin >= 0; ++set) {
            const std::string joint_name = text("JOINTS_", set), weight_name = text("WEIGHTS_", set);
            if (attribute(joint_name) < 0 || attribute(weight_name) < 0) break;
            bones.push_back(document_.integers(attribute(joint_name), 4, what + ": " + joint_name));
            weights.push_back(document_.numbers(attribute(weight_name), 4, what + ": " + weight_name));
            if (bones.back().size() != 4 * count || weights.back().size() != 4 * count)
                fail(VFIT_ERROR_DATA, what, ": ", joint_name, " has another count than POSITION");
        }
        const Mat4 fixed = from_file_ * worlds_[size_t(node)];
        any_uv_ = any_uv_ || !uvs.empty();
        missing_normals_ = missing_normals_ || normals.empty();
        Mesh& rest = out_.source.rest;
        for (size_t v = 0; v < count; ++v) {
            VertexBones row;
            Mat4 sum(0.0f);
            float total = 0.0f;
            for (size_t set = 0; set < bones.size(); ++set)
                for (size_t k = 4 * v; k < 4 * v + 4; ++k) {
                    const float w = weights[set][k];
                    if (!(w > 0.0f)) continue;
                    if (bones[set][k] >= joints_.size())
                        fail(VFIT_ERROR_DATA, what, ": vertex ", v, " names joint ", bones[set][k], " of ",
                             joints_.size());
                    const BoundJoint& joint = joints_[bones[set][k]];
                    row.add(joint.bone, w);
                    sum += w * joint.matrix;
                    total += w;
                }
            SkinBones b;
            SkinWeights w;
            if (carrier >= 0) row.add(carrier, 1.0f);
            const bool carried = row.write(b, w);
            if (!carried) {
                ++unweighted_;
                VertexBones hips;
                for (size_t i = 0; i < rig_.bones.size(); ++i)
                    if (rig_.bones[i].bone == VFIT_BONE_HIPS) hips.add(int(i), 1.0f);
                hips.write(b, w);
            }
            // Without weights it stays where it is bound, as its neighbours do.
            const Mat4 m = total > kLeastWeight            ? sum / total
                           : skin >= 0 && !joints_.empty() ? joints_[0].matrix
                                                           : fixed;
            const Vec3 p(m * Vec4(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2], 1.0f));
            Vec3 n(0.0f);
            if (!normals.empty()) {
                n = Mat3(m) * Vec3(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]);
                const float length = glm::length(n);
                n = length > 0.0f ? n / length : Vec3(0, 1, 0);
            }
            rest.positions.push_back(p);
            rest.normals.push_back(n);
            rest.uvs.push_back(uvs.empty() ? Vec2(0.0f) : Vec2(uvs[2 * v], uvs[2 * v + 1]));
            out_.source.skin_bones.push_back(b);
            out_.source.skin_weights.push_back(w);
        }
    }

    struct BoundJoint {
        int bone;
        Mat4 matrix;  // from the mesh to the rest posture
    };
    const GltfDocument& document_;
    const CharacterRig& rig_;
    const std::vector<Mat4>& worlds_;  // of the file's nodes, at rest
    const Mat4 from_file_;
    Character& out_;
    std::vector<BoundJoint> joints_;
    std::map<std::tuple<int, int, int>, uint32_t> first_of_;
    size_t unweighted_ = 0;
    bool any_uv_ = false, missing_normals_ = false, morphs_ = false, morphs_said_ = false;
};

/// What a bone's skin belongs to, by the humanoid bone that it hangs on.
BodyPart part_of(int bone) {
    switch (bone) {
        case VFIT_BONE_NECK:
        case VFIT_BONE_HEAD: return BodyPart::kHead;
        case VFIT_BONE_LEFT_UPPER_ARM: return BodyPart::kLeftUpperArm;
        case VFIT_BONE_LEFT_LOWER_ARM: return BodyPart::kLeftForearm;
        case VFIT_BONE_LEFT_HAND: return BodyPart::kLeftHand;
        case VFIT_BONE_RIGHT_UPPER_ARM: return BodyPart::kRightUpperArm;
        case VFIT_BONE_RIGHT_LOWER_ARM: return BodyPart::kRightForearm;
        case VFIT_BONE_RIGHT_HAND: return BodyPart::kRightHand;
        case VFIT_BONE_LEFT_UPPER_LEG: return BodyPart::kLeftThigh;
        case VFIT_BONE_LEFT_LOWER_LEG: return BodyPart::kLeftShank;
        case VFIT_BONE_LEFT_FOOT:
        case VFIT_BONE_LEFT_TOES: return BodyPart::kLeftFoot;
        case VFIT_BONE_RIGHT_UPPER_LEG: return BodyPart::kRightThigh;
        case VFIT_BONE_RIGHT_LOWER_LEG: return BodyPart::kRightShank;
        case VFIT_BONE_RIGHT_FOOT:
        case VFIT_BONE_RIGHT_TOES: return BodyPart::kRightFoot;
        default: return BodyPart::kTorso;
    }
}

std::vector<BodyPart> parts_of_bones(const std::vector<AvatarBone>& bones) {
    std::vector<BodyPart> parts;
    for (const AvatarBone& bone : bones) {
        if (bone.bone >= 0)
            parts.push_back(part_of(bone.bone));
        else
            parts.push_back(bone.parent < 0 ? BodyPart::kTorso : parts[size_t(bone.parent)]);
    }
    return parts;
}

void make_topology(AvatarSource& source) {
    auto topology = std::make_shared<BodyTopology>();
    topology->vertex_count = topology->render_vertex_count = uint32_t(source.rest.positions.size());
    topology->indices = topology->render_indices = source.rest.indices;
    topology->uvs = source.rest.uvs;
    topology->skin_bones = source.skin_bones;
    topology->skin_weights = source.skin_weights;
    const std::vector<BodyPart> parts = parts_of_bones(source.bones);
    for (size_t v = 0; v < source.skin_bones.size(); ++v) {
        std::array<float, kBodyPartCount> share{};
        for (size_t k = 0; k < size_t(kSkinBones); ++k)
            share[size_t(parts[source.skin_bones[v][k]])] += source.skin_weights[v][k];
        topology->parts.push_back(BodyPart(std::max_element(share.begin(), share.end()) - share.begin()));
    }
    source.topology = std::move(topology);
}

/// A file's own twist segments beside the way to the hand: their share goes to the limb, which is split anew.
void merge_twist_bones(AvatarSource& source) {
    std::vector<uint16_t> merged(source.bones.size());
    std::vector<bool> has_humanoid(source.bones.size(), false);
    for (size_t i = source.bones.size(); i-- > 0;) {
        if (source.bones[i].bone >= 0) has_humanoid[i] = true;
        if (has_humanoid[i] && source.bones[i].parent >= 0)
            has_humanoid[size_t(source.bones[i].parent)] = true;
    }
    for (size_t i = 0; i < source.bones.size(); ++i) {
        const AvatarBone& bone = source.bones[i];
        merged[i] = uint16_t(i);
        if (bone.parent < 0 || has_humanoid[i] || !bone.is_twist) continue;
        const uint16_t parent = merged[size_t(bone.parent)];
        if (t_pose_direction(std::max(0, source.bones[parent].bone)) != Vec3(0.0f)) merged[i] = parent;
    }
    for (size_t v = 0; v < source.skin_bones.size(); ++v) {
        VertexBones row;
        for (size_t k = 0; k < size_t(kSkinBones); ++k)
            if (source.skin_weights[v][k] > 0.0f)
                row.add(merged[source.skin_bones[v][k]], source.skin_weights[v][k]);
        row.write(source.skin_bones[v], source.skin_weights[v]);
    }
}

/// Where bones end: at the next humanoid bone, the head at the crown, a hand at the root of its middle
/// finger, a foot at its foremost point.
void find_tails(AvatarSource& source) {
    const auto rig_of = [&](int bone) {
        for (size_t i = 0; i < source.bones.size(); ++i)
            if (source.bones[i].bone == bone) return int(i);
        return -1;
    };
    for (int b = kBoneCount - 1; b > 0; --b) {
        const int own = rig_of(b);
        int parent = bone_parent(b);
        while (parent > 0 && rig_of(parent) < 0) parent = bone_parent(parent);
        // The trunk ends at its middle, not at a shoulder.
        const bool is_side_of_trunk = b >= VFIT_BONE_LEFT_SHOULDER && part_of(parent) == BodyPart::kTorso &&
                                      parent != VFIT_BONE_LEFT_SHOULDER && parent != VFIT_BONE_RIGHT_SHOULDER;
        if (own >= 0 && !is_side_of_trunk)
            source.bones[size_t(rig_of(parent))].rest_tail = source.bones[size_t(own)].rest_head;
    }
    for (size_t i = 0; i < source.bones.size(); ++i) {
        AvatarBone& bone = source.bones[i];
        const bool is_hand = bone.bone == VFIT_BONE_LEFT_HAND || bone.bone == VFIT_BONE_RIGHT_HAND;
        const bool is_foot = bone.bone >= 0 && (part_of(bone.bone) == BodyPart::kLeftFoot ||
                                                part_of(bone.bone) == BodyPart::kRightFoot);
        if (bone.bone == VFIT_BONE_HEAD || (is_foot && bone.rest_tail == bone.rest_head)) {
            const Vec3 way = is_foot ? Vec3(0, 0, 1) : Vec3(0, 1, 0);
            float farthest = 0.0f;
            for (size_t v = 0; v < source.skin_bones.size(); ++v)
                if (source.skin_bones[v][0] == i)
                    farthest = std::max(farthest, glm::dot(source.rest.positions[v] - bone.rest_head, way));
            bone.rest_tail = bone.rest_head + farthest * way;
        } else if (is_hand) {
            Vec3 sum(0.0f), middle(0.0f);
            int count = 0;
            bool has_middle = false;
            // Bones that start where the hand does are parts of it.
            std::vector<uint8_t> is_palm(source.bones.size(), 0);
            is_palm[i] = 1;
            for (size_t c = i + 1; c < source.bones.size(); ++c) {
                const AvatarBone& child = source.bones[c];
                if (child.parent < 0 || !is_palm[size_t(child.parent)]) continue;
                if (glm::distance(child.rest_head, bone.rest_head) < kSamePlace_m) {
                    is_palm[c] = 1;
                    continue;
                }
                sum += child.rest_head;
                ++count;
                if (!speaks_of(child.name, {"middle", "finger3"})) continue;
                middle = child.rest_head;
                has_middle = true;
            }
            const Vec3 fore =
                bone.parent >= 0 ? bone.rest_head - source.bones[size_t(bone.parent)].rest_head : Vec3(0.0f);
            constexpr float kHandOfForearm = 0.35f;  // from the wrist to the knuckles
            bone.rest_tail = has_middle  ? middle
                             : count > 0 ? sum / float(count)
                                         : bone.rest_head + kHandOfForearm * fore;
        }
    }
}

std::string vrm_name(const GltfDocument& document) {
    for (const auto& [extension, key] : {std::pair{"VRMC_vrm", "name"}, std::pair{"VRM", "title"}}) {
        const auto vrm = document.model().extensions.find(extension);
        if (vrm == document.model().extensions.end() || !vrm->second.Has("meta")) continue;
        const tinygltf::Value& meta = vrm->second.Get("meta");
        if (meta.IsObject() && meta.Has(key) && meta.Get(key).IsString())
            return meta.Get(key).Get<std::string>();
    }
    return {};
}

}  // namespace

Character load_character(const GltfDocument& document, const std::string& own_map, float scale) {
    if (document.model().skins.empty()) fail(VFIT_ERROR_DATA, "the file has no skinned mesh");
    const HumanoidMap map = find_humanoid(document, own_map);
    Character out;
    out.kind = map.kind;
    const std::vector<Mat4> worlds = rest_posture(document, map);
    out.name = vrm_name(document);
    out.from_file = glm::scale(Mat4(1.0f), Vec3(scale)) * upright_from_file(worlds, map);
    CharacterRig rig = make_character_rig(document, map, worlds, out.from_file);
    Gatherer(document, rig, worlds, out.from_file, out).run();
    if (const int bone = sheared_bone(document, rig); bone >= 0)
        out.notes.push_back(
            text("the bone \"", rig.bones[size_t(bone)].name,
                 "\" hangs below a scale that differs along its axes: the skin keeps its "
                 "form at rest here, but an engine that turns the file's own nodes shears it"));
    if (!document.model().animations.empty()) out.notes.push_back("animations are ignored");

    Mesh& rest = out.source.rest;
    Vec3 low = rest.positions.front(), high = low;
    for (const Vec3& p : rest.positions) low = glm::min(low, p), high = glm::max(high, p);
    const float stature = high.y - low.y;
    if (!(stature >= kLeastStature_m && stature <= kMostStature_m))
        fail(VFIT_ERROR_DATA, "the character is ", stature, " m tall; glTF counts in metres, and ",
             kLeastStature_m, " to ", kMostStature_m, " m can be posed; give its scale");
    Vec3 shift(0.0f, -low.y, 0.0f);
    for (const int leg : {VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG}) {
        const Vec3 at = rig.bones[size_t(rig.of_node[size_t(map.node[size_t(leg)])])].rest_head;
        shift -= 0.5f * Vec3(at.x, 0.0f, at.z);
    }
    for (Vec3& p : rest.positions) p += shift;
    for (AvatarBone& bone : rig.bones) bone.rest_head += shift, bone.rest_tail += shift;
    out.from_file = glm::translate(Mat4(1.0f), shift) * out.from_file;
    out.node_worlds = worlds;
    out.source.bones = std::move(rig.bones);
    out.source.is_body = false;
    merge_twist_bones(out.source);
    find_tails(out.source);
    make_topology(out.source);
    return out;
}

}  // namespace vfit
