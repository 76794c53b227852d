#include "avatar/skin_kernels.h"

#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "avatar/skin_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace vfit {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Four floats: a column of a matrix, a quaternion, a place. Highway's scalar target has vectors of one float
// alone.
#if HWY_TARGET == HWY_SCALAR
struct V {
    float x[4];
};
HWY_INLINE V Set(float a) { return {{a, a, a, a}}; }
HWY_INLINE V Load(const float* p) { return {{p[0], p[1], p[2], p[3]}}; }
HWY_INLINE V Mul(V a, V b) { return {{a.x[0] * b.x[0], a.x[1] * b.x[1], a.x[2] * b.x[2], a.x[3] * b.x[3]}}; }
HWY_INLINE V MulAdd(V a, V b, V c) {
    return {{a.x[0] * b.x[0] + c.x[0], a.x[1] * b.x[1] + c.x[1], a.x[2] * b.x[2] + c.x[2],
             a.x[3] * b.x[3] + c.x[3]}};
}
HWY_INLINE void Store(V v, float* p) {
    for (int i = 0; i < 4; ++i) p[i] = v.x[i];
}
HWY_INLINE void StoreThree(V v, unsigned char* p) { std::memcpy(p, v.x, 3 * sizeof(float)); }
HWY_INLINE float Dot(V a, V b) {
    return (a.x[0] * b.x[0] + a.x[2] * b.x[2]) + (a.x[1] * b.x[1] + a.x[3] * b.x[3]);
}
/// 1 / length of the first three floats of each.
HWY_INLINE void InverseLengths(const V* n, float least2, float* lengths2, float* inverse) {
    for (int k = 0; k < 4; ++k) {
        lengths2[k] = n[k].x[0] * n[k].x[0] + (n[k].x[1] * n[k].x[1] + n[k].x[2] * n[k].x[2]);
        inverse[k] = 1.0f / std::sqrt(lengths2[k] > least2 ? lengths2[k] : least2);
    }
}
#else
constexpr hn::FixedTag<float, 4> kFour;
using V = hn::Vec<hn::FixedTag<float, 4>>;
HWY_INLINE V Set(float a) { return hn::Set(kFour, a); }
HWY_INLINE V Load(const float* p) { return hn::LoadU(kFour, p); }
HWY_INLINE V Mul(V a, V b) { return hn::Mul(a, b); }
HWY_INLINE V MulAdd(V a, V b, V c) { return hn::MulAdd(a, b, c); }
HWY_INLINE void Store(V v, float* p) { hn::StoreU(v, kFour, p); }
/// Two stores: what lies behind the three is the host's, at any address.
HWY_INLINE void StoreThree(V v, unsigned char* p) {
    constexpr hn::FixedTag<float, 2> half;
    hn::StoreU(hn::LowerHalf(half, v), half, reinterpret_cast<float*>(p));
    const float third = hn::GetLane(hn::Shuffle1032(v));
    std::memcpy(p + 2 * sizeof(float), &third, sizeof third);
}
HWY_INLINE float Dot(V a, V b) { return hn::GetLane(hn::SumOfLanes(kFour, hn::Mul(a, b))); }
HWY_INLINE void InverseLengths(const V* n, float least2, float* lengths2, float* inverse) {
    const V ac_low = hn::InterleaveLower(kFour, n[0], n[2]), bd_low = hn::InterleaveLower(kFour, n[1], n[3]);
    const V ac_high = hn::InterleaveUpper(kFour, n[0], n[2]),
            bd_high = hn::InterleaveUpper(kFour, n[1], n[3]);
    const V x = hn::InterleaveLower(kFour, ac_low, bd_low), y = hn::InterleaveUpper(kFour, ac_low, bd_low);
    const V z = hn::InterleaveLower(kFour, ac_high, bd_high);
    const V length2 = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
    Store(length2, lengths2);
    Store(hn::Div(Set(1.0f), hn::Sqrt(hn::Max(length2, Set(least2)))), inverse);
}
#endif

// A sum of matrices: their four columns, two in a vector where it is wide enough.
#if HWY_TARGET != HWY_SCALAR && !HWY_HAVE_SCALABLE && HWY_MAX_BYTES >= 32
constexpr hn::FixedTag<float, 8> kEight;
struct Columns {
    hn::Vec<hn::FixedTag<float, 8>> c01, c23;
};
HWY_INLINE Columns Weighted(const float* bone, float weight) {
    const auto w = hn::Set(kEight, weight);
    return {hn::Mul(w, hn::LoadU(kEight, bone)), hn::Mul(w, hn::LoadU(kEight, bone + 8))};
}
HWY_INLINE void Add(Columns& m, const float* bone, float weight) {
    const auto w = hn::Set(kEight, weight);
    m.c01 = hn::MulAdd(w, hn::LoadU(kEight, bone), m.c01);
    m.c23 = hn::MulAdd(w, hn::LoadU(kEight, bone + 8), m.c23);
}
HWY_INLINE void Split(const Columns& m, V& c0, V& c1, V& c2, V& c3) {
    c0 = hn::LowerHalf(kFour, m.c01);
    c1 = hn::UpperHalf(kFour, m.c01);
    c2 = hn::LowerHalf(kFour, m.c23);
    c3 = hn::UpperHalf(kFour, m.c23);
}
#else
struct Columns {
    V c0, c1, c2, c3;
};
HWY_INLINE Columns Weighted(const float* bone, float weight) {
    const V w = Set(weight);
    return {Mul(w, Load(bone)), Mul(w, Load(bone + 4)), Mul(w, Load(bone + 8)), Mul(w, Load(bone + 12))};
}
HWY_INLINE void Add(Columns& m, const float* bone, float weight) {
    const V w = Set(weight);
    m.c0 = MulAdd(w, Load(bone), m.c0);
    m.c1 = MulAdd(w, Load(bone + 4), m.c1);
    m.c2 = MulAdd(w, Load(bone + 8), m.c2);
    m.c3 = MulAdd(w, Load(bone + 12), m.c3);
}
HWY_INLINE void Split(const Columns& m, V& c0, V& c1, V& c2, V& c3) {
    c0 = m.c0, c1 = m.c1, c2 = m.c2, c3 = m.c3;
}
#endif

constexpr uint32_t kBatch = 4;  // vertices whose normals are brought to unit length together
constexpr float kNoLength2 = 1e-12f;

/// To unit length; one without a length becomes the vertex' own at rest.
HWY_INLINE void StoreNormals(const V* n, const SkinJob& job, uint32_t item, uint32_t count) {
    float lengths2[kBatch], inverse[kBatch];
    InverseLengths(n, kNoLength2, lengths2, inverse);
    for (uint32_t k = 0; k < count; ++k) {
        unsigned char* to = job.normals + size_t(job.order[item + k]) * job.normal_stride;
        if (HWY_LIKELY(lengths2[k] > kNoLength2))
            StoreThree(Mul(n[k], Set(inverse[k])), to);
        else
            std::memcpy(to, job.rest + job.rest_floats * size_t(item + k) + 3, 3 * sizeof(float));
    }
}

template <typename Matrix>
HWY_INLINE void Run(const SkinJob& job, const Matrix& matrix_of) {
    for (uint32_t item = job.first; item < job.last; item += kBatch) {
        const uint32_t count = HWY_MIN(kBatch, job.last - item);
        V normals[kBatch] = {Set(0.0f), Set(0.0f), Set(0.0f), Set(0.0f)};
        for (uint32_t k = 0; k < count; ++k) {
            const float* rest = job.rest + job.rest_floats * size_t(item + k);
            V c0, c1, c2, c3;
            matrix_of(item + k, c0, c1, c2, c3);
            V p = MulAdd(c0, Set(rest[0]), c3);
            p = MulAdd(c1, Set(rest[1]), p);
            p = MulAdd(c2, Set(rest[2]), p);
            StoreThree(p, job.positions + size_t(job.order[item + k]) * job.position_stride);
            if (!job.normals) continue;
            V n = Mul(c0, Set(rest[3]));
            n = MulAdd(c1, Set(rest[4]), n);
            normals[k] = MulAdd(c2, Set(rest[5]), n);
        }
        if (job.normals) StoreNormals(normals, job, item, count);
    }
}

void Linear(const SkinJob& given) {
    const SkinJob job = given;  // its own: stores could not change it
    Run(job, [&](uint32_t item, V& c0, V& c1, V& c2, V& c3) HWY_ATTR {
        const SkinInfluence* i = job.influences + job.starts[item];
        const SkinInfluence* end = job.influences + job.starts[item + 1];
        Columns sum = Weighted(job.bones + i->offset, i->weight);
        for (++i; i != end; ++i) Add(sum, job.bones + i->offset, i->weight);
        Split(sum, c0, c1, c2, c3);
    });
}

void DualQuaternion(const SkinJob& given, const float* map) {
    const SkinJob job = given;
    const V m0 = Load(map), m1 = Load(map + 4), m2 = Load(map + 8);
    Run(job, [&](uint32_t item, V& c0, V& c1, V& c2, V& c3) HWY_ATTR {
        const SkinInfluence* i = job.influences + job.starts[item];
        const SkinInfluence* end = job.influences + job.starts[item + 1];
        const float* bone = job.bones + i->offset;
        const V heaviest = Load(bone);
        V real = Mul(heaviest, Set(i->weight)), dual = Mul(Load(bone + 4), Set(i->weight));
        for (++i; i != end; ++i) {
            bone = job.bones + i->offset;
            const V q = Load(bone);
            // q and -q are one rotation: blend on the heaviest bone's side.
            const float side = Dot(heaviest, q);
            const V w = Set(side < 0.0f ? -i->weight : i->weight);
            real = MulAdd(w, q, real);
            dual = MulAdd(w, Load(bone + 4), dual);
        }
        float q[4], t[4];
        Store(real, q);
        Store(dual, t);
        const float length2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        const float s = length2 > kNoLength2 ? 1.0f / length2 : 0.0f;
        const float x = q[0], y = q[1], z = q[2], w = q[3];
        const float two = 2.0f * s;
        // The columns of the rotation, and the translation 2 d conj(q), carried by the map.
        const auto column = [&](float a, float b, float c)
                                HWY_ATTR { return MulAdd(m0, Set(a), MulAdd(m1, Set(b), Mul(m2, Set(c)))); };
        c0 = column(1.0f - two * (y * y + z * z), two * (x * y + w * z), two * (x * z - w * y));
        c1 = column(two * (x * y - w * z), 1.0f - two * (x * x + z * z), two * (y * z + w * x));
        c2 = column(two * (x * z + w * y), two * (y * z - w * x), 1.0f - two * (x * x + y * y));
        c3 = column(two * (w * t[0] - t[3] * x + y * t[2] - z * t[1]),
                    two * (w * t[1] - t[3] * y + z * t[0] - x * t[2]),
                    two * (w * t[2] - t[3] * z + x * t[1] - y * t[0]));
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace vfit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vfit {

HWY_EXPORT(Linear);
HWY_EXPORT(DualQuaternion);

void skin_linear(const SkinJob& job) { HWY_DYNAMIC_DISPATCH(Linear)(job); }
void skin_dual_quaternion(const SkinJob& job, const float* map) {
    HWY_DYNAMIC_DISPATCH(DualQuaternion)(job, map);
}

}  // namespace vfit
#endif
