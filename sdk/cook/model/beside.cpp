#include "cook/model/beside.h"

#include <algorithm>

namespace vfit {

Beside::Beside(const std::string& folder) {
    std::error_code failed;
    folder_ = std::filesystem::canonical(folder.empty() ? "." : folder, failed);
    if (failed) folder_.clear();
}

Beside::Found Beside::find(std::string name) const {
    std::replace(name.begin(), name.end(), '\\', '/');  // of files that were written on Windows
    if (folder_.empty() || name.empty() || name.find('\0') != std::string::npos) return {Place::missing, ""};
    const auto is_below = [&](const std::filesystem::path& path) {
        const auto inside = path.lexically_relative(folder_);
        return !inside.empty() && *inside.begin() != "..";
    };
    const std::filesystem::path path = (folder_ / name).lexically_normal();
    if (!is_below(path)) return {Place::outside, ""};
    std::error_code failed;
    const std::filesystem::path real = std::filesystem::canonical(path, failed);
    if (failed) return {Place::missing, ""};
    if (!is_below(real)) return {Place::outside, ""};
    if (!std::filesystem::is_regular_file(real, failed)) return {Place::missing, ""};
    return {Place::inside, real.string()};
}

void note_missing_texture(const Beside& beside, const std::string& texture, const std::string& of,
                          std::vector<std::string>& notes) {
    const Beside::Place place = beside.find(texture).place;
    if (place == Beside::Place::missing)
        notes.push_back("the texture \"" + texture + "\"" + of + " is not there");
    if (place == Beside::Place::outside)
        notes.push_back("the texture \"" + texture + "\"" + of +
                        " is outside of the garment's folder: it was not looked for");
}

}  // namespace vfit
