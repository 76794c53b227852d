#include "cloth/contact/surface_kernels.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cloth/contact/surface_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "cloth/solver/particle_registers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vfit {
namespace HWY_NAMESPACE {

constexpr float kAside_m = 0.015f;
// Two places of a cloth that are near along it come as near as its thickness in a fold alone, where they face
// away from each other.
constexpr float kAway = -0.5f;  // cosine

constexpr hn::FixedTag<uint32_t, kWide> kInts;

/// Of lanes k on, those that a byte names.
HWY_INLINE auto Lanes(uint32_t byte, size_t k) {
    uint8_t bits[8] = {uint8_t(byte >> k)};
    return hn::LoadMaskBits(kTag, bits);
}

/// A run that looks: its lanes k on.
struct Looking {
    Points p, n;
    size_t k;

    HWY_INLINE Looking(const Particle* run, const Particle* normals, size_t from)
        : p(Columns(Load(run, from))), n(Columns(Load(normals, from))), k(from) {}
    HWY_INLINE explicit Looking(const Particle* run, size_t from)
        : p(Columns(Load(run, from))), n(Set(Vec3(0.0f))), k(from) {}
    /// Squares of distances; infinite for those that do not count.
    HWY_INLINE V Distance2(const Points& way, const NearRun& other, uint32_t j, const Vec3& normal) const {
        V distance2 = Dot(way, way);
        if (const uint32_t excluded = uint32_t(other.excluded >> (8 * j)) & 0xff)
            distance2 = hn::IfThenElse(Lanes(excluded, k), Set(INFINITY), distance2);
        if (const uint32_t beside = uint32_t(other.beside >> (8 * j)) & 0xff) {
            const auto alike = hn::Ge(Dot(n, Set(normal)), Set(kAway));
            distance2 = hn::IfThenElse(hn::And(Lanes(beside, k), alike), Set(INFINITY), distance2);
        }
        return distance2;
    }
};

/// The nearest of what is shown to a run.
class Nearest {
public:
    HWY_INLINE Nearest(const Looking& looking, NearestOfRun& out) : by_(looking), out_(out) {
        for (size_t side = 0; side < 2; ++side) {
            distance2_[side] = hn::Load(kTag, out.distance2[side] + by_.k);
            id_[side] = hn::BitCast(kTag, hn::Load(kInts, out.id[side] + by_.k));
        }
    }
    HWY_INLINE void see(const Points& way, V distance2, uint32_t id) {
        const V what = hn::BitCast(kTag, hn::Set(kInts, id));
        const auto before = hn::Ge(Dot(way, by_.n), Set(0.0f));
        const auto nearer = hn::And(before, hn::Lt(distance2, distance2_[0]));
        const auto nearer_behind = hn::AndNot(before, hn::Lt(distance2, distance2_[1]));
        distance2_[0] = hn::IfThenElse(nearer, distance2, distance2_[0]);
        id_[0] = hn::IfThenElse(nearer, what, id_[0]);
        distance2_[1] = hn::IfThenElse(nearer_behind, distance2, distance2_[1]);
        id_[1] = hn::IfThenElse(nearer_behind, what, id_[1]);
    }
    HWY_INLINE void tell() const {
        for (size_t side = 0; side < 2; ++side) {
            hn::Store(distance2_[side], kTag, out_.distance2[side] + by_.k);
            hn::Store(hn::BitCast(kInts, id_[side]), kInts, out_.id[side] + by_.k);
        }
    }

private:
    Looking by_;
    V distance2_[2], id_[2];
    NearestOfRun& out_;
};

/// Does a particle of these face away from one of the other run? What lies beside it counts only then.
HWY_INLINE bool FacesAway(const Looking& looking, const Particle* normals) {
    V least = Dot(looking.n, Set(normals[0].x));
    for (size_t j = 1; j < kLanes; ++j) least = hn::Min(least, Dot(looking.n, Set(normals[j].x)));
    return !hn::AllFalse(kTag, hn::Lt(least, Set(kAway)));
}

HWY_INLINE bool IsNear(const Looking& looking, const NearRun& other, const Particle* places,
                       const Particle* normals) {
    if (~(other.excluded | other.beside) == 0 && !FacesAway(looking, normals)) return false;
    V least = Set(INFINITY);
    for (uint32_t j = 0; j < kLanes; ++j)
        least = hn::Min(least, looking.Distance2(Sub(Set(places[j].x), looking.p), other, j, normals[j].x));
    const float reach = other.reach_m + other.way_m;
    return !hn::AllFalse(kTag, hn::Lt(least, Set(reach * reach)));
}

size_t KeepNear(uint32_t run, const Particle* all, const Particle* normals, std::span<NearRun> runs) {
    for (NearRun& other : runs) other.near = false;
    for (size_t k = 0; k < kLanes; k += kWide) {
        const Looking looking(all + run * kLanes, normals + run * kLanes, k);
        for (NearRun& other : runs)
            other.near =
                other.near || IsNear(looking, other, all + other.run * kLanes, normals + other.run * kLanes);
    }
    size_t kept = 0;
    for (const NearRun& other : runs) {
        const bool near = other.near;
        runs[kept] = other;
        kept += near;
    }
    return kept;
}

void FindNearestInRuns(const Particle* run, const Particle* all, std::span<const uint32_t> runs,
                       NearestOfRun& out) {
    for (size_t k = 0; k < kLanes; k += kWide) {
        const Looking looking(run, k);
        Nearest nearest(looking, out);
        for (const uint32_t other : runs)
            for (uint32_t id = other * uint32_t(kLanes); id < (other + 1) * kLanes; ++id) {
                const Points way = Sub(Set(all[id].x), looking.p);
                nearest.see(way, Dot(way, way), id);
            }
        nearest.tell();
    }
}

void FindNearestInCloth(uint32_t run, const Particle* all, const Particle* normals,
                        std::span<const NearRun> runs, NearestOfRun& out) {
    for (size_t k = 0; k < kLanes; k += kWide) {
        const Looking looking(all + run * kLanes, normals + run * kLanes, k);
        Nearest nearest(looking, out);
        for (const NearRun& other : runs)
            for (uint32_t j = 0; j < kLanes; ++j) {
                if ((other.excluded >> (8 * j) & 0xff) == 0xff) continue;
                const uint32_t id = other.run * uint32_t(kLanes) + j;
                const Points way = Sub(Set(all[id].x), looking.p);
                nearest.see(way, looking.Distance2(way, other, j, normals[id].x), id);
            }
        nearest.tell();
    }
}

HWY_INLINE Points Cross(const Points& a, const Points& b) {
    return {hn::NegMulAdd(a.z, b.y, hn::Mul(a.y, b.z)), hn::NegMulAdd(a.x, b.z, hn::Mul(a.z, b.x)),
            hn::NegMulAdd(a.y, b.x, hn::Mul(a.x, b.y))};
}

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

void FindNearestOnFans(const Particle* run, const uint32_t* points, const TriangleFans& fans,
                       const Particle* all, NearestOnFans& out) {
    const auto at = [all](uint32_t index) HWY_ATTR { return all + index; };
    alignas(32) uint32_t own[kLanes], second[kLanes], third[kLanes], corner[kLanes], left[kLanes];
    uint32_t most = 0;
    for (size_t lane = 0; lane < kLanes; ++lane) {
        const bool somebody = points[lane] != NearestOnFans::kNone;
        own[lane] = somebody ? points[lane] : 0;
        corner[lane] = fans.first()[own[lane]];
        left[lane] = somebody ? fans.first()[own[lane] + 1] - corner[lane] : 0;
        most = HWY_MAX(most, left[lane]);
        second[lane] = third[lane] = own[lane];
        out.distance2[lane] = INFINITY;
        out.corners[lane] = NearestOnFans::kNone;
        out.at_second[lane] = out.at_third[lane] = 0.0f;
    }
    const hn::Rebind<uint32_t, Tag> ints;
    for (uint32_t step = 0; step < most; ++step) {
        for (size_t lane = 0; lane < kLanes; ++lane) {
            if (step >= left[lane]) continue;  // the last one again is no nearer
            const TriangleFans::Corners& c = fans.corners()[corner[lane] + step];
            second[lane] = c.second, third[lane] = c.third;
        }
        for (size_t k = 0; k < kLanes; k += kWide) {
            const Points p = Columns(Load(run, k)), a = Columns(Gather(at, own + k));
            const OnTriangle found =
                NearestOnTriangle(p, a, Columns(Gather(at, second + k)), Columns(Gather(at, third + k)));
            const V before = hn::Load(kTag, out.distance2 + k);
            const auto there = hn::RebindMask(kTag, hn::Lt(hn::Set(ints, step), hn::Load(ints, left + k)));
            // On an edge, the first of its two triangles: rounding does not choose.
            const auto nearer = hn::And(there, hn::Lt(found.distance2, hn::Mul(before, Set(0.9999f))));
            hn::Store(hn::IfThenElse(nearer, found.distance2, before), kTag, out.distance2 + k);
            hn::Store(hn::IfThenElse(nearer, found.at_b, hn::Load(kTag, out.at_second + k)), kTag,
                      out.at_second + k);
            hn::Store(hn::IfThenElse(nearer, found.at_c, hn::Load(kTag, out.at_third + k)), kTag,
                      out.at_third + k);
            const auto which = hn::Add(hn::Load(ints, corner + k), hn::Set(ints, step));
            hn::Store(hn::IfThenElse(hn::RebindMask(ints, nearer), which, hn::Load(ints, out.corners + k)),
                      ints, out.corners + k);
        }
    }
}

/// A bit for each of the kWide boxes from there on.
HWY_INLINE uint32_t Meeting(const Boxes& boxes, size_t at, const Points& low, const Points& high) {
    auto meets = hn::Le(hn::LoadU(kTag, &boxes.low[0][at]), high.x);
    meets = hn::And(meets, hn::Ge(hn::LoadU(kTag, &boxes.high[0][at]), low.x));
    meets = hn::And(meets, hn::Le(hn::LoadU(kTag, &boxes.low[1][at]), high.y));
    meets = hn::And(meets, hn::Ge(hn::LoadU(kTag, &boxes.high[1][at]), low.y));
    meets = hn::And(meets, hn::Le(hn::LoadU(kTag, &boxes.low[2][at]), high.z));
    meets = hn::And(meets, hn::Ge(hn::LoadU(kTag, &boxes.high[2][at]), low.z));
    uint8_t bits[8] = {};
    hn::StoreMaskBits(kTag, meets, bits);
    return bits[0];
}

void FindMeeting(const RunBoxes& boxes, const Vec3& from, const Vec3& to, std::vector<uint32_t>& runs) {
    runs.clear();
    const Points low = Set(from), high = Set(to);
    for (size_t i = 0; i < boxes.blocks.low[0].size(); i += kWide)
        for (uint32_t blocks = Meeting(boxes.blocks, i, low, high); blocks; blocks &= blocks - 1) {
            const size_t block = (i + hwy::Num0BitsBelowLS1Bit_Nonzero32(blocks)) * kLanes;
            for (size_t k = 0; k < kLanes; k += kWide)
                for (uint32_t left = Meeting(boxes.runs, block + k, low, high); left; left &= left - 1)
                    runs.push_back(uint32_t(block + k + hwy::Num0BitsBelowLS1Bit_Nonzero32(left)));
        }
}

/// Adds to each particle in turn, so that one that several lanes name gets it all.
template <typename At>
HWY_INLINE void ScatterAdd(const Rows& rows, const At& at, const uint32_t* index) {
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

/// How far the particle is before the triangle, on its own side; and where it is from its place on it.
struct Before {
    V distance;
    Points off, normal;
};
HWY_INLINE Before BeforeTriangle(const SurfaceContacts& s, size_t k, const Points& p, const Points& a,
                                 const Points& b, const Points& c) {
    const Points across = Cross(Sub(b, a), Sub(c, a));
    const Points normal = Mul(
        across, hn::Div(hn::Load(kTag, s.side + k), hn::Max(hn::Sqrt(Dot(across, across)), Set(kNoLength))));
    const Points on = MulAdd(c, hn::Load(kTag, s.at_c + k),
                             MulAdd(b, hn::Load(kTag, s.at_b + k), Mul(a, hn::Load(kTag, s.at_a + k))));
    const Points off = Sub(p, on);
    return {Dot(off, normal), off, normal};
}

void SolveSurfaceContacts(std::span<const SurfaceContacts> contacts, const Particle* starts,
                          float most_back_m, Particle* particles) {
    auto* bytes = reinterpret_cast<unsigned char*>(particles);
    const auto* start_bytes = reinterpret_cast<const unsigned char*>(starts);
    const auto at = [bytes](uint32_t offset) HWY_ATTR { return reinterpret_cast<Particle*>(bytes + offset); };
    const auto start_of = [start_bytes](uint32_t offset)
                              HWY_ATTR { return reinterpret_cast<const Particle*>(start_bytes + offset); };
    for (const SurfaceContacts& s : contacts)
        for (size_t k = 0; k < kLanes; k += kWide) {
            const Before end =
                BeforeTriangle(s, k, Columns(Gather(at, s.vertex + k)), Columns(Gather(at, s.a + k)),
                               Columns(Gather(at, s.b + k)), Columns(Gather(at, s.c + k)));
            const V thickness = hn::Load(kTag, s.thickness_m + k);
            const V amiss = hn::Sub(thickness, end.distance);
            // Where the particle has slid away from the triangle, its plane says nothing any more.
            const V aside2 = hn::NegMulAdd(end.distance, end.distance, Dot(end.off, end.off));
            const auto touching = hn::And(hn::Gt(amiss, Set(0.0f)), hn::Lt(aside2, Set(kAside_m * kAside_m)));
            if (hn::AllFalse(kTag, touching)) continue;
            const Before start = BeforeTriangle(
                s, k, Columns(Gather(start_of, s.vertex + k)), Columns(Gather(start_of, s.a + k)),
                Columns(Gather(start_of, s.b + k)), Columns(Gather(start_of, s.c + k)));
            const V residue =
                hn::Max(Set(0.0f), hn::Sub(hn::Sub(thickness, start.distance), Set(most_back_m)));
            const V depth = hn::Max(Set(0.0f), hn::Sub(amiss, residue));
            const Points push = Mul(end.normal, hn::IfThenElseZero(touching, depth));
            ScatterAdd(RowsOf(Mul(push, hn::Load(kTag, s.vertex_gain + k))), at, s.vertex + k);
            ScatterAdd(RowsOf(Mul(push, hn::Neg(hn::Load(kTag, s.a_gain + k)))), at, s.a + k);
            ScatterAdd(RowsOf(Mul(push, hn::Neg(hn::Load(kTag, s.b_gain + k)))), at, s.b + k);
            ScatterAdd(RowsOf(Mul(push, hn::Neg(hn::Load(kTag, s.c_gain + k)))), at, s.c + k);
        }
}

}  // namespace HWY_NAMESPACE
}  // namespace vfit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vfit {

HWY_EXPORT(FindNearestInRuns);
HWY_EXPORT(FindNearestInCloth);
HWY_EXPORT(FindMeeting);
HWY_EXPORT(KeepNear);
HWY_EXPORT(FindNearestOnFans);
HWY_EXPORT(SolveSurfaceContacts);

NearestOfRun::NearestOfRun(float reach) {
    for (size_t side = 0; side < 2; ++side)
        for (size_t k = 0; k < kLanes; ++k) distance2[side][k] = reach * reach, id[side][k] = UINT32_MAX;
}

void Boxes::resize(size_t count) {
    const size_t whole = (count + kLanes - 1) / kLanes * kLanes;
    for (auto* list : {&low[0], &low[1], &low[2]}) list->assign(whole, INFINITY);
    for (auto* list : {&high[0], &high[1], &high[2]}) list->assign(whole, -INFINITY);
}

void Boxes::set(size_t at, const Vec3& from, const Vec3& to) {
    for (int k = 0; k < 3; ++k) low[k][at] = from[k], high[k][at] = to[k];
}

void RunBoxes::resize(size_t count) {
    runs.resize(count);
    blocks.resize(runs.low[0].size() / kLanes);
}

void RunBoxes::find_blocks() {
    for (size_t block = 0; block < runs.low[0].size() / kLanes; ++block) {
        Vec3 low(INFINITY), high(-INFINITY);
        for (size_t i = block * kLanes; i < (block + 1) * kLanes; ++i)
            low = glm::min(low, runs.low_of(i)), high = glm::max(high, runs.high_of(i));
        blocks.set(block, low, high);
    }
}

void find_nearest_in_runs(const Particle* run, const Particle* all, std::span<const uint32_t> runs,
                          NearestOfRun& out) {
    HWY_DYNAMIC_DISPATCH(FindNearestInRuns)(run, all, runs, out);
}
size_t keep_near(uint32_t run, const Particle* all, const Particle* normals, std::span<NearRun> runs) {
    return HWY_DYNAMIC_DISPATCH(KeepNear)(run, all, normals, runs);
}
void find_nearest_in_cloth(uint32_t run, const Particle* all, const Particle* normals,
                           std::span<const NearRun> runs, NearestOfRun& out) {
    HWY_DYNAMIC_DISPATCH(FindNearestInCloth)(run, all, normals, runs, out);
}
void find_meeting(const RunBoxes& boxes, const Vec3& low, const Vec3& high, std::vector<uint32_t>& runs) {
    HWY_DYNAMIC_DISPATCH(FindMeeting)(boxes, low, high, runs);
}
void find_nearest_on_fans(const Particle* run, const uint32_t* points, const TriangleFans& fans,
                          const Particle* all, NearestOnFans& out) {
    HWY_DYNAMIC_DISPATCH(FindNearestOnFans)(run, points, fans, all, out);
}
void solve_surface_contacts(std::span<const SurfaceContacts> contacts, const Particle* starts,
                            float most_back_m, Particle* particles) {
    HWY_DYNAMIC_DISPATCH(SolveSurfaceContacts)(contacts, starts, most_back_m, particles);
}

}  // namespace vfit
#endif
