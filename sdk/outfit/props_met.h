// The props that one garment stays outside of. A prop comes in as a point that grows, from where it lies
// farthest from the garment: whatever it meets is pushed aside, and nothing ends up inside of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "cloth/contact/contact.h"
#include "math/types.h"
#include "outfit/prop.h"

namespace vfit {

/// The body's motion in a step, as that of its root.
struct RootMotion {
    Mat4 before, now;      // skinning matrices
    float carried = 0.0f;  // the fraction of it that moves the cloth at once
};

class PropsMet {
public:
    /// From the next step on; prop must outlive its removal. False: it was there.
    bool add(const Prop& prop, Cloth& cloth);
    /// False: it was not there.
    bool remove(const Prop& prop, Cloth& cloth);
    /// Before a step of dt, 0 < dt <= kMaxStep_s: takes the places of the props. Motion of the body that
    /// moves the cloth at once is swept against them as well. A prop that leaps relative to the body, past
    /// the garment, comes in anew.
    void move(const RootMotion& body, float dt, Cloth& cloth);
    /// None is there until move().
    void hide(Cloth& cloth);
    /// The step has ended.
    void keep_step();

    size_t count() const { return met_.size(); }
    /// Triangles of the last step that has ended; no positions: it was not there.
    std::span<const Vec3> positions(size_t prop) const { return met_[prop].kept; }
    const std::vector<uint32_t>& indices(size_t prop) const { return met_[prop].prop->indices(); }

private:
    struct Met {
        const Prop* prop;
        uint32_t mesh;
        float size = 0.0f;        // 0..1
        uint32_t from = 0;        // the vertex that it grows from
        std::vector<Vec3> whole;  // in the last step
        std::vector<Vec3> places, starts, kept;
    };
    static void come_in_anew(Met& met, Cloth& cloth);
    static void begin_to_grow(Met& met, const Bounds& garment);

    std::vector<Met> met_;
    std::vector<uint32_t> free_meshes_;
};

}  // namespace vfit
