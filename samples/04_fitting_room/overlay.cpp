#include "overlay.h"

#include <algorithm>
#include <cfloat>
#include <cstring>
#include <initializer_list>
#include <utility>

#include "panels.h"

namespace room {

namespace {

// In em.
constexpr float kMargin = 1.0f, kCompactMargin = 0.6f;
constexpr float kLeftPanel = 16.4f, kRightPanel = 17.0f, kCompactPanel = 12.5f, kCompactRate = 5.5f,
                kCompactLegend = 10.0f;
constexpr float kFullWidth = 60.0f, kFullHeight = 43.0f;  // windows below it are compact

constexpr ImGuiWindowFlags kStill = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                    ImGuiWindowFlags_NoNav;

}  // namespace

Overlay::Overlay() {
    glGenTextures(1, &camera_texture_);
    glBindTexture(GL_TEXTURE_2D, camera_texture_);
    for (const GLenum key : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
        glTexParameteri(GL_TEXTURE_2D, key, GL_LINEAR);
    for (const GLenum key : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
        glTexParameteri(GL_TEXTURE_2D, key, GL_CLAMP_TO_EDGE);
}

Wish Overlay::take_wish() { return std::exchange(wish_, Wish{}); }

/// place: of the panel's corner that pivot names (0 left or top, 1 right or bottom). The height follows the
/// content.
bool Overlay::begin_panel(const char* name, ImVec2 place, ImVec2 pivot, float width) {
    ImGui::SetNextWindowPos(place, ImGuiCond_Always, pivot);
    ImGui::SetNextWindowSize({width, 0.0f});
    return ImGui::Begin(name, nullptr, kStill);
}

void Overlay::take_camera_image(const CameraPicture& camera) {
    if (camera.version == camera_version_) return;
    camera_version_ = camera.version;
    glBindTexture(GL_TEXTURE_2D, camera_texture_);
    if (camera.width != camera_width_ || camera.height != camera_height_)
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, GLsizei(camera.width), GLsizei(camera.height), 0, GL_RGBA,
                     GL_UNSIGNED_BYTE, nullptr);
    camera_width_ = camera.width, camera_height_ = camera.height;
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, GLsizei(camera.width), GLsizei(camera.height), GL_RGBA,
                    GL_UNSIGNED_BYTE, camera.rgba.data());
}

/// Large until the person is measured, because it shows the person where to stand; then in a corner.
void Overlay::camera(const Room& room, bool mirror) {
    const CameraPicture& image = room.camera_picture();
    if (image.version == 0) return;
    take_camera_image(image);
    const float aspect = float(image.width) / float(image.height);
    const float margin = (compact_ ? kCompactMargin : kMargin) * em_;
    const float height = room.dressed() ? std::min(0.21f * height_, 0.22f * width_ / aspect)
                                        : std::min(0.60f * height_, 0.90f * width_ / aspect);
    const float width = height * aspect;
    const ImVec2 from = room.dressed() ? ImVec2{width_ - margin - width, height_ - margin - height}
                                       : ImVec2{0.5f * (width_ - width), 0.57f * height_ - 0.5f * height};
    const ImVec2 to{from.x + width, from.y + height};
    const float left = mirror ? 1.0f : 0.0f;
    ImGui::GetBackgroundDrawList()->AddImage(texture_id(camera_texture_), from, to, {left, 0.0f},
                                             {1.0f - left, 1.0f});
}

/// What the person should do, or what is wrong with the camera.
void Overlay::banner(const Room& room) {
    const char* what = room.message();
    if (!*what) return;
    const bool is_scan = !room.dressed() && room.camera_on();
    constexpr size_t kShort = 60;  // bytes; anything longer is a report and not guidance
    const bool large = std::strlen(what) < kShort;
    // Between the panels, or, in a compact window, below them.
    const bool low = compact_ && room.dressed();
    const float beside = compact_ ? kCompactMargin : kRightPanel + 2.0f * kMargin;
    const float max_width = width_ - 2.0f * beside * em_ - 2.0f * em_;
    if (large) gui_.push_large();
    const ImVec2 size = ImGui::CalcTextSize(what, nullptr, false, max_width);
    ImGui::SetNextWindowPos({0.5f * width_, low ? height_ - kCompactMargin * em_ : kMargin * em_},
                            ImGuiCond_Always, {0.5f, low ? 1.0f : 0.0f});
    ImGui::SetNextWindowSize({size.x + 2.0f * em_, 0.0f});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32(38, 42, 50, 230));
    ImGui::PushStyleColor(ImGuiCol_Text, kWhite);
    ImGui::PushStyleColor(ImGuiCol_FrameBg, IM_COL32(255, 255, 255, 60));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2{em_, 0.6f * em_});
    if (ImGui::Begin("guidance", nullptr, kStill | ImGuiWindowFlags_NoInputs)) {
        ImGui::PushTextWrapPos(0.0f);
        ImGui::TextUnformatted(what);
        ImGui::PopTextWrapPos();
        const vfit_scan_state& scan = room.scan_state();
        if (is_scan && scan.frames_wanted > 0)
            ImGui::ProgressBar(float(scan.frames_taken) / float(scan.frames_wanted), {-FLT_MIN, 0.5f * em_},
                               "");
    }
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor(3);
    if (large) gui_.pop_large();
}

void Overlay::introduction() {
    if (begin_panel("introduction", {kMargin * em_, kMargin * em_}, {0.0f, 0.0f}, kLeftPanel * em_)) {
        ImGui::TextUnformatted("vfit fitting room");
        ImGui::PushStyleColor(ImGuiCol_Text, kFaint);
        ImGui::TextWrapped(
            "Stand in view of the camera until the scan is complete. Then choose garments here.");
        ImGui::PopStyleColor();
    }
    ImGui::End();
}

/// The person's size, the garment, and what can be chosen.
void Overlay::fitting(const Room& room, const OverlayState& state) {
    const float margin = (compact_ ? kCompactMargin : kMargin) * em_;
    const float width = compact_ ? std::min(kCompactPanel * em_, 0.42f * width_) : kLeftPanel * em_;
    if (begin_panel("fitting", {margin, margin}, {0.0f, 0.0f}, width)) {
        show_person(room, gui_, compact_);
        if (compact_) {
            choose_from_menus(room, wish_);
        } else {
            choose_from_lists(room, wish_);
            show_switches(room, state, wish_);
        }
    }
    ImGui::End();
}

/// Times of the pictures, and the legend of the fit map.
void Overlay::measured(const Room& room, const Times& times, const OverlayState& state) {
    const float margin = (compact_ ? kCompactMargin : kMargin) * em_;
    const float width = (!compact_ ? kRightPanel : state.fit_map ? kCompactLegend : kCompactRate) * em_;
    if (begin_panel("times", {width_ - margin, margin}, {1.0f, 0.0f}, width)) {
        show_rate(times, state, gui_, compact_);
        if (!compact_ && room.dressed()) show_stages(times, em_);
        if (state.fit_map && room.dressed()) show_fit_legend(em_, compact_);
    }
    ImGui::End();
}

void Overlay::help() {
    ImGui::PushStyleColor(ImGuiCol_WindowBg, IM_COL32(255, 255, 255, 245));
    if (begin_panel("keys", {0.5f * width_, 0.5f * height_}, {0.5f, 0.5f}, std::min(22.0f * em_, width_)))
        show_keys();
    ImGui::End();
    ImGui::PopStyleColor();
}

void Overlay::draw(const Room& room, const Times& times, const OverlayState& state, const Pointer& pointer,
                   int width, int height, float seconds) {
    gui_.begin(width, height, seconds, pointer);
    width_ = float(width), height_ = float(height), em_ = gui_.em();
    compact_ = width_ < kFullWidth * em_ || height_ < kFullHeight * em_;
    camera(room, state.mirror);
    if (room.dressed())
        fitting(room, state);
    else if (!compact_)
        introduction();
    if (room.dressed() || !compact_) measured(room, times, state);
    banner(room);
    if (state.help) help();
    gui_.end();
}

}  // namespace room
