// vfit.h, part "context" and the vocabularies.
#include "anthropometry/measure_keys.h"
#include "api/context.h"
#include "api/guard.h"
#include "api/structs.h"
#include "body/skeleton.h"
#include "core/clock.h"
#include "math/simd.h"

using namespace vfit;
using namespace vfit::api;

uint32_t vfit_version(void) { return VFIT_VERSION; }

vfit_result vfit_library_describe(vfit_library_info* out) {
    return guard([&] {
        check_output(out, "out");
        vfit_library_info info{};
        info.version = VFIT_VERSION;
        set_text(info.simd, simd_level());
        set_text(info.build, VFIT_BUILD_TEXT);
        write(out, info);
        return VFIT_OK;
    });
}

const char* vfit_result_name(vfit_result result) {
    switch (result) {
        case VFIT_OK: return "OK";
        case VFIT_NOT_READY: return "NOT_READY";
        case VFIT_TIMEOUT: return "TIMEOUT";
        case VFIT_INCOMPLETE: return "INCOMPLETE";
        case VFIT_END_OF_STREAM: return "END_OF_STREAM";
        case VFIT_ERROR_UNKNOWN: return "ERROR_UNKNOWN";
        case VFIT_ERROR_ARGUMENT: return "ERROR_ARGUMENT";
        case VFIT_ERROR_HANDLE: return "ERROR_HANDLE";
        case VFIT_ERROR_STATE: return "ERROR_STATE";
        case VFIT_ERROR_BUSY: return "ERROR_BUSY";
        case VFIT_ERROR_CAPACITY: return "ERROR_CAPACITY";
        case VFIT_ERROR_UNSUPPORTED: return "ERROR_UNSUPPORTED";
        case VFIT_ERROR_VERSION: return "ERROR_VERSION";
        case VFIT_ERROR_OUT_OF_MEMORY: return "ERROR_OUT_OF_MEMORY";
        case VFIT_ERROR_IO: return "ERROR_IO";
        case VFIT_ERROR_DATA: return "ERROR_DATA";
        case VFIT_ERROR_NOT_WEARABLE: return "ERROR_NOT_WEARABLE";
        case VFIT_ERROR_DEVICE_LOST: return "ERROR_DEVICE_LOST";
        case VFIT_ERROR_PLUGIN: return "ERROR_PLUGIN";
        default: return "?";
    }
}

uint32_t vfit_last_error(char* buffer, uint32_t capacity) {
    return write_text(last_error().data(), last_error().size(), buffer, capacity);
}

vfit_result vfit_context_create(const vfit_context_desc* desc, vfit_context* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        const vfit_context_desc d = read(desc, "desc");
        // Within 0.x a change of the minor version may break; from 1.0 on only the major one does.
        if (d.api_version >> 12 != VFIT_VERSION >> 12)
            fail(VFIT_ERROR_VERSION, "api_version ", d.api_version >> 22, ".", d.api_version >> 12 & 0x3FF,
                 " was asked for, this library is ", VFIT_VERSION >> 22, ".", VFIT_VERSION >> 12 & 0x3FF);
        check_flags(d.flags, VFIT_CONTEXT_VALIDATE | VFIT_CONTEXT_DETERMINISTIC | VFIT_CONTEXT_MIRROR,
                    "flags");
        check_enum(d.axes, VFIT_AXES_UNREAL, "axes");
        if (!d.submit != !d.wait) fail(VFIT_ERROR_ARGUMENT, "submit and wait must be given together");
        if (d.worker_count > 256)
            fail(VFIT_ERROR_ARGUMENT, "worker_count ", d.worker_count, " is more than 256");
        auto context = make<Context>(d);
        context->id = Handles::instance().add(Kind::context, context, 0);
        out->id = context->id;
        return VFIT_OK;
    });
}

vfit_result vfit_context_destroy(vfit_context context) {
    return guard([&] {
        if (context.id == 0) return VFIT_OK;
        const Ref<Object> object = Handles::instance().get(context.id, Kind::context);
        static_cast<Context*>(object.get())->close();
        return VFIT_OK;
    });
}

vfit_result vfit_shutdown(void) {
    return guard([&] {
        const auto contexts = [] { return Handles::instance().children(0, Kind::context); };
        // A plug-in may work with a context of its own until its device is closed, which takes that context
        // along.
        std::vector<Ref<Object>> live;
        for (const uint64_t id : contexts()) live.push_back(Handles::instance().get(id, Kind::context));
        for (const Ref<Object>& context : live) static_cast<Context*>(context.get())->end_streams();
        vfit_result first = VFIT_OK;
        for (const uint64_t id : contexts()) {
            const vfit_result result = vfit_context_destroy(vfit_context{id});
            if (first == VFIT_OK) first = result;
        }
        return first;
    });
}

vfit_result vfit_context_describe(vfit_context handle, vfit_context_stats* out) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        check_output(out, "out");
        vfit_context_stats stats{};
        stats.handle_count = Handles::instance().count_below(handle.id);
        const auto frames = Handles::instance().children(handle.id, Kind::frame);
        stats.frame_count = static_cast<uint32_t>(frames.size());
        stats.worker_count = context->jobs->concurrency() - 1;
        stats.frame_bytes = context->frame_bytes->count.load();
        write(out, stats);
        return VFIT_OK;
    });
}

vfit_result vfit_context_time(vfit_context handle, int64_t* time_ns) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        check_pointer(time_ns, "time_ns");
        *time_ns = now_ns();
        return VFIT_OK;
    });
}

vfit_result vfit_profile_list(vfit_context handle, vfit_profile* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        return write_list(items, stride, count, Profile::kStages, [&](size_t i) {
            const StageTimes times = context->profile.get(i);
            vfit_profile p{};
            p.calls = static_cast<uint32_t>(std::min<uint64_t>(times.calls, UINT32_MAX));
            p.last_ms = times.last_ms;
            p.mean_ms = times.calls ? times.sum_ms / static_cast<double>(times.calls) : 0.0;
            p.max_ms = times.max_ms;
            set_text(p.stage, Profile::name(i));
            return p;
        });
    });
}

vfit_result vfit_profile_reset(vfit_context handle) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        context->profile.reset();
        return VFIT_OK;
    });
}

vfit_result vfit_log_next(vfit_context handle, vfit_log_level* level, char* buffer, uint32_t capacity) {
    return guard([&]() -> vfit_result {
        UseContext<Mode::any> context(handle);
        check_pointer(level, "level");
        check_pointer(buffer, "buffer");
        std::string message;
        if (!context->log.next(*level, message)) return VFIT_NOT_READY;
        write_text(message.data(), message.size(), buffer, capacity);
        return VFIT_OK;
    });
}

vfit_result vfit_plugin_load(vfit_context handle, const char* path) {
    return guard([&] {
        UseContext<Mode::exclusive> context(handle);
        check_pointer(path, "path");
        context->plugins().load(path);
        return VFIT_OK;
    });
}

vfit_result vfit_plugin_list(vfit_context handle, vfit_plugin_info* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        const auto plugins = context->plugins().plugins();
        return write_list(items, stride, count, plugins.size(), [&](size_t i) {
            vfit_plugin_info info{};
            info.version = plugins[i].version;
            set_text(info.name, plugins[i].name);
            set_text(info.schemes, plugins[i].schemes);
            set_text(info.path, plugins[i].path);
            return info;
        });
    });
}

uint32_t vfit_joint_name(vfit_joint_id joint, char* buffer, uint32_t capacity) {
    const char* name = joint_name(joint);
    return write_text(name ? name : "", name ? std::strlen(name) : 0, buffer, capacity);
}

uint32_t vfit_bone_name(vfit_bone_id bone, char* buffer, uint32_t capacity) {
    const char* name = bone_name(bone);
    return write_text(name ? name : "", name ? std::strlen(name) : 0, buffer, capacity);
}

int32_t vfit_bone_parent(vfit_bone_id bone) { return bone_parent(bone); }

uint32_t vfit_measure_key(uint32_t index, char* buffer, uint32_t capacity) {
    const auto keys = measure_keys();
    const char* key = index < keys.size() ? keys[index].key : "";
    return write_text(key, std::strlen(key), buffer, capacity);
}

uint32_t vfit_measure_text(uint32_t index, char* buffer, uint32_t capacity) {
    const auto keys = measure_keys();
    const char* words = index < keys.size() ? keys[index].text : "";
    return write_text(words, std::strlen(words), buffer, capacity);
}
