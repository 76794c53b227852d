#include "scan/person_scan.h"

#include <cmath>

#include "core/clock.h"
#include "core/error.h"

namespace vfit {

namespace {

constexpr uint32_t kFewestSideFrames = 5;  // fewer are not worth the other estimator
// Deviation of what hair and shoes add, where nobody says that there are none: 0 to 5 cm, evenly.
constexpr float kHairAndShoes_m = 0.015f;
constexpr float kFront_rad = 0.7f, kSideFrom_rad = 1.0f, kSideTo_rad = 2.15f;
// From a hand to the hip joint of its side, across: nearer, and the arm hides the trunk's outline.
constexpr float kArmsOut_m = 0.14f;

/// From across the trunk to the image plane: 0 faces the camera, pi turns its back; a half pi is a side view.
float turned_rad(const Body& body) {
    const Vec3 left = body.at(VFIT_JOINT_LEFT_SHOULDER) - body.at(VFIT_JOINT_RIGHT_SHOULDER) +
                      body.at(VFIT_JOINT_LEFT_HIP) - body.at(VFIT_JOINT_RIGHT_HIP);
    return std::atan2(std::abs(left.z), left.x);
}

bool arms_out(const Body& body) {
    const Vec3 across = glm::normalize(body.at(VFIT_JOINT_LEFT_HIP) - body.at(VFIT_JOINT_RIGHT_HIP));
    for (const float side : {1.0f, -1.0f}) {
        const int hand = side > 0 ? VFIT_JOINT_LEFT_HAND : VFIT_JOINT_RIGHT_HAND;
        const int hip = side > 0 ? VFIT_JOINT_LEFT_HIP : VFIT_JOINT_RIGHT_HIP;
        if (body.has(hand) && side * glm::dot(across, body.at(hand) - body.at(hip)) < kArmsOut_m) return false;
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
    side_frames_ = 0;
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
    const float turned = turned_rad(*frame.body);
    const bool front = turned <= kFront_rad, side = turned >= kSideFrom_rad && turned <= kSideTo_rad;
    if (paper_.complete() ? !side : !front && !side)
        return paper_.complete() ? VFIT_GUIDANCE_TURN_SIDEWAYS : VFIT_GUIDANCE_FACE_CAMERA;
    if (side && side_frames_ >= side_frames_wanted()) return VFIT_GUIDANCE_FACE_CAMERA;
    if (front && !arms_out(*frame.body)) return VFIT_GUIDANCE_ARMS_OUT;
    const FitViewKind view = body_->add(frame.image, *frame.body);
    if (view != (front ? FitViewKind::kFront : FitViewKind::kSide)) return VFIT_GUIDANCE_HOLD_STILL;
    if (front)
        paper_.take(frame);
    else
        ++side_frames_;
    return VFIT_GUIDANCE_NONE;
}

std::vector<Measurement> PersonScan::measurements() const {
    if (!body_) return paper_.measurements();
    if (frames_taken() == 0) fail(VFIT_ERROR_STATE, "scan: no frame from the front has been taken yet");
    const bool side = side_frames_ >= kFewestSideFrames;
    std::vector<Measurement> out = desc_.measure_model->measure(body_->features(side), side, desc_.paper.sex);
    if (!desc_.bare)
        for (Measurement& m : out)
            if (m.key == "stature_m") m.sigma = std::hypot(m.sigma, kHairAndShoes_m);
    return out;
}

}  // namespace vfit
