// The files that a garment's file may name: those of its own folder and the folders in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vfit {

class Beside {
public:
    /// folder: empty for the current one.
    explicit Beside(const std::string& folder);
    /// None at all, of a file in memory.
    Beside() = default;

    enum class Place { inside, outside, missing };
    struct Found {
        Place place;
        std::string path;  // of one that is inside
    };
    /// A regular file, wherever links lead. Nothing is asked about what lies outside.
    Found find(std::string name) const;

private:
    std::filesystem::path folder_;
};

/// A note where a texture is not there: what is drawn with it is up to others. of: " of material ...".
void note_missing_texture(const Beside& beside, const std::string& texture, const std::string& of,
                          std::vector<std::string>& notes);

}  // namespace vfit
