#include "cloth/cloth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "body/mesh.h"
#include "cloth/base/rigid_motion.h"
#include "cloth/contact/triangle_contact.h"
#include "cloth/solver/particle_solver.h"
#include "core/clock.h"
#include "core/error.h"
#include "math/finite.h"

namespace vfit {

namespace {

// Kinetic over static friction of cotton on skin: 0.25/0.31 at the forearm, 0.79/0.90 at the chest (Temel
// 2022).
constexpr float kKineticShare = 0.84f;
// How fast a vertex that is already inside a collider comes out: brisk against the fastest body (about the
// speed of a walking foot), slow enough not to be shot away.
constexpr float kMaxDepenetration_m_s = 3.0f;
constexpr float kShortens_m_s = 0.12f;  // an edge that is longer than it may be
// What has been slower than that for so long, on a body that moves less than that in a step, sleeps. A swing
// is so slow only for an instant, where it turns round; single vertices may tremble in a contact.
constexpr float kStillMean_m_s = 0.002f, kStillMost_m_s = 0.05f, kStill_m = 2e-5f, kFallsAsleep_s = 0.5f;
constexpr float kFinestVirtual_m = 0.001f;
// Of the thickness, between a mesh's vertices or edges and the cloth: its own vertices keep all of it, so
// that few of the others are in contact.
constexpr float kMeshShare = 0.5f;
constexpr float kMinContactRate_hz = 60.0f;  // contacts with meshes are found as often as that, at least
// A sub-step in which a limb goes further stretches the triangles that it pulls along: what they pull on
// follows an edge a sub-step later. At 4 mm a hand that swings beside a skirt stretched it to 1.6 times its
// length and passed through it in one of three frames, at 1 mm in none. Off a prop cloth slides sooner at
// 1 mm. Contacts are found again on the way as well.
constexpr float kLimbWay_m = 0.001f, kPropWay_m = 0.004f, kIntervalWay_m = 0.02f;
constexpr float kMaxSubstepFactor = 8.0f;  // times those that the settings say
constexpr int kMinSubsteps = 4;            // from one look at contacts to the next
constexpr float kMeshAround_m =
    0.15f;  // about the cloth, in which meshes are looked for: a fast limb's way in a step
constexpr float kLatest = 0.1f;           // weight of the last step in the mean time of a sub-step
constexpr float kSubstepRate_hz = 60.0f;  // settings.substeps are per 1/60 s

// Putting on: frames of 1/60 s in which the cloth hangs, goes along into the pose (as fast as a leg steps)
// and settles, and the sub-steps of one. On the way half the usual ones do; the last frames take out the
// stretch that they leave. Damped so that hardly any speed outlives a second: a skirt that swings folds
// itself between the legs.
struct PutOnPhase {
    int frames, substeps;
};
constexpr PutOnPhase kHang{15, 4}, kMove{40, 4}, kSettle{10, 8};
constexpr float kPutOnDamping = 0.99f;
// After a change of lengths: what falls into its new folds should hang still within a second. A coat is a
// pendulum of 0.8 m, which no damping brings to rest faster than in 2 s; so its time runs twice as fast, in
// steps as short as ever: cloth that is pulled up a leg went through it in longer ones.
constexpr float kSettles_s = 0.8f, kSettlingDamping = 0.98f;
constexpr int kSettlingHaste = 2;

void check(const Air& air) {
    if (!finite(air.wind_m_s)) fail(VFIT_ERROR_ARGUMENT, "the wind is not finite");
    for (const float coefficient : {air.drag, air.lift})
        if (!finite(coefficient) || coefficient < 0.0f)
            fail(VFIT_ERROR_ARGUMENT, "a coefficient of drag or lift is ", coefficient);
}

void check_substeps(uint32_t substeps) {
    if (substeps == 0 || substeps > 1000)
        fail(VFIT_ERROR_ARGUMENT, "substeps must be 1..1000, is ", substeps);
}

void check(const ClothSettings& s) {
    check_substeps(s.substeps);
    if (!finite(s.gravity)) fail(VFIT_ERROR_ARGUMENT, "gravity is not finite");
    if (!finite(s.friction) || s.friction < 0.0f) fail(VFIT_ERROR_ARGUMENT, "friction is ", s.friction);
    if (!finite(s.self_friction) || s.self_friction < 0.0f)
        fail(VFIT_ERROR_ARGUMENT, "friction between layers is ", s.self_friction);
    if (!finite(s.damping) || s.damping < 0.0f || s.damping > 1.0f)
        fail(VFIT_ERROR_ARGUMENT, "damping must be 0..1, is ", s.damping);
    if (!finite(s.thickness_m) || s.thickness_m < 0.0f)
        fail(VFIT_ERROR_ARGUMENT, "thickness is ", s.thickness_m);
    if (!(s.carry_speed_m_s > 0.0f) || !(s.carry_way_m > 0.0f))  // may be infinite
        fail(VFIT_ERROR_ARGUMENT, "a jump is faster than ", s.carry_speed_m_s, " m/s, or further than ",
             s.carry_way_m, " m");
    if (!finite(s.inertia) || s.inertia < 0.0f || s.inertia > 1.0f)
        fail(VFIT_ERROR_ARGUMENT, "inertia must be 0..1, is ", s.inertia);
    if (!finite(s.budget_ms) || s.budget_ms < 0.0f)
        fail(VFIT_ERROR_ARGUMENT, "the budget is ", s.budget_ms, " ms");
    if (!finite(s.self_thickness_m) || s.self_thickness_m < 0.0f || s.self_thickness_m > 0.1f)
        fail(VFIT_ERROR_ARGUMENT, "the thickness between the cloth's own layers is ", s.self_thickness_m,
             " m");
    if (!finite(s.virtual_m) || (s.virtual_m != 0.0f && s.virtual_m < kFinestVirtual_m))
        fail(VFIT_ERROR_ARGUMENT, "the way between virtual particles is ", s.virtual_m, " m");
    check(s.air);
}

void check_points(std::span<const Vec3> points, uint32_t count, const char* what) {
    if (points.size() != count)
        fail(VFIT_ERROR_ARGUMENT, points.size(), " ", what, " for a garment of ", count, " vertices");
    float zero = 0.0f;  // times nothing, what is not finite is no number
    for (const Vec3& p : points) zero += (p.x + p.y + p.z) * 0.0f;
    if (zero == 0.0f) return;
    for (size_t i = 0; i < points.size(); ++i)
        if (!finite(points[i])) fail(VFIT_ERROR_DATA, what, " ", i, " is not finite");
}

void check_colliders(std::span<const Collider> colliders) {
    for (size_t i = 0; i < colliders.size(); ++i) {
        const Collider& c = colliders[i];
        const bool whole = finite(c.center) && finite(c.radius) &&
                           (!c.is_capsule() || (finite(c.center_b) && finite(c.radius_b)));
        if (!whole) fail(VFIT_ERROR_DATA, "collider ", i, " is not finite");
        if (c.radius < 0.0f || (c.is_capsule() && c.radius_b < 0.0f))
            fail(VFIT_ERROR_DATA, "collider ", i, " has a negative radius");
    }
}

/// The greatest way of any of these points.
float farthest(std::span<const Vec3> from, std::span<const Vec3> to) {
    float most2 = 0.0f;
    for (size_t i = 0; i < from.size(); ++i) {
        const Vec3 way = to[i] - from[i];
        most2 = std::max(most2, glm::dot(way, way));
    }
    return std::sqrt(most2);
}

/// FNV-1a over 32-bit words.
uint64_t hash(uint64_t state, const Vec3& v) {
    for (int k = 0; k < 3; ++k) {
        uint32_t bits;
        std::memcpy(&bits, &v[k], sizeof bits);
        state = (state ^ bits) * 0x100000001b3ull;
    }
    return state;
}

}  // namespace

ClothSettings ClothSettings::joined(std::span<const ClothSettings> of_pieces) {
    ClothSettings out = of_pieces.back();
    for (const ClothSettings& of : of_pieces) {
        out.substeps = std::max(out.substeps, of.substeps);
        out.thickness_m = std::max(out.thickness_m, of.thickness_m);
        out.pressure = out.pressure || of.pressure;
        out.sleeps = out.sleeps && of.sleeps;
    }
    return out;
}

struct Cloth::State {
    State(std::shared_ptr<const Fabric> f, std::span<const ClothSettings> of)
        : fabric(f),
          settings(ClothSettings::joined(of)),
          of_pieces(of.begin(), of.end()),
          solver(std::move(f), {settings.virtual_m, settings.pressure}) {}

    std::shared_ptr<const Fabric> fabric;
    ClothSettings settings;  // of all
    std::vector<ClothSettings> of_pieces;
    ParticleSolver solver;
    ColliderMotion colliders;
    std::vector<std::pair<size_t, size_t>> passing;       // pieces, through each other
    std::vector<uint32_t> collider_ends;                  // of each piece; empty: each meets all
    std::vector<ParticleSolver::PartContact> contact_of;  // of each part of the layout
    std::vector<ContactMesh> meshes;
    std::vector<std::vector<Vec3>> mesh_places;  // that they go to
    std::vector<std::vector<Vec3>> mesh_starts;  // that they come from; empty: where they were
    std::vector<Vec3> previous_targets;          // one a vertex, then one a backstop
    bool backstops_placed = false;               // previous_targets holds the backstops as well
    std::vector<float> limits_wider_m;           // one a vertex; empty: by nothing

    std::vector<Vec3> positions;    // what callers read
    std::vector<Vec3> before, now;  // with triangles: the same at the begin of the step, carried along; and
                                    // what the step made of it
    std::optional<TriangleContact> triangles;  // with own layers or props
    bool is_deformed = false;                  // bones made it jump, which may have made layers cross
    bool contacts_known = false;               // of where the cloth was placed
    bool certified = false;                    // layers do not cross, which is proven
    // The same, found when they are asked for.
    mutable std::vector<Vec3> normals;
    mutable std::vector<float> edge_strains, strains, pressures;
    mutable std::vector<Vec3> forces, pushes;
    mutable bool normals_known = false, strains_known = false;
    std::vector<float> inverse_rest;        // of an edge, 1/m
    std::vector<float> inverse_edge_count;  // of a vertex; 0: none
    float step_ms = 0.0f;
    float substep_ms = 0.0f;      // mean; 0: not known yet
    float substep_s = 0.0f;       // the last one's length; 0: there was none
    uint32_t substeps = 0;        // of the last step
    ParticleSolver::Ways ways;    // of the vertices in the last step
    float still_s = 0.0f;         // since the cloth last moved
    float settles_s = 0.0f;       // so long it comes to rest from other lengths, or once it was put on
    int haste = 1;                // steps in one, so long
    std::vector<Vec3> asleep_at;  // the targets at which it fell asleep; empty: it is awake
    bool lengths_are_new = true;  // it was put on, or came to its lengths
    bool limits_lengths = true;   // not while it is put on: it would be drawn through the body
    bool limits_give_way = true;  // as the fabric says, in these steps
    float carried = 0.0f;         // fraction of the body's motion in the next step that moved the cloth
    bool sleeps_on = false;       // after it was moved so

    bool stays_asleep(std::span<const Vec3> targets) const;
    void wake() { asleep_at.clear(), still_s = 0.0f; }
    void follow_fixed(float dt, std::span<const Vec3> targets);
    void meet_body(std::span<const Vec3> targets, std::span<const Collider> limbs);
    void look_at(const Interval& interval);
    void skip_targets(std::span<const Vec3> targets);
    float body_way() const;
    enum class Solids { skin, all };
    float way_within(Solids which) const;
    int substeps_for(float dt) const;
    int affordable(int wanted) const;
    void check_body(std::span<const Vec3> targets, std::span<const Collider> colliders) const;
    void check_mesh(uint32_t mesh, std::span<const Vec3> positions) const;
    void reset(std::span<const Vec3> start);
    void advance(float dt, int count, float damping, std::span<const Vec3> targets, Jobs& jobs,
                 const IntervalEnded& interval_ended = {});
    void advance_interval(float dt, int count, float damping, const Interval& interval,
                          std::span<const Vec3> targets, Jobs& jobs, const IntervalEnded& interval_ended);
    void rest_if_still(float dt, std::span<const Vec3> targets);
    void meet_triangles(const ContactMesh& mesh);
    LayerThickness layer_thickness() const;
    void find_triangles();
    void part_layers(Jobs& jobs);
    void keep_layers(float dt, Jobs& jobs);
    void find_contact_of_parts(float h);
    void publish();
    void find_normals() const;
    void find_strains() const;
    void find_pressures() const;
};

Cloth::Cloth(std::shared_ptr<const Fabric> fabric, const ClothSettings& settings, std::span<const Vec3> start,
             Jobs* jobs)
    : Cloth(std::move(fabric), std::span(&settings, 1), start, nullptr, jobs) {}

Cloth::Cloth(std::shared_ptr<const Fabric> fabric, std::span<const ClothSettings> of_pieces,
             std::span<const Vec3> start, const TriangleContact* like, Jobs* jobs) {
    if (!fabric) fail(VFIT_ERROR_ARGUMENT, "a cloth needs a fabric");
    if (of_pieces.size() != fabric->pieces().size())
        fail(VFIT_ERROR_ARGUMENT, of_pieces.size(), " settings for a fabric of ", fabric->pieces().size(),
             " pieces");
    for (const ClothSettings& settings : of_pieces) check(settings);
    state_ = std::make_unique<State>(fabric, of_pieces);
    State& s = *state_;
    const uint32_t n = fabric->vertex_count();
    const FabricData& data = fabric->data();
    s.positions.resize(n);
    s.previous_targets.resize(fabric->target_count());
    s.asleep_at.reserve(fabric->target_count());
    s.strains.resize(n);
    s.pressures.resize(n);
    if (s.settings.pressure) s.forces.resize(n), s.pushes.resize(n);
    s.edge_strains.resize(data.edges.size());
    s.inverse_edge_count.resize(n);
    for (const DistanceConstraint& e : data.edges) s.inverse_rest.push_back(1.0f / e.rest_m);
    for (const DistanceConstraint& e : data.edges)
        for (uint32_t v : {e.a, e.b}) s.inverse_edge_count[v] += 1.0f;
    for (float& count : s.inverse_edge_count) count = count > 0.0f ? 1.0f / count : 0.0f;
    if (like)
        s.triangles.emplace(*like, fabric, jobs);
    else if (const LayerThickness thickness = s.layer_thickness(); thickness.reach_m() > 0.0f)
        s.triangles.emplace(fabric, thickness, start.first(n), jobs);
    if (s.triangles) s.before.resize(n), s.now.resize(n);
    reset(start);
}

Cloth::~Cloth() = default;
Cloth::Cloth(Cloth&&) noexcept = default;
Cloth& Cloth::operator=(Cloth&&) noexcept = default;

Cloth Cloth::with_fabric(std::shared_ptr<const Fabric> fabric, Jobs* jobs) const {
    const State& s = *state_;
    if (!fabric || fabric->vertex_count() != s.fabric->vertex_count() ||
        fabric->target_count() != s.fabric->target_count())
        fail(VFIT_ERROR_ARGUMENT, "another fabric of a cloth must have as many vertices and targets");
    Cloth out(fabric, s.of_pieces, s.positions, s.triangles ? &*s.triangles : nullptr, jobs);
    State& o = *out.state_;
    o.settings = s.settings;
    o.colliders = s.colliders;
    o.collider_ends = s.collider_ends;
    o.passing = s.passing;
    o.meshes = s.meshes;
    o.mesh_places = s.mesh_places;
    o.mesh_starts.resize(s.mesh_starts.size());
    o.previous_targets = s.previous_targets;
    o.backstops_placed = s.backstops_placed;
    o.limits_wider_m = s.limits_wider_m;
    o.solver.widen_limits(o.limits_wider_m);
    return out;
}

void Cloth::reset(std::span<const Vec3> positions) {
    const Fabric& fabric = *state_->fabric;
    check_points(positions,
                 positions.size() == fabric.vertex_count() ? fabric.vertex_count() : fabric.target_count(),
                 "start positions");
    state_->reset(positions);
}

void Cloth::State::reset(std::span<const Vec3> start) {
    std::copy(start.begin(), start.end(), previous_targets.begin());
    backstops_placed = start.size() == previous_targets.size();
    solver.place(start);
    colliders.forget();
    for (ContactMesh& mesh : meshes) mesh.forget();
    contacts_known = certified = false, lengths_are_new = true;
    if (triangles) triangles->forget_meshes();
    carried = 0.0f;
    wake();
    publish();
}

std::vector<Vec3> Cloth::velocities() const {
    std::vector<Vec3> out;
    for (const uint32_t particle : state_->fabric->layout().particle_of)
        out.push_back(state_->solver.velocities()[particle].x);
    return out;
}

void Cloth::set_velocities(std::span<const Vec3> velocities) {
    check_points(velocities, state_->fabric->vertex_count(), "velocities");
    for (uint32_t v = 0; v < velocities.size(); ++v)
        state_->solver.place(v, state_->positions[v], velocities[v]);
}

void Cloth::put_on(std::span<const Vec3> start, const BodyOnItsWay& body, Jobs& jobs) {
    State& s = *state_;
    std::vector<Vec3> targets;
    std::vector<Collider> colliders;
    body(0.0f, targets, colliders);
    s.check_body(targets, colliders);
    reset(start);
    s.limits_lengths = false, s.limits_give_way = true;
    s.meet_body(targets, colliders);
    s.part_layers(jobs);
    const auto frame = [&](const PutOnPhase& phase, float share) {
        body(share, targets, colliders);
        s.check_body(targets, colliders);
        s.meet_body(targets, colliders);
        s.advance(1.0f / kSubstepRate_hz, phase.substeps, kPutOnDamping, targets, jobs);
    };
    for (int i = 0; i < kHang.frames; ++i) frame(kHang, 0.0f);
    for (int i = 1; i <= kMove.frames; ++i) frame(kMove, float(i) / float(kMove.frames));
    for (int i = 0; i < kSettle.frames; ++i) frame(kSettle, 1.0f);
    s.settles_s = kSettles_s, s.haste = 1;
    s.solver.rest();
    s.wake();
}

void Cloth::go_to(std::span<const Vec3> positions, Jobs& jobs) {
    constexpr int kParts = 10;  // of the way
    State& s = *state_;
    std::vector<Vec3> places(positions.begin(), positions.end());
    if (s.triangles && s.layer_thickness().reach_m() > 0.0f) {
        for (uint32_t i = 0; i < s.meshes.size(); ++i) s.triangles->hide_mesh(i);
        s.triangles->pass_each_other(true);
        s.before = s.positions;
        s.triangles->part(s.before, jobs);
        s.triangles->place(s.before, jobs);
        for (int i = 0; i < kParts; ++i) {
            for (size_t v = 0; v < s.now.size(); ++v)
                s.now[v] = glm::mix(s.before[v], positions[v], 1.0f / float(kParts - i));
            s.triangles->keep(s.before, s.now, jobs);
            s.before = s.now;
        }
        s.triangles->pass_each_other(false);
        std::copy(s.before.begin(), s.before.end(), places.begin());
    }
    reset(places);
}

void Cloth::come_to_lengths(const BodyOnItsWay& body, Jobs& jobs) {
    // The shorter a step, the softer is all that gives way in it (XPBD): at first cloth moves by a millimetre
    // or so between two looks at what it may meet, itself included. The last two take it out of the skin.
    constexpr int kSteps = 6, kGrowing = 4, kSubsteps = 10;
    constexpr float kShortest_s = 1.5e-4f, kLongest_s = 1.0f / 60.0f, kStopped = 1.0f;
    State& s = *state_;
    s.settles_s = kSettles_s, s.haste = kSettlingHaste;
    // In steps so short, what is not held firmly goes with the lengths.
    s.limits_lengths = true, s.limits_give_way = false;
    std::vector<Vec3> targets;
    std::vector<Collider> colliders;
    for (int i = 0; i < kSteps; ++i) {
        const float grown = std::min(1.0f, float(i) / float(kGrowing - 1));
        body(grown, targets, colliders);
        s.check_body(targets, colliders);
        s.meet_body(targets, colliders);
        if (i == 0) s.part_layers(jobs);
        s.advance(kShortest_s * std::pow(kLongest_s / kShortest_s, grown), kSubsteps, kStopped, targets,
                  jobs);
    }
    s.solver.rest();
    s.wake();
    s.lengths_are_new = true;
}

uint32_t Cloth::add_mesh(size_t vertices, std::span<const uint32_t> indices, std::span<const uint8_t> counts,
                         MeshOf what, const MeshFilter& filter) {
    if (!filter.category.empty() &&
        (filter.category.size() != vertices || filter.mask.size() != state_->fabric->vertex_count()))
        fail(VFIT_ERROR_ARGUMENT, "a filter has ", filter.category.size(), " categories for a mesh of ",
             vertices, " vertices, and ", filter.mask.size(), " masks for a cloth of ",
             state_->fabric->vertex_count());
    if (!counts.empty() && counts.size() != vertices)
        fail(VFIT_ERROR_ARGUMENT, counts.size(), " flags for a mesh of ", vertices, " vertices");
    state_->meshes.emplace_back(vertices, indices, counts, what, filter);
    state_->mesh_places.emplace_back(), state_->mesh_starts.emplace_back();
    state_->meet_triangles(state_->meshes.back());
    state_->wake();
    return uint32_t(state_->meshes.size()) - 1;
}

void Cloth::replace_mesh(uint32_t mesh, size_t vertices, std::span<const uint32_t> indices, MeshOf what,
                         const MeshFilter& filter) {
    State& s = *state_;
    if (mesh >= s.meshes.size()) fail(VFIT_ERROR_ARGUMENT, "there is no mesh ", mesh);
    s.meshes[mesh] = ContactMesh(vertices, indices, {}, what, filter);
    s.mesh_places[mesh].clear(), s.mesh_starts[mesh].clear();
    s.solver.forget_mesh(mesh);
    if (s.triangles) s.find_triangles();
    s.wake();
}

void Cloth::set_passing(size_t piece, size_t other, bool passing) {
    State& s = *state_;
    const size_t pieces = s.of_pieces.size();
    if (piece >= pieces || other >= pieces)
        fail(VFIT_ERROR_ARGUMENT, "there are ", pieces, " pieces, not ", piece, " and ", other);
    std::erase(s.passing, std::pair(piece, other));
    if (passing) s.passing.emplace_back(piece, other);
    if (s.triangles) s.triangles->set_passing(piece, other, passing);
}

void Cloth::set_collider_ends(std::span<const uint32_t> of_pieces) {
    if (!of_pieces.empty() && of_pieces.size() != state_->fabric->pieces().size())
        fail(VFIT_ERROR_ARGUMENT, of_pieces.size(), " ends of colliders for a fabric of ",
             state_->fabric->pieces().size(), " pieces");
    state_->collider_ends.assign(of_pieces.begin(), of_pieces.end());
}

void Cloth::meet_edges() {
    if (!state_->triangles) state_->find_triangles();
}

void Cloth::shape_mesh(uint32_t mesh, std::span<const Vec3> positions) {
    State& s = *state_;
    s.check_mesh(mesh, positions);
    s.meshes[mesh].accept(positions);
    if (s.triangles) s.triangles->move_mesh(mesh, positions);
    hide_mesh(mesh);
}

void Cloth::move_mesh(uint32_t mesh, std::span<const Vec3> positions, std::span<const Vec3> start) {
    State& s = *state_;
    s.check_mesh(mesh, positions);
    if (!start.empty()) s.check_mesh(mesh, start);
    if (s.mesh_places[mesh].empty()) s.wake();
    s.mesh_places[mesh].assign(positions.begin(), positions.end());
    s.mesh_starts[mesh].assign(start.begin(), start.end());
}

void Cloth::hide_mesh(uint32_t mesh) {
    if (mesh >= state_->meshes.size()) fail(VFIT_ERROR_ARGUMENT, "there is no mesh ", mesh);
    state_->mesh_places[mesh].clear(), state_->mesh_starts[mesh].clear();
    state_->solver.forget_mesh(mesh);
    state_->meshes[mesh].hide();
    if (state_->triangles) state_->triangles->hide_mesh(mesh);
    state_->wake();
}

bool Cloth::crosses_mesh(uint32_t mesh) const {
    return state_->triangles && state_->triangles->crosses_mesh(mesh);
}

void Cloth::set_mesh_mask(uint32_t mesh, std::span<const uint8_t> mask, size_t piece) {
    if (mesh >= state_->meshes.size()) fail(VFIT_ERROR_ARGUMENT, "there is no mesh ", mesh);
    const Fabric::Range vertices = state_->fabric->pieces().at(piece).vertices;
    const bool has_filter = !state_->meshes[mesh].filter().mask.empty();
    if (!has_filter || mask.size() != vertices.count())
        fail(VFIT_ERROR_ARGUMENT, mask.size(), " masks instead of ", has_filter ? vertices.count() : 0);
    state_->meshes[mesh].set_mask(mask, vertices.begin);
    if (state_->triangles) state_->triangles->set_mask(mesh, mask, vertices.begin);
    state_->wake();
}

void Cloth::widen_limits(std::span<const float> by_m) {
    if (by_m.size() != state_->fabric->vertex_count())
        fail(VFIT_ERROR_ARGUMENT, "limits of ", by_m.size(), " vertices instead of ",
             state_->fabric->vertex_count());
    state_->limits_wider_m.assign(by_m.begin(), by_m.end());
    state_->solver.widen_limits(by_m);
    state_->wake();
}

void Cloth::set_air(const Air& air) {
    check(air);
    if (air.wind_m_s != state_->settings.air.wind_m_s || air.drag != state_->settings.air.drag ||
        air.lift != state_->settings.air.lift)
        state_->wake();
    state_->settings.air = air;
}

const Air& Cloth::air() const { return state_->settings.air; }

void Cloth::set_quality(uint32_t substeps, float budget_ms) {
    check_substeps(substeps);
    if (!finite(budget_ms) || budget_ms < 0.0f) fail(VFIT_ERROR_ARGUMENT, "the budget is ", budget_ms, " ms");
    state_->settings.substeps = substeps;
    state_->settings.budget_ms = budget_ms;
}

void Cloth::step(float dt, std::span<const Vec3> skinned_targets, std::span<const Collider> colliders,
                 Jobs& jobs, const IntervalEnded& interval_ended) {
    State& s = *state_;
    if (!finite(dt) || dt < 0.0f) fail(VFIT_ERROR_ARGUMENT, "the step is ", dt, " s long");
    s.check_body(skinned_targets, colliders);
    if (dt == 0.0f) return;
    const Stopwatch watch;
    dt = std::clamp(dt, kMinStep_s, kMaxStep_s);
    s.limits_lengths = true, s.limits_give_way = true;
    if (s.settings.follows_fixed) s.follow_fixed(dt, skinned_targets);
    s.meet_body(skinned_targets, colliders);
    if (s.stays_asleep(skinned_targets)) {
        s.substeps = 0;
        s.step_ms = float(watch.ms());
        return;
    }
    if (!s.asleep_at.empty()) s.wake();
    if (s.triangles && std::exchange(s.lengths_are_new, false)) s.triangles->accept_lengths(s.positions);
    const bool settles = s.settles_s > 0.0f, is_first = s.settles_s == kSettles_s;
    if (settles) s.settles_s -= dt;
    const int wanted = s.substeps_for(dt);
    int times = settles && !is_first ? s.haste : 1;  // the first picture is waited for
    const int affordable = s.affordable(times * wanted), substeps = std::min(wanted, affordable);
    if (affordable < times * wanted) times = 1;  // haste is what a budget spares first
    int done = 0;
    for (; done < times && s.asleep_at.empty(); ++done) {
        if (done > 0) s.look_at({});  // the body stands where it arrived
        s.advance(dt, substeps, settles ? std::max(s.settings.damping, kSettlingDamping) : s.settings.damping,
                  skinned_targets, jobs, interval_ended);
    }
    s.substeps = uint32_t(substeps * done);
    s.substep_s = dt / float(substeps);
    s.step_ms = float(watch.ms());
    const float substep_ms = s.step_ms / float(s.substeps);
    s.substep_ms = s.substep_ms == 0.0f ? substep_ms : s.substep_ms + kLatest * (substep_ms - s.substep_ms);
}

void Cloth::State::meet_body(std::span<const Vec3> targets, std::span<const Collider> limbs) {
    colliders.accept(limbs, settings.thickness_m);
    for (size_t i = 0; i < meshes.size(); ++i) {
        if (mesh_places[i].empty()) continue;
        meshes[i].accept(mesh_places[i]);
        if (carried > 0.0f) meshes[i].skip(carried);
        if (triangles) triangles->move_mesh(uint32_t(i), mesh_places[i]);
    }
    if (carried > 0.0f) {
        skip_targets(targets), colliders.skip(carried);
        if (triangles) triangles->skip(carried);
    }
    for (uint32_t i = 0; i < meshes.size(); ++i) {
        if (mesh_starts[i].empty()) continue;
        meshes[i].start_at(mesh_starts[i]);
        if (triangles) triangles->start_mesh(i, mesh_starts[i]);
        mesh_starts[i].clear();
    }
    carried = 0.0f;
    look_at({});
}

void Cloth::State::look_at(const Interval& interval) {
    colliders.look_at(interval);
    if (meshes.empty()) return;
    Vec3 low, high;
    solver.bounds(low, high);
    for (ContactMesh& mesh : meshes) mesh.look_at(interval, low - kMeshAround_m, high + kMeshAround_m);
    if (triangles) triangles->look_at(interval);
}

/// Targets begin the step as far on their way as the cloth was moved.
void Cloth::State::skip_targets(std::span<const Vec3> targets) {
    for (size_t i = 0; i < targets.size(); ++i)
        previous_targets[i] = glm::mix(previous_targets[i], targets[i], carried);
    for (const uint32_t v : fabric->kinematic_vertices()) previous_targets[v] = positions[v];
    if (carried < 1.0f) return;
    if (sleeps_on && !asleep_at.empty())
        asleep_at.assign(targets.begin(), targets.end());
    else
        wake();
}

void Cloth::carry_along(const CarriedAlong& by) {
    State& s = *state_;
    by.check(s.fabric->vertex_count());
    by.move(*s.fabric, s.solver);
    s.publish();
    s.is_deformed = s.is_deformed || (by.fraction >= 1.0f && !by.rigid);
    s.carried = by.fraction;
    if (by.fraction >= 1.0f) s.contacts_known = false;  // their normals do not turn with it
    s.sleeps_on = by.keeps_rest(s.settings.gravity, s.settings.air);
}

/// The body's motion as the rigid one that fits the pinned vertices; velocities only turn.
void Cloth::State::follow_fixed(float dt, std::span<const Vec3> targets) {
    const std::vector<uint32_t>& fixed = fabric->kinematic_vertices();
    BodyWay way{INFINITY, 0.0f, 0.0f};
    for (const uint32_t v : fixed) {
        const float own_m = glm::distance(previous_targets[v], targets[v]);
        way = {std::min(way.min_m, own_m), std::max(way.whole_m, own_m), 0.0f};
    }
    const float unfelt = settings.is_jump(way, dt) ? 1.0f : 1.0f - settings.inertia;
    if (unfelt == 0.0f || fixed.empty() || (!asleep_at.empty() && way.whole_m <= kStill_m)) return;
    solver.carry(fit_rigid_motion(fixed, previous_targets, targets).part(unfelt));
    publish();
    carried = unfelt;
    sleeps_on = false;
}

/// Of colliders and meshes in this step, at most.
float Cloth::State::body_way() const {
    float most = colliders.greatest_way();
    for (const ContactMesh& mesh : meshes) most = std::max(most, mesh.greatest_way());
    return most;
}

bool Cloth::State::stays_asleep(std::span<const Vec3> targets) const {
    return !asleep_at.empty() && body_way() <= kStill_m && farthest(asleep_at, targets) <= kStill_m;
}

/// Greatest displacement of two parts of solids against each other in this step. A common translation does
/// not count.
float Cloth::State::way_within(Solids which) const {
    Bounds ways;
    for (const ContactMesh& mesh : meshes)
        if (mesh.what() == MeshOf::solid || (which == Solids::all && mesh.what() == MeshOf::prop))
            ways.add(mesh.ways());
    if (ways.low.x > ways.high.x) return 0.0f;  // no solid is near
    if (colliders.count() > 0) ways.add(colliders.ways());
    return glm::length(ways.high - ways.low);
}

int Cloth::State::substeps_for(float dt) const {
    const float own = dt * kSubstepRate_hz * float(settings.substeps);
    const float by_way =
        std::max(way_within(Solids::skin) / kLimbWay_m, way_within(Solids::all) / kPropWay_m);
    return std::max(1, int(std::lround(std::clamp(by_way, own, kMaxSubstepFactor * own))));
}

/// Of so many, those that are expected to be done within the budget; at least one.
int Cloth::State::affordable(int wanted) const {
    if (settings.budget_ms == 0.0f || substep_ms == 0.0f) return wanted;
    return std::clamp(int(settings.budget_ms / substep_ms), 1, wanted);
}

void Cloth::State::check_body(std::span<const Vec3> targets, std::span<const Collider> colliders) const {
    check_points(targets, fabric->target_count(), "skinned targets");
    check_colliders(colliders);
}

void Cloth::State::check_mesh(uint32_t mesh, std::span<const Vec3> positions) const {
    if (mesh >= meshes.size()) fail(VFIT_ERROR_ARGUMENT, "there is no mesh ", mesh);
    if (positions.size() != meshes[mesh].vertex_count())
        fail(VFIT_ERROR_ARGUMENT, positions.size(), " places for a mesh of ", meshes[mesh].vertex_count(),
             " vertices");
}

/// The body has been met.
void Cloth::State::advance(float dt, int count, float damping, std::span<const Vec3> targets, Jobs& jobs,
                           const IntervalEnded& interval_ended) {
    const float by_way = std::min(way_within(Solids::all) / kIntervalWay_m, float(count / kMinSubsteps)),
                parts = std::max(dt * kMinContactRate_hz - 1e-3f, by_way);
    const int intervals = meshes.empty() ? 1 : std::clamp(int(std::ceil(parts)), 1, count);
    if (triangles && std::exchange(is_deformed, false)) part_layers(jobs);
    if (!backstops_placed) {
        const uint32_t vertices = fabric->vertex_count();
        std::copy(targets.begin() + vertices, targets.end(), previous_targets.begin() + vertices);
        backstops_placed = true;
    }
    for (int i = 0; i < intervals; ++i) {
        const int first = i * count / intervals, end = (i + 1) * count / intervals;
        const Interval interval{float(first) / float(count), float(end) / float(count)};
        if (intervals > 1) look_at(interval);
        advance_interval(dt * float(end - first) / float(count), end - first, damping, interval, targets,
                         jobs, interval_ended);
        rest_if_still(dt * float(end - first) / float(count), targets);
    }
    std::copy(targets.begin(), targets.end(), previous_targets.begin());
    colliders.arrive();
    for (ContactMesh& mesh : meshes) mesh.arrive();
    if (triangles) triangles->arrive();
}

void Cloth::State::advance_interval(float dt, int count, float damping, const Interval& interval,
                                    std::span<const Vec3> targets, Jobs& jobs,
                                    const IntervalEnded& interval_ended) {
    if (triangles) {
        before = positions;
        if (!contacts_known) triangles->place(positions, jobs);
        contacts_known = true;
    }
    const float h = dt / float(count);
    find_contact_of_parts(h);
    solver.advance({dt, count, settings.gravity, settings.air, std::pow(1.0f - damping, h), contact_of,
                    settings.thickness_m, limits_give_way, previous_targets, targets, interval, colliders,
                    meshes, triangles ? &*triangles : nullptr, settings.self_friction},
                   jobs);
    publish();
    if (interval_ended) interval_ended(interval.to, dt);
    if (triangles) {
        keep_layers(dt, jobs);
        if (!triangles->moved().empty()) {
            const ParticleSolver::Ways solved = ways;
            publish();
            ways = {std::max(solved.greatest_m, ways.greatest_m), std::max(solved.rms_m, ways.rms_m)};
        }
    }
}

void Cloth::State::find_contact_of_parts(float h) {
    const std::vector<Fabric::Piece>& pieces = fabric->pieces();
    contact_of.clear();
    for (size_t i = 0; i < pieces.size(); ++i) {
        const float friction = of_pieces[i].friction;
        const bool all = collider_ends.empty();
        const size_t first = all || i == 0 ? 0 : colliders.count_before(collider_ends[i - 1]),
                     end = all ? colliders.count() : colliders.count_before(collider_ends[i]);
        contact_of.resize(pieces[i].parts.end,
                          {{friction, friction * kKineticShare, kMaxDepenetration_m_s * h},
                           uint32_t(first),
                           uint32_t(end)});
    }
}

LayerThickness Cloth::State::layer_thickness() const {
    LayerThickness out;
    for (const ClothSettings& of : of_pieces) out.own_m.push_back(of.self_thickness_m);
    if (of_pieces.size() > 1) out.between_m = settings.thickness_m;
    return out;
}

void Cloth::State::meet_triangles(const ContactMesh& mesh) {
    if (!triangles) return;
    triangles->add_mesh(mesh.vertex_count(), mesh.indices(), kMeshShare * settings.thickness_m, mesh.what(),
                        mesh.filter());
}

/// Builds the triangle contact again for the present meshes.
void Cloth::State::find_triangles() {
    before.resize(positions.size()), now.resize(positions.size());
    triangles.emplace(fabric, layer_thickness(), positions);
    for (const auto& [piece, other] : passing) triangles->set_passing(piece, other, true);
    for (uint32_t i = 0; i < meshes.size(); ++i) {
        meet_triangles(meshes[i]);
        if (!mesh_places[i].empty()) triangles->move_mesh(i, mesh_places[i]);
    }
    triangles->arrive();
    contacts_known = certified = false, lengths_are_new = true;
}

void Cloth::State::part_layers(Jobs& jobs) {
    if (!triangles) return;
    solver.copy_positions(now);
    triangles->part(now, jobs);
    for (uint32_t v = 0; v < now.size(); ++v)
        if (now[v] != positions[v])
            solver.place(v, now[v], solver.velocities()[fabric->layout().particle_of[v]].x);
    contacts_known = false;
    publish();
}

void Cloth::State::keep_layers(float dt, Jobs& jobs) {
    now = positions;
    const bool has_layers = std::all_of(of_pieces.begin(), of_pieces.end(),
                                        [](const ClothSettings& of) { return of.self_thickness_m > 0.0f; });
    certified = triangles->keep(before, now, jobs,
                                limits_lengths && settings.limits_lengths ? std::optional(kShortens_m_s * dt)
                                                                          : std::nullopt) &&
                has_layers;
    for (const uint32_t v : triangles->moved()) {
        const uint32_t particle = fabric->layout().particle_of[v];
        const Vec3 way = triangles->is_in_zone(v) ? now[v] - before[v] : now[v] - solver.places()[particle].x,
                   velocity = triangles->is_in_zone(v) ? Vec3(0.0f) : solver.velocities()[particle].x;
        solver.place(v, now[v], velocity + way / dt);
    }
}

void Cloth::State::rest_if_still(float dt, std::span<const Vec3> targets) {
    const bool still = ways.rms_m <= kStillMean_m_s * dt && ways.greatest_m <= kStillMost_m_s * dt &&
                       body_way() <= kStill_m && farthest(previous_targets, targets) <= kStill_m;
    still_s = still ? still_s + dt : 0.0f;
    if (!settings.sleeps || still_s < kFallsAsleep_s) return;
    // Their velocities stay: by them contact knows who is drawn to the body how fast, when it wakes.
    asleep_at.assign(targets.begin(), targets.end());
}

void Cloth::State::publish() {
    ways = solver.copy_positions(positions);
    normals_known = strains_known = false;
}

void Cloth::State::find_normals() const {
    if (normals_known) return;
    compute_normals(positions, fabric->data().indices, normals);
    normals_known = true;
}

void Cloth::State::find_strains() const {
    if (strains_known) return;
    const std::vector<DistanceConstraint>& edges = fabric->data().edges;
    std::fill(strains.begin(), strains.end(), 0.0f);
    for (size_t i = 0; i < edges.size(); ++i) {
        const DistanceConstraint& e = edges[i];
        edge_strains[i] = glm::length(positions[e.a] - positions[e.b]) * inverse_rest[i] - 1.0f;
        strains[e.a] += edge_strains[i];
        strains[e.b] += edge_strains[i];
    }
    for (size_t i = 0; i < strains.size(); ++i) strains[i] *= inverse_edge_count[i];
    strains_known = true;
}

/// Who is pushed by the body pushes back with what its threads and its weight pull with. That is taken from
/// how far the threads are stretched: what a sub-step's single pass moves a light vertex by, when it works
/// against a stiff thread, is far less.
void Cloth::State::find_pressures() const {
    const FabricData& data = fabric->data();
    std::fill(forces.begin(), forces.end(), Vec3(0.0f));
    for (const DistanceConstraint& e : data.edges) {
        const Vec3 way = positions[e.b] - positions[e.a];
        const float length = glm::length(way);
        const Vec3 pull = way * ((length - e.rest_m) / std::max(e.compliance_m_n * length, 1e-12f));
        forces[e.a] += pull;
        forces[e.b] -= pull;
    }
    solver.copy_pushes(pushes);
    for (const Fabric::Piece& piece : fabric->pieces())
        for (uint32_t v = piece.vertices.begin; v < piece.vertices.end; ++v) {
            const float push = glm::length(pushes[v]);
            pressures[v] = 0.0f;
            if (!(push > 0.0f) || data.inverse_mass[v] == 0.0f) continue;
            const Vec3 force = forces[v] + settings.gravity / data.inverse_mass[v];
            const float against = -glm::dot(force, pushes[v]) / push;
            // Mass over density is area.
            pressures[v] = std::max(0.0f, against) * data.inverse_mass[v] * piece.density_kg_m2;
        }
}

const std::vector<Vec3>& Cloth::positions() const { return state_->positions; }
const std::vector<Vec3>& Cloth::normals() const {
    state_->find_normals();
    return state_->normals;
}
const std::vector<float>& Cloth::strain() const {
    state_->find_strains();
    return state_->strains;
}
const std::vector<float>& Cloth::edge_strain() const {
    state_->find_strains();
    return state_->edge_strains;
}
const std::vector<float>& Cloth::pressure() const {
    if (state_->settings.pressure) state_->find_pressures();
    return state_->pressures;
}
float Cloth::substep_s() const {
    return state_->substep_s > 0.0f ? state_->substep_s
                                    : 1.0f / (kSubstepRate_hz * float(state_->settings.substeps));
}
const Fabric& Cloth::fabric() const { return *state_->fabric; }

uint64_t Cloth::state_hash(size_t piece) const {
    const Fabric::Piece& of = state_->fabric->pieces().at(piece);
    uint64_t out = 0xcbf29ce484222325ull;
    for (const Vec3& place : of.vertices.of(state_->positions)) out = hash(out, place);
    const ParticleLayout& layout = state_->fabric->layout();
    for (const ParticleLayout::Part& part : of.parts.of(layout.parts))
        for (uint32_t i = part.begin; i < part.moving_end; ++i)
            if (layout.vertex_of[i] != ParticleLayout::kNobody)
                out = hash(out, state_->solver.velocities()[i].x);
    return out;
}

ClothStats Cloth::stats(size_t piece) const {
    const State& s = *state_;
    const Fabric::Piece& of = s.fabric->pieces().at(piece);
    s.find_strains();
    ClothStats out;
    out.vertex_count = of.vertices.count();
    out.simulated_count = of.simulated_count;
    out.constraint_count = of.constraint_count;
    out.step_ms = s.step_ms;
    out.substeps = s.substeps;
    out.certified = s.certified;
    const std::span<const float> strains = of.edges.of(s.edge_strains);
    if (strains.empty()) return out;
    // A histogram finds the percentile without sorting a copy.
    constexpr float kBin = 0.001f;
    constexpr int kBins = 2000, kZero = 1000;
    std::array<uint32_t, kBins> histogram{};
    double sum = 0.0;
    for (size_t i = 0; i < strains.size(); ++i) {
        const float strain = strains[i];
        sum += std::abs(strain);
        // A side of a millimetre that is two long is no tear: contact a thickness away moves it by more.
        constexpr float kShortest_m = 0.02f;
        const float inverse_rest = s.inverse_rest[size_t(strains.data() - s.edge_strains.data()) + i];
        out.strain_max = std::max(out.strain_max, strain / std::max(kShortest_m * inverse_rest, 1.0f));
        const float bin = std::floor(strain / kBin) + kZero;
        ++histogram[bin > 0.0f ? size_t(std::min(bin, float(kBins - 1))) : 0];
    }
    out.strain_mean = float(sum / double(strains.size()));
    const auto rank = uint64_t(0.99 * double(strains.size()));
    uint64_t below = 0;
    int bin = 0;
    while (bin < kBins - 1 && (below += histogram[size_t(bin)]) <= rank) ++bin;
    out.strain_p99 = std::min(out.strain_max, float(bin - kZero + 1) * kBin);
    return out;
}

}  // namespace vfit
