// Sensor: opened by Context.open, an iterator of frames.
#include <algorithm>
#include <cmath>

#include "context.h"
#include "frame.h"

namespace vfit_python {

namespace {

// Between two looks at Ctrl-C.
constexpr int64_t kSlice_ns = 100'000'000;
// A sensor that waits for its pool never goes on by itself: this long without a frame, with this many held.
constexpr int64_t kStarved_ns = 5'000'000'000;
constexpr uint32_t kManyFrames = 4;
constexpr double kLongest_s = 1e9;  // of a timeout: a lifetime, and it still fits in 64 bits of nanoseconds

class Sensor : public Owned<vfit_sensor, vfit_sensor_close> {
public:
    using Owned::Owned;
};

std::string option_text(const py::handle& given) {
    if (py::isinstance<py::bool_>(given)) return given.cast<bool>() ? "1" : "0";
    return py::str(given).cast<std::string>();
}

void set_option(const Sensor& sensor, const std::string& key, const py::handle& given) {
    const std::string option = option_text(given);
    run([&, s = sensor.get()] { return vfit_sensor_set_option(s, key.c_str(), option.c_str()); });
}

vfit_sensor_stats describe(const Sensor& sensor) {
    vfit_sensor_stats s = vfit_sensor_stats_init();
    check(vfit_sensor_describe(sensor.get(), &s));
    return s;
}

void start(const Sensor& sensor) {
    run([s = sensor.get()] { return vfit_sensor_start(s); });
}

std::shared_ptr<Sensor> open(const Context& context, const py::object& uri, const py::kwargs& options) {
    const auto name = py::module_::import("os").attr("fspath")(uri).cast<std::string>();
    vfit_sensor handle{};
    run([&, h = context.handle()] { return vfit_sensor_open(h, name.c_str(), &handle); });
    auto sensor = make<Sensor>(context.core(), handle);
    for (const auto& [key, option] : options) set_option(*sensor, key.cast<std::string>(), option);
    return sensor;
}

void complain_where_starved(const Sensor& sensor, int64_t waited_ns) {
    if (waited_ns < kStarved_ns) return;
    vfit_context_stats stats = vfit_context_stats_init();
    check(vfit_context_describe(sensor.core()->handle(), &stats));
    if (stats.frame_count >= kManyFrames)
        fail(VFIT_ERROR_BUSY, "no frame for 5 s while " + std::to_string(stats.frame_count) +
                                  " frames are held: a sensor's pool is small, so copy what you keep "
                                  "(frame.depth.copy()) and let the frames go");
}

/// A frame; VFIT_NOT_READY, VFIT_TIMEOUT or VFIT_END_OF_STREAM without one. Ctrl-C gets through.
std::unique_ptr<Frame> take(const Sensor& sensor, int64_t timeout_ns, vfit_result& result) {
    for (int64_t waited = 0;;) {
        const int64_t slice = timeout_ns < 0 ? kSlice_ns : std::min(kSlice_ns, timeout_ns - waited);
        vfit_frame frame{};
        result = run([&, s = sensor.get()] { return vfit_sensor_acquire(s, slice, &frame); });
        if (result == VFIT_OK) return std::make_unique<Frame>(sensor.core(), frame);
        waited += slice;
        if (result != VFIT_TIMEOUT || (timeout_ns >= 0 && waited >= timeout_ns)) return nullptr;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (timeout_ns < 0) complain_where_starved(sensor, waited);
    }
}

std::unique_ptr<Frame> acquire(const Sensor& sensor, const std::optional<double>& timeout_s) {
    if (timeout_s && !std::isfinite(*timeout_s)) fail(VFIT_ERROR_ARGUMENT, "timeout_s is not finite");
    vfit_result result;
    if (!timeout_s) return take(sensor, -1, result);
    return take(sensor, static_cast<int64_t>(std::clamp(*timeout_s, 0.0, kLongest_s) * 1e9), result);
}

std::unique_ptr<Frame> next(const Sensor& sensor) {
    if (describe(sensor).running == 0) start(sensor);
    vfit_result result;
    auto frame = take(sensor, -1, result);
    if (!frame) throw py::stop_iteration();
    return frame;
}

py::list modes(const Sensor& sensor) {
    py::list out;
    for (const vfit_sensor_mode& m : list(vfit_sensor_modes, sensor.get()))
        out.append(value("SensorMode", field(m.name), m.width, m.height, m.rate_hz));
    return out;
}

py::dict options(const Sensor& sensor) {
    py::dict out;
    for (const vfit_sensor_option& o : list(vfit_sensor_options, sensor.get()))
        out[py::str(field(o.key))] = value("SensorOption", field(o.value), field(o.text));
    return out;
}

py::object stats(const Sensor& sensor) {
    const vfit_sensor_stats s = describe(sensor);
    return value("SensorStats", s.running != 0, value("ResultCode", s.state), s.received, s.taken, s.dropped,
                 s.latency_ns);
}

}  // namespace

void bind_sensor(py::module_& m) {
    closable(
        py::class_<Sensor, std::shared_ptr<Sensor>>(
            m, "Sensor", "A camera, a recording or a virtual person; iterate it for its frames.")
            .def("start", &start, "Iterating starts it too.")
            .def("stop", [](const Sensor& s) { run([h = s.get()] { return vfit_sensor_stop(h); }); })
            .def("acquire", &acquire, "timeout_s"_a = py::none(),
                 "The newest frame; None where none came in time, or the stream has ended. 0 never waits.")
            .def_property_readonly("ended",
                                   [](const Sensor& s) { return describe(s).state == VFIT_END_OF_STREAM; })
            .def("__iter__", [](py::object self) { return self; })
            .def("__next__", &next)
            .def(
                "set_option",
                [](const Sensor& s, const std::string& key, const py::object& v) { set_option(s, key, v); },
                "key"_a, "value"_a)
            .def("options", &options, "key -> SensorOption.")
            .def("modes", &modes)
            .def("stats", &stats));
    py::reinterpret_borrow<py::class_<Context>>(m.attr("Context"))
        .def("open", &open, "uri"_a,
             "A sensor by its URI (\"recording:PATH\", \"virtual:motion=demo\") or a recording's path; "
             "options by "
             "keyword.");
}

}  // namespace vfit_python
