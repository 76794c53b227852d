// Recorder: frames into a recording folder (docs/recording.md).
#include "context.h"
#include "frame.h"

namespace vfit_python {

namespace {

class Recorder : public Owned<vfit_recorder, vfit_recorder_destroy> {
public:
    using Owned::Owned;
};

std::shared_ptr<Recorder> create(const Context& context, const py::object& path,
                                 const std::optional<std::string>& sensor_name, float rate_hz,
                                 bool segmented) {
    const auto folder = py::module_::import("os").attr("fspath")(path).cast<std::string>();
    vfit_recorder_desc desc = vfit_recorder_desc_init();
    desc.sensor_name = sensor_name ? sensor_name->c_str() : nullptr;
    desc.rate_hz = rate_hz;
    desc.segmented = segmented ? 1 : 0;
    vfit_recorder handle{};
    run([&, h = context.handle()] { return vfit_recorder_create(h, folder.c_str(), &desc, &handle); });
    return make<Recorder>(context.core(), handle);
}

}  // namespace

void bind_recorder(py::module_& m) {
    closable(
        py::class_<Recorder, std::shared_ptr<Recorder>>(
            m, "Recorder", "Writes a recording folder; what was written stays readable if the process dies.")
            .def(py::init(&create), "context"_a, "path"_a, py::kw_only(), "sensor_name"_a = py::none(),
                 "rate_hz"_a = 30.0f, "segmented"_a = false,
                 "path must not exist or be an empty folder; segmented: the background was removed already.")
            .def(
                "write",
                [](const Recorder& r, const Frame& f) {
                    run([h = r.get(), g = f.get()] { return vfit_recorder_write(h, g); });
                },
                "frame"_a));
}

}  // namespace vfit_python
