// The contents of the overlay's panels: widgets and plots in the ImGui window that is open.
#pragma once

#include "overlay.h"

namespace room {

/// Size and measurements; the size alone in a compact window.
void show_person(const Room& room, Gui& gui, bool compact);

/// Garments and sizes as lists.
void choose_from_lists(const Room& room, Wish& wish);
/// The same as two menus that open.
void choose_from_menus(const Room& room, Wish& wish);
void show_switches(const Room& room, const OverlayState& state, Wish& wish);
void show_keys();

/// Pictures a second, and what draws them.
void show_rate(const Times& times, const OverlayState& state, Gui& gui, bool compact);
/// Time by stage: the last picture in figures, the last 240 as columns.
void show_stages(const Times& times, float em);
/// The colors of the fit map by strain.
void show_fit_legend(float em, bool compact);

}  // namespace room
