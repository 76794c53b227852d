#include "scan/section_girths.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/section.h"

namespace vfit {

namespace {

constexpr int kWindow = 4;  // levels to either side from which the front's place is taken
constexpr float kQuarters[] = {0.0f, 0.25f, 0.5f, 0.75f};
// From the side the arms hide the outline above this level: of the way from the hip joints to the neck's.
constexpr float kArmsFrom = 0.45f;
constexpr float kMetres = 0.01f;  // of the features' centimetres

float median(std::vector<float>& values) {
    if (values.empty()) return std::nanf("");
    std::sort(values.begin(), values.end());
    const size_t n = values.size();
    return 0.5f * (values[(n - 1) / 2] + values[n / 2]);
}

/// The trunk's section at a level: half of it, as a person is nearly the same on both sides.
class SectionSeen {
public:
    explicit SectionSeen(const ScanFeatures& features) : features_(features) {}

    /// Of the section's convex hull, centimetres; NaN where an outline is not seen.
    float girth(int level) const {
        const float breadth = front(level, TrunkProfile::kAhead), behind = side(level, TrunkProfile::kBehind),
                    ahead = front(level, TrunkProfile::kTowards) + front_place(level);
        if (!(breadth > 0.0f && behind > 0.0f && ahead > 0.0f)) return std::nanf("");
        const Falls face = falls(level, &SectionSeen::front, TrunkProfile::kAhead, ahead);
        Falls flank = falls(level, &SectionSeen::side, TrunkProfile::kAhead, breadth),
              rear_flank = falls(level, &SectionSeen::side, TrunkProfile::kBehind, breadth);
        const float nearest = *std::min_element(face.begin(), face.end());
        const float widest = std::min(*std::min_element(flank.begin(), flank.end()),
                                      *std::min_element(rear_flank.begin(), rear_flank.end()));
        std::vector<Vec2> outline = {{0.0f, -behind}};
        for (size_t q = 0; q < std::size(kQuarters); ++q) {
            const float share = kQuarters[q], round = std::sqrt(1.0f - share * share);
            const auto inside = [](float fall, float least, float reach) {
                return reach - std::clamp(fall - least, 0.0f, reach);
            };
            outline.emplace_back(share * breadth, inside(face[q], nearest, ahead));
            outline.emplace_back(inside(flank[q], widest, breadth), share * ahead);
            outline.emplace_back(inside(rear_flank[q], widest, breadth), -share * behind);
            // No view shows the middle of the back.
            outline.emplace_back(share * breadth, -round * behind);
        }
        for (size_t i = outline.size(); i-- > 0;) outline.emplace_back(-outline[i].x, outline[i].y);
        return hull_perimeter(outline);
    }

private:
    using Falls = std::array<float, std::size(kQuarters)>;

    float front(int level, size_t reach) const {
        return features_[kFrontReaches + size_t(level) * TrunkProfile::kReachesFromFront + reach];
    }
    float side(int level, size_t reach) const {
        return features_[kSideReaches + size_t(level) * TrunkProfile::kReaches + reach];
    }
    /// How much farther ahead the outline from the side is than the surface from the front, which is
    /// placed by the fitted body alone. Arms before the trunk hide the outline at some levels.
    float front_place(int level) const {
        std::vector<float> apart;
        for (int l = std::max(0, level - kWindow); l <= std::min(TrunkProfile::kLevels - 1, level + kWindow);
             ++l) {
            const float one = side(l, TrunkProfile::kAhead) - front(l, TrunkProfile::kTowards);
            if (!std::isnan(one)) apart.push_back(one);
        }
        return median(apart);
    }
    /// How far the surface falls back from its middle on the way to the outline; as an ellipse's does where
    /// that is not seen.
    Falls falls(int level, float (SectionSeen::*reach)(int, size_t) const, size_t outline,
                float depth) const {
        const float middle = (this->*reach)(level, TrunkProfile::kTowards);
        Falls out{};
        for (size_t q = 1; q < out.size(); ++q) {
            out[q] = middle - (this->*reach)(level, outline + q);
            if (std::isnan(out[q])) out[q] = depth * (1.0f - std::sqrt(1.0f - kQuarters[q] * kQuarters[q]));
        }
        return out;
    }

    const ScanFeatures& features_;
};

}  // namespace

SectionGirths section_girths(const ScanFeatures& features) {
    const SectionSeen section(features);
    SectionGirths out;
    for (int level = 0; level < TrunkProfile::kLevels; ++level)
        out[size_t(level)] =
            TrunkProfile::along(level) < kArmsFrom ? kMetres * section.girth(level) : std::nanf("");
    return out;
}

}  // namespace vfit
