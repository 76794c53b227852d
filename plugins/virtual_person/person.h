// The person's body: an avatar of vfit.h in a context of its own, posed and read back frame by frame.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "clothing.h"
#include "figure.h"
#include "proportions.h"
#include "vfit.h"

namespace vfit::virtual_person {

/// A context for this plug-in's own use: one worker, quiet but for errors.
class OwnContext {
public:
    OwnContext();
    ~OwnContext() { vfit_context_destroy(context_); }
    OwnContext(const OwnContext&) = delete;
    OwnContext& operator=(const OwnContext&) = delete;
    vfit_context get() const { return context_; }

private:
    vfit_context context_{};
};

std::vector<vfit_shape_value> shape_list(vfit_context context);

class Person {
public:
    Person(vfit_context context, vfit_sex sex, uint32_t detail, const std::map<std::string, float>& shape);
    ~Person();
    Person(const Person&) = delete;
    Person& operator=(const Person&) = delete;

    /// Clothes of that thickness; 0: none. Before the first pose: it is fitted in the T-pose.
    void wear(const Thickness& thickness, uint64_t seed);

    const Proportions& proportions() const { return proportions_; }
    const std::vector<uint32_t>& triangles() const { return triangles_; }
    uint32_t vertex_count() const { return vertex_count_; }
    /// Ground truth as JSON: {"stature_m": 1.712, ...}.
    const std::string& measures_json() const { return measures_json_; }

    /// Poses the body and moves it by `offset`. Valid until the next call: positions() and joints().
    void pose(const BonePose& pose, const Vec3& offset);
    /// The surface with its clothes, packed x, y, z in world space.
    const float* positions() const { return surface_; }
    std::span<const vfit_joint> joints() const { return joints_; }
    Vec3 joint_place(vfit_joint_id joint) const;

private:
    vfit_view vertices(vfit_stream stream) const;  // packed Vec3
    void read_triangles();
    void read_proportions();
    void read_measures();
    void read_joints();

    vfit_avatar avatar_{};
    vfit_frame mesh_{};
    const float* skin_ = nullptr;     // of mesh_
    const float* surface_ = nullptr;  // skin_ or its clothes
    std::optional<Clothing> clothing_;
    std::vector<uint32_t> triangles_;
    std::vector<vfit_joint> joints_;
    uint32_t vertex_count_ = 0;
    Proportions proportions_;
    std::string measures_json_;
};

}  // namespace vfit::virtual_person
