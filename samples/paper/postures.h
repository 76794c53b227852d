// A virtual person whose postures an avatar takes.
#pragma once

#include <functional>

#include "client/client.h"

namespace vfit::tools {

/// Plays the source: `on_frame` sees each tracked frame once the avatar stands as
/// the person in it does; false ends the play. Fails where nobody is in view.
void take_postures(vfit_context context, vfit_avatar avatar, const std::string& source,
                   const TrackOptions& track,
                   const std::function<bool(vfit_frame tracked, float time_s)>& on_frame);

/// The default body of that sex, or one of other shape values.
Avatar avatar_of_shape(vfit_context context, vfit_sex sex, const std::vector<vfit_shape_value>& shape,
                       uint32_t detail);

}  // namespace vfit::tools
