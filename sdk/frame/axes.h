// Conventions of what is written: the host's axes, unit and mirroring, as one orthogonal map and a scale.
// Inside the library everything is metres, right-handed, Y up; only sdk/api converts, at the border.
#pragma once

#include "frame/body.h"
#include "math/types.h"
#include "vfit.h"

namespace vfit {

class Axes {
public:
    /// Fails with VFIT_ERROR_ARGUMENT for an unknown convention.
    Axes(vfit_axes convention, bool mirror);
    Axes() : Axes(VFIT_AXES_RH_Y_UP, false) {}

    bool identity() const { return identity_; }
    /// Left-handed output, or a mirrored right-handed one: triangles turn over.
    bool flips_winding() const { return determinant_ < 0.0f; }
    bool mirrored() const { return mirror_; }
    bool flips_v() const { return flip_v_; }
    float unit() const { return scale_; }  // written lengths per metre

    Vec3 point_out(const Vec3& p) const { return map_ * p * scale_; }
    Vec3 point_in(const Vec3& p) const { return transposed_ * p / scale_; }
    Vec3 direction_out(const Vec3& d) const { return map_ * d; }
    float length_out(float x) const { return x * scale_; }
    float length_in(float x) const { return x / scale_; }
    Quat rotation_out(const Quat& q) const;
    Quat rotation_in(const Quat& q) const;
    Mat4 matrix_out(const Mat4& m) const;
    Vec2 uv_out(const Vec2& uv) const { return flip_v_ ? Vec2(uv.x, 1.0f - uv.y) : uv; }

    /// In a mirror the left hand is a right hand.
    int joint_out(int joint) const { return mirror_ ? mirrored_joint(joint) : joint; }
    int bone_out(int bone) const;

private:
    Mat3 map_, transposed_;
    float scale_ = 1.0f;
    float determinant_ = 1.0f;
    bool mirror_ = false, flip_v_ = false, identity_ = true;
};

}  // namespace vfit
