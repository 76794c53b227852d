#include "scan/body_scan.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/wipe.h"

namespace vfit {

namespace {

constexpr float kCrownHalfWidth_m =
    0.02f;                             // columns about the head's middle: the crown is all but level there
constexpr float kHeadReach_m = 0.30f;  // from the head's middle up to the highest crown, hair included
constexpr int kFewestColumns = 3;
// Above a head: longer without a reading than any sensor's outline is, and a background beyond.
constexpr float kHidden_m = 0.02f, kHairReach_m = 0.15f;
constexpr int kHidden_px = 3;
constexpr uint32_t kViewsOfWay = 3;  // of a turn; more tell nothing new

}  // namespace

BodyScan::BodyScan(std::shared_ptr<const FitModel> model)
    : model_(std::move(model)), fit_(model_), residuals_(*model_) {}

void BodyScan::reset() {
    fit_.reset();
    residuals_.reset();
    profile_.reset();
    for (TrunkView& view : turn_) wipe(view);
    turn_.clear();
    ring_.reset();
    outline_loss_.reset();
    wipe(sums_);
}

bool BodyScan::run_fit(const DepthImage& image, const Body& body) {
    BodyFitInput input;
    input.image = image;
    input.user = uint8_t(body.id);
    input.time_ns = body.time_ns;
    for (int j = 0; j < kJointCount; ++j)
        if (body.has(j)) input.joints[size_t(j)] = {body.at(j), body.joints[size_t(j)].confidence};
    return fit_.run(input).state == BodyFitState::kGood;
}

std::optional<float> BodyScan::fit_turning(const DepthImage& image, const Body& body) {
    if (!run_fit(image, body)) return std::nullopt;
    return facing(image.camera);
}

float BodyScan::facing(const Camera& camera) const {
    return facing_rad(camera, fit_.body().bone_turns()[VFIT_BONE_HIPS] * Vec3(0, 0, 1));
}

float BodyScan::pixel_m(const Camera& camera) const {
    return fit().pose.hips.z / std::sqrt(camera.fx * camera.fy);
}

float BodyScan::outline_loss_m() const {
    return sums_.frames ? outline_loss_px() * float(sums_.pixel_m / sums_.frames) : 0.0f;
}

float BodyScan::unseen_crown_m() const {
    if (sums_.crowns == 0) return 0.0f;
    const float unseen = float(sums_.gap_m / sums_.crowns) - 2.0f * outline_loss_m(),
                pixel_m = float(sums_.pixel_m / sums_.frames);
    return unseen > pixel_m ? unseen : 0.0f;
}

void BodyScan::keep_turning(const DepthImage& image, const Body& body) {
    turn_.reserve(size_t(TurnRing::kWays) * kViewsOfWay);
    const int way = TurnRing::way_of(facing(image.camera));
    if (ring_.frames(way) >= kViewsOfWay) return;
    ring_.add(way);
    turn_.emplace_back();
    look_at_trunk(image, uint8_t(body.id), fit_, turn_.back());
    // Of this camera, where it sees a background.
    OutlineLoss loss;
    loss.add(image, uint8_t(body.id));
    turn_.back().outline_loss_m = (loss.seen() ? loss.pixels() : outline_loss_px()) * pixel_m(image.camera);
}

ViewKind BodyScan::add(const DepthImage& image, const Body& body) {
    if (!run_fit(image, body)) return ViewKind::kOther;
    const auto user = uint8_t(body.id);
    const float faces = facing(image.camera);
    const ViewKind view = view_kind_of(faces);
    if (view == ViewKind::kOther) return view;
    residuals_.add(image, user, fit_);
    profile_.add(image, user, fit_, view);
    outline_loss_.add(image, user);
    ++sums_.frames;
    sums_.distance_m += double(fit().pose.hips.z);
    const double turned = double(std::abs(faces)) - (view == ViewKind::kSide ? 0.5 * double(kPi) : 0.0);
    sums_.turned_rad[size_t(view)] += turned;
    sums_.turned_squared[size_t(view)] += turned * turned;
    sums_.pixel_m += double(pixel_m(image.camera));
    if (const Top top = top_of_head(image, user); top.hidden) {
        sums_.bound_m += double(top.height_m);
        ++sums_.bounds;
    } else if (top.height_m > 0.0f) {
        sums_.crown_m += double(top.height_m), sums_.gap_m += double(top.gap_m);
        ++sums_.crowns;
    }
    return view;
}

/// Mean over a few columns, as single outline pixels are off to either side.
BodyScan::Top BodyScan::top_of_head(const DepthImage& image, uint8_t user) const {
    const Vec3 head = fit_.body().joints()[VFIT_JOINT_HEAD];
    if (head.z <= 0.1f) return {};
    const Camera& camera = image.camera;
    const Vec3& up = camera.floor_normal;
    const Vec2 at = camera.project(head), above = camera.project(head + kHeadReach_m * up);
    // Along the image's axis that the head points up by: portrait cameras lie on their side.
    const Vec2 way = above - at;
    const float length =
        std::min(glm::length(way), float(image.width() + image.height()));  // whatever the lens
    if (!(length >= 4.0f)) return {};
    const Vec2 step = glm::normalize(way), aside(-step.y, step.x);
    const int half =
        std::clamp(int(std::lround(kCrownHalfWidth_m * camera.fx / head.z)), 1, int(image.width()));
    // Of the image; nothing beyond its border.
    const auto pixel = [&](const Vec2& p) -> std::optional<size_t> {
        const int x = int(std::lround(p.x)), y = int(std::lround(p.y));
        if (x < 0 || y < 0 || x >= int(image.width()) || y >= int(image.height())) return std::nullopt;
        return image.index(uint32_t(x), uint32_t(y));
    };
    const auto belongs = [&](const Vec2& p) {
        const auto at_p = pixel(p);
        return at_p && image.users[*at_p] == user;
    };
    const float pixel_m = kHeadReach_m / length;
    // Pixels without a reading between that one of a column and the background; 0: nothing is behind.
    const auto gap_above = [&](const Vec2& column, float last) {
        for (int gap = 0; float(gap) * pixel_m < kHairReach_m; ++gap) {
            const auto at_p = pixel(column + (last + 1.0f + float(gap)) * step);
            if (!at_p) return 0;
            if (image.depth[*at_p] != 0) return gap;
        }
        return 0;
    };
    float sum = 0.0f, gaps_m = 0.0f;
    int columns = 0, hidden = 0;
    for (int c = -half; c <= half; ++c) {
        float last = -1.0f;
        for (float i = 0.0f; i < length; i += 1.0f)
            if (belongs(at + float(c) * aside + i * step)) last = i;
        const Vec2 top = at + float(c) * aside + (last + 0.5f) * step;
        // At the image's border the head may be cut.
        const bool inside = top.x > 1.0f && top.y > 1.0f && top.x < float(image.width()) - 2.0f &&
                            top.y < float(image.height()) - 2.0f;
        if (last < 0.0f || !inside) continue;
        const Vec3 p = camera.unproject(top.x, top.y, head.z);
        sum += glm::dot(up, p) + camera.floor_distance_m;
        ++columns;
        const int gap = gap_above(at + float(c) * aside, last);
        gaps_m += float(gap) * pixel_m;
        hidden += gap >= kHidden_px && float(gap) * pixel_m > kHidden_m;
    }
    if (columns < kFewestColumns) return {};
    return {sum / float(columns), gaps_m / float(columns), 2 * hidden > columns};
}

ScanFeatures BodyScan::features(bool side) const {
    if (sums_.frames == 0) fail(VFIT_ERROR_STATE, "the scan has kept no frame yet");
    constexpr float kCentimetres = 100.0f, kMillimetres = 1000.0f;
    ScanFeatures out{};
    size_t n = 0;
    for (const float value : shape()) out[n++] = value;
    const float unseen = std::nanf("");
    // Anywhere in what is unseen, as likely at its end as at its start.
    out[n++] = sums_.crowns && !crown_is_hidden()
                   ? float(sums_.crown_m / sums_.crowns) + 0.5f * unseen_crown_m()
                   : unseen;
    out[n++] = float(sums_.distance_m / sums_.frames);
    out[n++] = kMillimetres * float(sums_.pixel_m / sums_.frames);
    const auto counts = [&](ViewKind view) { return side || view != ViewKind::kSide; };
    const auto mean_of = [&](const auto& turned, ViewKind view) {
        const uint32_t frames = residuals_.frames(view);
        return counts(view) && frames ? float(turned[size_t(view)] / frames) : unseen;
    };
    out[n++] = mean_of(sums_.turned_squared, ViewKind::kFront);
    out[n++] = mean_of(sums_.turned_rad, ViewKind::kSide);
    out[n++] = mean_of(sums_.turned_squared, ViewKind::kSide);
    constexpr ViewKind kViews[] = {ViewKind::kFront, ViewKind::kSide};
    // Outlines lie as much farther out as the sensor loses of them.
    const float lost = outline_loss_m();
    for (const ViewKind view : kViews)
        for (const Seen seen : {Seen::kFacing, Seen::kRim})
            for (const float mean : residuals_.means_m(view, seen, shape()))
                out[n++] = counts(view) ? kCentimetres * (mean + (seen == Seen::kRim ? lost : 0.0f)) : unseen;
    for (const ViewKind view : kViews)
        for (int level = 0; level < TrunkProfile::kLevels; ++level) {
            const TrunkProfile::Reaches reaches = profile_.reaches_m(view, level);
            const size_t told = view == ViewKind::kFront ? TrunkProfile::kReachesFromFront : reaches.size();
            for (size_t r = 0; r < told; ++r) {
                const bool outline = r == TrunkProfile::kAhead || r == TrunkProfile::kBehind;
                out[n++] = counts(view) ? kCentimetres * (reaches[r] + (outline ? lost : 0.0f)) : unseen;
            }
        }
    for (const ViewKind view : kViews)
        for (int region = 0; region < SurfaceResiduals::kRegions; ++region)
            out[n++] = counts(view) ? kCentimetres * residuals_.roughness_m(view, region, shape()) : unseen;
    return out;
}

}  // namespace vfit
