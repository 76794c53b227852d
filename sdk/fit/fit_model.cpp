#include "fit/fit_model.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "avatar/rig.h"
#include "body/mesh.h"
#include "body/usual_shape.h"
#include "core/error.h"
#include "fit/fit_surface.h"
#include "fit/principal_components.h"
#include "math/random.h"

namespace vfit {

namespace {

constexpr size_t kSampleBodies = 160;  // for 10 components; more change them little
// Joints and bone lengths in the components' measure, against one vertex each: they are what is wanted.
constexpr double kJointShare = 8.0;
constexpr float kLeastWeight = 0.05f;  // skin weights below are left out

enum Limb { kTrunk, kLeftArm, kRightArm, kLeftLeg, kRightLeg };

constexpr int kTrunkBones[] = {VFIT_BONE_HIPS,           VFIT_BONE_SPINE,
                               VFIT_BONE_CHEST,          VFIT_BONE_UPPER_CHEST,
                               VFIT_BONE_NECK,           VFIT_BONE_HEAD,
                               VFIT_BONE_LEFT_SHOULDER,  VFIT_BONE_LEFT_UPPER_ARM,
                               VFIT_BONE_RIGHT_SHOULDER, VFIT_BONE_RIGHT_UPPER_ARM,
                               VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_RIGHT_UPPER_LEG};
constexpr int kLeftArmBones[] = {VFIT_BONE_HIPS,           VFIT_BONE_SPINE,         VFIT_BONE_CHEST,
                                 VFIT_BONE_UPPER_CHEST,    VFIT_BONE_LEFT_SHOULDER, VFIT_BONE_LEFT_UPPER_ARM,
                                 VFIT_BONE_LEFT_LOWER_ARM, VFIT_BONE_LEFT_HAND};
constexpr int kRightArmBones[] = {
    VFIT_BONE_HIPS,           VFIT_BONE_SPINE,           VFIT_BONE_CHEST,           VFIT_BONE_UPPER_CHEST,
    VFIT_BONE_RIGHT_SHOULDER, VFIT_BONE_RIGHT_UPPER_ARM, VFIT_BONE_RIGHT_LOWER_ARM, VFIT_BONE_RIGHT_HAND};
constexpr int kLeftLegBones[] = {VFIT_BONE_HIPS, VFIT_BONE_LEFT_UPPER_LEG, VFIT_BONE_LEFT_LOWER_LEG,
                                 VFIT_BONE_LEFT_FOOT};
constexpr int kRightLegBones[] = {VFIT_BONE_HIPS, VFIT_BONE_RIGHT_UPPER_LEG, VFIT_BONE_RIGHT_LOWER_LEG,
                                  VFIT_BONE_RIGHT_FOOT};

int limb_of(int bone) {
    switch (bone) {
        case VFIT_BONE_LEFT_UPPER_ARM:
        case VFIT_BONE_LEFT_LOWER_ARM:
        case VFIT_BONE_LEFT_HAND: return kLeftArm;
        case VFIT_BONE_RIGHT_UPPER_ARM:
        case VFIT_BONE_RIGHT_LOWER_ARM:
        case VFIT_BONE_RIGHT_HAND: return kRightArm;
        case VFIT_BONE_LEFT_UPPER_LEG:
        case VFIT_BONE_LEFT_LOWER_LEG:
        case VFIT_BONE_LEFT_FOOT: return kLeftLeg;
        case VFIT_BONE_RIGHT_UPPER_LEG:
        case VFIT_BONE_RIGHT_LOWER_LEG:
        case VFIT_BONE_RIGHT_FOOT: return kRightLeg;
        default: return kTrunk;
    }
}

/// Toes are carried by the foot: depth does not show how they bend.
int without_toes(int bone) {
    return bone == VFIT_BONE_LEFT_TOES || bone == VFIT_BONE_RIGHT_TOES ? bone_parent(bone) : bone;
}

/// The humanoid bone that carries each bone of the model's rig: itself, or its nearest humanoid ancestor.
std::vector<int> humanoid_of_rig(const BodyModel& model) {
    std::vector<int> out;
    for (const RigBone& bone : model.bones())
        out.push_back(bone.bone >= 0    ? without_toes(bone.bone)
                      : bone.parent < 0 ? int(VFIT_BONE_HIPS)
                                        : out[size_t(bone.parent)]);
    return out;
}

int clothing_layer_of(int limb, int bone) {
    if (bone == VFIT_BONE_HEAD || bone == VFIT_BONE_NECK || bone == VFIT_BONE_LEFT_HAND ||
        bone == VFIT_BONE_RIGHT_HAND)
        return -1;
    if (bone == VFIT_BONE_LEFT_FOOT || bone == VFIT_BONE_RIGHT_FOOT) return -1;
    return limb == kTrunk ? 0 : limb == kLeftArm || limb == kRightArm ? 1 : 2;
}

/// Of a bone's vertex with that normal, T-pose.
bool between_legs(int bone, const Vec3& normal) {
    switch (bone) {
        case VFIT_BONE_LEFT_UPPER_LEG: return normal.x < -0.3f || normal.y < -0.5f;
        case VFIT_BONE_RIGHT_UPPER_LEG: return normal.x > 0.3f || normal.y < -0.5f;
        case VFIT_BONE_HIPS: return normal.y < -0.5f;
        default: return false;
    }
}

/// Random grown-ups.
class Bodies {
public:
    std::vector<float> next(const BodyModel& model) {
        std::vector<float> shape = model.default_shape(VFIT_SEX_UNKNOWN);
        const float gender = random_.unit() < 0.5f ? 0.15f * random_.unit() : 1.0f - 0.15f * random_.unit();
        for (size_t i = 0; i < shape.size(); ++i) {
            const ShapeParameter& p = model.parameters()[i];
            const float usual = (1.0f - gender) * p.female + gender * p.male;
            float value = 0.0f;
            if (p.key == "gender")
                value = gender;
            else if (p.key == "age")
                value = 0.4f + 0.45f * random_.unit();
            else if (p.key == "height")
                value = usual + 0.13f * normal();
            else if (p.key == "weight")
                value = usual + 0.25f * normal();
            else if (p.minimum >= 0.0f)
                value = usual + 0.18f * normal();
            else if (p.key.rfind("measure-", 0) == 0)
                value = usual_measure(p.key) + 0.25f * normal();
            shape[i] = std::clamp(value, p.minimum, p.maximum);
        }
        return shape;
    }

private:
    float normal() { return std::clamp(random_.normal(), -2.5f, 2.5f); }
    Random random_{20};
};

/// One body in the frames of its bones: kFitInfluences points a vertex, then offsets, then joints.
struct BodyInBones {
    std::vector<Vec3> points;
    std::array<Mat3, kBoneCount> t_pose;
};

AvatarRig rig_of(const BodyModel& model, const EvaluatedBody& body) {
    std::vector<AvatarBone> bones;
    for (size_t i = 0; i < model.bones().size(); ++i) {
        const RigBone& b = model.bones()[i];
        bones.push_back({b.name, b.parent, b.bone, body.bone_heads[i], body.bone_tails[i]});
    }
    for (const int hand : {VFIT_BONE_LEFT_HAND, VFIT_BONE_RIGHT_HAND}) {
        const char* finger = hand == VFIT_BONE_LEFT_HAND ? "finger3-1.L" : "finger3-1.R";
        for (size_t i = 0; i < model.bones().size(); ++i)
            if (model.bones()[i].name == finger)
                bones[size_t(model.rig_bone(hand))].rest_tail = body.bone_heads[i];
    }
    return AvatarRig(std::move(bones), 0.0f, 0);
}

BodyInBones in_bones(const BodyModel& model, const EvaluatedBody& body,
                     const std::vector<FitModel::Vertex>& vertices) {
    const AvatarRig rig = rig_of(model, body);
    PosedSkeleton posed;
    std::vector<Mat4> matrices(rig.bones().size());
    rig.pose(Pose{}, posed, matrices);
    BodyInBones out;
    std::array<Vec3, kBoneCount> head;
    for (int b = 0; b < kBoneCount; ++b) {
        head[size_t(b)] = rig.bones()[size_t(rig.rig_bone(b))].rest_head;
        out.t_pose[size_t(b)] = Mat3(matrices[size_t(rig.rig_bone(b))]);
    }
    for (const FitModel::Vertex& vertex : vertices)
        for (const FitModel::Influence& influence : vertex.influences) {
            const auto b = size_t(influence.bone);
            out.points.push_back(out.t_pose[b] * (body.positions[vertex.source] - head[b]));
        }
    for (int b = 0; b < kBoneCount; ++b)
        out.points.push_back(b == 0 ? Vec3(0.0f) : rig.skeleton().offset[size_t(b)]);
    for (const JointPlace& place : kJointPlaces) {
        const AvatarBone& bone = rig.bones()[size_t(rig.rig_bone(place.bone))];
        const Vec3 at = glm::mix(bone.rest_head, bone.rest_tail, place.along);
        out.points.push_back(out.t_pose[size_t(place.bone)] * (at - bone.rest_head));
    }
    return out;
}

}  // namespace

Vec3 FitPoint::at(const FitShape& shape) const {
    Vec3 p = mean;
    for (int axis = 0; axis < 3; ++axis) {
        const float* field = fields.data() + axis * kFitShapeLanes;
        for (size_t s = 0; s < size_t(kFitShapes); ++s) p[axis] += field[s] * shape[s];
    }
    return p;
}

std::span<const int> FitModel::limb_bones(int limb) {
    switch (limb) {
        case kLeftArm: return kLeftArmBones;
        case kRightArm: return kRightArmBones;
        case kLeftLeg: return kLeftLegBones;
        case kRightLeg: return kRightLegBones;
        default: return kTrunkBones;
    }
}

FitModel::FitModel(const BodyModel& model, uint32_t vertices) {
    if (vertices < 100 || vertices > model.topology(0).vertex_count)
        fail(VFIT_ERROR_ARGUMENT, "a fitted body of ", vertices, " vertices: not 100 to ",
             model.topology(0).vertex_count);
    choose_vertices(model, vertices);
    find_influences(model);
    sort_by_limb();
    place_normals(model);
    learn_shapes(model);
    learn_fields(model);
    add_layers();
}

FitModel FitModel::refined(const BodyModel& model) const {
    FitModel fine;
    for (uint32_t v = 0; v < model.topology(0).vertex_count; ++v) {
        fine.vertices_.emplace_back();
        fine.vertices_.back().source = v;
    }
    fine.triangles_ = model.topology(0).indices;
    fine.scores_ = scores_;
    fine.find_influences(model);
    fine.sort_by_limb();
    fine.place_normals(model);
    fine.learn_fields(model);
    fine.add_layers();
    return fine;
}

void FitModel::choose_vertices(const BodyModel& model, uint32_t count) {
    EvaluatedBody body;
    model.evaluate(model.default_shape(VFIT_SEX_UNKNOWN), body);
    const BodyTopology& topology = model.topology(0);
    std::vector<float> density(topology.vertex_count, 1.0f);
    for (uint32_t v = 0; v < topology.vertex_count; ++v) switch (topology.parts[v]) {
            // Thin parts need more for their curvature, fingers fewer than they have surface for.
            case BodyPart::kLeftForearm:
            case BodyPart::kRightForearm: density[v] = 1.35f; break;
            case BodyPart::kLeftUpperArm:
            case BodyPart::kRightUpperArm: density[v] = 1.2f; break;
            case BodyPart::kLeftHand:
            case BodyPart::kRightHand: density[v] = 0.9f; break;
            default: break;
        }
    CoarseSurface surface = coarse_surface(body.positions, topology.indices, density, count);
    for (const uint32_t source : surface.vertices) {
        vertices_.emplace_back();
        vertices_.back().source = source;
    }
    triangles_ = std::move(surface.triangles);
}

/// Rows of one limb have the same columns.
void FitModel::sort_by_limb() {
    std::vector<uint32_t> order(vertices_.size()), place(vertices_.size());
    for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](uint32_t a, uint32_t b) { return vertices_[a].limb < vertices_[b].limb; });
    std::vector<Vertex> sorted;
    for (uint32_t i = 0; i < order.size(); ++i) {
        sorted.push_back(vertices_[order[i]]);
        place[order[i]] = i;
    }
    vertices_ = std::move(sorted);
    for (uint32_t& v : triangles_) v = place[v];
}

void FitModel::place_normals(const BodyModel& model) {
    EvaluatedBody body;
    model.evaluate(model.default_shape(VFIT_SEX_UNKNOWN), body);
    std::vector<Vec3> all_normals;
    compute_normals(body.positions, model.topology(0).indices, all_normals);
    const BodyInBones frames = in_bones(model, body, vertices_);
    for (Vertex& vertex : vertices_) {
        for (const Influence& influence : vertex.influences)
            normals_.push_back(frames.t_pose[size_t(influence.bone)] * all_normals[vertex.source]);
        vertex.bridged =
            between_legs(vertex.influences.front().bone, normals_[normals_.size() - kFitInfluences]);
    }
}

void FitModel::find_influences(const BodyModel& model) {
    const BodyTopology& topology = model.topology(0);
    const std::vector<int> humanoid = humanoid_of_rig(model);
    for (Vertex& vertex : vertices_) {
        std::array<float, kBoneCount> weights{};
        for (size_t k = 0; k < size_t(kSkinBones); ++k)
            weights[size_t(humanoid[topology.skin_bones[vertex.source][k]])] +=
                topology.skin_weights[vertex.source][k];
        const int heaviest = int(std::max_element(weights.begin(), weights.end()) - weights.begin());
        vertex.limb = limb_of(heaviest);
        const auto bones = limb_bones(vertex.limb);
        std::vector<Influence> found;
        for (int b = 0; b < kBoneCount; ++b)
            if (weights[size_t(b)] >= kLeastWeight && std::find(bones.begin(), bones.end(), b) != bones.end())
                found.push_back({b, weights[size_t(b)]});
        std::sort(found.begin(), found.end(),
                  [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
        vertex.influence_count = int(std::min<size_t>(found.size(), kFitInfluences));
        float sum = 0.0f;
        for (int k = 0; k < vertex.influence_count; ++k) sum += found[size_t(k)].weight;
        for (int k = 0; k < kFitInfluences; ++k)  // unused ones stand on the first bone, without weight
            vertex.influences[size_t(k)] =
                k < vertex.influence_count ? Influence{found[size_t(k)].bone, found[size_t(k)].weight / sum}
                                           : Influence{found[0].bone, 0.0f};
    }
}

/// Components of the sampled bodies' surfaces and joints.
void FitModel::learn_shapes(const BodyModel& model) {
    Bodies bodies;
    EvaluatedBody body;
    std::vector<std::vector<double>> samples;
    std::vector<std::vector<float>> shapes;
    const size_t vertex_points = vertices_.size() * kFitInfluences;
    for (size_t i = 0; i < kSampleBodies; ++i) {
        shapes.push_back(bodies.next(model));
        model.evaluate(shapes.back(), body);
        std::vector<double> sample;
        const BodyInBones placed = in_bones(model, body, vertices_);
        for (size_t p = 0; p < placed.points.size(); ++p)
            for (int axis = 0; axis < 3; ++axis)
                sample.push_back(double(placed.points[p][axis]) * (p < vertex_points ? 1.0 : kJointShare));
        samples.push_back(std::move(sample));
    }
    const auto scores = principal_components(samples, kFitComponents).scores;
    scores_.resize(kSampleBodies);
    for (size_t i = 0; i < kSampleBodies; ++i)
        for (size_t c = 0; c < size_t(kFitComponents); ++c) scores_[i][c] = float(scores[c][i]);

    const size_t parameters = model.parameters().size();
    parameter_means_.assign(parameters, 0.0f);
    parameter_fields_.assign(parameters * kFitComponents, 0.0f);
    for (size_t i = 0; i < kSampleBodies; ++i)
        for (size_t p = 0; p < parameters; ++p) {
            parameter_means_[p] += shapes[i][p] / float(kSampleBodies);
            for (size_t c = 0; c < size_t(kFitComponents); ++c)
                parameter_fields_[p * kFitComponents + c] +=
                    scores_[i][c] * shapes[i][p] / float(kSampleBodies);
        }
}

/// How each point moves with the components: the regression on their scores, which have mean 0 and
/// variance 1.
void FitModel::learn_fields(const BodyModel& model) {
    Bodies bodies;
    EvaluatedBody body;
    const size_t vertex_points = vertices_.size() * kFitInfluences;
    std::vector<FitPoint> points(vertex_points + kBoneCount + kJointCount);
    for (size_t i = 0; i < kSampleBodies; ++i) {
        model.evaluate(bodies.next(model), body);
        const BodyInBones placed = in_bones(model, body, vertices_);
        for (size_t p = 0; p < points.size(); ++p) {
            const Vec3 share = placed.points[p] / float(kSampleBodies);
            points[p].mean += share;
            for (int axis = 0; axis < 3; ++axis)
                for (size_t c = 0; c < size_t(kFitComponents); ++c)
                    points[p].fields[size_t(axis) * kFitShapeLanes + c] += scores_[i][c] * share[axis];
        }
    }
    places_.assign(points.begin(), points.begin() + std::ptrdiff_t(vertex_points));
    std::copy_n(points.begin() + std::ptrdiff_t(vertex_points), kBoneCount, offsets_.begin());
    std::copy_n(points.begin() + std::ptrdiff_t(vertex_points) + kBoneCount, kJointCount, joints_.begin());
}

void FitModel::add_layers() {
    for (size_t v = 0; v < vertices_.size(); ++v)
        for (size_t k = 0; k < size_t(kFitInfluences); ++k) {
            const int layer = clothing_layer_of(vertices_[v].limb, vertices_[v].influences[0].bone);
            if (layer < 0) continue;
            const size_t i = v * kFitInfluences + k;
            for (int axis = 0; axis < 3; ++axis)
                places_[i].fields[size_t(axis) * kFitShapeLanes + kFitComponents + size_t(layer)] =
                    kLayerUnit_m * normals_[i][axis];
        }
}

void FitModel::body_shape(const BodyModel& model, const FitShape& shape, std::span<float> out) const {
    for (size_t p = 0; p < parameter_means_.size(); ++p) {
        float value = parameter_means_[p];
        for (size_t c = 0; c < size_t(kFitComponents); ++c)
            value += parameter_fields_[p * kFitComponents + c] * shape[c];
        out[p] = std::clamp(value, model.parameters()[p].minimum, model.parameters()[p].maximum);
    }
}

}  // namespace vfit
