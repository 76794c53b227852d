#include "cook/draft/dress_form.h"

#include <algorithm>
#include <cmath>

#include "geometry/section.h"

namespace vfit {

namespace {

constexpr float kBeforeSkin_m = 0.025f;  // between skin and a piece that is held before it
constexpr float kAround_m = 0.03f;       // the body so far to the left and right of a piece counts too
// Of the sleeve's cap beyond the armhole, and of a wide sleeve more, that its corner below the arm does not
// cross the trunk's pieces.
constexpr float kSleeveGap_m = 0.05f, kSleeveGapPerWidth = 0.7f, kNarrowSleeve_m = 0.2f;
constexpr float kBesideMiddle_m = 0.01f;  // of a leg's fork, that left and right do not cross
constexpr uint32_t kEdgePoints = 6;

/// Half a turn about the upright axis: a back piece shows its outside to -Z.
const Quat kTurnedBack(0, 0, 1, 0);

CutLine seen_from(const CutLine& line, PieceSide side) {
    return side == PieceSide::back ? line.mirrored() : line;
}

}  // namespace

DressForm::DressForm(const BodyModel& model, vfit_sex sex) {
    model.evaluate(model.default_shape(sex), body_);
    const auto head = [&](int bone) { return body_.bone_heads[size_t(model.rig_bone(bone))]; };
    shoulder_ = head(VFIT_BONE_LEFT_UPPER_ARM);
    wrist_ = head(VFIT_BONE_LEFT_HAND);
    hip_ = head(VFIT_BONE_LEFT_UPPER_LEG);
    ankle_ = head(VFIT_BONE_LEFT_FOOT);
}

Panel DressForm::upright(const CutLine& line, std::string name, PieceSide side, const Vec2& at,
                         float turned_rad, float leaning_rad) const {
    Panel panel = seen_from(line, side).panel(std::move(name));
    const bool back = side == PieceSide::back;
    // Turning outwards and leaning are told as the person's left sees them from before; a back piece is
    // turned round first.
    panel.rotation = glm::angleAxis(back ? -turned_rad : turned_rad, Vec3(0, 1, 0)) *
                     glm::angleAxis(leaning_rad, Vec3(0, 0, 1)) * (back ? kTurnedBack : Quat(1, 0, 0, 0));
    panel.translation = Vec3(at, 0.0f);
    clear_of_body(panel, Vec3(0, 0, back ? -1 : 1));
    return panel;
}

Panel DressForm::along_left_leg(const CutLine& line, std::string name, PieceSide side, float height) const {
    const Panel flat = line.panel(name);
    Vec2 fork(0.0f), hem(0.0f);
    for (const PatternEdge& edge : flat.edges) {
        if (edge.label.ends_with("inseam thigh")) fork = flat.corners[edge.from];
        if (edge.label.ends_with("hem")) hem = 0.5f * (flat.corners[edge.from] + flat.corners[edge.to]);
    }
    // Turned about the fork until the hem's middle is before the leg: else the seams would meet beside it.
    const Vec2 down = hem - fork;
    const float y = height + hem.y, leg_x = glm::mix(hip_.x, ankle_.x, (hip_.y - y) / (hip_.y - ankle_.y));
    const float aside = std::clamp((leg_x - kBesideMiddle_m) / glm::length(down), -0.5f, 0.5f);
    const float lean = std::asin(aside) - std::atan2(down.x, -down.y);
    const float x = kBesideMiddle_m - (fork.x * std::cos(lean) - fork.y * std::sin(lean));
    return upright(line, std::move(name), side, {x, height}, 0.0f, lean);
}

Panel DressForm::along_left_arm(const CutLine& line, std::string name, PieceSide side, float cap_height_m,
                                float length_m, float width_m, float hem_m) const {
    Panel panel = seen_from(line, side).panel(std::move(name));
    const float out = side == PieceSide::back ? -1.0f : 1.0f;
    const Vec3 up = glm::normalize(shoulder_ - wrist_);  // along the arm, from the hand
    const Vec3 ahead = glm::normalize(Vec3(0, 0, 1) - up.z * up);
    const Vec3 outside = out * ahead;
    // The piece's own middle line runs along the arm.
    const Vec2 hem_middle(-0.5f * out * hem_m, -length_m), wide_middle(-0.5f * out * width_m, 0.0f);
    const Vec2 middle = glm::normalize(wide_middle - hem_middle);
    const Quat along = glm::quat_cast(Mat3(glm::cross(up, outside), up, outside));
    panel.rotation = along * glm::angleAxis(std::atan2(middle.x, middle.y), Vec3(0, 0, 1));
    const Vec2 top = wide_middle + middle * cap_height_m;
    const float gap = kSleeveGap_m + kSleeveGapPerWidth * std::max(0.0f, width_m - kNarrowSleeve_m);
    panel.translation = shoulder_ - gap * up - panel.rotation * Vec3(top, 0.0f);
    clear_of_body(panel, outside);
    return panel;
}

void DressForm::clear_of_body(Panel& panel, const Vec3& direction) const {
    std::vector<Vec2> outline;
    for (const PatternEdge& edge : panel.edges) {
        const std::vector<Vec2> points = sample_edge(panel, edge, kEdgePoints);
        outline.insert(outline.end(), points.begin(), points.end() - 1);
    }
    // Grown a little sideways; not downwards, where the feet stand out before a trouser's hem.
    const Extent box = extent(outline);
    const Vec2 middle = 0.5f * (box.minimum + box.maximum), half = 0.5f * (box.maximum - box.minimum);
    for (Vec2& p : outline) p.x = middle.x + (p.x - middle.x) * ((half.x + kAround_m) / half.x);

    const Vec3 normal = panel.rotation * Vec3(0, 0, 1);
    const Quat to_panel = glm::conjugate(panel.rotation);
    /// How far the body behind the panel reaches before it.
    const auto reach = [&] {
        float most = -INFINITY;
        for (const Vec3& p : body_.positions) {
            const Vec3 q = to_panel * (p - panel.translation);
            if (q.z <= most || std::abs(q.x - middle.x) > half.x + kAround_m ||
                std::abs(q.y - middle.y) > half.y)
                continue;
            if (encloses(outline, Vec2(q))) most = q.z;
        }
        return most;
    };
    const float straight = glm::dot(normal, direction);
    if (straight > 0.999f) {
        if (const float most = reach(); most > -INFINITY)
            panel.translation += direction * (most + kBeforeSkin_m);
        return;
    }
    // What lies behind a turned piece changes as it moves: it comes from afar until it would touch.
    constexpr float kAfar_m = 0.6f, kStep_m = 0.01f;
    const Vec3 place = panel.translation;
    for (float away = kAfar_m; away > 0.0f; away -= kStep_m) {
        panel.translation = place + direction * (away - kStep_m);
        if (reach() <= -kBeforeSkin_m) continue;
        panel.translation = place + direction * away;
        return;
    }
}

Panel right_of(const Panel& left, std::string name) {
    Panel out;
    out.name = std::move(name);
    out.material = left.material;
    // Gone round backwards: edge i of the right one is edge n - 1 - i of the left one.
    const uint32_t n = uint32_t(left.edges.size());
    const auto reflected = [](const Vec2& p) { return Vec2(-p.x, p.y); };
    for (uint32_t i = 0; i < n; ++i) {
        const PatternEdge& from = left.edges[n - 1 - i];
        PatternEdge edge = from;
        edge.from = i;
        edge.to = (i + 1) % n;
        if (edge.curve == PatternEdge::Curve::cubic) std::swap(edge.control[0], edge.control[1]);
        for (Vec2& control : edge.control) control = reflected(control);
        if (edge.label.starts_with("left ")) edge.label.replace(0, 4, "right");
        out.corners.push_back(reflected(left.corners[from.to]));
        out.edges.push_back(std::move(edge));
    }
    const Quat& q = left.rotation;
    out.rotation = Quat(q.w, q.x, -q.y, -q.z);
    out.translation = {-left.translation.x, left.translation.y, left.translation.z};
    return out;
}

}  // namespace vfit
