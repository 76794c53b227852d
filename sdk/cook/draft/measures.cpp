#include "cook/draft/measures.h"

#include <algorithm>
#include <cmath>

#include "anthropometry/tape_landmarks.h"
#include "avatar/avatar_measures.h"
#include "core/error.h"

namespace vfit {

namespace {

/// How much a measure grows with one centimetre of a girth, in centimetres. Engineering values, rounded from
/// the steps of the women's and men's size tables that drafting books grade by (4 cm of chest a size);
/// lengths down the body grow far less, as the letters of EN 13402 imply no stature.
struct GradeRule {
    float DraftMeasures::* measure;
    float per_chest, per_waist, per_hip;
};
constexpr GradeRule kGradeRules[] = {
    {&DraftMeasures::neck, 0.25f, 0.0f, 0.0f},  // 1 cm a size
    {&DraftMeasures::shoulder_half_m, 0.11f, 0.0f,
     0.0f},                                          // with the neckline's 2 mm: shoulder seam 2.4 mm a size
    {&DraftMeasures::upper_arm, 0.33f, 0.0f, 0.0f},  // 1.3 cm a size
    {&DraftMeasures::elbow, 0.2f, 0.0f, 0.0f},
    {&DraftMeasures::wrist, 0.12f, 0.0f, 0.0f},  // 0.5 cm a size
    {&DraftMeasures::thigh, 0.0f, 0.0f, 0.55f},  // 2.2 cm a size
    {&DraftMeasures::knee, 0.0f, 0.0f, 0.3f},
    {&DraftMeasures::ankle, 0.0f, 0.0f, 0.15f},
    {&DraftMeasures::front_length, 0.08f, 0.0f, 0.0f},  // 3 mm a size, over the fuller chest
    {&DraftMeasures::back_length, 0.05f, 0.0f, 0.0f},   // 2 mm a size
    {&DraftMeasures::bust_length, 0.1f, 0.0f, 0.0f},    // 4 mm a size
    {&DraftMeasures::bust_half_m, 0.1f, 0.0f, 0.0f},    // 8 mm from point to point a size
    {&DraftMeasures::arm_length, 0.04f, 0.0f, 0.0f},
    {&DraftMeasures::armpit_above_waist, -0.06f, 0.0f, 0.0f},  // the armhole deepens by 4 mm a size
    {&DraftMeasures::crotch_below_waist, 0.0f, 0.0f, 0.1f},    // 4 mm a size
};
/// Hips where the chart has none (men): a mean of how chest and waist grow, so that short and stout rows both
/// stay in shape.
constexpr float kHipPerChest = 0.45f, kHipPerWaist = 0.45f;

/// The natural neckline's half width: a fifth of the neck's girth and 2 mm, as flat drafts take it.
constexpr float kNeckWidthShare = 0.2f, kNeckWidth_m = 0.002f;

constexpr size_t kWaistToHipSteps = 16;

/// The default body as it stands for a tape measure, and at rest.
class DefaultBody {
public:
    DefaultBody(const BodyModel& model, vfit_sex sex) {
        AvatarDesc desc;
        desc.sex = sex;
        // The caller keeps the model for as long as this.
        const Avatar avatar(std::shared_ptr<const BodyModel>(std::shared_ptr<void>(), &model), desc, {},
                            Vec2(1.0f));
        mesh_ = avatar.measuring_mesh({}, &tape_.joints);
        const BodyTopology& topology = model.topology(0);
        tape_.positions = mesh_.positions;
        tape_.indices = topology.indices;
        tape_.parts = topology.parts;
        tape_.sex = sex;
        measures_ = measure_avatar(avatar, sex);

        EvaluatedBody rest;
        model.evaluate(model.default_shape(sex), rest);
        const auto height = [&](int bone) { return rest.bone_heads[size_t(model.rig_bone(bone))].y; };
        rest_knee_ = height(VFIT_BONE_LEFT_LOWER_LEG);
        rest_ankle_ = height(VFIT_BONE_LEFT_FOOT);
        // The trunk does not bend between the two postures.
        rest_lower_ = tape_.joints.at(VFIT_JOINT_NECK).y - height(VFIT_BONE_NECK);
    }
    DefaultBody(const DefaultBody&) = delete;
    DefaultBody& operator=(const DefaultBody&) = delete;

    const TapeBody& tape() const { return tape_; }
    float taken(const char* key) const { return find(measures_, key)->value; }
    float rest_knee() const { return rest_knee_; }
    float rest_ankle() const { return rest_ankle_; }
    /// What the trunk stands lower at rest, where the legs are further apart.
    float rest_lower() const { return rest_lower_; }

private:
    Mesh mesh_;
    TapeBody tape_;
    std::vector<Measurement> measures_;
    float rest_knee_ = 0.0f, rest_ankle_ = 0.0f, rest_lower_ = 0.0f;
};

/// Taut girth about a limb at a share of its axis, square to it.
float limb_girth(const TapeBody& body, const Axis& axis, float share) {
    const Section section = cut(body.positions, body.indices, axis.at(share), axis.direction());
    const std::vector<Vec2>* loop = loop_about(section, axis.at(share));
    if (!loop) fail(VFIT_ERROR_DATA, "draft: the body has no section about a limb");
    return hull_perimeter(*loop);
}

/// The trunk cut by the plane x = constant: points (z, y).
std::vector<Vec2> profile_points(const TapeMesh& body, float x) {
    const Section section = body.profile(x);
    std::vector<Vec2> points;
    for (const Vec2& p : section.points()) {
        const Vec3 place = section.lift(p);
        points.emplace_back(place.z, place.y);
    }
    return points;
}

/// The top of the shoulder above x, beside the neck: up from the chest until the skin is passed, where that
/// is highest.
Vec2 shoulder_ridge(const TapeMesh& body, float x) {
    const Section section = body.profile(x);
    const float middle = body.joint(VFIT_JOINT_LEFT_SHOULDER).z,
                inside = body.joint(VFIT_JOINT_LEFT_SHOULDER).y - 0.05f;
    constexpr float kReach_m = 0.06f, kStep_m = 0.005f;  // of the shoulder's thickness about the joint
    Vec2 best(middle, 0.0f);
    for (float z = middle - kReach_m; z <= middle + kReach_m; z += kStep_m) {
        float first = INFINITY;
        for (const auto& loop : section.loops)
            for (size_t i = 0; i < loop.size(); ++i) {
                const Vec3 a = section.lift(loop[i]), b = section.lift(loop[(i + 1) % loop.size()]);
                if ((a.z > z) == (b.z > z)) continue;
                const float y = glm::mix(a.y, b.y, (z - a.z) / (b.z - a.z));
                if (y > inside) first = std::min(first, y);
            }
        if (first < INFINITY && first > best.y) best = {z, first};
    }
    if (best.y == 0.0f) fail(VFIT_ERROR_DATA, "draft: the body has no shoulder beside its neck");
    return best;
}

/// A string pulled taut over the skin from the shoulder's ridge to the waist, in the plane x = constant.
float taut_length(const TapeMesh& body, float x, const Vec2& ridge, float waist, bool front) {
    const float sign = front ? 1.0f : -1.0f;
    Vec2 foot(-INFINITY, waist);
    std::vector<Vec2> side;
    constexpr float kTapeHalf_m = 0.01f;
    for (const Vec2& p : profile_points(body, x)) {
        if (std::abs(p.y - waist) < kTapeHalf_m) foot.x = std::max(foot.x, sign * p.x);
        if (p.y > waist && p.y < ridge.y) side.emplace_back(sign * p.x, p.y);
    }
    const Vec2 top(sign * ridge.x, ridge.y);
    if (!(foot.x > -INFINITY)) fail(VFIT_ERROR_DATA, "draft: the body has no profile at its waist");
    // What lies behind the straight line cannot touch the string.
    std::vector<Vec2> points{top, foot};
    const Vec2 along = top - foot;
    for (const Vec2& p : side)
        if (along.x * (p.y - foot.y) - along.y * (p.x - foot.x) < 0.0f) points.push_back(p);
    return points.size() < 3 ? glm::distance(top, foot) : hull_perimeter(points) - glm::distance(top, foot);
}

}  // namespace

float DraftMeasures::side_of_neck_m() const { return kNeckWidthShare * neck + kNeckWidth_m; }

float DraftMeasures::girth_between(float share) const {
    const float at = std::clamp(share, 0.0f, 1.0f) * float(waist_to_hip.size() - 1);
    const size_t i = std::min(size_t(at), waist_to_hip.size() - 2);
    return glm::mix(waist, hip, glm::mix(waist_to_hip[i], waist_to_hip[i + 1], at - float(i)));
}

float DraftMeasures::level(BodyLevel level) const {
    switch (level) {
        case BodyLevel::waist: return waist_height;
        case BodyLevel::hip: return hip_height;
        case BodyLevel::knee: return knee_height;
        case BodyLevel::ankle: return ankle_height;
    }
    return 0.0f;
}

float DraftMeasures::hip_depth() const {
    return std::hypot(waist_height - hip_height, (hip - waist) / (2.0f * kPi));
}

float DraftMeasures::depth(const LevelShare& place) const {
    return waist_height - glm::mix(level(place.from), level(place.to), place.share);
}

DraftMeasures measure_default_body(const BodyModel& model, vfit_sex sex) {
    const DefaultBody standing(model, sex);
    const TapeMesh body(standing.tape());
    DraftMeasures m;
    m.chest = standing.taken("chest_girth_m");
    m.waist = standing.taken("waist_girth_m");
    m.hip = standing.taken("hip_girth_m");
    m.neck = standing.taken("neck_girth_m");
    m.upper_arm = standing.taken("upper_arm_girth_m");
    m.thigh = standing.taken("thigh_girth_m");
    m.arm_length = standing.taken("arm_length_m");
    const Axis forearm{body.joint(VFIT_JOINT_LEFT_ELBOW), body.joint(VFIT_JOINT_LEFT_WRIST)};
    const Axis shank{body.joint(VFIT_JOINT_LEFT_KNEE), body.joint(VFIT_JOINT_LEFT_FOOT)};
    // Where each is: just below the elbow's bend, at the wrist bone, across the knee, above the ankle bones.
    m.elbow = limb_girth(standing.tape(), forearm, 0.1f);
    m.wrist = limb_girth(standing.tape(), forearm, 0.97f);
    m.knee = limb_girth(standing.tape(), shank, 0.0f);
    m.ankle = limb_girth(standing.tape(), shank, 0.95f);

    const float armpit = armpit_height(body), crotch = crotch_height(body), waist = waist_height(body);
    const float hip = hip_height(body, crotch, waist);
    m.waist_height = waist - standing.rest_lower();
    m.hip_height = hip - standing.rest_lower();
    m.knee_height = standing.rest_knee();
    m.ankle_height = standing.rest_ankle();
    m.armpit_above_waist = armpit - waist;
    m.crotch_below_waist = waist - crotch;
    for (size_t i = 0; i <= kWaistToHipSteps; ++i) {
        const float y = glm::mix(waist, hip, float(i) / float(kWaistToHipSteps));
        m.waist_to_hip.push_back((hull_perimeter(body.trunk(y).points()) - m.waist) / (m.hip - m.waist));
    }

    const float x = m.side_of_neck_m();
    const Vec2 ridge = shoulder_ridge(body, x);
    m.front_length = taut_length(body, x, ridge, waist, true);
    m.back_length = taut_length(body, x, ridge, waist, false);
    const Vec3 tip = acromion(standing.tape(), Side::kLeft);
    m.shoulder_half_m = tip.x;
    m.shoulder_above_waist = tip.y - waist;
    m.shoulder_slope_rad = std::atan2(ridge.y - tip.y, tip.x - x);
    const Vec3 bust = bust_point(body, Side::kLeft, armpit);
    m.bust_half_m = bust.x;
    m.bust_above_waist = bust.y - waist;
    m.bust_length = glm::distance(Vec2(ridge.x, ridge.y), Vec2(bust.z, bust.y));
    return m;
}

DraftMeasures graded(const DraftMeasures& body, const std::vector<Measurement>& girths) {
    const auto wanted = [&](const char* key, float otherwise) {
        const Measurement* m = find(girths, key);
        return m ? m->value : otherwise;
    };
    DraftMeasures m = body;
    m.chest = wanted("chest_girth_m", body.chest);
    m.waist = wanted("waist_girth_m", body.waist);
    const float chest = m.chest - body.chest, waist = m.waist - body.waist;
    m.hip = wanted("hip_girth_m", body.hip + kHipPerChest * chest + kHipPerWaist * waist);
    const float hip = m.hip - body.hip;
    for (const GradeRule& rule : kGradeRules)
        m.*rule.measure += rule.per_chest * chest + rule.per_waist * waist + rule.per_hip * hip;
    return m;
}

}  // namespace vfit
