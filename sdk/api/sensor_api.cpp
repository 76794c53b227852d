// vfit.h, part "sensor".
#include "api/context.h"
#include "api/guard.h"
#include "api/structs.h"
#include "sensor/sensor.h"

using namespace vfit;
using namespace vfit::api;

namespace {

struct SensorObject : ContextChild {
    static constexpr Kind kKind = Kind::sensor;
    SensorObject(Ref<Context> owner, Ref<Sensor> s) : ContextChild(std::move(owner)), sensor(std::move(s)) {}
    // Of a handle that was closed, or whose context goes: the device must not outlive it.
    ~SensorObject() override { sensor->close(); }
    const Ref<Sensor> sensor;
};

}  // namespace

vfit_result vfit_sensor_list(vfit_context handle, vfit_sensor_info* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        const auto sensors = context->plugins().discover();
        return write_list(items, stride, count, sensors.size(), [&](size_t i) { return sensors[i]; });
    });
}

vfit_result vfit_sensor_changes(vfit_context handle, uint64_t* count) {
    return guard([&] {
        check_pointer(count, "count");
        UseContext<Mode::any> context(handle);
        *count = context->plugins().changes();
        return VFIT_OK;
    });
}

vfit_result vfit_sensor_open(vfit_context handle, const char* uri, vfit_sensor* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        check_pointer(uri, "uri");
        auto sensor = make<SensorObject>(context.ref(), context->plugins().open(uri));
        out->id = context->publish(Kind::sensor, sensor);
        return VFIT_OK;
    });
}

vfit_result vfit_sensor_modes(vfit_sensor handle, vfit_sensor_mode* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        Use<SensorObject, Mode::read> sensor(handle.id);
        const auto modes = sensor->sensor->modes();
        return write_list(items, stride, count, modes.size(), [&](size_t i) { return modes[i]; });
    });
}

vfit_result vfit_sensor_options(vfit_sensor handle, vfit_sensor_option* items, uint32_t stride,
                                uint32_t* count) {
    return guard([&] {
        Use<SensorObject, Mode::read> sensor(handle.id);
        const auto options = sensor->sensor->options();
        return write_list(items, stride, count, options.size(), [&](size_t i) { return options[i]; });
    });
}

vfit_result vfit_sensor_set_option(vfit_sensor handle, const char* key, const char* value) {
    return guard([&] {
        Use<SensorObject, Mode::exclusive> sensor(handle.id);
        check_pointer(key, "key");
        check_pointer(value, "value");
        sensor->sensor->set_option(key, value);
        return VFIT_OK;
    });
}

vfit_result vfit_sensor_start(vfit_sensor handle) {
    return guard([&] {
        Use<SensorObject, Mode::exclusive> sensor(handle.id);
        sensor->sensor->start();
        return VFIT_OK;
    });
}

vfit_result vfit_sensor_stop(vfit_sensor handle) {
    return guard([&] {
        Use<SensorObject, Mode::exclusive> sensor(handle.id);
        sensor->sensor->stop();
        return VFIT_OK;
    });
}

vfit_result vfit_sensor_close(vfit_sensor handle) {
    return guard([&] {
        if (handle.id == 0) return VFIT_OK;
        Use<SensorObject, Mode::any> sensor(handle.id);
        sensor->sensor->close();
        Handles::instance().destroy(handle.id, Kind::sensor);
        return VFIT_OK;
    });
}

vfit_result vfit_sensor_acquire(vfit_sensor handle, int64_t timeout_ns, vfit_frame* out) {
    return guard([&]() -> vfit_result {
        check_pointer(out, "out");
        out->id = 0;
        Use<SensorObject, Mode::any> sensor(handle.id);
        Ref<Frame> frame;
        const vfit_result result = sensor->sensor->acquire(timeout_ns, frame);
        if (result == VFIT_OK) out->id = sensor->context->publish(Kind::frame, frame);
        return result;
    });
}

vfit_result vfit_sensor_describe(vfit_sensor handle, vfit_sensor_stats* out) {
    return guard([&] {
        Use<SensorObject, Mode::any> sensor(handle.id);
        check_output(out, "out");
        write(out, sensor->sensor->describe());
        return VFIT_OK;
    });
}
