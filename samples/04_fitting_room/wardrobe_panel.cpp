// The panel on the left: measurements, the garment, and the lists to choose from.
#include <algorithm>
#include <cfloat>
#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "panels.h"

namespace room {

namespace {

void faint(const char* format, ...) IM_FMTARGS(1);
void faint(const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    ImGui::PushStyleColor(ImGuiCol_Text, kFaint);
    ImGui::TextV(format, arguments);
    ImGui::PopStyleColor();
    va_end(arguments);
}

/// A number in a column of numbers, of which the last digits stand below each other.
void right_text(ImU32 color, const char* format, double value) {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    const float space = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, space));
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(text);
    ImGui::PopStyleColor();
}

constexpr struct {
    const char *key, *label;
} kMeasures[] = {{"stature_m", "stature"},         {"chest_girth_m", "chest girth"},
                 {"waist_girth_m", "waist girth"}, {"hip_girth_m", "hip girth"},
                 {"inside_leg_m", "inside leg"},   {"arm_length_m", "arm length"}};

/// Those of the list that the scan has, in cm with the standard deviation.
void show_measures(const Room& room) {
    if (!ImGui::BeginTable("measures", 3, ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("measure", ImGuiTableColumnFlags_WidthStretch);
    for (const auto& shown : kMeasures)
        for (const vfit_measurement& m : room.measures()) {
            if (std::strcmp(m.key, shown.key) != 0) continue;
            ImGui::TableNextColumn();
            faint("%s", shown.label);
            ImGui::TableNextColumn();
            right_text(kInk, "%.1f cm", 100.0 * double(m.value));
            ImGui::TableNextColumn();
            right_text(kFaint, "\u00b1 %.1f", 100.0 * double(m.sigma));
        }
    ImGui::EndTable();
}

int difference(size_t to, size_t from) { return int(to) - int(from); }

void choose_garment_in_list(const Room& room, Wish& wish) {
    const Wardrobe& wardrobe = room.wardrobe();
    constexpr size_t kMaxRows = 10;
    const float rows = float(std::min(wardrobe.count(), kMaxRows));
    faint("garment");
    if (ImGui::BeginChild("garments", {0.0f, rows * ImGui::GetTextLineHeightWithSpacing()})) {
        int& scrolled_to = *ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("scrolled to"), -1);
        for (size_t i = 0; i < wardrobe.count(); ++i) {
            const bool chosen = i == room.garment_index();
            ImGui::PushID(int(i));
            if (ImGui::Selectable(wardrobe.piece(i).name.c_str(), chosen))
                wish.garment = difference(i, room.garment_index());
            if (chosen && scrolled_to != int(i)) {  // keys choose garments that the list does not show
                ImGui::SetScrollHereY();
                scrolled_to = int(i);
            }
            ImGui::PopID();
        }
    }
    ImGui::EndChild();
}

/// A row of buttons, broken at the panel's edge. The recommended size has a frame, the worn one is filled.
void choose_size_by_button(const Room& room, Wish& wish) {
    const std::vector<std::string>& sizes = room.wardrobe().piece(room.garment_index()).sizes;
    const ImGuiStyle& style = ImGui::GetStyle();
    const float edge = ImGui::GetCursorScreenPos().x + ImGui::GetContentRegionAvail().x;
    faint("size");
    for (size_t i = 0; i < sizes.size(); ++i) {
        const float width = ImGui::CalcTextSize(sizes[i].c_str()).x + 2.0f * style.FramePadding.x;
        if (i > 0 && ImGui::GetItemRectMax().x + style.ItemSpacing.x + width <= edge) ImGui::SameLine();
        const bool worn = i == room.size_index();
        if (worn) {
            for (const ImGuiCol part : {ImGuiCol_Button, ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive})
                ImGui::PushStyleColor(part, kAccent);
            ImGui::PushStyleColor(ImGuiCol_Text, kWhite);
        }
        ImGui::PushID(int(i));
        if (ImGui::Button(sizes[i].c_str())) wish.size = difference(i, room.size_index());
        ImGui::PopID();
        if (worn) ImGui::PopStyleColor(4);
        if (sizes[i] == room.person().size && room.person().probability > 0.0f)
            ImGui::GetWindowDrawList()->AddRect(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), kAccent,
                                                style.FrameRounding);
    }
}

void toggle(const char* label, bool is_on, Key key, Wish& wish) {
    if (ImGui::Checkbox(label, &is_on)) wish.key = key;
}

}  // namespace

void show_person(const Room& room, Gui& gui, bool compact) {
    const Room::Person& person = room.person();
    if (person.probability > 0.0f) {
        gui.push_large();
        ImGui::Text("size %s", person.size.c_str());
        gui.pop_large();
        faint(compact ? "probability %.0f %%" : "recommended, probability %.0f %%",
              100.0 * double(person.probability));
    } else {
        ImGui::TextUnformatted(person.size.c_str());
        faint("no recommended size");
    }
    if (compact)
        faint("%.1f \u00b1 %.1f cm tall", 100.0 * double(person.stature_m),
              100.0 * double(person.stature_sigma_m));
    else
        show_measures(room);
    ImGui::Spacing();
}

void choose_from_lists(const Room& room, Wish& wish) {
    choose_garment_in_list(room, wish);
    ImGui::Spacing();
    choose_size_by_button(room, wish);
    ImGui::Spacing();
}

void choose_from_menus(const Room& room, Wish& wish) {
    const auto menu = [](const char* id, size_t count, size_t chosen, const auto& label) {
        size_t wanted = chosen;
        ImGui::SetNextItemWidth(-FLT_MIN);
        if (!ImGui::BeginCombo(id, label(chosen))) return 0;
        for (size_t i = 0; i < count; ++i) {
            ImGui::PushID(int(i));
            if (ImGui::Selectable(label(i), i == chosen)) wanted = i;
            ImGui::PopID();
        }
        ImGui::EndCombo();
        return difference(wanted, chosen);
    };
    const Wardrobe& wardrobe = room.wardrobe();
    if (const int by = menu("##garment", wardrobe.count(), room.garment_index(),
                            [&](size_t i) { return wardrobe.piece(i).name.c_str(); }))
        wish.garment = by;
    const std::vector<std::string>& sizes = wardrobe.piece(room.garment_index()).sizes;
    if (const int by =
            menu("##size", sizes.size(), room.size_index(), [&](size_t i) { return sizes[i].c_str(); }))
        wish.size = by;
}

void show_switches(const Room& room, const OverlayState& state, Wish& wish) {
    toggle("cloth simulation (P)", room.physics(), Key::physics, wish);
    toggle("fit map (F)", state.fit_map, Key::fit_map, wish);
    toggle("mirror (M)", state.mirror, Key::mirror, wish);
    toggle("camera (C)", room.camera_on(), Key::camera, wish);
    if (ImGui::Button("put on again (space)")) wish.key = Key::redress;
    ImGui::SameLine();
    if (ImGui::Button("keys (H)")) wish.key = Key::help;
}

void show_keys() {
    constexpr const char* kKeys[][2] = {{"left, right", "previous, next garment"},
                                        {"up, down", "next, previous size"},
                                        {"P", "cloth simulation on, off"},
                                        {"space", "put the garment on again"},
                                        {"F", "fit map on, off"},
                                        {"M", "mirror on, off"},
                                        {"C", "camera on, off"},
                                        {"H", "this list"},
                                        {"esc", "end"}};
    if (!ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) return;
    for (const auto& [key, meaning] : kKeys) {
        ImGui::TableNextColumn();
        faint("%s", key);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(meaning);
    }
    ImGui::EndTable();
}

}  // namespace room
