// Draws what Dear ImGui has laid out, by OpenGL 3.3 through libepoxy. Debian's package has a renderer too,
// but it loads OpenGL by GLX, which the off-screen room does not have.
#pragma once

#include <imgui.h>

#include "gl.h"

namespace room {

class GuiRenderer {
public:
    GuiRenderer();
    /// Uploads the font atlas of the current ImGui context. Call it once a context, after the fonts are
    /// added.
    void take_fonts();
    /// Draws over the bound framebuffer. Leaves scissor test, depth test and blending disabled.
    void draw(const ImDrawData& data);

private:
    void upload(const ImDrawData& data);

    GLuint program_, array_ = 0, fonts_ = 0;
    StreamBuffer vertices_, indices_;
};

/// A texture that ImGui can draw, and back. ImTextureID is a pointer before ImGui 1.91.4, a number since.
inline ImTextureID texture_id(GLuint texture) { return (ImTextureID)(intptr_t)texture; }
inline GLuint texture_of(ImTextureID id) { return GLuint((intptr_t)id); }

}  // namespace room
