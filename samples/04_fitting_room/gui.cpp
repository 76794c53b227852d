#include "gui.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#ifndef VFIT_ROOM_FONT
#define VFIT_ROOM_FONT ""
#endif

namespace room {

namespace {

constexpr float kEm = 16.0f, kMinEm = 13.0f;  // pixels: of a window that is 720 high or wide, and at least
constexpr float kLarge = 2.0f;                // size of large text in em

/// The font that the build has found, or ImGui's own where that file is not on this machine.
ImFont* add_font(float pixels) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    std::error_code none;
    if (std::filesystem::exists(VFIT_ROOM_FONT, none))
        if (ImFont* font = atlas.AddFontFromFileTTF(VFIT_ROOM_FONT, pixels)) return font;
    ImFontConfig config;
    config.SizePixels = std::max(kMinEm, std::round(0.82f * pixels));  // its letters are wider
    return atlas.AddFontDefault(&config);
}

void set_style(float em) {
    ImGui::StyleColorsLight();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowPadding = {0.8f * em, 0.7f * em};
    style.FramePadding = {0.45f * em, 0.2f * em};
    style.ItemSpacing = {0.45f * em, 0.35f * em};
    style.ItemInnerSpacing = {0.4f * em, 0.3f * em};
    style.CellPadding = {0.2f * em, 0.1f * em};
    style.ScrollbarSize = 0.8f * em;
    style.WindowRounding = style.PopupRounding = style.ChildRounding = 0.5f * em;
    style.FrameRounding = style.GrabRounding = style.ScrollbarRounding = 0.25f * em;
    style.WindowBorderSize = style.PopupBorderSize = 0.0f;
    style.WindowMinSize = {1.0f, 1.0f};
    const auto set = [&](ImGuiCol which, ImU32 color) {
        style.Colors[which] = ImGui::ColorConvertU32ToFloat4(color);
    };
    set(ImGuiCol_Text, kInk);
    set(ImGuiCol_WindowBg, kPaper);
    set(ImGuiCol_PopupBg, IM_COL32(255, 255, 255, 250));
    set(ImGuiCol_ChildBg, IM_COL32(0, 0, 0, 0));
    set(ImGuiCol_FrameBg, IM_COL32(0, 0, 0, 22));
    set(ImGuiCol_FrameBgHovered, IM_COL32(0, 0, 0, 40));
    set(ImGuiCol_FrameBgActive, IM_COL32(0, 0, 0, 60));
    set(ImGuiCol_Button, IM_COL32(0, 0, 0, 22));
    set(ImGuiCol_ButtonHovered, IM_COL32(0, 0, 0, 40));
    set(ImGuiCol_ButtonActive, IM_COL32(0, 0, 0, 60));
    set(ImGuiCol_Header, IM_COL32(176, 52, 60, 46));
    set(ImGuiCol_HeaderHovered, IM_COL32(176, 52, 60, 66));
    set(ImGuiCol_HeaderActive, IM_COL32(176, 52, 60, 90));
    set(ImGuiCol_CheckMark, kAccent);
    set(ImGuiCol_PlotHistogram, kAccent);  // of progress bars
}

void take(const Pointer& pointer) {
    ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM >= 18700
    io.AddMousePosEvent(pointer.x, pointer.y);
    io.AddMouseButtonEvent(0, pointer.down);
    io.AddMouseWheelEvent(0.0f, pointer.wheel);
#else
    io.MousePos = {pointer.x, pointer.y};
    io.MouseDown[0] = pointer.down;
    io.MouseWheel = pointer.wheel;
#endif
}

}  // namespace

Gui::~Gui() {
    if (ImGui::GetCurrentContext()) ImGui::DestroyContext();
}

/// A context for text of that size. A window that changes its size gets another: the room keeps no state in
/// ImGui.
void Gui::open(float em) {
    if (ImGui::GetCurrentContext()) ImGui::DestroyContext();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = io.LogFilename = nullptr;  // no files
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    em_ = em;
    add_font(em);
    large_ = add_font(kLarge * em);
    set_style(em);
    renderer_.take_fonts();
}

void Gui::begin(int width, int height, float seconds, const Pointer& pointer) {
    const float em = std::max(kMinEm, std::round(kEm * float(std::min(width, height)) / 720.0f));
    if (em != em_) open(em);
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {float(width), float(height)};
    io.DeltaTime = std::max(seconds, 1e-4f);  // ImGui wants time to pass
    take(pointer);
    ImGui::NewFrame();
}

void Gui::end() {
    ImGui::Render();
    renderer_.draw(*ImGui::GetDrawData());
}

void Gui::push_large() {
#if IMGUI_VERSION_NUM >= 19200
    ImGui::PushFont(large_, large_->LegacySize);
#else
    ImGui::PushFont(large_);
#endif
}

}  // namespace room
