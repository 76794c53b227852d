#include "fit/body_fit.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"
#include "core/wipe.h"
#include "math/finite.h"
#include "math/quaternion.h"

namespace vfit {

namespace {

// How much firmer than their spread among bodies the components are held: rows err together, and clothes that
// hang off the body pull the legs short and the hips wide. Chosen on virtual clothed people and judged on
// recordings.
constexpr double kFirmness = 50.0;
constexpr float kUsualLayer = 0.8f, kLayerSpread = 1.0f;  // units of kLayerUnit_m
constexpr float kLeastConfidence = 0.15f;                 // of a joint that is used at all
// One frame's information about the shape that counts: the errors of frames that follow each other are much
// the same.
constexpr double kFrameShare = 0.5;
constexpr int kShapeFrames = 300;   // then the shape moves by 1/150 of what a frame says
constexpr int kSettledFrames = 30;  // a second: then the shape is held
constexpr double kHold = 5.0;       // times as firmly as what is known of it would
constexpr float kGoodIou = 0.70f, kGoodMedian_m = 0.04f;
constexpr float kFrame_s = 1.0f / 30.0f;
constexpr float kLongestStep_rad = 0.6f, kLongestStep_m = 0.3f;
constexpr double kDamping = 1.0;  // rad^-2 and m^-2: for directions that nothing holds
constexpr int kReachSteps = 3, kReachStepsAtFirst = 25, kReachStepsOfLimb = 8;
constexpr float kWideRobust_m = 0.10f;
constexpr float kLimbRobust_m = 1.0f;  // of a limb's joints, which may be an arm's length away
constexpr float kBetter = 0.97f;       // of the cost: the other start has to win by this
// The same of a start with limbs where the network is sure to see them: a hand covers little of the picture.
constexpr float kLimbBetter = 1.2f;
// Of frames that follow each other within half a second: who turns or steps farther was cut, not moving.
constexpr float kCutTurn_rad = 0.6f, kCutStep_m = 0.3f;
constexpr float kTurnedAbout_rad = 1.0f;  // from the last frame, by the joints: the person faces elsewhere
constexpr float kSure = 0.3f;             // confidence
constexpr float kAgree_m = 0.10f;         // from the last frame's joints: the network says nothing else

bool good(const FitScore& score) { return score.iou >= kGoodIou && score.median_m <= kGoodMedian_m; }

bool finite(const FitState& state) {
    for (const Quat& q : state.rotation)
        if (!vfit::finite(q)) return false;
    for (const float s : state.shape)
        if (!std::isfinite(s)) return false;
    return vfit::finite(state.hips);
}

/// The step cut where it is longer than what the linear equations hold for.
void limit(FitVector& step) {
    double scale = 1.0;
    for (size_t i = 0; i < size_t(kFitPoseUnknowns); ++i) {
        const double most = i < size_t(kFitHipsColumn) ? kLongestStep_rad : kLongestStep_m;
        if (std::abs(step[i]) * scale > most) scale = most / std::abs(step[i]);
    }
    for (double& x : step) x *= scale;
}

/// Lower triangle of the inverse's diagonal by Cholesky; `matrix` is positive definite.
FitShape standard_deviations(const FitShapeMatrix& matrix) {
    constexpr size_t n = kFitShapes;
    FitShapeMatrix factor{};
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j <= i; ++j) {
            double sum = matrix[i][j];
            for (size_t k = 0; k < j; ++k) sum -= factor[i][k] * factor[j][k];
            factor[i][j] = i == j ? std::sqrt(std::max(sum, 1e-12)) : sum / factor[j][j];
        }
    FitShape out{};
    for (size_t column = 0; column < n; ++column) {
        // Solve L y = e: the diagonal of the inverse is the sum of the squares of y's.
        std::array<double, n> y{};
        for (size_t i = column; i < n; ++i) {
            double sum = i == column ? 1.0 : 0.0;
            for (size_t k = column; k < i; ++k) sum -= factor[i][k] * y[k];
            y[i] = sum / factor[i][i];
        }
        double squares = 0.0;
        for (const double v : y) squares += v * v;
        out[column] = float(std::sqrt(squares));
    }
    return out;
}

float turned_rad(const FitState& a, const FitState& b) {
    return angle_of(a.rotation[VFIT_BONE_HIPS] * glm::conjugate(b.rotation[VFIT_BONE_HIPS]));
}

}  // namespace

FitShape usual_shape() {
    FitShape shape{};
    for (size_t i = kFitComponents; i < size_t(kFitShapes); ++i) shape[i] = kUsualLayer;
    return shape;
}

BodyFit::BodyFit(std::shared_ptr<const FitModel> model, const BodyFitOptions& options)
    : model_(std::move(model)), options_(options), body_(*model_) {
    targets_.reserve(model_->vertex_count());
    reset();
}

void BodyFit::reset() {
    view_.wipe();
    raster_.wipe();
    body_.wipe();
    targets_.wipe();
    equations_.wipe();
    wipe(last_), wipe(shape_), wipe(seen_), wipe(out_);
    tracked_ = drawn_ = false;
    last_ns_ = 0;
    last_ = FitState{};
    shape_ = usual_shape();
    shape_frames_ = 0;
    out_ = BodyFitOutput{};
}

FitShapeMatrix BodyFit::shape_knowledge() const {
    FitShapeMatrix out = seen_;
    const double share = kFrameShare * double(shape_frames_);
    for (auto& row : out)
        for (double& x : row) x *= share;
    for (size_t i = 0; i < size_t(kFitShapes); ++i)
        out[i][i] += i < size_t(kFitComponents) ? kFirmness : 1.0 / double(kLayerSpread * kLayerSpread);
    return out;
}

FitShapeMatrix BodyFit::shape_hold() const {
    FitShapeMatrix out = shape_knowledge();
    if (shape_frames_ >= kSettledFrames)
        for (auto& row : out)
            for (double& x : row) x *= kHold;
    return out;
}

bool BodyFit::start_from_joints(const FitJoints& joints, FitState& state) const {
    const auto at = [&](int j) { return joints[size_t(j)].place; };
    for (const int j :
         {VFIT_JOINT_LEFT_SHOULDER, VFIT_JOINT_RIGHT_SHOULDER, VFIT_JOINT_LEFT_HIP, VFIT_JOINT_RIGHT_HIP})
        if (joints[size_t(j)].confidence <= 0.0f) return false;
    const Vec3 hips = 0.5f * (at(VFIT_JOINT_LEFT_HIP) + at(VFIT_JOINT_RIGHT_HIP));
    const Vec3 shoulders = 0.5f * (at(VFIT_JOINT_LEFT_SHOULDER) + at(VFIT_JOINT_RIGHT_SHOULDER));
    Vec3 up = shoulders - hips;
    Vec3 left = at(VFIT_JOINT_LEFT_SHOULDER) - at(VFIT_JOINT_RIGHT_SHOULDER) + at(VFIT_JOINT_LEFT_HIP) -
                at(VFIT_JOINT_RIGHT_HIP);
    if (glm::length(up) < 0.05f || glm::length(left) < 0.02f) return false;
    up = glm::normalize(up);
    left -= glm::dot(left, up) * up;
    if (glm::length(left) < 0.01f) return false;
    left = glm::normalize(left);
    state = FitState{};
    state.shape = shape_;
    state.hips = hips;
    state.rotation[VFIT_BONE_HIPS] = glm::normalize(glm::quat_cast(Mat3(left, up, glm::cross(left, up))));
    const Quat lowered(std::cos(0.6f), 0.0f, 0.0f, -std::sin(0.6f));  // 1.2 rad: arms hang
    state.rotation[VFIT_BONE_LEFT_UPPER_ARM] = lowered;
    state.rotation[VFIT_BONE_RIGHT_UPPER_ARM] = glm::conjugate(lowered);
    return true;
}

void BodyFit::reach_for_joints(const FitJoints& joints, const FitWeights& weights, int steps,
                               FitState& state) {
    const FitShapeMatrix hold = shape_hold();
    for (int i = 0; i < steps; ++i) {
        body_.place_bones(state);
        equations_.start(body_);
        add_joint_rows(joints, body_, weights, equations_);
        equations_.finish();
        add_pose_priors(state, equations_);
        std::array<double, kFitShapes> back;
        for (size_t s = 0; s < back.size(); ++s) back[s] = double(shape_[s] - state.shape[s]);
        equations_.add_shape_prior(hold, back);
        for (int c = 0; c < kFitPoseUnknowns; ++c) equations_.add_prior(c, 0.0, 10.0 * kDamping);
        FitVector step;
        if (!equations_.solve(step)) return;
        limit(step);
        if (!options_.shape) std::fill(step.begin() + kFitPoseUnknowns, step.end(), 0.0);
        apply_step(step, state);
    }
}

void BodyFit::draw(const FitState& state) {
    body_.place(state);
    raster_.draw(body_, view_);
}

FitScore BodyFit::score_of(const FitState& state) {
    draw(state);
    return raster_.score(view_);
}

/// The last frame's pose, that pose moved to the joints, or one made from the joints alone: whichever meets
/// the picture best, the later ones tried only where there is a reason.
bool BodyFit::find_start(const BodyFitInput& input, bool follow, FitState& state) {
    bool started = false;
    const auto consider = [&](const FitState& candidate, bool from_last, float better = kBetter) {
        const FitScore score = score_of(candidate);
        drawn_ = !started || score.cost < better * out_.start_score.cost;
        if (!drawn_) return;
        state = candidate;
        out_.start_score = score;
        out_.from_last = from_last;
        started = true;
    };
    FitState afresh;
    const bool can_start = start_from_joints(input.joints, afresh);
    // Seen from a side, the outline is as good with left and right exchanged: joints decide.
    if (follow && !(can_start && turned_rad(afresh, last_) > kTurnedAbout_rad)) {
        consider(last_, true);
        FitJoints wanted = input.joints;
        const bool astray = limbs_astray(wanted);
        if (good(out_.start_score) && astray) {
            // One limb that lost its way, in a body that is right: the whole picture would hardly tell.
            FitState mended = last_;
            FitWeights weights = options_.weights;
            weights.joint_robust_m = kLimbRobust_m;
            reach_for_joints(wanted, weights, kReachStepsOfLimb, mended);
            consider(mended, false, kLimbBetter);
        } else if (!good(out_.start_score) || !agrees_with(input.joints)) {
            FitState reached = last_;
            reach_for_joints(input.joints, options_.weights, kReachSteps, reached);
            consider(reached, false);
        }
    }
    if (can_start && (!started || !good(out_.start_score))) {
        reach_for_joints(input.joints, options_.weights, kReachStepsAtFirst, afresh);
        consider(afresh, false);
    }
    return started;
}

/// Keeps of `joints` those of arms and legs of which the network is sure and sees somewhere else; the others
/// become the body's own as it is placed. False where none is left, or where the trunk lies elsewhere, too.
bool BodyFit::limbs_astray(FitJoints& joints) const {
    constexpr std::array<std::array<int, 3>, 4> kLimbs = {
        {{VFIT_JOINT_LEFT_ELBOW, VFIT_JOINT_LEFT_WRIST, VFIT_JOINT_LEFT_HAND},
         {VFIT_JOINT_RIGHT_ELBOW, VFIT_JOINT_RIGHT_WRIST, VFIT_JOINT_RIGHT_HAND},
         {VFIT_JOINT_LEFT_KNEE, VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_LEFT_TOES},
         {VFIT_JOINT_RIGHT_KNEE, VFIT_JOINT_RIGHT_FOOT, VFIT_JOINT_RIGHT_TOES}}};
    const auto elsewhere = [&](int j) {
        const FitJoint& joint = joints[size_t(j)];
        return joint.confidence > kSure && glm::distance(joint.place, body_.joints()[size_t(j)]) > kAgree_m;
    };
    std::array<bool, kJointCount> free{};
    bool any = false;
    for (const auto& limb : kLimbs)
        if (std::any_of(limb.begin(), limb.end(), elsewhere)) {
            for (const int j : limb) free[size_t(j)] = true;
            any = true;
        }
    for (int j = 0; j < kJointCount; ++j)
        if (!free[size_t(j)]) joints[size_t(j)] = {body_.joints()[size_t(j)], 1.0f};
    return any;
}

/// Whether every joint that the network is sure of lies near the body's as it is placed.
bool BodyFit::agrees_with(const FitJoints& joints) const {
    for (size_t j = 0; j < size_t(kJointCount); ++j)
        if (joints[j].confidence > kSure && glm::distance(joints[j].place, body_.joints()[j]) > kAgree_m)
            return false;
    return true;
}

/// Whether the person stands so differently from the last frame's that the two do not follow each other: a
/// recording that was cut, or another one. Nothing of the last pose then holds.
bool BodyFit::is_cut(const FitState& state) const {
    return turned_rad(state, last_) > kCutTurn_rad || glm::distance(state.hips, last_.hips) > kCutStep_m;
}

/// From `state` as it was drawn.
bool BodyFit::step(const BodyFitInput& input, const FitState* last, float frames, float robust_m,
                   FitState& state) {
    FitWeights weights = options_.weights;
    weights.robust_m = robust_m;
    equations_.start(body_);
    out_.matched =
        options_.depth_rows ? add_depth_rows(view_, body_, raster_, weights, targets_, equations_) : 0;
    if (options_.outline_rows) add_outline_rows(view_, body_, raster_, weights, equations_);
    if (options_.joint_rows) add_joint_rows(input.joints, body_, weights, equations_);
    equations_.finish();
    add_pose_priors(state, equations_);
    if (last) add_motion_priors(state, *last, frames, equations_);
    std::array<double, kFitShapes> back;
    for (size_t s = 0; s < back.size(); ++s) back[s] = double(shape_[s] - state.shape[s]);
    equations_.add_shape_prior(shape_hold(), back);
    for (int c = 0; c < kFitPoseUnknowns; ++c) equations_.add_prior(c, 0.0, kDamping);
    FitVector change;
    if (!equations_.solve(change)) return false;
    limit(change);
    if (!options_.shape) std::fill(change.begin() + kFitPoseUnknowns, change.end(), 0.0);
    apply_step(change, state);
    return true;
}

void BodyFit::learn_shape(const FitShape& shape) {
    // What the last step's equations know beyond what was known before it.
    const FitShapeMatrix& now = equations_.shape_information();
    const FitShapeMatrix before = shape_hold();
    shape_frames_ = std::min(shape_frames_ + 1, kShapeFrames);
    for (size_t i = 0; i < size_t(kFitShapes); ++i)
        for (size_t j = 0; j < size_t(kFitShapes); ++j)
            seen_[i][j] += (now[i][j] - before[i][j] - seen_[i][j]) / double(shape_frames_);
    shape_ = shape;
}

const BodyFitOutput& BodyFit::run(const BodyFitInput& input_as_given) {
    BodyFitInput input = input_as_given;
    for (FitJoint& joint : input.joints)
        if (!vfit::finite(joint.place) || !(joint.confidence >= kLeastConfidence)) joint.confidence = 0.0f;
    out_.state = BodyFitState::kNothing;
    out_.matched = 0;
    out_.score = out_.start_score = FitScore{};
    out_.from_last = out_.cut = false;
    const double gap_s = seconds_between(last_ns_, input.time_ns);
    const float frames = float(gap_s) / kFrame_s;
    const bool follow = tracked_ && gap_s > 0.0 && gap_s < 0.5;
    if (!view_.look(input.image, input.user, input.box)) {
        tracked_ = false;
        return out_;
    }

    FitState state;
    if (!find_start(input, follow, state)) {
        tracked_ = false;
        return out_;
    }

    out_.cut = follow && is_cut(state);
    const bool follows = follow && !out_.cut;
    const bool calm = follows && good(out_.start_score);
    const int steps = calm ? options_.steps : options_.steps_at_first;
    bool solved = true;
    for (int i = 0; solved && i < steps; ++i) {
        const float robust_m = !calm && i < 2 ? kWideRobust_m : options_.weights.robust_m;
        if (!drawn_) draw(state);
        drawn_ = false;
        // Where little moves, the picture before the last step is judged: one less to draw.
        if (calm && i + 1 == steps) out_.score = raster_.score(view_);
        solved = step(input, follows ? &last_ : nullptr, frames, robust_m, state);
    }
    if (!solved || !finite(state)) {
        tracked_ = false;
        return out_;
    }
    if (!calm) out_.score = score_of(state);
    out_.state = good(out_.score) ? BodyFitState::kGood : BodyFitState::kPoor;
    if (out_.state == BodyFitState::kGood && options_.shape) {
        learn_shape(state.shape);
    } else if (options_.shape) {
        state.shape = shape_;  // one bad picture does not change a body
    }
    tracked_ = out_.state == BodyFitState::kGood;
    last_ = state;
    last_ns_ = input.time_ns;
    tell(input);
    return out_;
}

void BodyFit::tell(const BodyFitInput& input) {
    body_.place(last_);
    out_.pose = last_;
    out_.joints = body_.joints();
    for (size_t j = 0; j < size_t(kJointCount); ++j) {
        out_.rotations[j] = body_.bone_rotations()[size_t(kJointPlaces[j].bone)];
        out_.confidence[j] = input.joints[j].confidence;
    }
    out_.shape_sd = standard_deviations(shape_knowledge());
    for (size_t i = 0; i < size_t(kFitComponents); ++i) out_.shape_sd[i] *= float(std::sqrt(kFirmness));
}

}  // namespace vfit
