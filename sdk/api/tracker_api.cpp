// vfit.h, part "bodies and tracker".
#include "api/bodies.h"
#include "api/context.h"
#include "api/guard.h"
#include "core/clock.h"
#include "frame/floor.h"

using namespace vfit;
using namespace vfit::api;

namespace {

constexpr size_t kMaxBodies = 8;  // of one frame

struct TrackerObject : ContextChild {
    static constexpr Kind kKind = Kind::tracker;
    using ContextChild::ContextChild;

    bool has_floor = false;  // of the description, or estimated from the first body
    Camera floor;

    /// The camera of a frame whose source does not know the floor gets the tracker's.
    void place(Camera& camera) const {
        if (!has_floor || camera.floor_state == VFIT_FLOOR_GIVEN) return;
        camera.floor_state = floor.floor_state;
        camera.floor_normal = floor.floor_normal;
        camera.floor_distance_m = floor.floor_distance_m;
    }
};

Ref<Frame> tracked_frame(Context& context, const Ref<Frame>& base) {
    Ref<Frame> tracked = Context::take_frame(*context.frames);
    tracked->base = base;
    tracked->time_ns = base->time_ns;
    tracked->camera = base->camera;
    return tracked;
}

}  // namespace

vfit_result vfit_frame_bodies(vfit_frame handle, vfit_body* items, uint32_t stride, uint32_t* count) {
    return guard([&] {
        UseFrame frame(handle);
        return write_list(items, stride, count, frame->bodies.size(), [&](size_t i) {
            const Body& body = frame->bodies[i];
            vfit_body out{};
            out.body_id = body.id;
            out.time_ns = body.time_ns;
            out.flags = body.flags;
            return out;
        });
    });
}

vfit_result vfit_frame_joints(vfit_frame handle, uint32_t body_id, vfit_joint* items, uint32_t stride,
                              uint32_t* count) {
    return guard([&] {
        UseFrame frame(handle);
        const Body* body = frame->body(body_id);
        if (!body) fail(VFIT_ERROR_ARGUMENT, "the frame has no body ", body_id);
        return write_joints(*body, frame.context().axes, items, stride, count);
    });
}

vfit_result vfit_tracker_create(vfit_context handle, const vfit_tracker_desc* desc, vfit_tracker* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        const vfit_tracker_desc d = read_or_default(desc, "desc");
        auto tracker = make<TrackerObject>(context.ref());
        if (d.floor) {
            const vfit_camera c = read(d.floor, "desc.floor");
            tracker->floor.width = tracker->floor.height = 1;  // only the floor counts here
            tracker->floor.fx = tracker->floor.fy = 1.0f;
            tracker->floor.floor_state = VFIT_FLOOR_GIVEN;
            tracker->floor.floor_normal = {c.floor_normal[0], c.floor_normal[1], c.floor_normal[2]};
            tracker->floor.floor_distance_m = c.floor_distance_m;
            validate(tracker->floor);
            tracker->has_floor = true;
        }
        out->id = context->publish(Kind::tracker, tracker);
        return VFIT_OK;
    });
}

vfit_result vfit_tracker_destroy(vfit_tracker tracker) {
    return guard([&] {
        Handles::instance().destroy(tracker.id, Kind::tracker);
        return VFIT_OK;
    });
}

vfit_result vfit_tracker_reset(vfit_tracker handle) {
    return guard([&] {
        Use<TrackerObject, Mode::exclusive> tracker(handle.id);
        if (tracker->floor.floor_state != VFIT_FLOOR_GIVEN) tracker->has_floor = false;
        return VFIT_OK;
    });
}

vfit_result vfit_tracker_update(vfit_tracker handle, vfit_frame frame_handle, vfit_frame* tracked) {
    return guard([&] {
        check_pointer(tracked, "tracked");
        tracked->id = 0;
        Use<TrackerObject, Mode::exclusive> tracker(handle.id);
        UseFrame frame(frame_handle);
        Profile::Scope time(tracker->context->profile, Stage::track);
        // A source that tells its bodies may have nobody in view; one that knows of none needs a tracker.
        if (frame->bodies.empty() && !frame->meta("bodies"))
            fail(VFIT_ERROR_UNSUPPORTED,
                 "the frame's source supplies no bodies, and this version finds no skeleton by itself: "
                 "use a source with joints, or vfit_tracker_submit");
        Ref<Frame> out = tracked_frame(*tracker->context, frame.ref());
        out->bodies = frame->bodies;
        tracked->id = tracker->context->publish(Kind::frame, out);
        return VFIT_OK;
    });
}

vfit_result vfit_tracker_submit(vfit_tracker handle, vfit_frame frame_handle, const vfit_body* body,
                                const vfit_joint* items, uint32_t stride, uint32_t count,
                                vfit_frame* tracked) {
    return guard([&] {
        check_pointer(tracked, "tracked");
        tracked->id = 0;
        Use<TrackerObject, Mode::exclusive> tracker(handle.id);
        UseFrame frame(frame_handle);
        Profile::Scope time(tracker->context->profile, Stage::track);
        Body in = body_in(read(body, "body"), read_array(items, stride, count, "items"), tracker->context->axes);
        if (frame->body(in.id)) fail(VFIT_ERROR_ARGUMENT, "the frame has a body ", in.id, " already");
        if (frame->bodies.size() == kMaxBodies)
            fail(VFIT_ERROR_CAPACITY, "a frame holds at most ", kMaxBodies, " bodies");
        if (in.time_ns == 0) in.time_ns = frame->time_ns;

        Ref<Frame> out = tracked_frame(*tracker->context, frame.ref());
        if ((in.flags & VFIT_BODY_CAMERA_SPACE) != 0) {
            in.flags &= ~uint32_t(VFIT_BODY_CAMERA_SPACE);
            if (!tracker->has_floor && out->camera.floor_state == VFIT_FLOOR_DEFAULT) {
                tracker->floor = out->camera;
                tracker->has_floor = estimate_floor(tracker->floor, in);
            }
            tracker->place(out->camera);
            in = to_world(in, out->camera);
        } else {
            tracker->place(out->camera);
        }
        out->bodies = frame->bodies;
        out->bodies.push_back(in);
        tracked->id = tracker->context->publish(Kind::frame, out);
        return VFIT_OK;
    });
}
