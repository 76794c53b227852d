// Crown, floor and the head: the lines that the silhouette shows along the up axis.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "paper/body_lines.h"
#include "paper/silhouette.h"

namespace vfit {

namespace {

// Half of the mean head length of ANSUR II (200 mm men, 190 mm women): from the face to the axis of the head,
// and the radius of the skull below the crown.
constexpr float kHalfHeadLength_m = 0.097f;
// Lateral malleolus height over stature, ANSUR II: 0.0415 men, 0.0385 women.
constexpr float kAnkleHeight_stature = 0.040f;
// Head height over stature: Drillis and Contini 1966.
constexpr float kHeadHeight_stature = 0.130f;

constexpr float kCrownSigma_m = 0.005f;       // mixed pixels, shape of the skull
constexpr float kGivenFloorSigma_m = 0.005f;  // calibration of the plane
constexpr float kSoleSigma_m = 0.012f;        // user maps end up to a few pixels above the sole

/// Metres that one pixel covers at that depth.
float footprint(const Camera& camera, float z) { return z / std::min(camera.fx, camera.fy); }

/// Step from low to high that misses no pixel, yet ends soon where a pixel covers next to nothing (a joint
/// right before the lens) or a wrong floor makes the way long.
float step_over(float low, float high, float pixel_m) {
    constexpr float kMostSteps = 256.0f;  // a foot's length at 0.8 m is 160 pixels of an Azure Kinect
    return std::max(pixel_m, (high - low) / kMostSteps);
}

/// A quantity that is rounded to pixels (uniform error).
float quantisation(float footprint_m) { return footprint_m / std::sqrt(12.0f); }

float hypotenuse(float a, float b, float c = 0.0f) { return std::sqrt(a * a + b * b + c * c); }

struct HeadAxis {
    bool known = false;
    Vec3 centre{0.0f};  // the head joint, moved to the middle of the skull in depth
};

/// The face's reading places the head better in depth than the joints of most trackers do.
HeadAxis head_axis(const FilteredDepth& depth, const Camera& camera, const Body& body) {
    HeadAxis axis;
    if (!body.has(VFIT_JOINT_HEAD) || !(body.at(VFIT_JOINT_HEAD).z > 0.0f)) return axis;
    const Vec2 pixel = camera.project(body.at(VFIT_JOINT_HEAD));
    const auto [x, y] = nearest_pixel(pixel);
    if (!depth.inside(x, y)) return axis;
    axis.known = true;
    axis.centre = camera.unproject(pixel.x, pixel.y, depth.at(x, y) + kHalfHeadLength_m);
    return axis;
}

Estimate crown_height(const FilteredDepth& depth, const Camera& camera, const Body& body) {
    const HeadAxis head = head_axis(depth, camera, body);
    if (!head.known) return {};
    const FrontalPlane plane(camera, head.centre);
    const float pixel_m = footprint(camera, head.centre.z);

    // The middle of the vertex: further out the skull falls away. Its higher half of columns, so that neither
    // a head joint beside the middle nor single noisy pixels above the crown decide.
    constexpr float kHalfVertex_m = 0.04f;
    constexpr size_t kMostColumns = 64;
    std::array<FrontalPlane::Reach, kMostColumns> columns;
    size_t count = 0;
    const float step_m = std::max(pixel_m, 2.0f * kHalfVertex_m / float(kMostColumns - 1));
    for (float offset = -kHalfVertex_m; offset <= kHalfVertex_m && count < kMostColumns; offset += step_m) {
        const auto reach = plane.reach(depth, head.centre + plane.right() * offset, plane.up());
        if (reach.seen()) columns[count++] = reach;
    }
    if (count == 0) return {};
    std::sort(columns.begin(), columns.begin() + std::ptrdiff_t(count),
              [&](const auto& a, const auto& b) { return plane.height(a.point) > plane.height(b.point); });
    const size_t kept = (count + 1) / 2;
    float height = 0.0f;
    for (size_t i = 0; i < kept; ++i) height += plane.height(columns[i].point) / float(kept);

    // The line of sight that touches a sphere passes its vertical axis above the top by R (1 / cos e - 1).
    const float cosine = std::max(0.5f, std::cos(plane.elevation_rad(columns[0].edge)));
    const float crown = height - kHalfHeadLength_m * (1.0f / cosine - 1.0f);
    return {crown, hypotenuse(kCrownSigma_m, quantisation(pixel_m)), true};
}

/// Lowest point of the contour about one ankle.
float lowest_near(const FilteredDepth& depth, const Camera& camera, const Vec3& ankle) {
    const FrontalPlane plane(camera, ankle);
    const float pixel_m = footprint(camera, ankle.z);
    // Half the length of a foot (0.154 of stature, ANSUR II): the toes may point outwards.
    constexpr float kHalfFoot_m = 0.13f;
    constexpr float kInward_px = 2.5f;  // off the contour, where the filter mixes in the background
    float lowest = std::numeric_limits<float>::max();
    const float step_m = step_over(-kHalfFoot_m, kHalfFoot_m, pixel_m);
    for (float offset = -kHalfFoot_m; offset <= kHalfFoot_m; offset += step_m) {
        const Vec3 from = ankle + plane.right() * offset;
        const auto reach = plane.reach(depth, from, -plane.up());
        if (!reach.seen()) continue;
        const Vec2 start = camera.project(from);
        const Vec2 back = glm::length(start - reach.edge) > kInward_px
                              ? reach.edge + glm::normalize(start - reach.edge) * kInward_px
                              : start;
        const auto [x, y] = nearest_pixel(back);
        if (!depth.inside(x, y)) continue;
        const Vec3 point = camera.unproject(reach.edge.x, reach.edge.y, depth.at(x, y));
        lowest = std::min(lowest, plane.height(point));
    }
    return lowest;
}

Estimate floor_height(const FilteredDepth& depth, const Camera& camera, const Body& body,
                      const Estimate& crown) {
    if (camera.floor_state == VFIT_FLOOR_GIVEN) return {-camera.floor_distance_m, kGivenFloorSigma_m, true};

    constexpr float kUnknown = std::numeric_limits<float>::max();
    float mask = kUnknown, ankle = kUnknown, z = 0.0f;
    for (const int joint : {VFIT_JOINT_LEFT_FOOT, VFIT_JOINT_RIGHT_FOOT}) {
        if (!body.has(joint) || !(body.at(joint).z > 0.0f)) continue;
        z = body.at(joint).z;
        mask = std::min(mask, lowest_near(depth, camera, body.at(joint)));
        if (body.joints[size_t(joint)].state == VFIT_JOINT_MEASURED)
            ankle = std::min(ankle, glm::dot(camera.floor_normal, body.at(joint)));
    }
    if (mask == kUnknown) return {};
    // A user map that was cut above the sole ends too high for the ankle that stands in it.
    float floor = mask;
    if (ankle != kUnknown && crown.known)
        floor =
            std::min(floor, (ankle - kAnkleHeight_stature * crown.value_m) / (1.0f - kAnkleHeight_stature));
    return {floor, hypotenuse(kSoleSigma_m, quantisation(footprint(camera, z))), true};
}

}  // namespace

Upright measure_upright(const FilteredDepth& depth, const Camera& camera, const Body& body) {
    Upright upright;
    upright.crown = crown_height(depth, camera, body);
    upright.floor = floor_height(depth, camera, body, upright.crown);
    return upright;
}

Estimate head_width(const FilteredDepth& depth, const Camera& camera, const Body& body,
                    const Upright& upright) {
    const HeadAxis head = head_axis(depth, camera, body);
    if (!head.known || !upright.crown.known) return {};
    const FrontalPlane plane(camera, head.centre);
    const float pixel_m = footprint(camera, head.centre.z);

    // The skull is broadest above the ears, a third to a half of the head below the crown.
    const float head_m =
        kHeadHeight_stature * (upright.floor.known ? upright.crown.value_m - upright.floor.value_m
                                                   : 1.69f);  // mean of ANSUR II's sexes
    const float highest = head_m / 3.0f, lowest = head_m / 2.0f, step_m = step_over(highest, lowest, pixel_m);
    float sum = 0.0f;
    int rows = 0;
    for (float below = highest; below <= lowest; below += step_m) {
        const Vec3 from =
            head.centre + plane.up() * (upright.crown.value_m - below - plane.height(head.centre));
        const auto left = plane.reach(depth, from, -plane.right());
        const auto right = plane.reach(depth, from, plane.right());
        if (!left.seen() || !right.seen()) continue;
        sum += glm::dot(right.point - left.point, plane.right());
        ++rows;
    }
    if (rows == 0) return {};
    constexpr float kHairSigma_m = 0.008f;
    return {sum / float(rows), hypotenuse(kHairSigma_m, quantisation(pixel_m)), true};
}

// The chin is where, going down the middle of the face, the surface steps back to the throat.
Estimate head_height(const FilteredDepth& depth, const Camera& camera, const Body& body,
                     const Upright& upright) {
    const HeadAxis head = head_axis(depth, camera, body);
    if (!head.known || !upright.crown.known || !upright.floor.known) return {};
    const FrontalPlane plane(camera, head.centre);
    const float typical = kHeadHeight_stature * (upright.crown.value_m - upright.floor.value_m);
    const float pixel_m = footprint(camera, head.centre.z);

    constexpr float kStep_m = 0.03f;      // height over which the chin turns into the throat
    constexpr float kSetBack_m = 0.015f;  // least depth of that step; the noise of a Kinect v1 at 3 m
    const auto surface = [&](float below) {
        const Vec3 p = head.centre + plane.up() * (upright.crown.value_m - below - plane.height(head.centre));
        const Vec2 pixel = camera.project(p);
        const auto [x, y] = nearest_pixel(pixel);
        return depth.inside(x, y) ? depth.at(x, y) : std::numeric_limits<float>::quiet_NaN();
    };
    float deepest = kSetBack_m, chin = 0.0f;
    // Four standard deviations of the head's share about its mean (ANSUR II, menton to sellion: 6 %).
    const float highest = 0.76f * typical, lowest = 1.24f * typical;
    const float step_m = step_over(highest, lowest, 0.5f * pixel_m);
    for (float below = highest; below <= lowest; below += step_m) {
        const float step = surface(below + 0.5f * kStep_m) - surface(below - 0.5f * kStep_m);
        if (step > deepest) {
            deepest = step;
            chin = below;
        }
    }
    if (chin == 0.0f) return {};
    constexpr float kChinSigma_m = 0.012f;  // height of the step, and hair on the crown
    return {chin, hypotenuse(kChinSigma_m, quantisation(pixel_m), upright.crown.sigma_m), true};
}

}  // namespace vfit
