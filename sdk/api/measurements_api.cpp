// vfit.h, part "scan -> measurements -> size": measurements that an app keeps.
#include <algorithm>

#include "anthropometry/calibration.h"
#include "anthropometry/profile.h"
#include "api/guard.h"
#include "api/measurements.h"
#include "core/wipe.h"

using namespace vfit;
using namespace vfit::api;

namespace {

constexpr uint64_t kMaxProfileBytes = 1u << 20, kMaxCalibrationBytes = 64u << 20;

void check_sex(vfit_sex sex) { check_enum(sex, VFIT_SEX_MALE, "sex"); }

/// Body data: `written` is overwritten.
void write_text(std::string& written, char* text, uint32_t* capacity) {
    const auto need = static_cast<uint32_t>(written.size() + 1);
    const bool fits = text && *capacity >= need;
    if (fits) std::copy_n(written.c_str(), need, text);
    const uint32_t given = *capacity;
    *capacity = need;
    wipe(std::span(written));
    if (text && !fits) fail(VFIT_ERROR_CAPACITY, "capacity ", given, ": the text has ", need, " bytes");
}

Calibration calibration_in(const void* text, uint64_t byte_count) {
    check_pointer(text, "text");
    if (byte_count > kMaxCalibrationBytes)
        fail(VFIT_ERROR_ARGUMENT, "byte_count ", byte_count, " is too large");
    return Calibration::parse({static_cast<const char*>(text), static_cast<size_t>(byte_count)});
}

}  // namespace

vfit_result vfit_measurements_write(const vfit_measurement* items, uint32_t stride, uint32_t count,
                                    vfit_sex sex, char* text, uint32_t* capacity) {
    return guard([&] {
        check_pointer(capacity, "capacity");
        check_sex(sex);
        std::string written = profile_text({sex, measurements_in(items, stride, count)});
        write_text(written, text, capacity);
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

vfit_result vfit_calibration_add(const void* text, uint64_t byte_count, const vfit_measurement* scanned,
                                 uint32_t scanned_stride, uint32_t scanned_count,
                                 const vfit_measurement* taped, uint32_t taped_stride, uint32_t taped_count,
                                 char* out, uint32_t* capacity) {
    return guard([&] {
        check_pointer(capacity, "capacity");
        Calibration calibration;
        if (text || byte_count) calibration = calibration_in(text, byte_count);
        calibration.add(measurements_in(scanned, scanned_stride, scanned_count),
                        measurements_in(taped, taped_stride, taped_count));
        std::string written = calibration.text();
        write_text(written, out, capacity);
        return VFIT_OK;
    });
}

vfit_result vfit_calibration_measures(const void* text, uint64_t byte_count, vfit_calibrated_measure* items,
                                      uint32_t stride, uint32_t* count) {
    return guard([&] {
        const std::vector<CalibratedMeasure> list = calibration_in(text, byte_count).measures();
        return write_list(items, stride, count, list.size(), [&](size_t i) {
            vfit_calibrated_measure m{};
            m.people = list[i].people;
            m.enough = list[i].enough;
            m.offset = list[i].offset;
            m.widening = list[i].widening;
            set_text(m.key, list[i].key);
            return m;
        });
    });
}

vfit_result vfit_calibration_apply(const void* text, uint64_t byte_count, const vfit_measurement* scanned,
                                   uint32_t scanned_stride, uint32_t scanned_count, vfit_measurement* items,
                                   uint32_t stride, uint32_t* count) {
    return guard([&] {
        const Calibration calibration = calibration_in(text, byte_count);
        return write_measurements(calibration.apply(measurements_in(scanned, scanned_stride, scanned_count)),
                                  items, stride, count);
    });
}
