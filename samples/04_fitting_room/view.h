// The picture: a studio with the dressed avatar in it.
#pragma once

#include <array>
#include <cstdint>

#include "gl.h"
#include "room.h"

namespace room {

struct Look {
    bool mirror = true, fit_map = false;
    float seconds = 0.0f;  // since the last picture, for what moves smoothly
};

class View {
public:
    View(int width, int height, int samples);
    void resize(int width, int height);

    BodyVertex* map_body(const Room& room);
    void unmap_body() { body_.unmap(); }
    ClothVertex* map_cloth(const Room& room);
    void unmap_cloth() { cloth_.unmap(); }

    /// Into that framebuffer of the window.
    void draw(const Room& room, const Look& look, GLuint framebuffer);

    int width() const { return width_; }
    int height() const { return height_; }

private:
    void take_meshes(const Room& room);
    void aim(const Room& room, float seconds);
    struct Rectangle {
        int x = 0, y = 0, width = 0, height = 0;
    };
    Rectangle around(const Room& room) const;
    void grow_layer(int width, int height);
    void draw_studio(GLuint framebuffer);
    void draw_shadows(const Room& room);
    void draw_person(const Room& room, const Look& look);

    int width_ = 0, height_ = 0, samples_;
    GLuint studio_ = 0, studio_color_ = 0;  // drawn once
    // The person alone: with several samples a pixel, and what comes of them.
    GLuint layer_ = 0, layer_color_ = 0, layer_depth_ = 0, flat_ = 0, flat_color_ = 0;
    int layer_width_ = 0, layer_height_ = 0;
    GLuint studio_program_, shadow_program_, skin_program_, cloth_program_, layer_program_;
    GLuint studio_array_ = 0, studio_buffer_ = 0, studio_indices_ = 0, square_array_ = 0, square_buffer_ = 0;
    GLsizei studio_count_ = 0;
    GLuint body_array_ = 0, body_indices_ = 0, cloth_array_ = 0, cloth_indices_ = 0, cloth_uvs_ = 0;
    GLsizei body_count_ = 0, cloth_count_ = 0;
    StreamBuffer body_, cloth_;
    uint64_t mesh_version_ = 0;
    std::array<float, 3> aim_{};  // where the camera looks, following the person
    float stature_m_ = 0.0f;
    bool aimed_ = false;
    std::array<float, 16> clip_from_world_{};
};

}  // namespace room
