// What is laid over the picture: guidance, panels, the camera's image. Dear ImGui draws it.
#pragma once

#include <cstdint>

#include "gui.h"
#include "options.h"
#include "room.h"
#include "times.h"

namespace room {

struct OverlayState {
    bool mirror = true, fit_map = false, help = false;
    const char* renderer = "";
    bool software = false;
};

/// What the user has clicked in one picture. Garment and size are relative to the chosen ones.
struct Wish {
    Key key = Key::none;
    int garment = 0, size = 0;
};

class Overlay {
public:
    Overlay();

    /// Over the bound framebuffer, which has that size in pixels. seconds: since the last picture.
    void draw(const Room& room, const Times& times, const OverlayState& state, const Pointer& pointer,
              int width, int height, float seconds);
    /// What was clicked since the last call.
    Wish take_wish();

private:
    void take_camera_image(const CameraPicture& camera);
    void camera(const Room& room, bool mirror);
    void banner(const Room& room);
    void introduction();
    void fitting(const Room& room, const OverlayState& state);
    void measured(const Room& room, const Times& times, const OverlayState& state);
    void help();
    bool begin_panel(const char* name, ImVec2 place, ImVec2 pivot, float width);

    Gui gui_;
    Wish wish_;
    float width_ = 0.0f, height_ = 0.0f, em_ = 0.0f;
    bool compact_ = false;  // a window that has no space for lists and plots
    GLuint camera_texture_ = 0;
    uint64_t camera_version_ = 0;
    uint32_t camera_width_ = 0, camera_height_ = 0;
};

}  // namespace room
