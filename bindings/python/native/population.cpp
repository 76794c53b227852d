// Population: from the measures that a person knows to all the others.
#include "context.h"
#include "joints.h"

namespace vfit_python {

namespace {

class Population : public Owned<vfit_population, vfit_population_destroy> {
public:
    using Owned::Owned;
};

std::shared_ptr<Population> open(const Context& context, const std::string& name) {
    vfit_population handle{};
    run([&, h = context.handle()] { return vfit_population_open(h, name.c_str(), &handle); });
    return make<Population>(context.core(), handle);
}

std::shared_ptr<Population> load(const Context& context, const std::string& json) {
    vfit_population handle{};
    run([&, h = context.handle()] { return vfit_population_load(h, json.data(), json.size(), &handle); });
    return make<Population>(context.core(), handle);
}

vfit_person person_in(const py::object& sex, const std::optional<float>& age) {
    vfit_person person = vfit_person_init();
    person.sex = sex_in(sex);
    person.age_years = age.value_or(0.0f);
    return person;
}

py::dict estimate(const Population& population, const py::object& known, const py::object& sex,
                  const std::optional<float>& age) {
    const std::vector<vfit_measurement> given = measurements_in(known);
    const vfit_person person = person_in(sex, age);
    return measurements_out(
        list<vfit_measurement>([&, p = population.get()](auto* items, uint32_t stride, uint32_t* n) {
            return vfit_population_estimate(p, &person, given.data(), sizeof(vfit_measurement),
                                            static_cast<uint32_t>(given.size()), items, stride, n);
        }));
}

py::list check_known(const Population& population, const py::object& known, const py::object& sex,
                     const std::optional<float>& age) {
    const std::vector<vfit_measurement> given = measurements_in(known);
    const vfit_person person = person_in(sex, age);
    py::list out;
    for (const vfit_doubt& d :
         list<vfit_doubt>([&, p = population.get()](auto* items, uint32_t stride, uint32_t* n) {
             return vfit_population_check(p, &person, given.data(), sizeof(vfit_measurement),
                                          static_cast<uint32_t>(given.size()), items, stride, n);
         }))
        out.append(value("Doubt", field(d.key), value("DoubtKind", d.kind), d.value, d.suggested, d.expected,
                         d.sigma, field(d.other_key)));
    return out;
}

}  // namespace

void bind_population(py::module_& m) {
    closable(py::class_<Population, std::shared_ptr<Population>>(
                 m, "Population", "How the measures of people go together (docs/measuring.md).")
                 .def_static("open", &open, "context"_a, "name"_a, "One that comes with vfit: \"adults\".")
                 .def_static("load", &load, "context"_a, "json"_a, "One of your own, as JSON text.")
                 .def("estimate", &estimate, "known"_a, "sex"_a = py::none(), "age"_a = py::none(),
                      "Every measure of a person of whom these are known.")
                 .def("check", &check_known, "known"_a, "sex"_a = py::none(), "age"_a = py::none(),
                      "Measures that do not go with the others, the worst first."));
}

}  // namespace vfit_python
