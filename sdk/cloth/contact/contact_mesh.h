// Contact with a moving mesh: the skin, or a garment that is worn below. Once a step, each particle that is
// near the mesh gets the plane that touches it at the nearest point, and stays before that plane, as it
// moves, through the sub-steps. In a hollow, as between arm and chest, it gets the plane of the other side
// too, where it was nearest before: else it would come out of one side into the other, and back in the next
// step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/base/triangle_fans.h"
#include "cloth/contact/mesh_of.h"
#include "cloth/contact/run_planes.h"
#include "cloth/contact/surface_kernels.h"
#include "cloth/contact/triangle_groups.h"

namespace vfit {

class ContactMesh {
public:
    /// Three indices a triangle, counter-clockwise seen from outside; triangles with a vertex that does not
    /// count (flags, one a vertex; empty: all do) are left out. VFIT_ERROR_DATA where an index is out of
    /// range.
    ContactMesh(size_t vertices, std::span<const uint32_t> indices, std::span<const uint8_t> counts = {},
                MeshOf what = MeshOf::solid);

    size_t vertex_count() const { return vertex_count_; }
    /// Of the triangles that count.
    std::span<const uint32_t> indices() const { return indices_; }
    MeshOf what() const { return what_; }
    /// Where its vertices are at the end of this step. `around`: the box in which it is looked for.
    void accept(std::span<const Vec3> positions, const Vec3& low, const Vec3& high);
    /// They were nowhere before: the next step begins where it ends.
    void forget() { begin_.clear(); }
    void hide();
    void arrive() {
        if (!begin_.empty()) std::swap(begin_, end_);
    }
    float greatest_way() const { return greatest_way_; }

    /// Points of the mesh about which a particle was nearest to it in the step before, and where it faced
    /// another side of it.
    struct Touched {
        uint32_t nearest = NearestOnFans::kNone, other = NearestOnFans::kNone;
    };
    /// Planes for runs of particles as they lie and move at the begin of a step of dt, by rising runs. Those
    /// of a run that is not near are left out. May run for several parts at the same time. near: room to work
    /// in. lift_m: of each particle, what it keeps beyond the thickness, or may go below it (negative);
    /// empty: nothing. touched: the part's memory of this mesh, one a particle; empty at first.
    void find_planes(const Moving& moving, float dt, float thickness_m, std::span<const float> lift_m,
                     std::vector<uint32_t>& near, std::vector<Touched>& touched,
                     std::vector<RunPlanes>& out) const;
    /// Adds those of the triangles of one of the cloth's groups that go through the mesh where it arrived.
    void find_crossed(const TriangleGroups& cloth, uint32_t group, std::vector<uint32_t>& near,
                      std::vector<uint32_t>& triangles) const;

private:
    /// A place on a triangle.
    struct Place {
        uint32_t corner[3];
        Vec3 weights;

        Vec3 at(const Particles& points) const;
        Vec3 normal(const Particles& points) const;  // of the triangle
        uint32_t nearest_corner() const;
    };
    void order(std::span<const Vec3> positions);
    float reach_of(const Moving& moving, uint32_t first, float dt, float thickness_m,
                   std::vector<uint32_t>& near) const;
    void find_nearest(const Particle* run, uint32_t* points, NearestOnFans& out) const;
    Place place_of(const NearestOnFans& nearest, size_t lane, uint32_t point) const;
    /// What a particle is kept before.
    struct Touch {
        Vec3 on, to, normal, turn;  // `on` at the begin of the step, on its way `to`; how the normal turns
    };
    bool touch_at(const Place& place, const Vec3& particle, float reach, Touch& out) const;
    void add_other_sides(const Particle* run, float reach, const Touch* touches, const uint32_t* points,
                         float thickness_m, Touched* touched, RunPlanes& out) const;
    Vec3 outward_at(const Place& place) const;
    bool is_at_border(const Place& place) const;

    size_t vertex_count_;
    MeshOf what_;
    std::vector<uint32_t> indices_;  // of vertices
    float greatest_way_ = 0.0f;
    // Its vertices that have triangles as points, in runs of kLanes that lie together.
    std::vector<uint32_t> vertex_of_;
    std::vector<uint8_t> on_border_;  // of the open mesh: a hem, or where what does not count was left out
    TriangleFans fans_;
    Particles begin_, end_;  // of the step
    Particles places_;       // as begin_; not finite: nobody, or too far to matter
    RunBoxes boxes_;         // on their way through the step, and as far as their triangles may reach
    std::vector<float> ways_m_, edges_m_;  // of each run, at most
};

}  // namespace vfit
