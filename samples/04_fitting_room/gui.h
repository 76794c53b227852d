// Dear ImGui in the room: its context, fonts, style and pointer. gui_renderer.h draws it.
#pragma once

#include <imgui.h>

#include "gui_renderer.h"
#include "window.h"

namespace room {

/// Colors of the overlay, as on the paper of a light studio.
inline constexpr ImU32 kInk = IM_COL32(38, 42, 50, 255), kFaint = IM_COL32(92, 96, 104, 255),
                       kAccent = IM_COL32(176, 52, 60, 255), kPaper = IM_COL32(255, 255, 255, 190),
                       kWhite = IM_COL32(255, 255, 255, 255);

class Gui {
public:
    Gui() = default;
    Gui(const Gui&) = delete;
    ~Gui();

    /// Begins a picture of that size in pixels. Fonts and spacing follow the size; text is never smaller than
    /// 13 pixels.
    void begin(int width, int height, float seconds, const Pointer& pointer);
    /// Draws the windows since begin() over the bound framebuffer.
    void end();

    /// Height of normal text in pixels: the unit of all lengths in the overlay.
    float em() const { return em_; }
    void push_large();
    void pop_large() { ImGui::PopFont(); }

private:
    void open(float em);

    GuiRenderer renderer_;
    float em_ = 0.0f;
    ImFont* large_ = nullptr;
};

}  // namespace room
