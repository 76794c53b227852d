#include "cloth/surface_kernels.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cloth/surface_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "cloth/particle_registers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vfit {
namespace HWY_NAMESPACE {

constexpr float kAside_m = 0.015f;

constexpr hn::FixedTag<uint32_t, kWide> kInts;

/// The nearest of what is shown to lanes k on of a run.
class Nearest {
public:
    HWY_INLINE Nearest(const Particle* run, const Particle* normals, size_t k, NearestOfRun& out)
        : p_(Columns(Load(run, k))), n_(Columns(Load(normals, k))), k_(k), out_(out) {
        for (size_t side = 0; side < 2; ++side) {
            distance2_[side] = hn::Load(kTag, out.distance2[side] + k);
            id_[side] = hn::BitCast(kTag, hn::Load(kInts, out.id[side] + k));
        }
    }
    HWY_INLINE void see(const Vec3& point, uint32_t id, uint32_t excluded) {
        const Points way = Sub(Set(point), p_);
        V distance2 = Dot(way, way);
        if (excluded != 0) {
            uint8_t bits[8] = {uint8_t(excluded >> k_)};
            distance2 = hn::IfThenElse(hn::LoadMaskBits(kTag, bits), Set(INFINITY), distance2);
        }
        const V what = hn::BitCast(kTag, hn::Set(kInts, id));
        const auto before = hn::Ge(Dot(way, n_), Set(0.0f));
        const auto nearer = hn::And(before, hn::Lt(distance2, distance2_[0]));
        const auto nearer_behind = hn::AndNot(before, hn::Lt(distance2, distance2_[1]));
        distance2_[0] = hn::IfThenElse(nearer, distance2, distance2_[0]);
        id_[0] = hn::IfThenElse(nearer, what, id_[0]);
        distance2_[1] = hn::IfThenElse(nearer_behind, distance2, distance2_[1]);
        id_[1] = hn::IfThenElse(nearer_behind, what, id_[1]);
    }
    HWY_INLINE void tell() const {
        for (size_t side = 0; side < 2; ++side) {
            hn::Store(distance2_[side], kTag, out_.distance2[side] + k_);
            hn::Store(hn::BitCast(kInts, id_[side]), kInts, out_.id[side] + k_);
        }
    }

private:
    Points p_, n_;
    V distance2_[2], id_[2];
    size_t k_;
    NearestOfRun& out_;
};

size_t KeepNear(const Particle* run, const Particle* all, float reach_m, uint32_t* runs, uint64_t* excluded, size_t count) {
    const V reach2 = Set(reach_m * reach_m);
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i) {
        bool any = false;
        for (size_t k = 0; k < kLanes && !any; k += kWide) {
            const Points p = Columns(Load(run, k));
            uint32_t found = 0;  // a bit for each lane
            for (uint32_t j = 0; j < kLanes; ++j) {
                const Points way = Sub(Set(all[runs[i] * kLanes + j].x), p);
                uint8_t bits[8] = {};
                hn::StoreMaskBits(kTag, hn::Lt(Dot(way, way), reach2), bits);
                found |= bits[0] & ~uint32_t(uint8_t(excluded[i] >> (8 * j)) >> k);
            }
            any = found != 0;
        }
        runs[kept] = runs[i];
        excluded[kept] = excluded[i];
        kept += any;
    }
    return kept;
}

void FindNearestInRuns(const Particle* run, const Particle* normals, const Particle* all, std::span<const uint32_t> runs,
                       std::span<const uint64_t> excluded, NearestOfRun& out) {
    for (size_t k = 0; k < kLanes; k += kWide) {
        Nearest nearest(run, normals, k, out);
        for (size_t i = 0; i < runs.size(); ++i)
            for (uint32_t j = 0; j < kLanes; ++j) {
                const uint32_t id = runs[i] * uint32_t(kLanes) + j, lanes = excluded.empty() ? 0 : uint32_t(excluded[i] >> (8 * j)) & 0xff;
                if (lanes != 0xff) nearest.see(all[id].x, id, lanes);
            }
        nearest.tell();
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
    const auto add = [&](const hn::Vec<hn::FixedTag<float, 4>>& what, uint32_t to) HWY_ATTR {
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

HWY_INLINE Points Cross(const Points& a, const Points& b) {
    return {hn::NegMulAdd(a.z, b.y, hn::Mul(a.y, b.z)), hn::NegMulAdd(a.x, b.z, hn::Mul(a.z, b.x)),
            hn::NegMulAdd(a.y, b.x, hn::Mul(a.x, b.y))};
}

void SolveSurfaceContacts(std::span<const SurfaceContacts> contacts, Particle* particles) {
    auto* bytes = reinterpret_cast<unsigned char*>(particles);
    const auto at = [bytes](uint32_t offset) HWY_ATTR { return reinterpret_cast<Particle*>(bytes + offset); };
    for (const SurfaceContacts& s : contacts)
        for (size_t k = 0; k < kLanes; k += kWide) {
            const Points p = Columns(Gather(at, s.vertex + k)), a = Columns(Gather(at, s.a + k));
            const Points b = Columns(Gather(at, s.b + k)), c = Columns(Gather(at, s.c + k));
            const Points across = Cross(Sub(b, a), Sub(c, a));
            const V length2 = Dot(across, across);
            const Points normal = Mul(across, hn::Div(hn::Load(kTag, s.side + k), hn::Max(hn::Sqrt(length2), Set(kNoLength))));
            const Points on = MulAdd(c, hn::Load(kTag, s.at_c + k), MulAdd(b, hn::Load(kTag, s.at_b + k), Mul(a, hn::Load(kTag, s.at_a + k))));
            const V thickness = hn::Load(kTag, s.thickness_m + k);
            const Points off = Sub(p, on);
            const V before = Dot(off, normal), amiss = hn::Sub(thickness, before);
            // Where the particle has slid away from the triangle, its plane says nothing any more.
            const V aside2 = hn::NegMulAdd(before, before, Dot(off, off));
            const auto touching = hn::And(hn::Gt(amiss, Set(0.0f)), hn::Lt(aside2, Set(kAside_m * kAside_m)));
            if (hn::AllFalse(kTag, touching)) continue;
            const Points push = Mul(normal, hn::IfThenElseZero(touching, hn::Min(amiss, thickness)));
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
HWY_EXPORT(FindMeeting);
HWY_EXPORT(KeepNear);
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
        for (size_t i = block * kLanes; i < (block + 1) * kLanes; ++i) low = glm::min(low, runs.low_of(i)), high = glm::max(high, runs.high_of(i));
        blocks.set(block, low, high);
    }
}

void find_nearest_in_runs(const Particle* run, const Particle* normals, const Particle* all, std::span<const uint32_t> runs,
                          std::span<const uint64_t> excluded, NearestOfRun& out) {
    HWY_DYNAMIC_DISPATCH(FindNearestInRuns)(run, normals, all, runs, excluded, out);
}
size_t keep_near(const Particle* run, const Particle* all, float reach_m, uint32_t* runs, uint64_t* excluded, size_t count) {
    return HWY_DYNAMIC_DISPATCH(KeepNear)(run, all, reach_m, runs, excluded, count);
}
void find_meeting(const RunBoxes& boxes, const Vec3& low, const Vec3& high, std::vector<uint32_t>& runs) {
    HWY_DYNAMIC_DISPATCH(FindMeeting)(boxes, low, high, runs);
}
void solve_surface_contacts(std::span<const SurfaceContacts> contacts, Particle* particles) {
    HWY_DYNAMIC_DISPATCH(SolveSurfaceContacts)(contacts, particles);
}

}  // namespace vfit
#endif
