// Mesh frames: posed vertices copied into a pooled frame in the host's axes, beside topology that never
// changes.
#pragma once

#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "api/context.h"
#include "math/types.h"

namespace vfit::api {

/// Streams that stay the same as long as the object lives, already in the host's axes; shared by all its
/// frames, which keep it alive.
class StaticStreams : public Object {
public:
    void set_indices(const std::vector<uint32_t>& indices, const Axes& axes);
    void set_uvs(const std::vector<Vec2>& uvs, const Axes& axes);
    void set_skin(std::span<const uint16_t> bones, std::span<const float> weights, size_t vertex_count);
    void add_to(Frame& frame) const;

private:
    std::vector<uint32_t> indices_;
    std::vector<Vec2> uvs_;
    std::vector<uint16_t> skin_bones_;
    std::vector<float> skin_weights_;
    std::vector<Stream> streams_;
    void add(vfit_stream kind, vfit_format format, size_t items, const void* data);
};

/// The newest mesh of an object, handed out by acquire while the object is posed on another thread.
class MeshOutput {
public:
    explicit MeshOutput(const Context& context)
        : pool_(make<FramePool>(kFrames, context.frame_bytes)), topology_(make<StaticStreams>()) {}

    StaticStreams& topology() { return *topology_; }
    /// An empty frame; VFIT_ERROR_BUSY when the host holds all.
    Ref<Frame> begin() const { return Context::take_frame(*pool_); }
    /// Adds vertices to be filled, packed, in the host's axes, and the topology to the frame.
    struct Vertices {
        Vec3* positions;
        Vec3* normals;
    };
    Vertices add_vertices(Frame& frame, uint32_t count, int64_t time_ns) const;
    /// The same from vertices in world space.
    void fill(Frame& frame, std::span<const Vec3> positions, std::span<const Vec3> normals, const Axes& axes,
              int64_t time_ns) const;
    void publish(Ref<Frame> frame);
    Ref<Frame> latest() const;

private:
    // One published, one in the making; the rest may be held by render threads.
    static constexpr uint32_t kFrames = 6;
    const Ref<FramePool> pool_;
    const Ref<StaticStreams> topology_;
    mutable std::mutex mutex_;
    Ref<Frame> latest_;
};

}  // namespace vfit::api
