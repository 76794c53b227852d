#include "scan.h"

#include "context.h"
#include "joints.h"

namespace vfit_python {

namespace {

std::shared_ptr<Scan> create(const Context& context, uint32_t frames, const py::object& sex, int method,
                             uint32_t side_frames, bool bare, bool tight, bool turn, uint32_t cameras) {
    vfit_scan_desc desc = vfit_scan_desc_init();
    desc.frame_count = frames;
    desc.sex = sex_in(sex);
    desc.method = method;
    desc.side_frame_count = side_frames;
    desc.flags = (bare ? uint32_t{VFIT_SCAN_BARE} : 0u) | (tight ? uint32_t{VFIT_SCAN_TIGHT} : 0u) |
                 (turn ? uint32_t{VFIT_SCAN_TURN} : 0u);
    desc.camera_count = cameras;
    vfit_scan handle{};
    run([&, h = context.handle()] { return vfit_scan_create(h, &desc, &handle); });
    return make<Scan>(context.core(), handle);
}

py::object add(const Scan& scan, const Frame& frame, const std::optional<uint32_t>& body_id,
               uint32_t camera) {
    vfit_scan_state state = vfit_scan_state_init();
    const uint32_t body = body_or_active(frame, body_id);
    const vfit_result result = run([&, s = scan.get(), f = frame.get()] {
        return camera == 0 ? vfit_scan_add(s, f, body, &state)
                           : vfit_scan_add_from(s, camera, f, body, &state);
    });
    return value("ScanState", result != VFIT_INCOMPLETE, result == VFIT_OK, state.frames_taken,
                 state.frames_wanted, value("Guidance", state.guidance), state.correction_m, state.compute_ms,
                 state.side_frames_taken, state.side_frames_wanted, state.turn_seen, state.turn_wanted);
}

py::dict measure(const Scan& scan) { return measurements_out(list(vfit_scan_measure, scan.get())); }

py::tuple sex(const Scan& scan) {
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    float probability = 0.0f;
    run([&, h = scan.get()] { return vfit_scan_sex(h, &sex, &probability); });
    return py::make_tuple(value("Sex", sex), probability);
}

py::list colliders(const Scan& scan) { return colliders_out(list(vfit_scan_colliders, scan.get())); }

py::object scale(const Scan& scan, const std::string& garment_kind) {
    vfit_scale s = vfit_scale_init();
    run([&, h = scan.get()] { return vfit_scan_scale(h, garment_kind.c_str(), &s); });
    return value("Scale", s.x, s.y, s.sigma_x, s.sigma_y, s.width_m, s.height_m);
}

}  // namespace

void bind_scan(py::module_& m) {
    closable(py::class_<Scan, std::shared_ptr<Scan>>(
                 m, "Scan", "Measures one person over several frames; closing it wipes the body data.")
                 .def(py::init(&create), "context"_a, py::kw_only(), "frames"_a = 0, "sex"_a = py::none(),
                      "method"_a = 0, "side_frames"_a = 0, "bare"_a = false, "tight"_a = false,
                      "turn"_a = false, "cameras"_a = 1,
                      "frames 0: 30, as in the paper. Of method FIT: side_frames, from the side, 15 are "
                      "enough; bare: no shoes "
                      "and no hair on the crown; tight: the clothes lie on the skin; turn: then once "
                      "round on the spot; cameras: so many see the person at once.")
                 .def("add", &add, "frame"_a, "body_id"_a = py::none(), "camera"_a = 0,
                      "One tracked frame; the state says whether it was taken, and if not why. Default: its "
                      "active body. camera: which of several saw it, from 0 on.")
                 .def("measure", &measure,
                      "key -> Measurement, from the first frame on; the values settle with each.")
                 .def("sex", &sex,
                      "(Sex, probability): as the scan was told, else as it infers from the fitted body.")
                 .def("colliders", &colliders, "Spheres of the person, centres as in the last frame.")
                 .def("scale", &scale, "garment_kind"_a,
                      "Algorithm 3 for \"short_sleeves\", \"long_sleeves\" or \"trousers\".")
                 .def(
                     "extend",
                     [](const Scan& s, uint32_t frames, uint32_t side_frames) {
                         check(vfit_scan_extend(s.get(), frames, side_frames));
                     },
                     "frames"_a, "side_frames"_a = 0, "Asks for more frames, also of a complete scan.")
                 .def("reset", [](const Scan& s) { check(vfit_scan_reset(s.get())); }));
}

}  // namespace vfit_python
