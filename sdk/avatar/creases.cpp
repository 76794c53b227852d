#include "avatar/creases.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <tuple>

namespace vfit {

namespace {

using glm::dot;

constexpr float kRoom_m = 0.012f;  // between two parts: two layers of cloth, each 4 mm from its skin, and 4
                                   // mm from each other
constexpr float kTolerance_m = 0.01f;  // by which a field may differ from the skin
// Skins press into each other where they face each other: cosine between the way to the own bone and the way
// out of the other part, from none to full.
constexpr float kMinCosine = -0.8f, kFullCosine = -0.5f;
constexpr float kMaxDepth = 0.7f;  // fraction of the radius by which skin gives way
constexpr int kRounds = 2;         // of a vertex: fields are not linear
constexpr float kNear_m = kRoom_m + kTolerance_m;
constexpr uint32_t kClusterSize = 8;  // vertices
constexpr uint32_t kChunk = 64;       // clusters of one item of work
constexpr float kStretch = 1.25f;     // of a cluster's radius: skinning is not rigid
constexpr float kMinWeight = 0.02f;
constexpr float kMaxSteepness = 1.5f;  // depth by way along the skin from the other part
constexpr float kSlope = 0.5f;         // of the room by that way
constexpr float kMaxWay_m = 0.06f;     // along the skin: further away, nothing limits the depth
constexpr uint8_t kNone = 255;
constexpr float kFollows_m = 0.05f;  // from a cell of a field to the vertex that it follows
constexpr float kRigid = 0.98f;      // fraction of a vertex that its part carries

/// Hands and feet are bony: they keep their shape, and the other part gives way alone.
bool is_bony(BodyPart part) {
    return part == BodyPart::kLeftHand || part == BodyPart::kRightHand || part == BodyPart::kLeftFoot ||
           part == BodyPart::kRightFoot;
}
bool is_bony(size_t part) { return is_bony(BodyPart(part)); }

/// From 0 to 1: skins press into each other where they face each other.
float facing_of(float cosine) {
    return std::clamp((cosine - kMinCosine) / (kFullCosine - kMinCosine), 0.0f, 1.0f);
}

/// Upper arm and forearm, thigh and shank: their numbers follow each other.
bool are_joined(BodyPart a, BodyPart b) {
    const int first = std::min(int(a), int(b));
    return std::abs(int(a) - int(b)) == 1 &&
           (first == int(BodyPart::kLeftUpperArm) || first == int(BodyPart::kLeftForearm) ||
            first == int(BodyPart::kRightUpperArm) || first == int(BodyPart::kRightForearm) ||
            first == int(BodyPart::kLeftThigh) || first == int(BodyPart::kLeftShank) ||
            first == int(BodyPart::kRightThigh) || first == int(BodyPart::kRightShank));
}

/// Nothing presses where a limb is straight: radii of two bones in line point the same way. A bony part does
/// not press into the part that it continues.
bool may_press(const PosedField& a, const PosedField& b) {
    if (a.field->part == b.field->part) return false;
    if (!are_joined(a.field->part, b.field->part)) return true;
    return !is_bony(b.field->part) && -dot(a.axis, b.axis) > kMinCosine;
}

/// Between two segments (Ericson, Real-Time Collision Detection, 5.1.9).
float segment_distance(const PosedField& a, const PosedField& b) {
    const Vec3 d1 = a.end() - a.start, d2 = b.end() - b.start, r = a.start - b.start;
    const float l1 = dot(d1, d1), l2 = dot(d2, d2), f = dot(d2, r), c = dot(d1, r), along = dot(d1, d2);
    const float square = l1 * l2 - along * along;
    float s = square > 1e-6f * l1 * l2 ? std::clamp((along * f - c * l2) / square, 0.0f, 1.0f) : 0.5f;
    const float t = std::clamp((along * s + f) / l2, 0.0f, 1.0f);
    s = std::clamp((along * t - c) / l1, 0.0f, 1.0f);
    return glm::length(r + s * d1 - t * d2);
}

}  // namespace

struct Creases::Posed {
    std::array<PosedField, kMaxFieldBones> fields;
    std::array<PosedField::Radii, kMaxFieldBones> radii;
    const PosedField& operator[](size_t i) const { return fields[i]; }
};

/// Fields of other parts that a cluster is near to, part by part.
struct Creases::Active {
    std::array<uint8_t, kMaxFieldBones> field{};
    size_t count = 0;
};

Creases::Creases(const AvatarRig& rig, const BodyTopology& topology, std::span<const Vec3> rest,
                 std::span<const SkinBones> bones, std::span<const SkinWeights> weights)
    : fields_(learn_bone_fields(rig, rest, topology.parts)),
      part_of_(rest.size(), kNone),
      field_of_(rest.size(), kNone),
      carried_(rest.size()),
      way_to_(rest.size()) {
    for (size_t i = 0; i < fields_.size(); ++i) {
        FieldRange& range = fields_of_[size_t(fields_[i].part)];
        if (range.end == 0) range.first = uint8_t(i);
        range.end = uint8_t(i + 1);
    }
    // The part that each rig bone carries.
    std::vector<std::array<float, kBodyPartCount>> shares(rig.bones().size());
    for (auto& share : shares) share.fill(0.0f);
    for (size_t v = 0; v < rest.size(); ++v)
        for (size_t k = 0; k < kSkinBones; ++k)
            shares[bones[v][k]][size_t(topology.parts[v])] += weights[v][k];
    std::vector<size_t> part_of_bone;
    for (const auto& share : shares)
        part_of_bone.push_back(size_t(std::max_element(share.begin(), share.end()) - share.begin()));

    const std::vector<Mat4> identity(rig.bones().size(), Mat4(1.0f));
    Posed posed;
    pose_fields(identity, posed);
    for (size_t v = 0; v < rest.size(); ++v) {
        if (topology.parts[v] == BodyPart::kHead) continue;
        auto& carried = carried_[v];
        carried.fill(0.0f);
        for (size_t k = 0; k < kSkinBones; ++k) carried[part_of_bone[bones[v][k]]] += weights[v][k];
        if (fields_of_[size_t(topology.parts[v])].end > 0) part_of_[v] = uint8_t(topology.parts[v]);
        if (part_of_[v] == kNone) continue;
        const FieldRange range = fields_of_[part_of_[v]];
        float nearest = INFINITY;
        for (uint8_t i = range.first; i < range.end; ++i) {
            const float distance = posed[i].sample(rest[v]).distance_m;
            if (distance < nearest) nearest = distance, field_of_[v] = i;
        }
    }
    measure_ways(topology, rest);
}

void Creases::measure_ways(const BodyTopology& topology, std::span<const Vec3> rest) {
    for (auto& way : way_to_) way.fill(INFINITY);
    const size_t count = topology.vertex_count;
    std::vector<uint32_t> first(count + 1, 0), neighbour(topology.indices.size());
    for (const uint32_t v : topology.indices) ++first[v + 1];
    for (size_t v = 0; v < count; ++v) first[v + 1] += first[v];
    std::vector<uint32_t> next(first.begin(), first.end() - 1);
    for (size_t i = 0; i < topology.indices.size(); i += 3)
        for (size_t k = 0; k < 3; ++k)
            neighbour[next[topology.indices[i + k]]++] = topology.indices[i + (k + 1) % 3];
    for (size_t part = 0; part < kBodyPartCount; ++part) {
        if (fields_of_[part].end == 0) continue;
        using Reached = std::pair<float, uint32_t>;
        std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
        for (uint32_t v = 0; v < count; ++v)
            if (part_of_[v] == part) way_to_[v][part] = 0.0f, open.push({0.0f, v});
        while (!open.empty()) {
            const auto [way, v] = open.top();
            open.pop();
            if (way > way_to_[v][part]) continue;
            for (uint32_t i = first[v]; i < first[v + 1]; ++i) {
                const uint32_t to = neighbour[i];
                const float longer = way + glm::distance(rest[v], rest[to]);
                if (longer >= way_to_[to][part] || longer > kMaxWay_m) continue;
                way_to_[to][part] = longer;
                open.push({longer, to});
            }
        }
    }
    for (size_t i = 0; i < topology.seam_sources.size(); ++i)
        way_to_[count + i] = way_to_[topology.seam_sources[i]];
}

void Creases::pose_fields(std::span<const Mat4> matrices, Posed& out) const {
    for (size_t i = 0; i < fields_.size(); ++i) {
        const BoneField& f = fields_[i];
        const Mat4& m = matrices[size_t(f.rig_bone)];
        const Mat3 turn(m);
        out.fields[i] = {&f, &f.radius, Vec3(m * Vec4(f.start, 1.0f)), turn * f.x, turn * f.axis, turn * f.z};
    }
}

PosedField::Sample Creases::part_sample(const Posed& posed, size_t part, const Vec3& p) const {
    PosedField::Sample nearest{INFINITY, 0.0f, Vec3(0.0f)};
    for (uint8_t i = fields_of_[part].first; i < fields_of_[part].end; ++i) {
        const PosedField::Sample sample = posed[i].sample(p);
        if (sample.distance_m < nearest.distance_m) nearest = sample;
    }
    return nearest;
}
float Creases::part_distance(const Posed& posed, size_t part, const Vec3& p) const {
    return part_sample(posed, part, p).distance_m;
}

Creases::Mesh Creases::mesh_of(std::span<const uint32_t> vertices, std::span<const Vec3> places) const {
    Mesh mesh;
    if (fields_.empty()) return mesh;
    size_t bones = 0;
    for (const BoneField& f : fields_) bones = std::max(bones, size_t(f.rig_bone) + 1);
    const std::vector<Mat4> identity(bones, Mat4(1.0f));
    Posed posed;
    pose_fields(identity, posed);
    struct Sorted {
        Mesh::Vertex vertex;
        int level, turn;
    };
    std::vector<Sorted> all;
    for (size_t i = 0; i < vertices.size(); ++i) {
        const uint8_t part = part_of_[vertices[i]], field = field_of_[vertices[i]];
        if (part == kNone || is_bony(part)) continue;
        Mesh::Vertex v{uint32_t(i), part, field, {}, {}};
        v.near_parts.fill({kNone, kRoom_m, INFINITY});
        v.own.fill({kNone, 0.0f});
        const auto& carried = carried_[vertices[i]];
        for (size_t q = 0; q < kBodyPartCount; ++q) {
            if (fields_of_[q].end == 0 || carried[q] < kMinWeight || is_bony(q)) continue;
            auto* slot = std::min_element(v.own.begin(), v.own.end(),
                                          [](const auto& x, const auto& y) { return x.weight < y.weight; });
            if (carried[q] > slot->weight) *slot = {uint8_t(q), carried[q]};
        }
        const float own = part_distance(posed, part, places[i]);
        for (size_t q = 0; q < kBodyPartCount; ++q) {
            if (q == part || fields_of_[q].end == 0) continue;
            const float own_of_pair = is_bony(q) ? 0.0f : own;
            const PosedField::Sample other = part_sample(posed, q, places[i]);
            const float way = way_to_[vertices[i]][q];
            const float facing = facing_of(-dot(part_sample(posed, part, places[i]).outward, other.outward));
            const float opened = std::min(kRoom_m, kSlope * way);
            const float room = facing > 0.0f ? std::min(opened, other.distance_m - own_of_pair) : opened;
            const float depth =
                is_bony(q) && are_joined(BodyPart(q), BodyPart(part)) ? 0.0f : kMaxSteepness * way;
            auto* slot =
                std::max_element(v.near_parts.begin(), v.near_parts.end(), [](const auto& x, const auto& y) {
                    return std::tie(x.max_depth_m, x.room_m) < std::tie(y.max_depth_m, y.room_m);
                });
            if (std::tie(depth, room) < std::tie(slot->max_depth_m, slot->room_m))
                *slot = {uint8_t(q), room, depth};
        }
        const Vec3 d = places[i] - fields_[field].start;
        constexpr float kAlong_m = 0.03f, kAround = 0.8f;  // rad
        all.push_back(
            {v, int(std::floor(dot(d, fields_[field].axis) / kAlong_m)),
             int(std::floor(std::atan2(dot(d, fields_[field].z), dot(d, fields_[field].x)) / kAround))});
    }
    std::sort(all.begin(), all.end(), [](const Sorted& a, const Sorted& b) {
        return std::tie(a.vertex.field, a.level, a.turn, a.vertex.number) <
               std::tie(b.vertex.field, b.level, b.turn, b.vertex.number);
    });
    std::array<std::vector<uint32_t>, kBodyPartCount> of_part;
    for (const Sorted& s : all) of_part[s.vertex.part].push_back(s.vertex.number);
    for (uint8_t field = 0; field < fields_.size(); ++field) {
        const BoneField& f = fields_[field];
        if (is_bony(f.part)) continue;
        const bool is_chain = fields_of_[size_t(f.part)].end - fields_of_[size_t(f.part)].first > 1;
        for (size_t cell = 0; cell < f.levels * BoneField::kAngles; ++cell) {
            const Vec3 place = place_of_cell(f, cell);
            float nearest2 = kFollows_m * kFollows_m;
            uint32_t number = UINT32_MAX;
            for (const uint32_t v : of_part[size_t(f.part)]) {
                const Vec3 way = places[v] - place;
                if (dot(way, way) < nearest2) nearest2 = dot(way, way), number = v;
            }
            if (number == UINT32_MAX) continue;
            if (!is_chain && carried_[vertices[number]][size_t(f.part)] > kRigid) continue;
            const float radius = f.radius[cell];
            mesh.loose_.push_back({field, uint16_t(cell), number,
                                   radius - posed[field].radius_of(places[number]), 0.5f * radius,
                                   1.5f * radius});
        }
    }
    for (size_t begin = 0, end; begin < all.size(); begin = end) {
        const uint8_t field = all[begin].vertex.field;
        Vec3 sum(0.0f);
        for (end = begin; end < all.size() && end - begin < kClusterSize && all[end].vertex.field == field;
             ++end)
            sum += places[all[end].vertex.number];
        const Vec3 centre = sum / float(end - begin);
        Mesh::Cluster cluster{uint32_t(mesh.vertices_.size()), uint32_t(end - begin), field, 0, 0.0f};
        float nearest = INFINITY;
        for (size_t i = begin; i < end; ++i) {
            const uint32_t number = all[i].vertex.number;
            const float distance = glm::distance(places[number], centre);
            if (distance < nearest) nearest = distance, cluster.middle = number;
            mesh.vertices_.push_back(all[i].vertex);
        }
        for (size_t i = begin; i < end; ++i)
            cluster.radius_m =
                std::max(cluster.radius_m,
                         kStretch * glm::distance(places[all[i].vertex.number], places[cluster.middle]));
        mesh.clusters_.push_back(cluster);
    }
    return mesh;
}

Vec3 Creases::moved(const Posed& posed, const Mesh::Vertex& vertex, const Active& active,
                    const Vec3& p) const {
    Vec3 at = p;
    float depth = 0.0f;
    std::array<PosedField::Sample, 3> own;
    bool known = false;
    for (int round = 0; round < kRounds; ++round) {
        bool moved = false;
        for (size_t k = 0; k < active.count;) {
            const auto part = uint8_t(fields_[active.field[k]].part);
            PosedField::Sample other{INFINITY, 0.0f, Vec3(0.0f)};
            for (; k < active.count && uint8_t(fields_[active.field[k]].part) == part; ++k) {
                const PosedField::Sample sample = posed[active.field[k]].sample(at);
                if (sample.distance_m < other.distance_m) other = sample;
            }
            if (part == vertex.part || other.distance_m > kNear_m) continue;
            if (!known)
                for (size_t i = 0; i < own.size(); ++i)
                    if (vertex.own[i].part != kNone) own[i] = part_sample(posed, vertex.own[i].part, at);
            known = true;
            Vec3 outward(0.0f);
            float own_m = INFINITY, radius = 0.0f;
            for (size_t i = 0; i < own.size(); ++i) {
                const auto [of, weight] = vertex.own[i];
                if (of == kNone || of == part) continue;
                outward += weight * own[i].outward;
                if (own[i].distance_m < own_m) own_m = own[i].distance_m, radius = own[i].radius_m;
            }
            outward = glm::normalize(outward);
            float room = kRoom_m, max_depth = kMaxDepth * radius;
            for (const auto& n : vertex.near_parts)
                if (n.part == part) room = n.room_m, max_depth = std::min(max_depth, n.max_depth_m);
            const bool bony = is_bony(part);
            const float missing = room - (other.distance_m - (bony ? 0.0f : own_m));
            if (missing <= 0.0f) continue;
            const float facing = facing_of(-dot(outward, other.outward));
            if (facing <= 0.0f) continue;
            const Vec3 gradient = bony ? other.outward : other.outward - outward;
            const float rate = glm::length(gradient);
            const float step = std::min(max_depth - depth, facing * missing / rate);
            if (step <= 0.0f) continue;
            depth += step;
            at += (step / rate) * gradient;
            known = false, moved = true;
        }
        if (!moved) break;
    }
    return at;
}

template <typename Place>
void Creases::open_places(std::span<const Mat4> matrices, const Mesh& mesh, Place&& place, Jobs& jobs) const {
    Posed posed;
    pose_fields(matrices, posed);
    for (size_t i = 0; i < fields_.size(); ++i) {
        std::copy_n(fields_[i].radius.begin(), fields_[i].levels * BoneField::kAngles,
                    posed.radii[i].begin());
        posed.fields[i].radius = &posed.radii[i];
    }
    for (const Mesh::Loose& loose : mesh.loose_)
        posed.radii[loose.field][loose.cell] = std::clamp(
            posed[loose.field].radius_of(place.get(loose.number)) + loose.beyond_m, loose.min_m, loose.max_m);
    // Fields of other parts that each field comes near to.
    std::array<Active, kMaxFieldBones> near_field;
    for (size_t own = 0; own < fields_.size(); ++own)
        for (size_t other = 0; other < fields_.size(); ++other)
            if (may_press(posed[own], posed[other]) &&
                segment_distance(posed[own], posed[other]) <
                    fields_[own].reach_m + fields_[other].reach_m + kNear_m)
                near_field[own].field[near_field[own].count++] = uint8_t(other);
    const auto count = uint32_t(mesh.clusters_.size());
    parallel_for(jobs, (count + kChunk - 1) / kChunk, [&](uint32_t chunk) {
        for (uint32_t c = chunk * kChunk; c < std::min(count, (chunk + 1) * kChunk); ++c) {
            const Mesh::Cluster& cluster = mesh.clusters_[c];
            const Active& near_own = near_field[cluster.field];
            if (near_own.count == 0) continue;
            const Vec3 centre = place.get(cluster.middle);
            Active near_cluster;
            for (size_t k = 0; k < near_own.count; ++k)
                if (posed[near_own.field[k]].is_within(centre, cluster.radius_m + kNear_m))
                    near_cluster.field[near_cluster.count++] = near_own.field[k];
            if (near_cluster.count == 0) continue;
            for (uint32_t i = cluster.first; i < cluster.first + cluster.count; ++i) {
                const Mesh::Vertex& vertex = mesh.vertices_[i];
                const Vec3 p = place.get(vertex.number);
                bool is_near = false;
                for (size_t k = 0; k < near_cluster.count && !is_near; ++k)
                    is_near = posed[near_cluster.field[k]].is_within(p, kNear_m);
                if (!is_near) continue;
                const Vec3 to = moved(posed, vertex, near_cluster, p);
                if (to != p) place.set(vertex.number, to);
            }
        }
    });
}

namespace {

struct OwnPlaces {
    std::span<Vec3> positions;
    Vec3 get(uint32_t v) const { return positions[v]; }
    void set(uint32_t v, const Vec3& p) const { positions[v] = p; }
};
struct HostPlaces {
    const SkinTarget& target;
    const Axes& axes;
    float* at(uint32_t v) const {
        return reinterpret_cast<float*>(static_cast<unsigned char*>(target.positions) +
                                        size_t(v) * target.position_stride);
    }
    Vec3 get(uint32_t v) const {
        const float* p = at(v);
        return axes.point_in({p[0], p[1], p[2]});
    }
    void set(uint32_t v, const Vec3& p) const {
        const Vec3 out = axes.point_out(p);
        float* to = at(v);
        to[0] = out.x, to[1] = out.y, to[2] = out.z;
    }
};

}  // namespace

void Creases::open(std::span<const Mat4> matrices, const Mesh& mesh, std::span<Vec3> positions,
                   Jobs& jobs) const {
    open_places(matrices, mesh, OwnPlaces{positions}, jobs);
}
void Creases::open(std::span<const Mat4> matrices, const Mesh& mesh, const SkinTarget& target,
                   const Axes& axes, Jobs& jobs) const {
    open_places(matrices, mesh, HostPlaces{target, axes}, jobs);
}

}  // namespace vfit
