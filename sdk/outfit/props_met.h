// The props that one garment stays outside of. A prop comes in as a point that grows, from where it lies
// farthest from the garment: whatever it meets is pushed aside, and nothing ends up inside of it.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "cloth/contact/contact.h"
#include "core/jobs.h"
#include "math/types.h"
#include "outfit/cloth_piece.h"
#include "outfit/held_cloth.h"
#include "outfit/posed_body.h"
#include "outfit/prop.h"

namespace vfit {

/// The body's motion in a step, as that of its root.
struct RootMotion {
    Mat4 before, now;      // skinning matrices
    float carried = 0.0f;  // the fraction of it that moves the cloth at once
};

/// The body beside the props.
struct BodyBeside {
    RootMotion motion;
    PosedBody& posed;  // at the end of the step
    float room_m;      // for cloth, between it and props
};

class PropsMet {
public:
    /// From the next step on; prop must outlive its removal. False: it was there.
    bool add(const Prop& prop, ClothPiece cloth);
    /// The garment has another cloth from now on.
    void add_to(ClothPiece cloth);
    /// False: it was not there.
    bool remove(const Prop& prop, ClothPiece cloth);
    /// Before a step of dt, 0 < dt <= kMaxStep_s: takes the places of the props, moved out of the body.
    /// Motion of the body that moves the cloth at once is swept against them as well. A prop that leaps
    /// relative to the body, past the garment, comes in anew.
    void move(const BodyBeside& body, float dt, ClothPiece cloth, Jobs& jobs);
    /// A prop that holds cloth passes through it for a while, and then comes in anew (held_cloth.h). Where it
    /// soon holds cloth again, it passes twice as long. With that fraction of the step behind the cloth, dt
    /// after the last time.
    void let_pass(ClothPiece cloth, float share, float dt);
    /// None is there until move().
    void hide(ClothPiece cloth);
    /// The step has ended.
    void keep_step();

    size_t count() const { return met_.size(); }
    /// Triangles of the last step that has ended; no positions: it was not there. Those of a prop
    /// that passes through the garment too.
    std::span<const Vec3> positions(size_t prop) const { return met_[prop].kept; }
    const std::vector<uint32_t>& indices(size_t prop) const { return met_[prop].prop->indices(); }

private:
    struct Met {
        const Prop* prop;
        uint32_t mesh;
        float size = 0.0f;  // 0..1
        uint32_t from = 0;  // the vertex that it grows from
        PosedBody::Points whole;
        std::vector<Vec3> last_whole;  // moved out, in the last step
        std::vector<Vec3> places, starts, kept;
        bool passes = false;
        float for_s = INFINITY;      // that it passes, or not
        float passes_s = kPasses_s;  // that it passed the last time
    };
    static bool holds(const Met& met, const ClothPiece& cloth, float share);
    static void come_in_anew(Met& met, ClothPiece cloth);
    static void begin_to_grow(Met& met, const Bounds& garment);

    std::vector<Met> met_;
    std::vector<uint32_t> free_meshes_;
};

}  // namespace vfit
