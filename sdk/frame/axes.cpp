#include "frame/axes.h"

#include "core/error.h"

namespace vfit {

namespace {

/// Rows of the map from (x, y, z) inside to the host's axes, and the host's length of a metre.
struct Convention {
    Mat3 map;
    float scale;
    bool flip_v;
};

Mat3 rows(const Vec3& a, const Vec3& b, const Vec3& c) { return glm::transpose(Mat3(a, b, c)); }

Convention convention_of(vfit_axes axes) {
    switch (axes) {
        case VFIT_AXES_RH_Y_UP: return {Mat3(1.0f), 1.0f, false};
        // Left-handed, Y up, forward stays +Z: the character's left goes from +X to -X.
        case VFIT_AXES_UNITY: return {rows({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}), 1.0f, true};
        // Left-handed, Z up, X forward, centimetres: the character's left is -Y.
        case VFIT_AXES_UNREAL: return {rows({0, 0, 1}, {-1, 0, 0}, {0, 1, 0}), 100.0f, false};
        default: fail(VFIT_ERROR_ARGUMENT, "unknown axes convention ", axes);
    }
}

}  // namespace

Axes::Axes(vfit_axes axes, bool mirror) : mirror_(mirror) {
    const Convention convention = convention_of(axes);
    map_ = convention.map;
    if (mirror) map_ = map_ * Mat3(Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
    transposed_ = glm::transpose(map_);
    determinant_ = glm::determinant(map_);
    scale_ = convention.scale;
    flip_v_ = convention.flip_v;
    identity_ = axes == VFIT_AXES_RH_Y_UP && !mirror;
}

// A rotation's axis is a pseudo-vector: a reflection turns it about as well.
Quat Axes::rotation_out(const Quat& q) const {
    const Vec3 v = determinant_ * (map_ * Vec3(q.x, q.y, q.z));
    return Quat(q.w, v.x, v.y, v.z);
}

Quat Axes::rotation_in(const Quat& q) const {
    const Vec3 v = determinant_ * (transposed_ * Vec3(q.x, q.y, q.z));
    return Quat(q.w, v.x, v.y, v.z);
}

Mat4 Axes::matrix_out(const Mat4& m) const {
    Mat4 out(map_ * Mat3(m) * transposed_);
    out[3] = Vec4(point_out(Vec3(m[3])), 1.0f);
    return out;
}

int Axes::bone_out(int bone) const {
    constexpr int kArm = VFIT_BONE_RIGHT_SHOULDER - VFIT_BONE_LEFT_SHOULDER;
    if (!mirror_ || bone < VFIT_BONE_LEFT_SHOULDER) return bone;
    // Four bones a limb: left arm, right arm, left leg, right leg.
    const int limb = (bone - VFIT_BONE_LEFT_SHOULDER) / kArm;
    return limb % 2 == 0 ? bone + kArm : bone - kArm;
}

}  // namespace vfit
