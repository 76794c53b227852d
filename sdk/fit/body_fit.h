// The body model fitted to one person, frame after frame: depth, outline and the network's joints in; pose,
// shape and joints with rotations out.
#pragma once

#include <cstdint>
#include <memory>

#include "fit/fit_priors.h"
#include "fit/fit_rows.h"

namespace vfit {

struct BodyFitInput {
    DepthImage image;  // with a user map
    uint8_t user = 0;  // the person's id in it
    PixelBox box;      // where they are; empty: anywhere
    int64_t time_ns = 0;
    FitJoints joints;  // camera space
};

enum class BodyFitState {
    kNothing,  // too few pixels or joints: nothing is said
    kPoor,     // fitted, but what the camera sees is something else
    kGood,
};

struct BodyFitOutput {
    BodyFitState state = BodyFitState::kNothing;
    FitState pose;                              // camera space
    std::array<Vec3, kJointCount> joints{};     // camera space
    std::array<Quat, kJointCount> rotations{};  // of the joint's bone, from the T-pose's axes to the camera's
    std::array<float, kJointCount> confidence{};  // 0 to 1
    FitShape shape_sd{};                          // standard deviations of the shape so far
    FitScore score;                               // how well the camera's picture is met
    FitScore start_score;                         // of the start that was taken
    uint32_t matched = 0;                         // depth points in the last step
    bool from_last = false;                       // started from the last frame, not from the joints alone
    bool cut = false;                             // stands so differently that this frame follows no other
};

struct BodyFitOptions {
    FitWeights weights;
    int steps_at_first = 8;  // Gauss-Newton steps where there is no good last frame
    int steps = 2;           // after one
    bool depth_rows = true, outline_rows = true, joint_rows = true,
         shape = true;  // for judging each one's part
};

class BodyFit {
public:
    explicit BodyFit(std::shared_ptr<const FitModel> model, const BodyFitOptions& options = {});
    ~BodyFit() { reset(); }
    BodyFit(const BodyFit&) = delete;
    BodyFit& operator=(const BodyFit&) = delete;

    /// Does not allocate after its first run on an image of that size. The output stays valid until the next
    /// run.
    const BodyFitOutput& run(const BodyFitInput& input);
    /// Overwrites all that is of the person: another one comes.
    void reset();

    const BodyFitOutput& output() const { return out_; }
    const FitModel& model() const { return *model_; }
    /// As it was fitted to the last image.
    const FitBody& body() const { return body_; }
    /// In the last image, behind another part of the body.
    bool hidden(uint32_t vertex) const { return raster_.hidden(body_, view_, vertex); }

private:
    bool start_from_joints(const FitJoints& joints, FitState& state) const;
    void reach_for_joints(const FitJoints& joints, const FitWeights& weights, int steps, FitState& state);
    bool find_start(const BodyFitInput& input, bool follow, FitState& state);
    bool limbs_astray(FitJoints& joints) const;
    bool agrees_with(const FitJoints& joints) const;
    bool is_cut(const FitState& state) const;
    bool step(const BodyFitInput& input, const FitState* last, float frames, float robust_m, FitState& state);
    void draw(const FitState& state);
    FitScore score_of(const FitState& state);
    void learn_shape(const FitShape& shape);
    void tell(const BodyFitInput& input);
    FitShapeMatrix shape_knowledge() const;  // information, of the frames so far and of bodies in general
    FitShapeMatrix shape_hold() const;       // the weight that keeps the shape where it is

    std::shared_ptr<const FitModel> model_;
    BodyFitOptions options_;
    FitBody body_;
    FitView view_;
    FitRaster raster_;
    FitTargets targets_;
    FitEquations equations_;
    BodyFitOutput out_;

    bool drawn_ = false;    // body and raster are of the state to start from
    bool tracked_ = false;  // the last frame's fit was good
    FitState last_;
    int64_t last_ns_ = 0;
    FitShape shape_{};       // best so far
    FitShapeMatrix seen_{};  // mean information of a frame about the shape
    int shape_frames_ = 0;
};

/// Layers of clothing before anything is seen: a thin one.
FitShape usual_shape();

}  // namespace vfit
