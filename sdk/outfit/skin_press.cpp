#include "outfit/skin_press.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr float kClear_m = 0.001f;    // below the cloth
constexpr float kMaxDepth_m = 0.02f;  // what flesh gives way by at most
constexpr float kMaxStep_m = 0.005f;  // of a round: planes of triangles that stand on the skin reach far
constexpr float kMinCosine = 0.35f;   // between normals of skin and cloth, for the way to the plane
constexpr int kMaxRounds = 20;

}  // namespace

SkinPress::SkinPress(std::span<const Vec3> rest, std::span<const uint32_t> indices)
    : indices_(indices.begin(), indices.end()),
      about_(rest.size(), indices_),
      groups_(rest, indices_),
      depth_m_(rest.size(), 0.0f),
      ask_m_(rest.size(), 0.0f),
      is_looked_at_(indices.size() / 3, 0) {}

void SkinPress::find_all(std::span<const PressingCloth> cloths, std::span<const Vec3> positions, Jobs& jobs) {
    groups_.move(positions, jobs);
    crossings_.clear();
    for (uint32_t c = 0; c < cloths.size(); ++c) {
        pairs_.clear();
        cloths[c].groups->find_crossings(groups_, pairs_, jobs);
        for (const auto& [of_cloth, of_skin] : pairs_) crossings_.push_back({c, of_cloth, of_skin});
    }
}

/// Crossings of triangles without a moved vertex are as they were.
void SkinPress::find_of_moved(std::span<const PressingCloth> cloths, std::span<const Vec3> positions) {
    found_.clear();
    for (const uint32_t v : moved_)
        for (const uint32_t triangle : about_.of(v))
            if (!is_looked_at_[triangle]) is_looked_at_[triangle] = 1, found_.push_back(triangle);
    std::erase_if(crossings_, [&](const Crossing& c) { return is_looked_at_[c.of_skin] != 0; });
    for (const uint32_t triangle : found_) {
        is_looked_at_[triangle] = 0;
        const uint32_t* v = &indices_[3 * triangle];
        const Corners corners{{positions[v[0]], positions[v[1]], positions[v[2]]}};
        for (uint32_t c = 0; c < cloths.size(); ++c) {
            patch_.clear();
            cloths[c].groups->find_crossed(corners, near_, patch_);
            for (const uint32_t of_cloth : patch_) crossings_.push_back({c, of_cloth, triangle});
        }
    }
}

/// How far the vertices of the triangle of skin are above the plane of the triangle of cloth.
void SkinPress::ask(const MeshView& cloth, const Crossing& crossing, std::span<const Vec3> normals,
                    std::span<const Vec3> positions) {
    const uint32_t* t = &cloth.indices[3 * crossing.of_cloth];
    const uint32_t* v = &indices_[3 * crossing.of_skin];
    const Vec3& a = cloth.positions[t[0]];
    Vec3 up = glm::cross(cloth.positions[t[1]] - a, cloth.positions[t[2]] - a);
    up /= std::max(glm::length(up), 1e-20f);
    // Folded cloth may face the skin: outside is where the skin has it.
    if (glm::dot(up, normals[v[0]] + normals[v[1]] + normals[v[2]]) < 0.0f) up = -up;
    for (int k = 0; k < 3; ++k) {
        const float above_m = glm::dot(up, positions[v[k]] - a) + kClear_m;
        if (above_m <= 0.0f) continue;
        const float way_m = above_m / std::max(glm::dot(up, normals[v[k]]), kMinCosine);
        if (ask_m_[v[k]] == 0.0f) asked_.push_back(v[k]);
        ask_m_[v[k]] = std::max(ask_m_[v[k]], std::min(way_m, kMaxStep_m));
    }
}

/// False: nothing can move any further.
bool SkinPress::move_asked(std::span<const Vec3> normals, std::span<Vec3> positions) {
    moved_.clear();
    for (const uint32_t v : asked_) {
        const float step_m = std::min(ask_m_[v], kMaxDepth_m - depth_m_[v]);
        ask_m_[v] = 0.0f;
        if (step_m <= 0.0f) continue;
        if (depth_m_[v] == 0.0f) pressed_.push_back(v);
        depth_m_[v] += step_m;
        positions[v] -= step_m * normals[v];
        moved_.push_back(v);
    }
    asked_.clear();
    return !moved_.empty();
}

/// Patches of pressed vertices that still cross go back.
void SkinPress::undo_patches(std::span<const Vec3> normals, std::span<Vec3> positions) {
    patch_.clear(), moved_.clear();
    const auto undo = [&](uint32_t triangle) {
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t v = indices_[3 * triangle + k];
            if (depth_m_[v] == 0.0f) continue;
            positions[v] += depth_m_[v] * normals[v];
            depth_m_[v] = 0.0f;
            patch_.push_back(v), moved_.push_back(v);
        }
    };
    for (const Crossing& c : crossings_) undo(c.of_skin);
    while (!patch_.empty()) {
        const uint32_t v = patch_.back();
        patch_.pop_back();
        for (const uint32_t triangle : about_.of(v)) undo(triangle);
    }
}

SkinPress::Result SkinPress::press(std::span<const PressingCloth> cloths, std::span<const Vec3> normals,
                                   std::span<Vec3> positions, Jobs& jobs) {
    pressed_.clear();
    find_all(cloths, positions, jobs);
    for (int round = 0; round < kMaxRounds && !crossings_.empty(); ++round) {
        for (const Crossing& c : crossings_) ask(cloths[c.cloth].mesh, c, normals, positions);
        if (!move_asked(normals, positions)) break;
        find_of_moved(cloths, positions);
    }
    if (!crossings_.empty()) {
        undo_patches(normals, positions);
        find_of_moved(cloths, positions);
    }
    Result out{0, 0.0f, uint32_t(crossings_.size())};
    for (const uint32_t v : pressed_) {
        out.pressed += depth_m_[v] > 0.0f, out.deepest_m = std::max(out.deepest_m, depth_m_[v]);
        depth_m_[v] = 0.0f;
    }
    return out;
}

}  // namespace vfit
