#include "cloth/solver/particle_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "cloth/contact/contact_culling.h"
#include "core/phases.h"

namespace vfit {

namespace {

// Bends that take back no more than this share of a fold in a sub-step are so soft that they may push in
// every second one, with twice the force: the impulse is the same, at half the work.
constexpr float kSoft = 0.5f;

// So fast do layers of the cloth part that are closer than its thickness: pushed out at once, they would fly.
constexpr float kParts_m_s = 1.0f;
constexpr int kRefreshedEvery = 2;  // sub-steps: contacts' closest points

// Passes over the edges in a second, at least: with fewer, a limb that kicks stretches the few triangles that
// it meets until it is through between their corners.
constexpr float kLeastPasses_hz = 240.0f;
int passes(float h) { return std::max(1, int(std::ceil(kLeastPasses_hz * h - 1e-3f))); }

float share(const ParticleSolver::Step& step, int substep) { return float(substep) / float(step.substeps); }
float substep_s(const ParticleSolver::Step& step) { return step.dt / float(step.substeps); }
Vec3 half_fall(const ParticleSolver::Step& step) { return step.gravity * (0.5f * substep_s(step)); }

struct Way {
    Vec3 from, way;
};
Way way_of(const ParticleSolver::Step& step, uint32_t target) {
    const Vec3 from = step.from[target], way = step.to[target] - from;
    return {from + way * step.interval.from, way * (step.interval.to - step.interval.from)};
}

}  // namespace

ParticleSolver::ParticleSolver(std::shared_ptr<const Fabric> fabric, const Options& options)
    : fabric_(std::move(fabric)) {
    if (options.virtual_m > 0.0f) virtual_ = std::make_unique<VirtualParticles>(*fabric_, options.virtual_m);
    const ParticleLayout& layout = fabric_->layout();
    for (Particles* list : {&places_, &starts_, &velocities_}) list->resize(layout.count());
    if (options.with_pushes) pushed_.resize(layout.count());
    for (uint32_t i = 0; i < layout.group_count(); ++i) {
        Gains& gains = gains_.emplace_back();
        gains.bends.resize(fabric_->bend_batches()[i].joints.size());
        gains.edges.resize(fabric_->edge_batches()[i].joints.size());
        gains.hinges.resize(fabric_->hinge_batches()[i].hinges.size());
    }
    parts_.resize(layout.parts.size());
}

void ParticleSolver::place(std::span<const Vec3> vertices) {
    const ParticleLayout& layout = fabric_->layout();
    for (uint32_t i = 0; i < layout.count(); ++i)
        if (layout.vertex_of[i] != ParticleLayout::kNobody) places_[i].x = vertices[layout.vertex_of[i]];
    for (Part& part : parts_) part.touched.clear();
    rest();
}

void ParticleSolver::place(uint32_t vertex, const Vec3& at, const Vec3& velocity) {
    const uint32_t particle = fabric_->layout().particle_of[vertex];
    places_[particle].x = at;
    velocities_[particle].x = velocity;
}

void ParticleSolver::forget_mesh(size_t mesh) {
    for (Part& part : parts_)
        if (mesh < part.touched.size()) part.touched[mesh].clear();
}

void ParticleSolver::widen_limits(std::span<const float> by_m) {
    const ParticleLayout& layout = fabric_->layout();
    limits_wider_m_.assign(by_m.empty() ? 0 : layout.count(), 0.0f);
    for (size_t v = 0; v < by_m.size(); ++v) {
        const uint32_t particle = layout.particle_of[v];
        limits_wider_m_[particle / kLanes * kLanes + lane_of(particle % kLanes)] = by_m[v];
    }
}

void ParticleSolver::rest() { std::fill(velocities_.begin(), velocities_.end(), Particle()); }

void ParticleSolver::carry(const RigidMotion& motion) {
    for (Particle& p : places_) p.x = motion.point(p.x);
    for (Particle& v : velocities_) v.x = motion.direction(v.x);
}

ParticleSolver::Ways ParticleSolver::copy_positions(std::span<Vec3> out) const {
    const std::vector<uint32_t>& particle_of = fabric_->layout().particle_of;
    float most2 = 0.0f, sum2 = 0.0f;
    for (size_t v = 0; v < out.size(); ++v) {
        const Vec3 place = places_[particle_of[v]].x, way = place - out[v];
        const float way2 = glm::dot(way, way);
        most2 = std::max(most2, way2);
        sum2 += way2;
        out[v] = place;
    }
    return {std::sqrt(most2), std::sqrt(sum2 / float(std::max<size_t>(out.size(), 1)))};
}

void ParticleSolver::copy_pushes(std::span<Vec3> out) const {
    for (size_t v = 0; v < out.size(); ++v) out[v] = pushed_[fabric_->layout().particle_of[v]].x;
}

Moving ParticleSolver::moving(uint32_t part) {
    const ParticleLayout::Part& p = fabric_->layout().parts[part];
    return {&places_[p.begin], &starts_[p.begin], &velocities_[p.begin], p.moving_end - p.begin};
}

void ParticleSolver::bounds(Vec3& low, Vec3& high) const {
    low = Vec3(INFINITY), high = Vec3(-INFINITY);
    for (const ParticleLayout::Part& part : fabric_->layout().parts)
        for (uint32_t i = part.begin; i < part.moving_end; ++i)
            low = glm::min(low, places_[i].x), high = glm::max(high, places_[i].x);
}

/// Parts, then cuts, then what the cloth does to itself, then parts ...: a part ends one sub-step and begins
/// the next, up to what its own constraints do.
void ParticleSolver::advance(const Step& step, Jobs& jobs) {
    const auto parts = uint32_t(parts_.size());
    set_gains(substep_s(step), step.substeps);
    std::fill(pushed_.begin(), pushed_.end(), Particle());
    step.colliders.sweep(0.0f, 1.0f, swept_step_);
    for (uint32_t part = 0; part < parts; ++part) fill_up(part);
    if (step.air.drag != 0.0f || step.air.lift != 0.0f)
        parallel_for(jobs, parts,
                     [&](uint32_t part) { blow(step.air, step.dt, *fabric_, part, places_, velocities_); });
    if (virtual_) virtual_->find_near(places_, velocities_, step.dt, swept_step_);
    enum class Phase { parts, cuts, refresh_contacts, solve_contacts, virtual_particles };
    std::array<Phase, 5> cycle{Phase::parts, Phase::cuts};
    uint32_t phases = 2;
    if (step.contacts && step.contacts->contact_count() > 0)
        cycle[phases++] = Phase::refresh_contacts, cycle[phases++] = Phase::solve_contacts;
    if (virtual_) cycle[phases++] = Phase::virtual_particles;
    const auto items = [&](uint32_t phase) -> uint32_t {
        switch (cycle[phase % phases]) {
            case Phase::parts:
            case Phase::cuts: return parts;
            case Phase::refresh_contacts:
                return int(phase / phases) % kRefreshedEvery == 0 ? step.contacts->share_count() : 1;
            default: return 1;
        }
    };
    if (step.contacts) {
        const size_t with_meshes = fabric_->layout().count() + step.contacts->mesh_particle_count();
        if (places_.size() < with_meshes) places_.resize(with_meshes), starts_.resize(with_meshes);
    }
    const ContactPush push{kParts_m_s * substep_s(step), step.contact_friction};
    run_phases(jobs, phases * uint32_t(step.substeps) + 1, parts, items, [&](uint32_t phase, uint32_t item) {
        const int substep = int(phase / phases);
        switch (cycle[phase % phases]) {
            case Phase::parts:
                if (phase == 0)
                    begin_part(step, item);
                else
                    end_part(step, substep - 1, item);
                if (substep < step.substeps) begin_substep(step, substep, item);
                return;
            case Phase::cuts:
                if (item + 1 < parts) return solve_group(substep, parts + item);
                step.colliders.sweep(share(step, substep), share(step, substep + 1), swept_);
                if (step.contacts)
                    step.contacts->place_meshes(share(step, substep), share(step, substep + 1), starts_,
                                                places_);
                return;
            case Phase::refresh_contacts:
                if (substep % kRefreshedEvery == 0) step.contacts->refresh(places_, item);
                return;
            case Phase::solve_contacts: return step.contacts->solve(push, starts_, places_);
            case Phase::virtual_particles:
                return virtual_->solve(swept_, step.contact_of[0].settings, starts_, places_, pushed_);
        }
    });
}

void ParticleSolver::set_gains(float h, int substeps) {
    const bool alternate = substeps % 2 == 0;
    if (h == gains_h_ && alternate == may_alternate_) return;
    gains_h_ = h;
    may_alternate_ = alternate;
    const auto find_bend_gains = [&](float force) {
        float most = 0.0f;
        for (size_t i = 0; i < gains_.size(); ++i)
            most = std::max(most, find_gains(fabric_->bend_batches()[i].masses, h, force, gains_[i].bends));
        return most;
    };
    // Beside hinges, distances over folds only keep folds from closing.
    const bool fold_limits = !fabric_->data().hinges.empty();
    bend_every_ = alternate && (find_bend_gains(2.0f) <= kSoft || fold_limits) ? 2 : 1;
    if (bend_every_ == 1) find_bend_gains(1.0f);
    for (size_t i = 0; i < gains_.size(); ++i) {
        find_gains(fabric_->edge_batches()[i].masses, h, 1.0f, gains_[i].edges);
        const HingeBatches& hinges = fabric_->hinge_batches()[i];
        find_hinge_gains(hinges.hinges, hinges.masses, h, alternate ? kSoft : 0.0f, gains_[i].hinges);
    }
}

void ParticleSolver::solve_group(int substep, uint32_t group) {
    if (substep % bend_every_ == 0)
        solve_distances(fabric_->bend_batches()[group].joints, gains_[group].bends, places_.data());
    solve_hinges(fabric_->hinge_batches()[group].hinges, gains_[group].hinges, substep % 2 == 0,
                 places_.data());
    for (int i = passes(gains_h_); i > 0; --i)
        solve_distances(fabric_->edge_batches()[group].joints, gains_[group].edges, places_.data());
}

void ParticleSolver::begin_part(const Step& step, uint32_t part) {
    place_balls(
        step, part, fabric_->backstop_runs()[part],
        [&](const BallRun& ball, size_t lane) { return ball.radius_m[lane] + step.thickness_m; },
        parts_[part].backstops);
    place_balls(
        step, part, fabric_->limit_runs()[part],
        [&](const BallRun& ball, size_t lane) {
            const float wider_m = limits_wider_m_.empty() ? 0.0f : limits_wider_m_[ball.run * kLanes + lane];
            return ball.radius_m[lane] + wider_m;
        },
        parts_[part].limits);
    place_fixed(step, part);
    const Moving m = moving(part);
    parts_[part].planes.clear();
    const ParticleLayout& layout = fabric_->layout();
    const uint32_t begin = layout.parts[part].begin;
    parts_[part].touched.resize(step.meshes.size());
    for (size_t i = 0; i < step.meshes.size(); ++i)
        step.meshes[i].find_planes({m, std::span(layout.vertex_of).subspan(begin), step.dt, step.thickness_m},
                                   parts_[part].near_runs, parts_[part].touched[i], parts_[part].planes);
    if (step.meshes.size() > 1) {
        // Stable, without the room that std::stable_sort allocates.
        std::vector<RunPlanes>& planes = parts_[part].planes;
        for (uint32_t i = 0; i < planes.size(); ++i) planes[i].order = i;
        std::sort(planes.begin(), planes.end(), [](const RunPlanes& a, const RunPlanes& b) {
            return std::pair(a.run, a.order) < std::pair(b.run, b.order);
        });
    }
    const std::span<const SweptCapsule> colliders = step.colliders_of(part, swept_step_);
    reserve(parts_[part].may_meet, m.count, colliders.size());
    cull({m.places, m.count}, {m.velocities, m.count}, step.dt, colliders, parts_[part].may_meet);
    predict(m, half_fall(step), substep_s(step));
}

/// Particles that only fill up the last run lie with the first of it, so that it stays small.
void ParticleSolver::fill_up(uint32_t part) {
    const ParticleLayout& layout = fabric_->layout();
    const ParticleLayout::Part& p = layout.parts[part];
    for (uint32_t i = p.moving_end; i-- > p.begin && layout.vertex_of[i] == ParticleLayout::kNobody;) {
        places_[i] = places_[i / kLanes * kLanes];
        velocities_[i] = Particle();
    }
}

template <typename Radius>
void ParticleSolver::place_balls(const Step& step, uint32_t part, std::span<const BallRun> runs,
                                 const Radius& radius_m, std::vector<RunBalls>& out) const {
    const uint32_t first_run = fabric_->layout().parts[part].begin / uint32_t(kLanes);
    const float h = substep_s(step);
    out.resize(runs.size());
    for (size_t i = 0; i < runs.size(); ++i) {
        RunBalls& ball = out[i];
        ball.run = runs[i].run - first_run;
        for (size_t k = 0; k < kLanes; ++k) {
            const auto [from, way] = way_of(step, runs[i].target[k]);
            ball.x[k] = from.x, ball.y[k] = from.y, ball.z[k] = from.z;
            ball.way_x[k] = way.x, ball.way_y[k] = way.y, ball.way_z[k] = way.z;
            ball.radius_m[k] = runs[i].radius_m[k] > 0.0f ? radius_m(runs[i], k) : 0.0f;
            ball.pull_m[k] =
                step.limits_give_way ? runs[i].pull_m_s2[k] * h * h : std::numeric_limits<float>::infinity();
        }
    }
}

void ParticleSolver::place_fixed(const Step& step, uint32_t part) {
    const ParticleLayout& layout = fabric_->layout();
    const ParticleLayout::Part& p = layout.parts[part];
    Part& own = parts_[part];
    own.fixed.clear(), own.fixed_ways.clear();
    for (uint32_t i = p.moving_end; i < p.end && layout.vertex_of[i] != ParticleLayout::kNobody; ++i) {
        const uint32_t v = layout.vertex_of[i];
        const auto [from, way] = way_of(step, v);
        own.fixed.push_back(Particle{from});
        own.fixed_ways.push_back(Particle{way});
    }
}

void ParticleSolver::begin_substep(const Step& step, int substep, uint32_t part) {
    const ParticleLayout::Part& p = fabric_->layout().parts[part];
    const float to = share(step, substep + 1);
    const Part& own = parts_[part];
    for (size_t i = 0; i < own.fixed.size(); ++i) {
        const size_t at = p.moving_end + i;
        if (step.contacts || virtual_) starts_[at] = places_[at];
        places_[at].x = own.fixed[i].x + own.fixed_ways[i].x * to;
    }
    solve_group(substep, part);
}

void ParticleSolver::end_part(const Step& step, int substep, uint32_t part) {
    const ParticleLayout::Part& p = fabric_->layout().parts[part];
    SubstepEnd end{};
    end.moving = moving(part);
    end.anchors = places_.data();
    end.anchor_index = std::span(fabric_->tether_anchors()).subspan(p.begin, end.moving.count);
    end.tether_m = std::span(fabric_->tether_lengths()).subspan(p.begin, end.moving.count);
    end.backstops = parts_[part].backstops;
    end.limits = parts_[part].limits;
    end.planes = parts_[part].planes;
    end.from = share(step, substep);
    end.to = share(step, substep + 1);
    end.colliders = step.colliders_of(part, swept_);
    end.may_meet = &parts_[part].may_meet;
    end.contact = step.contact_of[part].settings;
    end.half_fall = half_fall(step);
    end.h = substep_s(step);
    end.keep = step.keep;
    end.last = substep + 1 == step.substeps;
    end.pushed = pushed_.empty() ? nullptr : &pushed_[p.begin];
    end_substep(end);
}

}  // namespace vfit
