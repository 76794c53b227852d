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

}  // namespace

void bind_size(py::module_& m) {
    closable(
        py::class_<SizeChart, std::shared_ptr<SizeChart>>(m, "SizeChart",
                                                          "A size chart (docs/size-charts.md).")
            .def_static("open", &open, "context"_a, "name"_a, "A chart that comes with vfit, by its name.")
            .def_static("load", &load, "context"_a, "json"_a, "A chart of your own, as JSON text.")
            .def("rows", &rows)
            .def("recommend", &recommend, "garment_kind"_a, "measurements"_a,
                 "Every label of that kind with its probability, best first."));
}

}  // namespace vfit_python
