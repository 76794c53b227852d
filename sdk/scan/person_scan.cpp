#include "scan/person_scan.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"
#include "core/error.h"
#include "core/wipe.h"

namespace vfit {

namespace {

// Deviation of what hair and shoes add, where nobody says that there are none: 0 to 5 cm, evenly.
constexpr float kHairAndShoes_m = 0.015f;
constexpr float kJointsSlack_rad = 0.1f;  // joints tell less well than the fitted body how somebody stands
// From a hand to the hip joint of its side, across or ahead: nearer, and the arm hides the trunk's outline.
constexpr float kArmsOut_m = 0.14f;
constexpr float kFastestTurn = 2.6f;    // radians a second; at a pace of 8 s a turn small steps reach 1.6
constexpr float kSpeedOver_s = 0.2f;    // a fitted body's direction wavers by some degrees
constexpr uint32_t kFramesOfWay = 15;   // of a turn: the person stands still
constexpr uint32_t kViewsOfCamera = 3;  // more tell nothing new

/// By the joints, before the body is fitted.
ViewKind view_of(const Camera& camera, const Body& body) {
    const Vec3 left = body.at(VFIT_JOINT_LEFT_SHOULDER) - body.at(VFIT_JOINT_RIGHT_SHOULDER) +
                      body.at(VFIT_JOINT_LEFT_HIP) - body.at(VFIT_JOINT_RIGHT_HIP);
    return view_kind_of(facing_rad(camera, glm::cross(left, camera.floor_normal)), kJointsSlack_rad);
}

template <typename T>
void forget(std::optional<T>& value) {
    if (value) wipe(*value);
    value.reset();
}

bool arms_out(const Body& body) {
    const Vec3 across = glm::normalize(body.at(VFIT_JOINT_LEFT_HIP) - body.at(VFIT_JOINT_RIGHT_HIP));
    for (const float side : {1.0f, -1.0f}) {
        const int hand = side > 0 ? VFIT_JOINT_LEFT_HAND : VFIT_JOINT_RIGHT_HAND;
        const int hip = side > 0 ? VFIT_JOINT_LEFT_HIP : VFIT_JOINT_RIGHT_HIP;
        if (body.has(hand) && side * glm::dot(across, body.at(hand) - body.at(hip)) < kArmsOut_m)
            return false;
    }
    return true;
}

/// Whether the arm on the camera's side leaves the outline of a side view free; the other arm is behind the
/// trunk. Left and right may be exchanged, so an arm behind the trunk counts as one ahead of it.
bool arm_clear_of_side(const Camera& camera, const Body& body) {
    const Vec3 left = body.at(VFIT_JOINT_LEFT_HIP) - body.at(VFIT_JOINT_RIGHT_HIP);
    const Vec3 ahead = glm::cross(left, camera.floor_normal);
    const bool left_is_near = left.z < 0.0f;
    const int hand = left_is_near ? VFIT_JOINT_LEFT_HAND : VFIT_JOINT_RIGHT_HAND;
    const int hip = left_is_near ? VFIT_JOINT_LEFT_HIP : VFIT_JOINT_RIGHT_HIP;
    return !body.has(hand) ||
           std::abs(glm::dot(ahead, body.at(hand) - body.at(hip))) >= kArmsOut_m * glm::length(ahead);
}

/// A measure that is known to be larger than a bound: the upper part of its normal distribution.
Measurement above(Measurement m, float bound) {
    const double from = double(bound - m.value) / double(m.sigma);
    if (from < -4.0) return m;
    // Mills's ratio, inverted; far out by its expansion, where the tail underflows.
    const double density = std::exp(-0.5 * from * from) / std::sqrt(2.0 * double(kPi)),
                 beyond = 0.5 * std::erfc(from / std::sqrt(2.0)),
                 ratio = from < 5.0 ? density / beyond : from + 1.0 / from;
    m.value += float(double(m.sigma) * ratio);
    m.sigma *= float(from < 5.0 ? std::sqrt(1.0 + from * ratio - ratio * ratio) : 1.0 / from);
    return m;
}

}  // namespace

PersonScan::PersonScan(const PersonScanDesc& desc)
    : desc_(desc),
      paper_(desc.paper),
      views_of_camera_(desc.paper.camera_count),
      said_by_camera_(desc.paper.camera_count, VFIT_GUIDANCE_NONE) {
    if (desc.fit_model && desc.measure_model) body_ = std::make_unique<BodyScan>(desc.fit_model);
}

void PersonScan::reset() {
    paper_.reset();
    if (body_) body_->reset();
    side_frames_ = more_side_frames_ = 0;
    ring_.reset();
    std::fill(views_of_camera_.begin(), views_of_camera_.end(), 0u);
    std::fill(said_by_camera_.begin(), said_by_camera_.end(), VFIT_GUIDANCE_NONE);
    forget(before_turn_), forget(turned_);
    turned_views_ = 0;
    turned_rad_ = 0.0f, turned_ns_ = 0, fast_ = false;
}

void PersonScan::extend(uint32_t frames, uint32_t side_frames) {
    paper_.extend(frames);
    more_side_frames_ += side_frames;
}

ScanProgress PersonScan::add(const ScanFrame& frame) {
    if (!body_) return paper_.add(frame);
    ScanProgress progress;
    progress.frames_taken = frames_taken();
    if (complete()) return progress;
    const Stopwatch watch;
    progress = paper_.look(frame);
    if (progress.guidance == VFIT_GUIDANCE_NONE) progress.guidance = fit(frame);
    said_by_camera_[frame.camera] = progress.guidance;
    progress.taken = progress.guidance == VFIT_GUIDANCE_NONE;
    progress.frames_taken = frames_taken();
    progress.compute_ms = watch.ms();
    return progress;
}

vfit_guidance PersonScan::turn(const ScanFrame& frame) {
    if (!arms_out(*frame.body)) return VFIT_GUIDANCE_ARMS_OUT;
    if (!before_turn_) before_turn_ = body_->features(with_side());
    const auto turned = body_->fit_turning(frame.image, *frame.body);
    if (!turned) return VFIT_GUIDANCE_HOLD_STILL;
    const float seconds = float(double(frame.body->time_ns - turned_ns_) * 1e-9);
    if (turned_ns_ == 0 || !(seconds >= 0.0f && seconds < kSpeedOver_s)) {
        const float step = std::remainder(*turned - turned_rad_, 2.0f * kPi);
        fast_ = turned_ns_ != 0 && seconds > 0.0f && std::abs(step) > kFastestTurn * seconds;
        turned_rad_ = *turned, turned_ns_ = frame.body->time_ns;
    }
    if (fast_) return VFIT_GUIDANCE_TURN_SLOWER;
    const int way = TurnRing::way_of(*turned);
    if (ring_.frames(way) >= kFramesOfWay) return VFIT_GUIDANCE_TURN_ROUND;
    body_->keep_turning(frame.image, *frame.body);
    ring_.add(way);
    return VFIT_GUIDANCE_NONE;
}

bool PersonScan::all_cameras_seen() const {
    return !several_cameras() || !body_ ||
           std::all_of(views_of_camera_.begin(), views_of_camera_.end(),
                       [](uint32_t views) { return views >= kViewsOfCamera; });
}

vfit_guidance PersonScan::wanted_by_others() const {
    for (size_t k = 0; k < views_of_camera_.size(); ++k)
        if (views_of_camera_[k] < kViewsOfCamera && said_by_camera_[k] != VFIT_GUIDANCE_NONE)
            return said_by_camera_[k];
    return VFIT_GUIDANCE_HOLD_STILL;
}

vfit_guidance PersonScan::look_around(const ScanFrame& frame) {
    if (views_of_camera_[frame.camera] >= kViewsOfCamera) return wanted_by_others();
    // From the side the trunk hides a hand, and its estimated position is of no use.
    const bool side = view_of(frame.image.camera, *frame.body) == ViewKind::kSide;
    if (!side && !arms_out(*frame.body)) return VFIT_GUIDANCE_ARMS_OUT;
    if (!before_turn_) before_turn_ = body_->features(with_side());
    const auto turned = body_->fit_turning(frame.image, *frame.body);
    if (!turned) return VFIT_GUIDANCE_HOLD_STILL;
    body_->keep_turning(frame.image, *frame.body);
    ring_.add(TurnRing::way_of(*turned));
    ++views_of_camera_[frame.camera];
    return VFIT_GUIDANCE_NONE;
}

vfit_guidance PersonScan::fit(const ScanFrame& frame) {
    const bool side_done = side_frames_ >= side_frames_wanted();
    if (paper_.complete() && side_done) {
        if (desc_.turn) return turn(frame);
        if (several_cameras()) return look_around(frame);
    }
    const ViewKind seen = view_of(frame.image.camera, *frame.body);
    const bool front = seen == ViewKind::kFront, side = seen == ViewKind::kSide;
    if (paper_.complete() ? !side : !front && !side)
        return paper_.complete() ? VFIT_GUIDANCE_TURN_SIDEWAYS : VFIT_GUIDANCE_FACE_CAMERA;
    if (side && side_done) return VFIT_GUIDANCE_FACE_CAMERA;
    if (front && !arms_out(*frame.body)) return VFIT_GUIDANCE_ARMS_OUT;
    if (side && !arm_clear_of_side(frame.image.camera, *frame.body)) return VFIT_GUIDANCE_ARMS_FORWARD;
    if (body_->add(frame.image, *frame.body) != seen) return VFIT_GUIDANCE_HOLD_STILL;
    forget(before_turn_);  // extend() asked for more after a turn
    if (front)
        paper_.take(frame);
    else
        ++side_frames_;
    return VFIT_GUIDANCE_NONE;
}

const SeenOfTurn* PersonScan::seen_of_turn() const {
    if (!(several_cameras() ? ring_.surrounded() : ring_.closed())) return nullptr;
    if (turned_views_ != body_->views_of_turn()) {
        turned_.emplace(body_->turned_trunk(),
                        several_cameras() ? ring_.doubt_between_cameras() : ring_.doubt(), several_cameras());
        turned_views_ = body_->views_of_turn();
    }
    return &*turned_;
}

InferredSex PersonScan::inferred_sex() const {
    if (desc_.paper.sex != VFIT_SEX_UNKNOWN) return {desc_.paper.sex, 1.0f};
    if (!fitted_shape()) return {};
    const float female = desc_.measure_model->female_probability(features(), {with_side(), desc_.tight});
    if (female > 0.5f) return {VFIT_SEX_FEMALE, female};
    return {VFIT_SEX_MALE, 1.0f - female};
}

std::vector<Measurement> PersonScan::measurements() const {
    if (!body_) return paper_.measurements();
    if (frames_taken() == 0) fail(VFIT_ERROR_STATE, "scan: no frame from the front has been taken yet");
    std::vector<Measurement> out =
        desc_.measure_model->measure(features(), {with_side(), desc_.tight}, desc_.paper.sex, seen_of_turn());
    for (Measurement& m : out)
        if (m.key == "stature_m") {
            m.sigma = std::hypot(m.sigma, body_->crown_sigma_m());
            if (std::isnan(features()[kCrownFeature])) m.observed = false;
            if (const float bound = body_->stature_bound_m(); bound > 0.0f) m = above(m, bound);
        }
    if (!desc_.bare)
        for (Measurement& m : out)
            if (m.key == "stature_m") m.sigma = std::hypot(m.sigma, kHairAndShoes_m);
    return out;
}

}  // namespace vfit
