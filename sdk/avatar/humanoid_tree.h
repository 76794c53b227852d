// The skeleton of a character's file as a tree of nodes, in which humanoid bones hang on each other: some
// rigs hang a foot on the ground, as a target of inverse kinematics, and not on the leg.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "avatar/gltf_document.h"

namespace vfit {

class HumanoidTree {
public:
    HumanoidTree() = default;
    /// Of the nodes that skins name, of `more` nodes (-1: none), and of those above them.
    HumanoidTree(const GltfDocument& document, std::span<const int> more);

    /// Parents before children.
    const std::vector<int>& nodes() const { return nodes_; }
    /// -1: a root, or a node that is not of the tree.
    int parent(int node) const { return parents_[size_t(node)]; }
    /// Also of a node and itself.
    bool is_above(int ancestor, int node) const;
    /// The lowest node that is above both; -1: there is none.
    int common(int a, int b) const;
    /// Of a node's children the one with the longest chain of nodes below it; -1: it has none.
    int main_child(int node) const;
    /// The same of those that are above none of these.
    int main_child(int node, std::span<const int> beside) const;
    size_t child_count(int node) const;
    /// From now on the node, and all below it, hangs on `parent`, which is not below it.
    void hang(int node, int parent);

    /// A line a node, indented.
    std::string text(const GltfDocument& document) const;

private:
    void sort();

    std::vector<int> parents_, nodes_;
    std::vector<int> height_;  // of the chain below each node
};

}  // namespace vfit
