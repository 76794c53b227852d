// Contact between triangles: of a cloth with itself and with meshes. Contacts keep a step's layers apart, and
// what would end up crossing all the same is set right once the step is over.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cloth/base/interval.h"
#include "cloth/contact/contact_list.h"
#include "cloth/contact/crossing_guard.h"
#include "cloth/contact/mesh_of.h"
#include "cloth/contact/proximity.h"
#include "cloth/fabric/fabric.h"
#include "core/jobs.h"

namespace vfit {

class TriangleContact {
public:
    /// positions: one a vertex, by which triangles are grouped.
    TriangleContact(std::shared_ptr<const Fabric> fabric, const LayerThickness& thickness,
                    std::span<const Vec3> positions, Jobs* jobs = nullptr);
    /// Of another fabric with the same triangles, among the same meshes, which are hidden.
    TriangleContact(const TriangleContact& other, std::shared_ptr<const Fabric> fabric, Jobs* jobs = nullptr);

    /// From the next keep() on, these two pieces of the cloth pass through each other, or no longer do.
    void set_passing(size_t piece, size_t other, bool passing) {
        proximity_.set_passing(piece, other, passing);
    }
    /// Whether all of them do.
    void pass_each_other(bool they_do) {
        pieces_meet_ = !they_do && thickness_.own_m.size() > 1;
        proximity_.pass_each_other(they_do);
    }
    /// Triangles counter-clockwise from outside; keeps_m: as ContactList. It is hidden until it is moved.
    void add_mesh(size_t vertices, std::span<const uint32_t> indices, float keeps_m, MeshOf what,
                  const MeshFilter& filter = {});
    void set_mask(uint32_t mesh, std::span<const uint8_t> mask, uint32_t first) {
        proximity_.set_mask(mesh, mask, first);
    }
    /// Where it goes in the next step, from where it went in the last.
    void move_mesh(uint32_t mesh, std::span<const Vec3> end);
    /// After move_mesh() and skip(): where it begins the next step.
    void start_mesh(uint32_t mesh, std::span<const Vec3> positions);
    /// A fraction of the meshes' way in the next step lies behind them when it begins.
    void skip(float fraction);
    /// The next keep() is about that part of the step.
    void look_at(const Interval& interval);
    /// What was in contact with it no longer is: it may show up elsewhere in the next step.
    void hide_mesh(uint32_t mesh);
    /// Meshes were nowhere before: their next step begins where it ends.
    void forget_meshes() {
        for (Mesh& mesh : meshes_) mesh.is_known = false;
    }
    /// The step has ended.
    void arrive() { from_ = to_; }

    /// The cloth was placed there anew, at rest.
    void place(std::span<const Vec3> positions, Jobs& jobs);
    /// After look_at(): moves triangles of the cloth that cross each other apart. Of two pieces the later one
    /// goes outwards.
    void part(std::span<Vec3> positions, Jobs& jobs);

    /// Edges may be as long as there, until they get shorter.
    void accept_lengths(std::span<const Vec3> positions);
    /// After a step: changes its `end` so that nothing crosses which did not at its begin, and finds the
    /// contacts of the next step. True: the cloth crosses neither itself nor a mesh, which is proven.
    /// shortens_m: as of CrossingGuard.
    bool keep(std::span<const Vec3> begin, std::span<Vec3> end, Jobs& jobs,
              std::optional<float> shortens_m = {});
    /// Before and after the last keep(), the cloth crossed that mesh, which is guarded.
    bool crosses_mesh(uint32_t mesh) const { return guard_.crosses_mesh(mesh); }
    /// Vertices that keep() moved; is_in_zone: as one with others, whose velocity is their way.
    std::span<const uint32_t> moved() const { return guard_.moved(); }
    bool is_in_zone(uint32_t vertex) const { return guard_.is_in_zone(vertex); }

    size_t contact_count() const { return contacts_.size(); }
    size_t mesh_particle_count() const { return contacts_.mesh_particle_count(); }
    /// For a sub-step between those shares of the step: particles that stand for vertices of meshes.
    void place_meshes(float from, float to, Particles& starts, Particles& places) const {
        contacts_.place_meshes(begin_, end_, from, to, starts, places);
    }
    uint32_t share_count() const { return contacts_.share_count(); }
    void refresh(const Particles& places, uint32_t share) { contacts_.refresh(places, share); }
    void solve(const ContactPush& push, const Particles& starts, Particles& places) const {
        contacts_.solve(push, starts, places);
    }

private:
    struct Mesh {
        size_t first_vertex, vertices;
        float keeps_m;
        MeshOf what;
        bool is_known = false;  // where it is
    };
    void make_room_for(const Mesh& mesh);

    size_t cloth_vertices_;
    LayerThickness thickness_;
    bool pieces_meet_ = thickness_.own_m.size() > 1;
    Proximity proximity_;
    ContactList contacts_;
    CrossingGuard guard_;
    std::vector<Vec3> from_, to_;        // of the meshes' vertices, in a step
    std::vector<Particle> begin_, end_;  // of all vertices, in an interval
    std::vector<Mesh> meshes_;
};

}  // namespace vfit
