#include "api/mesh_frame.h"

#include <cstring>

namespace vfit::api {

namespace {

// Readers may load 16 bytes past the last item (vfit_view).
template <typename T>
void pad(std::vector<T>& v) {
    const size_t extra = (16 + sizeof(T) - 1) / sizeof(T);
    v.resize(v.size() + extra);
}

}  // namespace

void StaticStreams::add(vfit_stream kind, vfit_format format, size_t items, const void* data) {
    const uint32_t item = format_size(format);
    const auto count = static_cast<uint32_t>(items);
    streams_.push_back({kind, format, count, 1, item, item * count, data, Frame::next_serial()});
}

void StaticStreams::set_indices(const std::vector<uint32_t>& indices, const Axes& axes) {
    indices_ = indices;
    if (axes.flips_winding())
        for (size_t t = 0; t + 2 < indices_.size(); t += 3) std::swap(indices_[t + 1], indices_[t + 2]);
    pad(indices_);
    add(VFIT_STREAM_INDEX, VFIT_FORMAT_U32, indices.size(), indices_.data());
}

void StaticStreams::set_uvs(const std::vector<Vec2>& uvs, const Axes& axes) {
    if (uvs.empty()) return;
    uvs_ = uvs;
    for (Vec2& uv : uvs_) uv = axes.uv_out(uv);
    pad(uvs_);
    add(VFIT_STREAM_UV, VFIT_FORMAT_F32X2, uvs.size(), uvs_.data());
}

void StaticStreams::set_skin(std::span<const uint16_t> bones, std::span<const float> weights,
                             size_t vertex_count) {
    skin_bones_.assign(bones.begin(), bones.end());
    skin_weights_.assign(weights.begin(), weights.end());
    pad(skin_bones_);
    pad(skin_weights_);
    add(VFIT_STREAM_SKIN_BONES, VFIT_FORMAT_U16X8, vertex_count, skin_bones_.data());
    add(VFIT_STREAM_SKIN_WEIGHTS, VFIT_FORMAT_F32X8, vertex_count, skin_weights_.data());
}

void StaticStreams::add_to(Frame& frame) const {
    for (const Stream& stream : streams_) frame.add_view(stream);
}

MeshOutput::Vertices MeshOutput::add_vertices(Frame& frame, uint32_t count, int64_t time_ns) const {
    const Vertices vertices = {
        static_cast<Vec3*>(frame.add_stream(VFIT_STREAM_POSITION, VFIT_FORMAT_F32X3, count, 1)),
        static_cast<Vec3*>(frame.add_stream(VFIT_STREAM_NORMAL, VFIT_FORMAT_F32X3, count, 1))};
    topology_->add_to(frame);
    frame.owner = topology_;
    frame.time_ns = time_ns;
    return vertices;
}

void MeshOutput::fill(Frame& frame, std::span<const Vec3> positions, std::span<const Vec3> normals,
                      const Axes& axes, int64_t time_ns) const {
    const auto count = static_cast<uint32_t>(positions.size());
    const auto [p, n] = add_vertices(frame, count, time_ns);
    if (axes.identity()) {
        std::memcpy(static_cast<void*>(p), positions.data(), positions.size_bytes());
        std::memcpy(static_cast<void*>(n), normals.data(), normals.size_bytes());
        return;
    }
    for (uint32_t i = 0; i < count; ++i) {
        p[i] = axes.point_out(positions[i]);
        n[i] = axes.direction_out(normals[i]);
    }
}

void MeshOutput::publish(Ref<Frame> frame) {
    std::lock_guard lock(mutex_);
    std::swap(latest_, frame);
}

Ref<Frame> MeshOutput::latest() const {
    std::lock_guard lock(mutex_);
    return latest_;
}

}  // namespace vfit::api
