#include "cloth/contact/self_contact.h"

namespace vfit {

namespace {

void copy(std::span<const Vec3> from, std::vector<Particle>& to) {
    for (size_t v = 0; v < from.size(); ++v) to[v].x = from[v];
}
void copy(const std::vector<Particle>& from, std::span<Vec3> to) {
    for (size_t v = 0; v < to.size(); ++v) to[v] = from[v].x;
}

}  // namespace

SelfContact::SelfContact(std::shared_ptr<const Fabric> fabric, float thickness_m,
                         std::span<const Vec3> positions, Jobs* jobs)
    : proximity_(positions, fabric->data().indices),
      contacts_(fabric, thickness_m, jobs),
      guard_(fabric->data()),
      begin_(fabric->vertex_count()),
      end_(fabric->vertex_count()) {}

void SelfContact::place(std::span<const Vec3> positions, Jobs& jobs) {
    copy(positions, end_);
    proximity_.find(end_, end_, contacts_.reach_m(), jobs);
    contacts_.fill(proximity_, end_, end_, {});
}

void SelfContact::part(std::span<Vec3> positions, Jobs& jobs) {
    copy(positions, end_);
    guard_.part(end_, proximity_, jobs);
    copy(end_, positions);
}

bool SelfContact::keep(std::span<const Vec3> begin, std::span<Vec3> end, Jobs& jobs) {
    copy(begin, begin_), copy(end, end_);
    const bool is_free = guard_.keep(begin_, end_, proximity_, contacts_.reach_m(), jobs);
    contacts_.fill(proximity_, begin_, end_, guard_.tangled());
    if (!guard_.moved().empty()) copy(end_, end);
    return is_free;
}

}  // namespace vfit
