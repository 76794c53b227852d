#include "avatar/humanoid_map.h"

#include <cctype>
#include <cstring>

#include "avatar/rig.h"
#include "core/error.h"
#include "core/json.h"

namespace vfit {

namespace {

struct NamedBone {
    const char* name;  // words of the name without side, prefix and number
    int bone;          // of the left where it has a side
};

// Unity, VRoid, Mixamo, Unreal, 3ds Max Biped, Source, Rigify, MakeHuman, Daz, Reallusion, SMPL, CMU.
constexpr NamedBone kNames[] = {
    {"hips", VFIT_BONE_HIPS},
    {"hip", VFIT_BONE_HIPS},
    {"pelvis", VFIT_BONE_HIPS},
    {"spine", VFIT_BONE_SPINE},
    {"chest", VFIT_BONE_SPINE},
    {"upperchest", VFIT_BONE_SPINE},
    {"torso", VFIT_BONE_SPINE},
    {"abdomen", VFIT_BONE_SPINE},
    {"waist", VFIT_BONE_SPINE},
    {"neck", VFIT_BONE_NECK},
    {"head", VFIT_BONE_HEAD},
    {"shoulder", VFIT_BONE_LEFT_SHOULDER},
    {"clavicle", VFIT_BONE_LEFT_SHOULDER},
    {"collar", VFIT_BONE_LEFT_SHOULDER},
    {"collarbone", VFIT_BONE_LEFT_SHOULDER},
    {"upperarm", VFIT_BONE_LEFT_UPPER_ARM},
    {"uparm", VFIT_BONE_LEFT_UPPER_ARM},
    {"shldr", VFIT_BONE_LEFT_UPPER_ARM},
    {"arm", VFIT_BONE_LEFT_UPPER_ARM},
    {"lowerarm", VFIT_BONE_LEFT_LOWER_ARM},
    {"forearm", VFIT_BONE_LEFT_LOWER_ARM},
    {"elbow", VFIT_BONE_LEFT_LOWER_ARM},
    {"hand", VFIT_BONE_LEFT_HAND},
    {"wrist", VFIT_BONE_LEFT_HAND},
    {"palm", VFIT_BONE_LEFT_HAND},
    {"upperleg", VFIT_BONE_LEFT_UPPER_LEG},
    {"upleg", VFIT_BONE_LEFT_UPPER_LEG},
    {"thigh", VFIT_BONE_LEFT_UPPER_LEG},
    {"lowerleg", VFIT_BONE_LEFT_LOWER_LEG},
    {"leg", VFIT_BONE_LEFT_LOWER_LEG},
    {"calf", VFIT_BONE_LEFT_LOWER_LEG},
    {"shin", VFIT_BONE_LEFT_LOWER_LEG},
    {"knee", VFIT_BONE_LEFT_LOWER_LEG},
    {"foot", VFIT_BONE_LEFT_FOOT},
    {"ankle", VFIT_BONE_LEFT_FOOT},
    {"toes", VFIT_BONE_LEFT_TOES},
    {"toe", VFIT_BONE_LEFT_TOES},
    {"toebase", VFIT_BONE_LEFT_TOES},
    {"ball", VFIT_BONE_LEFT_TOES},
};

/// "mixamorig:LeftUpLeg" to {"left", "up", "leg"}, "LShoulder" to {"l", "shoulder"}; numbers are dropped.
std::vector<std::string> words_of(const std::string& name) {
    std::vector<std::string> words;
    std::string word;
    const auto finish = [&] {
        if (!word.empty()) words.push_back(word);
        word.clear();
    };
    const size_t colon = name.rfind(':');
    const std::string own = colon == std::string::npos ? name : name.substr(colon + 1);
    bool was_lower = false;
    for (size_t i = 0; i < own.size(); ++i) {
        const auto u = static_cast<unsigned char>(own[i]);
        const bool begins_word =
            was_lower || (i + 1 < own.size() && std::islower(static_cast<unsigned char>(own[i + 1])));
        if (!std::isalpha(u) || (std::isupper(u) && begins_word)) finish();
        was_lower = std::islower(u) != 0;
        if (std::isalpha(u)) word += char(std::tolower(u));
    }
    finish();
    return words;
}

bool is_prefix(const std::string& word) {
    for (const char* known : {"j", "bip", "mixamorig", "def", "c", "cc", "base", "bone", "jnt", "joint",
                              "rig", "skeleton", "armature", "bind", "valve", "biped", "character", "bend"})
        if (word == known) return true;
    return false;
}

int of_right(int bone) {
    if (bone >= VFIT_BONE_LEFT_UPPER_LEG)
        return bone + (VFIT_BONE_RIGHT_UPPER_LEG - VFIT_BONE_LEFT_UPPER_LEG);
    return bone + (VFIT_BONE_RIGHT_SHOULDER - VFIT_BONE_LEFT_SHOULDER);
}

int bone_from_vrm_name(const std::string& name) {
    for (int b = 0; b < kBoneCount; ++b)
        if (name == bone_name(b)) return b;
    return -1;
}

void set_bone(const GltfDocument& document, HumanoidMap& map, int bone, int node, const char* source) {
    if (node < 0 || size_t(node) >= document.model().nodes.size())
        fail(VFIT_ERROR_DATA, source, " names node ", node, " as ", bone_name(bone), ", which is not there");
    map.node[size_t(bone)] = node;
}

const tinygltf::Value* member(const tinygltf::Value* value, const char* key) {
    return value && value->IsObject() && value->Has(key) ? &value->Get(key) : nullptr;
}

const tinygltf::Value* extension(const GltfDocument& document, const char* name) {
    const auto found = document.model().extensions.find(name);
    return found == document.model().extensions.end() ? nullptr : &found->second;
}

/// humanBones: [{"bone": "hips", "node": 3}, ...].
void read_vrm0(const GltfDocument& document, const tinygltf::Value* bones, HumanoidMap& map) {
    for (size_t i = 0; bones && bones->IsArray() && i < bones->ArrayLen(); ++i) {
        const tinygltf::Value& item = bones->Get(int(i));
        const tinygltf::Value *name = member(&item, "bone"), *node = member(&item, "node");
        if (!name || !name->IsString() || !node || !node->IsNumber())
            fail(VFIT_ERROR_DATA, "VRM: humanBones ", i, " is malformed");
        if (const int bone = bone_from_vrm_name(name->Get<std::string>()); bone >= 0)
            set_bone(document, map, bone, node->GetNumberAsInt(), "VRM");
    }
}

/// humanBones: {"hips": {"node": 3}, ...}.
void read_vrm1(const GltfDocument& document, const tinygltf::Value* bones, HumanoidMap& map) {
    if (!bones || !bones->IsObject()) return;
    for (const std::string& key : bones->Keys()) {
        const int bone = bone_from_vrm_name(key);
        const tinygltf::Value* node = member(&bones->Get(key), "node");
        if (bone < 0) continue;
        if (!node || !node->IsNumber()) fail(VFIT_ERROR_DATA, "VRM: humanBones.", key, " names no node");
        set_bone(document, map, bone, node->GetNumberAsInt(), "VRM");
    }
}

void read_own(const GltfDocument& document, const std::string& json, HumanoidMap& map) {
    const Json parsed = parse_json(json, "bone map");
    if (!parsed.is_object())
        fail(VFIT_ERROR_DATA, "the bone map is no JSON object {\"hips\": \"node name\", ...}");
    for (const auto& [key, value] : parsed.items()) {
        const int bone = bone_from_vrm_name(key);
        if (bone < 0) fail(VFIT_ERROR_ARGUMENT, "the bone map's \"", key, "\" is no VRM bone name");
        if (!value.is_string()) fail(VFIT_ERROR_ARGUMENT, "the bone map's ", key, " is no text");
        int found = -1;
        for (const int node : document.nodes_in_order())
            if (document.node_name(node) == value.get<std::string>()) found = node;
        if (found < 0)
            fail(VFIT_ERROR_DATA, "the bone map's ", key, ": the file has no node \"",
                 value.get<std::string>(), "\"");
        map.node[size_t(bone)] = found;
    }
}

void read_names(const GltfDocument& document, HumanoidMap& map) {
    for (const int node : map.tree.nodes()) {
        const int bone = bone_of_name(document.node_name(node));
        // Of several segments the one next to the root is the bone.
        if (bone >= 0 && bone != VFIT_BONE_SPINE && map.node[size_t(bone)] < 0) map.node[size_t(bone)] = node;
    }
}

/// Rigs whose names are those of joints: the one above an elbow is the upper arm, whatever it is called, and
/// so is that above a knee the thigh. Where both sides hang on it, it is of the trunk.
void find_upper_limbs(HumanoidMap& map) {
    const auto at = [&](int bone) -> int& { return map.node[size_t(bone)]; };
    struct Limb {
        int upper, lower, end, other_lower, shoulder;
    };
    for (const Limb& limb : {Limb{VFIT_BONE_LEFT_UPPER_ARM, VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_LEFT_HAND,
                                  VFIT_BONE_RIGHT_LOWER_ARM, VFIT_BONE_LEFT_SHOULDER},
                             Limb{VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_RIGHT_LOWER_ARM, VFIT_BONE_RIGHT_HAND,
                                  VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_RIGHT_SHOULDER},
                             Limb{VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_LEFT_FOOT,
                                  VFIT_BONE_RIGHT_LOWER_LEG, -1},
                             Limb{VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG, VFIT_BONE_RIGHT_FOOT,
                                  VFIT_BONE_LEFT_LOWER_LEG, -1}}) {
        if (at(limb.upper) >= 0 || at(limb.lower) < 0 || at(limb.end) < 0) continue;
        const int node = map.tree.parent(at(limb.lower)), other = at(limb.other_lower);
        if (node < 0 || (other >= 0 && map.tree.is_above(node, other))) continue;
        at(limb.upper) = node;
        if (limb.shoulder >= 0 && at(limb.shoulder) == node) at(limb.shoulder) = -1;
    }
}

/// Limbs and head whose names say nothing: each bone is the main child of the one above it.
void find_limbs(HumanoidMap& map) {
    const auto at = [&](int bone) -> int& { return map.node[size_t(bone)]; };
    const auto below = [&](int bone, int above) {
        if (at(bone) < 0 && at(above) >= 0) at(bone) = map.tree.main_child(at(above));
    };
    for (const bool right : {false, true}) {
        const auto of_side = [&](int left) { return right ? of_right(left) : left; };
        const int upper_leg = of_side(VFIT_BONE_LEFT_UPPER_LEG),
                  lower_leg = of_side(VFIT_BONE_LEFT_LOWER_LEG), foot = of_side(VFIT_BONE_LEFT_FOOT),
                  upper_arm = of_side(VFIT_BONE_LEFT_UPPER_ARM),
                  lower_arm = of_side(VFIT_BONE_LEFT_LOWER_ARM);
        // All of a leg may be called so.
        if (at(upper_leg) < 0 && at(foot) < 0) std::swap(at(upper_leg), at(lower_leg));
        below(lower_leg, upper_leg), below(foot, lower_leg);
        below(lower_arm, upper_arm), below(of_side(VFIT_BONE_LEFT_HAND), lower_arm);
    }
    below(VFIT_BONE_HEAD, VFIT_BONE_NECK);
}

/// Where neither neck nor head is named: what goes on from where the arms meet, up to the first fork or end.
void find_head(HumanoidMap& map) {
    const auto at = [&](int bone) -> int& { return map.node[size_t(bone)]; };
    const std::array arms = {at(VFIT_BONE_LEFT_UPPER_ARM), at(VFIT_BONE_RIGHT_UPPER_ARM)};
    if (at(VFIT_BONE_NECK) >= 0 || at(VFIT_BONE_HEAD) >= 0 || arms[0] < 0 || arms[1] < 0) return;
    int node = map.tree.common(arms[0], arms[1]);
    if (node >= 0) node = map.tree.main_child(node, arms);
    if (node < 0) return;
    const int first = node;
    while (map.tree.child_count(node) == 1) node = map.tree.main_child(node);
    at(VFIT_BONE_HEAD) = node;
    if (node != first) at(VFIT_BONE_NECK) = first;
}

/// By what lies between: hips are what trunk and legs have in common, the spine is between hips and neck.
void find_trunk(HumanoidMap& map) {
    const auto at = [&](int bone) -> int& { return map.node[size_t(bone)]; };
    const HumanoidTree& tree = map.tree;
    const int top = at(VFIT_BONE_NECK) >= 0 ? at(VFIT_BONE_NECK) : at(VFIT_BONE_HEAD),
              left = at(VFIT_BONE_LEFT_UPPER_LEG), right = at(VFIT_BONE_RIGHT_UPPER_LEG);
    int& hips = at(VFIT_BONE_HIPS);
    const auto hips_are_above = [&](int node) { return hips >= 0 && tree.is_above(hips, node); };
    if (top < 0) return;
    if (left >= 0 && right >= 0 && !(hips_are_above(left) && hips_are_above(right) && hips_are_above(top)))
        hips = tree.common(tree.common(left, right), top);
    if (!hips_are_above(top) || at(VFIT_BONE_SPINE) >= 0) return;
    std::vector<int> chain;
    for (int node = tree.parent(top); node >= 0 && node != hips; node = tree.parent(node))
        chain.insert(chain.begin(), node);
    // The trunk ends where the arms meet; what follows is the neck.
    const int arm = at(VFIT_BONE_LEFT_UPPER_ARM);
    for (; !chain.empty() && arm >= 0 && !tree.is_above(chain.back(), arm); chain.pop_back())
        if (top == at(VFIT_BONE_HEAD)) at(VFIT_BONE_NECK) = chain.back();
    if (chain.empty()) return;
    at(VFIT_BONE_SPINE) = chain.front();
    if (chain.size() > 1) at(VFIT_BONE_CHEST) = chain[chain.size() > 2 ? chain.size() / 2 : 1];
    if (chain.size() > 2) at(VFIT_BONE_UPPER_CHEST) = chain.back();
}

/// Feet and hands that hang on the ground or on the hips go with leg and arm, and a palm of several nodes
/// with the one that is the hand.
void hang_ends(const GltfDocument& document, HumanoidMap& map) {
    for (const int end :
         {VFIT_BONE_LEFT_FOOT, VFIT_BONE_RIGHT_FOOT, VFIT_BONE_LEFT_HAND, VFIT_BONE_RIGHT_HAND}) {
        const int node = map.node[size_t(end)], limb = map.node[size_t(bone_parent(end))];
        if (node < 0 || limb < 0 || map.tree.is_above(node, limb)) continue;
        if (!map.tree.is_above(limb, node)) map.tree.hang(node, limb);
        for (const int other : std::vector<int>(map.tree.nodes()))
            if (other != node && map.tree.parent(other) == map.tree.parent(node) &&
                bone_of_name(document.node_name(other)) == end)
                map.tree.hang(other, node);
    }
}

/// A bone map as far as it is known.
std::string to_fill_in(const GltfDocument& document, const HumanoidMap& map) {
    Json out = Json::object();
    for (int b = 0; b < kBoneCount; ++b)
        if (const int node = map.node[size_t(b)]; node >= 0)
            out[bone_name(b)] = document.node_name(node);
        else if (!is_optional_bone(b))
            out[bone_name(b)] = "";
    return out.dump(2, ' ', false, Json::error_handler_t::replace);
}

void check(const GltfDocument& document, const HumanoidMap& map) {
    std::string missing;
    for (int b = 0; b < kBoneCount; ++b)
        if (map.node[size_t(b)] < 0 && !is_optional_bone(b))
            missing += (missing.empty() ? "" : ", ") + std::string(bone_name(b));
    if (!missing.empty())
        fail(VFIT_ERROR_DATA, "the character has no bone for ", missing, "; name its nodes in a bone map:\n",
             to_fill_in(document, map), "\nIts nodes:\n", map.tree.text(document));
    for (int b = 1; b < kBoneCount; ++b) {
        const int node = map.node[size_t(b)];
        if (node < 0) continue;
        int above = bone_parent(b);
        while (map.node[size_t(above)] < 0) above = bone_parent(above);
        const int parent = map.node[size_t(above)];
        if (node == parent || !map.tree.is_above(parent, node))
            fail(VFIT_ERROR_DATA, "the bone ", bone_name(b), " (node \"", document.node_name(node),
                 "\") does not hang on ", bone_name(above), " (\"", document.node_name(parent), "\")");
    }
}

}  // namespace

int bone_of_name(const std::string& name) {
    std::string joined, reversed;  // "armUpper" is an upper arm
    bool left = false, right = false;
    for (const std::string& word : words_of(name)) {
        if (word == "l" || word == "left")
            left = true;
        else if (word == "r" || word == "right")
            right = true;
        else if (!is_prefix(word))
            joined += word, reversed = word + reversed;
    }
    for (const NamedBone& known : kNames) {
        if (joined != known.name && reversed != known.name) continue;
        if (known.bone < VFIT_BONE_LEFT_SHOULDER) return left || right ? -1 : known.bone;
        if (left == right) return -1;
        return left ? known.bone : of_right(known.bone);
    }
    return -1;
}

HumanoidMap find_humanoid(const GltfDocument& document, const std::string& own_map) {
    HumanoidMap map;
    if (const tinygltf::Value* vrm = extension(document, "VRMC_vrm")) {
        map.kind = CharacterKind::vrm1;
        read_vrm1(document, member(member(vrm, "humanoid"), "humanBones"), map);
    } else if (const tinygltf::Value* vrm = extension(document, "VRM")) {
        map.kind = CharacterKind::vrm0;
        read_vrm0(document, member(member(vrm, "humanoid"), "humanBones"), map);
    }
    if (!own_map.empty()) read_own(document, own_map, map);
    map.tree = HumanoidTree(document, map.node);
    if (map.kind == CharacterKind::gltf) {
        read_names(document, map);
        find_upper_limbs(map);
        find_limbs(map);
        find_head(map);
        find_trunk(map);
        hang_ends(document, map);
    }
    check(document, map);
    return map;
}

}  // namespace vfit
