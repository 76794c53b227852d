#include "cloth/solver/cloth_kernels.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cloth/solver/cloth_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "cloth/base/particle_registers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vfit {
namespace HWY_NAMESPACE {

void Predict(const Moving& m, const Vec3& half_fall, float h) {
    for (size_t i = 0; i < m.count; i += kLanes)
        for (size_t k = 0; k < kLanes; k += kWide) {
            const Rows start = Load(m.places + i, k), v = Add(Load(m.velocities + i, k), half_fall);
            Store(start, m.starts + i, k);
            Store(v, m.velocities + i, k);
            Store(MulAdd(v, Set(h), start), m.places + i, k);
        }
}

float FindGains(std::span<const BatchMasses> masses, float h, float force, std::span<BatchGains> gains) {
    const V rate2 = Set(1.0f / (force * h * h));
    V most = Set(0.0f);
    for (size_t i = 0; i < masses.size(); ++i)
        for (size_t k = 0; k < kLanes; k += kWide) {
            const V a = hn::Load(kTag, masses[i].a + k), b = hn::Load(kTag, masses[i].b + k),
                    sum = hn::Add(a, b);
            const V inverse =
                hn::Div(Set(1.0f), hn::MulAdd(hn::Load(kTag, masses[i].compliance + k), rate2, sum));
            hn::Store(hn::Mul(a, inverse), kTag, gains[i].a + k);
            hn::Store(hn::Mul(b, inverse), kTag, gains[i].b + k);
            most = hn::Max(most, hn::Mul(sum, inverse));
        }
    return hn::GetLane(hn::MaxOfLanes(kTag, most));
}

void SolveDistances(std::span<const DistanceBatch> batches, std::span<const BatchGains> gains,
                    Particle* particles) {
    const V one = Set(1.0f), no_length = Set(kNoLength);
    auto* bytes = reinterpret_cast<unsigned char*>(particles);
    const auto at = [bytes](uint32_t offset) HWY_ATTR { return reinterpret_cast<Particle*>(bytes + offset); };
    for (size_t i = 0; i < batches.size(); ++i) {
        const DistanceBatch& batch = batches[i];
        const BatchGains& gain = gains[i];
        for (size_t k = 0; k < kLanes; k += kWide) {
            const Rows a = Gather(at, batch.a + k), b = Gather(at, batch.b + k);
            const Rows way = Sub(a, b);
            const Points d = Columns(way);
            const V length = hn::Add(hn::Sqrt(Dot(d, d)), no_length);
            const V amiss = hn::Sub(hn::Div(hn::Load(kTag, batch.rest_m + k), length), one);
            Scatter(AddScaled(a, way, hn::Mul(amiss, hn::Load(kTag, gain.a + k))), at, batch.a + k);
            Scatter(AddScaled(b, way, hn::Neg(hn::Mul(amiss, hn::Load(kTag, gain.b + k)))), at, batch.b + k);
        }
    }
}

/// Of one batch; the greatest share of a fold that one of its hinges takes back.
HWY_INLINE float FindHingeGains(const HingeBatch& batch, const HingeMasses& masses, float h, float force,
                                HingeGains& gains) {
    const V rate2 = Set(1.0f / (force * h * h));
    V most = Set(0.0f);
    for (size_t lane = 0; lane < kLanes; lane += kWide) {
        V sum = Set(0.0f), share[4];
        for (size_t k = 0; k < 4; ++k) {
            const V weight = hn::Load(kTag, batch.weight[k] + lane);
            share[k] = hn::Mul(hn::Load(kTag, masses.inverse_mass[k] + lane), weight);
            sum = hn::MulAdd(share[k], weight, sum);
        }
        const V inverse =
            hn::Div(Set(1.0f), hn::MulAdd(hn::Load(kTag, masses.compliance + lane), rate2, sum));
        for (size_t k = 0; k < 4; ++k) hn::Store(hn::Mul(share[k], inverse), kTag, gains.at[k] + lane);
        most = hn::Max(most, hn::Mul(sum, inverse));
    }
    return hn::GetLane(hn::MaxOfLanes(kTag, most));
}
void FindAllHingeGains(std::span<const HingeBatch> batches, std::span<const HingeMasses> masses, float h,
                       float soft, std::span<HingeGains> gains) {
    for (size_t i = 0; i < batches.size(); ++i) {
        gains[i].soft = FindHingeGains(batches[i], masses[i], h, 2.0f, gains[i]) <= soft;
        if (!gains[i].soft) FindHingeGains(batches[i], masses[i], h, 1.0f, gains[i]);
    }
}

/// All is linear: nothing has to be turned into columns.
void SolveHinges(std::span<const HingeBatch> batches, std::span<const HingeGains> gains, bool with_soft,
                 Particle* particles) {
    auto* bytes = reinterpret_cast<unsigned char*>(particles);
    const auto at = [bytes](uint32_t offset) HWY_ATTR { return reinterpret_cast<Particle*>(bytes + offset); };
    for (size_t i = 0; i < batches.size(); ++i) {
        if (gains[i].soft && !with_soft) continue;
        for (size_t lane = 0; lane < kLanes; lane += kWide) {
            const HingeBatch& batch = batches[i];
            Rows x[4];
            for (size_t k = 0; k < 4; ++k) x[k] = Gather(at, batch.at[k] + lane);
            Rows amiss = Times(x[0], hn::Load(kTag, batch.weight[0] + lane));
            for (size_t k = 1; k < 4; ++k)
                amiss = AddScaled(amiss, x[k], hn::Load(kTag, batch.weight[k] + lane));
            for (size_t k = 0; k < 4; ++k)
                Scatter(AddScaled(x[k], amiss, hn::Neg(hn::Load(kTag, gains[i].at[k] + lane))), at,
                        batch.at[k] + lane);
        }
    }
}

void FindRunBalls(std::span<const Particle> moving, std::span<const Particle> velocities,
                  NearColliders& near) {
    for (size_t run = 0; run < moving.size() / kLanes; ++run) {
        const Particle *places = moving.data() + run * kLanes, *speeds = velocities.data() + run * kLanes;
        const Points p = Columns(Load(places, 0)), v = Columns(Load(speeds, 0));
        Points low = p, high = p;
        V speed2 = Dot(v, v);
        for (size_t k = kWide; k < kLanes; k += kWide) {
            const Points q = Columns(Load(places, k)), w = Columns(Load(speeds, k));
            low = {hn::Min(low.x, q.x), hn::Min(low.y, q.y), hn::Min(low.z, q.z)};
            high = {hn::Max(high.x, q.x), hn::Max(high.y, q.y), hn::Max(high.z, q.z)};
            speed2 = hn::Max(speed2, Dot(w, w));
        }
        const auto least = [](V v) HWY_ATTR { return hn::GetLane(hn::MinOfLanes(kTag, v)); };
        const auto most = [](V v) HWY_ATTR { return hn::GetLane(hn::MaxOfLanes(kTag, v)); };
        const Vec3 from(least(low.x), least(low.y), least(low.z)),
            to(most(high.x), most(high.y), most(high.z));
        near.x[run] = 0.5f * (from.x + to.x), near.y[run] = 0.5f * (from.y + to.y),
        near.z[run] = 0.5f * (from.z + to.z);
        const Vec3 diagonal = to - from;
        near.radii_m[run] =
            0.5f * std::sqrt(diagonal.x * diagonal.x + diagonal.y * diagonal.y + diagonal.z * diagonal.z);
        near.speeds2[run] = most(speed2);
    }
}

HWY_INLINE V NearestAlong(const CapsuleShape& c, const Points& p) {
    const Points axis = Set(c.axis), from_a = Sub(p, Set(c.a));
    const V inverse = Set(c.inverse_length2);
    const V dot = hn::Mul(Dot(from_a, axis), inverse);
    const Points square = MulAdd(axis, hn::Neg(dot), from_a);
    const V along = hn::MulAdd(Set(c.lean), hn::Sqrt(hn::Mul(Dot(square, square), inverse)), dot);
    return hn::Min(hn::Max(along, Set(0.0f)), Set(1.0f));
}

/// Which of these are within `way` of where the collider comes?
HWY_INLINE auto Near(const SweptCapsule& c, const Points& p, V way) {
    const V along = NearestAlong(c.to, p);
    const Points off = Sub(p, MulAdd(Set(c.to.axis), along, Set(c.to.a)));
    const V reach = hn::Add(hn::MulAdd(Set(c.to.taper), along, Set(c.to.radius + c.travel_m)), way);
    return hn::Lt(Dot(off, off), hn::Mul(reach, reach));
}

void FindNear(std::span<const SweptCapsule> colliders, std::span<const Particle> moving,
              NearColliders& near) {
    const size_t runs = moving.size() / kLanes, words = near.words();
    for (uint64_t& word : near.bits) word = 0;
    for (size_t run = 0; run < runs; run += kWide) {
        // The vectors are filled up to whole registers.
        const Points center{hn::LoadU(kTag, near.x.data() + run), hn::LoadU(kTag, near.y.data() + run),
                            hn::LoadU(kTag, near.z.data() + run)};
        const V radius = hn::LoadU(kTag, near.radii_m.data() + run);
        uint64_t* bits = near.bits.data() + run * words;
        for (size_t i = 0; i < colliders.size(); ++i) {
            const auto touches = Near(colliders[i], center, radius);
            if (hn::AllFalse(kTag, touches)) continue;
            uint8_t lanes[8] = {};
            hn::StoreMaskBits(kTag, touches, lanes);
            for (uint32_t left = lanes[0]; left; left &= left - 1)
                bits[hwy::Num0BitsBelowLS1Bit_Nonzero32(left) * words + i / 64] |= uint64_t(1) << (i % 64);
        }
    }
    for (size_t run = 0; run < runs; ++run) {
        const V way = Set(near.ways_m[run]);
        uint64_t* bits = near.bits.data() + run * words;
        for (size_t word = 0; word < words; ++word) {
            if (bits[word] == 0) continue;
            uint64_t kept = 0;
            for (size_t k = 0; k < kLanes; k += kWide) {
                const Points p = Columns(Load(moving.data() + run * kLanes, k));
                for (uint64_t left = bits[word]; left; left &= left - 1) {
                    const size_t i = hwy::Num0BitsBelowLS1Bit_Nonzero64(left);
                    kept |= uint64_t(!hn::AllFalse(kTag, Near(colliders[word * 64 + i], p, way))) << i;
                }
            }
            bits[word] = kept;
        }
    }
}

/// Of a run of particles from a capsule: the ball of it that is nearest, as nearest_ball() says.
struct Nearest {
    V along, distance;
    Points normal;
};
HWY_INLINE Nearest NearestBallOf(const CapsuleShape& c, V along, const Points& from_center, V length2) {
    const V length = hn::Sqrt(length2);
    const V radius = hn::MulAdd(Set(c.taper), along, Set(c.radius));
    const auto centred = hn::Le(length, Set(1e-9f));
    const Points n = Mul(from_center, hn::Div(Set(1.0f), hn::Max(length, Set(1e-9f))));
    return {along,
            hn::Sub(length, radius),
            {hn::IfThenZeroElse(centred, n.x), hn::IfThenElse(centred, Set(1.0f), n.y),
             hn::IfThenZeroElse(centred, n.z)}};
}
HWY_INLINE Points FromCenter(const CapsuleShape& c, V along, const Points& p) {
    return Sub(p, MulAdd(Set(c.axis), along, Set(c.a)));
}

/// apply_friction(): Coulomb's, all of the sliding within the cone, else the kinetic share.
HWY_INLINE Points Held(const Points& p, const Points& start, const Points& surface_motion,
                       const Points& normal, V depth, const ContactSettings& settings) {
    const Points relative = Sub(Sub(p, start), surface_motion);
    const Points sliding = MulAdd(normal, hn::Neg(Dot(relative, normal)), relative);
    const V length = hn::Sqrt(Dot(sliding, sliding));
    const V kinetic =
        hn::Div(hn::Mul(Set(settings.friction_kinetic), depth), hn::Max(length, Set(kNoLength)));
    const V share =
        hn::IfThenElse(hn::Le(length, hn::Mul(Set(settings.friction_static), depth)), Set(1.0f), kinetic);
    return MulAdd(sliding, hn::Neg(share), p);
}

/// resolve_contact() for all particles of a register whose way through the sub-step was short; the others are
/// named in the result, a bit each, and left as they are.
HWY_INLINE uint32_t Resolve(const SweptCapsule& c, const Points& start, V travel,
                            const ContactSettings& settings, Points& p) {
    const V along = NearestAlong(c.to, p), radius = hn::MulAdd(Set(c.to.taper), along, Set(c.to.radius));
    const Points from_center = FromCenter(c.to, along, p);
    const V reach = hn::Add(travel, Set(c.travel_m)), length2 = Dot(from_center, from_center),
            touching = hn::Add(radius, reach);
    const auto near = hn::Lt(length2, hn::Mul(touching, touching));
    if (HWY_LIKELY(hn::AllFalse(kTag, near))) return 0;
    const Nearest end = NearestBallOf(c.to, along, from_center, length2);
    const auto inside = hn::Lt(end.distance, Set(0.0f));
    // Who ends outside, and went no further than the radius, cannot have come through; the surface's bulge is
    // met from the side on which it began.
    const auto far = hn::And(near, hn::And(hn::Not(inside), hn::Gt(reach, radius)));
    uint8_t bits[8] = {};
    hn::StoreMaskBits(kTag, far, bits);
    uint32_t special = bits[0];
    if (hn::AllFalse(kTag, inside)) return special;

    V depth = hn::Neg(end.distance);
    auto push = inside;
    // Where it began matters only if it may have begun on the other side, or too deep to come out at once.
    const V most = hn::Min(radius, Set(settings.max_depenetration_m));
    const auto deep = hn::Gt(hn::Add(depth, reach), most);
    if (!hn::AllFalse(kTag, hn::And(inside, deep))) {
        const V begin_along = NearestAlong(c.from, start);
        const Points begin_from = FromCenter(c.from, begin_along, start);
        const Nearest begin = NearestBallOf(c.from, begin_along, begin_from, Dot(begin_from, begin_from));
        const auto same_side = hn::Gt(Dot(begin.normal, end.normal), Set(0.0f));
        hn::StoreMaskBits(kTag, hn::AndNot(same_side, inside), bits);
        special |= bits[0];
        depth = hn::Sub(
            depth, hn::Max(Set(0.0f), hn::Sub(hn::Neg(begin.distance), Set(settings.max_depenetration_m))));
        push = hn::And(hn::And(inside, same_side), hn::Gt(depth, Set(0.0f)));
        if (hn::AllFalse(kTag, push)) return special;
    }
    const V out = hn::IfThenElseZero(push, depth);
    const Points pushed = MulAdd(end.normal, out, p);

    // The surface moves with its ball and turns with the axis: w x n r = dA (A.n) - A (dA.n), times r.
    const Points axis = Set(c.to.axis), turned = Set(c.to.axis - c.from.axis);
    Points motion = MulAdd(turned, end.along, Set(c.to.a - c.from.a));
    const V lever = hn::Mul(radius, Set(c.to.inverse_length2));
    motion = MulAdd(turned, hn::Mul(lever, Dot(axis, end.normal)), motion);
    motion = MulAdd(axis, hn::Neg(hn::Mul(lever, Dot(turned, end.normal))), motion);
    const Points held = Held(pushed, start, motion, end.normal, out, settings);
    p = Choose(push, held, p);
    return special;
}

/// The lanes from k on of a run that begins with particle `at`, against one collider.
HWY_INLINE void Resolve(const SubstepEnd& end, const SweptCapsule& collider, size_t at, size_t k,
                        const Points& start, V travel, Points& p) {
    uint32_t special = Resolve(collider, start, travel, end.contact, p);
    if (HWY_LIKELY(special == 0)) return;
    Particle* places = end.moving.places + at;
    Store(RowsOf(p), places, k);
    for (; special; special &= special - 1) {
        const size_t i = particle_at(k + hwy::Num0BitsBelowLS1Bit_Nonzero32(special));
        resolve_contact(collider, end.moving.starts[at + i].x, end.contact, places[i].x);
    }
    p = Columns(Load(places, k));
}

HWY_INLINE Points WayOf(const RunBalls& balls, size_t k) {
    return {hn::Load(kTag, balls.way_x + k), hn::Load(kTag, balls.way_y + k),
            hn::Load(kTag, balls.way_z + k)};
}
HWY_INLINE Points CenterAt(const RunBalls& balls, size_t k, float share) {
    return MulAdd(WayOf(balls, k), Set(share),
                  {hn::Load(kTag, balls.x + k), hn::Load(kTag, balls.y + k), hn::Load(kTag, balls.z + k)});
}

/// Towards the balls' surface.
HWY_INLINE void KeepIn(const SubstepEnd& end, const RunBalls& balls, size_t k, Points& p) {
    const V radius = hn::Load(kTag, balls.radius_m + k);
    const Points way = Sub(p, CenterAt(balls, k, end.to));
    const V length2 = Dot(way, way);
    const auto beyond = hn::And(hn::Gt(radius, Set(0.0f)), hn::Gt(length2, hn::Mul(radius, radius)));
    const V length = hn::Max(hn::Sqrt(length2), Set(kNoLength));
    const V back = hn::Max(hn::Sub(hn::Div(radius, length), Set(1.0f)),
                           hn::Neg(hn::Div(hn::Load(kTag, balls.pull_m + k), length)));
    p = MulAdd(way, hn::IfThenElseZero(beyond, back), p);
}

/// Out of the balls, as out of colliders.
HWY_INLINE void KeepOut(const SubstepEnd& end, const RunBalls& balls, size_t k, const Points& start,
                        Points& p) {
    const ContactSettings& settings = end.contact;
    const V radius = hn::Load(kTag, balls.radius_m + k);
    const Points was = CenterAt(balls, k, end.from), way = Mul(WayOf(balls, k), Set(end.to - end.from));
    const Points from_center = Sub(Sub(p, was), way);
    const V length2 = Dot(from_center, from_center);
    const auto inside = hn::And(hn::Lt(length2, hn::Mul(radius, radius)), hn::Gt(length2, Set(0.0f)));
    if (hn::AllFalse(kTag, inside)) return;
    const V length = hn::Max(hn::Sqrt(length2), Set(kNoLength));
    const Points from = Sub(start, was);
    const V began = hn::Sub(radius, hn::Sqrt(Dot(from, from)));
    const V residue = hn::Max(Set(0.0f), hn::Sub(began, Set(settings.max_depenetration_m)));
    const V depth = hn::Sub(hn::Sub(radius, length), residue);
    const auto push = hn::And(inside, hn::Gt(depth, Set(0.0f)));
    const V out = hn::IfThenElseZero(push, depth);
    const Points normal = Mul(from_center, hn::Div(Set(1.0f), length));
    p = Choose(push, Held(MulAdd(normal, out, p), start, way, normal, out, settings), p);
}

HWY_INLINE Points Lanes(const float* x, const float* y, const float* z, size_t k) {
    return {hn::Load(kTag, x + k), hn::Load(kTag, y + k), hn::Load(kTag, z + k)};
}

/// Before the planes, as out of colliders.
HWY_INLINE void KeepBefore(const SubstepEnd& end, const RunPlanes& planes, size_t k, const Points& start,
                           Points& p) {
    const Points way = Lanes(planes.way_x, planes.way_y, planes.way_z, k),
                 first = Lanes(planes.x, planes.y, planes.z, k);
    const Points turn = Lanes(planes.turn_x, planes.turn_y, planes.turn_z, k);
    const Points upright = Lanes(planes.normal_x, planes.normal_y, planes.normal_z, k);
    const Points normal = MulAdd(turn, Set(end.to), upright), before = MulAdd(turn, Set(end.from), upright);
    const V thickness = hn::Load(kTag, planes.thickness_m + k);
    const V deep = hn::Sub(thickness, Dot(Sub(p, MulAdd(way, Set(end.to), first)), normal));
    if (hn::AllFalse(kTag, hn::Gt(deep, Set(0.0f)))) return;
    const V began = hn::Sub(thickness, Dot(Sub(start, MulAdd(way, Set(end.from), first)), before));
    const V depth = hn::Sub(deep, hn::Max(Set(0.0f), hn::Sub(began, Set(end.contact.max_depenetration_m))));
    const auto push = hn::Gt(depth, Set(0.0f));
    const V out = hn::IfThenElseZero(push, depth);
    p = Choose(
        push, Held(MulAdd(normal, out, p), start, Mul(way, Set(end.to - end.from)), normal, out, end.contact),
        p);
}

/// Of a register's particles, those beyond their tethers; `p` is set where there are any.
HWY_INLINE bool PullBack(const SubstepEnd& end, size_t at, Points& p) {
    const Particle* all = end.anchors;
    const auto anchor_at = [all](uint32_t index) HWY_ATTR { return all + index; };
    const Points anchor = Columns(Gather(anchor_at, end.anchor_index.data() + at)), way = Sub(p, anchor);
    const V length2 = Dot(way, way), most = hn::LoadU(kTag, end.tether_m.data() + at);
    const auto beyond = hn::Gt(length2, hn::Mul(most, most));
    if (hn::AllFalse(kTag, beyond)) return false;
    p = MulAdd(way, hn::IfThenElseZero(beyond, hn::Sub(hn::Div(most, hn::Sqrt(length2)), Set(1.0f))), p);
    return true;
}

void EndSubstep(const SubstepEnd& given) {
    const SubstepEnd end = given;
    const Moving& m = end.moving;
    const NearColliders& met = *end.may_meet;
    const size_t words = met.words();
    const V rate = Set(1.0f / end.h), keep = Set(end.keep), h = Set(end.h);
    const RunBalls* backstops = end.backstops.data();
    const RunBalls* const no_backstop = backstops + end.backstops.size();
    const RunPlanes* planes = end.planes.data();
    const RunPlanes* const no_plane = planes + end.planes.size();
    const RunBalls* limits = end.limits.data();
    const RunBalls* const no_limit = limits + end.limits.size();
    for (size_t run = 0; run < m.count / kLanes; ++run) {
        const uint64_t* bits = met.bits.data() + run * words;
        uint64_t any = 0;
        for (size_t word = 0; word < words; ++word) any |= bits[word];
        const V reach2 = Set(met.radii_m[run] * met.radii_m[run]);
        const RunBalls *const own_backstops = backstops, *const own_limits = limits;
        while (backstops != no_backstop && backstops->run == run) ++backstops;
        while (limits != no_limit && limits->run == run) ++limits;
        const RunPlanes* const own_planes = planes;
        while (planes != no_plane && planes->run == run) ++planes;
        const size_t at = run * kLanes;
        for (size_t k = 0; k < kLanes; k += kWide) {
            Rows place = Load(m.places + at, k);
            const Rows start = Load(m.starts + at, k);
            Points p = Columns(place);
            bool moved = PullBack(end, at + k, p);
            for (const RunBalls* b = own_limits; b != limits; ++b, moved = true) KeepIn(end, *b, k, p);
            const Points off = Sub(p, {Set(met.x[run]), Set(met.y[run]), Set(met.z[run])});
            const bool strayed = !hn::AllTrue(kTag, hn::Le(Dot(off, off), reach2));
            if (any != 0 || own_backstops != backstops || own_planes != planes || HWY_UNLIKELY(strayed)) {
                const Points from = Columns(start), free = p;
                for (const RunBalls* b = own_backstops; b != backstops; ++b) KeepOut(end, *b, k, from, p);
                for (const RunPlanes* b = own_planes; b != planes; ++b) KeepBefore(end, *b, k, from, p);
                const Points way = Sub(p, from);
                const V travel = hn::Sqrt(Dot(way, way));
                if (HWY_UNLIKELY(strayed)) {
                    for (const SweptCapsule& collider : end.colliders)
                        Resolve(end, collider, at, k, from, travel, p);
                } else {
                    for (size_t word = 0; word < words; ++word)
                        for (uint64_t left = bits[word]; left; left &= left - 1)
                            Resolve(end, end.colliders[word * 64 + hwy::Num0BitsBelowLS1Bit_Nonzero64(left)],
                                    at, k, from, travel, p);
                }
                moved = true;
                if (end.pushed)
                    Store(AddScaled(Load(end.pushed + at, k), RowsOf(Sub(p, free)), Set(1.0f)),
                          end.pushed + at, k);
            }
            if (moved) place = RowsOf(p);
            const Rows v = Load(m.velocities + at, k);
            // The same sum as by which it was predicted.
            const Rows change = Sub(place, MulAdd(v, h, start));
            const Rows ended = Scaled(Add(MulAdd(change, rate, v), end.half_fall), keep);
            if (end.last) {
                Store(place, m.places + at, k);
                Store(ended, m.velocities + at, k);
                continue;
            }
            const Rows next = Add(ended, end.half_fall);
            Store(place, m.starts + at, k);
            Store(next, m.velocities + at, k);
            Store(MulAdd(next, h, place), m.places + at, k);
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace vfit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vfit {

HWY_EXPORT(Predict);
HWY_EXPORT(FindGains);
HWY_EXPORT(SolveDistances);
HWY_EXPORT(FindAllHingeGains);
HWY_EXPORT(SolveHinges);
HWY_EXPORT(FindRunBalls);
HWY_EXPORT(FindNear);
HWY_EXPORT(EndSubstep);

void predict(const Moving& moving, const Vec3& half_fall, float h) {
    HWY_DYNAMIC_DISPATCH(Predict)(moving, half_fall, h);
}
float find_gains(std::span<const BatchMasses> masses, float h, float force, std::span<BatchGains> gains) {
    return HWY_DYNAMIC_DISPATCH(FindGains)(masses, h, force, gains);
}
void solve_distances(std::span<const DistanceBatch> batches, std::span<const BatchGains> gains,
                     Particle* particles) {
    HWY_DYNAMIC_DISPATCH(SolveDistances)(batches, gains, particles);
}
void find_hinge_gains(std::span<const HingeBatch> batches, std::span<const HingeMasses> masses, float h,
                      float soft, std::span<HingeGains> gains) {
    HWY_DYNAMIC_DISPATCH(FindAllHingeGains)(batches, masses, h, soft, gains);
}
void solve_hinges(std::span<const HingeBatch> batches, std::span<const HingeGains> gains, bool with_soft,
                  Particle* particles) {
    HWY_DYNAMIC_DISPATCH(SolveHinges)(batches, gains, with_soft, particles);
}
void find_run_balls(std::span<const Particle> moving, std::span<const Particle> velocities,
                    NearColliders& near) {
    HWY_DYNAMIC_DISPATCH(FindRunBalls)(moving, velocities, near);
}
void find_near(std::span<const SweptCapsule> colliders, std::span<const Particle> moving,
               NearColliders& near) {
    HWY_DYNAMIC_DISPATCH(FindNear)(colliders, moving, near);
}
void end_substep(const SubstepEnd& end) { HWY_DYNAMIC_DISPATCH(EndSubstep)(end); }

}  // namespace vfit
#endif
