#include "view.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace room {

namespace {

// Colours are squared in the shaders and drawn by their roots: nearly sRGB, and cheap on a processor that
// draws.

constexpr const char* kStudioVertex = R"(#version 330 core
layout(location = 0) in vec2 place;
layout(location = 1) in vec3 color;
out vec3 shade;
void main() { shade = color; gl_Position = vec4(place, 0.0, 1.0); })";

// Noise of half a step hides the steps of 8 bits in so soft a gradient.
constexpr const char* kStudioFragment = R"(#version 330 core
in vec3 shade;
out vec4 pixel;
void main() {
    float noise = fract(53.0 * fract(dot(gl_FragCoord.xy, vec2(0.0671, 0.00584))));
    pixel = vec4(shade + (noise - 0.5) / 255.0, 1.0);
})";

constexpr const char* kShadowVertex = R"(#version 330 core
layout(location = 0) in vec2 corner;
uniform mat4 clip_from_world;
uniform vec4 disc;  // centre x, z; radius; darkness
out vec2 place;
void main() {
    place = corner;
    gl_Position = clip_from_world * vec4(disc.x + disc.z * corner.x, 0.0, disc.y + disc.z * corner.y, 1.0);
})";

constexpr const char* kShadowFragment = R"(#version 330 core
in vec2 place;
uniform vec4 disc;
uniform vec3 color;
out vec4 pixel;
void main() {
    float inside = max(0.0, 1.0 - dot(place, place));
    pixel = vec4(color, disc.w * inside * inside);
})";

constexpr const char* kSkinVertex = R"(#version 330 core
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
uniform mat4 clip_from_world;
out vec3 n;
void main() { n = normal; gl_Position = clip_from_world * vec4(place, 1.0); })";

// A large soft light from the camera's upper left, a cool one from the right, the floor's own shine from
// below, and a rim.
constexpr const char* kLight = R"(
vec3 lit(vec3 color, vec3 n) {
    float key = 0.5 + 0.5 * dot(n, vec3(-0.48, 0.62, 0.62));
    float fill = max(0.0, dot(n, vec3(0.80, 0.15, 0.58)));
    float rim = 1.0 - max(0.0, n.z);
    rim *= rim * rim;
    vec3 light = vec3(1.00, 0.97, 0.92) * (key * key * 1.02) + vec3(0.16, 0.19, 0.24) * fill
               + vec3(0.21, 0.205, 0.20) * (0.75 - 0.25 * n.y);
    return sqrt(color * light + vec3(0.10) * (rim * (0.4 + 0.6 * key)));
}
)";

constexpr const char* kSkinFragment = R"(
in vec3 n;
out vec4 pixel;
void main() { pixel = vec4(lit(vec3(0.72, 0.50, 0.40), normalize(n)), 1.0); })";

constexpr const char* kClothVertex = R"(#version 330 core
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in float strain;
layout(location = 3) in vec2 uv;
uniform mat4 clip_from_world;
uniform vec3 color;
uniform float fit_map;
out vec3 n;
out vec3 shade;
out vec2 thread;
void main() {
    // Loose is blue, 0 grey, 4 % yellow, 10 % red.
    vec3 map = strain < 0.0 ? mix(vec3(0.60), vec3(0.10, 0.26, 0.80), min(1.0, -strain / 0.04))
             : strain < 0.04 ? mix(vec3(0.60), vec3(0.95, 0.75, 0.10), strain / 0.04)
             : mix(vec3(0.95, 0.75, 0.10), vec3(0.80, 0.04, 0.03), min(1.0, (strain - 0.04) / 0.06));
    n = normal;
    shade = mix(color, map, fit_map);
    thread = uv;
    gl_Position = clip_from_world * vec4(place, 1.0);
})";

// Small dots in rows, in metres of cloth: folds and stretch can be seen by them.
constexpr const char* kClothFragment = R"(
in vec3 n;
in vec3 shade;
in vec2 thread;
uniform float dots;
out vec4 pixel;
void main() {
    vec3 normal = normalize(gl_FrontFacing ? n : -n);
    vec2 cell = thread / 0.045;
    cell.x += 0.5 * mod(floor(cell.y), 2.0);
    vec2 d = fract(cell) - 0.5;
    float dot_here = dots * clamp((0.030 - dot(d, d)) * 60.0, 0.0, 1.0);
    vec3 color = mix(shade, vec3(0.92, 0.88, 0.80), 0.75 * dot_here);
    pixel = vec4(lit(gl_FrontFacing ? color : 0.45 * color, normal), 1.0);
})";

constexpr const char* kLayerVertex = R"(#version 330 core
layout(location = 0) in vec2 corner;
uniform vec4 from_to;  // in clip space
void main() { gl_Position = vec4(mix(from_to.xy, from_to.zw, 0.5 + 0.5 * corner), 0.0, 1.0); })";

constexpr const char* kLayerFragment = R"(#version 330 core
uniform sampler2D layer;
uniform ivec2 origin;
out vec4 pixel;
void main() { pixel = texelFetch(layer, ivec2(gl_FragCoord.xy) - origin, 0); })";

constexpr std::array<std::array<float, 3>, 6> kFabrics = {{{0.42f, 0.045f, 0.060f},
                                                           {0.030f, 0.16f, 0.22f},
                                                           {0.50f, 0.27f, 0.035f},
                                                           {0.055f, 0.06f, 0.22f},
                                                           {0.06f, 0.17f, 0.09f},
                                                           {0.25f, 0.08f, 0.24f}}};

constexpr float kFieldOfView_rad = 0.46f;  // of the picture's height: a portrait lens
constexpr float kEye_m = 1.15f;            // the camera's height: a standing person's chest
constexpr float kAbove_m = 0.34f,
                kBelow_m = 0.16f;   // room over the crown (for raised arms) and under the soles
constexpr float kAcross_m = 1.3f;   // that a narrow picture shows: arms that are not held out
constexpr float kShadow_m = 0.62f;  // radius of the soft one below the whole person
constexpr float kFollow_s = 0.5f;   // how fast the camera follows

using Matrix = std::array<float, 16>;

Matrix product(const Matrix& a, const Matrix& b) {
    Matrix out{};
    for (size_t c = 0; c < 4; ++c)
        for (size_t r = 0; r < 4; ++r)
            for (size_t k = 0; k < 4; ++k) out[4 * c + r] += a[4 * k + r] * b[4 * c + k];
    return out;
}

GLint uniform(GLuint program, const char* name) { return glGetUniformLocation(program, name); }

std::string with_light(const char* source) { return std::string("#version 330 core\n") + kLight + source; }

}  // namespace

View::View(int width, int height, int samples)
    : samples_(samples),
      studio_program_(make_program(kStudioVertex, kStudioFragment)),
      shadow_program_(make_program(kShadowVertex, kShadowFragment)),
      skin_program_(make_program(kSkinVertex, with_light(kSkinFragment).c_str())),
      cloth_program_(make_program(kClothVertex, with_light(kClothFragment).c_str())),
      layer_program_(make_program(kLayerVertex, kLayerFragment)) {
    GLint most = 0;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    samples_ = std::min(samples_, int(most));
    for (GLuint* framebuffer : {&studio_, &layer_, &flat_}) glGenFramebuffers(1, framebuffer);
    for (GLuint* buffer : {&studio_color_, &layer_color_, &layer_depth_}) glGenRenderbuffers(1, buffer);
    glGenTextures(1, &flat_color_);
    glBindTexture(GL_TEXTURE_2D, flat_color_);
    for (const GLenum key : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, key, GL_NEAREST);

    // A bend of paper: wall, hollow and floor without a line between them, darker towards the corners.
    constexpr int kColumns = 16, kRows = 24;
    std::vector<float> corners;
    for (int y = 0; y <= kRows; ++y)
        for (int x = 0; x <= kColumns; ++x) {
            const float u = 2.0f * float(x) / kColumns - 1.0f, v = 2.0f * float(y) / kRows - 1.0f;
            const float wall = std::clamp((v + 0.55f) / 1.55f, 0.0f, 1.0f);
            const float floor = std::clamp((-0.35f - v) / 0.65f, 0.0f, 1.0f);
            const float light =
                0.925f - 0.17f * wall * wall - 0.07f * floor - 0.05f * u * u - 0.05f * u * u * v * v;
            corners.insert(corners.end(), {u, v, light, light * 0.995f, light * 0.985f});
        }
    std::vector<GLushort> indices;
    for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < kColumns; ++x) {
            const auto at = [&](int i, int j) { return GLushort((y + j) * (kColumns + 1) + x + i); };
            indices.insert(indices.end(), {at(0, 0), at(1, 0), at(0, 1), at(0, 1), at(1, 0), at(1, 1)});
        }
    studio_count_ = GLsizei(indices.size());
    glGenVertexArrays(1, &studio_array_);
    glGenBuffers(1, &studio_buffer_);
    glGenBuffers(1, &studio_indices_);
    glBindVertexArray(studio_array_);
    glBindBuffer(GL_ARRAY_BUFFER, studio_buffer_);
    glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(corners.size() * sizeof(float)), corners.data(), GL_STATIC_DRAW);
    attribute(0, 2, 5 * sizeof(float), 0);
    attribute(1, 3, 5 * sizeof(float), 2 * sizeof(float));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, studio_indices_);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, GLsizeiptr(indices.size() * sizeof(GLushort)), indices.data(),
                 GL_STATIC_DRAW);

    constexpr float kSquare[] = {-1, -1, 1, -1, -1, 1, 1, 1};
    glGenVertexArrays(1, &square_array_);
    glGenBuffers(1, &square_buffer_);
    glBindVertexArray(square_array_);
    glBindBuffer(GL_ARRAY_BUFFER, square_buffer_);
    glBufferData(GL_ARRAY_BUFFER, sizeof kSquare, kSquare, GL_STATIC_DRAW);
    attribute(0, 2, 2 * sizeof(float), 0);

    body_.create();
    cloth_.create();
    for (GLuint* buffer : {&body_indices_, &cloth_indices_, &cloth_uvs_}) glGenBuffers(1, buffer);
    glGenVertexArrays(1, &body_array_);
    glBindVertexArray(body_array_);
    glBindBuffer(GL_ARRAY_BUFFER, body_.name());
    attribute(0, 3, sizeof(BodyVertex), offsetof(BodyVertex, position));
    attribute(1, 3, sizeof(BodyVertex), offsetof(BodyVertex, normal));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, body_indices_);
    glGenVertexArrays(1, &cloth_array_);
    glBindVertexArray(cloth_array_);
    glBindBuffer(GL_ARRAY_BUFFER, cloth_.name());
    attribute(0, 3, sizeof(ClothVertex), offsetof(ClothVertex, position));
    attribute(1, 3, sizeof(ClothVertex), offsetof(ClothVertex, normal));
    attribute(2, 1, sizeof(ClothVertex), offsetof(ClothVertex, strain));
    glBindBuffer(GL_ARRAY_BUFFER, cloth_uvs_);
    attribute(3, 2, 2 * sizeof(float), 0);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, cloth_indices_);
    glBindVertexArray(0);
    resize(width, height);
}

void View::resize(int width, int height) {
    if (width == width_ && height == height_) return;
    width_ = width, height_ = height;
    glBindRenderbuffer(GL_RENDERBUFFER, studio_color_);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, studio_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, studio_color_);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Failure("OpenGL cannot draw a picture of that size");
    glViewport(0, 0, width, height);
    glUseProgram(studio_program_);
    glBindVertexArray(studio_array_);
    glDrawElements(GL_TRIANGLES, studio_count_, GL_UNSIGNED_SHORT, nullptr);
    layer_width_ = layer_height_ = 0;
}

/// As large as the person has ever been, and in coarse steps.
void View::grow_layer(int width, int height) {
    if (width <= layer_width_ && height <= layer_height_) return;
    constexpr int kStep = 64;
    const auto stepped = [](int least, int now, int most) {
        return std::min(std::max(now, (least + kStep - 1) / kStep * kStep), most);
    };
    layer_width_ = stepped(width, layer_width_, width_);
    layer_height_ = stepped(height, layer_height_, height_);
    glBindFramebuffer(GL_FRAMEBUFFER, layer_);
    glBindRenderbuffer(GL_RENDERBUFFER, layer_color_);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples_, GL_RGBA8, layer_width_, layer_height_);
    glBindRenderbuffer(GL_RENDERBUFFER, layer_depth_);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples_, GL_DEPTH_COMPONENT24, layer_width_,
                                     layer_height_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, layer_color_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, layer_depth_);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Failure("OpenGL cannot draw with so many samples a pixel");
    glBindTexture(GL_TEXTURE_2D, flat_color_);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, layer_width_, layer_height_, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                 nullptr);
    glBindFramebuffer(GL_FRAMEBUFFER, flat_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, flat_color_, 0);
}

/// Index buffers and texture coordinates, where another garment or size hides another part of the skin.
void View::take_meshes(const Room& room) {
    if (mesh_version_ == room.mesh_version()) return;
    mesh_version_ = room.mesh_version();
    const auto fill = [](GLuint buffer, const auto& values) {
        // Not as GL_ELEMENT_ARRAY_BUFFER: that binding belongs to whichever vertex array is bound.
        glBindBuffer(GL_ARRAY_BUFFER, buffer);
        glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(values.size() * sizeof values[0]), values.data(),
                     GL_STATIC_DRAW);
    };
    fill(body_indices_, room.body_indices());
    fill(cloth_indices_, room.cloth_indices());
    fill(cloth_uvs_, room.cloth_uvs());
    body_count_ = GLsizei(room.body_indices().size());
    cloth_count_ = GLsizei(room.cloth_indices().size());
}

BodyVertex* View::map_body(const Room& room) {
    return static_cast<BodyVertex*>(body_.map(room.body_vertices() * sizeof(BodyVertex)));
}
ClothVertex* View::map_cloth(const Room& room) {
    return static_cast<ClothVertex*>(cloth_.map(room.cloth_vertices() * sizeof(ClothVertex)));
}

/// The whole person is in the picture; the camera follows softly as they walk about.
void View::aim(const Room& room, float seconds) {
    const Room::Place& p = room.joints().pelvis;
    const float share = aimed_ ? 1.0f - std::exp(-seconds / kFollow_s) : 1.0f;
    aimed_ = true;
    aim_[0] += share * (p.x - aim_[0]);
    aim_[2] += share * (p.z - aim_[2]);
    stature_m_ += share * (room.person().stature_m - stature_m_);
    const float height = stature_m_ + kAbove_m + kBelow_m;
    aim_[1] = 0.5f * height - kBelow_m;
    const float aspect = float(width_) / float(height_);
    const float distance = 0.5f * std::max(height, kAcross_m / aspect) / std::tan(0.5f * kFieldOfView_rad);

    const float eye[3] = {aim_[0], kEye_m, aim_[2] + distance};
    // The lens is shifted and not tilted, as of a studio camera: upright lines stay upright.
    const float near = 0.2f, far = 20.0f, f = 1.0f / std::tan(0.5f * kFieldOfView_rad);
    const float shift = f * (aim_[1] - kEye_m) / distance;
    const Matrix projection = {f / aspect,
                               0,
                               0,
                               0,
                               0,
                               f,
                               0,
                               0,
                               0,
                               shift,
                               (far + near) / (near - far),
                               -1,
                               0,
                               0,
                               2 * far * near / (near - far),
                               0};
    const Matrix view = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -eye[0], -eye[1], -eye[2], 1};
    clip_from_world_ = product(projection, view);
}

/// Where in the picture the person and the garment are.
View::Rectangle View::around(const Room& room) const {
    constexpr float kAroundJoints_m = 0.26f;  // crown, fingers, toes
    const Room::Joints& j = room.joints();
    const Room::Place &a = room.cloth_low(), &b = room.cloth_high();
    const float low[3] = {std::min(j.low.x - kAroundJoints_m, a.x), std::min(j.low.y - kAroundJoints_m, a.y),
                          std::min(j.low.z - kAroundJoints_m, a.z)};
    const float high[3] = {std::max(j.high.x + kAroundJoints_m, b.x),
                           std::max(j.high.y + kAroundJoints_m, b.y),
                           std::max(j.high.z + kAroundJoints_m, b.z)};
    float left = 1.0f, right = -1.0f, bottom = 1.0f, top = -1.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const float p[3] = {corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
                            corner & 4 ? high[2] : low[2]};
        float clip[4];
        for (size_t r = 0; r < 4; ++r)
            clip[r] = clip_from_world_[r] * p[0] + clip_from_world_[4 + r] * p[1] +
                      clip_from_world_[8 + r] * p[2] + clip_from_world_[12 + r];
        if (clip[3] < 0.1f) return {0, 0, width_, height_};  // beside the camera
        left = std::min(left, clip[0] / clip[3]), right = std::max(right, clip[0] / clip[3]);
        bottom = std::min(bottom, clip[1] / clip[3]), top = std::max(top, clip[1] / clip[3]);
    }
    const auto pixel = [](float place, int size) {
        return std::clamp(int(std::floor((0.5f + 0.5f * place) * float(size))), 0, size);
    };
    const int x = pixel(left, width_), y = pixel(bottom, height_);
    return {x, y, std::min(width_, pixel(right, width_) + 1) - x,
            std::min(height_, pixel(top, height_) + 1) - y};
}

void View::draw_studio(GLuint framebuffer) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, studio_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

void View::draw_shadows(const Room& room) {
    const Room::Joints& j = room.joints();
    const auto lower = [](const Room::Place& foot) {
        return std::max(0.0f, 1.0f - 2.5f * std::max(0.0f, foot.y - 0.08f));
    };  // a lifted foot's fades
    const float discs[3][4] = {{j.pelvis.x, j.pelvis.z, kShadow_m, 0.30f},
                               {j.left_foot.x, j.left_foot.z + 0.05f, 0.21f, 0.50f * lower(j.left_foot)},
                               {j.right_foot.x, j.right_foot.z + 0.05f, 0.21f, 0.50f * lower(j.right_foot)}};
    glUseProgram(shadow_program_);
    glUniformMatrix4fv(uniform(shadow_program_, "clip_from_world"), 1, GL_FALSE, clip_from_world_.data());
    glUniform3f(uniform(shadow_program_, "color"), 0.16f, 0.15f, 0.17f);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glBindVertexArray(square_array_);
    for (const auto& disc : discs) {
        glUniform4fv(uniform(shadow_program_, "disc"), 1, disc);
        glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    }
    glDisable(GL_BLEND);
}

void View::draw_person(const Room& room, const Look& look) {
    glEnable(GL_DEPTH_TEST);
    glFrontFace(look.mirror ? GL_CW : GL_CCW);
    glEnable(GL_CULL_FACE);
    glUseProgram(skin_program_);
    glUniformMatrix4fv(uniform(skin_program_, "clip_from_world"), 1, GL_FALSE, clip_from_world_.data());
    glBindVertexArray(body_array_);
    glDrawElements(GL_TRIANGLES, body_count_, GL_UNSIGNED_INT, nullptr);
    glDisable(GL_CULL_FACE);  // a skirt is seen from both sides

    const auto& color = kFabrics[room.garment_index() % kFabrics.size()];
    glUseProgram(cloth_program_);
    glUniformMatrix4fv(uniform(cloth_program_, "clip_from_world"), 1, GL_FALSE, clip_from_world_.data());
    glUniform3fv(uniform(cloth_program_, "color"), 1, color.data());
    glUniform1f(uniform(cloth_program_, "fit_map"), look.fit_map ? 1.0f : 0.0f);
    glUniform1f(uniform(cloth_program_, "dots"), look.fit_map ? 0.0f : 1.0f);
    glBindVertexArray(cloth_array_);
    glDrawElements(GL_TRIANGLES, cloth_count_, GL_UNSIGNED_INT, nullptr);
    glFrontFace(GL_CCW);
}

void View::draw(const Room& room, const Look& look, GLuint framebuffer) {
    draw_studio(framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, width_, height_);
    aimed_ = aimed_ && room.dressed();
    if (!room.dressed()) return;
    take_meshes(room);
    aim(room, look.seconds);
    if (look.mirror)
        for (size_t c = 0; c < 4; ++c) clip_from_world_[4 * c] = -clip_from_world_[4 * c];
    draw_shadows(room);

    // Several samples a pixel are dear where a processor draws: the person alone is worth them, and gets a
    // layer of that size.
    const Rectangle r = around(room);
    if (r.width <= 0 || r.height <= 0) return;
    grow_layer(r.width, r.height);
    glBindFramebuffer(GL_FRAMEBUFFER, layer_);
    glViewport(-r.x, -r.y, width_, height_);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw_person(room, look);
    glDisable(GL_DEPTH_TEST);
    glBindFramebuffer(GL_READ_FRAMEBUFFER, layer_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, flat_);
    glBlitFramebuffer(0, 0, r.width, r.height, 0, 0, r.width, r.height, GL_COLOR_BUFFER_BIT, GL_NEAREST);

    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, width_, height_);
    const auto clip = [](int pixel, int size) { return 2.0f * float(pixel) / float(size) - 1.0f; };
    glUseProgram(layer_program_);
    glUniform4f(uniform(layer_program_, "from_to"), clip(r.x, width_), clip(r.y, height_),
                clip(r.x + r.width, width_), clip(r.y + r.height, height_));
    glUniform2i(uniform(layer_program_, "origin"), r.x, r.y);
    glBindTexture(GL_TEXTURE_2D, flat_color_);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);  // samples beside the person are black and clear
    glBindVertexArray(square_array_);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glDisable(GL_BLEND);
}

}  // namespace room
