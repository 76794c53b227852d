// vfit.h, part "avatar and cloth": garments.
#include <span>
#include <string>
#include <vector>

#include "api/garment_object.h"
#include "api/guard.h"
#include "api/structs.h"
#include "core/files.h"

using namespace vfit;
using namespace vfit::api;

namespace {

constexpr size_t kMaxGarmentBytes = 256u << 20;

Ref<GarmentObject> parse(const Ref<Context>& context, std::span<const std::byte> bytes) {
    const FabricLibrary fabrics = FabricLibrary::parse(read_file(context->data_dir + "/fabrics.json"));
    Garment garment = parse_garment(bytes, fabrics);
    const FabricMaterial material = fabrics.get(garment.fabric);
    auto object = make<GarmentObject>(context, std::move(garment), material);
    // Bodies of that detail are usual: to bind it now saves time when clothes are changed.
    object->wearable.bound(0, *context->jobs);
    return object;
}

}  // namespace

vfit_result vfit_garment_list(vfit_context handle, vfit_data_name* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        return write_data_names(data_names(context->data_dir, "garments"), items, stride, count);
    });
}

vfit_result vfit_garment_load(vfit_context handle, const void* bytes, uint64_t byte_count,
                              vfit_garment* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        check_pointer(bytes, "bytes");
        if (byte_count > kMaxGarmentBytes)
            fail(VFIT_ERROR_ARGUMENT, "byte_count ", byte_count, " is too large");
        const std::span<const std::byte> span(static_cast<const std::byte*>(bytes),
                                              static_cast<size_t>(byte_count));
        out->id = context->publish(Kind::garment, parse(context.ref(), span));
        return VFIT_OK;
    });
}

vfit_result vfit_garment_open(vfit_context handle, const char* name, vfit_garment* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        check_pointer(name, "name");
        const auto bytes = read_file(data_file(context->data_dir, "garments", name), kMaxGarmentBytes);
        out->id = context->publish(Kind::garment, parse(context.ref(), bytes));
        return VFIT_OK;
    });
}

vfit_result vfit_garment_destroy(vfit_garment garment) {
    return guard([&] {
        destroy<GarmentObject>(garment.id);
        return VFIT_OK;
    });
}

vfit_result vfit_garment_describe(vfit_garment handle, vfit_garment_info* out) {
    return guard([&] {
        Use<GarmentObject, Mode::read> garment(handle.id);
        check_output(out, "out");
        const Garment& g = garment->wearable.garment();
        vfit_garment_info info{};
        info.vertex_count = g.vertex_count();
        info.simulated_count = g.simulated_count();
        info.size_count = static_cast<uint32_t>(g.sizes.size());
        set_text(info.name, g.name);
        set_text(info.garment_kind, g.kind);
        set_text(info.fabric, g.fabric);
        set_text(info.size_chart, g.size_chart);
        info.body_sex = g.body_sex;
        write(out, info);
        return VFIT_OK;
    });
}

uint32_t vfit_garment_size_label(vfit_garment handle, uint32_t index, char* buffer, uint32_t capacity) {
    uint32_t length = 0;
    const vfit_result result = guard([&] {
        Use<GarmentObject, Mode::read> garment(handle.id);
        const auto& sizes = garment->wearable.garment().sizes;
        const std::string label = index < sizes.size() ? sizes[index].label : "";
        length = write_text(label.data(), label.size(), buffer, capacity);
        return VFIT_OK;
    });
    if (result != VFIT_OK) write_text("", 0, buffer, capacity);
    return length;
}

vfit_result vfit_garment_parts(vfit_garment handle, vfit_garment_part* items, uint32_t stride,
                               uint32_t* count) {
    return guard([&] {
        Use<GarmentObject, Mode::read> garment(handle.id);
        const Garment& g = garment->wearable.garment();
        // A garment that tells of none is one, of one look.
        const std::vector<GarmentPart> whole{
            {"", "", GarmentPart().color, 0, uint32_t(g.mesh.indices.size() / 3)}};
        const std::vector<GarmentPart>& parts = g.parts.empty() ? whole : g.parts;
        return write_list(items, stride, count, parts.size(), [&](size_t i) {
            vfit_garment_part part{};
            part.first_index = 3 * parts[i].first_triangle;
            part.index_count = 3 * parts[i].triangle_count;
            for (int k = 0; k < 3; ++k) part.color[k] = parts[i].color[k];
            set_text(part.material, parts[i].material);
            set_text(part.texture, parts[i].texture);
            return part;
        });
    });
}
