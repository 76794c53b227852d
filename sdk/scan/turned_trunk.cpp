#include "scan/turned_trunk.h"

#include <algorithm>
#include <cmath>

#include "core/wipe.h"
#include "geometry/section.h"

namespace vfit {

namespace {

constexpr float kStep = TrunkProfile::along(1) - TrunkProfile::along(0);
constexpr float kLegsApart = -0.08f;  // below it two legs make the outline

float girth_of(const TrunkSection& section) {
    constexpr int kWidestGap = TrunkSection::kDirections / 4;
    std::vector<Vec2> outline;
    int gap = 0, widest = 0;
    for (int i = 0; i < 2 * TrunkSection::kDirections; ++i) {  // twice round: gaps run across the first one
        const size_t d = size_t(i % TrunkSection::kDirections);
        const bool seen = !std::isnan(section.radii_m[d]);
        gap = seen ? 0 : gap + 1;
        widest = std::max(widest, gap);
        if (seen && i < TrunkSection::kDirections) outline.push_back(section.point(d));
    }
    return widest > kWidestGap ? std::nanf("") : hull_perimeter(outline);
}

}  // namespace

TurnedTrunk::TurnedTrunk(const std::vector<TrunkView>& views) {
    fuse_views(views, sections_);
    for (int l = 0; l < kLevels; ++l)
        girths_m_[size_t(l)] =
            TrunkProfile::along(l) < kLegsApart ? std::nanf("") : girth_of(sections_[size_t(l)]);
}

TurnedTrunk::~TurnedTrunk() { wipe(sections_), wipe(girths_m_); }

float TurnedTrunk::girth_m(float share) const {
    const float place = (share - TrunkProfile::along(0)) / kStep;
    if (!(place >= 0.0f && place <= float(kLevels - 1))) return std::nanf("");
    const size_t level = std::min(size_t(place), size_t(kLevels - 2));
    return std::lerp(girths_m_[level], girths_m_[level + 1], place - float(level));
}

float TurnedTrunk::largest_girth_m(float low, float high) const {
    if (!(low < high)) return std::nanf("");
    float out = girth_m(low);
    size_t last = 0;
    for (size_t l = 0; l < size_t(kLevels); ++l)
        if (low < TrunkProfile::along(int(l)) && TrunkProfile::along(int(l)) < high)
            out = std::fmax(out, girths_m_[l]), last = l;
    if (last == 0) return std::fmax(out, girth_m(high));
    // At the end arms may begin: the girth goes on no steeper than below it.
    const float rest = (high - TrunkProfile::along(int(last))) / kStep,
                goes_on = girths_m_[last] + rest * (girths_m_[last] - girths_m_[last - 1]);
    return std::fmax(out, std::fmin(girth_m(high), goes_on));
}

float TurnedTrunk::smallest_girth_m(float low, float high) const {
    if (!(low < high)) return std::nanf("");
    float out = std::fmin(girth_m(low), girth_m(high));
    for (int l = 0; l < kLevels; ++l)
        if (low < TrunkProfile::along(l) && TrunkProfile::along(l) < high)
            out = std::fmin(out, girths_m_[size_t(l)]);
    return out;
}

float TurnedTrunk::bust(float low, float high) const {
    std::vector<Vec2> fronts;  // share and reach ahead
    for (int l = 0; l < kLevels; ++l) {
        if (!(low < TrunkProfile::along(l) && TrunkProfile::along(l) < high)) continue;
        float ahead = 0.0f;
        for (size_t d = 0; d < TrunkSection::kDirections; ++d)
            ahead = std::fmax(ahead, sections_[size_t(l)].point(d).y);
        fronts.emplace_back(TrunkProfile::along(l), ahead);
    }
    if (fronts.size() < 3 || fronts.front().y == 0.0f || fronts.back().y == 0.0f) return std::nanf("");
    const Vec2 first = fronts.front(), last = fronts.back();
    for (Vec2& front : fronts)
        front.y -= std::lerp(first.y, last.y, (front.x - first.x) / (last.x - first.x));
    const size_t top = size_t(std::max_element(fronts.begin(), fronts.end(),
                                               [](const Vec2& a, const Vec2& b) { return a.y < b.y; }) -
                              fronts.begin());
    if (top == 0 || top + 1 == fronts.size()) return std::nanf("");
    // The parabola through it and its neighbours.
    const float below = fronts[top - 1].y, above = fronts[top + 1].y,
                bend = below - 2.0f * fronts[top].y + above;
    return bend < 0.0f ? fronts[top].x + 0.5f * kStep * (below - above) / bend : fronts[top].x;
}

}  // namespace vfit
