// vfit.h, part "bodies and tracker".
#include <algorithm>
#include <cmath>

#include "api/bodies.h"
#include "api/context.h"
#include "api/guard.h"
#include "fit/people_fit.h"
#include "frame/camera_struct.h"
#include "frame/depth_check.h"
#include "frame/floor.h"
#include "frame/world_align.h"
#include "track/active_person.h"
#include "track/match_bodies.h"
#include "track/perception.h"
#include "track/steady_bodies.h"

using namespace vfit;
using namespace vfit::api;

namespace {

constexpr size_t kMaxBodies = Perception::kMaxBodies;  // of one frame
constexpr float kFarthest_m = 100.0f;                  // of another camera, and of people that it sees

struct TrackerObject : ContextChild {
    static constexpr Kind kKind = Kind::tracker;
    using ContextChild::ContextChild;

    Camera floor;  // its floor_state says whose: GIVEN by the description, ESTIMATED from the first body
    vfit_track_source joints = VFIT_TRACK_AUTO, user_map = VFIT_TRACK_AUTO;
    std::unique_ptr<Perception> own;  // made when first needed
    std::vector<Body> in_camera;
    std::string why_absent;  // as JSON
    ActivePerson active;
    vfit_joint_filter filter = VFIT_FILTER_AUTO;
    SteadyBodies steady;  // joints that are not the tracker's own
    /// What the host says of the people of a frame.
    struct Told {
        std::vector<JointHint> hints;
        std::vector<Body> elsewhere;  // by other cameras, in this one's world space

        void clear() { hints.clear(), elsewhere.clear(); }
    };
    Told told, told_next;  // for this update, for the next one
    Camera seen_by;        // as the last update knew it
    vfit_track_fit fit = VFIT_FIT_AUTO;
    std::shared_future<std::shared_ptr<const FitModel>> fit_model;
    std::unique_ptr<PeopleFit> fits;  // made for the first person
    bool depth_is_right = false;      // a frame had readings that can be depths

    /// The frame is complete as far as it goes.
    void choose_active(Frame& tracked) {
        tracked.active = active.update(tracked.time_ns, tracked.bodies, tracked.camera);
    }
    /// Where the tracker knows more of the floor than the frame's source, the tracker's is taken.
    void place(Camera& camera) const {
        if (floor.floor_state <= camera.floor_state) return;
        camera.floor_state = floor.floor_state;
        camera.floor_normal = floor.floor_normal;
        camera.floor_distance_m = floor.floor_distance_m;
    }
    bool nobody_knows_the_floor(const Camera& camera) const {
        return std::max(floor.floor_state, camera.floor_state) == VFIT_FLOOR_DEFAULT;
    }
    bool makes_map(const DepthImage& image) const {
        return user_map == VFIT_TRACK_BUILT_IN || (user_map == VFIT_TRACK_AUTO && !image.users);
    }
    /// Finds the bodies in the images of `base`.
    void see(const Ref<Frame>& base, Frame& tracked) {
        DepthImage image = base->depth_image();
        depth_is_right = depth_is_right || check_depth(image);
        const bool own_map = makes_map(image);
        if (!own_map && !image.users)
            fail(VFIT_ERROR_UNSUPPORTED,
                 "the frame's source supplies no user map, and the tracker was told to make none");
        tracked.base = base;
        tracked.time_ns = base->time_ns;
        place(image.camera);
        bring_from_elsewhere(image.camera);
        perception().run(image, base->time_ns, own_map ? add_map(image, tracked) : nullptr,
                         {told.hints, told.elsewhere}, tracked.bodies);
        seen_by = tracked.camera = image.camera;
        if (tracked.bodies.empty()) say_why_absent(tracked);
        in_camera = tracked.bodies;
        for (Body& body : tracked.bodies) body = to_world(body, tracked.camera);
        if (fit != VFIT_FIT_OFF) fit_bodies(image, tracked);
    }
    /// Carries them to camera space. The floor of `camera` may be found in this image alone: until then it is
    /// where the last one had it.
    void bring_from_elsewhere(const Camera& camera) {
        const Camera& placed = camera.floor_state < seen_by.floor_state ? seen_by : camera;
        for (Body& body : told.elsewhere) body = to_camera(body, placed);
    }
    void say_why_absent(Frame& tracked) {
        static const std::string key = "no_person";
        why_absent = '"';
        why_absent.append(text_of(own->why_absent())).append(1, '"');
        tracked.set_meta(key, why_absent);
    }
    /// Moves bodies, as they are in_camera, to those that are fitted to the image.
    void fit_bodies(const DepthImage& image, Frame& tracked) {
        if (!fit_model.valid()) fit_model = context->fit_model();
        if (in_camera.empty()) return;
        if (!fits) fits = std::make_unique<PeopleFit>(fit_model.get());
        choose_active(tracked);
        for (size_t i = 0; i < in_camera.size(); ++i) {
            if (fit == VFIT_FIT_AUTO && in_camera[i].id != tracked.active->id) continue;
            const auto targets = own->targets();
            const auto target = std::find_if(targets.begin(), targets.end(),
                                             [&](const TrackTarget& t) { return t.id == in_camera[i].id; });
            fits->run(image, target == targets.end() ? PixelBox{} : target->box, in_camera[i]);
            tracked.bodies[i] = to_world(in_camera[i], tracked.camera);
        }
    }
    /// Gives `tracked`, which has its source's bodies, a user map of the tracker's own with their numbers.
    void map_given_bodies(const Frame& base, Frame& tracked) {
        if (!base.find(VFIT_STREAM_DEPTH)) return;
        DepthImage image = base.depth_image();
        if (!makes_map(image)) return;
        place(image.camera);
        uint8_t* const map = add_map(image, tracked);
        const auto found = perception().map_people(image, tracked.time_ns, map);
        in_camera.clear();
        for (const Body& body : tracked.bodies) in_camera.push_back(to_camera(body, tracked.camera));
        number_by_bodies(in_camera, image.camera, found, map);
    }
    uint8_t* add_map(const DepthImage& image, Frame& tracked) {
        return static_cast<uint8_t*>(
            tracked.add_stream(VFIT_STREAM_USER_MAP, VFIT_FORMAT_U8, image.width(), image.height()));
    }
    Perception& perception() {
        if (!own)
            own = std::make_unique<Perception>(
                [this] {
                    return std::make_shared<JointNetwork>(context->module_path("vfit_joint_network"),
                                                          context->data_dir + "/networks/joints.onnx");
                },
                filter != VFIT_FILTER_OFF);
        return *own;
    }
};

/// Shares the images of `base` and has its bodies, on the floor that the tracker knows.
void track(const TrackerObject& tracker, const Ref<Frame>& base, Frame& tracked) {
    tracked.base = base;
    tracked.time_ns = base->time_ns;
    tracked.camera = base->camera;
    tracker.place(tracked.camera);
    tracked.bodies = base->bodies;
    // Bodies of the source stand on the source's floor. An estimate moves nobody: it is made where bodies
    // that the host put into the world may be there already.
    if (tracked.camera.floor_state == VFIT_FLOOR_GIVEN && base->camera.floor_state != VFIT_FLOOR_GIVEN)
        for (Body& body : tracked.bodies) body = to_world(to_camera(body, base->camera), tracked.camera);
}

/// A tracked frame keeps its images alive, so both must go with one context.
void require_same_context(const TrackerObject& tracker, const UseFrame& frame) {
    if (&frame.context() != tracker.context.get())
        fail(VFIT_ERROR_HANDLE, "the frame belongs to another context than the tracker");
}

vfit_track_source check_source(vfit_track_source source, const char* name) {
    if (source < VFIT_TRACK_AUTO || source > VFIT_TRACK_GIVEN)
        fail(VFIT_ERROR_ARGUMENT, "desc.", name, ": unknown track source ", source);
    return source;
}

bool is_near(const Vec3& p) {
    return std::abs(p.x) <= kFarthest_m && std::abs(p.y) <= kFarthest_m && std::abs(p.z) <= kFarthest_m;
}

WorldPlace place_in(const float* position, const float* rotation, const Axes& axes) {
    check_pointer(position, "position");
    const Vec3 at = axes.point_in({position[0], position[1], position[2]});
    if (!is_near(at))
        fail(VFIT_ERROR_ARGUMENT, "position is not finite, or further than ", kFarthest_m, " m away");
    return {at, rotation_in(rotation, axes)};
}

void check_hint(const vfit_joint_hint& hint) {
    const char* name = joint_name(hint.joint);
    if (!name) fail(VFIT_ERROR_ARGUMENT, "hint: joint ", hint.joint, " is not one of VFIT_JOINT_*");
    if (hint.body_id > 255)
        fail(VFIT_ERROR_ARGUMENT, "hint of ", name, ": body_id ", hint.body_id, " is not in 0..255");
    if (!std::isfinite(hint.x) || !std::isfinite(hint.y) || !std::isfinite(hint.confidence))
        fail(VFIT_ERROR_DATA, "hint of ", name, " is not finite");
    if (hint.confidence < 0.0f || hint.confidence > 1.0f)
        fail(VFIT_ERROR_ARGUMENT, "hint of ", name, ": confidence ", hint.confidence, " is not in 0..1");
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

vfit_result vfit_frame_active_body(vfit_frame handle, uint32_t* body_id, vfit_active_state* state) {
    return guard([&] {
        check_pointer(body_id, "body_id");
        UseFrame frame(handle);
        ActiveBody active;
        if (frame->active)
            active = *frame->active;
        else if (!frame->bodies.empty())
            active = {frame->bodies.front().id, VFIT_ACTIVE_BY_RULE};
        *body_id = active.id;
        if (state) *state = active.state;
        return VFIT_OK;
    });
}

vfit_result vfit_tracker_set_active(vfit_tracker handle, uint32_t body_id) {
    return guard([&] {
        Use<TrackerObject, Mode::exclusive> tracker(handle.id);
        if (body_id > 255) fail(VFIT_ERROR_ARGUMENT, "body_id ", body_id, " is not in 0..255");
        tracker->active.choose(body_id);
        return VFIT_OK;
    });
}

vfit_result vfit_tracker_create(vfit_context handle, const vfit_tracker_desc* desc, vfit_tracker* out) {
    return guard([&] {
        check_pointer(out, "out");
        out->id = 0;
        UseContext<Mode::any> context(handle);
        const vfit_tracker_desc d = read_or_default(desc, "desc");
        auto tracker = make<TrackerObject>(context.ref());
        tracker->joints = check_source(d.joints, "joints");
        tracker->user_map = check_source(d.user_map, "user_map");
        check_enum(d.follow, VFIT_FOLLOW_CHOSEN, "desc.follow");
        tracker->active = ActivePerson(d.follow);
        check_enum(d.filter, VFIT_FILTER_OFF, "desc.filter");
        tracker->filter = d.filter;
        check_enum(d.fit, VFIT_FIT_EVERYBODY, "desc.fit");
        tracker->fit = d.fit;
        if (d.floor) {
            vfit_camera floor = read(d.floor, "desc.floor");
            floor.floor_state = VFIT_FLOOR_GIVEN;
            set_placement(tracker->floor, floor);
        }
        out->id = context->publish(Kind::tracker, tracker);
        return VFIT_OK;
    });
}

vfit_result vfit_tracker_destroy(vfit_tracker tracker) {
    return guard([&] {
        destroy<TrackerObject>(tracker.id);
        return VFIT_OK;
    });
}

vfit_result vfit_tracker_reset(vfit_tracker handle) {
    return guard([&] {
        Use<TrackerObject, Mode::exclusive> tracker(handle.id);
        if (tracker->floor.floor_state != VFIT_FLOOR_GIVEN) tracker->floor = Camera{};
        if (tracker->own) tracker->own->reset();
        if (tracker->fits) tracker->fits->reset();
        tracker->active.reset();
        tracker->steady.reset();
        tracker->told_next.clear();
        tracker->seen_by = Camera{};
        return VFIT_OK;
    });
}

vfit_result vfit_tracker_update(vfit_tracker handle, vfit_frame frame_handle, vfit_frame* tracked) {
    return guard([&] {
        check_pointer(tracked, "tracked");
        tracked->id = 0;
        Use<TrackerObject, Mode::exclusive> tracker(handle.id);
        UseFrame frame(frame_handle);
        require_same_context(*tracker, frame);
        // What was told is for this update alone, even where it fails.
        std::swap(tracker->told, tracker->told_next);
        tracker->told_next.clear();
        Profile::Scope time(tracker->context->profile, Stage::track);
        Ref<Frame> out = Context::take_frame(*tracker->context->frames);
        // A source that tells its bodies may have nobody in view.
        const bool told = !frame->bodies.empty() || frame->meta("bodies");
        if (!told && tracker->joints == VFIT_TRACK_GIVEN)
            fail(VFIT_ERROR_UNSUPPORTED,
                 "the frame's source supplies no joints, and the tracker was told to find none");
        const bool given = told && tracker->joints != VFIT_TRACK_BUILT_IN;
        if (given) {
            track(*tracker, frame.ref(), *out);
            tracker->map_given_bodies(*frame, *out);
            if (tracker->filter == VFIT_FILTER_ON)
                for (Body& body : out->bodies) tracker->steady.run(body);
        } else {
            tracker->see(frame.ref(), *out);
        }
        tracker->choose_active(*out);
        tracked->id = tracker->context->publish(Kind::frame, out);
        return VFIT_OK;
    });
}

vfit_result vfit_tracker_hint(vfit_tracker handle, const vfit_joint_hint* items, uint32_t stride,
                              uint32_t count) {
    return guard([&] {
        Use<TrackerObject, Mode::exclusive> tracker(handle.id);
        const Items<vfit_joint_hint> given(items, stride, count, "items");
        if (count > kMaxBodies * kJointCount)
            fail(VFIT_ERROR_ARGUMENT, "items: ", count, " hints, at most ", kMaxBodies * kJointCount);
        for (uint32_t i = 0; i < count; ++i) check_hint(given[i]);
        auto& hints = tracker->told_next.hints;
        hints.clear();
        for (uint32_t i = 0; i < count; ++i) {
            const vfit_joint_hint h = given[i];
            hints.push_back({h.joint, h.x, h.y, h.confidence, h.body_id});
        }
        return VFIT_OK;
    });
}

vfit_result vfit_tracker_hint_from(vfit_tracker handle, vfit_frame seen, uint32_t body_id,
                                   const float position[3], const float rotation[4]) {
    return guard([&]() -> vfit_result {
        Use<TrackerObject, Mode::exclusive> tracker(handle.id);
        UseFrame frame(seen);
        require_same_context(*tracker, frame);
        const WorldPlace place = place_in(position, rotation, tracker->context->axes);
        const Body* const body = frame->body(body_id);
        if (!body) return VFIT_INCOMPLETE;
        auto& elsewhere = tracker->told_next.elsewhere;
        if (elsewhere.size() == kMaxBodies)
            fail(VFIT_ERROR_CAPACITY, "at most ", kMaxBodies, " people of other cameras");
        Body there = *body;
        for (Joint& joint : there.joints) {
            joint.position = place.point(joint.position);
            if (joint.seen() && !is_near(joint.position))
                fail(VFIT_ERROR_DATA, "body ", body_id, " has a joint further than ", kFarthest_m, " m away");
        }
        elsewhere.push_back(there);
        return VFIT_OK;
    });
}

vfit_result vfit_world_align(vfit_context handle, const float* here, const float* there, uint32_t count,
                             float position[3], float rotation[4], float* rms) {
    return guard([&] {
        UseContext<Mode::any> context(handle);
        check_pointer(here, "here");
        check_pointer(there, "there");
        check_pointer(position, "position");
        check_pointer(rotation, "rotation");
        if (count > kMaxItems) fail(VFIT_ERROR_ARGUMENT, "count ", count, " is more than ", kMaxItems);
        const Axes& axes = context->axes;
        std::vector<Vec3> points[2];
        for (uint32_t i = 0; i < count; ++i) {
            points[0].push_back(axes.point_in({here[3 * i], here[3 * i + 1], here[3 * i + 2]}));
            points[1].push_back(axes.point_in({there[3 * i], there[3 * i + 1], there[3 * i + 2]}));
        }
        float rms_m = 0.0f;
        const WorldPlace place = align_worlds(points[0], points[1], rms_m);
        const Vec3 at = axes.point_out(place.position);
        const Quat turn = axes.rotation_out(place.rotation);
        for (int k = 0; k < 3; ++k) position[k] = at[k];
        const float parts[] = {turn.x, turn.y, turn.z, turn.w};
        std::copy_n(parts, 4, rotation);
        if (rms) *rms = axes.length_out(rms_m);
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
        require_same_context(*tracker, frame);
        Profile::Scope time(tracker->context->profile, Stage::track);
        Body in = body_in(read(body, "body"), Items<vfit_joint>(items, stride, count, "items"),
                          tracker->context->axes);
        if (frame->body(in.id)) fail(VFIT_ERROR_ARGUMENT, "the frame has a body ", in.id, " already");
        if (frame->bodies.size() == kMaxBodies)
            fail(VFIT_ERROR_CAPACITY, "a frame holds at most ", kMaxBodies, " bodies");
        if (in.time_ns == 0) in.time_ns = frame->time_ns;

        Ref<Frame> out = Context::take_frame(*tracker->context->frames);
        const bool camera_space = (in.flags & VFIT_BODY_CAMERA_SPACE) != 0;
        in.flags &= ~uint32_t(VFIT_BODY_CAMERA_SPACE);
        if (camera_space && tracker->nobody_knows_the_floor(frame->camera))
            estimate_floor(tracker->floor, in);
        track(*tracker, frame.ref(), *out);
        if (camera_space) in = to_world(in, out->camera);
        if (tracker->filter != VFIT_FILTER_OFF) tracker->steady.run(in);
        out->bodies.push_back(in);
        tracker->choose_active(*out);
        tracked->id = tracker->context->publish(Kind::frame, out);
        return VFIT_OK;
    });
}
