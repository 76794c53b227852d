#include "gui_renderer.h"

#include <cstring>
#include <initializer_list>

namespace room {

namespace {

constexpr const char* kVertex = R"(#version 330 core
layout(location = 0) in vec2 place;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;
uniform vec2 pixels;
out vec2 at;
out vec4 ink;
void main() {
    at = uv;
    ink = color;
    gl_Position = vec4(2.0 * place.x / pixels.x - 1.0, 1.0 - 2.0 * place.y / pixels.y, 0.0, 1.0);
})";

constexpr const char* kFragment = R"(#version 330 core
in vec2 at;
in vec4 ink;
uniform sampler2D image;
out vec4 pixel;
void main() { pixel = ink * texture(image, at); })";

/// Buffers grow in these steps, so that pictures of nearly the same length share one.
size_t rounded(size_t bytes) {
    constexpr size_t kStep = 1u << 16;
    return (bytes + kStep - 1) / kStep * kStep;
}

}  // namespace

GuiRenderer::GuiRenderer() : program_(make_program(kVertex, kFragment)) {
    vertices_.create();
    indices_.create();
    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    attribute(0, 2, sizeof(ImDrawVert), offsetof(ImDrawVert, pos));
    attribute(1, 2, sizeof(ImDrawVert), offsetof(ImDrawVert, uv));
    glEnableVertexAttribArray(2);
    glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(ImDrawVert),
                          reinterpret_cast<const void*>(offsetof(ImDrawVert, col)));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
    glBindVertexArray(0);
    glGenTextures(1, &fonts_);
    glBindTexture(GL_TEXTURE_2D, fonts_);
    for (const GLenum key : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, key, GL_LINEAR);
    constexpr GLint kWhiteWithCoverage[] = {GL_ONE, GL_ONE, GL_ONE, GL_RED};
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, kWhiteWithCoverage);
}

void GuiRenderer::take_fonts() {
    unsigned char* coverage = nullptr;
    int width = 0, height = 0;
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.GetTexDataAsAlpha8(&coverage, &width, &height);
    glBindTexture(GL_TEXTURE_2D, fonts_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, coverage);
    atlas.SetTexID(texture_id(fonts_));
}

/// All lists of the picture, one after the other in the same two buffers.
void GuiRenderer::upload(const ImDrawData& data) {
    const auto fill = [&](StreamBuffer& buffer, size_t bytes, auto&& part) {
        auto* to = static_cast<char*>(buffer.map(rounded(bytes)));
        for (int i = 0; i < data.CmdListsCount; ++i) {
            const auto& values = part(*data.CmdLists[i]);
            std::memcpy(to, values.Data, size_t(values.size_in_bytes()));
            to += values.size_in_bytes();
        }
        buffer.unmap();
    };
    fill(vertices_, size_t(data.TotalVtxCount) * sizeof(ImDrawVert),
         [](const ImDrawList& list) -> const auto& { return list.VtxBuffer; });
    fill(indices_, size_t(data.TotalIdxCount) * sizeof(ImDrawIdx),
         [](const ImDrawList& list) -> const auto& { return list.IdxBuffer; });
}

void GuiRenderer::draw(const ImDrawData& data) {
    if (data.TotalIdxCount == 0) return;
    upload(data);
    glUseProgram(program_);
    glUniform2f(glGetUniformLocation(program_, "pixels"), data.DisplaySize.x, data.DisplaySize.y);
    glBindVertexArray(array_);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_SCISSOR_TEST);
    constexpr GLenum kIndex = sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT;
    size_t first_index = 0;
    GLint first_vertex = 0;
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const ImVec4& clip = command.ClipRect;  // left, top, right, bottom
            if (command.UserCallback || clip.z <= clip.x || clip.w <= clip.y) continue;
            glScissor(int(clip.x), int(data.DisplaySize.y - clip.w), int(clip.z - clip.x),
                      int(clip.w - clip.y));
            glBindTexture(GL_TEXTURE_2D, texture_of(command.GetTexID()));
            glDrawElementsBaseVertex(
                GL_TRIANGLES, GLsizei(command.ElemCount), kIndex,
                reinterpret_cast<const void*>((first_index + command.IdxOffset) * sizeof(ImDrawIdx)),
                first_vertex + GLint(command.VtxOffset));
        }
        first_index += size_t(list.IdxBuffer.Size);
        first_vertex += list.VtxBuffer.Size;
    }
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
}

}  // namespace room
