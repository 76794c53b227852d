// vfit.h, part "scan -> measurements -> size": measurements that an app keeps.
#include <algorithm>

#include "api/guard.h"
#include "api/measurements.h"
#include "core/wipe.h"
#include "measure/profile.h"

using namespace vfit;
using namespace vfit::api;

namespace {

constexpr uint64_t kMaxProfileBytes = 1u << 20;

void check_sex(vfit_sex sex) { check_enum(sex, VFIT_SEX_MALE, "sex"); }

}  // namespace

vfit_result vfit_measurements_write(const vfit_measurement* items, uint32_t stride, uint32_t count,
                                    vfit_sex sex, char* text, uint32_t* capacity) {
    return guard([&]() -> vfit_result {
        check_pointer(capacity, "capacity");
        check_sex(sex);
        std::string written = profile_text({sex, measurements_in(items, stride, count)});
        const auto need = static_cast<uint32_t>(written.size() + 1);
        const bool fits = text && *capacity >= need;
        if (fits) std::copy_n(written.c_str(), need, text);
        const uint32_t given = *capacity;
        *capacity = need;
        wipe(std::span(written));
        if (text && !fits) fail(VFIT_ERROR_CAPACITY, "capacity ", given, ": the text has ", need, " bytes");
        return VFIT_OK;
    });
}

vfit_result vfit_measurements_read(const void* text, uint64_t byte_count, vfit_measurement* items,
                                   uint32_t stride, uint32_t* count, vfit_sex* sex) {
    return guard([&] {
        check_pointer(text, "text");
        check_pointer(count, "count");
        if (byte_count > kMaxProfileBytes)
            fail(VFIT_ERROR_ARGUMENT, "byte_count ", byte_count, " is too large");
        const auto profile = parse_profile({static_cast<const char*>(text), static_cast<size_t>(byte_count)});
        const vfit_result result = write_measurements(profile.measurements, items, stride, count);
        if (sex) *sex = profile.sex;
        return result;
    });
}

vfit_result vfit_measurements_merge(const vfit_measurement* a, uint32_t a_stride, uint32_t a_count,
                                    const vfit_measurement* b, uint32_t b_stride, uint32_t b_count,
                                    vfit_measurement* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        const auto both = merge(measurements_in(a, a_stride, a_count), measurements_in(b, b_stride, b_count));
        return write_measurements(both, items, stride, count);
    });
}
