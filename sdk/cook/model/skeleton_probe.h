// What the bones of a body meet of cloth that stands about them.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cook/body/cook_body.h"

namespace vfit {

/// The ends of a body, each in a class with those that go out of the cloth by the same openings.
struct Parted {
    enum End { head, left_arm, right_arm, left_leg, right_leg };
    std::array<uint8_t, 5> group{};

    /// One of these or the other of them is parted from the head by cloth over that shoulder.
    bool over_shoulder() const { return group[left_arm] != group[head] || group[right_arm] != group[head]; }
    bool legs_from_head() const { return group[left_leg] != group[head] || group[right_leg] != group[head]; }
    bool legs_from_each_other() const { return group[left_leg] != group[right_leg]; }
    int count() const { return 1 + *std::max_element(group.begin(), group.end()); }
    bool round_nothing() const { return group == std::array<uint8_t, 5>{}; }
};

class SkeletonProbe {
public:
    explicit SkeletonProbe(const CookBody& body);

    struct Found {
        std::vector<std::string> pierced;  // bones that cross the cloth
        Vec3 pierced_at{0.0f};             // where the first of them does
        float girth_ratio = 0.0f;  // of cloth to body where it goes round it most closely; 0: round nothing
    };
    /// Cloth that is moved, about a body in that stance.
    Found find(const MeshQuery& cloth, const Vec3& moved, const Stance& stance) const;

    /// How many of the bones of a limb cross it.
    size_t crossed(const MeshQuery& cloth, const Vec3& moved, const Stance& stance, Limb limb) const;

    /// Whether a way to an end of the body, or on from there, crosses it.
    bool is_in_the_way(const MeshQuery& cloth, const Vec3& moved, const Stance& stance) const;

    /// Whether the way on from an end of the body crosses it, as out of a sleeve that is longer than the arm.
    bool is_beyond(Parted::End end, const MeshQuery& cloth) const;

    /// By which of the openings each end of the body leaves the cloth.
    Parted parted(std::span<const Vec3> places, const std::vector<std::vector<uint32_t>>& openings,
                  const Vec3& moved, const Stance& stance) const;

private:
    struct Bone {
        std::string name;
        Vec3 from, to;
        std::optional<Limb> limb;
    };
    struct Ring {
        Vec3 centre;
        std::vector<Vec3> directions;
        std::vector<float> skin_m;
        std::optional<Limb> limb;
    };
    /// Where the bone meets the cloth.
    std::optional<Vec3> crossing(const Bone& bone, const MeshQuery& cloth, const Vec3& moved,
                                 const Stance& stance) const;
    void add_ring(const Vec3& centre, const Vec3& along, std::optional<Limb> limb);
    Vec3 carried(const Stance& stance, std::optional<Limb> limb, const Vec3& place) const;

    const CookBody& body_;
    std::vector<Bone> bones_;
    std::vector<Ring> rings_;
    std::array<std::vector<Bone>, 5> ways_;  // to each end, and on to far from it
};

}  // namespace vfit
