#include "overlay.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

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
uniform bool is_picture;
out vec4 pixel;
void main() {
    vec4 here = texture(image, at);
    pixel = is_picture ? vec4(here.rgb, 1.0) * ink : vec4(ink.rgb, ink.a * here.r);
})";

// In pixels of a picture that is 720 high.
constexpr float kMargin = 26.0f;
constexpr float kPlotFrom = 1000.0f;  // a narrower picture has no room for it beside the person
constexpr size_t kMostCorners = 6 * 4096;

}  // namespace

// Ink on paper.
#define INK Color{38, 42, 50, 255}
#define FAINT Color{104, 108, 116, 255}
#define PAPER Color{255, 255, 255, 150}
#define ACCENT Color{176, 52, 60, 255}

Overlay::Overlay(int picture_width, int picture_height)
    : scale_(std::min(float(picture_height) / 720.0f, float(picture_width) / 720.0f)),
      program_(make_program(kVertex, kFragment)) {
    const Letters small(1.25f * scale_), large(2.3f * scale_);
    const int width = std::max(small.columns * small.width, large.columns * large.width);
    const int small_rows = small.rows * small.height, height = small_rows + large.rows * large.height + 2;
    std::vector<uint8_t> pixels(size_t(width) * size_t(height), 0);
    const auto put = [&](const Letters& l, int top) {
        const int pitch = l.columns * l.width;
        for (int y = 0; y < l.rows * l.height; ++y)
            std::copy_n(&l.coverage[size_t(y * pitch)], pitch, &pixels[size_t((top + y) * width)]);
        return Face{l.width,
                    l.height,
                    l.columns,
                    0.0f,
                    float(top) / float(height),
                    float(l.width) / float(width),
                    float(l.height) / float(height)};
    };
    small_ = put(small, 0);
    large_ = put(large, small_rows);
    std::fill(pixels.end() - 2 * width, pixels.end(), uint8_t{255});
    white_u_ = 0.5f, white_v_ = (float(height) - 1.0f) / float(height);

    const auto texture = [](GLuint& name, GLint filter) {
        glGenTextures(1, &name);
        glBindTexture(GL_TEXTURE_2D, name);
        for (const GLenum key : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
            glTexParameteri(GL_TEXTURE_2D, key, filter);
        for (const GLenum key : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
            glTexParameteri(GL_TEXTURE_2D, key, GL_CLAMP_TO_EDGE);
    };
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    texture(letters_texture_, GL_NEAREST);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, pixels.data());
    texture(camera_texture_, GL_LINEAR);

    buffer_.create();
    glGenVertexArrays(1, &array_);
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
    attribute(0, 2, sizeof(Corner), offsetof(Corner, x));
    attribute(1, 2, sizeof(Corner), offsetof(Corner, u));
    glEnableVertexAttribArray(2);
    glVertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(Corner),
                          reinterpret_cast<const void*>(offsetof(Corner, color)));
    glBindVertexArray(0);
    corners_.reserve(kMostCorners);
}

void Overlay::quad(float x, float y, float w, float h, float u0, float v0, float u1, float v1, Color color) {
    if (corners_.size() + 6 > kMostCorners) return;
    const Corner a{x, y, u0, v0, color}, b{x + w, y, u1, v0, color}, c{x, y + h, u0, v1, color},
        d{x + w, y + h, u1, v1, color};
    corners_.insert(corners_.end(), {a, b, c, c, b, d});
}

void Overlay::box(float x, float y, float w, float h, Color color) {
    quad(x, y, w, h, white_u_, white_v_, white_u_, white_v_, color);
}

void Overlay::letters(const Face& face, float x, float y, Color color, const char* line) {
    // On whole pixels, as the texture's letters are.
    x = float(int(x)), y = float(int(y));
    for (; *line; ++line, x += float(face.width)) {
        const int letter = *line - ' ';
        if (letter <= 0 || letter >= 95) continue;
        const float u = face.u + face.du * float(letter % face.columns),
                    v = face.v + face.dv * float(letter / face.columns);
        quad(x, y, float(face.width), float(face.height), u, v, u + face.du, v + face.dv, color);
    }
}

/// Returns where the line ends.
float Overlay::text(const Face& face, float x, float y, Color color, const char* format, ...) {
    char line[256];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    letters(face, x, y, color, line);
    return x + float(face.width) * float(std::strlen(line));
}

void Overlay::right_text(const Face& face, float right, float y, Color color, const char* format, ...) {
    char line[256];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    letters(face, right - float(face.width) * float(std::strlen(line)), y, color, line);
}

void Overlay::person(const Room& room) {
    const float x = kMargin * scale_;
    float y = kMargin * scale_;
    text(small_, x, y, FAINT, "VFIT FITTING ROOM");
    y += 1.6f * float(small_.height);
    if (!room.dressed()) {
        const vfit_scan_state& s = room.scan_state();
        const float share = s.frames_wanted ? float(s.frames_taken) / float(s.frames_wanted) : 0.0f;
        text(large_, x, y, INK, "measuring");
        y += 1.25f * float(large_.height);
        box(x, y, 260.0f * scale_, 6.0f * scale_, {0, 0, 0, 30});
        box(x, y, 260.0f * scale_ * share, 6.0f * scale_, ACCENT);
        return;
    }
    const Room::Person& p = room.person();
    if (p.probability > 0.0f) {
        const float end = text(large_, x, y, INK, "size %s", p.size.c_str());
        text(small_, end + float(small_.width), y + 0.42f * float(large_.height), FAINT, "%.0f %% sure",
             100.0 * double(p.probability));
    } else {
        text(large_, x, y, INK, "%s", p.size.c_str());
    }
    y += 1.2f * float(large_.height);
    text(small_, x, y, FAINT, "%.1f cm tall, +- %.1f", 100.0 * double(p.stature_m),
         100.0 * double(p.stature_sigma_m));
}

void Overlay::worn(const Room& room, const OverlayState& state) {
    if (!room.dressed()) return;
    const float x = kMargin * scale_;
    float y = 178.0f * scale_;
    const float line = 1.35f * float(small_.height), value = x + 10.0f * float(small_.width);
    const auto row = [&](const char* name, Color color, const char* format, auto... arguments) {
        text(small_, x, y, FAINT, "%s", name);
        text(small_, value, y, color, format, arguments...);
        y += line;
    };
    if (room.garment_count() > 1)
        row("garment", INK, "%s  %zu/%zu", room.garment().c_str(), room.garment_index() + 1,
            room.garment_count());
    else
        row("garment", INK, "%s", room.garment().c_str());
    row("worn in", INK, "%s", room.size().c_str());
    row("cloth", room.physics() ? INK : ACCENT, "%s", room.physics() ? "simulated" : "carried only");
    row("view", INK, "%s", state.mirror ? "mirror" : "as filmed");
    if (state.fit_map) {
        row("fit map", ACCENT, "stretch");
        const Color steps[] = {
            {92, 128, 225, 255}, {200, 200, 200, 255}, {248, 222, 90, 255}, {228, 52, 44, 255}};
        const char* names[] = {"loose", "0 %", "4 %", "10 %"};
        for (int i = 0; i < 4; ++i) {
            const float left = value + 62.0f * scale_ * float(i);
            box(left, y + 2.0f * scale_, 58.0f * scale_, 8.0f * scale_, steps[i]);
            text(small_, left, y + 12.0f * scale_, FAINT, "%s", names[i]);
        }
    }
}

void Overlay::rate(const Times& times, const OverlayState& state) {
    const float right = width_ - kMargin * scale_;
    float y = kMargin * scale_;
    right_text(small_, right, y, FAINT, "%.50s%s", state.renderer, state.software ? " (software)" : "");
    y += 1.6f * float(small_.height);
    if (times.frames() > 0) right_text(large_, right, y, INK, "%.0f fps", times.recent_fps());
    y += 1.2f * float(large_.height);
    right_text(small_, right, y, FAINT, "H: keys");
}

/// The last 240 pictures, stage on stage.
void Overlay::plot(const Times& times) {
    constexpr Color kColors[kStages] = {
        {70, 130, 180, 255}, {96, 168, 108, 255}, {200, 96, 84, 255}, {168, 160, 150, 255}};
    constexpr const char* kNames[kStages] = {"sensor+track", "motion+skin", "cloth", "draw"};
    constexpr float kTop_ms = 50.0f;
    const float column = 1.5f * scale_, w = column * float(Times::kPlotted), h = 100.0f * scale_;
    const float x = kMargin * scale_, bottom = height_ - kMargin * scale_, top = bottom - h;
    const float pad = 8.0f * scale_, legend = 2.0f * 1.2f * float(small_.height);
    box(x - pad, top - legend - pad, w + 2 * pad + 58.0f * scale_, h + legend + 2 * pad, PAPER);
    for (const float ms : {100.0f / 6.0f, 100.0f / 3.0f}) {
        const float y = float(int(bottom - h * ms / kTop_ms));
        box(x, y, w, 1.0f, {0, 0, 0, 50});
        text(small_, x + w + 6.0f * scale_, y - 0.55f * float(small_.height), FAINT, "%.0f ms", double(ms));
    }
    for (size_t i = 0; i < Times::kPlotted; ++i) {
        const StageMs stages = times.ago(i);
        float y = bottom;
        for (size_t s = 0; s < kStages; ++s) {
            const float tall = std::min(h * stages[s] / kTop_ms, y - top);
            if (tall <= 0.0f) continue;
            box(x + w - column * float(i + 1), y - tall, column, tall, kColors[s]);
            y -= tall;
        }
    }
    const StageMs last = times.ago(0);
    for (size_t s = 0; s < kStages; ++s) {
        const float left = x + (s % 2 ? 0.55f : 0.0f) * w,
                    y = top - legend + float(s / 2) * 1.2f * float(small_.height);
        box(left, y + 0.3f * float(small_.height), 8.0f * scale_, 8.0f * scale_, kColors[s]);
        text(small_, left + 14.0f * scale_, y, INK, "%s %.1f", kNames[s], double(last[s]));
    }
}

void Overlay::message(const Room& room) {
    const char* what = room.message();
    if (!*what) return;
    const Face& face = std::strlen(what) < 50 ? large_ : small_;
    const float w = float(face.width) * float(std::strlen(what)), pad = 18.0f * scale_;
    const float x = 0.5f * (width_ - w), y = (room.dressed() ? 0.87f : 0.80f) * height_;
    box(x - pad, y - pad, w + 2 * pad, float(face.height) + 2 * pad, {38, 42, 50, 225});
    letters(face, x, y, {255, 255, 255, 255}, what);
}

void Overlay::help() {
    constexpr const char* kLines[] = {
        "left right   garment",        "up down      size",   "P            cloth on, off",
        "C            camera on, off", "M            mirror", "space        put on anew",
        "F            fit map",        "H            this",   "esc          end"};
    const float line = 1.4f * float(small_.height), w = 29.0f * float(small_.width),
                h = line * float(std::size(kLines));
    const float x = width_ - kMargin * scale_ - w, pad = 14.0f * scale_;
    float y = 170.0f * scale_;
    box(x - pad, y - pad, w + 2 * pad, h + 2 * pad, {255, 255, 255, 190});
    for (const char* l : kLines) {
        letters(small_, x, y, INK, l);
        y += line;
    }
}

void Overlay::flush(GLuint texture, bool picture) {
    if (corners_.empty()) return;
    void* memory = buffer_.map(kMostCorners * sizeof(Corner));
    std::memcpy(memory, corners_.data(), corners_.size() * sizeof(Corner));
    buffer_.unmap();
    glUseProgram(program_);
    glUniform2f(glGetUniformLocation(program_, "pixels"), width_, height_);
    glUniform1i(glGetUniformLocation(program_, "is_picture"), picture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glBindVertexArray(array_);
    glDrawArrays(GL_TRIANGLES, 0, GLsizei(corners_.size()));
    glDisable(GL_BLEND);
    corners_.clear();
}

void Overlay::draw(const Room& room, const Times& times, const OverlayState& state, int width, int height) {
    width_ = float(width), height_ = float(height);
    const CameraPicture& camera = room.camera_picture();
    if (camera.version != 0) {
        glBindTexture(GL_TEXTURE_2D, camera_texture_);
        if (camera.version != camera_version_) {
            camera_version_ = camera.version;
            if (camera.width != camera_width_ || camera.height != camera_height_)
                glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, GLsizei(camera.width), GLsizei(camera.height), 0,
                             GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
            camera_width_ = camera.width, camera_height_ = camera.height;
            glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, GLsizei(camera.width), GLsizei(camera.height), GL_RGBA,
                            GL_UNSIGNED_BYTE, camera.rgba.data());
        }
        // Large as long as the person has to see what the camera sees; then in the corner.
        const float h = (room.dressed() ? 150.0f : 420.0f) * scale_,
                    w = h * float(camera.width) / float(camera.height);
        const float x = room.dressed() ? width_ - kMargin * scale_ - w : 0.5f * (width_ - w);
        const float y = room.dressed() ? height_ - kMargin * scale_ - h : 120.0f * scale_;
        const float left = state.mirror ? 1.0f : 0.0f;
        quad(x, y, w, h, left, 0.0f, 1.0f - left, 1.0f, {255, 255, 255, 255});
        flush(camera_texture_, true);
    }
    person(room);
    worn(room, state);
    rate(times, state);
    if (room.dressed() && width_ >= kPlotFrom * scale_) plot(times);
    message(room);
    if (state.help) help();
    flush(letters_texture_, false);
}

}  // namespace room
