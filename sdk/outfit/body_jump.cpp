#include "outfit/body_jump.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_inverse.hpp>
#include <numeric>

#include "cloth/base/rigid_motion.h"
#include "core/error.h"

namespace vfit {

namespace {

constexpr uint32_t kJumpChunk = 512;  // vertices of one item of work
constexpr float kRigid = 2e-5f;       // of matrices in metres: rounding of a body some metres off the origin
constexpr uint32_t kNoVertex = UINT32_MAX;

Vec3 moved(const Mat4& m, const Vec3& p) { return Mat3(m) * p + Vec3(m[3]); }

bool equal(const Mat4& a, const Mat4& b, float tolerance) {
    float most = 0.0f;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) most = std::max(most, std::abs(a[column][row] - b[column][row]));
    return most <= tolerance;
}

}  // namespace

BodyJump::BodyJump(const Carry& carry, std::span<const Vec3> rest) : carry_(&carry) {
    if (rest.size() != carry.vertex_count())
        fail(VFIT_ERROR_ARGUMENT, rest.size(), " places for cloth of ", carry.vertex_count(), " vertices");
    find_outermost(rest);
}

/// The vertices that a rigid bone moves furthest are about the extreme ones along some axis.
void BodyJump::find_outermost(std::span<const Vec3> rest) {
    struct Ends {
        uint32_t low[3] = {kNoVertex, kNoVertex, kNoVertex}, high[3] = {kNoVertex, kNoVertex, kNoVertex};
    };
    std::vector<Ends> ends;
    for (uint32_t v = 0; v < rest.size(); ++v) {
        const uint32_t bone = carry_->heaviest_bone(v);
        if (bone >= ends.size()) ends.resize(bone + 1);
        for (int k = 0; k < 3; ++k) {
            uint32_t &low = ends[bone].low[k], &high = ends[bone].high[k];
            if (low == kNoVertex || rest[v][k] < rest[low][k]) low = v;
            if (high == kNoVertex || rest[v][k] > rest[high][k]) high = v;
        }
    }
    for (const Ends& of_bone : ends)
        for (const auto& side : {of_bone.low, of_bone.high})
            for (int k = 0; k < 3; ++k)
                if (side[k] != kNoVertex) outermost_.push_back({side[k], rest[side[k]]});
    all_outermost_.resize(outermost_.size());
    std::iota(all_outermost_.begin(), all_outermost_.end(), 0u);
    from_.reserve(outermost_.size()), to_.reserve(outermost_.size());
}

void BodyJump::stand(std::span<const Mat4> pose) {
    carry_->check_matrices(pose);
    for (std::vector<Mat4>* at : {&earlier_, &before_, &now_}) at->assign(pose.begin(), pose.end());
    dt_ = earlier_dt_ = 0.0f;
    felt_ = earlier_felt_ = 1.0f;
    way_ = {};
}

void BodyJump::move_to(std::span<const Mat4> pose, float dt) {
    carry_->check_matrices(pose);
    std::swap(earlier_, before_);
    std::swap(before_, now_);
    now_.assign(pose.begin(), pose.end());
    earlier_dt_ = dt_, dt_ = dt;
    earlier_felt_ = felt_, felt_ = 1.0f;
    way_ = {};
    if (outermost_.empty()) return;
    from_.clear(), to_.clear();
    for (const Sample& s : outermost_) {
        from_.push_back(moved(carry_->blended(s.vertex, before_), s.rest));
        to_.push_back(moved(carry_->blended(s.vertex, now_), s.rest));
    }
    const RigidMotion whole = fit_rigid_motion(all_outermost_, from_, to_);
    way_.min_m = INFINITY;
    for (size_t i = 0; i < from_.size(); ++i) {
        const Vec3 with_all = whole.point(from_[i]);
        way_.min_m = std::min(way_.min_m, glm::distance(from_[i], to_[i]));
        way_.whole_m = std::max(way_.whole_m, glm::distance(from_[i], with_all));
        way_.limb_m = std::max(way_.limb_m, glm::distance(with_all, to_[i]));
    }
}

bool BodyJump::is_rigid() const {
    const Mat4 motion = now_[0] * glm::affineInverse(before_[0]);
    for (size_t bone = 1; bone < now_.size(); ++bone)
        if (!equal(motion * before_[bone], now_[bone], kRigid)) return false;
    return true;
}

void BodyJump::carry(std::span<const Vec3> positions, float fraction, Jobs& jobs) {
    const uint32_t count = carry_->vertex_count();
    if (positions.size() != count)
        fail(VFIT_ERROR_ARGUMENT, positions.size(), " places for cloth of ", count, " vertices");
    felt_ = 1.0f - fraction;
    places_.resize(count);
    turns_.resize(count);
    speeds_.resize(count);
    const bool jumps = felt_ == 0.0f;
    const float felt_per_s = earlier_dt_ > 0.0f ? earlier_felt_ / earlier_dt_ : 0.0f;
    parallel_for(jobs, (count + kJumpChunk - 1) / kJumpChunk, [&](uint32_t chunk) {
        const uint32_t last = std::min(count, (chunk + 1) * kJumpChunk);
        for (uint32_t v = chunk * kJumpChunk; v < last; ++v) {
            const Vec3& at = positions[v];
            const Mat4 motion = carry_->motion(v, before_, now_);
            const Vec3 way = moved(motion, at) - at;
            places_[v] = at + fraction * way;
            turns_[v] = Mat3(1.0f) + fraction * (Mat3(motion) - Mat3(1.0f));
            speeds_[v] = Vec3(0.0f);
            if (jumps && felt_per_s > 0.0f)
                speeds_[v] = turns_[v] * (moved(carry_->motion(v, before_, earlier_), at) - at) * felt_per_s;
            else if (!jumps && follows_jump())
                speeds_[v] = way * (felt_ / dt_);
        }
    });
}

}  // namespace vfit
