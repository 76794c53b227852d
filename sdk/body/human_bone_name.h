// The names of Unity's HumanBodyBones: VRM's with a capital, "LeftUpperArm". Programs that read VMC or BVH
// know them.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

#include "body/skeleton.h"

namespace vfit {

struct HumanBoneName {
    std::array<char, 24> letters{};
    size_t length = 0;
    std::string_view view() const { return {letters.data(), length}; }
};

inline HumanBoneName human_bone_name(int bone) {
    const std::string_view vrm = bone_name(bone);
    HumanBoneName name;
    name.length = std::min(vrm.size(), name.letters.size());
    std::copy_n(vrm.begin(), name.length, name.letters.begin());
    name.letters[0] = static_cast<char>(name.letters[0] - 'a' + 'A');
    return name;
}

}  // namespace vfit
