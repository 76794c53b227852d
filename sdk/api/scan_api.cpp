// vfit.h, part "scan -> measurements -> size": the scan.
#include <algorithm>

#include "api/bodies.h"
#include "api/guard.h"
#include "api/measurements.h"
#include "api/scan_object.h"
#include "frame/floor.h"

using namespace vfit;
using namespace vfit::api;

namespace {

constexpr uint32_t kPaperFrames = 30;  // Alg. 4
constexpr uint32_t kMaxFrames = 3000;
constexpr uint32_t kMaxCameras = 8;

/// What the scanned person's avatar will need is made ready before the capture, so that the person does not
/// wait for it after. A context without a body can still scan; it will be told when it asks for an avatar.
void prepare_avatar(Context& context, vfit_sex sex) {
    try {
        context.default_measures(sex);
    } catch (const Error& error) {
        context.log.info("no avatar can be made of this scan: ", error.what());
    }
}

void require_frames(const ScanObject& scan) {
    if (scan.scan.frames_taken() == 0) fail(VFIT_ERROR_STATE, "the scan has taken no frame yet");
}

}  // namespace

vfit_result vfit_scan_create(vfit_context handle, const vfit_scan_desc* desc, vfit_scan* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        const vfit_scan_desc d = read_or_default(desc, "desc");
        check_enum(d.method, VFIT_SCAN_FIT, "method");
        check_enum(d.sex, VFIT_SEX_MALE, "sex");
        for (const auto& [name, count] :
             {std::pair("frame_count", d.frame_count), {"side_frame_count", d.side_frame_count}})
            if (count > kMaxFrames) fail(VFIT_ERROR_ARGUMENT, name, " ", count, " is more than ", kMaxFrames);
        if (d.flags & ~uint32_t{VFIT_SCAN_BARE | VFIT_SCAN_TIGHT | VFIT_SCAN_TURN})
            fail(VFIT_ERROR_ARGUMENT, "flags ", d.flags, ": unknown bits");
        if (d.camera_count > kMaxCameras)
            fail(VFIT_ERROR_ARGUMENT, "camera_count ", d.camera_count, " is more than ", kMaxCameras);
        if (d.camera_count > 1 && (d.flags & VFIT_SCAN_TURN))
            fail(VFIT_ERROR_ARGUMENT, "camera_count ", d.camera_count,
                 " with VFIT_SCAN_TURN: a turn is seen by one camera");
        const bool by_fit = d.method == VFIT_SCAN_FIT || d.method == VFIT_SCAN_DEFAULT;
        if (d.camera_count > 1 && !by_fit)
            fail(VFIT_ERROR_ARGUMENT, "camera_count ", d.camera_count,
                 ": the paper's method measures by one camera");
        PersonScanDesc settings;
        if (d.method == VFIT_SCAN_PROPORTIONS_AS_PRINTED) settings.paper = ScanDesc::as_printed();
        settings.paper.frame_count = d.frame_count ? d.frame_count : kPaperFrames;
        settings.paper.sex = d.sex;
        settings.paper.camera_count = std::max(d.camera_count, 1u);
        if (by_fit) {
            settings.measure_model = context->measure_model();
            settings.fit_model = context->fit_model().get();
            settings.side_frame_count = d.side_frame_count;
            settings.bare = (d.flags & VFIT_SCAN_BARE) != 0;
            settings.tight = (d.flags & VFIT_SCAN_TIGHT) != 0;
            settings.turn = (d.flags & VFIT_SCAN_TURN) != 0;
        }
        prepare_avatar(*context, d.sex);
        out->id = context->publish(Kind::scan, make<ScanObject>(context.ref(), settings));
        return VFIT_OK;
    });
}

vfit_result vfit_scan_destroy(vfit_scan scan) {
    return guard([&] {
        destroy<ScanObject>(scan.id);
        return VFIT_OK;
    });
}

vfit_result vfit_scan_reset(vfit_scan handle) {
    return guard([&] {
        Use<ScanObject, Mode::exclusive> scan(handle.id);
        scan->forget();
        return VFIT_OK;
    });
}

vfit_result vfit_scan_extend(vfit_scan handle, uint32_t frames, uint32_t side_frames) {
    return guard([&] {
        Use<ScanObject, Mode::exclusive> scan(handle.id);
        const auto too_many = [](uint32_t wanted, uint32_t more) {
            return more > kMaxFrames || wanted + more > kMaxFrames;
        };
        if (too_many(scan->scan.frames_wanted(), frames) ||
            too_many(scan->scan.side_frames_wanted(), side_frames))
            fail(VFIT_ERROR_ARGUMENT, "frames ", frames, ", side_frames ", side_frames,
                 ": the scan would want more than ", kMaxFrames);
        scan->scan.extend(frames, side_frames);
        return VFIT_OK;
    });
}

vfit_result vfit_scan_add(vfit_scan handle, vfit_frame tracked, uint32_t body_id, vfit_scan_state* state) {
    return vfit_scan_add_from(handle, 0, tracked, body_id, state);
}

vfit_result vfit_scan_add_from(vfit_scan handle, uint32_t camera, vfit_frame tracked, uint32_t body_id,
                               vfit_scan_state* state) {
    return guard([&]() -> vfit_result {
        Use<ScanObject, Mode::exclusive> scan(handle.id);
        if (camera >= scan->scan.camera_count())
            fail(VFIT_ERROR_ARGUMENT, "camera ", camera, ": the scan was made for ",
                 scan->scan.camera_count(), ", numbered from 0");
        UseFrame frame(tracked);
        if (state) check_output(state, "state");
        vfit_scan_state out{};
        out.frames_wanted = scan->scan.frames_wanted();
        out.frames_taken = scan->scan.frames_taken();
        out.side_frames_wanted = scan->scan.side_frames_wanted();
        out.side_frames_taken = scan->scan.side_frames_taken();
        out.turn_wanted = scan->scan.turn_wanted();
        out.turn_seen = scan->scan.turn_seen();
        vfit_result result = VFIT_OK;
        if (!scan->scan.complete()) {
            Profile::Scope time(scan->context->profile, Stage::measure);
            const DepthImage image = frame->depth_image();
            if (!image.users)
                fail(VFIT_ERROR_UNSUPPORTED,
                     "the frame has no user map: its source supplies none, and "
                     "vfit_tracker_update, which makes one, did not see it");
            Body camera_space;
            const Body* body = frame->body(body_id);
            if (body) camera_space = to_camera(*body, frame->camera);
            ScanFrame in{};
            in.image = image;
            in.body = body ? &camera_space : nullptr;
            in.person_count = static_cast<uint32_t>(frame->bodies.size());
            in.camera = camera;
            const ScanProgress progress = scan->scan.add(in);
            out.frames_taken = progress.frames_taken;
            out.side_frames_taken = scan->scan.side_frames_taken();
            out.turn_seen = scan->scan.turn_seen();
            out.guidance = progress.guidance;
            out.correction_m = progress.correction_m;
            out.compute_ms = static_cast<float>(progress.compute_ms);
            if (progress.taken) {
                scan->last_colliders.clear();
                for (int id = 0; id < kPaperJointCount; ++id)
                    if (body->has(id))
                        scan->last_colliders.push_back({id, body->at(id), 0.0f, -1, Vec3(0.0f), 0.0f});
            }
            result = !progress.taken ? VFIT_INCOMPLETE : !scan->scan.complete() ? VFIT_NOT_READY : VFIT_OK;
        }
        if (state) write(state, out);
        return result;
    });
}

vfit_result vfit_scan_measure(vfit_scan handle, vfit_measurement* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        Use<ScanObject, Mode::read> scan(handle.id);
        require_frames(*scan);
        return write_measurements(scan->scan.measurements(), items, stride, count);
    });
}

vfit_result vfit_scan_sex(vfit_scan handle, vfit_sex* sex, float* probability) {
    return guard([&] {
        Use<ScanObject, Mode::read> scan(handle.id);
        check_pointer(sex, "sex");
        require_frames(*scan);
        const InferredSex inferred = scan->scan.inferred_sex();
        *sex = inferred.sex;
        if (probability) *probability = inferred.probability;
        return VFIT_OK;
    });
}

vfit_result vfit_scan_colliders(vfit_scan handle, vfit_collider* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        Use<ScanObject, Mode::read> scan(handle.id);
        require_frames(*scan);
        std::vector<Collider> spheres = scan->last_colliders;
        const auto radii = scan->scan.paper().radii();
        for (Collider& c : spheres) c.radius = radii[static_cast<size_t>(c.joint)];
        return write_colliders(spheres, scan->context->axes, items, stride, count);
    });
}

vfit_result vfit_scan_scale(vfit_scan handle, const char* garment_kind, vfit_scale* out) {
    return guard([&] {
        Use<ScanObject, Mode::read> scan(handle.id);
        check_pointer(garment_kind, "garment_kind");
        check_output(out, "out");
        require_frames(*scan);
        const PaperScan::Scale s = scan->scan.paper().scale(garment_kind);
        vfit_scale scale{};
        scale.x = s.x;
        scale.y = s.y;
        scale.sigma_x = s.sigma_x;
        scale.sigma_y = s.sigma_y;
        scale.width_m = s.width_m;
        scale.height_m = s.height_m;
        write(out, scale);
        return VFIT_OK;
    });
}
