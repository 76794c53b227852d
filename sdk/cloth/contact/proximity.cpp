#include "cloth/contact/proximity.h"

#include <algorithm>
#include <utility>

namespace vfit {

Proximity::Proximity(std::span<const Vec3> positions, std::span<const uint32_t> indices, float reach_m,
                     std::vector<uint8_t> piece_of)
    : cloth_(positions, indices), piece_of_(std::move(piece_of)), vertex_count_(positions.size()) {
    surfaces_.emplace_back().is_shown = reach_m > 0.0f;
    surfaces_.back().reach_m = reach_m;
}

Proximity::Proximity(const Proximity& other)
    : cloth_(other.cloth_),
      piece_of_(other.piece_of_),
      passes_(other.passes_),
      surfaces_(other.surfaces_),
      vertex_count_(other.vertex_count_) {
    for (Surface& surface : surfaces_) surface.all = {}, surface.of_marked = {};  // of the other's triangles
}

void Proximity::add_mesh(size_t vertices, std::span<const uint32_t> indices, float reach_m, MeshOf what,
                         const MeshFilter& filter) {
    Surface& surface = surfaces_.emplace_back();
    surface.category.assign(filter.category.begin(), filter.category.end());
    surface.mask.assign(filter.mask.begin(), filter.mask.end());
    surface.reach_m = reach_m, surface.is_shown = false, surface.what = what;
    surface.first_vertex = uint32_t(vertex_count_);
    surface.indices.assign(indices.begin(), indices.end());
    vertex_count_ += vertices;
}

void Proximity::show_mesh(uint32_t mesh, std::span<const Vec3> positions) {
    Surface& surface = surfaces_[mesh + 1];
    if (!surface.patches) surface.patches.emplace(positions, surface.indices, surface.first_vertex);
    surface.indices.clear();
    surface.is_shown = true;
}

void Proximity::hide_mesh(uint32_t mesh) {
    Surface& surface = surfaces_[mesh + 1];
    surface.is_shown = false;
    for (Classified* of : {&surface.all, &surface.of_marked}) of->pairs.clear(), of->batches.clear();
}

bool Proximity::Surface::meets(const Pair& pair) const {
    uint8_t own = 0;
    for (const uint32_t v : pair.first->vertex) own |= mask[v];
    for (const uint32_t v : pair.second->vertex)
        if ((own & category[v - first_vertex]) == 0) return false;
    return true;
}

void Proximity::find(std::span<const Particle> begin, std::span<const Particle> end, Jobs& jobs) {
    cloth_.move(begin, end, jobs);
    only_marked_ = false, is_complete_ = are_classified_ = true;
    for (Surface& surface : surfaces_) {
        if (surface.what == MeshOf::solid) continue;
        surface.all.pairs.clear();
        if (surface.is_shown) {
            if (surface.patches) surface.patches->move(begin, end, jobs);
            look_for_missed(surface);
            cloth_.find_pairs(surface.patches ? *surface.patches : cloth_, surface.reach_m, surface.all.pairs,
                              jobs);
            filter(surface, 0);
        }
        classify_all(surface.all, surface, begin, end, jobs);
    }
}

/// Does what moves past that surface move so fast that pairs may be missed?
void Proximity::look_for_missed(const Surface& surface) {
    const Bounds own = cloth_.way(), other = surface.patches ? surface.patches->way() : own;
    const Vec3 way = glm::max(own.high - other.low, other.high - own.low);
    is_complete_ = is_complete_ && std::max({way.x, way.y, way.z}) <= kMaxWay_m;
}

void Proximity::filter(Surface& surface, size_t first) const {
    if (surface.what ? surface.category.empty() : piece_of_.empty()) return;
    std::vector<Pair>& pairs = surface.all.pairs;
    const auto is_left_out = [&](const Pair& pair) {
        return surface.what ? !surface.meets(pair) : !pieces_meet(pair);
    };
    pairs.erase(std::remove_if(pairs.begin() + std::ptrdiff_t(first), pairs.end(), is_left_out), pairs.end());
}

bool Proximity::pieces_meet(const Pair& pair) const {
    const uint8_t piece = piece_of_[pair.first->vertex[0]], other = piece_of_[pair.second->vertex[0]];
    return (passes_[piece] >> other & 1) == 0 && !(all_pass_ && piece != other);
}

void Proximity::find_again(std::span<const uint8_t> marked, std::span<const Particle> begin,
                           std::span<const Particle> end) {
    cloth_.move_marked(marked, begin, end, moved_);
    const auto is_moved = [&](const Triangle* t) {
        return std::binary_search(moved_.begin(), moved_.end(), t->patch);
    };
    for (Surface& surface : surfaces_) {
        if (surface.what == MeshOf::solid || !surface.is_shown) continue;
        std::vector<Pair>& pairs = surface.all.pairs;
        std::erase_if(pairs, [&](const Pair& pair) {
            return is_moved(pair.first) || (!surface.patches && is_moved(pair.second));
        });
        const size_t kept = pairs.size();
        cloth_.find_pairs_of(moved_, surface.patches ? *surface.patches : cloth_, surface.reach_m, pairs);
        filter(surface, kept);
        look_for_missed(surface);
    }
    are_classified_ = false;
}

void Proximity::find_close(std::span<const Particle> begin, std::span<const Particle> end, Jobs& jobs) {
    for (Surface& surface : surfaces_) {
        if (surface.what == MeshOf::solid) {
            surface.all.pairs.clear();
            if (surface.is_shown) {
                surface.patches->move(begin, end, jobs);
                cloth_.find_pairs_with_solid(*surface.patches, end, surface.reach_m, surface.all.pairs, jobs);
                filter(surface, 0);
            }
        } else if (are_classified_) {
            continue;
        }
        classify_all(surface.all, surface, begin, end, jobs);
    }
    are_classified_ = true;
}

void Proximity::find_uncertain_of(std::span<const uint8_t> marked, std::span<const Particle> begin,
                                  std::span<const Particle> end, Jobs& jobs) {
    const auto has_marked = [&](const Triangle* t) {
        return marked[t->vertex[0]] || marked[t->vertex[1]] || marked[t->vertex[2]];
    };
    only_marked_ = true;
    for (Surface& surface : surfaces_) {
        surface.of_marked.pairs.clear(), surface.of_marked.batches.clear();
        if (surface.what == MeshOf::solid) continue;
        for (const Pair& pair : surface.all.pairs)
            if (has_marked(pair.first) || has_marked(pair.second)) surface.of_marked.pairs.push_back(pair);
        classify_all(surface.of_marked, surface, begin, end, jobs);
    }
}

void Proximity::classify_all(Classified& of, const Surface& surface, std::span<const Particle> begin,
                             std::span<const Particle> end, Jobs& jobs) {
    constexpr uint32_t kBatchesOfAJob = 256;
    of.batches.resize((of.pairs.size() + kLanes - 1) / kLanes);
    const auto count = uint32_t(of.batches.size());
    parallel_for(jobs, (count + kBatchesOfAJob - 1) / kBatchesOfAJob, [&](uint32_t share) {
        const uint32_t first = share * kBatchesOfAJob, last = std::min(first + kBatchesOfAJob, count);
        for (uint32_t i = first; i < last; ++i)
            for (size_t k = 0; k < kLanes; ++k) {
                const Pair& pair = of.pairs[std::min(i * kLanes + k, of.pairs.size() - 1)];
                for (size_t corner = 0; corner < 3; ++corner) {
                    of.batches[i].first[corner][k] = pair.first->vertex[corner];
                    of.batches[i].second[corner][k] = pair.second->vertex[corner];
                }
            }
        classify(std::span(of.batches).subspan(first, last - first), begin.data(), end.data(),
                 surface.reach_m, surface.what != MeshOf::solid);
    });
    if (const size_t in_last = of.pairs.size() % kLanes; in_last != 0) {
        of.batches.back().uncertain &= uint8_t((1u << in_last) - 1);
        of.batches.back().close &= uint8_t((1u << in_last) - 1);
    }
}

}  // namespace vfit
