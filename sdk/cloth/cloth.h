// Cloth: one simulated instance of a fabric. Small sub-steps of one XPBD pass (Macklin et al. 2019), swept
// collision with spheres and tapered capsules, friction, tethers and backstops. One thread at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "body/body_way.h"
#include "body/collider.h"
#include "cloth/carried_along.h"
#include "cloth/contact/mesh_of.h"
#include "cloth/fabric/fabric.h"
#include "cloth/solver/air.h"
#include "core/jobs.h"
#include "math/types.h"

namespace vfit {

class TriangleContact;

inline constexpr float kMaxStep_s = 0.1f;   // a longer step is clamped (vfit_cloth_step)
inline constexpr float kMinStep_s = 1e-4f;  // a shorter one too: a body that moves in no time has no speed

/// A step in which the body as a whole moves faster, or a limb against it, or all of it further, is a jump.
/// Of bodies that moved within 1/60 s, all sleeves stayed on arms at 5 cm, and the duster's came off at 10 cm
/// (vfit-bench garments
/// --jumps --carry-speed 7 --carry-way -1). A limb that swings moves further, and is no jump: carried by
/// skinning, a sleeve goes through the trunk's cloth (vfit-bench garments --recordings).
inline constexpr float kCarrySpeed_m_s = 6.0f, kCarryWay_m = 0.06f;

struct ClothSettings {
    uint32_t substeps = 8;       // per 1/60 s
    Vec3 gravity{0, -9.81f, 0};  // m/s2
    float friction = 0.3f;       // static Coulomb coefficient against colliders
    float damping = 0.5f;        // share of speed lost in a second, 0..1
    float thickness_m = 0.004f;  // kept between vertices and colliders
    float inertia =
        1.0f;  // share of the body's own motion that the cloth feels; the rest carries it along, 0..1
    float carry_speed_m_s = kCarrySpeed_m_s;  // a body that moves faster as a whole, or one of whose limbs
                                              // does against that, jumps: the cloth feels nothing of it
    float carry_way_m = kCarryWay_m;          // the same where all parts move further in one step
    bool follows_fixed = true;  // takes the rigid motion of the pinned vertices for the body's; else the
                                // caller states it (carry_along)
    Air air;
    float budget_ms = 0.0f;  // of a step; where it would take longer, sub-steps are left out. 0: none
    float self_friction =
        0.3f;  // static Coulomb coefficient between the cloth's own layers, and to those below
    float self_thickness_m = 0.0f;  // kept between the cloth's own layers; 0: they pass through each other
    float virtual_m =
        0.0f;  // points of triangles, no further from each other, meet colliders as vertices do; 0: none
    bool pressure = false;       // how the body presses against each vertex is found
    bool limits_lengths = true;  // with own layers or props: edges have a greatest length, save where the
                                 // cloth is put on
    bool sleeps = true;          // a cloth that lies still, on a body that does, is not stepped

    bool is_jump(const BodyWay& way, float dt) const {
        return std::max(way.whole_m, way.limb_m) > carry_speed_m_s * dt || way.min_m > carry_way_m;
    }
    /// Of several pieces that are one cloth. Each keeps its own friction and self_thickness_m. Thickness and
    /// sub-steps are those of the piece that has most; it sleeps where all may, and has pressure where one
    /// does; the rest is as of the last one, which is worn over the others.
    static ClothSettings joined(std::span<const ClothSettings> of_pieces);
};

struct ClothStats {
    uint32_t vertex_count = 0, simulated_count = 0, constraint_count = 0;
    float strain_mean = 0.0f;  // of the edges: mean of the magnitude
    float strain_p99 = 0.0f;   // 99th percentile, to 0.001
    float strain_max = 0.0f;   // of an edge; of those below 2 cm as a fraction of 2 cm
    float step_ms = 0.0f;      // the last step
    uint32_t substeps = 0;     // of the last step; 0: it slept
    bool certified = false;    // with own layers: after the last step none cross, which is proven
};

class Cloth {
public:
    /// start: as for reset.
    Cloth(std::shared_ptr<const Fabric> fabric, const ClothSettings& settings, std::span<const Vec3> start,
          Jobs* jobs = nullptr);
    /// Settings of each of the fabric's pieces. These do not cross each other: they meet as own layers do, a
    /// thickness_m apart.
    static Cloth of_pieces(std::shared_ptr<const Fabric> fabric, std::span<const ClothSettings> settings,
                           std::span<const Vec3> start, Jobs* jobs = nullptr) {
        return Cloth(std::move(fabric), settings, start, nullptr, jobs);
    }
    ~Cloth();
    Cloth(Cloth&&) noexcept;
    Cloth& operator=(Cloth&&) noexcept;

    /// The same cloth with other lengths, at rest where it is now: of a fabric with as many vertices and
    /// targets (VFIT_ERROR_ARGUMENT), on the same body.
    Cloth with_fabric(std::shared_ptr<const Fabric> fabric, Jobs* jobs = nullptr) const;

    /// At rest at these places: one a vertex, or the fabric's target_count() as Dress::skin gives them.
    void reset(std::span<const Vec3> positions);
    /// One a vertex, m/s.
    std::vector<Vec3> velocities() const;
    void set_velocities(std::span<const Vec3> velocities);

    /// Fills skinned targets and colliders, as for step, of a body at that share of its way into a pose.
    using BodyOnItsWay =
        std::function<void(float share, std::vector<Vec3>& targets, std::vector<Collider>& colliders)>;

    /// Put on a body that first stands as at share 0 and then goes to 1: what it meets pushes the cloth
    /// aside, instead of ending up inside of it. start: as for reset. Ends at rest. The number of sub-steps
    /// is always the same, whatever the settings.
    void put_on(std::span<const Vec3> start, const BodyOnItsWay& body, Jobs& jobs);

    /// There at once, at rest, through other pieces but not through its own layers: where these would cross,
    /// not all of the way. positions: as for reset.
    void go_to(std::span<const Vec3> positions, Jobs& jobs);

    /// From a shape that was stretched over the body at share 0 to the cloth's own lengths on the body at
    /// share 1, without the speed that giving way at once would leave. Layers that cross at share 0, as they
    /// may after it was carried to another body, are moved apart first: of two pieces the later one outwards.
    /// Ends at rest.
    void come_to_lengths(const BodyOnItsWay& body, Jobs& jobs);

    /// Before a step or come_to_lengths. Moves the cloth at once. Colliders, meshes and targets begin that
    /// step with the same fraction of their way behind them. VFIT_ERROR_ARGUMENT for a wrong count.
    void carry_along(const CarriedAlong& by);

    /// Advances by dt. skinned_targets: the fabric's target_count(), where the skinned garment and the
    /// backstops are at the END of the step; a free vertex ignores its own. colliders: at the end of the
    /// step, in the same order each call. Both are interpolated from the previous call over the sub-steps.
    /// Fails without changing anything: VFIT_ERROR_DATA for a value that is not finite, VFIT_ERROR_ARGUMENT
    /// for a wrong count or a dt that is negative or not finite. Does not allocate while the number of
    /// colliders stays. The result is the same for any number of threads, unless there is a budget.
    /// interval_ended: before contacts are looked for again, dt after the last time and with that fraction of
    /// the step behind it. May set masks and hide meshes.
    using IntervalEnded = std::function<void(float share, float dt)>;
    void step(float dt, std::span<const Vec3> skinned_targets, std::span<const Collider> colliders,
              Jobs& jobs, const IntervalEnded& interval_ended = {});

    /// From the next step on, these two pieces pass through each other, or no longer do.
    void set_passing(size_t piece, size_t other, bool passing);
    /// From the next step on, each piece meets the colliders up to its end alone, from where those of the
    /// piece before end. Empty: each meets all.
    void set_collider_ends(std::span<const uint32_t> of_pieces);

    /// A solid that the cloth stays outside of, as its skin: triangles counter-clockwise from outside, flags
    /// of the vertices that count (empty: all). Returns its number. Where it is, is said before each step.
    uint32_t add_mesh(size_t vertices, std::span<const uint32_t> indices,
                      std::span<const uint8_t> counts = {}, MeshOf what = MeshOf::solid,
                      const MeshFilter& filter = {});
    /// Another one in the place of a mesh, hidden until it is moved.
    void replace_mesh(uint32_t mesh, size_t vertices, std::span<const uint32_t> indices, MeshOf what,
                      const MeshFilter& filter = {});
    /// Before a mesh is moved the first time: its shape, by which its triangles are grouped, where it does
    /// not have it then.
    void shape_mesh(uint32_t mesh, std::span<const Vec3> positions);
    /// From now on edges meet those of meshes, as they do with own layers. Without, vertices alone meet them.
    void meet_edges();
    /// At the end of the next step, one a vertex. VFIT_ERROR_ARGUMENT for a wrong number or count.
    /// start: where it begins that step, whatever fraction of its way carry_along() leaves behind it; empty:
    /// where it was.
    void move_mesh(uint32_t mesh, std::span<const Vec3> positions, std::span<const Vec3> start = {});
    /// At both ends of the last look at contacts, the cloth crossed that prop.
    bool crosses_mesh(uint32_t mesh) const;
    /// It is not there until it is moved again.
    void hide_mesh(uint32_t mesh);
    /// From the next step on, of a mesh that has a filter. One a vertex of the piece.
    void set_mesh_mask(uint32_t mesh, std::span<const uint8_t> mask, size_t piece = 0);

    /// From the next step on: the fabric's limits are wider by that, one a vertex. What is worn over other
    /// garments is held further off the body than these limits were made for.
    void widen_limits(std::span<const float> by_m);

    /// From the next step on.
    void set_air(const Air& air);
    const Air& air() const;
    void set_quality(uint32_t substeps, float budget_ms);

    const std::vector<Vec3>& positions() const;
    const std::vector<Vec3>& normals() const;
    /// Mean strain of the edges at each vertex; 0: unstretched.
    const std::vector<float>& strain() const;
    /// Of each of the fabric's edges.
    const std::vector<float>& edge_strain() const;
    /// Of the body (and what else is met) against each vertex as it lies, Pa: what the threads and the weight
    /// of who is touched pull with against it, over the flat cloth's area. 0 for vertices that are moved by
    /// their targets, and without settings.pressure.
    const std::vector<float>& pressure() const;
    /// Of positions and velocities of a piece, bit by bit.
    uint64_t state_hash(size_t piece = 0) const;
    ClothStats stats(size_t piece = 0) const;
    /// Length of the last sub-step; before the first step that of the settings.
    float substep_s() const;
    const Fabric& fabric() const;

private:
    Cloth(std::shared_ptr<const Fabric> fabric, std::span<const ClothSettings> of_pieces,
          std::span<const Vec3> start, const TriangleContact* like, Jobs* jobs);
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace vfit
