#include "cook/model/skeleton_probe.h"

#include <algorithm>
#include <cmath>

namespace vfit {

namespace {

constexpr size_t kDirections = 16;
constexpr float kCloth_m = 1.2f;  // no cloth that is worn is further from a bone
constexpr float kBeyond_m = 4.0f;

/// Whether the segment crosses the triangle.
bool crosses(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, const Vec3& c) {
    const auto volume = [](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
        return double(glm::dot(glm::cross(q - p, r - p), s - p));
    };
    if ((volume(a, b, c, from) > 0.0) == (volume(a, b, c, to) > 0.0)) return false;
    const bool one = volume(from, to, a, b) > 0.0, two = volume(from, to, b, c) > 0.0,
               three = volume(from, to, c, a) > 0.0;
    return one == two && two == three;
}

}  // namespace

SkeletonProbe::SkeletonProbe(const CookBody& body) : body_(body) {
    const TailorLevels& levels = body.outline().levels();
    const float axis_z = body.outline().axis_z();
    const Vec3 chest(0.0f, levels.bust, axis_z), neck = body.joint(VFIT_BONE_NECK),
                                                 head = body.joint(VFIT_BONE_HEAD),
                                                 hips = body.joint(VFIT_BONE_HIPS);
    const float crotch = hips.y - 0.5f * (levels.waist - levels.hip);
    ways_[Parted::head] = {
        {"neck", chest, neck, {}}, {"neck", neck, head, {}}, {"", head, head + Vec3(0, kBeyond_m, 0), {}}};
    struct Side {
        const char* name;
        Limb leg, shank, arm, forearm;
        int shoulder;
        Parted::End arm_end, leg_end;
    };
    for (const Side& side :
         {Side{"left ", Limb::left_leg, Limb::left_shank, Limb::left_arm, Limb::left_forearm,
               VFIT_BONE_LEFT_SHOULDER, Parted::left_arm, Parted::left_leg},
          Side{"right ", Limb::right_leg, Limb::right_shank, Limb::right_arm, Limb::right_forearm,
               VFIT_BONE_RIGHT_SHOULDER, Parted::right_arm, Parted::right_leg}}) {
        const auto name = [&](const char* bone) { return side.name + std::string(bone); };
        const auto limb = [&](const char* bone, Limb of) {
            return Bone{name(bone), body.root(of), body.end(of), of};
        };
        const auto beyond = [&](Limb of) {
            const Vec3 along = glm::normalize(body.end(of) - body.root(of));
            return Bone{"", body.end(of), body.end(of) + kBeyond_m * along, of};
        };
        ways_[side.arm_end] = {{name("shoulder"), chest, body.joint(side.shoulder), {}},
                               {name("shoulder"), body.joint(side.shoulder), body.root(side.arm), {}},
                               limb("upper arm", side.arm),
                               limb("forearm", side.forearm),
                               beyond(side.forearm)};
        ways_[side.leg_end] = {{"trunk", chest, hips, {}},
                               {name("hip"), hips, body.root(side.leg), {}},
                               limb("thigh", side.leg),
                               limb("shank", side.shank),
                               beyond(side.shank)};
        constexpr float kRoot = 0.35f, kStep = 0.15f;  // nearer to it a ring meets the trunk
        for (const Limb of : {side.arm, side.forearm, side.leg, side.shank})
            for (float t = CookBody::parent(of) ? 0.0f : kRoot; t < 0.95f; t += kStep)
                add_ring(glm::mix(body.root(of), body.end(of), t), body.end(of) - body.root(of), of);
    }
    for (const auto& way : ways_)
        for (const Bone& bone : way)
            if (!bone.name.empty()) bones_.push_back(bone);
    constexpr float kApart_m = 0.03f;
    for (float y = crotch; y < levels.bust; y += kApart_m)
        add_ring({0.0f, y, axis_z}, {0, 1, 0}, std::nullopt);
}

void SkeletonProbe::add_ring(const Vec3& centre, const Vec3& along, std::optional<Limb> limb) {
    const Vec3 axis = glm::normalize(along);
    const Vec3 a = glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.8f ? Vec3(1, 0, 0) : Vec3(0, 0, 1))),
               b = glm::cross(axis, a);
    Ring ring{centre, {}, {}, limb};
    for (size_t i = 0; i < kDirections; ++i) {
        const float angle = 2.0f * kPi * float(i) / float(kDirections);
        const Vec3 direction = std::cos(angle) * a + std::sin(angle) * b;
        const auto skin = body_.skin().cast(centre, direction, kCloth_m);
        if (!skin) continue;
        ring.directions.push_back(direction);
        ring.skin_m.push_back(skin->distance);
    }
    rings_.push_back(std::move(ring));
}

Vec3 SkeletonProbe::carried(const Stance& stance, std::optional<Limb> limb, const Vec3& place) const {
    return limb ? body_.carried(stance, *limb, place) : place;
}

std::optional<Vec3> SkeletonProbe::crossing(const Bone& bone, const MeshQuery& cloth, const Vec3& moved,
                                            const Stance& stance) const {
    const Vec3 from = carried(stance, bone.limb, bone.from), to = carried(stance, bone.limb, bone.to);
    const float length = glm::length(to - from);
    if (length == 0.0f) return std::nullopt;
    const auto hit = cloth.cast(from - moved, (to - from) / length, length);
    if (!hit) return std::nullopt;
    return from + (to - from) * (hit->distance / length);
}

size_t SkeletonProbe::crossed(const MeshQuery& cloth, const Vec3& moved, const Stance& stance,
                              Limb limb) const {
    return size_t(std::count_if(bones_.begin(), bones_.end(), [&](const Bone& bone) {
        return bone.limb && (*bone.limb == limb || CookBody::parent(*bone.limb) == limb) &&
               crossing(bone, cloth, moved, stance);
    }));
}

SkeletonProbe::Found SkeletonProbe::find(const MeshQuery& cloth, const Vec3& moved,
                                         const Stance& stance) const {
    Found out;
    for (const Bone& bone : bones_) {
        const auto at = crossing(bone, cloth, moved, stance);
        if (!at) continue;
        if (out.pierced.empty()) out.pierced_at = *at;
        out.pierced.push_back(bone.name);
    }
    std::vector<float> ratios;
    for (const Ring& ring : rings_) {
        const Vec3 centre = carried(stance, ring.limb, ring.centre);
        float cloth_m = 0.0f, skin_m = 0.0f;
        size_t met = 0;
        for (size_t i = 0; i < ring.directions.size(); ++i) {
            const Vec3 direction = carried(stance, ring.limb, ring.centre + ring.directions[i]) - centre;
            const auto hit = cloth.cast(centre - moved, direction, kCloth_m);
            if (!hit) continue;
            cloth_m += hit->distance, skin_m += ring.skin_m[i], ++met;
        }
        constexpr size_t kRound = kDirections * 3 / 4;
        if (met >= kRound) ratios.push_back(cloth_m / skin_m);
    }
    if (ratios.empty()) return out;
    std::sort(ratios.begin(), ratios.end());
    out.girth_ratio = ratios[ratios.size() / 10];
    return out;
}

bool SkeletonProbe::is_in_the_way(const MeshQuery& cloth, const Vec3& moved, const Stance& stance) const {
    for (const auto& way : ways_)
        for (const Bone& bone : way)
            if (crossing(bone, cloth, moved, stance)) return true;
    return false;
}

bool SkeletonProbe::is_beyond(Parted::End end, const MeshQuery& cloth) const {
    return crossing(ways_[end].back(), cloth, Vec3(0.0f), Stance()).has_value();
}

Parted SkeletonProbe::parted(std::span<const Vec3> places, const std::vector<std::vector<uint32_t>>& openings,
                             const Vec3& moved, const Stance& stance) const {
    // Closed far away, the ways to two ends are one loop: it goes through an opening that parts them an odd
    // number of times, whatever the surface that spans the opening.
    std::array<std::vector<bool>, 5> through;
    for (const auto& opening : openings) {
        Vec3 middle(0.0f);
        for (const uint32_t v : opening) middle += places[v] / float(opening.size());
        for (size_t end = 0; end < through.size(); ++end) {
            bool odd = false;
            for (const Bone& bone : ways_[end]) {
                const Vec3 from = carried(stance, bone.limb, bone.from) - moved,
                           to = carried(stance, bone.limb, bone.to) - moved;
                for (size_t i = 0; i < opening.size(); ++i)
                    odd ^= crosses(from, to, places[opening[i]], places[opening[(i + 1) % opening.size()]],
                                   middle);
            }
            through[end].push_back(odd);
        }
    }
    Parted out;
    std::vector<std::vector<bool>> groups;
    for (size_t end = 0; end < through.size(); ++end) {
        const auto known = std::find(groups.begin(), groups.end(), through[end]);
        out.group[end] = uint8_t(known - groups.begin());
        if (known == groups.end()) groups.push_back(through[end]);
    }
    return out;
}

}  // namespace vfit
