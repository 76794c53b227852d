// The nearest place on a triangle, in SIMD: included once for each instruction set (Highway's -inl.h).
#if defined(VFIT_CLOTH_NEAREST_ON_TRIANGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef VFIT_CLOTH_NEAREST_ON_TRIANGLE_INL_H_
#undef VFIT_CLOTH_NEAREST_ON_TRIANGLE_INL_H_
#else
#define VFIT_CLOTH_NEAREST_ON_TRIANGLE_INL_H_
#endif

#include "cloth/base/particle_registers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vfit {
namespace HWY_NAMESPACE {

/// nearest_on_triangle() for all lanes: weights of b and c.
struct OnTriangle {
    V at_b, at_c, distance2;
};
HWY_INLINE OnTriangle NearestOnTriangle(const Points& p, const Points& a, const Points& b, const Points& c) {
    const V zero = hn::Zero(kTag);
    const Points ab = Sub(b, a), ac = Sub(c, a), ap = Sub(p, a), bp = Sub(p, b), cp = Sub(p, c);
    const V d1 = Dot(ab, ap), d2 = Dot(ac, ap), d3 = Dot(ab, bp), d4 = Dot(ac, bp), d5 = Dot(ab, cp),
            d6 = Dot(ac, cp);
    const V beside_ab = hn::NegMulAdd(d3, d2, hn::Mul(d1, d4)),
            beside_ac = hn::NegMulAdd(d1, d6, hn::Mul(d5, d2));
    const V beside_bc = hn::NegMulAdd(d5, d4, hn::Mul(d3, d6));
    const auto none = [&](V v) HWY_ATTR { return hn::Le(v, zero); };
    const auto some = [&](V v) HWY_ATTR { return hn::Ge(v, zero); };
    // Numerators of b and c over one denominator: inside; then edges, then corners, where they are nearer.
    V b_share = beside_ac, c_share = beside_ab, whole = hn::Add(beside_bc, hn::Add(beside_ac, beside_ab));
    const V to_c = hn::Sub(d4, d3), to_b = hn::Sub(d5, d6);
    const auto on = [&](const auto& mask, V b_part, V c_part, V sum) HWY_ATTR {
        b_share = hn::IfThenElse(mask, b_part, b_share);
        c_share = hn::IfThenElse(mask, c_part, c_share);
        whole = hn::IfThenElse(mask, sum, whole);
    };
    on(hn::And(none(beside_bc), hn::And(some(to_c), some(to_b))), to_b, to_c, hn::Add(to_b, to_c));
    on(hn::And(none(beside_ac), hn::And(some(d2), none(d6))), zero, d2, hn::Sub(d2, d6));
    on(hn::And(none(beside_ab), hn::And(some(d1), none(d3))), d1, zero, hn::Sub(d1, d3));
    const V one = Set(1.0f);
    on(hn::And(some(d6), hn::Le(d5, d6)), zero, one, one);
    on(hn::And(some(d3), hn::Le(d4, d3)), one, zero, one);
    on(hn::And(none(d1), none(d2)), zero, zero, one);
    const V inverse = hn::Div(one, hn::IfThenElse(hn::Gt(whole, zero), whole, one));
    const V at_b = hn::Mul(b_share, inverse), at_c = hn::Mul(c_share, inverse);
    const Points off = MulAdd(ab, hn::Neg(at_b), MulAdd(ac, hn::Neg(at_c), ap));
    return {at_b, at_c, Dot(off, off)};
}

}  // namespace HWY_NAMESPACE
}  // namespace vfit
HWY_AFTER_NAMESPACE();

#endif
