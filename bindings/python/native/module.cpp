// The extension module vfit._vfit: its parts, its errors and its end.
#include "core.h"

namespace vfit_python {

namespace {

void translate(std::exception_ptr pointer) {
    try {
        if (pointer) std::rethrow_exception(pointer);
    } catch (const Failure& failure) {
        const py::object error =
            py::module_::import("vfit.errors").attr("from_result")(failure.result(), failure.what());
        PyErr_SetObject(py::type::handle_of(error).ptr(), error.ptr());
    }
}

py::object info() {
    vfit_library_info info = vfit_library_info_init();
    check(vfit_library_describe(&info));
    return value("LibraryInfo", version_text(info.version), field(info.simd), field(info.build));
}

}  // namespace

std::string version_text(uint32_t version) {
    return std::to_string(version >> 22) + "." + std::to_string(version >> 12 & 0x3FF) + "." +
           std::to_string(version & 0xFFF);
}

}  // namespace vfit_python

PYBIND11_MODULE(_vfit, m) {
    using namespace vfit_python;
    m.doc() = "The C ABI of vfit for Python; use it through the package vfit.";
    py::register_exception_translator(translate);
    m.attr("__version__") = version_text(vfit_version());
    m.def("info", &info, "Version, instruction set in use and build of the library.");
    bind_vocabulary(m);
    bind_context(m);
    bind_frame(m);
    bind_sensor(m);
    bind_recorder(m);
    bind_tracker(m);
    bind_scan(m);
    bind_size(m);
    bind_population(m);
    bind_avatar(m);
    bind_motion(m);
    bind_pose_formats(m);
    bind_cloth(m);
    py::module_::import("atexit").attr("register")(py::cpp_function(&Core::close_all));
}
