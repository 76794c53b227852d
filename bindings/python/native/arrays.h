// Between numpy arrays and the views and targets of vfit.h.
#pragma once

#include "frame.h"

namespace vfit_python {

/// A stream as a read-only array over the library's memory; its base holds a reference to the frame.
py::array array_of(const Frame& frame, vfit_stream stream, const vfit_view& view);

/// Where vfit_frame_write puts a stream of that format: the array's own type and stride.
vfit_target target_in(const py::array& out, vfit_format stream_format);

/// An image of the host as the library takes it, and the array that holds its pixels.
struct ImageArray {
    py::array pixels;
    vfit_view view;
};
ImageArray depth_in(const py::array& depth);
ImageArray users_in(const py::array& users);
ImageArray color_in(const py::array& color);

}  // namespace vfit_python
