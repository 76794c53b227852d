#include "track/heads.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// Heads are looked for in the outline's upper edge, from a column of 4 cm to the next, over 5 m.
constexpr float kColumn_m = 0.04f;
constexpr float kNothing_m = -1e9f;  // top of an empty column
// On the floor: two people shoulder to shoulder, the one half behind the other.
constexpr float kHeadsApart_m = 0.28f;
constexpr int kLeastApart = 4;       // columns between them in the view
constexpr float kSameTop_m = 0.05f;  // below the peak: the crown, whose middle is the axis
constexpr int kCrownHalf = 3;        // columns
constexpr float kNeck_m = 0.10f;     // that the outline falls between two heads
constexpr float kLowestHead_m = 0.9f;
// The head itself: from below the crown to the chin, to both sides of the axis. A forearm held up is half as
// broad.
constexpr float kFaceFrom_m = 0.05f, kFaceTo_m = 0.20f, kLeastFace_m = 0.12f;
constexpr int kFaceHalf = 2;          // columns
constexpr float kHeadDeep_m = 0.17f;  // from the crown to the face, and less than between two heads
// Shoulders and elbows below the top, and the breadth there to either side of the axis, as shares of the
// height (ANSUR II, with a margin): a raised arm has none outside.
constexpr float kShoulderFrom = 0.18f, kShoulderTo = 0.41f, kShoulder = 0.052f;
constexpr int kBodyHalf = 5;            // columns: 0.2 m to both sides of the axis
constexpr float kSlice_m = 0.10f;       // a body is looked for below the head slice by slice
constexpr float kLeastSlice_m = 0.07f;  // breadth: a shin
constexpr float kLeastTrunk_m = 0.55f;  // of slices in a row below the head

}  // namespace

int HeadFinder::column(float x) const { return int(std::floor((x - left_m_) / kColumn_m)); }

// Upper edge of the outline, and what is seen in each slice of each column.
void HeadFinder::project(std::span<const Vec4> points) {
    left_m_ = points[points.size() / 2].x - 0.5f * kColumns * kColumn_m;
    top_.fill(kNothing_m);
    filled_.fill(0.0f);
    lowest_m_ = -kNothing_m;
    for (const Vec4& p : points) {
        const int c = column(p.x);
        if (c < 0 || c >= kColumns) continue;
        if (p.y > top_[size_t(c)]) top_[size_t(c)] = p.y, top_z_[size_t(c)] = p.z;
        lowest_m_ = std::min(lowest_m_, p.y);
        const int slice = int(std::floor(p.y / kSlice_m));
        if (slice >= 0 && slice < kSlices) filled_[size_t(c * kSlices + slice)] += p.w;
    }
}

int HeadFinder::highest_untried() const {
    int best = -1;
    for (int c = 0; c < kColumns; ++c)
        if (!tried_[size_t(c)] && top_[size_t(c)] > kLowestHead_m &&
            (best < 0 || top_[size_t(c)] > top_[size_t(best)]))
            best = c;
    return best;
}

int HeadFinder::middle_of_crown(int peak) const {
    float sum = 0.0f;
    int columns = 0;
    for (int c = std::max(0, peak - kCrownHalf); c <= std::min(kColumns - 1, peak + kCrownHalf); ++c)
        if (top_[size_t(c)] > top_[size_t(peak)] - kSameTop_m) {
            sum += float(c);
            ++columns;
        }
    return int(std::lround(sum / float(columns)));
}

// Where the head is; returns what is seen of its face.
float HeadFinder::look(std::span<const Vec4> points, int axis, Head& head) const {
    head.x_m = left_m_ + (float(axis) + 0.5f) * kColumn_m;
    float sum = 0.0f, area = 0.0f;
    for (const Vec4& p : points) {
        if (p.y < head.top_m - kFaceFrom_m || p.y > head.top_m || std::abs(column(p.x) - axis) > kFaceHalf)
            continue;
        sum += p.w * p.z;
        area += p.w;
    }
    head.z_m = sum / std::max(area, 1e-9f);
    float face = 0.0f;
    for (const Vec4& p : points) {
        const bool high = p.y > head.top_m - kFaceTo_m && p.y < head.top_m - kFaceFrom_m;
        if (high && std::abs(column(p.x) - axis) <= kFaceHalf && std::abs(p.z - head.z_m) < kHeadDeep_m)
            face += p.w;
    }
    return face;
}

// What the outline alone can say of it: the points need not be gone through for every bump of a wall's edge.
bool HeadFinder::may_be_separate(int axis, float top) const {
    for (size_t k = 0; k < count_; ++k) {
        const int a = std::min(axis, axes_[k]), b = std::max(axis, axes_[k]);
        const bool step = std::abs(top_z_[size_t(axis)] - heads_[k].z_m) > 0.5f * kHeadDeep_m;
        if (b - a < kLeastApart || (!step && valley(a, b) > top - kNeck_m)) return false;
    }
    return true;
}

float HeadFinder::valley(int from, int to) const {
    return *std::min_element(top_.begin() + from, top_.begin() + to + 1);
}

// From the heads that were found before, which are higher.
bool HeadFinder::separate(int axis, const Head& head, float face_m2) const {
    for (size_t k = 0; k < count_; ++k) {
        const int a = std::min(axis, axes_[k]), b = std::max(axis, axes_[k]);
        if (b - a < kLeastApart) return false;
        const bool neck =
            valley(a, b)<head.top_m - kNeck_m, step = std::abs(head.z_m - heads_[k].z_m)> kHeadDeep_m;
        if (!neck && !step) return false;
        if (neck && float(b - a) * kColumn_m >= kHeadsApart_m) continue;
        // Close in the view, the one behind the other: there an arm held up is no head.
        if (std::hypot(head.x_m - heads_[k].x_m, head.z_m - heads_[k].z_m) < kHeadsApart_m ||
            face_m2 < kLeastFace_m * (kFaceTo_m - kFaceFrom_m))
            return false;
    }
    return true;
}

bool HeadFinder::has_shoulders(int axis, float top) const {
    const int highest = int(top / kSlice_m);
    const int first = std::max(0, highest - int(std::lround(kShoulderTo * top / kSlice_m)));
    const int last = std::min(kSlices, highest - int(std::lround(kShoulderFrom * top / kSlice_m)));
    float left = 0.0f, right = 0.0f;
    for (int slice = first; slice < last; ++slice)
        for (int k = 1; k <= kBodyHalf; ++k) {
            if (axis - k >= 0) left += filled(axis - k, slice);
            if (axis + k < kColumns) right += filled(axis + k, slice);
        }
    const float least = kShoulder * top * kSlice_m * float(last - first);
    return left >= least && right >= least;
}

bool HeadFinder::has_body(int axis, float top, bool half_seen) const {
    float trunk = 0.0f;
    for (int slice = std::min(int(top / kSlice_m), kSlices) - 1; slice >= 0; --slice) {
        float area = 0.0f;
        for (int c = std::max(0, axis - kBodyHalf); c <= std::min(kColumns - 1, axis + kBodyHalf); ++c)
            area += filled(c, slice);
        if (area < kLeastSlice_m * kSlice_m) break;
        trunk += kSlice_m;
    }
    const float wanted =
        half_seen ? kLeastTrunk_m : std::max(kLeastTrunk_m, 0.75f * (top - std::max(0.0f, lowest_m_)));
    return trunk >= wanted || trunk >= 0.9f * top - 0.3f;
}

std::span<const Head> HeadFinder::run(std::span<const Vec4> points, bool half_seen) {
    count_ = 0;
    if (points.empty()) return {};
    project(points);
    tried_.fill(false);
    while (count_ < kMost) {
        const int peak = highest_untried();
        if (peak < 0) break;
        // What belongs to this peak is not tried again.
        const int near = int(kHeadsApart_m / kColumn_m) / 2;
        for (int c = std::max(0, peak - near); c <= std::min(kColumns - 1, peak + near); ++c)
            tried_[size_t(c)] = true;
        Head head;
        head.top_m = top_[size_t(peak)];
        const int axis = middle_of_crown(peak);
        if (!has_shoulders(axis, head.top_m) || !has_body(axis, head.top_m, half_seen)) continue;
        if (!may_be_separate(axis, head.top_m)) continue;
        const float face_m2 = look(points, axis, head);
        if (!separate(axis, head, face_m2)) continue;
        axes_[count_] = axis;
        heads_[count_++] = head;
    }
    return {heads_.data(), count_};
}

}  // namespace vfit
