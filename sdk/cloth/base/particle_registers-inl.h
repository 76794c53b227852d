// Particles in SIMD registers: included once for each instruction set (Highway's -inl.h).
#if defined(VFIT_CLOTH_PARTICLE_REGISTERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VFIT_CLOTH_PARTICLE_REGISTERS_INL_H_
#undef VFIT_CLOTH_PARTICLE_REGISTERS_INL_H_
#else
#define VFIT_CLOTH_PARTICLE_REGISTERS_INL_H_
#endif

#include <hwy/highway.h>

#include "cloth/base/particle.h"

HWY_BEFORE_NAMESPACE();
namespace vfit {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Registers of eight floats, or of four; Highway's scalar target has one.
#if HWY_TARGET == HWY_SCALAR
constexpr size_t kWide = 1;
#elif !HWY_HAVE_SCALABLE && HWY_MAX_BYTES >= 32
constexpr size_t kWide = 8;
#else
constexpr size_t kWide = 4;
#endif
using Tag = hn::FixedTag<float, kWide>;
using V = hn::Vec<Tag>;
constexpr Tag kTag;
constexpr float kNoLength = 1e-12f;  // m; far below any rest length

HWY_INLINE V Set(float a) { return hn::Set(kTag, a); }

/// kWide places as x, y, z.
struct Points {
    V x, y, z;
};
HWY_INLINE V Dot(const Points& a, const Points& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
HWY_INLINE Points Sub(const Points& a, const Points& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
/// p + d * s
HWY_INLINE Points MulAdd(const Points& d, V s, const Points& p) {
    return {hn::MulAdd(d.x, s, p.x), hn::MulAdd(d.y, s, p.y), hn::MulAdd(d.z, s, p.z)};
}
HWY_INLINE Points Mul(const Points& a, V s) { return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)}; }
HWY_INLINE Points Set(const Vec3& v) { return {Set(v.x), Set(v.y), Set(v.z)}; }

#if HWY_TARGET == HWY_SCALAR
/// kWide particles: here one.
struct Rows {
    Points p;
};
template <typename At>
HWY_INLINE Rows Gather(const At& at, const uint32_t* index) {
    return {Set(at(*index)->x)};
}
HWY_INLINE Rows Load(const Particle* run, size_t k) { return {Set(run[particle_at(k)].x)}; }
HWY_INLINE Rows RowsOf(const Points& p) { return {p}; }
HWY_INLINE void Store(const Rows& rows, Particle* run, size_t k) {
    run[particle_at(k)].x = Vec3(hn::GetLane(rows.p.x), hn::GetLane(rows.p.y), hn::GetLane(rows.p.z));
}
template <typename At>
HWY_INLINE void Scatter(const Rows& rows, const At& at, const uint32_t* index) {
    at(*index)->x = Vec3(hn::GetLane(rows.p.x), hn::GetLane(rows.p.y), hn::GetLane(rows.p.z));
}
HWY_INLINE Rows Add(const Rows& a, const Vec3& b) { return {Sub(a.p, Set(-b))}; }
HWY_INLINE Rows Scaled(const Rows& a, V s) { return {Mul(a.p, s)}; }
/// a * s + b
HWY_INLINE Rows MulAdd(const Rows& a, V s, const Rows& b) { return {MulAdd(a.p, s, b.p)}; }
HWY_INLINE Rows Sub(const Rows& a, const Rows& b) { return {Sub(a.p, b.p)}; }
HWY_INLINE Rows AddScaled(const Rows& a, const Rows& d, V s) { return {MulAdd(d.p, s, a.p)}; }
HWY_INLINE Rows Times(const Rows& a, V s) { return {Mul(a.p, s)}; }
HWY_INLINE Points Columns(const Rows& rows) { return rows.p; }
#else
/// kWide particles in four registers: register k holds particle k and, in its upper half, particle k + 4.
struct Rows {
    V r[4];
};
constexpr hn::FixedTag<float, 4> kFour;
HWY_INLINE V LoadRow(const Particle* low, const Particle* high) {
#if !HWY_HAVE_SCALABLE && HWY_MAX_BYTES >= 32
    return hn::Combine(kTag, hn::Load(kFour, &high->x.x), hn::Load(kFour, &low->x.x));
#else
    (void)high;
    return hn::Load(kFour, &low->x.x);
#endif
}
HWY_INLINE void StoreRow(V row, Particle* low, Particle* high) {
#if !HWY_HAVE_SCALABLE && HWY_MAX_BYTES >= 32
    hn::Store(hn::LowerHalf(kFour, row), kFour, &low->x.x);
    hn::Store(hn::UpperHalf(kFour, row), kFour, &high->x.x);
#else
    (void)high;
    hn::Store(row, kFour, &low->x.x);
#endif
}
template <typename At>
HWY_INLINE Rows Gather(const At& at, const uint32_t* index) {
    Rows rows;
    for (size_t k = 0; k < 4; ++k) rows.r[k] = LoadRow(at(index[k]), at(index[(k + 4) % kWide]));
    return rows;
}
template <typename At>
HWY_INLINE void Scatter(const Rows& rows, const At& at, const uint32_t* index) {
    for (size_t k = 0; k < 4; ++k) StoreRow(rows.r[k], at(index[k]), at(index[(k + 4) % kWide]));
}
/// Lanes k to k + kWide of a run: with eight, the run as it lies.
HWY_INLINE Rows Load(const Particle* run, size_t k) {
    Rows rows;
    for (size_t i = 0; i < 4; ++i) rows.r[i] = hn::Load(kTag, &run[2 * i + k / 4].x.x);
    return rows;
}
HWY_INLINE Rows Sub(const Rows& a, const Rows& b) {
    Rows rows;
    for (size_t k = 0; k < 4; ++k) rows.r[k] = hn::Sub(a.r[k], b.r[k]);
    return rows;
}
/// a + d * s, s one a particle.
HWY_INLINE Rows AddScaled(const Rows& a, const Rows& d, V s) {
    return {{hn::MulAdd(d.r[0], hn::Broadcast<0>(s), a.r[0]), hn::MulAdd(d.r[1], hn::Broadcast<1>(s), a.r[1]),
             hn::MulAdd(d.r[2], hn::Broadcast<2>(s), a.r[2]),
             hn::MulAdd(d.r[3], hn::Broadcast<3>(s), a.r[3])}};
}
/// a * s, s one a particle.
HWY_INLINE Rows Times(const Rows& a, V s) {
    return {{hn::Mul(hn::Broadcast<0>(s), a.r[0]), hn::Mul(hn::Broadcast<1>(s), a.r[1]),
             hn::Mul(hn::Broadcast<2>(s), a.r[2]), hn::Mul(hn::Broadcast<3>(s), a.r[3])}};
}
using Pairs = hn::Repartition<double, Tag>;
HWY_INLINE V LowerPairs(V a, V b) {
    return hn::BitCast(kTag, hn::InterleaveLower(Pairs(), hn::BitCast(Pairs(), a), hn::BitCast(Pairs(), b)));
}
HWY_INLINE V UpperPairs(V a, V b) {
    return hn::BitCast(kTag, hn::InterleaveUpper(Pairs(), hn::BitCast(Pairs(), a), hn::BitCast(Pairs(), b)));
}
HWY_INLINE Points Columns(const Rows& rows) {
    const V xy01 = hn::InterleaveLower(kTag, rows.r[0], rows.r[1]),
            xy23 = hn::InterleaveLower(kTag, rows.r[2], rows.r[3]);
    const V zw01 = hn::InterleaveUpper(kTag, rows.r[0], rows.r[1]),
            zw23 = hn::InterleaveUpper(kTag, rows.r[2], rows.r[3]);
    return {LowerPairs(xy01, xy23), UpperPairs(xy01, xy23), LowerPairs(zw01, zw23)};
}
HWY_INLINE Rows RowsOf(const Points& p) {
    const V zero = hn::Zero(kTag);
    const V xy_low = hn::InterleaveLower(kTag, p.x, p.y), xy_high = hn::InterleaveUpper(kTag, p.x, p.y);
    const V z_low = hn::InterleaveLower(kTag, p.z, zero), z_high = hn::InterleaveUpper(kTag, p.z, zero);
    return {{LowerPairs(xy_low, z_low), UpperPairs(xy_low, z_low), LowerPairs(xy_high, z_high),
             UpperPairs(xy_high, z_high)}};
}
HWY_INLINE void Store(const Rows& rows, Particle* run, size_t k) {
    for (size_t i = 0; i < 4; ++i) hn::Store(rows.r[i], kTag, &run[2 * i + k / 4].x.x);
}
HWY_INLINE Rows Add(const Rows& a, const Vec3& b) {
    const Particle four{b};
    const V same = hn::LoadDup128(kTag, &four.x.x);
    Rows rows;
    for (size_t k = 0; k < 4; ++k) rows.r[k] = hn::Add(a.r[k], same);
    return rows;
}
HWY_INLINE Rows Scaled(const Rows& a, V s) {
    Rows rows;
    for (size_t k = 0; k < 4; ++k) rows.r[k] = hn::Mul(a.r[k], s);
    return rows;
}
/// a * s + b
HWY_INLINE Rows MulAdd(const Rows& a, V s, const Rows& b) {
    Rows rows;
    for (size_t k = 0; k < 4; ++k) rows.r[k] = hn::MulAdd(a.r[k], s, b.r[k]);
    return rows;
}
#endif

template <typename Mask>
HWY_INLINE Points Choose(Mask mask, const Points& yes, const Points& no) {
    return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
            hn::IfThenElse(mask, yes.z, no.z)};
}

}  // namespace HWY_NAMESPACE
}  // namespace vfit
HWY_AFTER_NAMESPACE();

#endif
