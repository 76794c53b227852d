// What is written over the picture: who, which size, what to do, and where the time goes.
#pragma once

#include <cstdarg>
#include <cstdint>
#include <string>
#include <vector>

#include "font.h"
#include "gl.h"
#include "room.h"
#include "times.h"

namespace room {

struct OverlayState {
    bool mirror = true, fit_map = false, help = false;
    const char* renderer = "";
    bool software = false;
};

class Overlay {
public:
    /// Letters fit a picture of that size.
    Overlay(int picture_width, int picture_height);

    /// Over the framebuffer that is bound.
    void draw(const Room& room, const Times& times, const OverlayState& state, int width, int height);

private:
    struct Color {
        uint8_t r, g, b, a;
    };
    struct Corner {
        float x, y, u, v;
        Color color;
    };
    struct Face {  // letters of one size in the texture
        int width, height, columns;
        float u, v, du, dv;  // of the first cell
    };
    void box(float x, float y, float width, float height, Color color);
    void quad(float x, float y, float width, float height, float u0, float v0, float u1, float v1,
              Color color);
    float text(const Face& face, float x, float y, Color color, const char* format, ...);
    void right_text(const Face& face, float right, float y, Color color, const char* format, ...);
    void letters(const Face& face, float x, float y, Color color, const char* line);
    void person(const Room& room);
    void worn(const Room& room, const OverlayState& state);
    void rate(const Times& times, const OverlayState& state);
    void plot(const Times& times);
    void message(const Room& room);
    void help();
    void flush(GLuint texture, bool picture);

    float scale_;  // pixels of what is one in a picture of 1280 x 720
    float width_ = 0, height_ = 0;
    Face small_{}, large_{};
    float white_u_ = 0, white_v_ = 0;
    GLuint program_, array_ = 0, letters_texture_ = 0, camera_texture_ = 0;
    StreamBuffer buffer_;
    uint64_t camera_version_ = 0;
    uint32_t camera_width_ = 0, camera_height_ = 0;
    std::vector<Corner> corners_;
};

}  // namespace room
