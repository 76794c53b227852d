// The props that one garment stays outside of. A prop comes in as a point that grows, from where it lies
// farthest from the garment: whatever it meets is pushed aside, and nothing ends up inside of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cloth/cloth.h"
#include "math/types.h"
#include "outfit/prop.h"

namespace vfit {

class PropsMet {
public:
    /// From the next step on; prop must outlive its removal. False: it was there.
    bool add(const Prop& prop, Cloth& cloth);
    /// False: it was not there.
    bool remove(const Prop& prop, Cloth& cloth);
    /// Before a step of dt: takes where the props are. root: of the body, which moves at once with what it
    /// carries; a prop that leaps against it comes in anew.
    void move(const Mat4& root, float dt, Cloth& cloth);
    /// None is there until move().
    void hide(Cloth& cloth);
    /// The step has ended.
    void keep_step();

    size_t count() const { return met_.size(); }
    /// Triangles of the last step that has ended; no positions: there was none.
    std::span<const Vec3> positions(size_t prop) const { return met_[prop].kept; }
    const std::vector<uint32_t>& indices(size_t prop) const { return met_[prop].prop->indices(); }

private:
    struct Met {
        const Prop* prop;
        uint32_t mesh;
        float size = 0.0f;     // 0..1
        uint32_t from = 0;     // the vertex that it grows from
        Vec3 from_body{0.0f};  // its center, as the body's root carries it
        std::vector<Vec3> places, kept;
    };
    static void come_in_anew(Met& met, Cloth& cloth);
    static void begin_to_grow(Met& met, const Cloth& cloth);

    std::vector<Met> met_;
    std::vector<uint32_t> free_meshes_;
};

}  // namespace vfit
