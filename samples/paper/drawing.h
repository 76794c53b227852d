// The fitting room's pictures, drawn into memory, where this build can draw.
#pragma once

#include <memory>
#include <string>

#include "room.h"

namespace vfit::tools {

class Drawing {
public:
    virtual ~Drawing() = default;
    virtual room::BodyVertex* map_body(const room::Room& room) = 0;
    virtual void unmap_body() = 0;
    virtual room::ClothVertex* map_cloth(const room::Room& room) = 0;
    virtual void unmap_cloth() = 0;
    /// Returns once the picture is drawn.
    virtual void draw(const room::Room& room, float seconds) = 0;
    virtual const std::string& renderer() const = 0;
    virtual bool is_software() const = 0;
};

/// Null where the room was built without OpenGL; throws where there is none to draw with.
std::unique_ptr<Drawing> open_drawing(int width, int height);

}  // namespace vfit::tools
