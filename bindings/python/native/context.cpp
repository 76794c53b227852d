#include "context.h"

namespace vfit_python {

namespace {

std::optional<std::string> path_text(const py::object& path) {
    if (path.is_none()) return std::nullopt;
    return py::module_::import("os").attr("fspath")(path).cast<std::string>();
}

Context create(int axes, bool validate, bool deterministic, bool mirror, uint32_t workers,
               const py::object& plugin_dir, const py::object& data_dir) {
    const auto plugins = path_text(plugin_dir), data = path_text(data_dir);
    vfit_context_desc desc = vfit_context_desc_init();
    desc.api_version = VFIT_VERSION;
    desc.axes = axes;
    desc.flags = flag(validate, VFIT_CONTEXT_VALIDATE) | flag(deterministic, VFIT_CONTEXT_DETERMINISTIC) |
                 flag(mirror, VFIT_CONTEXT_MIRROR);
    desc.worker_count = workers;
    desc.plugin_dir = plugins ? plugins->c_str() : nullptr;
    desc.data_dir = data ? data->c_str() : nullptr;
    // Lines are polled with log(): a callback would need the GIL on threads that Python does not know.
    desc.log = [](void*, vfit_log_level, const char*) {};
    return Context(std::make_shared<Core>(desc));
}

py::object stats(const Context& context) {
    vfit_context_stats s = vfit_context_stats_init();
    check(vfit_context_describe(context.core()->handle(), &s));
    return value("ContextStats", s.handle_count, s.frame_count, s.worker_count, s.frame_bytes);
}

int64_t time_ns(const Context& context) {
    int64_t now = 0;
    check(vfit_context_time(context.handle(), &now));
    return now;
}

py::dict profile(const Context& context) {
    py::dict out;
    for (const vfit_profile& p : list(vfit_profile_list, context.handle()))
        out[py::str(field(p.stage))] = value("StageTime", p.calls, p.last_ms, p.mean_ms, p.max_ms);
    return out;
}

py::list log(const Context& context) {
    // Lines longer than this are cut; the library's are one sentence, at most with a path in it.
    char line[8192];
    py::list out;
    for (;;) {
        vfit_log_level level = 0;
        if (check(vfit_log_next(context.core()->handle(), &level, line, sizeof line)) == VFIT_NOT_READY)
            return out;
        out.append(value("LogLine", value("LogLevel", level), py::str(line)));
    }
}

py::list plugins(const Context& context) {
    py::list out;
    for (const vfit_plugin_info& p : list(vfit_plugin_list, context.handle()))
        out.append(
            value("PluginInfo", field(p.name), version_text(p.version), field(p.schemes), field(p.path)));
    return out;
}

/// Names of vfit_garment_list or vfit_size_chart_list.
template <typename List>
py::list data_names(const Context& context, List list_call) {
    py::list out;
    for (const vfit_data_name& n : list(list_call, context.handle())) out.append(field(n.name));
    return out;
}

py::list sensors(const Context& context) {
    py::list out;
    for (const vfit_sensor_info& s : list(vfit_sensor_list, context.handle()))
        out.append(value("SensorInfo", field(s.uri), field(s.name), field(s.plugin), s.caps));
    return out;
}

}  // namespace

void bind_context(py::module_& m) {
    py::class_<Context>(m, "Context", "All that vfit does happens in a context; contexts share nothing.")
        .def(py::init(&create), py::kw_only(), "axes"_a = 0, "validate"_a = false, "deterministic"_a = false,
             "mirror"_a = false, "workers"_a = 0, "plugin_dir"_a = py::none(), "data_dir"_a = py::none(),
             "workers 0: physical cores less one. The folders default to those in the package.")
        .def(
            "close", [](const Context& c) { c.core()->close(); },
            "Closes every object of this context. Frames and arrays stay valid; the last of them frees the "
            "rest.")
        .def_property_readonly("closed", [](const Context& c) { return c.core()->closed(); })
        .def("__enter__", [](py::object self) { return self; })
        .def("__exit__", [](const Context& c, const py::args&) { c.core()->close(); })
        .def("stats", &stats, "Live handles and frames, and the memory that frames hold.")
        .def_property_readonly("time_ns", &time_ns, "Now, on the clock of all time stamps of this context.")
        .def("profile", &profile, "Time spent in each stage: name -> StageTime.")
        .def("reset_profile", [](const Context& c) { check(vfit_profile_reset(c.handle())); })
        .def("log", &log, "The log lines since the last call; the library keeps the newest 256.")
        .def(
            "load_plugin",
            [](const Context& c, const py::object& path) {
                const std::string file = path_text(path).value_or("");
                run([&, h = c.handle()] { return vfit_plugin_load(h, file.c_str()); });
            },
            "path"_a, "Loads a sensor plug-in from its file.")
        .def("plugins", &plugins, "The plug-ins that are loaded.")
        .def(
            "garments", [](const Context& c) { return data_names(c, vfit_garment_list); },
            "Names that Garment.open takes.")
        .def(
            "size_charts", [](const Context& c) { return data_names(c, vfit_size_chart_list); },
            "Names that SizeChart.open takes.")
        .def(
            "populations", [](const Context& c) { return data_names(c, vfit_population_list); },
            "Names that Population.open takes.")
        .def("sensors", &sensors, "The sensors that can be opened now.")
        .def(
            "sensor_changes",
            [](const Context& c) {
                uint64_t count = 0;
                check(vfit_sensor_changes(c.handle(), &count));
                return count;
            },
            "Rises when sensors() may tell something else: a USB camera came or went, a plug-in was loaded.");
}

}  // namespace vfit_python
