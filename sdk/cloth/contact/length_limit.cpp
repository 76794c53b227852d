#include "cloth/contact/length_limit.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace vfit {

namespace {

constexpr int kPasses = 30;
constexpr float kMaxLengths = 1.0f + LengthLimit::kMaxStrain,
                kMaxContactLengths = 1.0f + LengthLimit::kMaxContactStrain;

}  // namespace

LengthLimit::LengthLimit(const Fabric& fabric) : first_(fabric.vertex_count() + 1, 0) {
    const std::vector<float>& inverse_mass = fabric.data().inverse_mass;
    for (const DistanceConstraint& e : fabric.data().edges) {
        const float a = inverse_mass[e.a], b = inverse_mass[e.b];
        if (a + b == 0.0f) continue;
        edges_.push_back({e.a, e.b, e.rest_m, kMaxContactLengths * e.rest_m, a / (a + b), b / (a + b)});
        ++first_[e.a + 1], ++first_[e.b + 1];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    edges_at_.resize(2 * edges_.size());
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    for (uint32_t i = 0; i < edges_.size(); ++i)
        for (const uint32_t v : {edges_[i].a, edges_[i].b}) edges_at_[next[v]++] = i;
    is_next_.resize(edges_.size(), 0), is_moved_.resize(fabric.vertex_count(), 0);
    pass_.reserve(edges_.size()), next_.reserve(edges_.size()), moved_.reserve(fabric.vertex_count());
}

void LengthLimit::accept(std::span<const Particle> at) {
    is_accepted_ = true;
    for (Edge& edge : edges_)
        edge.most_m = std::max(kMaxLengths * edge.rest_m, glm::distance(at[edge.a].x, at[edge.b].x));
}

std::span<const uint32_t> LengthLimit::keep(std::span<const Particle> begin, std::span<Particle> end,
                                            float shortens_m) {
    forget_moved();
    for (uint32_t i = 0; i < edges_.size(); ++i) {
        Edge& edge = edges_[i];
        if (const float lowest_m = kMaxLengths * edge.rest_m; is_accepted_ && edge.most_m > lowest_m)
            edge.most_m = std::clamp(glm::distance(begin[edge.a].x, begin[edge.b].x), lowest_m, edge.most_m);
        if (glm::distance(end[edge.a].x, end[edge.b].x) > edge.most_m) next_.push_back(i), is_next_[i] = 1;
    }
    return run({begin, end, {}, shortens_m, false});
}

std::span<const uint32_t> LengthLimit::keep_about(std::span<const uint32_t> vertices,
                                                  std::span<const uint8_t> stays,
                                                  std::span<const Particle> begin, std::span<Particle> end,
                                                  float shortens_m) {
    forget_moved();
    for (const uint32_t v : vertices) look_about(v);
    return run({begin, end, stays, shortens_m, true});
}

std::span<const uint32_t> LengthLimit::run(const Step& step) {
    for (int pass = 0; pass < kPasses && !next_.empty(); ++pass) {
        std::swap(pass_, next_);
        next_.clear();
        for (const uint32_t i : pass_) is_next_[i] = 0;
        for (const uint32_t i : pass_) shorten(edges_[i], step);
    }
    for (const uint32_t i : next_) is_next_[i] = 0;
    next_.clear();
    return moved_;
}

void LengthLimit::shorten(const Edge& edge, const Step& step) {
    Vec3 &a = step.end[edge.a].x, &b = step.end[edge.b].x;
    const float length_m = glm::distance(a, b),
                most_m = step.after_contact ? std::max(edge.most_m, kMaxContactLengths * edge.rest_m)
                                            : edge.most_m;
    if (length_m <= most_m) return;
    const float before_m = glm::distance(step.begin[edge.a].x, step.begin[edge.b].x),
                limit_m = std::max(most_m, before_m - step.shortens_m);
    if (length_m <= limit_m) return;
    const auto stays = [&](uint32_t v) { return !step.stays.empty() && step.stays[v] != 0; };
    const float share_a = stays(edge.a) ? 0.0f : edge.share_a, share_b = stays(edge.b) ? 0.0f : edge.share_b;
    if (share_a + share_b == 0.0f) return;
    const Vec3 shorter = (b - a) * ((1.0f - limit_m / length_m) / (share_a + share_b));
    a += share_a * shorter;
    b -= share_b * shorter;
    if (share_a > 0.0f) mark(edge.a);
    if (share_b > 0.0f) mark(edge.b);
}

void LengthLimit::forget_moved() {
    for (const uint32_t v : moved_) is_moved_[v] = 0;
    moved_.clear();
}

void LengthLimit::mark(uint32_t vertex) {
    if (!is_moved_[vertex]) moved_.push_back(vertex);
    is_moved_[vertex] = 1;
    look_about(vertex);
}

void LengthLimit::look_about(uint32_t vertex) {
    for (uint32_t i = first_[vertex]; i < first_[vertex + 1]; ++i) {
        const uint32_t edge = edges_at_[i];
        if (!is_next_[edge]) next_.push_back(edge);
        is_next_[edge] = 1;
    }
}

}  // namespace vfit
