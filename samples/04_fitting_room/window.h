// Where pictures go: a window or memory. A window has keys and a pointer.
#pragma once

#include <epoxy/gl.h>

#include <cfloat>
#include <memory>
#include <string>
#include <vector>

#include "options.h"

namespace room {

/// The mouse, in pixels of the picture from its upper left corner.
struct Pointer {
    float x = -FLT_MAX, y = -FLT_MAX;  // ImGui's place for no mouse
    bool down = false;                 // the left button
    float wheel = 0.0f;                // since the last picture
};

class Window {
public:
    virtual ~Window() = default;
    virtual int width() const = 0;
    virtual int height() const = 0;
    virtual GLuint framebuffer() const = 0;
    /// What was pressed since the last call, oldest first. Key::quit: the window was closed.
    virtual std::vector<Key>& keys() = 0;
    virtual Pointer pointer() = 0;
    /// Shows the picture; returns once it is drawn.
    virtual void present() = 0;
};

/// Throws Failure where there is no display, or no OpenGL 3.3.
std::unique_ptr<Window> open_window(int width, int height, const char* title);
/// The same without a display, by surfaceless EGL.
std::unique_ptr<Window> open_offscreen(int width, int height);

/// GL_RENDERER, and whether it is a processor that draws.
struct Renderer {
    std::string name;
    bool software = false;
};
Renderer renderer();

}  // namespace room
