// Contact with a moving mesh: the skin, or a garment that is worn below. Once a step, each particle that is near the mesh gets
// the plane that touches it at the nearest point, and stays before that plane, as it moves, through the sub-steps.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/cloth_kernels.h"
#include "cloth/rigid_motion.h"
#include "cloth/surface_kernels.h"
#include "cloth/triangle_fans.h"

namespace vfit {

class ContactMesh {
public:
    /// Three indices a triangle, counter-clockwise seen from outside; triangles with a vertex that does not count (flags, one
    /// a vertex; empty: all do) are left out. VFIT_ERROR_DATA where an index is out of range.
    ContactMesh(size_t vertices, std::span<const uint32_t> indices, std::span<const uint8_t> counts = {});

    size_t vertex_count() const { return counts_.size(); }
    /// Where its vertices are at the end of this step. `around`: the box in which it is looked for.
    void accept(std::span<const Vec3> positions, const Vec3& low, const Vec3& high);
    /// They were where they are now.
    void jump() { previous_ = current_; }
    void forget() { previous_.clear(); }
    void hide();
    void arrive() { std::swap(previous_, current_); }
    void carry(const RigidMotion& motion);
    float greatest_way() const { return greatest_way_; }

    /// Planes for runs of particles as they lie and move at the begin of a step of dt, by rising runs. Those of a run that is
    /// not near are left out. May run for several parts at the same time.
    /// near: room to work in.
    void find_planes(const Moving& moving, float dt, float thickness_m, std::vector<uint32_t>& near, std::vector<RunPlanes>& out) const;

private:
    struct Place {
        uint32_t triangle;
        Vec3 weights;
    };
    Vec3 at(const std::vector<Vec3>& positions, const Place& place) const;
    Vec3 normal_of(const std::vector<Vec3>& positions, uint32_t triangle) const;
    Place nearest_about(uint32_t vertex, const Vec3& p) const;
    Vec3 outward_at(const Place& place) const;

    void order(std::span<const Vec3> positions);

    std::vector<uint8_t> counts_;
    std::vector<uint32_t> indices_;
    TriangleFans fans_;
    float greatest_way_ = 0.0f;
    std::vector<Vec3> previous_, current_;
    // Vertices in runs of kLanes neighbours, as they lie at the begin of the step; not finite: nobody, or too far to matter.
    std::vector<uint32_t> vertex_of_;
    Particles places_;
    RunBoxes boxes_;                        // on their way through the step, and as far as their triangles may reach
    std::vector<float> ways_m_, edges_m_;  // of each run, at most
};

}  // namespace vfit
