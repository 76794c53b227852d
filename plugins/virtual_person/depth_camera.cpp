#include "depth_camera.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#define VFIT_EMBREE_4 1
#else
#include <embree3/rtcore.h>
#endif

#include "error.h"

namespace vfit::virtual_person {

namespace {

constexpr uint32_t kTile = 4;        // px a side: one packet of 16 rays
constexpr float kNearest_m = 0.05f;  // a vertex nearer than this cannot be projected: the whole image is cast

}  // namespace

struct DepthCamera::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    RTCGeometry mesh = nullptr;
    float* vertices = nullptr;

    // One thread: the plug-in shares the machine with the program that it serves.
    Embree() {
        device = rtcNewDevice("threads=1");
        if (!device) fail(VFIT_ERROR_UNKNOWN, "virtual: Embree gives no device");
        scene = rtcNewScene(device);
        // Low build quality is the two-level structure, the one whose meshes can be refitted.
        rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_LOW);
        rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST));
    }
    ~Embree() {
        if (mesh) rtcReleaseGeometry(mesh);
        if (scene) rtcReleaseScene(scene);
        if (device) rtcReleaseDevice(device);
    }
    void intersect(const int* valid, RTCRayHit16* rays) {
#ifdef VFIT_EMBREE_4
        RTCIntersectArguments arguments;
        rtcInitIntersectArguments(&arguments);
        arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
        rtcIntersect16(valid, scene, rays, &arguments);
#else
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        rtcIntersect16(valid, scene, &context, rays);
#endif
    }
};

DepthCamera::DepthCamera(const SensorModel& model, const CameraPlace& place, const Room& room)
    : model_(model),
      place_(place),
      tiles_x_((model.width + kTile - 1) / kTile),
      tiles_y_((model.height + kTile - 1) / kTile),
      embree_(std::make_unique<Embree>()) {
    const float c = std::cos(place.tilt_rad), s = std::sin(place.tilt_rad);
    rotation_ = Mat3(Vec3(1, 0, 0), Vec3(0, -c, s), Vec3(0, -s, -c));  // columns: right, down, forward
    tiles_.resize(size_t{tiles_x_} * tiles_y_);
    solve_room(room);
}

DepthCamera::~DepthCamera() = default;

Vec3 DepthCamera::to_camera(const Vec3& world) const {
    return glm::transpose(rotation_) * (world - Vec3(0, place_.height_m, 0));
}

Vec2 DepthCamera::project(const Vec3& p) const {
    return {p.x / p.z * model_.fx + model_.cx, p.y / p.z * model_.fy + model_.cy};
}

void DepthCamera::solve_room(const Room& room) {
    room_.resize(model_.width, model_.height);
    for (uint32_t y = 0; y < model_.height; ++y) {
        for (uint32_t x = 0; x < model_.width; ++x) {
            // A direction with z = 1 in camera space: the ray's parameter is the depth.
            const Vec3 d = rotation_ * Vec3((static_cast<float>(x) - model_.cx) / model_.fx,
                                            (static_cast<float>(y) - model_.cy) / model_.fy, 1.0f);
            float depth = 0.0f, along_normal = 0.0f;
            const auto meet = [&](float distance, float speed) {
                if (distance <= 0.0f || speed <= 0.0f) return;
                const float t = distance / speed;
                if (depth == 0.0f || t < depth) depth = t, along_normal = speed;
            };
            meet(place_.height_m, -d.y);
            meet(room.back_wall_m, -d.z);
            meet(room.side_wall_m, -d.x);
            const size_t i = size_t{y} * model_.width + x;
            room_.depth_m[i] = depth;
            room_.cosine[i] = along_normal / glm::length(d);
        }
    }
}

void DepthCamera::set_triangles(std::span<const uint32_t> indices, uint32_t vertex_count) {
    if (indices.empty() || indices.size() % 3 != 0)
        fail(VFIT_ERROR_DATA, "virtual: the body's mesh has no triangles");
    for (const uint32_t i : indices)
        if (i >= vertex_count)
            fail(VFIT_ERROR_DATA, "virtual: the body's mesh names vertex ", i, " of ", vertex_count);
    indices_.assign(indices.begin(), indices.end());
    vertex_count_ = vertex_count;
    pixels_.resize(vertex_count);

    Embree& e = *embree_;
    e.mesh = rtcNewGeometry(e.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(e.mesh, RTC_BUILD_QUALITY_REFIT);
    e.vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        e.mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertex_count));
    void* triangles = rtcSetNewGeometryBuffer(e.mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                              3 * sizeof(uint32_t), indices.size() / 3);
    if (!e.vertices || !triangles)
        fail(VFIT_ERROR_OUT_OF_MEMORY, "virtual: Embree has no room for the body's mesh");
    std::memcpy(triangles, indices.data(), indices.size_bytes());
    rtcAttachGeometry(e.scene, e.mesh);
}

void DepthCamera::move_vertices(const float* positions) {
    std::memcpy(embree_->vertices, positions, size_t{vertex_count_} * 3 * sizeof(float));
    rtcUpdateGeometryBuffer(embree_->mesh, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(embree_->mesh);
    rtcCommitScene(embree_->scene);
    for (uint32_t i = 0; i < vertex_count_; ++i) {
        const Vec3 p = to_camera({positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]});
        pixels_[i] = p.z > kNearest_m ? Vec3(project(p), p.z) : Vec3(0, 0, 0);
    }
}

void DepthCamera::mark_tiles() {
    std::fill(tiles_.begin(), tiles_.end(), uint8_t{0});
    const float limit_x = static_cast<float>(model_.width), limit_y = static_cast<float>(model_.height);
    for (size_t i = 0; i < indices_.size(); i += 3) {
        const Vec3 &a = pixels_[indices_[i]], &b = pixels_[indices_[i + 1]], &c = pixels_[indices_[i + 2]];
        if (a.z <= 0.0f || b.z <= 0.0f || c.z <= 0.0f) {
            std::fill(tiles_.begin(), tiles_.end(), uint8_t{1});
            return;
        }
        // Half a pixel more on each side covers the rounding of the projection.
        const Vec3 low = glm::min(a, glm::min(b, c)) - 0.5f, high = glm::max(a, glm::max(b, c)) + 0.5f;
        if (high.x < 0.0f || high.y < 0.0f || low.x >= limit_x || low.y >= limit_y) continue;
        const auto x0 = static_cast<uint32_t>(std::max(0.0f, low.x)) / kTile;
        const auto y0 = static_cast<uint32_t>(std::max(0.0f, low.y)) / kTile;
        const auto x1 = static_cast<uint32_t>(std::min(limit_x - 1.0f, high.x)) / kTile;
        const auto y1 = static_cast<uint32_t>(std::min(limit_y - 1.0f, high.y)) / kTile;
        for (uint32_t y = y0; y <= y1; ++y)
            for (uint32_t x = x0; x <= x1; ++x) tiles_[size_t{y} * tiles_x_ + x] = 1;
    }
}

void DepthCamera::cast_tile(uint32_t tile_x, uint32_t tile_y, CleanImage& out) {
    const Vec3 origin(0, place_.height_m, 0);
    const uint32_t x0 = tile_x * kTile, y0 = tile_y * kTile;
    alignas(64) RTCRayHit16 packet;
    alignas(64) int valid[16];
    for (uint32_t k = 0; k < 16; ++k) {
        const uint32_t x = x0 + k % kTile, y = y0 + k / kTile;
        valid[k] = x < model_.width && y < model_.height ? -1 : 0;
        if (!valid[k]) continue;
        const Vec3 d = rotation_ * Vec3((static_cast<float>(x) - model_.cx) / model_.fx,
                                        (static_cast<float>(y) - model_.cy) / model_.fy, 1.0f);
        const float wall = room_.depth_m[size_t{y} * model_.width + x];
        packet.ray.org_x[k] = origin.x, packet.ray.org_y[k] = origin.y, packet.ray.org_z[k] = origin.z;
        packet.ray.dir_x[k] = d.x, packet.ray.dir_y[k] = d.y, packet.ray.dir_z[k] = d.z;
        packet.ray.tnear[k] = 0.0f, packet.ray.time[k] = 0.0f;
        packet.ray.tfar[k] = wall > 0.0f ? wall : std::numeric_limits<float>::infinity();
        packet.ray.mask[k] = ~0u, packet.ray.id[k] = k, packet.ray.flags[k] = 0;
        packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        packet.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
    embree_->intersect(valid, &packet);
    for (uint32_t k = 0; k < 16; ++k) {
        if (!valid[k] || packet.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
        const size_t i = size_t{y0 + k / kTile} * model_.width + x0 + k % kTile;
        const Vec3 normal(packet.hit.Ng_x[k], packet.hit.Ng_y[k], packet.hit.Ng_z[k]);
        const Vec3 d(packet.ray.dir_x[k], packet.ray.dir_y[k], packet.ray.dir_z[k]);
        const float lengths = std::sqrt(glm::dot(normal, normal) * glm::dot(d, d));
        out.depth_m[i] = packet.ray.tfar[k];
        out.cosine[i] = lengths > 0.0f ? std::abs(glm::dot(normal, d)) / lengths : 0.0f;
        out.user[i] = 1;
    }
}

void DepthCamera::render(const float* positions, CleanImage& out) {
    out = room_;
    if (vertex_count_ == 0) return;
    move_vertices(positions);
    mark_tiles();
    for (uint32_t y = 0; y < tiles_y_; ++y)
        for (uint32_t x = 0; x < tiles_x_; ++x)
            if (tiles_[size_t{y} * tiles_x_ + x]) cast_tile(x, y, out);
}

}  // namespace vfit::virtual_person
