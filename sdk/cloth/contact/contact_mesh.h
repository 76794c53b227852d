// Contact with a moving solid: the skin, or a prop. Once a step, each particle that is near the mesh gets the
// plane that touches it at the nearest point, and stays before that plane, as it moves, through the
// sub-steps. Its contact slides along the mesh from step to step: in a hollow, as between arm and chest, it
// stays in contact with the side where it was, and with the other one that it meets.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/base/interval.h"
#include "cloth/base/triangle_fans.h"
#include "cloth/contact/contact.h"
#include "cloth/contact/mesh_of.h"
#include "cloth/contact/run_planes.h"
#include "cloth/contact/surface_kernels.h"

namespace vfit {

class ContactMesh {
public:
    /// Three indices a triangle, counter-clockwise seen from outside; triangles with a vertex that does not
    /// count (flags, one a vertex; empty: all do) are left out. VFIT_ERROR_DATA where an index is out of
    /// range.
    ContactMesh(size_t vertices, std::span<const uint32_t> indices, std::span<const uint8_t> counts = {},
                MeshOf what = MeshOf::solid, const MeshFilter& filter = {});

    size_t vertex_count() const { return vertex_count_; }
    /// Of the triangles that count.
    std::span<const uint32_t> indices() const { return indices_; }
    MeshOf what() const { return what_; }
    MeshFilter filter() const { return {category_, mask_}; }
    /// Of the cloth's vertices from `first` on.
    void set_mask(std::span<const uint8_t> mask, uint32_t first) {
        std::copy(mask.begin(), mask.end(), mask_.begin() + first);
    }
    /// Where its vertices are at the end of this step.
    void accept(std::span<const Vec3> positions);
    /// A fraction of their way in this step lies behind them when it begins.
    void skip(float fraction);
    /// After accept(): where they begin the step.
    void start_at(std::span<const Vec3> positions);
    /// What follows is about that part of the step; the mesh is looked for within a box.
    void look_at(const Interval& interval, const Vec3& low, const Vec3& high);
    /// They were nowhere before: the next step begins where it ends.
    void forget() { from_.clear(); }
    void hide();
    /// The step has ended.
    void arrive() {
        if (!from_.empty()) from_ = to_;
    }
    float greatest_way() const { return greatest_way_; }  // in the step
    /// Of its vertices, in the step.
    const Bounds& ways() const { return ways_; }

    /// Points of the mesh about which the places lie that a particle is in contact with.
    struct Touched {
        uint32_t points[2] = {NearestOnFans::kNone, NearestOnFans::kNone};
        bool any() const { return (points[0] & points[1]) != NearestOnFans::kNone; }
    };
    /// A part of a cloth at the begin of an interval.
    struct PartOfCloth {
        Moving moving;
        std::span<const uint32_t> vertex_of;  // of each particle
        float dt, thickness_m;
    };
    /// Planes for runs of particles, by rising runs. Those of a run that meets nothing are left out. May run
    /// for several parts at the same time. runs: room to work in. touched: the part's memory of this mesh,
    /// one a particle; empty at first.
    void find_planes(const PartOfCloth& part, std::vector<uint32_t>& runs, std::vector<Touched>& touched,
                     std::vector<RunPlanes>& out) const;

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
    void find_edges(std::span<const Vec3> positions);
    float reach_of(const Moving& moving, uint32_t first, float dt, float thickness_m,
                   std::vector<uint32_t>& near) const;
    void find_nearest(const Particle* run, uint32_t* points, int max_steps, NearestOnFans& out) const;
    Place place_of(const NearestOnFans& nearest, size_t lane, uint32_t point) const;
    /// What a particle is kept before.
    struct Touch {
        Vec3 on, to, normal, turn;  // `on` at the begin of the step, on its way `to`; how the normal turns
        uint32_t point = NearestOnFans::kNone;  // about which it lies; kNone: there is none
        float before_m = 0.0f;                  // distance of the particle, negative inside
    };
    struct Touches {
        Touch of[kLanes];
    };
    void touch(const Particle* run, const uint32_t* points, int max_steps, float reach, Touches& out) const;
    static void choose(const Touch& now, Touch (&known)[2]);
    void touch_at(const Place& place, const Vec3& particle, float reach, Touch& out) const;
    Vec3 outward_at(const Place& place) const;
    bool is_at_border(const Place& place) const;

    bool meets(uint32_t point, uint32_t cloth_vertex) const;

    size_t vertex_count_;
    MeshOf what_;
    std::vector<uint8_t> category_, mask_;  // of a vertex of the mesh, and of the cloth; empty: all meet all
    std::vector<uint32_t> indices_;         // of vertices
    float greatest_way_ = 0.0f;
    Bounds ways_;
    // Its vertices that have triangles as points, in runs of kLanes that lie together.
    std::vector<uint32_t> vertex_of_;    // kNobody fills a run up, so that each is of one category
    std::vector<uint8_t> run_category_;  // with a filter
    std::vector<uint8_t> on_border_;     // of the open mesh: a hem, or where what does not count was left out
    TriangleFans fans_;
    Particles from_, to_;    // of the step
    Particles begin_, end_;  // of the interval
    Particles places_;       // as begin_; not finite: nobody, or too far to matter
    RunBoxes boxes_;         // on their way through the interval, and as far as their triangles may reach
    std::vector<float> ways_m_, edges_m_;  // of each run, at most
};

}  // namespace vfit
