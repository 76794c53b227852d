#include "avatar/rest_posture.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <optional>

#include "math/finite.h"

namespace vfit {

namespace {

constexpr float kStraighter_rad = 0.35f;  // by how much all segments of the legs together have to be
constexpr float kSmallestScale = 1e-6f;

bool is_usable(const Mat4& m) {
    for (int c = 0; c < 4; ++c)
        if (!finite(Vec3(m[c]))) return false;
    return std::abs(glm::determinant(Mat3(m))) > kSmallestScale * kSmallestScale * kSmallestScale;
}

/// Angles between the legs' segments and straight down; nothing where the character does not stand upright.
std::optional<float> bend_of_legs(const std::vector<Mat4>& worlds, const HumanoidMap& map) {
    const auto place = [&](int bone) { return Vec3(worlds[size_t(map.node[size_t(bone)])][3]); };
    const Vec3 trunk = place(VFIT_BONE_HEAD) - place(VFIT_BONE_HIPS);
    if (!(trunk.y > 0.7f * glm::length(trunk))) return std::nullopt;
    float sum = 0.0f;
    for (const auto& [upper, lower] : {std::pair{VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG},
                                       std::pair{VFIT_BONE_LEFT_LOWER_LEG, VFIT_BONE_LEFT_FOOT},
                                       std::pair{VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG},
                                       std::pair{VFIT_BONE_RIGHT_LOWER_LEG, VFIT_BONE_RIGHT_FOOT}}) {
        const Vec3 way = place(lower) - place(upper);
        const float length = glm::length(way);
        if (!(length > 0.0f)) return std::nullopt;
        sum += std::acos(std::clamp(-way.y / length, -1.0f, 1.0f));
    }
    return sum;
}

/// The rotation of a node that shows the skin.
Mat3 turn_of_mesh(const GltfDocument& document, int skin) {
    for (const int node : document.nodes_in_order()) {
        const tinygltf::Node& n = document.model().nodes[size_t(node)];
        if (n.mesh < 0 || n.skin != skin) continue;
        Mat3 turn(document.node_worlds()[size_t(node)]);
        for (int c = 0; c < 3; ++c) turn[c] /= std::max(glm::length(turn[c]), kSmallestScale);
        return turn;
    }
    return Mat3(1.0f);
}

/// The mesh stands as its own numbers say, or as its node turns them: exporters do either. Nothing where bind
/// matrices miss or cannot be inverted.
std::optional<std::vector<Mat4>> bound_posture(const GltfDocument& document, bool turned) {
    const std::vector<Mat4>& shown = document.node_worlds();
    std::vector<std::optional<Mat4>> bound(shown.size());
    const std::vector<tinygltf::Skin>& skins = document.model().skins;
    for (size_t s = 0; s < skins.size(); ++s) {
        const std::vector<int>& joints = skins[s].joints;
        if (joints.empty()) continue;
        if (skins[s].inverseBindMatrices < 0) return std::nullopt;
        const auto numbers = document.numbers(skins[s].inverseBindMatrices, 16, "inverse bind matrix");
        if (numbers.size() < 16 * joints.size()) return std::nullopt;  // told by the one who reads the skin
        std::vector<Mat4> binds;
        for (size_t j = 0; j < joints.size(); ++j) {
            binds.push_back(glm::make_mat4(&numbers[16 * j]));
            if (!is_usable(binds.back())) return std::nullopt;
        }
        // Where a skin before has placed a joint, this one stands with it.
        // As large as the first joint shows it.
        const float size = std::cbrt(std::abs(glm::determinant(Mat3(shown[size_t(joints[0])] * binds[0]))));
        Mat4 world_from_mesh(size * (turned ? turn_of_mesh(document, int(s)) : Mat3(1.0f)));
        for (size_t j = 0; j < joints.size(); ++j)
            if (const auto& placed = bound[size_t(joints[j])]) {
                world_from_mesh = *placed * binds[j];
                break;
            }
        for (size_t j = 0; j < joints.size(); ++j)
            if (auto& placed = bound[size_t(joints[j])]; !placed)
                placed = world_from_mesh * glm::inverse(binds[j]);
    }
    std::vector<Mat4> worlds = shown;
    for (const int node : document.nodes_in_order()) {
        const auto n = size_t(node);
        const int parent = document.parent(node);
        if (bound[n])
            worlds[n] = *bound[n];
        else if (parent >= 0 && worlds[size_t(parent)] != shown[size_t(parent)] &&
                 is_usable(shown[size_t(parent)]))
            worlds[n] = worlds[size_t(parent)] * (glm::inverse(shown[size_t(parent)]) * shown[n]);
        if (!is_usable(worlds[n])) return std::nullopt;
    }
    return worlds;
}

}  // namespace

std::vector<Mat4> rest_posture(const GltfDocument& document, const HumanoidMap& map) {
    const std::vector<Mat4>& shown = document.node_worlds();
    if (map.kind != CharacterKind::gltf) return shown;
    const std::optional<float> bend_shown = bend_of_legs(shown, map);
    if (!bend_shown) return shown;
    std::vector<Mat4> best = shown;
    float least = *bend_shown - kStraighter_rad;
    for (const bool turned : {true, false}) {
        auto bound = bound_posture(document, turned);
        const auto bend = bound ? bend_of_legs(*bound, map) : std::nullopt;
        if (!bend || *bend >= least) continue;
        least = *bend;
        best = std::move(*bound);
    }
    return best;
}

}  // namespace vfit
