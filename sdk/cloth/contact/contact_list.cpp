#include "cloth/contact/contact_list.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

// Beyond the thickness, for what acceleration brings closer in a step. Two garments are held apart by what
// holds each of them to the body, and come closer faster: with 1 mm a standing vest trembles over a shirt.
constexpr float kMargin_m = 0.001f, kMarginBetween_m = 0.002f;
constexpr float kSideways = 0.25f;   // of the way past each other: the normal may turn so far
constexpr float kEdgeShare = 0.5f;   // of the thickness, between two edges
constexpr float kFlatShare = 0.45f;  // of the shortest way along edges, which is longer than the straight one
constexpr float kFlatReach = 1.0f / kFlatShare;
constexpr float kAlongSide = 0.3f;  // cosine: beside that, a way does not tell on which side of a mesh one is
constexpr float kOn_m = 1e-6f;      // closer, a way has no direction

Vec3 unit(const Vec3& v) { return v / std::max(glm::length(v), 1e-20f); }

std::array<uint32_t, 4> vertices_of(const PrimitivePairs& pairs, size_t lane) {
    return {pairs.at[0][lane], pairs.at[1][lane], pairs.at[2][lane], pairs.at[3][lane]};
}

template <typename Body>
void for_own_pairs(const Proximity::Triangle& a, const Proximity::Triangle& b, Body&& body) {
    for (uint32_t j = 0; j < 3; ++j) {
        if (a.own_vertices >> j & 1)
            body(PairKind::vertex_face, std::array{a.vertex[j], b.vertex[0], b.vertex[1], b.vertex[2]});
        if (b.own_vertices >> j & 1)
            body(PairKind::vertex_face, std::array{b.vertex[j], a.vertex[0], a.vertex[1], a.vertex[2]});
        if (!(a.own_edges >> j & 1)) continue;
        for (uint32_t k = 0; k < 3; ++k)
            if (b.own_edges >> k & 1)
                body(PairKind::edge_edge,
                     std::array{a.vertex[j], a.vertex[(j + 1) % 3], b.vertex[k], b.vertex[(k + 1) % 3]});
    }
}

}  // namespace

ContactList::ContactList(std::shared_ptr<const Fabric> fabric, const LayerThickness& thickness, Jobs* jobs)
    : fabric_(std::move(fabric)),
      thickness_(thickness),
      piece_of_(fabric_->piece_of()),
      inverse_mass_(fabric_->data().inverse_mass),
      flat_(fabric_->data(), kFlatReach * *std::max_element(thickness.own_m.begin(), thickness.own_m.end()),
            jobs) {}

void ContactList::add_mesh(size_t vertices, float keeps_m, MeshOf what) {
    meshes_.push_back({keeps_m, what});
    inverse_mass_.resize(inverse_mass_.size() + vertices, 0.0f);
    slots_.resize(inverse_mass_.size(), 0);
    slot_rounds_.resize(inverse_mass_.size(), 0);
}

float ContactList::reach_m(float keeps_m) { return keeps_m + kMargin_m; }

float LayerThickness::reach_m() const {
    const float most_m = *std::max_element(own_m.begin(), own_m.end());
    return std::max(most_m > 0.0f ? most_m + kMargin_m : 0.0f,
                    between_m > 0.0f ? between_m + kMarginBetween_m : 0.0f);
}

bool ContactList::reaches(float distance_m, float kept_m, const std::array<uint32_t, 4>& v,
                          uint32_t surface) const {
    const bool between = surface == Proximity::kSelf && piece_of_[v[0]] != piece_of_[v[3]];
    return distance_m <= kept_m + (between ? kMarginBetween_m : kMargin_m);
}

float ContactList::keeps_m(PairKind kind, const std::array<uint32_t, 4>& v, uint32_t surface) const {
    if (surface != Proximity::kSelf) return meshes_[surface - 1].keeps_m;
    const uint8_t piece = piece_of_[v[0]];
    const float keeps_m = piece == piece_of_[v[3]] ? thickness_.own_m[piece] : thickness_.between_m;
    return kind == PairKind::edge_edge ? kEdgeShare * keeps_m : keeps_m;
}

void ContactList::fill(const Proximity& proximity, std::span<const Particle> begin,
                       std::span<const Particle> end, std::span<const uint8_t> tangled) {
    tangled_ = tangled;
    for (OfKind& of : of_kind_) of.contacts.clear();
    for (Candidates& of : candidates_) of.count = 0, of.sides.clear();
    proximity.for_close(
        [&](const Proximity::Pair& pair, uint32_t surface) { add_candidates(pair, surface, end); });
    for (const PairKind kind : {PairKind::vertex_face, PairKind::edge_edge}) {
        Candidates& of = candidates_[size_t(kind)];
        of.fill_up();
        find_closest(std::span(of.pairs).first((of.count + kLanes - 1) / kLanes), kind == PairKind::edge_edge,
                     begin.data(), end.data(), kSideways);
        add(kind, of, end);
    }
    ++round_;
    mesh_vertices_.clear();
    for (OfKind& of : of_kind_) pack(of);
}

/// Vertices of the cloth and triangles of a solid are left out: planes keep those apart (ContactMesh).
void ContactList::add_candidates(const Proximity::Pair& pair, uint32_t surface,
                                 std::span<const Particle> end) {
    const auto is_fixed = [&](uint32_t v) { return inverse_mass_[v] == 0.0f; };
    const bool of_cloth = surface == Proximity::kSelf;
    if (surface != Proximity::kSelf && std::all_of(pair.first->vertex, pair.first->vertex + 3, is_fixed))
        return;
    // Outwards of a mesh, or of the earlier one of two pieces.
    const auto normal_of = [&](const Proximity::Triangle& t) {
        const uint32_t* v = t.vertex;
        return unit(glm::cross(end[v[1]].x - end[v[0]].x, end[v[2]].x - end[v[0]].x));
    };
    Vec3 outward(0.0f);
    const uint32_t first = pair.first->vertex[0], second = pair.second->vertex[0];
    if (!of_cloth || piece_of_[second] < piece_of_[first])
        outward = normal_of(*pair.second);
    else if (piece_of_[first] < piece_of_[second])
        outward = -normal_of(*pair.first);
    for_own_pairs(*pair.first, *pair.second, [&](PairKind kind, const std::array<uint32_t, 4>& v) {
        const bool of_first = of_cloth ? piece_of_[v[0]] == piece_of_[first] : v[0] < fabric_->vertex_count();
        if (of_cloth || kind == PairKind::edge_edge || !of_first)
            candidates_[size_t(kind)].add(v, {of_first ? outward : -outward, surface});
    });
}

void ContactList::Candidates::add(const std::array<uint32_t, 4>& vertices, const Side& side) {
    if (count == pairs.size() * kLanes) pairs.emplace_back();
    for (size_t k = 0; k < 4; ++k) pairs[count / kLanes].at[k][count % kLanes] = vertices[k];
    sides.push_back(side);
    ++count;
}

void ContactList::Candidates::fill_up() {
    for (size_t i = count; i % kLanes != 0; ++i)
        for (size_t k = 0; k < 4; ++k) pairs[i / kLanes].at[k][i % kLanes] = pairs[count / kLanes].at[k][0];
}

void ContactList::add(PairKind kind, const Candidates& of, std::span<const Particle> end) {
    for (size_t i = 0; i < of.count; ++i) {
        const PrimitivePairs& pairs = of.pairs[i / kLanes];
        const uint32_t surface = of.sides[i].surface;
        const size_t lane = i % kLanes;
        const float comes_m =
            is_solid(surface) ? std::min(pairs.comes_m[lane], kMaxWayPastSolid_m) : pairs.comes_m[lane];
        const std::array<uint32_t, 4> v = vertices_of(pairs, lane);
        if (reaches(pairs.distance_m[lane] - comes_m, keeps_m(kind, v, surface), v, surface))
            add(kind, pairs, lane, of.sides[i], end);
    }
}

void ContactList::add(PairKind kind, const PrimitivePairs& pairs, size_t lane, const Side& side,
                      std::span<const Particle> end) {
    const bool edges = kind == PairKind::edge_edge;
    const float distance = pairs.distance_m[lane];
    if (distance < kOn_m) return;
    const std::array<uint32_t, 4> v = vertices_of(pairs, lane);
    const auto is_moved = [&](uint32_t vertex) { return inverse_mass_[vertex] > 0.0f; };
    if (std::none_of(v.begin(), v.end(), is_moved)) return;
    const bool is_own = side.surface == Proximity::kSelf;
    const auto second = v.begin() + (edges ? 2 : 1);
    const auto is_tangled = [&](uint32_t vertex) { return tangled_[vertex] != 0; };
    const bool crosses = is_own && !tangled_.empty() && std::any_of(v.begin(), second, is_tangled) &&
                         std::any_of(second, v.end(), is_tangled);
    if (crosses && piece_of_[v[0]] == piece_of_[v[3]]) return;
    float kept_m = keeps_m(kind, v, side.surface);
    if (is_own) kept_m = std::min(kept_m, flat_limit_m(kind, v));
    if (kept_m <= 0.0f || !reaches(distance - pairs.comes_m[lane], kept_m, v, side.surface)) return;
    Vec3 normal = Vec3(pairs.way[0][lane], pairs.way[1][lane], pairs.way[2][lane]) / distance;
    if (!is_own || crosses) {
        const float along = glm::dot(normal, side.way);
        if (std::abs(along) < kAlongSide) return;
        if (along < 0.0f && is_solid(side.surface)) return;  // planes bring it out
        if (along < 0.0f) normal = -normal;                  // it is on the wrong side
    }
    Contact contact{v, normal, kept_m, 0.0f};
    if (!edges && std::max({pairs.weight[1][lane], pairs.weight[2][lane], pairs.weight[3][lane]}) < 0.0f) {
        const Vec3 face = glm::cross(end[v[2]].x - end[v[1]].x, end[v[3]].x - end[v[1]].x);
        contact.side = glm::dot(face, normal) >= 0.0f ? 1.0f : -1.0f;
    }
    of_kind_[size_t(kind)].contacts.push_back(contact);
}

uint32_t ContactList::particle_of(uint32_t vertex) {
    if (vertex < fabric_->vertex_count()) return fabric_->layout().particle_of[vertex];
    if (slot_rounds_[vertex] != round_) {
        slot_rounds_[vertex] = round_;
        slots_[vertex] = fabric_->layout().count() + uint32_t(mesh_vertices_.size());
        mesh_vertices_.push_back(vertex);
    }
    return slots_[vertex];
}

void ContactList::place_meshes(std::span<const Particle> begin, std::span<const Particle> end, float from,
                               float to, Particles& starts, Particles& places) const {
    const uint32_t first = fabric_->layout().count();
    for (size_t i = 0; i < mesh_vertices_.size(); ++i) {
        const Vec3 &a = begin[mesh_vertices_[i]].x, way = end[mesh_vertices_[i]].x - a;
        starts[first + i].x = a + way * from;
        places[first + i].x = a + way * to;
    }
}

/// How far apart the two may be held: less than where the cloth lies flat.
float ContactList::flat_limit_m(PairKind kind, const std::array<uint32_t, 4>& v) const {
    float min_m = INFINITY;
    const size_t second = kind == PairKind::edge_edge ? 2 : 1;
    for (size_t i = 0; i < second; ++i)
        for (size_t k = second; k < 4; ++k) min_m = std::min(min_m, flat_.between(v[i], v[k]));
    return kFlatShare * min_m;
}

/// Lanes of a batch far apart in the list: what they push is seldom the same.
void ContactList::pack(OfKind& of) {
    of.batches.resize((of.contacts.size() + kLanes - 1) / kLanes);
    const auto spare = uint32_t(fabric_->layout().parts[0].spare() * sizeof(Particle));
    for (size_t i = 0; i < of.batches.size(); ++i) {
        ContactBatch& batch = of.batches[i];
        for (size_t k = 0; k < kLanes; ++k) {
            const size_t at = k * of.batches.size() + i;
            const bool is_there = at < of.contacts.size();
            const Contact contact = is_there ? of.contacts[at] : Contact{{}, Vec3(0.0f), -1.0f, 0.0f};
            for (size_t j = 0; j < 4; ++j) {
                const uint32_t v = contact.vertices[j];
                batch.at[j][k] = is_there ? particle_of(v) * uint32_t(sizeof(Particle)) : spare;
                batch.inverse_mass[j][k] = is_there ? inverse_mass_[v] : 0.0f;
            }
            for (int j = 0; j < 3; ++j) batch.normal[j][k] = contact.normal[j];
            batch.distance_m[k] = contact.distance_m, batch.side[k] = contact.side;
        }
    }
}

void ContactList::refresh(const Particles& places, uint32_t share) {
    for (size_t kind = 0; kind < 2; ++kind) {
        const std::span<ContactBatch> all(of_kind_[kind].batches);
        const size_t first = share * all.size() / kShares, end = (share + 1) * all.size() / kShares;
        refresh_contacts(all.subspan(first, end - first), kind == size_t(PairKind::edge_edge), places.data());
    }
}

void ContactList::solve(const ContactPush& push, const Particles& starts, Particles& places) const {
    for (const OfKind& of : of_kind_) solve_contacts(of.batches, push, starts.data(), places.data());
}

}  // namespace vfit
