// The parametric human body: shape values in, skin and joints out, from the binary that
// scripts/bake_body.py makes of the CC0 MakeHuman data. The body stands in the data's own rest posture
// (arms out at about 45 degrees, elbows a little bent), metres, Y up, facing +Z, its left on +X, soles on
// y = 0.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "math/types.h"
#include "vfit.h"

namespace vfit {

/// A phenotype ("gender", "age", ...) or a local slider ("measure-waist-circ", ...).
struct ShapeParameter {
    std::string key;
    float minimum, maximum;
    float female, male;  // defaults
};

/// Parents stand before children. Twist segments and fingers are no humanoid bones: bone is -1.
struct RigBone {
    std::string name;
    int parent;  // -1: root
    int bone;    // VFIT_BONE_* or -1
};

enum class BodyPart : uint8_t {
    kHead,
    kTorso,
    kLeftUpperArm,
    kLeftForearm,
    kLeftHand,
    kRightUpperArm,
    kRightForearm,
    kRightHand,
    kLeftThigh,
    kLeftShank,
    kLeftFoot,
    kRightThigh,
    kRightShank,
    kRightFoot,
};
inline constexpr int kBodyPartCount = 14;
inline bool is_arm(BodyPart part) { return part >= BodyPart::kLeftUpperArm && part <= BodyPart::kRightHand; }

struct EvaluatedBody {
    std::vector<Vec3> positions;               // level 0, geometric vertices
    std::vector<Vec3> bone_heads, bone_tails;  // one a rig bone
    std::vector<float> scratch;                // evaluate's own; kept so that it need not allocate again
};

inline constexpr uint32_t kBodyLevels = 3;  // of subdivision
inline constexpr uint32_t kCoarseBody = 3;  // after them, the level with few vertices
inline constexpr uint32_t kCoarseVertices = 1000;
inline constexpr int kSkinBones = 8;

/// One level of detail. Geometric vertices form a closed surface; where the UV map is cut a renderer needs
/// copies of some of them: render vertices are the geometric ones, then the copies.
struct BodyTopology {
    uint32_t vertex_count = 0;             // geometric
    uint32_t render_vertex_count = 0;      // with the copies
    std::vector<uint32_t> seam_sources;    // the geometric vertex of render vertex vertex_count + i
    std::vector<uint32_t> indices;         // three a triangle, geometric vertices
    std::vector<uint32_t> render_indices;  // the same triangles, render vertices
    // One a render vertex; v = 0 at the top of the picture.
    std::vector<Vec2> uvs;
    std::vector<std::array<uint16_t, kSkinBones>> skin_bones;  // heaviest first
    std::vector<std::array<float, kSkinBones>> skin_weights;   // sum to 1; 0 where unused
    std::vector<BodyPart> parts;                               // that carries most of the weight
};

class BodyModel {
public:
    /// Reads and checks the baked binary. VFIT_ERROR_IO where it cannot be read, VFIT_ERROR_VERSION where
    /// another version wrote it, VFIT_ERROR_DATA where it is cut, damaged or not such a file.
    static std::shared_ptr<const BodyModel> load(const std::string& path);
    ~BodyModel();
    BodyModel(const BodyModel&) = delete;
    BodyModel& operator=(const BodyModel&) = delete;

    const std::vector<ShapeParameter>& parameters() const;
    int parameter(const std::string& key) const;  // -1: there is none of that key
    const std::vector<RigBone>& bones() const;
    /// The rig bone that is that humanoid bone.
    int rig_bone(int humanoid_bone) const;

    /// VFIT_SEX_UNKNOWN: halfway between the two.
    std::vector<float> default_shape(vfit_sex sex) const;

    /// Body of that shape, one value a parameter; values are clamped to their range. Thread-safe; allocates
    /// only where `out` has not been used before.
    void evaluate(std::span<const float> shape, EvaluatedBody& out) const;

    /// Level of detail 0, 1, 2 or kCoarseBody; built on its first use, thread-safe.
    const BodyTopology& topology(uint32_t level) const;
    /// Geometric positions at that level from those of level 0. Allocates only where `out` has not been used
    /// before.
    void subdivide(uint32_t level, const std::vector<Vec3>& base, std::vector<Vec3>& out) const;

private:
    BodyModel();
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace vfit
