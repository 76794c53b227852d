// vfit.h, part "scan -> measurements -> size": what the measures that a person knows make likely of the
// others.
#include "anthropometry/measure_doubts.h"
#include "anthropometry/population_model.h"
#include "api/context.h"
#include "api/guard.h"
#include "api/measurements.h"
#include "core/files.h"

using namespace vfit;
using namespace vfit::api;

namespace {

constexpr size_t kMaxPopulationBytes = 1u << 20;

struct PopulationObject : ContextChild {
    static constexpr Kind kKind = Kind::population;
    PopulationObject(Ref<Context> owner, PopulationModel m)
        : ContextChild(std::move(owner)), model(std::move(m)) {}
    const PopulationModel model;
};

PopulationModel parsed(std::span<const std::byte> bytes) {
    return PopulationModel::parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Person person_in(const vfit_person* in) {
    const vfit_person given = read_or_default(in, "person");
    check_enum(given.sex, VFIT_SEX_MALE, "person.sex");
    Person person{given.sex, {}};
    if (given.age_years != 0.0f) person.age_years = given.age_years;
    return person;
}

}  // namespace

vfit_result vfit_population_list(vfit_context handle, vfit_data_name* items, uint32_t stride,
                                 uint32_t* count) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        return write_data_names(data_names(context->data_dir, "populations"), items, stride, count);
    });
}

vfit_result vfit_population_load(vfit_context handle, const void* bytes, uint64_t byte_count,
                                 vfit_population* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        check_pointer(bytes, "bytes");
        if (byte_count > kMaxPopulationBytes)
            fail(VFIT_ERROR_ARGUMENT, "byte_count ", byte_count, " is too large");
        auto model = parsed({static_cast<const std::byte*>(bytes), static_cast<size_t>(byte_count)});
        out->id = context->publish(Kind::population, make<PopulationObject>(context.ref(), std::move(model)));
        return VFIT_OK;
    });
}

vfit_result vfit_population_open(vfit_context handle, const char* name, vfit_population* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        check_pointer(name, "name");
        auto model =
            parsed(read_file(data_file(context->data_dir, "populations", name), kMaxPopulationBytes));
        out->id = context->publish(Kind::population, make<PopulationObject>(context.ref(), std::move(model)));
        return VFIT_OK;
    });
}

vfit_result vfit_population_destroy(vfit_population population) {
    return guard([&] {
        destroy<PopulationObject>(population.id);
        return VFIT_OK;
    });
}

vfit_result vfit_population_estimate(vfit_population handle, const vfit_person* person,
                                     const vfit_measurement* known, uint32_t known_stride,
                                     uint32_t known_count, vfit_measurement* items, uint32_t stride,
                                     uint32_t* count) {
    return guard([&] {
        Use<PopulationObject, Mode::read> population(handle.id);
        return write_measurements(
            population->model.estimate(person_in(person), measurements_in(known, known_stride, known_count)),
            items, stride, count);
    });
}

vfit_result vfit_population_check(vfit_population handle, const vfit_person* person,
                                  const vfit_measurement* known, uint32_t known_stride, uint32_t known_count,
                                  vfit_doubt* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        Use<PopulationObject, Mode::read> population(handle.id);
        const auto doubts = find_doubts(population->model, person_in(person),
                                        measurements_in(known, known_stride, known_count));
        return write_list(items, stride, count, doubts.size(), [&](size_t i) {
            vfit_doubt d{};
            d.kind = doubts[i].kind;
            d.value = doubts[i].value;
            d.suggested = doubts[i].suggested;
            d.expected = doubts[i].expected;
            d.sigma = doubts[i].sigma;
            set_text(d.key, doubts[i].key);
            set_text(d.other_key, doubts[i].other_key);
            return d;
        });
    });
}
