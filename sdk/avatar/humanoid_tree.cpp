#include "avatar/humanoid_tree.h"

#include <algorithm>

#include "core/error.h"

namespace vfit {

HumanoidTree::HumanoidTree(const GltfDocument& document, std::span<const int> more) {
    const tinygltf::Model& model = document.model();
    std::vector<uint8_t> is_bone(model.nodes.size(), 0);
    const auto add = [&](int node) {
        for (; node >= 0 && !is_bone[size_t(node)]; node = document.parent(node)) is_bone[size_t(node)] = 1;
    };
    for (const tinygltf::Skin& skin : model.skins)
        for (const int node : skin.joints) {
            if (node < 0 || size_t(node) >= is_bone.size())
                fail(VFIT_ERROR_DATA, "skin ", skin.name, " names node ", node, ", which is not there");
            add(node);
        }
    for (const int node : more) add(node);
    parents_.assign(is_bone.size(), -1);
    for (const int node : document.nodes_in_order())
        if (is_bone[size_t(node)]) nodes_.push_back(node), parents_[size_t(node)] = document.parent(node);
    sort();
}

bool HumanoidTree::is_above(int ancestor, int node) const {
    while (node >= 0 && node != ancestor) node = parent(node);
    return node == ancestor;
}

int HumanoidTree::common(int a, int b) const {
    while (a >= 0 && !is_above(a, b)) a = parent(a);
    return a;
}

int HumanoidTree::main_child(int node) const { return main_child(node, {}); }

int HumanoidTree::main_child(int node, std::span<const int> beside) const {
    int best = -1;
    for (const int child : nodes_)
        if (parent(child) == node && (best < 0 || height_[size_t(child)] > height_[size_t(best)]) &&
            std::none_of(beside.begin(), beside.end(), [&](int other) { return is_above(child, other); }))
            best = child;
    return best;
}

size_t HumanoidTree::child_count(int node) const {
    return size_t(std::count_if(nodes_.begin(), nodes_.end(), [&](int n) { return parent(n) == node; }));
}

void HumanoidTree::hang(int node, int parent) {
    parents_[size_t(node)] = parent;
    sort();
}

/// Parents first, and otherwise as they were.
void HumanoidTree::sort() {
    std::vector<int> depth(parents_.size(), -1), way;
    for (const int node : nodes_) {
        for (int at = node; at >= 0 && depth[size_t(at)] < 0; at = parent(at)) way.push_back(at);
        for (; !way.empty(); way.pop_back())
            depth[size_t(way.back())] = parent(way.back()) < 0 ? 0 : depth[size_t(parent(way.back()))] + 1;
    }
    std::stable_sort(nodes_.begin(), nodes_.end(),
                     [&](int a, int b) { return depth[size_t(a)] < depth[size_t(b)]; });
    height_.assign(parents_.size(), 0);
    for (size_t i = nodes_.size(); i-- > 0;)
        if (const int above = parent(nodes_[i]); above >= 0)
            height_[size_t(above)] = std::max(height_[size_t(above)], height_[size_t(nodes_[i])] + 1);
}

std::string HumanoidTree::text(const GltfDocument& document) const {
    constexpr size_t kMaxLines = 300;
    std::string out;
    size_t lines = 0;
    std::vector<std::pair<int, size_t>> left;  // nodes and how deep they are; the last one is next
    for (size_t i = nodes_.size(); i-- > 0;)
        if (parent(nodes_[i]) < 0) left.emplace_back(nodes_[i], 0);
    while (!left.empty() && ++lines <= kMaxLines) {
        const auto [node, depth] = left.back();
        left.pop_back();
        out += std::string(2 * std::min<size_t>(depth, 40) + 2, ' ') + document.node_name(node) + "\n";
        for (size_t i = nodes_.size(); i-- > 0;)
            if (parent(nodes_[i]) == node) left.emplace_back(nodes_[i], depth + 1);
    }
    return lines > kMaxLines ? out + "  ...\n" : out;
}

}  // namespace vfit
