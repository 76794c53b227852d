// SizeChart: measures in, sizes with their probability out.
#include "context.h"
#include "joints.h"

namespace vfit_python {

namespace {

class SizeChart : public Owned<vfit_size_chart, vfit_size_chart_destroy> {
public:
    using Owned::Owned;
};

std::shared_ptr<SizeChart> open(const Context& context, const std::string& name) {
    vfit_size_chart handle{};
    run([&, h = context.handle()] { return vfit_size_chart_open(h, name.c_str(), &handle); });
    return make<SizeChart>(context.core(), handle);
}

std::shared_ptr<SizeChart> load(const Context& context, const std::string& json) {
    vfit_size_chart handle{};
    run([&, h = context.handle()] { return vfit_size_chart_load(h, json.data(), json.size(), &handle); });
    return make<SizeChart>(context.core(), handle);
}

py::list rows(const SizeChart& chart) {
    py::list out;
    for (const vfit_size_row& r : list(vfit_size_chart_rows, chart.get()))
        out.append(value("SizeRow", field(r.garment_kind), field(r.label), r.measure_count));
    return out;
}

py::list recommend(const SizeChart& chart, const std::string& garment_kind, const py::object& measurements) {
    const std::vector<vfit_measurement> given = measurements_in(measurements);
    py::list out;
    for (const vfit_size& s :
         list<vfit_size>([&, c = chart.get()](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_size_recommend(c, garment_kind.c_str(), given.data(), sizeof(vfit_measurement),
                                        static_cast<uint32_t>(given.size()), items, stride, n);
         }))
        out.append(value("Size", field(s.label), s.probability));
    return out;
}

py::list zones(const SizeChart& chart, const std::string& garment_kind, const std::string& label,
               const py::object& measurements) {
    const std::vector<vfit_measurement> given = measurements_in(measurements);
    py::list out;
    for (const vfit_size_zone& z :
         list<vfit_size_zone>([&, c = chart.get()](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_size_zones(c, garment_kind.c_str(), label.c_str(), given.data(),
                                    sizeof(vfit_measurement), static_cast<uint32_t>(given.size()), items,
                                    stride, n);
         }))
        out.append(value("SizeZone", field(z.key), z.ease, z.sigma, z.tight, z.regular, z.loose));
    return out;
}

py::str write_measurements(const py::object& measurements, const py::object& sex) {
    const std::vector<vfit_measurement> given = measurements_in(measurements);
    const auto count = static_cast<uint32_t>(given.size());
    const vfit_sex of = sex_in(sex);
    uint32_t capacity = 0;
    check(vfit_measurements_write(given.data(), sizeof(vfit_measurement), count, of, nullptr, &capacity));
    std::string text(capacity, 0);
    check(vfit_measurements_write(given.data(), sizeof(vfit_measurement), count, of, text.data(), &capacity));
    text.resize(capacity - 1);
    return py::str(text);
}

py::tuple read_measurements(const std::string& json) {
    vfit_sex sex = VFIT_SEX_UNKNOWN;
    const auto measurements = list<vfit_measurement>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_measurements_read(json.data(), json.size(), items, stride, n, &sex);
    });
    return py::make_tuple(measurements_out(measurements), value("Sex", sex));
}

py::dict merge_measurements(const py::object& a, const py::object& b) {
    const std::vector<vfit_measurement> one = measurements_in(a), other = measurements_in(b);
    return measurements_out(list<vfit_measurement>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_measurements_merge(
            one.data(), sizeof(vfit_measurement), static_cast<uint32_t>(one.size()), other.data(),
            sizeof(vfit_measurement), static_cast<uint32_t>(other.size()), items, stride, n);
    }));
}

py::str add_to_calibration(const std::optional<std::string>& text, const py::object& scanned,
                           const py::object& taped) {
    const std::vector<vfit_measurement> scan = measurements_in(scanned), tape = measurements_in(taped);
    std::string out;
    uint32_t capacity = 0;
    const auto add = [&](char* to) {
        check(vfit_calibration_add(text ? text->data() : nullptr, text ? text->size() : 0, scan.data(),
                                   sizeof(vfit_measurement), static_cast<uint32_t>(scan.size()), tape.data(),
                                   sizeof(vfit_measurement), static_cast<uint32_t>(tape.size()), to,
                                   &capacity));
    };
    add(nullptr);
    out.resize(capacity);
    add(out.data());
    out.resize(capacity - 1);
    return py::str(out);
}

py::dict calibrated_measures(const std::string& text) {
    py::dict out;
    for (const vfit_calibrated_measure& m :
         list<vfit_calibrated_measure>([&](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_calibration_measures(text.data(), text.size(), items, stride, n);
         }))
        out[py::str(field(m.key))] =
            value("CalibratedMeasure", m.people, m.enough != 0, m.offset, m.widening);
    return out;
}

py::dict calibrate(const std::string& text, const py::object& measurements) {
    const std::vector<vfit_measurement> given = measurements_in(measurements);
    return measurements_out(list<vfit_measurement>([&](auto* items, uint32_t stride, uint32_t* n) {
        return vfit_calibration_apply(text.data(), text.size(), given.data(), sizeof(vfit_measurement),
                                      static_cast<uint32_t>(given.size()), items, stride, n);
    }));
}

}  // namespace

void bind_size(py::module_& m) {
    closable(
        py::class_<SizeChart, std::shared_ptr<SizeChart>>(m, "SizeChart",
                                                          "A size chart (docs/size-charts.md).")
            .def_static("open", &open, "context"_a, "name"_a, "A chart that comes with vfit, by its name.")
            .def_static("load", &load, "context"_a, "json"_a, "A chart of your own, as JSON text.")
            .def("rows", &rows)
            .def("recommend", &recommend, "garment_kind"_a, "measurements"_a,
                 "Every label of that kind with its probability, best first.")
            .def("zones", &zones, "garment_kind"_a, "label"_a, "measurements"_a,
                 "How that size sits, by measure: ease, its sigma, and the probabilities of tight, regular "
                 "and loose."));
    m.def("write_measurements", &write_measurements, "measurements"_a, "sex"_a = py::none(),
          "As JSON text, for an app that keeps them with the person's consent.");
    m.def("read_measurements", &read_measurements, "json"_a, "(measurements, sex) of such a text.");
    m.def("merge_measurements", &merge_measurements, "a"_a, "b"_a, "Two scans of one person in one.");
    m.def("add_to_calibration", &add_to_calibration, "text"_a, "scanned"_a, "taped"_a,
          "A calibration, as JSON text, with one more person; text None: the first one.");
    m.def("calibrated_measures", &calibrated_measures, "text"_a,
          "key -> CalibratedMeasure: people, enough, offset, widening.");
    m.def("calibrate", &calibrate, "text"_a, "measurements"_a,
          "Measures of a scan as the calibration's tape would tell them.");
}

}  // namespace vfit_python
