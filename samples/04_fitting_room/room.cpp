#include "room.h"

#include <algorithm>
#include <cstring>

namespace room {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int64_t kForgotten_ns = 5'000'000'000;  // who has been away so long is not awaited any more
constexpr int64_t kFurthestAhead_ns =
    100'000'000;                        // that motion predicts beyond the last camera image: three of them
constexpr float kLongestStep_s = 0.1f;  // as the library clamps it
constexpr auto kLookAgain = std::chrono::milliseconds(1000);  // for a camera that is lost

Context open_context(const Options& options) {
    vfit_context_desc desc = vfit_context_desc_init();
    desc.api_version = VFIT_VERSION;
    if (!options.data_dir.empty()) desc.data_dir = options.data_dir.c_str();
    Context context;
    check(vfit_context_create(&desc, context.out()));
    return context;
}

const char* guidance_text(vfit_guidance guidance) {
    switch (guidance) {
        case VFIT_GUIDANCE_STEP_BACK: return "Please step back a little";
        case VFIT_GUIDANCE_STEP_CLOSER: return "Please come a little closer";
        case VFIT_GUIDANCE_ARMS_OUT: return "Please hold your arms away from your body";
        case VFIT_GUIDANCE_HOLD_STILL: return "Please stand upright and hold still";
        case VFIT_GUIDANCE_TURN_SIDEWAYS: return "Please turn to the side";
        case VFIT_GUIDANCE_TURN_ROUND: return "Please go on turning";
        case VFIT_GUIDANCE_TURN_SLOWER: return "Please turn more slowly";
        case VFIT_GUIDANCE_ARMS_FORWARD: return "Please hold your arms forward";
        case VFIT_GUIDANCE_FEET_NOT_VISIBLE: return "Please step back until your feet are in view";
        case VFIT_GUIDANCE_ONE_PERSON_ONLY: return "One at a time, please";
        case VFIT_GUIDANCE_NOBODY: return "Please step before the camera";
        case VFIT_GUIDANCE_JOINTS_MISSING: return "Please show your whole body";
        case VFIT_GUIDANCE_FACE_CAMERA: return "Please face the camera";
        default: return "Please hold still: you are being measured";
    }
}

template <typename T>
std::vector<T> copy_of(vfit_frame frame, vfit_stream stream, size_t values_an_item) {
    const vfit_view view = view_of(frame, stream);
    std::vector<T> out(view.width * values_an_item);
    for (size_t i = 0; i < view.width; ++i)
        std::memcpy(&out[i * values_an_item], static_cast<const char*>(view.data) + i * view.item_stride,
                    values_an_item * sizeof(T));
    return out;
}

void grow(Room::Place& low, Room::Place& high, const Room::Place& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

constexpr Room::Place kNowhereLow{1e9f, 1e9f, 1e9f}, kNowhereHigh{-1e9f, -1e9f, -1e9f};

vfit_target target_of(void* data, size_t count, size_t stride, size_t offset, vfit_format format,
                      size_t item) {
    vfit_target target = vfit_target_init();
    target.format = format;
    target.data = static_cast<char*>(data) + offset;
    target.item_stride = uint32_t(stride);
    target.capacity = (count - 1) * stride + item;
    return target;
}

}  // namespace

Room::Room(const Options& options)
    : options_(options), context_(open_context(options)), wardrobe_(context_.get(), options.garments) {
    if (!options.size.empty()) {
        const auto& sizes = wardrobe_.piece(0).sizes;
        const auto found = std::find(sizes.begin(), sizes.end(), options.size);
        if (found == sizes.end())
            throw Failure("garment " + garment() + " does not come in size " + options.size);
        size_ = size_t(found - sizes.begin());
        size_chosen_ = true;
    }
    vfit_tracker_desc desc = vfit_tracker_desc_init();
    if (options.tracked) desc.joints = desc.user_map = VFIT_TRACK_BUILT_IN;
    check(vfit_tracker_create(context_.get(), &desc, tracker_.out()));
    check(vfit_motion_create(context_.get(), nullptr, motion_.out()));
    for (vfit_bone& bone : bones_) bone = vfit_bone_init();
    open_camera();
    begin_scan();
}

void Room::open_camera() {
    check(vfit_sensor_open(context_.get(), options_.source.c_str(), sensor_.out()));
    // Not every source has these; a camera always runs at its own pace.
    vfit_sensor_set_option(sensor_.get(), "pace", options_.film ? "none" : "realtime");
    vfit_sensor_set_option(sensor_.get(), "loop", options_.film ? "0" : "1");
    check(vfit_sensor_start(sensor_.get()));
}

/// The room goes on: the person keeps the last pose, and the message says what is wrong.
void Room::lose_camera(const std::string& why) {
    trouble_ = "The camera is lost: " + why;
    looked_for_it_ = Clock::now();
}

void Room::begin_scan() {
    cloth_.clear();
    stepping_ = false;
    avatar_.clear();
    vfit_scan_desc desc = vfit_scan_desc_init();
    desc.sex = options_.sex;
    check(vfit_scan_create(context_.get(), &desc, scan_.out()));
    check(vfit_motion_reset(motion_.get()));
    scan_state_ = vfit_scan_state_init();
    scan_state_.guidance = VFIT_GUIDANCE_NOBODY;
    scan_done_ = false;
    person_ = {};
    hidden_by_.clear();
    if (options_.size.empty()) size_chosen_ = false;
}

void Room::sense() {
    if (!camera_on_) return;
    Frame frame;
    vfit_result got = VFIT_OK;
    if (sensor_) got = vfit_sensor_acquire(sensor_.get(), options_.film ? -1 : 0, frame.out());
    if (got < 0) {
        if (trouble_.empty()) lose_camera(last_error());
    } else if (got == VFIT_END_OF_STREAM) {
        ended_ = options_.film;
        if (trouble_.empty()) lose_camera(options_.source + " has ended");
    }
    if (!trouble_.empty() && !frame && Clock::now() - looked_for_it_ > kLookAgain) {
        // Most plug-ins find their camera again by themselves; one that has given up is opened anew.
        looked_for_it_ = Clock::now();
        vfit_sensor_stats stats = vfit_sensor_stats_init();
        if (!sensor_ || (vfit_sensor_describe(sensor_.get(), &stats) == VFIT_OK && stats.state != VFIT_OK &&
                         stats.state != VFIT_ERROR_DEVICE_LOST)) {
            try {
                open_camera();
            } catch (const Failure& failure) {
                lose_camera(failure.what());
            }
        }
    }
    if (!frame) return;
    trouble_.clear();
    ++camera_images_;
    check(vfit_tracker_update(tracker_.get(), frame.get(), tracked_.out()));
    const int64_t time_ns = view_of(tracked_.get(), VFIT_STREAM_DEPTH).time_ns;
    frame_ns_ = time_ns;
    arrived_ = Clock::now();
    uint32_t active = 0;
    vfit_active_state state = VFIT_ACTIVE_NOBODY;
    check(vfit_frame_active_body(tracked_.get(), &active, &state));
    if (active != 0) nobody_since_ns_ = time_ns;
    draw_camera(tracked_.get());

    const bool other = active != 0 && active != body_id_;
    const bool gone = active == 0 && body_id_ != 0 && time_ns - nobody_since_ns_ > kForgotten_ns;
    if ((other || gone) && body_id_ != 0) begin_scan();
    if (other || gone) body_id_ = active;
    if (!scan_done_) scan(tracked_.get(), active);
}

void Room::scan(vfit_frame tracked, uint32_t body_id) {
    if (body_id == 0) {
        scan_state_.guidance = VFIT_GUIDANCE_NOBODY;
        return;
    }
    // Motion is filtered from the first image on, so that it has settled when the avatar appears.
    check(vfit_motion_step(motion_.get(), tracked, body_id, frame_ns_));
    if (check(vfit_scan_add(scan_.get(), tracked, body_id, &scan_state_)) == VFIT_OK) meet_person();
}

/// The scan is complete: an avatar, its size, the first garment.
void Room::meet_person() {
    scan_done_ = true;
    uint32_t count = 0;
    check(vfit_scan_measure(scan_.get(), nullptr, sizeof(vfit_measurement), &count));
    measures_.resize(count);
    check(vfit_scan_measure(scan_.get(), measures_.data(), sizeof(vfit_measurement), &count));
    for (const vfit_measurement& m : measures_)
        if (std::strcmp(m.key, "stature_m") == 0)
            person_.stature_m = m.value, person_.stature_sigma_m = m.sigma;

    vfit_avatar_desc desc = vfit_avatar_desc_init();
    desc.sex = options_.sex;
    desc.detail = options_.detail;
    check(vfit_avatar_create_from_scan(context_.get(), &desc, scan_.get(), avatar_.out()));
    check(vfit_motion_bind(motion_.get(), avatar_.get()));
    Frame rest;
    check(vfit_avatar_acquire_rest(avatar_.get(), rest.out()));
    body_vertices_ = view_of(rest.get(), VFIT_STREAM_POSITION).width;
    skin_ = copy_of<uint32_t>(rest.get(), VFIT_STREAM_INDEX, 1);
    std::vector<BodyVertex> nowhere(body_vertices_);
    move(nowhere.data());
    put_on();
}

/// Sizes by the chart that the garment names. A garment that does not come in the best size gets the best of
/// those that it has.
void Room::recommend() {
    const Piece& piece = wardrobe_.piece(garment_);
    SizeChart chart;
    check(vfit_size_chart_open(context_.get(), piece.chart.empty() ? "en13402_women" : piece.chart.c_str(),
                               chart.out()));
    std::array<vfit_size, 64> sizes{};
    uint32_t count = uint32_t(sizes.size());
    person_.size = kMadeToMeasure;
    person_.probability = 0.0f;
    if (vfit_size_recommend(chart.get(), piece.kind.c_str(), measures_.data(), sizeof(vfit_measurement),
                            uint32_t(measures_.size()), sizes.data(), sizeof(vfit_size), &count) < 0)
        return;  // of a kind that the chart does not know
    for (uint32_t i = 0; i < count; ++i)
        if (std::find(piece.sizes.begin(), piece.sizes.end(), sizes[i].label) != piece.sizes.end()) {
            person_.size = sizes[i].label;
            person_.probability = sizes[i].probability;
            return;
        }
}

/// The chosen garment in the chosen size, on the avatar in the pose that it has now.
void Room::put_on() {
    Watch watch;
    recommend();
    const Piece& piece = wardrobe_.piece(garment_);
    if (!size_chosen_) {
        const auto found = std::find(piece.sizes.begin(), piece.sizes.end(), person_.size);
        size_ = size_t(found - piece.sizes.begin());
    }
    size_ = std::min(size_, piece.sizes.size() - 1);
    cloth_.clear();
    stepping_ = false;
    vfit_cloth_desc desc = vfit_cloth_desc_init();
    constexpr float kBudget_ms = 10.0f;  // a slow machine gets fewer sub-steps, not fewer pictures
    desc.flags = VFIT_CLOTH_SKIN;
    desc.budget_ms = kBudget_ms;
    if (size() != kMadeToMeasure) desc.size_label = size().c_str();
    check(vfit_cloth_create(avatar_.get(), piece.garment.get(), &desc, cloth_.out()));
    check(vfit_cloth_reset(cloth_.get()));
    stepped_ns_ = now_ns();
    take_mesh();
    hide_skin();
    dress_ms_ = watch.lap_ms();
}

void Room::take_mesh() {
    Frame frame;
    check(vfit_cloth_acquire(cloth_.get(), frame.out()));
    cloth_vertices_ = view_of(frame.get(), VFIT_STREAM_POSITION).width;
    cloth_indices_ = copy_of<uint32_t>(frame.get(), VFIT_STREAM_INDEX, 1);
    cloth_uvs_ = copy_of<float>(frame.get(), VFIT_STREAM_UV, 2);
    ++mesh_version_;
}

void Room::hide_skin() {
    std::vector<uint8_t>& hidden = hidden_by_[{garment_, size_}];
    if (hidden.empty()) {
        hidden.resize(skin_.size() / 3);
        check(vfit_cloth_hide_skin(cloth_.get(), 0.0f, hidden.data(), uint32_t(hidden.size())));
    }
    seen_skin_.clear();
    for (size_t t = 0; t < hidden.size(); ++t)
        if (!hidden[t]) seen_skin_.insert(seen_skin_.end(), &skin_[3 * t], &skin_[3 * t] + 3);
}

int64_t Room::now_ns() const {
    if (options_.film) return frame_ns_;
    // The camera's clock goes on from its last image: right for recordings too, whose time stamps are of
    // another day.
    return frame_ns_ + std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - arrived_).count();
}

void Room::move(BodyVertex* to) {
    if (!avatar_) return;
    // Where no image comes, the pose stays: a prediction would wander off.
    const int64_t now = now_ns();
    if (body_id_ != 0 && now - frame_ns_ <= kFurthestAhead_ns)
        check(vfit_motion_step(motion_.get(), tracked_.get(), body_id_, now));
    bone_count_ = VFIT_BONE_COUNT;
    check(vfit_motion_pose(motion_.get(), &pose_, bones_.data(), sizeof(vfit_bone), &bone_count_));
    const vfit_target positions = target_of(to, body_vertices_, sizeof(BodyVertex),
                                            offsetof(BodyVertex, position), VFIT_FORMAT_F32X3, 12);
    const vfit_target normals = target_of(to, body_vertices_, sizeof(BodyVertex),
                                          offsetof(BodyVertex, normal), VFIT_FORMAT_F32X3, 12);
    check(vfit_avatar_pose_into(avatar_.get(), &pose_, bones_.data(), sizeof(vfit_bone), bone_count_,
                                &positions, &normals));

    std::array<vfit_joint, VFIT_JOINT_COUNT> joints;
    uint32_t count = VFIT_JOINT_COUNT;
    check(vfit_avatar_joints(avatar_.get(), joints.data(), sizeof(vfit_joint), &count));
    joints_.low = kNowhereLow, joints_.high = kNowhereHigh;
    for (uint32_t i = 0; i < count; ++i) {
        const Place place{joints[i].position[0], joints[i].position[1], joints[i].position[2]};
        grow(joints_.low, joints_.high, place);
        if (joints[i].joint == VFIT_JOINT_PELVIS) joints_.pelvis = place;
        if (joints[i].joint == VFIT_JOINT_LEFT_FOOT) joints_.left_foot = place;
        if (joints[i].joint == VFIT_JOINT_RIGHT_FOOT) joints_.right_foot = place;
    }
}

void Room::end_step(Times* times) {
    if (!stepping_) return;
    stepping_ = false;
    check(vfit_cloth_end_step(cloth_.get()));
    vfit_cloth_stats stats = vfit_cloth_stats_init();
    check(vfit_cloth_describe(cloth_.get(), &stats));
    if (times) times->add_cloth_step(stats.step_ms, interval_ms_);
}

void Room::run_cloth(Times& times) {
    if (!cloth_) return;
    end_step(&times);
    const float dt = 1e-9f * float(now_ns() - stepped_ns_);
    if (physics_ && dt > 0.0f && dt >= float(options_.min_interval_s)) {
        interval_ms_ = 1e3f * dt;
        check(vfit_cloth_begin_step(cloth_.get(), std::min(dt, kLongestStep_s)));
        stepping_ = true;
        stepped_ns_ = now_ns();
    }
    check(vfit_cloth_carry(cloth_.get()));
}

void Room::write_cloth(ClothVertex* to) {
    Frame frame;
    check(vfit_cloth_acquire(cloth_.get(), frame.out()));
    const auto write = [&](vfit_stream stream, size_t offset, vfit_format format, size_t item) {
        const vfit_target target = target_of(to, cloth_vertices_, sizeof(ClothVertex), offset, format, item);
        check(vfit_frame_write(frame.get(), stream, &target, nullptr));
    };
    write(VFIT_STREAM_POSITION, offsetof(ClothVertex, position), VFIT_FORMAT_F32X3, 12);
    write(VFIT_STREAM_NORMAL, offsetof(ClothVertex, normal), VFIT_FORMAT_F32X3, 12);
    write(VFIT_STREAM_STRAIN, offsetof(ClothVertex, strain), VFIT_FORMAT_F32, 4);
    // From the frame and not from `to`: memory of a graphics card is slow to read.
    const vfit_view places = view_of(frame.get(), VFIT_STREAM_POSITION);
    cloth_low_ = kNowhereLow, cloth_high_ = kNowhereHigh;
    for (uint32_t i = 0; i < places.width; ++i) {
        Place p;
        std::memcpy(&p, static_cast<const char*>(places.data) + size_t(i) * places.item_stride, sizeof p);
        grow(cloth_low_, cloth_high_, p);
    }
}

void Room::choose_garment(int by) {
    const auto count = int(wardrobe_.count());
    const auto next = size_t((int(garment_) + by + count) % count);
    if (next == garment_) return;
    garment_ = next;
    size_chosen_ = false;
    if (dressed()) put_on();
}

void Room::choose_size(int by) {
    const auto count = int(wardrobe_.piece(garment_).sizes.size());
    size_ = size_t((int(size_) + by + count) % count);
    size_chosen_ = true;
    if (dressed()) put_on();
}

void Room::redress() {
    if (!dressed()) return;
    end_step(nullptr);
    check(vfit_cloth_reset(cloth_.get()));
    stepped_ns_ = now_ns();
}

void Room::switch_physics() {
    physics_ = !physics_;
    // Without it the cloth is only carried along; where it goes on, the body may stand elsewhere.
    if (physics_) redress();
}

void Room::switch_camera() {
    camera_on_ = !camera_on_;
    if (!sensor_) return;
    if ((camera_on_ ? vfit_sensor_start : vfit_sensor_stop)(sensor_.get()) < 0) lose_camera(last_error());
}

const char* Room::message() const {
    if (!camera_on_) return "The camera is off";
    if (!trouble_.empty()) return trouble_.c_str();
    return scan_done_ ? "" : guidance_text(scan_state_.guidance);
}

void Room::draw_camera(vfit_frame tracked) {
    const vfit_view depth = view_of(tracked, VFIT_STREAM_DEPTH);
    vfit_view users = vfit_view_init();
    const bool has_users = vfit_frame_view(tracked, VFIT_STREAM_USER_MAP, &users) == VFIT_OK;
    vfit_camera camera = vfit_camera_init();
    check(vfit_frame_camera(tracked, &camera));
    CameraPicture& p = camera_picture_;
    const uint32_t step = (depth.width + CameraPicture::kMaxWidth - 1) / CameraPicture::kMaxWidth;
    p.width = depth.width / step, p.height = depth.height / step;
    p.rgba.resize(size_t(p.width) * p.height);
    constexpr float kFarthest_m = 4.5f;
    const float shade = 200.0f * camera.depth_unit_m / kFarthest_m;
    for (uint32_t y = 0; y < p.height; ++y) {
        const auto* row = reinterpret_cast<const uint16_t*>(static_cast<const char*>(depth.data) +
                                                            size_t(y * step) * depth.row_stride);
        const auto* user_row =
            has_users ? static_cast<const uint8_t*>(users.data) + size_t(y * step) * users.row_stride
                      : nullptr;
        for (uint32_t x = 0; x < p.width; ++x) {
            const uint16_t d = row[x * step];
            const auto grey = uint32_t(d ? std::max(0.0f, 225.0f - shade * float(d)) : 12.0f);
            const bool person = user_row && user_row[x * step] != 0;
            const uint32_t r = person ? std::min(255u, grey + 70) : grey,
                           g = person ? std::min(255u, grey + 45) : grey;
            p.rgba[size_t(y) * p.width + x] = 0xff000000u | grey << 16 | g << 8 | r;
        }
    }
    ++p.version;
}

}  // namespace room
