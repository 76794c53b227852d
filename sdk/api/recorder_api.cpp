// vfit.h, part "recorder".
#include <cmath>

#include "api/context.h"
#include "api/guard.h"
#include "api/structs.h"
#include "record/recorder.h"

using namespace vfit;
using namespace vfit::api;

namespace {

struct RecorderObject : ContextChild {
    static constexpr Kind kKind = Kind::recorder;
    RecorderObject(Ref<Context> owner, const std::string& path, const RecorderDesc& desc)
        : ContextChild(std::move(owner)), recorder(path, desc) {}
    Recorder recorder;
};

}  // namespace

vfit_result vfit_recorder_create(vfit_context handle, const char* path, const vfit_recorder_desc* desc,
                                 vfit_recorder* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        check_pointer(path, "path");
        const vfit_recorder_desc d = read_or_default(desc, "desc");
        if (!std::isfinite(d.rate_hz) || d.rate_hz < 0.0f)
            fail(VFIT_ERROR_ARGUMENT, "desc.rate_hz ", d.rate_hz, " is no rate");
        RecorderDesc settings;
        if (d.sensor_name) settings.sensor_name = d.sensor_name;
        if (d.rate_hz > 0.0f) settings.rate_hz = d.rate_hz;
        settings.segmented = d.segmented != 0;
        out->id = context->publish(Kind::recorder, make<RecorderObject>(context.ref(), path, settings));
        return VFIT_OK;
    });
}

vfit_result vfit_recorder_write(vfit_recorder handle, vfit_frame frame_handle) {
    return guard([&] {
        Use<RecorderObject, Mode::exclusive> recorder(handle.id);
        UseFrame frame(frame_handle);
        recorder->recorder.write(*frame);
        return VFIT_OK;
    });
}

vfit_result vfit_recorder_destroy(vfit_recorder handle) {
    return guard([&] {
        if (handle.id == 0) return VFIT_OK;
        Use<RecorderObject, Mode::exclusive> recorder(handle.id);
        recorder->recorder.close();
        Handles::instance().destroy(handle.id, Kind::recorder);
        return VFIT_OK;
    });
}
