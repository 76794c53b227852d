// Pictures of the room as PNG files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace room {

/// What is in the framebuffer that is bound.
class Picture {
public:
    void read(int width, int height);
    void write_png(const std::string& path) const;

private:
    int width_ = 0, height_ = 0;
    std::vector<uint8_t> rgb_;
};

}  // namespace room
