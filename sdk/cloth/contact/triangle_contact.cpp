#include "cloth/contact/triangle_contact.h"

#include <algorithm>

namespace vfit {

namespace {

void copy(std::span<const Vec3> from, std::span<Particle> to) {
    for (size_t v = 0; v < from.size(); ++v) to[v].x = from[v];
}
void copy(std::span<const Particle> from, std::span<Vec3> to) {
    for (size_t v = 0; v < to.size(); ++v) to[v] = from[v].x;
}
bool has_pieces(const Fabric& fabric) { return fabric.pieces().size() > 1; }

}  // namespace

TriangleContact::TriangleContact(std::shared_ptr<const Fabric> fabric, const LayerThickness& thickness,
                                 std::span<const Vec3> positions, Jobs* jobs)
    : cloth_vertices_(fabric->vertex_count()),
      thickness_(thickness),
      proximity_(positions, fabric->data().indices, thickness.reach_m(),
                 has_pieces(*fabric) ? fabric->piece_of() : std::vector<uint8_t>()),
      contacts_(fabric, thickness, jobs),
      guard_(*fabric),
      begin_(cloth_vertices_),
      end_(cloth_vertices_) {
    for (size_t piece = 0; has_pieces(*fabric) && piece < thickness_.own_m.size(); ++piece)
        if (thickness_.own_m[piece] <= 0.0f) set_passing(piece, piece, true);
}

TriangleContact::TriangleContact(const TriangleContact& other, std::shared_ptr<const Fabric> fabric,
                                 Jobs* jobs)
    : cloth_vertices_(other.cloth_vertices_),
      thickness_(other.thickness_),
      proximity_(other.proximity_),
      contacts_(fabric, thickness_, jobs),
      guard_(*fabric),
      begin_(cloth_vertices_),
      end_(cloth_vertices_),
      meshes_(other.meshes_) {
    for (uint32_t i = 0; i < meshes_.size(); ++i) make_room_for(meshes_[i]), hide_mesh(i);
}

void TriangleContact::add_mesh(size_t vertices, std::span<const uint32_t> indices, float keeps_m, MeshOf what,
                               const MeshFilter& filter) {
    proximity_.add_mesh(vertices, indices, ContactList::reach_m(keeps_m), what, filter);
    meshes_.push_back({begin_.size(), vertices, keeps_m, what});
    make_room_for(meshes_.back());
}

void TriangleContact::make_room_for(const Mesh& mesh) {
    contacts_.add_mesh(mesh.vertices, mesh.keeps_m, mesh.what);
    guard_.add_mesh(mesh.vertices, mesh.what);
    begin_.resize(mesh.first_vertex + mesh.vertices), end_.resize(begin_.size());
    from_.resize(begin_.size() - cloth_vertices_), to_.resize(from_.size());
}

void TriangleContact::move_mesh(uint32_t number, std::span<const Vec3> end) {
    Mesh& mesh = meshes_[number];
    proximity_.show_mesh(number, end);
    const auto first = std::ptrdiff_t(mesh.first_vertex - cloth_vertices_);
    if (!mesh.is_known) std::copy(end.begin(), end.end(), from_.begin() + first);
    mesh.is_known = true;
    std::copy(end.begin(), end.end(), to_.begin() + first);
}

void TriangleContact::hide_mesh(uint32_t number) {
    proximity_.hide_mesh(number);
    if (meshes_[number].is_known) contacts_.fill(proximity_, begin_, end_, guard_.tangled());
    meshes_[number].is_known = false;
}

void TriangleContact::start_mesh(uint32_t number, std::span<const Vec3> positions) {
    const auto first = std::ptrdiff_t(meshes_[number].first_vertex - cloth_vertices_);
    std::copy(positions.begin(), positions.end(), from_.begin() + first);
}

void TriangleContact::skip(float fraction) {
    for (size_t i = 0; i < from_.size(); ++i) from_[i] = glm::mix(from_[i], to_[i], fraction);
}

void TriangleContact::look_at(const Interval& interval) {
    for (size_t i = 0; i < from_.size(); ++i) {
        const Vec3 way = to_[i] - from_[i];
        begin_[cloth_vertices_ + i].x = from_[i] + way * interval.from;
        end_[cloth_vertices_ + i].x = from_[i] + way * interval.to;
    }
}

void TriangleContact::place(std::span<const Vec3> positions, Jobs& jobs) {
    copy(positions, end_);
    copy(positions, begin_);
    guard_.forget();
    proximity_.find(end_, end_, jobs);
    proximity_.find_close(end_, end_, jobs);
    contacts_.fill(proximity_, end_, end_, {});
}

void TriangleContact::part(std::span<Vec3> positions, Jobs& jobs) {
    copy(positions, end_);
    guard_.part(end_, pieces_meet_, proximity_, jobs);
    copy(end_, positions);
}

void TriangleContact::accept_lengths(std::span<const Vec3> positions) {
    copy(positions, begin_);
    guard_.accept_lengths(begin_);
}

bool TriangleContact::keep(std::span<const Vec3> begin, std::span<Vec3> end, Jobs& jobs,
                           std::optional<float> shortens_m) {
    copy(begin, begin_), copy(end, end_);
    const bool is_free = guard_.keep(begin_, end_, proximity_, jobs, shortens_m);
    proximity_.find_close(begin_, end_, jobs);
    contacts_.fill(proximity_, begin_, end_, guard_.tangled());
    if (!guard_.moved().empty()) copy(end_, end);
    return is_free;
}

}  // namespace vfit
