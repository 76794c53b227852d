#include "scan/person_scan.h"

#include <cmath>

#include "core/clock.h"
#include "core/error.h"

namespace vfit {

namespace {

// Deviation of what hair and shoes add, where nobody says that there are none: 0 to 5 cm, evenly.
constexpr float kHairAndShoes_m = 0.015f;
constexpr float kJointsSlack_rad = 0.1f;  // joints tell less well than the fitted body how somebody stands
// From a hand to the hip joint of its side, across: nearer, and the arm hides the trunk's outline.
constexpr float kArmsOut_m = 0.14f;

/// By the joints, before the body is fitted.
ViewKind view_of(const Body& body) {
    const Vec3 left = body.at(VFIT_JOINT_LEFT_SHOULDER) - body.at(VFIT_JOINT_RIGHT_SHOULDER) +
                      body.at(VFIT_JOINT_LEFT_HIP) - body.at(VFIT_JOINT_RIGHT_HIP);
    return view_kind_of(Vec3(left.z, 0.0f, -left.x), kJointsSlack_rad);
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

}  // namespace

PersonScan::PersonScan(const PersonScanDesc& desc) : desc_(desc), paper_(desc.paper) {
    if (desc.fit_model && desc.measure_model) body_ = std::make_unique<BodyScan>(desc.fit_model);
}

void PersonScan::reset() {
    paper_.reset();
    if (body_) body_->reset();
    side_frames_ = more_side_frames_ = 0;
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
    progress.taken = progress.guidance == VFIT_GUIDANCE_NONE;
    progress.frames_taken = frames_taken();
    progress.compute_ms = watch.ms();
    return progress;
}

vfit_guidance PersonScan::fit(const ScanFrame& frame) {
    const ViewKind seen = view_of(*frame.body);
    const bool front = seen == ViewKind::kFront, side = seen == ViewKind::kSide;
    if (paper_.complete() ? !side : !front && !side)
        return paper_.complete() ? VFIT_GUIDANCE_TURN_SIDEWAYS : VFIT_GUIDANCE_FACE_CAMERA;
    if (side && side_frames_ >= side_frames_wanted()) return VFIT_GUIDANCE_FACE_CAMERA;
    if (front && !arms_out(*frame.body)) return VFIT_GUIDANCE_ARMS_OUT;
    if (body_->add(frame.image, *frame.body) != seen) return VFIT_GUIDANCE_HOLD_STILL;
    if (front)
        paper_.take(frame);
    else
        ++side_frames_;
    return VFIT_GUIDANCE_NONE;
}

InferredSex PersonScan::inferred_sex() const {
    if (desc_.paper.sex != VFIT_SEX_UNKNOWN) return {desc_.paper.sex, 1.0f};
    if (!fitted_shape()) return {};
    const float female =
        desc_.measure_model->female_probability(body_->features(with_side()), {with_side(), desc_.tight});
    if (female > 0.5f) return {VFIT_SEX_FEMALE, female};
    return {VFIT_SEX_MALE, 1.0f - female};
}

std::vector<Measurement> PersonScan::measurements() const {
    if (!body_) return paper_.measurements();
    if (frames_taken() == 0) fail(VFIT_ERROR_STATE, "scan: no frame from the front has been taken yet");
    const bool side = with_side();
    std::vector<Measurement> out =
        desc_.measure_model->measure(body_->features(side), {side, desc_.tight}, desc_.paper.sex);
    if (!desc_.bare)
        for (Measurement& m : out)
            if (m.key == "stature_m") m.sigma = std::hypot(m.sigma, kHairAndShoes_m);
    return out;
}

}  // namespace vfit
