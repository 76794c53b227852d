#include "arrays.h"

#include <limits>

namespace vfit_python {

namespace {

struct Layout {
    py::dtype type;
    std::vector<py::ssize_t> shape, strides;  // of one item
};

template <typename T>
Layout layout(std::vector<py::ssize_t> shape = {}, std::vector<py::ssize_t> strides = {}) {
    if (strides.empty() && !shape.empty()) strides = {static_cast<py::ssize_t>(sizeof(T))};
    return {py::dtype::of<T>(), std::move(shape), std::move(strides)};
}

Layout layout_of(vfit_format format) {
    switch (format) {
        case VFIT_FORMAT_U8: return layout<uint8_t>();
        case VFIT_FORMAT_U16: return layout<uint16_t>();
        case VFIT_FORMAT_U32: return layout<uint32_t>();
        case VFIT_FORMAT_F32: return layout<float>();
        case VFIT_FORMAT_RGBA8: return layout<uint8_t>({4});
        case VFIT_FORMAT_F32X2: return layout<float>({2});
        case VFIT_FORMAT_F32X3: return layout<float>({3});
        // Column-major in memory, so that [row, column] steps by 4 and 16 bytes.
        case VFIT_FORMAT_F32X16: return layout<float>({4, 4}, {4, 16});
        case VFIT_FORMAT_U16X8: return layout<uint16_t>({8});
        case VFIT_FORMAT_F32X8: return layout<float>({8});
        default: fail(VFIT_ERROR_UNSUPPORTED, "the binding does not know format " + std::to_string(format));
    }
}

bool is_image(vfit_stream stream) {
    return stream == VFIT_STREAM_DEPTH || stream == VFIT_STREAM_COLOR || stream == VFIT_STREAM_USER_MAP;
}

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")).cast<std::string>(); }

std::string dtype_text(const py::array& array) { return py::str(array.dtype()).cast<std::string>(); }

/// Numbers of one item, and the format that the array's type makes of them.
vfit_format target_format(const py::array& out, vfit_format from, py::ssize_t& numbers) {
    numbers = 1;
    for (const py::ssize_t n : layout_of(from).shape) numbers *= n;
    if (py::isinstance<py::array_t<float>>(out)) {
        if (numbers == 1) return VFIT_FORMAT_F32;
        if (numbers == 2) return VFIT_FORMAT_F32X2;
        if (numbers == 3) return VFIT_FORMAT_F32X3;
        return numbers == 8 ? VFIT_FORMAT_F32X8 : VFIT_FORMAT_F32X16;
    }
    if (py::isinstance<py::array_t<uint8_t>>(out)) return numbers == 4 ? VFIT_FORMAT_RGBA8 : VFIT_FORMAT_U8;
    if (py::isinstance<py::array_t<uint16_t>>(out)) return numbers == 8 ? VFIT_FORMAT_U16X8 : VFIT_FORMAT_U16;
    if (py::isinstance<py::array_t<uint32_t>>(out)) return VFIT_FORMAT_U32;
    fail(VFIT_ERROR_ARGUMENT, "out: type " + dtype_text(out) + " is none of uint8, uint16, uint32, float32");
}

ImageArray image_in(const char* name, const py::array& given, const py::dtype& type, py::ssize_t channels,
                    vfit_format format, const char* hint = "") {
    const bool shaped = channels == 1 ? given.ndim() == 2 : given.ndim() == 3 && given.shape(2) == channels;
    if (!given.dtype().equal(type) || !shaped)
        fail(VFIT_ERROR_ARGUMENT, std::string(name) + ": wanted is " + py::str(type).cast<std::string>() +
                                      (channels == 1 ? " (height, width)" : " (height, width, 4)") +
                                      ", given is " + dtype_text(given) + " " + shape_text(given) + hint);
    ImageArray out{py::array::ensure(given, py::array::c_style), vfit_view_init()};
    out.view.format = format;
    out.view.data = out.pixels.data();
    out.view.width = static_cast<uint32_t>(given.shape(1));
    out.view.height = static_cast<uint32_t>(given.shape(0));
    return out;
}

}  // namespace

py::array array_of(const Frame& frame, vfit_stream stream, const vfit_view& view) {
    const Layout item = layout_of(view.format);
    const auto item_stride = static_cast<py::ssize_t>(view.item_stride);
    std::vector<py::ssize_t> shape, strides;
    if (is_image(stream)) {
        shape = {view.height, view.width};
        strides = {view.row_stride, item_stride};
    } else if (stream == VFIT_STREAM_INDEX) {
        shape = {view.width / 3, 3};
        strides = {3 * item_stride, item_stride};
    } else {
        shape = {view.width};
        strides = {item_stride};
    }
    shape.insert(shape.end(), item.shape.begin(), item.shape.end());
    strides.insert(strides.end(), item.strides.begin(), item.strides.end());
    auto reference = std::make_unique<FrameReference>(frame.reference.retained());
    const py::capsule owner(reference.get(), [](void* r) { delete static_cast<FrameReference*>(r); });
    reference.release();
    py::array out(item.type, shape, strides, view.data, owner);
    out.attr("setflags")("write"_a = false);
    return out;
}

vfit_target target_in(const py::array& out, vfit_format stream_format) {
    py::ssize_t numbers = 1;
    vfit_target target = vfit_target_init();
    target.format = target_format(out, stream_format, numbers);
    if (!out.writeable()) fail(VFIT_ERROR_ARGUMENT, "out is read-only");
    target.data = const_cast<void*>(out.data());
    if (out.size() == 0) return target;
    py::ssize_t dimensions = out.ndim();
    if (numbers > 1) {
        --dimensions;
        if (dimensions < 0 || out.shape(dimensions) != numbers || out.strides(dimensions) != out.itemsize())
            fail(VFIT_ERROR_ARGUMENT, "out: the last axis must hold the " + std::to_string(numbers) +
                                          " numbers of an item, side by side; its shape is " +
                                          shape_text(out));
    }
    // Items must lie one stride apart over all the other axes.
    py::ssize_t stride = 0, items = 1;
    for (py::ssize_t i = dimensions - 1; i >= 0; --i) {
        if (out.shape(i) == 1) continue;
        if (stride == 0) stride = out.strides(i);
        // A stride of 0 (np.broadcast_to) makes many items of one place in memory.
        if (out.strides(i) != stride * items || stride <= 0 || stride > std::numeric_limits<uint32_t>::max())
            fail(VFIT_ERROR_ARGUMENT, "out: its items do not lie one stride apart");
        items *= out.shape(i);
    }
    if (stride == 0) stride = numbers * out.itemsize();
    target.item_stride = static_cast<uint32_t>(stride);
    target.capacity = static_cast<uint64_t>((items - 1) * stride + numbers * out.itemsize());
    return target;
}

ImageArray depth_in(const py::array& depth) {
    const bool metres = depth.dtype().kind() == 'f';
    return image_in("depth", depth, py::dtype::of<uint16_t>(), 1, VFIT_FORMAT_U16,
                    metres ? "; of metres: (1000 * np.nan_to_num(depth)).astype(np.uint16)" : "");
}

ImageArray users_in(const py::array& users) {
    // A mask is a user map of person 1.
    if (users.dtype().kind() == 'b') return users_in(users.attr("view")("uint8").cast<py::array>());
    return image_in("users", users, py::dtype::of<uint8_t>(), 1, VFIT_FORMAT_U8);
}

ImageArray color_in(const py::array& color) {
    return image_in("color", color, py::dtype::of<uint8_t>(), 4, VFIT_FORMAT_RGBA8);
}

}  // namespace vfit_python
