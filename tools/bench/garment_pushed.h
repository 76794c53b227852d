// Garments that props of other makers push against.
#pragma once

#include <string>

namespace vfit::tools {

struct PushedOptions {
    std::string folder;   // of glTF files, whose meshes are the props
    std::string garment;  // one, or an outfit "A+B"; empty: the sundress
    bool json = false;
};
void judge_pushed(const PushedOptions& options);

}  // namespace vfit::tools
