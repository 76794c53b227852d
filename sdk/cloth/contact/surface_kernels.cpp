#include "cloth/contact/surface_kernels.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cloth/contact/surface_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "cloth/base/nearest_on_triangle-inl.h"
#include "cloth/base/particle_registers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace vfit {
namespace HWY_NAMESPACE {

constexpr hn::FixedTag<uint32_t, kWide> kInts;

void FindNearestInRuns(const Particle* run, const Particle* all, std::span<const uint32_t> runs,
                       NearestOfRun& out) {
    for (size_t k = 0; k < kLanes; k += kWide) {
        const Points p = Columns(Load(run, k));
        V best2 = hn::Load(kTag, out.distance2 + k);
        V best = hn::BitCast(kTag, hn::Load(kInts, out.id + k));
        for (const uint32_t other : runs)
            for (uint32_t id = other * uint32_t(kLanes); id < (other + 1) * kLanes; ++id) {
                const Points way = Sub(Set(all[id].x), p);
                const V distance2 = Dot(way, way);
                const auto nearer = hn::Lt(distance2, best2);
                best2 = hn::IfThenElse(nearer, distance2, best2);
                best = hn::IfThenElse(nearer, hn::BitCast(kTag, hn::Set(kInts, id)), best);
            }
        hn::Store(best2, kTag, out.distance2 + k);
        hn::Store(hn::BitCast(kInts, best), kInts, out.id + k);
    }
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

}  // namespace HWY_NAMESPACE
}  // namespace vfit
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace vfit {

HWY_EXPORT(FindNearestInRuns);
HWY_EXPORT(FindMeeting);
HWY_EXPORT(FindNearestOnFans);

NearestOfRun::NearestOfRun(float reach) {
    for (size_t k = 0; k < kLanes; ++k) distance2[k] = reach * reach, id[k] = UINT32_MAX;
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
void find_meeting(const RunBoxes& boxes, const Vec3& low, const Vec3& high, std::vector<uint32_t>& runs) {
    HWY_DYNAMIC_DISPATCH(FindMeeting)(boxes, low, high, runs);
}
void find_nearest_on_fans(const Particle* run, const uint32_t* points, const TriangleFans& fans,
                          const Particle* all, NearestOnFans& out) {
    HWY_DYNAMIC_DISPATCH(FindNearestOnFans)(run, points, fans, all, out);
}

}  // namespace vfit
#endif
