// The particles of one cloth and their way through a step: small sub-steps of one XPBD pass each (Macklin et
// al. 2019), part by part on as many threads as there are.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cloth/base/rigid_motion.h"
#include "cloth/contact/collider_motion.h"
#include "cloth/contact/contact_mesh.h"
#include "cloth/contact/triangle_contact.h"
#include "cloth/contact/virtual_particles.h"
#include "cloth/fabric/fabric.h"
#include "cloth/solver/air.h"
#include "cloth/solver/cloth_kernels.h"
#include "core/jobs.h"

namespace vfit {

class ParticleSolver {
public:
    struct Options {
        float virtual_m = 0.0f;    // between points of triangles that meet colliders as well; 0: none
        bool with_pushes = false;  // copy_pushes() is asked for
    };
    ParticleSolver(std::shared_ptr<const Fabric> fabric, const Options& options);

    /// At rest at these places, one a vertex.
    void place(std::span<const Vec3> vertices);
    void rest();
    /// One vertex is there and moves so.
    void place(uint32_t vertex, const Vec3& at, const Vec3& velocity);
    /// Mesh of that number is another one from now on.
    void forget_mesh(size_t mesh);
    /// FabricData::limits are wider by that, one a vertex; empty: by nothing.
    void widen_limits(std::span<const float> by_m);
    /// As the cloth lies and moves.
    void carry(const RigidMotion& motion);

    /// What a part of the layout meets its obstacles with, and which of the colliders.
    struct PartContact {
        ContactSettings settings;
        uint32_t first_collider, end_collider;
    };
    struct Step {
        float dt;
        int substeps;
        Vec3 gravity;
        Air air;
        float keep;                               // of the speed, a sub-step
        std::span<const PartContact> contact_of;  // one a part
        float thickness_m;                        // of backstops; colliders have theirs
        bool limits_give_way;                     // pull by no more than the fabric says
        std::span<const Vec3> from, to;           // the fabric's targets at both ends of a step
        Interval interval;                        // of that one, which this is about
        const ColliderMotion& colliders;
        std::span<const ContactMesh> meshes;
        TriangleContact* contacts = nullptr;
        float contact_friction = 0.0f;  // of these

        std::span<const SweptCapsule> colliders_of(uint32_t part, std::span<const SweptCapsule> all) const {
            return all.subspan(contact_of[part].first_collider,
                               contact_of[part].end_collider - contact_of[part].first_collider);
        }
    };
    /// The box about all particles.
    void bounds(Vec3& low, Vec3& high) const;

    /// The result is the same for any number of threads. Does not allocate while the number of colliders
    /// stays.
    void advance(const Step& step, Jobs& jobs);

    /// One a vertex; and how far they are from what was there before.
    struct Ways {
        float greatest_m = 0.0f, rms_m = 0.0f;
    };
    Ways copy_positions(std::span<Vec3> out) const;
    /// One a vertex: where contacts pushed it in the last step; zero: it met nothing.
    void copy_pushes(std::span<Vec3> out) const;
    const Particles& places() const { return places_; }
    const Particles& velocities() const { return velocities_; }

private:
    struct Gains {
        std::vector<BatchGains> bends, edges;
        std::vector<HingeGains> hinges;
    };
    struct Part {
        NearColliders may_meet;
        std::vector<RunBalls> backstops, limits;
        std::vector<RunPlanes> planes;
        Particles fixed, fixed_ways;  // copies of the fixed vertices at the begin of the step, and to its end
        std::vector<uint32_t> near_runs;
        std::vector<std::vector<ContactMesh::Touched>> touched;  // of each mesh
    };
    Moving moving(uint32_t part);
    void set_gains(float h, int substeps);
    void begin_part(const Step& step, uint32_t part);
    template <typename Radius>
    void place_balls(const Step& step, uint32_t part, std::span<const BallRun> runs, const Radius& radius_m,
                     std::vector<RunBalls>& out) const;
    void place_fixed(const Step& step, uint32_t part);
    void begin_substep(const Step& step, int substep, uint32_t part);
    void end_part(const Step& step, int substep, uint32_t part);
    void solve_group(int substep, uint32_t group);
    void fill_up(uint32_t part);

    std::shared_ptr<const Fabric> fabric_;
    Particles places_, starts_, velocities_;  // in the fabric's layout
    Particles pushed_;                        // by contacts in this step; empty: nobody asks
    std::vector<float> limits_wider_m_;       // in the lanes of runs; empty: by nothing
    std::vector<Gains> gains_;                // of its groups
    float gains_h_ = 0.0f;                    // the sub-step that they are for,
    bool may_alternate_ = false;              // and whether a step has an even number of them
    int bend_every_ = 1;                      // so many sub-steps
    std::vector<Part> parts_;
    std::unique_ptr<VirtualParticles> virtual_;
    std::vector<SweptCapsule> swept_step_,
        swept_;  // over the step, and over the sub-step that comes to its end
};

}  // namespace vfit
