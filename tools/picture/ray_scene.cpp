#include "picture/ray_scene.h"

#include <algorithm>

#include "client/client.h"

namespace vfit::tools {

namespace {

RTCRay ray(const glm::vec3& origin, const glm::vec3& direction, float far) {
    RTCRay r{};
    r.org_x = origin.x;
    r.org_y = origin.y;
    r.org_z = origin.z;
    r.dir_x = direction.x;
    r.dir_y = direction.y;
    r.dir_z = direction.z;
    r.tfar = far;
    r.mask = ~0u;
    return r;
}

}  // namespace

// One thread: the rays are shot from threads of our own, and the meshes are small.
RayScene::RayScene() : device_(rtcNewDevice("threads=1")), scene_(nullptr) {
    if (!device_) throw Failure("Embree gives no device to draw pictures with");
    scene_ = rtcNewScene(device_);
}

RayScene::~RayScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

void RayScene::add(const std::vector<glm::vec3>& positions, const std::vector<uint32_t>& indices) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), positions.size()));
    std::copy(positions.begin(), positions.end(), vertices);
    auto* corners = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), indices.size() / 3));
    std::copy(indices.begin(), indices.end(), corners);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
}

void RayScene::commit() { rtcCommitScene(scene_); }

std::optional<RayScene::Hit> RayScene::first_hit(const glm::vec3& origin, const glm::vec3& direction,
                                                 float far) const {
    RTCRayHit query{};
    query.ray = ray(origin, direction, far);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    rtcIntersect1(scene_, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(scene_, &context, &query);
#endif
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{query.ray.tfar, query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v};
}

bool RayScene::blocked(const glm::vec3& origin, const glm::vec3& direction, float far) const {
    RTCRay query = ray(origin, direction, far);
#if RTC_VERSION_MAJOR >= 4
    rtcOccluded1(scene_, &query);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene_, &context, &query);
#endif
    return query.tfar < 0.0f;
}

}  // namespace vfit::tools
