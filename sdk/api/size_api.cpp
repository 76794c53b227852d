// vfit.h, part "scan -> measurements -> size": charts and recommendation.
#include "api/context.h"
#include "api/guard.h"
#include "api/measurements.h"
#include "core/files.h"
#include "size/recommend.h"
#include "size/size_chart.h"

using namespace vfit;
using namespace vfit::api;

namespace {

constexpr size_t kMaxChartBytes = 16u << 20;

struct SizeChartObject : ContextChild {
    static constexpr Kind kKind = Kind::size_chart;
    SizeChartObject(Ref<Context> owner, SizeChart c) : ContextChild(std::move(owner)), chart(std::move(c)) {}
    const SizeChart chart;
};

std::string_view as_text(const std::byte* bytes, size_t count) {
    return {reinterpret_cast<const char*>(bytes), count};
}

}  // namespace

vfit_result vfit_size_chart_list(vfit_context handle, vfit_data_name* items, uint32_t stride,
                                 uint32_t* count) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        return write_data_names(data_names(context->data_dir, "charts"), items, stride, count);
    });
}

vfit_result vfit_size_chart_load(vfit_context handle, const void* bytes, uint64_t byte_count,
                                 vfit_size_chart* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        check_pointer(bytes, "bytes");
        if (byte_count > kMaxChartBytes)
            fail(VFIT_ERROR_ARGUMENT, "byte_count ", byte_count, " is too large");
        const auto text = as_text(static_cast<const std::byte*>(bytes), static_cast<size_t>(byte_count));
        out->id =
            context->publish(Kind::size_chart, make<SizeChartObject>(context.ref(), SizeChart::parse(text)));
        return VFIT_OK;
    });
}

vfit_result vfit_size_chart_open(vfit_context handle, const char* name, vfit_size_chart* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        check_pointer(name, "name");
        const auto bytes = read_file(data_file(context->data_dir, "charts", name), kMaxChartBytes);
        auto chart = SizeChart::parse(as_text(bytes.data(), bytes.size()));
        out->id = context->publish(Kind::size_chart, make<SizeChartObject>(context.ref(), std::move(chart)));
        return VFIT_OK;
    });
}

vfit_result vfit_size_chart_destroy(vfit_size_chart chart) {
    return guard([&] {
        destroy<SizeChartObject>(chart.id);
        return VFIT_OK;
    });
}

vfit_result vfit_size_chart_rows(vfit_size_chart handle, vfit_size_row* items, uint32_t stride,
                                 uint32_t* count) {
    return guard([&] {
        Use<SizeChartObject, Mode::read> chart(handle.id);
        std::vector<vfit_size_row> rows;
        for (const GarmentSizes& garment : chart->chart.garments())
            for (const auto& size : garment.sizes) {
                vfit_size_row row{};
                row.measure_count = static_cast<uint32_t>(garment.measures.size());
                set_text(row.garment_kind, garment.kind);
                set_text(row.label, size.label);
                rows.push_back(row);
            }
        return write_list(items, stride, count, rows.size(), [&](size_t i) { return rows[i]; });
    });
}

vfit_result vfit_size_recommend(vfit_size_chart handle, const char* garment_kind,
                                const vfit_measurement* items, uint32_t stride, uint32_t count,
                                vfit_size* sizes, uint32_t size_stride, uint32_t* size_count) {
    return guard([&] {
        Use<SizeChartObject, Mode::read> chart(handle.id);
        check_pointer(garment_kind, "garment_kind");
        const auto list = recommend(chart->chart, garment_kind, measurements_in(items, stride, count));
        return write_list(sizes, size_stride, size_count, list.size(), [&](size_t i) {
            vfit_size size{};
            size.probability = list[i].probability;
            set_text(size.label, list[i].label);
            return size;
        });
    });
}

vfit_result vfit_size_zones(vfit_size_chart handle, const char* garment_kind, const char* label,
                            const vfit_measurement* items, uint32_t stride, uint32_t count,
                            vfit_size_zone* zones, uint32_t zone_stride, uint32_t* zone_count) {
    return guard([&] {
        Use<SizeChartObject, Mode::read> chart(handle.id);
        check_pointer(garment_kind, "garment_kind");
        check_pointer(label, "label");
        const auto list =
            size_zones(chart->chart, garment_kind, label, measurements_in(items, stride, count));
        return write_list(zones, zone_stride, zone_count, list.size(), [&](size_t i) {
            vfit_size_zone zone{};
            zone.ease = list[i].ease;
            zone.sigma = list[i].sigma;
            zone.tight = list[i].tight;
            zone.regular = list[i].regular;
            zone.loose = list[i].loose;
            set_text(zone.key, list[i].key);
            return zone;
        });
    });
}
