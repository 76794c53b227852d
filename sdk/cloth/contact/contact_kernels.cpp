#include "cloth/contact/contact_kernels.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cloth/contact/contact_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "cloth/base/nearest_on_triangle-inl.h"
#include "cloth/base/particle_registers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vfit {
namespace HWY_NAMESPACE {

constexpr float kRounding_m = 2e-5f;   // of a gap between places some metres from the origin
constexpr float kTouching_m = -4e-6f;  // a gap of triangles that share a vertex
constexpr float kCrossedEdges =
    0.05f;                      // sine of the angle from which on two edges have a normal of their own
constexpr float kOn_m = 1e-6f;  // closer, a way has no direction
constexpr hn::FixedTag<uint32_t, kWide> kInts;

template <typename Mask>
HWY_INLINE uint32_t Bits(Mask mask) {
    uint8_t bits[8] = {};
    hn::StoreMaskBits(kTag, mask, bits);
    return bits[0];
}

/// A bit for each of the eight boxes from there on.
HWY_INLINE uint32_t MeetingBoxes(const MovingBoxes::Level& level, size_t from, const Bounds& box,
                                 const Bounds& way, float reach_m, float max_way_m) {
    uint32_t bits = 0;
    for (size_t k = 0; k < kLanes; k += kWide) {
        const size_t at = from + k;
        auto meets = hn::FirstN(kTag, kWide);
        for (int axis = 0; axis < 3; ++axis) {
            // How much further apart the two were, or will be, than now.
            const V back = hn::Abs(hn::Sub(hn::LoadU(kTag, &level.ways.high[axis][at]), Set(way.low[axis]))),
                    forth = hn::Abs(hn::Sub(Set(way.high[axis]), hn::LoadU(kTag, &level.ways.low[axis][at])));
            const V margin = hn::Add(hn::Min(hn::Max(back, forth), Set(max_way_m)), Set(reach_m));
            const V low = hn::Sub(hn::LoadU(kTag, &level.boxes.low[axis][at]), margin),
                    high = hn::Add(hn::LoadU(kTag, &level.boxes.high[axis][at]), margin);
            meets =
                hn::And(meets, hn::And(hn::Le(low, Set(box.high[axis])), hn::Ge(high, Set(box.low[axis]))));
        }
        bits |= Bits(meets) << k;
    }
    return bits;
}

void FindMeetingMoving(const MovingBoxes& patches, uint32_t first, const Bounds& box, const Bounds& way,
                       float reach_m, float max_way_m, std::vector<uint32_t>& out) {
    constexpr size_t kMaxLevels = 12;
    uint32_t left[kMaxLevels], base[kMaxLevels];  // of each level: bits to visit, and the box of the lowest
    size_t level = patches.levels.size() - 1;
    const auto enter = [&](size_t at, uint32_t from) HWY_ATTR {
        base[at] = from;
        left[at] = MeetingBoxes(patches.levels[at], from, box, way, reach_m, max_way_m);
        // Boxes before the first one's are done.
        const uint32_t begin = first >> (3 * at);
        if (begin > from) left[at] &= begin - from < kLanes ? ~0u << (begin - from) : 0u;
    };
    enter(level, 0);
    for (;;) {
        if (left[level] == 0) {
            if (++level == patches.levels.size()) return;
            continue;
        }
        const uint32_t at = base[level] + uint32_t(hwy::Num0BitsBelowLS1Bit_Nonzero32(left[level]));
        left[level] &= left[level] - 1;
        if (level == 0)
            out.push_back(at);
        else
            enter(--level, at * uint32_t(kLanes));
    }
}

void MeetingTriangles(const PatchBoxes& a, const PatchBoxes& b, const Vec3& margin, uint8_t* out) {
    for (size_t i = 0; i < kLanes; ++i) {
        uint32_t bits = 0;
        for (size_t k = 0; k < kLanes; k += kWide) {
            auto meets = hn::FirstN(kTag, kWide);
            for (int axis = 0; axis < 3; ++axis) {
                const V high = Set(a.high[axis][i] + margin[axis]), low = Set(a.low[axis][i] - margin[axis]);
                meets = hn::And(meets, hn::Le(hn::Load(kTag, b.low[axis] + k), high));
                meets = hn::And(meets, hn::Ge(hn::Load(kTag, b.high[axis] + k), low));
            }
            bits |= Bits(meets) << k;
        }
        out[i] = uint8_t(bits);
    }
}

/// The least of n * way, of any way within the bounds.
HWY_INLINE V MinAlong(const Points& n, const Bounds& ways) {
    const Vec3 middle = 0.5f * (ways.low + ways.high), half = 0.5f * (ways.high - ways.low);
    return hn::Sub(Dot(n, Set(middle)), Dot({hn::Abs(n.x), hn::Abs(n.y), hn::Abs(n.z)}, Set(half)));
}

void ClearBeforePlanes(const uint32_t (&corners)[3][kLanes], const Particle* at, const PatchBoxes& b,
                       const Bounds& past, float reach_m, float max_way_m, uint8_t* meeting) {
    for (size_t k = 0; k < kLanes; k += kWide) {
        const Points n = {hn::Load(kTag, b.normal[0] + k), hn::Load(kTag, b.normal[1] + k),
                          hn::Load(kTag, b.normal[2] + k)};
        const V comes = hn::Min(hn::Max(hn::Neg(MinAlong(n, past)), hn::Zero(kTag)), Set(max_way_m));
        const V limit = hn::Add(hn::Load(kTag, b.offset + k), hn::Add(comes, Set(reach_m)));
        for (size_t i = 0; i < kLanes; ++i) {
            if (meeting[i] == 0) continue;
            const V lowest =
                hn::Min(Dot(n, Set(at[corners[0][i]].x)),
                        hn::Min(Dot(n, Set(at[corners[1][i]].x)), Dot(n, Set(at[corners[2][i]].x))));
            const uint32_t before = Bits(hn::Gt(lowest, limit)) << k;
            meeting[i] = uint8_t(meeting[i] & ~before);
        }
    }
}

HWY_INLINE Points CrossProduct(const Points& a, const Points& b) {
    return {hn::NegMulAdd(a.z, b.y, hn::Mul(a.y, b.z)), hn::NegMulAdd(a.x, b.z, hn::Mul(a.z, b.x)),
            hn::NegMulAdd(a.y, b.x, hn::Mul(a.x, b.y))};
}
HWY_INLINE Points Plus(const Points& a, const Points& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

HWY_INLINE float MinLane(V v) { return hn::GetLane(hn::MinOfLanes(kTag, v)); }
HWY_INLINE float MaxLane(V v) { return hn::GetLane(hn::MaxOfLanes(kTag, v)); }
HWY_INLINE float SumLanes(V v) { return hn::GetLane(hn::SumOfLanes(kTag, v)); }
/// The least and the greatest of all lanes, by axes.
HWY_INLINE Bounds BoundsOf(const Points& low, const Points& high) {
    return {{MinLane(low.x), MinLane(low.y), MinLane(low.z)},
            {MaxLane(high.x), MaxLane(high.y), MaxLane(high.z)}};
}
HWY_INLINE Points Lower(const Points& a, const Points& b) {
    return {hn::Min(a.x, b.x), hn::Min(a.y, b.y), hn::Min(a.z, b.z)};
}
HWY_INLINE Points Higher(const Points& a, const Points& b) {
    return {hn::Max(a.x, b.x), hn::Max(a.y, b.y), hn::Max(a.z, b.z)};
}

void FindShape(const uint32_t (&corners)[3][kLanes], uint32_t count, const Particle* begin,
               const Particle* end, PatchBoxes& boxes, PatchShape& out) {
    const auto from = [begin](uint32_t index) HWY_ATTR { return begin + index; };
    const auto to = [end](uint32_t index) HWY_ATTR { return end + index; };
    out = PatchShape{};
    Vec3 sum(0.0f);
    Points normals[kLanes / kWide][2];
    for (size_t k = 0; k < kLanes; k += kWide) {
        Points a[3], b[3];
        for (size_t i = 0; i < 3; ++i)
            a[i] = Columns(Gather(from, corners[i] + k)), b[i] = Columns(Gather(to, corners[i] + k));
        const Points low = Lower(b[0], Lower(b[1], b[2])), high = Higher(b[0], Higher(b[1], b[2]));
        const Points way[3] = {Sub(b[0], a[0]), Sub(b[1], a[1]), Sub(b[2], a[2])};
        const Bounds box = BoundsOf(low, high), ways = BoundsOf(Lower(way[0], Lower(way[1], way[2])),
                                                                Higher(way[0], Higher(way[1], way[2])));
        out.box.add(box.low), out.box.add(box.high), out.way.add(ways.low), out.way.add(ways.high);
        const auto is_there = hn::FirstN(kTag, count > k ? count - k : 0);
        const V nowhere = Set(INFINITY);
        hn::Store(hn::IfThenElse(is_there, low.x, nowhere), kTag, boxes.low[0] + k);
        hn::Store(hn::IfThenElse(is_there, low.y, nowhere), kTag, boxes.low[1] + k);
        hn::Store(hn::IfThenElse(is_there, low.z, nowhere), kTag, boxes.low[2] + k);
        hn::Store(hn::IfThenElse(is_there, high.x, hn::Neg(nowhere)), kTag, boxes.high[0] + k);
        hn::Store(hn::IfThenElse(is_there, high.y, hn::Neg(nowhere)), kTag, boxes.high[1] + k);
        hn::Store(hn::IfThenElse(is_there, high.z, hn::Neg(nowhere)), kTag, boxes.high[2] + k);
        Points* n = normals[k / kWide];
        n[0] = CrossProduct(Sub(a[1], a[0]), Sub(a[2], a[0]));
        n[1] = CrossProduct(Sub(b[1], b[0]), Sub(b[2], b[0]));
        sum += Vec3(SumLanes(n[1].x), SumLanes(n[1].y), SumLanes(n[1].z));
        const Points unit = Mul(n[1], hn::Div(Set(1.0f), hn::Max(hn::Sqrt(Dot(n[1], n[1])), Set(1e-20f))));
        hn::Store(unit.x, kTag, boxes.normal[0] + k);
        hn::Store(unit.y, kTag, boxes.normal[1] + k);
        hn::Store(unit.z, kTag, boxes.normal[2] + k);
        hn::Store(Dot(unit, b[0]), kTag, boxes.offset + k);
    }
    out.normal = sum / std::max(std::sqrt(sum.x * sum.x + sum.y * sum.y + sum.z * sum.z), 1e-20f);
    const Points mean = Set(out.normal);
    V cosine = Set(1.0f);
    for (const auto& both : normals)
        for (const Points& n : both)
            cosine = hn::Min(cosine, hn::Div(Dot(n, mean), hn::Max(hn::Sqrt(Dot(n, n)), Set(1e-20f))));
    out.min_cosine = MinLane(cosine);
}

/// Corners of two triangles at both ends, and how far they are apart. kCertifies: `safe` is found.
template <bool kCertifies>
struct TwoTriangles {
    Points first_begin[3], second_begin[3], first[3], second[3];
    V far_m, clear_m;  // gaps from which on a pair is apart, and safe
    V apart, safe;     // the widest gap less these

    HWY_INLINE Points Normal(const Points* corners) const {
        return CrossProduct(Sub(corners[1], corners[0]), Sub(corners[2], corners[0]));
    }
    HWY_INLINE Points BetweenMiddles() const {
        return Sub(Plus(first[0], Plus(first[1], first[2])), Plus(second[0], Plus(second[1], second[2])));
    }
    HWY_INLINE void Look(const Points& axis) {
        const V inverse = hn::Div(Set(1.0f), hn::Sqrt(hn::Add(Dot(axis, axis), Set(1e-30f))));
        const Points n = Mul(axis, inverse);
        constexpr int kFirst = kCertifies ? 0 : 1;
        V low[3][2], high[3][2];  // begin, end, and the same way again; first, second
        for (int side = 0; side < 2; ++side) {
            const Points *from = side ? second_begin : first_begin, *to = side ? second : first;
            for (int k = 0; k < 3; ++k) {
                const V begin = Dot(n, from[k]), end = Dot(n, to[k]),
                        next = hn::Sub(hn::Add(end, end), begin);
                const V at[3] = {begin, end, next};
                for (int t = kFirst; t < 3; ++t) {
                    low[t][side] = k ? hn::Min(low[t][side], at[t]) : at[t];
                    high[t][side] = k ? hn::Max(high[t][side], at[t]) : at[t];
                }
            }
        }
        for (int side = 0; side < 2; ++side) {
            const auto gap = [&](int t) HWY_ATTR { return hn::Sub(low[t][side], high[t][1 - side]); };
            if constexpr (kCertifies) safe = hn::Max(safe, hn::Sub(hn::Min(gap(0), gap(1)), clear_m));
            apart = hn::Max(apart, hn::Sub(hn::Min(gap(1), gap(2)), far_m));
        }
    }
};

template <bool kCertifies>
HWY_INLINE void ClassifyAs(std::span<TrianglePairs> pairs, const Particle* begin, const Particle* end,
                           float reach_m) {
    const auto from = [begin](uint32_t index) HWY_ATTR { return begin + index; };
    const auto to = [end](uint32_t index) HWY_ATTR { return end + index; };
    for (TrianglePairs& pair : pairs) {
        uint32_t uncertain = 0, close = 0;
        for (size_t k = 0; k < kLanes; k += kWide) {
            TwoTriangles<kCertifies> two;
            auto shared = hn::Zero(kInts);
            for (size_t i = 0; i < 3; ++i) {
                two.first_begin[i] = Columns(Gather(from, pair.first[i] + k));
                two.second_begin[i] = Columns(Gather(from, pair.second[i] + k));
                two.first[i] = Columns(Gather(to, pair.first[i] + k));
                two.second[i] = Columns(Gather(to, pair.second[i] + k));
                for (size_t j = 0; j < 3; ++j)
                    shared = hn::Add(shared, hn::IfThenElseZero(hn::Eq(hn::Load(kInts, pair.first[i] + k),
                                                                       hn::Load(kInts, pair.second[j] + k)),
                                                                hn::Set(kInts, 1)));
            }
            const auto share_one = hn::RebindMask(kTag, hn::Ne(shared, hn::Zero(kInts))),
                       share_two = hn::RebindMask(kTag, hn::Gt(shared, hn::Set(kInts, 1)));
            two.far_m = Set(reach_m);
            two.apart = two.safe = Set(-1.0f);
            two.clear_m = hn::IfThenElse(share_one, Set(kTouching_m), Set(kRounding_m));
            const Points first = two.Normal(two.first), second = two.Normal(two.second),
                         between = two.BetweenMiddles();
            two.Look(first);
            two.Look(second);
            two.Look(between);
            const auto opposed = hn::Lt(Dot(first, second), Set(0.0f));
            const Points mean = Choose(opposed, Sub(first, second), Plus(first, second));
            const V part = hn::Div(Dot(mean, between), hn::Add(Dot(mean, mean), Set(1e-30f)));
            two.Look(MulAdd(mean, hn::Neg(part), between));
            const V zero = hn::Zero(kTag);
            if constexpr (kCertifies) uncertain |= Bits(hn::AndNot(share_two, hn::Le(two.safe, zero))) << k;
            close |= Bits(hn::AndNot(share_one, hn::Le(two.apart, zero))) << k;
        }
        pair.uncertain = uint8_t(uncertain), pair.close = uint8_t(close);
    }
}

void Classify(std::span<TrianglePairs> pairs, const Particle* begin, const Particle* end, float reach_m,
              bool certifies) {
    if (certifies)
        ClassifyAs<true>(pairs, begin, end, reach_m);
    else
        ClassifyAs<false>(pairs, begin, end, reach_m);
}

/// Where on each of two edges they are closest (Ericson 2004, 5.1.9).
struct OnEdges {
    V first, second;
};
HWY_INLINE OnEdges ClosestOnEdges(const Points& p, const Points& p_end, const Points& q,
                                  const Points& q_end) {
    const V zero = hn::Zero(kTag), one = Set(1.0f), tiny = Set(1e-20f);
    const auto clamp = [&](V v) HWY_ATTR { return hn::Min(one, hn::Max(zero, v)); };
    const Points d1 = Sub(p_end, p), d2 = Sub(q_end, q), r = Sub(p, q);
    const V a = hn::Max(Dot(d1, d1), tiny), e = hn::Max(Dot(d2, d2), tiny), f = Dot(d2, r), c = Dot(d1, r),
            b = Dot(d1, d2);
    const V denominator = hn::NegMulAdd(b, b, hn::Mul(a, e));
    const auto crossed = hn::Gt(denominator, hn::Mul(Set(1e-7f), hn::Mul(a, e)));
    const V s0 = hn::IfThenElse(
        crossed,
        clamp(hn::Div(hn::NegMulAdd(c, e, hn::Mul(b, f)), hn::IfThenElse(crossed, denominator, one))),
        Set(0.5f));
    const V t0 = hn::Div(hn::MulAdd(b, s0, f), e);
    const V t = clamp(t0);
    const V s =
        hn::IfThenElse(hn::Eq(t0, t), s0, clamp(hn::Div(hn::NegMulAdd(Set(1.0f), c, hn::Mul(b, t)), a)));
    return {s, t};
}

void FindClosest(std::span<PrimitivePairs> pairs, bool edges, const Particle* begin, const Particle* end,
                 float sideways) {
    const auto from = [begin](uint32_t index) HWY_ATTR { return begin + index; };
    const auto to = [end](uint32_t index) HWY_ATTR { return end + index; };
    const V one = Set(1.0f), third = Set(1.0f / 3.0f), half = Set(0.5f), zero = hn::Zero(kTag);
    for (PrimitivePairs& pair : pairs)
        for (size_t k = 0; k < kLanes; k += kWide) {
            Points p[4], moved[4];
            for (size_t i = 0; i < 4; ++i) {
                p[i] = Columns(Gather(to, pair.at[i] + k));
                moved[i] = Sub(p[i], Columns(Gather(from, pair.at[i] + k)));
            }
            V weight[4];
            Points relative;
            if (edges) {
                const OnEdges on = ClosestOnEdges(p[0], p[1], p[2], p[3]);
                weight[0] = hn::Sub(one, on.first), weight[1] = on.first;
                weight[2] = hn::Sub(on.second, one), weight[3] = hn::Neg(on.second);
                relative = Mul(Sub(Plus(moved[0], moved[1]), Plus(moved[2], moved[3])), half);
            } else {
                const OnTriangle on = NearestOnTriangle(p[0], p[1], p[2], p[3]);
                weight[0] = one, weight[1] = hn::Sub(hn::Add(on.at_b, on.at_c), one);
                weight[2] = hn::Neg(on.at_b), weight[3] = hn::Neg(on.at_c);
                relative = MulAdd(Plus(moved[1], Plus(moved[2], moved[3])), hn::Neg(third), moved[0]);
            }
            Points way = Mul(p[0], weight[0]);
            for (size_t i = 1; i < 4; ++i) way = MulAdd(p[i], weight[i], way);
            const V distance = hn::Sqrt(Dot(way, way)), length = hn::Sqrt(Dot(relative, relative));
            const V closing = hn::Div(hn::Neg(Dot(way, relative)), hn::Max(distance, Set(1e-9f)));
            for (size_t i = 0; i < 4; ++i) hn::Store(weight[i], kTag, pair.weight[i] + k);
            hn::Store(way.x, kTag, pair.way[0] + k), hn::Store(way.y, kTag, pair.way[1] + k),
                hn::Store(way.z, kTag, pair.way[2] + k);
            hn::Store(distance, kTag, pair.distance_m + k);
            hn::Store(hn::MulAdd(Set(sideways), length, hn::Max(zero, closing)), kTag, pair.comes_m + k);
        }
}

/// Adds to each particle in turn, so that one that several lanes name gets it all.
template <typename At>
HWY_INLINE void ScatterSum(const Rows& rows, const At& at, const uint32_t* index) {
#if HWY_TARGET == HWY_SCALAR
    at(*index)->x += Vec3(hn::GetLane(rows.p.x), hn::GetLane(rows.p.y), hn::GetLane(rows.p.z));
#else
    const auto add = [&](const hn::Vec<hn::FixedTag<float, 4> >& what, uint32_t to) HWY_ATTR {
        float* place = &at(to)->x.x;
        hn::Store(hn::Add(hn::Load(kFour, place), what), kFour, place);
    };
    for (size_t k = 0; k < 4; ++k) {
#if !HWY_HAVE_SCALABLE && HWY_MAX_BYTES >= 32
        add(hn::LowerHalf(kFour, rows.r[k]), index[k]);
        add(hn::UpperHalf(kFour, rows.r[k]), index[k + 4]);
#else
        add(rows.r[k], index[k]);
#endif
    }
#endif
}

void RefreshContacts(std::span<ContactBatch> contacts, bool edges, const Particle* particles) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(particles);
    const auto at = [bytes](uint32_t offset)
                        HWY_ATTR { return reinterpret_cast<const Particle*>(bytes + offset); };
    const V zero = hn::Zero(kTag), one = Set(1.0f), tiny = Set(1e-20f);
    for (ContactBatch& c : contacts)
        for (size_t k = 0; k < kLanes; k += kWide) {
            Points p[4];
            for (size_t i = 0; i < 4; ++i) p[i] = Columns(Gather(at, c.at[i] + k));
            const Points old{hn::Load(kTag, c.normal[0] + k), hn::Load(kTag, c.normal[1] + k),
                             hn::Load(kTag, c.normal[2] + k)};
            V weight[4], length, towards;
            Points square;  // the normal of a triangle, or of two edges, and whether it holds
            auto holds = hn::FirstN(kTag, 0);
            if (edges) {
                const OnEdges on = ClosestOnEdges(p[0], p[1], p[2], p[3]);
                weight[0] = hn::Sub(one, on.first), weight[1] = on.first;
                weight[2] = hn::Sub(on.second, one), weight[3] = hn::Neg(on.second);
                const Points first = Sub(p[1], p[0]), second = Sub(p[3], p[2]);
                square = CrossProduct(first, second);
                length = hn::Sqrt(hn::Add(Dot(square, square), tiny));
                const V both = hn::Sqrt(hn::Mul(Dot(first, first), Dot(second, second)));
                holds = hn::And(hn::And(hn::Gt(hn::Mul(weight[0], weight[1]), zero),
                                        hn::Gt(hn::Mul(weight[2], weight[3]), zero)),
                                hn::Gt(length, hn::Mul(Set(kCrossedEdges), both)));
                towards = Dot(square, old);
            } else {
                const OnTriangle on = NearestOnTriangle(p[0], p[1], p[2], p[3]);
                weight[0] = one, weight[1] = hn::Sub(hn::Add(on.at_b, on.at_c), one);
                weight[2] = hn::Neg(on.at_b), weight[3] = hn::Neg(on.at_c);
                square = CrossProduct(Sub(p[2], p[1]), Sub(p[3], p[1]));
                length = hn::Sqrt(hn::Add(Dot(square, square), tiny));
                holds = hn::Lt(hn::Max(weight[1], hn::Max(weight[2], weight[3])), zero);
                const V side = hn::Load(kTag, c.side + k), above = Dot(square, Sub(p[0], p[1]));
                towards = hn::IfThenElse(hn::Eq(side, zero), above, side);
                hn::Store(hn::IfThenElseZero(holds, hn::CopySign(one, towards)), kTag, c.side + k);
            }
            Points way = Mul(p[0], weight[0]);
            for (size_t i = 1; i < 4; ++i) way = MulAdd(p[i], weight[i], way);
            const V distance = hn::Sqrt(Dot(way, way));
            const auto agrees = hn::And(hn::Gt(distance, Set(kOn_m)), hn::Gt(Dot(way, old), zero));
            Points normal = Choose(agrees, Mul(way, hn::Div(one, hn::Max(distance, Set(kOn_m)))), old);
            normal = Choose(holds, Mul(square, hn::Div(hn::CopySign(one, towards), length)), normal);
            hn::Store(normal.x, kTag, c.normal[0] + k), hn::Store(normal.y, kTag, c.normal[1] + k);
            hn::Store(normal.z, kTag, c.normal[2] + k);
            V share[4], sum = tiny, lightest = zero;
            for (size_t i = 0; i < 4; ++i) {
                const V inverse_mass = hn::Load(kTag, c.inverse_mass[i] + k);
                lightest = hn::Max(lightest, inverse_mass);
                share[i] = hn::Mul(weight[i], inverse_mass);
                sum = hn::MulAdd(share[i], weight[i], sum);
            }
            const V inverse = hn::Div(one, hn::Max(sum, hn::Mul(Set(kMinMobility), lightest)));
            for (size_t i = 0; i < 4; ++i) {
                hn::Store(weight[i], kTag, c.weight[i] + k);
                hn::Store(hn::Mul(share[i], inverse), kTag, c.gain[i] + k);
            }
        }
}

void SolveContacts(std::span<const ContactBatch> contacts, const ContactPush& push, const Particle* starts,
                   Particle* particles) {
    auto* bytes = reinterpret_cast<unsigned char*>(particles);
    const auto* start_bytes = reinterpret_cast<const unsigned char*>(starts);
    const auto at = [bytes](uint32_t offset) HWY_ATTR { return reinterpret_cast<Particle*>(bytes + offset); };
    const auto start_of = [start_bytes](uint32_t offset)
                              HWY_ATTR { return reinterpret_cast<const Particle*>(start_bytes + offset); };
    for (const ContactBatch& c : contacts)
        for (size_t k = 0; k < kLanes; k += kWide) {
            const auto between = [&](const auto& place) HWY_ATTR {
                Points sum = Mul(Columns(Gather(place, c.at[0] + k)), hn::Load(kTag, c.weight[0] + k));
                for (int i = 1; i < 4; ++i)
                    sum = MulAdd(Columns(Gather(place, c.at[i] + k)), hn::Load(kTag, c.weight[i] + k), sum);
                return sum;
            };
            const Points normal{hn::Load(kTag, c.normal[0] + k), hn::Load(kTag, c.normal[1] + k),
                                hn::Load(kTag, c.normal[2] + k)};
            const Points now = between(at);
            const V distance = Dot(normal, now), kept = hn::Load(kTag, c.distance_m + k);
            if (hn::AllFalse(kTag, hn::Lt(distance, kept))) continue;
            const Points start = between(start_of);
            const V began = Dot(normal, start);
            const V depth =
                hn::Max(hn::Zero(kTag), hn::Sub(hn::Min(kept, hn::Add(began, Set(push.max_m))), distance));
            const Points way = Sub(now, start), slide = MulAdd(normal, hn::Neg(Dot(way, normal)), way);
            const V length = hn::Sqrt(hn::Add(Dot(slide, slide), Set(kNoLength * kNoLength)));
            const V held = hn::Min(Set(1.0f), hn::Div(hn::Mul(Set(push.friction), depth), length));
            const Points move = MulAdd(slide, hn::Neg(held), Mul(normal, depth));
            for (int i = 0; i < 4; ++i)
                ScatterSum(RowsOf(Mul(move, hn::Load(kTag, c.gain[i] + k))), at, c.at[i] + k);
        }
}

}  // namespace HWY_NAMESPACE
}  // namespace vfit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vfit {

HWY_EXPORT(FindMeetingMoving);
HWY_EXPORT(FindClosest);
HWY_EXPORT(FindShape);
HWY_EXPORT(MeetingTriangles);
HWY_EXPORT(ClearBeforePlanes);
HWY_EXPORT(Classify);
HWY_EXPORT(RefreshContacts);
HWY_EXPORT(SolveContacts);

void MovingBoxes::resize(size_t count) {
    levels.clear();
    do {
        levels.emplace_back();
        levels.back().boxes.resize(count), levels.back().ways.resize(count);
        count = (count + kLanes - 1) / kLanes;
    } while (levels.back().boxes.low[0].size() > kLanes);
}

void MovingBoxes::find_levels() {
    for (size_t i = 1; i < levels.size(); ++i)
        for (size_t at = 0; at * kLanes < levels[i - 1].boxes.low[0].size(); ++at) {
            Bounds box, way;
            for (size_t k = at * kLanes; k < (at + 1) * kLanes; ++k) {
                const Level& below = levels[i - 1];
                box.low = glm::min(box.low, below.boxes.low_of(k));
                box.high = glm::max(box.high, below.boxes.high_of(k));
                way.low = glm::min(way.low, below.ways.low_of(k));
                way.high = glm::max(way.high, below.ways.high_of(k));
            }
            levels[i].boxes.set(at, box.low, box.high), levels[i].ways.set(at, way.low, way.high);
        }
}

Bounds MovingBoxes::way() const {
    Bounds out;
    for (size_t i = 0; i < levels.back().ways.low[0].size(); ++i) {
        out.low = glm::min(out.low, levels.back().ways.low_of(i));
        out.high = glm::max(out.high, levels.back().ways.high_of(i));
    }
    return out;
}

void find_meeting(const MovingBoxes& patches, uint32_t first, const Bounds& box, const Bounds& way,
                  float reach_m, float max_way_m, std::vector<uint32_t>& out) {
    HWY_DYNAMIC_DISPATCH(FindMeetingMoving)(patches, first, box, way, reach_m, max_way_m, out);
}
PatchShape find_shape(const uint32_t (&corners)[3][kLanes], uint32_t count, const Particle* begin,
                      const Particle* end, PatchBoxes& boxes) {
    PatchShape out;
    HWY_DYNAMIC_DISPATCH(FindShape)(corners, count, begin, end, boxes, out);
    return out;
}
void find_closest(std::span<PrimitivePairs> pairs, bool edges, const Particle* begin, const Particle* end,
                  float sideways) {
    HWY_DYNAMIC_DISPATCH(FindClosest)(pairs, edges, begin, end, sideways);
}
std::array<uint8_t, kLanes> meeting_triangles(const PatchBoxes& a, const PatchBoxes& b, const Vec3& margin) {
    std::array<uint8_t, kLanes> out;
    HWY_DYNAMIC_DISPATCH(MeetingTriangles)(a, b, margin, out.data());
    return out;
}
void clear_before_planes(const uint32_t (&corners)[3][kLanes], const Particle* at, const PatchBoxes& b,
                         const Bounds& past, float reach_m, float max_way_m,
                         std::array<uint8_t, kLanes>& meeting) {
    HWY_DYNAMIC_DISPATCH(ClearBeforePlanes)(corners, at, b, past, reach_m, max_way_m, meeting.data());
}
void classify(std::span<TrianglePairs> pairs, const Particle* begin, const Particle* end, float reach_m,
              bool certifies) {
    HWY_DYNAMIC_DISPATCH(Classify)(pairs, begin, end, reach_m, certifies);
}
void refresh_contacts(std::span<ContactBatch> contacts, bool edges, const Particle* particles) {
    HWY_DYNAMIC_DISPATCH(RefreshContacts)(contacts, edges, particles);
}
void solve_contacts(std::span<const ContactBatch> contacts, const ContactPush& push, const Particle* starts,
                    Particle* particles) {
    HWY_DYNAMIC_DISPATCH(SolveContacts)(contacts, push, starts, particles);
}

}  // namespace vfit
#endif
