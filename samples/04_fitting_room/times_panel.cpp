// The panel on the right: where the time of a picture goes, and what the colors of the fit map mean.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "panels.h"

namespace room {

namespace {

constexpr ImU32 kColors[kStages] = {IM_COL32(70, 130, 180, 255), IM_COL32(96, 168, 108, 255),
                                    IM_COL32(200, 96, 84, 255), IM_COL32(168, 160, 150, 255)};
constexpr const char* kNames[kStages] = {"sensor, tracker", "motion, skin", "cloth", "drawing"};
constexpr float kTop_ms = 50.0f;  // of the plot

/// Reserves a rectangle of the panel's width, and returns its upper left corner.
ImVec2 reserve(float width, float height) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy({width, height});
    return at;
}

void label(ImVec2 at, const char* text) { ImGui::GetWindowDrawList()->AddText(at, kFaint, text); }

/// A column a picture, the newest on the right, with lines at 60 and 30 pictures a second.
void plot(const Times& times, float em) {
    const float scale = 3.2f * em;  // for the labels
    const float width = ImGui::GetContentRegionAvail().x - scale, height = 6.0f * em;
    const ImVec2 at = reserve(width + scale, height);
    const float bottom = at.y + height, column = width / float(Times::kPlotted);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (size_t i = 0; i < Times::kPlotted; ++i) {
        const StageMs stages = times.ago(i);
        const float right = at.x + width - column * float(i);
        float y = bottom;
        for (size_t s = 0; s < kStages && y > at.y; ++s) {
            const float top = std::max(at.y, y - height * stages[s] / kTop_ms);
            list.AddRectFilled({right - column, top}, {right, y}, kColors[s]);
            y = top;
        }
    }
    for (const float ms : {1000.0f / 60.0f, 1000.0f / 30.0f}) {
        const float y = std::floor(bottom - height * ms / kTop_ms);
        list.AddRectFilled({at.x, y}, {at.x + width, y + 1.0f}, IM_COL32(0, 0, 0, 60));
        char text[16];
        std::snprintf(text, sizeof text, "%.0f ms", double(ms));
        label({at.x + width + 0.3f * em, y - 0.6f * em}, text);
    }
}

ImU32 mixed(const float (&from)[3], const float (&to)[3], float part) {
    const auto channel = [&](int c) {  // as the shader of the cloth: squared, drawn by the root
        return int(std::lround(255.0f * std::sqrt(from[c] + (to[c] - from[c]) * part)));
    };
    return IM_COL32(channel(0), channel(1), channel(2), 255);
}

/// As view.cpp colors the cloth, in white light.
ImU32 color_of(float strain) {
    constexpr float kLoose[3] = {0.10f, 0.26f, 0.80f}, kNone[3] = {0.60f, 0.60f, 0.60f},
                    kTaut[3] = {0.95f, 0.75f, 0.10f}, kTight[3] = {0.80f, 0.04f, 0.03f};
    if (strain < 0.0f) return mixed(kNone, kLoose, std::min(1.0f, -strain / 0.04f));
    if (strain < 0.04f) return mixed(kNone, kTaut, strain / 0.04f);
    return mixed(kTaut, kTight, std::min(1.0f, (strain - 0.04f) / 0.06f));
}

}  // namespace

void show_rate(const Times& times, const OverlayState& state, Gui& gui, bool compact) {
    if (!compact) gui.push_large();
    if (times.frames() > 0) ImGui::Text("%.0f fps", times.recent_fps());
    if (!compact) gui.pop_large();
    ImGui::PushStyleColor(ImGuiCol_Text, kFaint);
    if (compact)
        ImGui::TextUnformatted("keys: H");
    else
        ImGui::TextWrapped("%s%s", state.renderer, state.software ? " (software)" : "");
    ImGui::PopStyleColor();
}

void show_stages(const Times& times, float em) {
    ImGui::Spacing();
    const StageMs last = times.ago(0);
    for (size_t s = 0; s < kStages; ++s) {
        const float edge = ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x;
        const ImVec2 at = reserve(0.8f * em, ImGui::GetTextLineHeight());
        const float y = at.y + 0.5f * (ImGui::GetTextLineHeight() - 0.7f * em);
        ImGui::GetWindowDrawList()->AddRectFilled({at.x, y}, {at.x + 0.7f * em, y + 0.7f * em}, kColors[s]);
        ImGui::SameLine();
        ImGui::TextUnformatted(kNames[s]);
        char text[16];
        std::snprintf(text, sizeof text, "%.2f ms", double(last[s]));
        ImGui::SameLine(edge - ImGui::CalcTextSize(text).x);
        ImGui::TextUnformatted(text);
    }
    ImGui::Spacing();
    plot(times, em);
}

void show_fit_legend(float em, bool compact) {
    constexpr float kFrom = -0.04f, kTo = 0.10f;
    constexpr int kSteps = 56;
    ImGui::Spacing();
    ImGui::TextUnformatted(compact ? "strain" : "fit map: strain, from loose to tight");
    const float width = ImGui::GetContentRegionAvail().x, bar = 0.8f * em;
    const ImVec2 at = reserve(width, bar + 1.2f * ImGui::GetTextLineHeight());
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float step = width / float(kSteps);
    for (int i = 0; i < kSteps; ++i) {
        const float left = at.x + step * float(i);
        list.AddRectFilled({left, at.y}, {left + step, at.y + bar},
                           color_of(kFrom + (kTo - kFrom) * (float(i) + 0.5f) / float(kSteps)));
    }
    constexpr struct {
        float strain, pivot;  // pivot: the part of the label left of its place
        const char* text;
    } kTicks[] = {{-0.04f, 0.0f, "-4 %"}, {0.0f, 0.5f, "0"}, {0.04f, 0.5f, "4 %"}, {0.10f, 1.0f, "10 %"}};
    for (const auto& tick : kTicks)
        label({at.x + width * (tick.strain - kFrom) / (kTo - kFrom) -
                   tick.pivot * ImGui::CalcTextSize(tick.text).x,
               at.y + bar + 0.1f * em},
              tick.text);
}

}  // namespace room
