// The reduced body that is fitted to depth: about 1,200 vertices of the body model with skin weights and
// shape fields of their own. Shape is a few principal components of the body space, and layers of clothing.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "body/body_model.h"
#include "body/joint_bones.h"
#include "body/skeleton.h"
#include "frame/body.h"

namespace vfit {

inline constexpr int kFitComponents = 10;  // of the body space, unit variance
inline constexpr int kFitLayers =
    3;  // clothing on trunk, arms, legs: one unit is kLayerUnit_m along the normal
inline constexpr int kFitShapes = kFitComponents + kFitLayers;
inline constexpr int kFitShapeLanes = 16;  // kFitShapes, padded for vector arithmetic
inline constexpr float kLayerUnit_m = 0.01f;
inline constexpr int kFitInfluences = 3;  // bones of a vertex at most
inline constexpr int kFitLimbs = 5;       // trunk with head, two arms, two legs

using FitShape = std::array<float, kFitShapes>;

/// A point that belongs to a bone, in that bone's frame (origin at its start, axes of the T-pose), and how it
/// moves with each unit of shape.
struct FitPoint {
    Vec3 mean{0.0f};
    std::array<float, 3 * kFitShapeLanes> fields{};  // x of every shape, then y, then z; padding 0
    Vec3 at(const FitShape& shape) const;
};

class FitModel {
public:
    /// Takes `vertices` of the model's skin, spread evenly; a few hundred milliseconds. The same each time.
    explicit FitModel(const BodyModel& model, uint32_t vertices = 1200);
    /// The same shapes on every vertex of the body model: for pictures and for judging.
    FitModel refined(const BodyModel& model) const;

    struct Influence {
        int bone = 0;  // VFIT_BONE_*; every further one lies on a bone of the same limb
        float weight = 0.0f;
    };
    struct Vertex {
        std::array<Influence, kFitInfluences> influences{};
        int influence_count = 0;
        int limb = 0;
        bool bridged =
            false;  // between the legs, where cloth spans from one to the other: no outline of the body's
        uint32_t source = 0;  // vertex of the body model, level 0
    };

    uint32_t vertex_count() const { return static_cast<uint32_t>(vertices_.size()); }
    /// Ordered by limb.
    const std::vector<Vertex>& vertices() const { return vertices_; }
    /// kFitInfluences a vertex: its place in the frame of each of its bones.
    const std::vector<FitPoint>& places() const { return places_; }
    /// kFitInfluences a vertex: unit normals of the mean body in the frames of its bones.
    const std::vector<Vec3>& normals() const { return normals_; }
    /// Three vertices a triangle, counter-clockwise from outside.
    const std::vector<uint32_t>& triangles() const { return triangles_; }
    /// From the parent bone's start, T-pose; zero for the hips.
    const std::array<FitPoint, kBoneCount>& offsets() const { return offsets_; }
    /// By joint id, in the frame of kJointPlaces' bone.
    const std::array<FitPoint, kJointCount>& joints() const { return joints_; }
    /// Bones whose motion can move a vertex of that limb, parents first.
    static std::span<const int> limb_bones(int limb);

    /// Shape values of the body model for that shape: the regression of the sampled bodies' values on their
    /// components, within the model's ranges. Clothing is left out.
    void body_shape(const BodyModel& model, const FitShape& shape, std::span<float> out) const;

private:
    FitModel() = default;
    void choose_vertices(const BodyModel& model, uint32_t count);
    void find_influences(const BodyModel& model);
    void sort_by_limb();
    void place_normals(const BodyModel& model);
    void learn_shapes(const BodyModel& model);
    void learn_fields(const BodyModel& model);
    void add_layers();

    std::vector<Vertex> vertices_;
    std::vector<FitPoint> places_;
    std::vector<Vec3> normals_;
    std::vector<uint32_t> triangles_;
    std::array<FitPoint, kBoneCount> offsets_{};
    std::array<FitPoint, kJointCount> joints_{};
    std::vector<float> parameter_means_, parameter_fields_;  // fields: kFitComponents a parameter
    std::vector<std::array<float, kFitComponents>> scores_;  // of the sampled bodies
};

}  // namespace vfit
